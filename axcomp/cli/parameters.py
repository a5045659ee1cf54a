"""``axcomp parameters``: the list parameters that are understood."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterable, Sequence

from ..kinds import ListKind
from ..lists import CATALOGUE, HEADINGS, as_dict, cells

_EXAMPLE = """\
example:
  axcomp parameters --list achskw
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "parameters",
        description="Print every list parameter with its ids, type, range, unit and default.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--format", choices=("table", "json"), default="table", help="what to print (default: table)")
    parser.add_argument(
        "--list",
        metavar="NAME",
        choices=[_short_name(kind) for kind in CATALOGUE],
        help=f"only the parameters of one list: {', '.join(_short_name(kind) for kind in CATALOGUE)}",
    )
    parser.set_defaults(do=_do_parameters)


def _short_name(kind: ListKind) -> str:
    return kind.value.removesuffix(".lis").rstrip("*")


def _do_parameters(options: argparse.Namespace) -> int:
    kinds = [kind for kind in CATALOGUE if options.list in (None, _short_name(kind))]
    if options.format == "json":
        rows = [as_dict(kind, parameter) for kind in kinds for parameter in CATALOGUE[kind]]
        print(json.dumps(rows, indent=2, ensure_ascii=False))
        return 0
    for number, kind in enumerate(kinds):
        print(f"{'' if number == 0 else chr(10)}{kind.value}")
        for line in _table([HEADINGS, *(cells(parameter) for parameter in CATALOGUE[kind])]):
            print(line)
    return 0


def _table(rows: Sequence[Sequence[str]]) -> Iterable[str]:
    """Yield rows with their columns below each other; the last column is as wide as it is."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
