"""``axcomp show``: compensation tables as pictures, pages and tables, and the difference of two machines."""

from __future__ import annotations

import argparse
import csv
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from ..kinds import KINDS
from ..lists import Severity, read_machine
from ..model.companions import machine_path
from ..plot.content import Content, NotComparableError, Records
from ..plot.contents import contents_of
from ..plot.page import overview, page, shown
from ..plot.style import save
from ..plot.volume import volumetric_contents

VOLUMETRIC = "volumetric"
ROWS = 12
HEAD_MAX = 110
"""Characters of the names of all columns that one line has room for."""

_EPILOG = """\
The suffix of the output file tells what is written: .png a picture for each table (several get the names of axis and
kind added), .html one page with all pictures and tables, .csv all numbers. Without it tables are printed.

examples:
  axcomp show models/three_axis
  axcomp show models/three_axis --axis X --kind leadscrew --output x.png
  axcomp show models/three_axis --output machine.html
  axcomp show new/hochlauf.lis --against old/hochlauf.lis --output difference.html
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "show",
        description="Show the compensation tables of a machine, or the difference of two machines.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "path", type=machine_path, metavar="PATH", help="start-up list, folder, or one compensation list"
    )
    parser.add_argument("--axis", help="only the tables of this axis")
    parser.add_argument("--kind", choices=(*KINDS, VOLUMETRIC), help="only this kind")
    parser.add_argument("--output", type=Path, metavar="FILE", help="FILE.png, FILE.html or FILE.csv")
    parser.add_argument("--against", type=Path, metavar="OTHER", help="another machine: show OTHER minus PATH")
    parser.add_argument("--tool-length", type=float, default=0.0, metavar="mm", help="for the TCP error (0)")
    parser.add_argument("--rows", type=int, default=ROWS, metavar="N", help=f"rows of a printed table ({ROWS}); 0: all")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    parser.set_defaults(do=_do_show)


def _do_show(args: argparse.Namespace) -> int:
    if args.output is not None and args.output.suffix.lower() not in _WRITERS:
        print(f"axcomp show: {args.output} must end in {', '.join(_WRITERS)}", file=sys.stderr)
        return 1
    contents, known = _contents(args.path, args)
    notes: list[str] = []
    if args.against is not None:
        others, other_known = _contents(args.against, args)
        if not other_known:
            print(f"axcomp show: there is no axis in {args.against}", file=sys.stderr)
            return 1
        known |= other_known
        contents, notes = _differences(contents, others)
    if not contents:
        print(f"axcomp show: {_nothing(args, known, notes)}", file=sys.stderr)
        return 1
    for note in notes:
        print(f"note: {note}", file=sys.stderr)
    if args.output is not None:
        for path in _WRITERS[args.output.suffix.lower()](contents, args.output, _title(args), notes):
            print(path)
    elif args.format == "json":
        print(json.dumps([_figures(content) for content in contents], ensure_ascii=False))
    else:
        _print(contents, args.rows)
    return 0


def _contents(path: Path, args: argparse.Namespace) -> tuple[list[Content], set[str]]:
    """Return what is asked for, and the names of the machine's axes."""
    reading = read_machine(path)
    machine = reading.machine
    for finding in reading.findings:
        if finding.severity is Severity.ERROR:
            print(finding, file=sys.stderr)
    contents = [] if args.kind == VOLUMETRIC else contents_of(machine, args.axis, args.kind)
    if args.kind in {None, VOLUMETRIC}:
        contents += volumetric_contents(machine, args.axis, args.tool_length)
    return contents, {axis.name for axis in machine.axes}


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


def _title(args: argparse.Namespace) -> str:
    return f"{args.against} minus {args.path}" if args.against else f"Compensations of {args.path}"


def _write_pictures(contents: Sequence[Content], path: Path, _title: str, _notes: Sequence[str]) -> list[Path]:
    paths = [path]
    if len(contents) > 1:
        paths = [path.with_name(f"{path.stem}-{_in_file_name(one.subject.name)}{path.suffix}") for one in contents]
    for content, place in zip(contents, paths, strict=True):
        save(content.figure(), place)
    return paths


def _in_file_name(name: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "-_" else "_" for letter in name)


def _write_page(contents: Sequence[Content], path: Path, title: str, notes: Sequence[str]) -> list[Path]:
    path.write_text(page(title, contents, notes), encoding="utf-8")
    return [path]


def _write_csv(contents: Sequence[Content], path: Path, _title: str, _notes: Sequence[str]) -> list[Path]:
    """Write all numbers below each other; columns that a content does not have stay empty."""
    all_records = [content.records() for content in contents]
    columns = list(dict.fromkeys(column for records in all_records for column in records.columns))
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["axis", "kind", "part", *columns])
        for content, records in zip(contents, all_records, strict=True):
            subject = content.subject
            for row in records.rows:
                cells = dict(zip(records.columns, row, strict=True))
                writer.writerow([subject.axis, subject.kind, subject.part, *(cells.get(name, "") for name in columns)])
    return [path]


_WRITERS = {".png": _write_pictures, ".html": _write_page, ".csv": _write_csv}


def _figures(content: Content) -> dict[str, object]:
    subject, records = content.subject, content.records()
    head: dict[str, object] = {"axis": subject.axis, "kind": subject.kind, "part": subject.part}
    return {**head, "columns": records.columns, "rows": records.rows}


def _print(contents: Sequence[Content], rows: int) -> None:
    from ..plot.terminal import console, table

    out = console()
    if len(contents) > 1:
        summary = overview(contents)
        out.print(table("", summary.columns, [[shown(cell) for cell in row] for row in summary.rows]))
    for content in contents:
        extract = content.extract(rows)
        out.print(table(content.subject.title, _head(extract), [[shown(c) for c in row] for row in extract.rows]))


def _head(records: Records) -> list[str]:
    """Return the names of the columns, on several lines each where one line would be too long."""
    if sum(map(len, records.columns)) <= HEAD_MAX:
        return list(records.columns)
    return [name.replace(", ", ",\n").replace(" [", "\n[") for name in records.columns]
