"""``axcomp convert``: compensation tables to and from other controllers."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ..conversion import (
    CONVERTED,
    FORMATS,
    LISTS,
    MAX_POINTS,
    CannotHoldError,
    Compared,
    CompensationTable,
    FormatError,
    Options,
    compared,
    dropped,
    machine_with,
    recognized,
    tables_of,
    written,
)
from ..kinds import KINDS
from ..lists import decode, machine_documents, read_machine, write_machine
from ..saving import write_whole
from .lists import add_lists_command, failed, read_lists

_NAMES = (LISTS, *FORMATS)

_EPILOG = f"""\
formats:
  {LISTS:<12} a start-up list, a folder with one, or a compensation list; written to a folder
{chr(10).join(f"  {one.name:<12} {one.summary}" for one in FORMATS.values())}

Whatever is written is read again and compared with what it came from, at all points, between and beyond them.

examples:
  axcomp convert models/three_axis --axis Y --kind leadscrew --to enc-comp --output y.mpf
  axcomp convert models/three_axis --axis X --kind leadscrew --to cec --within 0.1 --output x.mpf
  axcomp convert x.com --rotary C --to lists --output lists
  axcomp convert joint0.comp --from linuxcnc-0 --axis X --to csv
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    description = "Convert leadscrew and cross compensation tables to and from other controllers."
    parser = add_lists_command(
        subparsers, "convert", description, _EPILOG, _do_convert, "lists of a machine, or a file of another controller"
    )
    parser.add_argument("--to", required=True, choices=_NAMES, metavar="FORMAT", help="one of the formats below")
    parser.add_argument("--from", dest="source", choices=_NAMES, metavar="FORMAT", help="default: by the content")
    parser.add_argument("--output", type=Path, metavar="FILE", help="file, or folder for lists; default: print it")
    parser.add_argument("--axis", help="only this axis; also the axis of a file that does not tell it")
    parser.add_argument("--kind", choices=KINDS, help="only this kind")
    parser.add_argument("--over", metavar="AXIS", help="axis of the positions, where the file does not tell it")
    parser.add_argument("--rotary", metavar="AXIS,…", default="", help="rotary axes, where the file does not tell them")
    parser.add_argument(
        "--within", type=float, metavar="µm", help="choose other points; they may cost this much (rotary: ″)"
    )
    parser.add_argument(
        "--max-points", type=int, default=MAX_POINTS, metavar="N", help="points the other control reserves for a table"
    )
    parser.add_argument("--encoder", type=int, choices=(0, 1), default=0, help="measuring system of ENC_COMP (0)")
    parser.add_argument("--from-inch", action="store_true", help="the file is in inches (SINUMERIK, LinuxCNC)")
    parser.add_argument("--to-inch", action="store_true", help="write inches (SINUMERIK, LinuxCNC)")
    parser.add_argument("--machine", type=Path, metavar="PATH", help="machine whose lists get the tables (--to lists)")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of the report; default: text")


def _do_convert(args: argparse.Namespace) -> int:
    try:
        tables, notes = _read(args)
        if args.to == LISTS:
            text, result = "", _write_lists(tables, args)
        else:
            text, result = written(tables, args.to, replace(_options(args), inch=args.to_inch))
            if args.output is not None:
                write_whole(args.output, text)
    except FormatError as error:
        print(f"{args.path}:{error.line}: error: {error.message}", file=sys.stderr)
        return 1
    except (CannotHoldError, ValueError) as error:
        return failed("convert", str(error))
    # The converted file has standard output for itself where it goes there.
    report = sys.stderr if text and args.output is None else sys.stdout
    if report is sys.stderr:
        sys.stdout.write(text)
    if args.format == "json":
        print(
            json.dumps({"tables": [_figures(one) for one in result], "notes": notes}, ensure_ascii=False), file=report
        )
    else:
        for line in (*(_sentence(one) for one in result), *(f"note: {note}" for note in notes)):
            print(line, file=report)
    return 0


def _options(args: argparse.Namespace) -> Options:
    if args.within is not None and not args.within >= 0.0:
        raise CannotHoldError("--within must be 0 µm or more")
    if args.max_points < 2:
        raise CannotHoldError("--max-points must be 2 or more")
    return Options(
        axis=args.axis,
        over=args.over,
        rotary=frozenset(name for name in args.rotary.split(",") if name),
        encoder=args.encoder,
        max_points=args.max_points,
        within=args.within,
    )


def _read(args: argparse.Namespace) -> tuple[list[CompensationTable], list[str]]:
    """Return the tables that are asked for, and what the target does not take over."""
    source = args.source or (LISTS if args.path.is_dir() or args.path.suffix.lower() == ".lis" else None)
    if source == LISTS:
        machine = read_lists(args.path, args.allow_outside).machine
        tables = tables_of(machine, args.axis, args.kind)
        return tables, dropped(machine, tables) if args.to != LISTS else []
    text = decode(args.path.read_bytes())
    if text is None:
        raise FormatError(0, "the file is no text")
    source = source or recognized(text)
    if source is None:
        raise FormatError(0, f"the content does not tell the format; say it: --from {'|'.join(_NAMES)}")
    tables = FORMATS[source].read(text, replace(_options(args), inch=args.from_inch))
    chosen = [table for table in tables if args.axis in {None, table.axis} and args.kind in {None, table.kind}]
    if not chosen:
        raise CannotHoldError(f"none of its tables is asked for: it has {', '.join(table.name for table in tables)}")
    return chosen, []


def _write_lists(tables: Sequence[CompensationTable], args: argparse.Namespace) -> list[Compared]:
    """Write a machine's lists once what they say is found to be right."""
    if args.output is None:
        raise CannotHoldError("lists are several files: give a folder for them with --output")
    of = None if args.machine is None else read_lists(args.machine, args.allow_outside).machine
    machine = machine_with(tables, of)
    back = read_machine(args.output, documents=machine_documents(machine, args.output)).machine
    held = [(axis.name, kind) for kind in CONVERTED for axis in back.axes if getattr(axis, kind)]
    after = [table for axis, kind in held for table in tables_of(back, axis, kind)]
    result = compared(tables, after, args.within)
    write_machine(machine, args.output)
    return result


def _sentence(one: Compared) -> str:
    size, position, direction = one.difference
    points = f"{len(one.before.positions)} points, written {len(one.after.positions)}"
    motion = "positive" if direction > 0 else "negative"
    where = f" at {position:g} {one.before.over_unit} in {motion} motion" if size else ""
    return f"{one.before.name}: {points}; largest difference {size:.4f} {one.before.shown.unit}{where}"


def _figures(one: Compared) -> dict[str, object]:
    return {
        "axis": one.before.axis,
        "over": one.before.over,
        "kind": one.before.kind,
        "points": len(one.before.positions),
        "written_points": len(one.after.positions),
        "largest_difference": one.difference.size,
        "unit": one.before.shown.unit,
        "at": one.difference.position,
        "direction": one.difference.direction,
    }
