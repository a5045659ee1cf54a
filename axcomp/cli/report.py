"""``axcomp report``: everything there is to say about a machine's compensations on one page."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from ..lists import read_machine
from ..model.companions import machine_path
from ..report.report import REPEATS, make_report
from .check import STATUS_MAX
from .judgement_options import add_judgement_options, evidence_of

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
    parser = subparsers.add_parser(
        "report",
        description="Write a self-contained HTML page about the compensations of a machine.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "path", type=machine_path, metavar="PATH", help="start-up list, folder, or one compensation list"
    )
    parser.add_argument("--output", type=Path, default=Path("report.html"), metavar="FILE", help="default: report.html")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    parser.add_argument(
        "--repeats", type=int, default=REPEATS, metavar="N", help=f"of the cost of a cycle ({REPEATS}); 0: without"
    )
    add_judgement_options(parser)
    parser.set_defaults(do=_do_report)


def _do_report(options: argparse.Namespace) -> int:
    reading = read_machine(options.path)
    if not reading.machine.axes:
        for finding in reading.findings:
            print(finding, file=sys.stderr)
        print(f"axcomp report: there is no machine in {options.path}", file=sys.stderr)
        return 1
    if not options.output.parent.is_dir():
        print(f"axcomp report: there is no folder {options.output.parent}", file=sys.stderr)
        return 1
    evidence = evidence_of(options, reading.machine)
    report = make_report(
        reading,
        readings=evidence.readings,
        measurements=evidence.measurements,
        demand=evidence.demand,
        given=evidence.input,
        tool_length=options.tool_length,
        cycle_time=options.cycle_time,
        repeats=options.repeats,
        notes=evidence.faults,
    )
    options.output.write_text(report.html(), encoding="utf-8")
    for note in report.notes:
        print(f"axcomp report: {note}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps({"output": str(options.output), **report.to_dict()}, indent=2, ensure_ascii=False))
    else:
        print(options.output)
    return min(len(report.notes), STATUS_MAX)
