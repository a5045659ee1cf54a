"""``axcomp show``: compensation tables as pictures, pages and tables, and the difference of two machines."""

from __future__ import annotations

import argparse
import csv
import io
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict, astuple
from pathlib import Path

from ..kinds import KINDS
from ..plot import (
    VOLUMETRIC,
    Content,
    NoPlotlyError,
    NotComparableError,
    Records,
    contents_of,
    overview,
    page,
    save,
    shown,
)
from ..saving import write_whole
from .lists import add_lists_command, failed, read_lists
from .reading_options import add_axis_type

ROWS = 12
HEAD_MAX = 110
"""Characters of the names of all columns that one line has room for."""

_EPILOG = """\
The suffix of the output file tells what is written: .png a picture for each table (several get the names of axis and
kind added), .html one page with all pictures and tables, .csv all numbers. Without it tables are printed.

examples:
  axcomp show models/three_axis
  axcomp show models/three_axis --axis X --kind leadscrew --output x.png
  axcomp show models/five_axis --output machine.html --interactive
  axcomp show new/hochlauf.lis --against old/hochlauf.lis --output difference.html
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    description = "Show the compensation tables of a machine, or the difference of two machines."
    parser = add_lists_command(subparsers, "show", description, _EPILOG, _do_show)
    parser.add_argument("--axis", help="only the tables of this axis")
    parser.add_argument("--kind", choices=(*KINDS, VOLUMETRIC), help="only this kind")
    parser.add_argument("--output", type=Path, metavar="FILE", help="FILE.png, FILE.html or FILE.csv")
    parser.add_argument("--interactive", action="store_true", help="FILE.html: volumetric errors in 3-D, by Plotly")
    parser.add_argument("--against", type=Path, metavar="OTHER", help="another machine: show OTHER minus PATH")
    parser.add_argument("--tool-length", type=float, default=0.0, metavar="mm", help="for the TCP error (0)")
    parser.add_argument("--rows", type=int, default=ROWS, metavar="N", help=f"rows of a printed table ({ROWS}); 0: all")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    add_axis_type(parser)


def _do_show(args: argparse.Namespace) -> int:
    if args.output is not None and args.output.suffix.lower() not in _SUFFIXES:
        return failed("show", f"{args.output} must end in {', '.join(_SUFFIXES)}")
    contents, known, name = _contents(args.path, args)
    notes: list[str] = []
    title = f"Compensations of {name}"
    if args.against is not None:
        others, other_known, other = _contents(args.against, args)
        if not other_known:
            return failed("show", f"there is no axis in {args.against}")
        known |= other_known
        title = f"{other} minus {name}"
        contents, notes = _differences(contents, others)
    if not contents:
        return failed("show", _nothing(args, known, notes))
    for note in notes:
        print(f"note: {note}", file=sys.stderr)
    if args.output is not None:
        try:
            written = _written(contents, args, title, notes)
        except NoPlotlyError as error:
            return failed("show", str(error))
        for path in written:
            print(path)
    elif args.format == "json":
        print(json.dumps([_figures(content) for content in contents], ensure_ascii=False))
    else:
        _print(contents, args.rows)
    return 0


def _contents(path: Path, args: argparse.Namespace) -> tuple[list[Content], set[str], str]:
    """Return what is asked for, the names of the machine's axes, and its own."""
    reading = read_lists(path, args.allow_outside, args.axis_type)
    machine = reading.machine
    contents = contents_of(machine, args.axis, args.kind, args.tool_length)
    return contents, {axis.name for axis in machine.axes}, reading.name


def _differences(mine: Sequence[Content], theirs: Sequence[Content]) -> tuple[list[Content], list[str]]:
    """Return the differences of what both have, and a sentence for what cannot be compared."""
    others = {content.subject: content for content in theirs}
    found: list[Content] = []
    notes = []
    for content in mine:
        other = others.pop(content.subject, None)
        if other is None:
            notes.append(f"{content.subject.title}: the other machine has none")
            continue
        try:
            found.append(content.against(other))
        except NotComparableError as error:
            notes.append(str(error))
    return found, notes + [f"{subject.title}: only the other machine has one" for subject in others]


def _nothing(args: argparse.Namespace, known: set[str], notes: Sequence[str]) -> str:
    if args.axis is not None and args.axis not in known:
        return f"there is no axis {args.axis!r}; there are {', '.join(sorted(known)) or 'none'}"
    asked = " ".join(word for word in (args.kind, "compensation") if word)
    of_axis = f" of axis {args.axis}" if args.axis else ""
    said = "".join(f"\n  {note}" for note in notes)
    return f"no {asked}{of_axis} is in force in {args.path}{' and ' + str(args.against) if args.against else ''}{said}"


def _write_pictures(contents: Sequence[Content], path: Path) -> list[Path]:
    paths = [path]
    if len(contents) > 1:
        paths = [path.with_name(f"{path.stem}-{_in_file_name(one.subject.name)}{path.suffix}") for one in contents]
    for content, file in zip(contents, paths, strict=True):
        save(content.figure(), file)
    return paths


def _in_file_name(name: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "-_" else "_" for letter in name)


def _write_csv(contents: Sequence[Content], path: Path) -> list[Path]:
    """Write all numbers below each other; columns that a content does not have stay empty."""
    all_records = [content.records() for content in contents]
    columns = list(dict.fromkeys(column for records in all_records for column in records.columns))
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["axis", "kind", "part", *columns])
    for content, records in zip(contents, all_records, strict=True):
        for row in records.rows:
            cells = dict(zip(records.columns, row, strict=True))
            writer.writerow([*astuple(content.subject), *(cells.get(name, "") for name in columns)])
    write_whole(path, file.getvalue())
    return [path]


_SUFFIXES = (".png", ".html", ".csv")


def _written(contents: Sequence[Content], args: argparse.Namespace, title: str, notes: Sequence[str]) -> list[Path]:
    """Write the contents and return the files."""
    path: Path = args.output
    suffix = path.suffix.lower()
    if suffix == ".html":
        write_whole(path, page(title, contents, notes, turning=args.interactive))
        return [path]
    return _write_pictures(contents, path) if suffix == ".png" else _write_csv(contents, path)


def _figures(content: Content) -> dict[str, object]:
    return {**asdict(content.subject), **content.records()._asdict()}


def _print(contents: Sequence[Content], rows: int) -> None:
    from ..plot import console, table

    out = console()

    def show(title: str, records: Records) -> None:
        out.print(table(title, _head(records), [[shown(cell) for cell in row] for row in records.rows]))

    if len(contents) > 1:
        show("", overview(contents))
    for content in contents:
        show(content.subject.title, content.extract(rows))


def _head(records: Records) -> list[str]:
    """Return the names of the columns, on several lines each where one line would be too long."""
    if sum(map(len, records.columns)) <= HEAD_MAX:
        return list(records.columns)
    return [name.replace(", ", ",\n").replace(" [", "\n[") for name in records.columns]
