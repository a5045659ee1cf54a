"""Where the package's companions are: the sources of the FMUs, the example machines, the documentation.

They lie beside the package in a checkout, and inside it in an installed wheel.
"""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def fmu_sources() -> Path:
    """Return the folder of what goes into the FMUs."""
    return _companion("fmu_src")


def models() -> Path:
    """Return the folder of the example machines."""
    return _companion("models")


def licence() -> Path:
    """Return the file with the terms under which all of it may be used."""
    return _companion("LICENSE")


def docs() -> Path:
    """Return the folder of the documentation."""
    return _companion("docs")


def machine_path(text: str) -> Path:
    """Return the path of a machine; ``models/NAME`` and ``NAME`` name an example where nothing else has that path."""
    path = Path(text)
    if path in (Path(path.name), Path("models", path.name)) and path.name and not path.exists():
        example = models() / path.name
        return example if example.is_dir() else path
    return path


def _companion(name: str) -> Path:
    installed = _PACKAGE / f"_{name}"
    return installed if installed.exists() else _PACKAGE.parent / name
