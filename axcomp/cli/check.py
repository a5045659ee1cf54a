"""``axcomp check``: what is wrong with the lists of a machine, and whether their tables are right."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict, replace
from typing import Any

from ..analysis.judgement import Judgement
from ..lists import Reading, Severity, read_machine
from ..model import machine_path
from .judgement_options import add_judgement_options, evidence_of
from .reading_options import add_reading_options

STATUS_MAX = 100
"""Largest exit status: larger ones are not the program's to use."""

_EXAMPLE = """\
Tables that can be read are judged too: outliers, seams of round axes, volumetric corrections against s_limit; by a
measurement taken without the compensation the sign, by a feed what a table asks of the drives, by an input file whether
the tables hold all positions in use. These findings are warnings and infos: they do not change the exit status.

example:
  axcomp check models/three_axis
  axcomp check models/three_axis --measurement x.rtl --axis X
  axcomp check models/three_axis --feed 30000 --feed Z=10000 --max-acceleration 5m/s2
  axcomp check models/three_axis --input models/three_axis/input.csv --format json
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "check",
        description="Read the lists of a machine and print what was found, one finding a line: "
        "file:line: severity code: sentence. The exit status is the number of errors, at most 100.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "path",
        type=machine_path,
        metavar="PATH",
        help="a hochlauf.lis, a folder with one or with achskw*.lis, or a single achskw*.lis",
    )
    parser.add_argument("--format", choices=("text", "json"), default="text", help="what to print (default: text)")
    add_judgement_options(parser)
    add_reading_options(parser)
    parser.set_defaults(do=_do_check)


def _do_check(options: argparse.Namespace) -> int:
    reading = read_machine(options.path, axis_type=options.axis_type, allow_outside=options.allow_outside)
    evidence = evidence_of(options, reading.machine)
    judgement = evidence.judge(reading)
    reading = replace(reading, findings=(*reading.findings, *judgement.findings))
    counts = {severity: sum(f.severity is severity for f in reading.findings) for severity in Severity}
    if options.format == "json":
        print(json.dumps(_as_json(reading, counts, judgement), indent=2, ensure_ascii=False))
    else:
        for finding in reading.findings:
            print(finding)
        print(_summary(reading, counts))
    for fault in evidence.faults:
        print(f"axcomp check: {fault}", file=sys.stderr)
    return min(counts[Severity.ERROR] + len(evidence.faults), STATUS_MAX)


def _summary(reading: Reading, counts: dict[Severity, int]) -> str:
    axes = reading.machine.axes
    compensations = sum(len(axis.compensations) for axis in axes)
    found = ", ".join(_counted(count, severity.value) for severity, count in counts.items())
    volumetric = _counted(len(reading.machine.volumetric), "volumetric compensation")
    of_axes = f"{_counted(len(axes), 'axis')} with {_counted(compensations, 'compensation')}"
    return f"{found}; {of_axes}{f' and {volumetric}' if reading.machine.volumetric else ''}."


def _counted(count: int, noun: str) -> str:
    plural = {"axis": "axes", "info": "infos"}.get(noun, f"{noun}s")
    return f"{count} {noun if count == 1 else plural}"


def _as_json(reading: Reading, counts: dict[Severity, int], judgement: Judgement) -> dict[str, Any]:
    return {
        "findings": [asdict(finding) | {"severity": finding.severity.value} for finding in reading.findings],
        "counts": {severity.value: count for severity, count in counts.items()},
        "axes": [
            {
                "number": axis.number,
                "name": axis.name,
                "type": axis.type.name.lower(),
                "compensations": [one.kind for one in axis.compensations],
            }
            for axis in reading.machine.axes
        ],
        "volumetric": [
            {"index": one.index, "chain": one.chain, "axes": dict(one.axes), "errors": len(one.errors)}
            for one in reading.machine.volumetric
        ],
        "judgement": judgement.to_dict(),
    }
