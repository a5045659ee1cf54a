"""Options of the commands that read lists: ``--axis-type`` and ``--allow-outside``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import get_args

from ..lists import TypeName


def add_reading_options(parser: argparse.ArgumentParser) -> None:
    """Add both options."""
    add_axis_type(parser)
    add_allow_outside(parser)


def add_axis_type(parser: argparse.ArgumentParser) -> None:
    """Add the option that says what axes are of which no list says it."""
    parser.add_argument(
        "--axis-type",
        choices=get_args(TypeName),
        help="of the axes that have an achskw*.lis, where there is no axis list at all; modulo: rotary, 0 to 360 deg "
        "(default: translatory)",
    )


def add_allow_outside(parser: argparse.ArgumentParser) -> None:
    """Add the option that lets lists name files elsewhere."""
    parser.add_argument(
        "--allow-outside",
        type=Path,
        action="append",
        default=[],
        metavar="FOLDER",
        help="files that the lists name may lie in this folder too, not only in that of the start-up list (repeatable)",
    )
