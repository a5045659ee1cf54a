"""Write the C sources that follow from the declarations: ``python -m axcomp.native``."""

from __future__ import annotations

from pathlib import Path

from ..model import fmu_sources
from ..saving import write_whole
from .places import layout_header, places_source
from .records import records_source


def write(folder: Path) -> list[Path]:
    """Write ``layout.h``, ``places.c`` and ``records.c``; return their paths."""
    texts = {"layout.h": layout_header(), "places.c": places_source(), "records.c": records_source()}
    for name, text in texts.items():
        write_whole(folder / name, text)
    return [folder / name for name in texts]


if __name__ == "__main__":
    for path in write(fmu_sources() / "native"):
        print(f"wrote {path.name}")
