"""What the commands about a machine's lists do alike: their PATH, errors in the lists, and a sentence for a fault."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from ..lists import Reading, Severity, TypeName, read_machine
from ..model import machine_path
from .reading_options import add_allow_outside

STATUS_MAX = 100
"""Largest exit status that counts something: larger ones are not the program's to use."""


def add_lists_command(
    subparsers: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    description: str,
    epilog: str,
    do: Callable[[argparse.Namespace], int],
    path_help: str = "start-up list, folder, or one compensation list",
) -> argparse.ArgumentParser:
    """Add a sub-command with the lists of a machine as PATH, and return it for its options; ``do`` carries it out."""
    parser = subparsers.add_parser(name, description=description, epilog=epilog)
    parser.add_argument("path", type=machine_path, metavar="PATH", help=path_help)
    add_allow_outside(parser)
    parser.set_defaults(do=do)
    return parser


def read_lists(path: Path, allow_outside: Sequence[Path], axis_type: TypeName | None = None) -> Reading:
    """Return the lists of a machine; errors in them go to standard error."""
    reading = read_machine(path, axis_type=axis_type, allow_outside=allow_outside)
    for finding in reading.findings:
        if finding.severity is Severity.ERROR:
            print(finding, file=sys.stderr)
    return reading


def failed(command: str, sentence: str) -> int:
    """Say why a command cannot be carried out; return its exit status."""
    print(f"axcomp {command}: {sentence}", file=sys.stderr)
    return 1
