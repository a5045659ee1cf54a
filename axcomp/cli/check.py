"""``axcomp check``: what is wrong with the lists of a machine."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from typing import Any

from ..lists import Reading, Severity, read_machine

STATUS_MAX = 100
"""Largest exit status: larger ones are not the program's to use."""

_EXAMPLE = """\
example:
  axcomp check models/three_axis
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "check",
        help="check the lists of a machine",
        description="Read the lists of a machine and print what was found, one finding a line: "
        "file:line: severity code: sentence. The exit status is the number of errors, at most 100.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "path", metavar="PATH", help="a hochlauf.lis, a folder with one or with achskw*.lis, or a single achskw*.lis"
    )
    parser.add_argument("--format", choices=("text", "json"), default="text", help="what to print (default: text)")
    parser.set_defaults(do=_do_check)


def _do_check(options: argparse.Namespace) -> int:
    reading = read_machine(options.path)
    counts = {severity: sum(f.severity is severity for f in reading.findings) for severity in Severity}
    if options.format == "json":
        print(json.dumps(_as_json(reading, counts), indent=2, ensure_ascii=False))
    else:
        for finding in reading.findings:
            print(finding)
        print(_summary(reading, counts))
    return min(counts[Severity.ERROR], STATUS_MAX)


def _summary(reading: Reading, counts: dict[Severity, int]) -> str:
    axes = reading.machine.axes
    compensations = sum(1 for axis in axes for _ in axis.compensations())
    found = ", ".join(_counted(count, severity.value) for severity, count in counts.items())
    return f"{found}; {_counted(len(axes), 'axis')} with {_counted(compensations, 'compensation')}."


def _counted(count: int, noun: str) -> str:
    plural = {"axis": "axes", "info": "infos"}.get(noun, f"{noun}s")
    return f"{count} {noun if count == 1 else plural}"


def _as_json(reading: Reading, counts: dict[Severity, int]) -> dict[str, Any]:
    return {
        "findings": [asdict(finding) | {"severity": finding.severity.value} for finding in reading.findings],
        "counts": {severity.value: count for severity, count in counts.items()},
        "axes": [
            {
                "number": axis.number,
                "name": axis.name,
                "type": axis.type.name.lower(),
                "compensations": [kind for kind, _ in axis.compensations()],
            }
            for axis in reading.machine.axes
        ],
    }
