"""What all kinds of ``axcomp create`` do alike: make a table, write it, draw it, tell about it, or what is wrong."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..measurement.columns import MeasurementError


class Created(Protocol):
    """A table that was made from measurements."""

    def write(self, output: Path | None = None) -> Path:
        """Write the list; return its path."""
        ...

    def plot(self) -> Any:
        """Return axes with the picture."""
        ...

    def to_dict(self) -> dict[str, Any]:
        """Return everything about it for JSON."""
        ...


Made = TypeVar("Made", bound=Created)


def carry_out(args: argparse.Namespace, make: Callable[[], Made], show: Callable[[Made, Path | None], None]) -> int:
    """Make a table as the options say and return the exit status; ``show`` prints it and where it was written."""
    try:
        creation = make()
        written = None if args.dry_run else creation.write(args.output)
        if args.plot is not None:
            creation.plot().figure.savefig(args.plot)
    except MeasurementError as error:
        print(error, file=sys.stderr)
        return 1
    except ValueError as error:
        print(f"axcomp create: {error}", file=sys.stderr)
        return 1
    if args.format == "json":
        written_to = None if written is None else str(written)
        print(json.dumps({**creation.to_dict(), "written": written_to}, indent=2, ensure_ascii=False))
    else:
        show(creation, written)
    return 0
