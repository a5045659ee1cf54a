"""``axcomp parameters``: the list parameters that are understood."""

from __future__ import annotations

import argparse
import json
import shutil
import textwrap
from collections.abc import Iterable, Sequence

from ..kinds import ListKind
from ..lists import CATALOGUE, HEADINGS, as_dict, cells

_EXAMPLE = """\
example:
  axcomp parameters --list achskw
"""


LEAST = 20
"""Characters that the last column needs."""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "parameters",
        description="Print every list parameter with its ids, type, range, unit and default.",
        epilog=_EXAMPLE,
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
    """Yield rows with their columns below each other; the last one goes on below where the terminal ends."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    room = shutil.get_terminal_size((0, 0)).columns
    before = sum(widths[:-1]) + 2 * (len(widths) - 1)
    for row in rows:
        line = "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        if not room or len(line) <= room:
            yield line
        elif before + LEAST <= room:
            yield from textwrap.wrap(line, room, subsequent_indent=" " * before, drop_whitespace=True)
        else:
            cells = "  ".join(cell for cell in row if cell)
            yield from textwrap.wrap(cells, room, subsequent_indent="    ")
