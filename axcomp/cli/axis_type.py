"""The option ``--axis-type``: what an axis is that has a compensation list but no axis list."""

from __future__ import annotations

import argparse
from typing import get_args

from ..lists import TypeName


def add_axis_type(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--axis-type",
        choices=get_args(TypeName),
        help="of the axes that have an achskw*.lis, where there is no axis list at all; modulo: rotary, 0 to 360 deg "
        "(default: translatory)",
    )
