"""``axcomp report``: everything there is to say about a machine's compensations on one page."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from ..lists import read_machine
from ..report import REPEATS, make_report
from ..saving import write_whole
from .check import STATUS_MAX
from .judgement_options import add_judgement_options, evidence_of
from .lists import add_lists_command, failed

_EPILOG = """\
The page holds the findings, a summary of the machine, a picture of every table, the judgement of the tables, the
evaluation of the measurements by ISO 230-2, the budget along the input file, and the cost of a cycle. It needs nothing
beside it and no script. The exit status is the number of options that could not be followed; findings do not count.

examples:
  axcomp report models/three_axis --output report.html
  axcomp report models/three_axis --measurement x.rtl --axis X --feed 30000 --input models/three_axis/input.csv
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    description = "Write a self-contained HTML page about the compensations of a machine."
    parser = add_lists_command(subparsers, "report", description, _EPILOG, _do_report)
    parser.add_argument("--output", type=Path, default=Path("report.html"), metavar="FILE", help="default: report.html")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    parser.add_argument(
        "--repeats", type=int, default=REPEATS, metavar="N", help=f"of the cost of a cycle ({REPEATS}); 0: without"
    )
    add_judgement_options(parser)


def _do_report(options: argparse.Namespace) -> int:
    reading = read_machine(options.path, allow_outside=options.allow_outside)
    if not reading.machine.axes:
        for finding in reading.findings:
            print(finding, file=sys.stderr)
        return failed("report", f"there is no machine in {options.path}")
    if not options.output.parent.is_dir():
        return failed("report", f"there is no folder {options.output.parent}")
    evidence = evidence_of(options, reading.machine)
    report = make_report(reading, evidence, cycle_time=options.cycle_time, repeats=options.repeats)
    write_whole(options.output, report.html())
    for note in report.notes:
        print(f"axcomp report: {note}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps({"output": str(options.output), **report.to_dict()}, indent=2, ensure_ascii=False))
    else:
        print(options.output)
    return min(len(report.notes), STATUS_MAX)
