"""``axcomp create``: lists from measurements, one sub-command a kind that the room ``fit`` knows."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from ..fit import DROP, FITS, KEEP, REPORT, Creation, Fit, Options, create, fit_of
from ..measurement import MeasurementError, SeveralAxesError


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "create",
        description="Makes a compensation table from measurements and puts it into a list; the rest of the list stays.",
        epilog="example:\n  axcomp create leadscrew --from x.rtl --into achskw1.lis --bound 0.5",
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True)
    for kind in FITS:
        _add_kind(kinds, fit_of(kind))


def _add_kind(kinds: argparse._SubParsersAction[argparse.ArgumentParser], fit: type[Fit[Any, Any]]) -> None:
    parser = kinds.add_parser(
        fit.name, help=fit.meaning, description=fit.description(), epilog=f"example:\n  {fit.example}"
    )
    parser.add_argument(
        "--from", dest="files", nargs="+", type=Path, required=True, metavar="MEASUREMENT", help="files, as one"
    )
    parser.add_argument("--into", type=Path, required=True, metavar="LIST", help=fit.into)
    parser.add_argument("--output", type=Path, metavar="FILE", help="write there instead")
    parser.add_argument("--dry-run", action="store_true", help="write nothing, and show what would change")
    parser.add_argument("--measured", default="", metavar="AXIS", help="of files with several axes the one that counts")
    parser.add_argument(
        "--outliers",
        choices=(REPORT, DROP, KEEP),
        default=REPORT,
        help="readings that stand apart: stop and say so (default), leave them out, or let them count",
    )
    for option, how in fit.arguments.items():
        parser.add_argument(f"--{option}", **how)
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw measurement, table and what is left")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    parser.set_defaults(do=_do_create, fit=fit)


def _do_create(args: argparse.Namespace) -> int:
    fit: type[Fit[Any, Any]] = args.fit
    given = vars(args)
    try:
        target = fit.open(args.into, given)
        readings = fit.load(args.files, given, lambda path: _read(fit, path, args.measured, target))
        options = Options(**{item.name: given[item.name] for item in fields(Options) if item.name in given})
        creation = create(fit.name, readings, target, options)
        changes = creation.changes(args.output) if args.dry_run else []
        kept = [] if args.dry_run else creation.backups(args.output)
        written = [] if args.dry_run else creation.write(args.output)
        if args.plot is not None:
            from ..plot import save  # takes long to load

            picture: Any = creation.plot().figure
            save(picture, args.plot)
    except MeasurementError as error:
        print(error, file=sys.stderr)
        return 1
    except ValueError as error:
        print(f"axcomp create: {error}", file=sys.stderr)
        return 1
    if args.format == "json":
        written_to = str(written[0]) if written else None
        found = {**creation.to_dict(), "written": written_to, "backups": list(map(str, kept))}
        print(json.dumps({**found, **({"diff": changes} if args.dry_run else {})}, indent=2, ensure_ascii=False))
    else:
        _print(creation, written, kept, changes)
    return 0


def _read(fit: type[Fit[Any, Any]], path: Path, axis: str, target: Any) -> Any:
    """Return the readings of a file; of several axes those of ``axis``, else of the axis that the list is for."""
    try:
        return fit.read(path, axis) if axis else fit.read(path)
    except SeveralAxesError:
        own = getattr(getattr(target, "axis", None), "name", "")
        if axis or not own:
            raise
        return fit.read(path, own)


def _print(creation: Creation, written: Sequence[Path], kept: Sequence[Path], changes: Sequence[str]) -> None:
    from ..plot import compared, console, table

    out, report = console(), creation.report
    if report.rows:
        title, *header = report.rows[0]
        out.print(table(title, ["", *header], report.rows[1:]))
    out.print(compared(f"{creation.kind} into {creation.path}", creation.figures, creation.labels, creation.unit))
    for sentence in (*report.sentences, *(f"Note: {note}" for note in report.notes)):
        out.print(sentence)
    for line in changes:
        print(line)
    if kept:
        out.print(f"What was there before is in {' and '.join(map(str, kept))}.")
    out.print(f"Written to {' and '.join(map(str, written))}." if written else "Nothing was written.")
