"""``axcomp diagnose``: all records of the volumetric compensations as spreadsheets."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..analysis.diagnosis import Written, volumetric_lists, write_diagnoses
from ..fmu import BuildError
from ..lists import Severity, read_machine
from ..model import COMPENSATIONS_MAX
from .lists import add_lists_command, failed

_EPILOG = """\
A workbook has a sheet with the settings of the volumetric list and what was found in it, then a sheet for each
parameter file: every record with its position, value, line, and why it does not count if it does not.

Without --output it goes where the list's diagnosis_file says; a folder of the controller that is not there is replaced
by that of the list. With --output and several compensations their numbers are added to the name.

examples:
  axcomp diagnose lists/hochlauf.lis
  axcomp diagnose models/five_axis --output records.xlsx
  axcomp diagnose models/five_axis --id 1 --output rotary.xlsx
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    description = "Write the diagnosis files of volumetric compensations: spreadsheets of all records, sorted."
    parser = add_lists_command(
        subparsers, "diagnose", description, _EPILOG, _do_diagnose, "a start-up list, or a folder with one"
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="default: what the list names")
    parser.add_argument("--id", type=int, choices=range(COMPENSATIONS_MAX), help="only this compensation; default: all")


def _do_diagnose(args: argparse.Namespace) -> int:
    reading = read_machine(args.path, allow_outside=args.allow_outside)
    found, faults = volumetric_lists(reading)
    status = max([0, *(failed("diagnose", fault) for fault in faults)])
    sources = [source for source in found if args.id in (None, source.index)]
    if not sources:
        which = "volumetric list" if args.id is None else f"volumetric list with ID {args.id}"
        return failed("diagnose", f"there is no {which} to be read in {args.path}.")
    taken = sources if args.output is not None else [source for source in sources if source.diagnosis_file]
    if not taken:
        names = ", ".join(source.path.name for source in sources)
        return failed("diagnose", f"{names}: no diagnosis_file is named; --output FILE says where to write.")
    for result in write_diagnoses(taken, reading, args.output):
        status = max(status, failed("diagnose", str(result)) if isinstance(result, BuildError) else _tell(result))
    return status


def _tell(written: Written) -> int:
    """Print what was written; return 1 if a parameter file is missing in it."""
    for note in written.notes:
        print(f"note: {note}", file=sys.stderr)
    diagnosis = written.diagnosis
    for finding in diagnosis.findings:
        if finding.severity is Severity.ERROR:
            print(finding, file=sys.stderr)
    count = sum(len(file.records) for file in diagnosis.files)
    print(f"{written.path}: {count} records of {', '.join(file.path.name for file in diagnosis.files) or 'no file'}")
    return int(any(not file.was_read for file in diagnosis.files))
