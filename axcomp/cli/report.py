"""``axcomp report``: everything there is to say about a machine's compensations on one page."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import fields, replace
from pathlib import Path

from ..analysis.judgement import Evidence
from ..lists import Reading, read_machine
from ..measurement import evaluate_robustly
from ..plot import NoPlotlyError
from ..report import REPEATS, Protocol, ProtocolFields, Report, make_protocol, make_report
from ..saving import write_whole
from .judgement_options import add_judgement_options, evidence_of
from .lists import STATUS_MAX, add_lists_command, failed

_EPILOG = """\
The page holds the findings, a summary of the machine, a picture of every table, the judgement of the tables, the
evaluation of the measurements by ISO 230-2, the budget along the input file, and the cost of a cycle. It needs nothing
beside it. The exit status is the number of options that could not be followed; findings do not count.

examples:
  axcomp report models/three_axis --output report.html
  axcomp report models/three_axis --protocol --fields job.toml --measurement before.csv --measurement after.csv
  axcomp report models/three_axis --measurement x.rtl --axis X --feed 30000 --input models/three_axis/input.csv
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    description = "Write a self-contained HTML page about the compensations of a machine."
    parser = add_lists_command(subparsers, "report", description, _EPILOG, _do_report)
    parser.add_argument("--output", type=Path, metavar="FILE", help="default: report.html or protocol.html")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    parser.add_argument(
        "--repeats", type=int, default=REPEATS, metavar="N", help=f"of the cost of a cycle ({REPEATS}); 0: without"
    )
    parser.add_argument("--interactive", action="store_true", help="volumetric errors in 3-D, by Plotly's script")
    add_judgement_options(parser)
    group = parser.add_argument_group("a dated protocol instead", "It prints to A4; the first measurement is before.")
    group.add_argument("--protocol", action="store_true", help="write it")
    group.add_argument("--fields", type=Path, metavar="FILE.toml", help="what it says; options go before the file")
    for one in fields(ProtocolFields):
        if one.name != "axis":
            name = "--machine-name" if one.name == "machine" else f"--{one.name}"
            group.add_argument(name, dest=f"field_{one.name}", metavar="TEXT", help=one.metadata["meaning"])


def _do_report(options: argparse.Namespace) -> int:
    reading = read_machine(options.path, allow_outside=options.allow_outside)
    if not reading.machine.axes:
        for finding in reading.findings:
            print(finding, file=sys.stderr)
        return failed("report", f"there is no machine in {options.path}")
    if options.output is None:
        options.output = Path("protocol.html" if options.protocol else "report.html")
    evidence = evidence_of(options, reading.machine)
    if options.protocol:
        return _write_protocol(options, reading, evidence)
    given = [one.name for one in fields(ProtocolFields) if getattr(options, f"field_{one.name}", None)]
    if given or options.fields is not None:
        return failed("report", "fields are for a protocol: --protocol writes one")
    report = make_report(reading, evidence, cycle_time=options.cycle_time, repeats=options.repeats)
    try:
        html = replace(report, turning=options.interactive).html()
    except NoPlotlyError as error:
        return failed("report", str(error))
    return _tell(options, html, report)


def _write_protocol(options: argparse.Namespace, reading: Reading, evidence: Evidence) -> int:
    given = {one.name: getattr(options, f"field_{one.name}", None) for one in fields(ProtocolFields)}
    said = {name: text for name, text in {**given, "axis": options.axis}.items() if text}
    try:
        found = ProtocolFields(**said) if options.fields is None else ProtocolFields.read(options.fields, said)
    except ValueError as error:
        return failed("report", str(error))
    evaluations = [evaluate_robustly(one) for one in evidence.readings]
    protocol = make_protocol(reading, evaluations, found, evidence.faults)
    return _tell(options, protocol.html(), protocol)


def _tell(options: argparse.Namespace, html: str, made: Report | Protocol) -> int:
    """Write a page and say where it is and what was noted; return the exit status."""
    write_whole(options.output, html)
    for note in made.notes:
        print(f"axcomp report: {note}", file=sys.stderr)
    if options.format == "json":
        print(json.dumps({"output": str(options.output), **made.to_dict()}, indent=2, ensure_ascii=False))
    else:
        print(options.output)
    return min(len(made.notes), STATUS_MAX)
