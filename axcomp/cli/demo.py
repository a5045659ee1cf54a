"""``axcomp demo``: both FMUs coupled, the errors of the machine without and with compensation."""

from __future__ import annotations

import argparse
import shutil
import sys
import textwrap
from pathlib import Path

from ..model import CYCLE_TIME, machine_path, models
from .progress import progress

PICTURE = "demo.png"

NOTE = """\
Largest errors: true position of the tool against the raw setpoint, without and with this one compensation (all: every
one), the others on. Geometric errors at standstill, crosstalk while the other axis changes speed, friction as peaks at
the reversals of a circle. TCP: the tool tip as the workpiece sees it, with and without all volumetric compensations,
at standstill. The FMUs step side by side: a delay of one communication step between them is inherent.
No table removes: thermal growth, lag and ringing of the structure, compliance between the tests; of friction
the peak that its table leaves with the best position_delay, reversal_lookahead, delay_cycles and scaling_factor."""

MEMORY = "Plant that remembers: friction with pre-sliding, different per direction; a structure that swings; growth"

NEXT = """
Next: axcomp show models/three_axis --output tables.html
      axcomp check PATH/TO/YOUR/LISTS"""

EXAMPLE = """\
PATH needs a plant.json beside the lists: drives, friction and geometric errors of the machine.

examples:
  axcomp demo
  axcomp demo --machine models/five_axis --output demo
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "demo",
        description="Build axcomp.fmu and plant.fmu, couple them in FMPy, and compare the errors of the machine "
        "without and with compensation, in a table and a picture.",
        epilog=EXAMPLE,
    )
    parser.add_argument(
        "--machine",
        type=machine_path,
        metavar="PATH",
        help="hochlauf.lis or its folder, with a plant.json beside it, or the name of an example: five_axis",
    )
    parser.add_argument(
        "--output", type=Path, default=Path(), metavar="DIR", help=f"for the FMUs and {PICTURE} (default: here)"
    )
    parser.add_argument(
        "--seed", type=int, metavar="N", help="draws the parameters of the plant (default: plant.json's)"
    )
    parser.set_defaults(do=_do_demo)


def _do_demo(args: argparse.Namespace) -> int:
    from ..demo import BuildError, DemoError, demonstrate, draw, table

    try:
        with progress("cycles") as show:
            machine, results, note, remembering = demonstrate(
                args.machine or models() / "three_axis", args.output, args.seed, show
            )
        draw(args.output / PICTURE, machine, remembering or results, CYCLE_TIME)
    except (BuildError, DemoError) as error:
        print(f"axcomp demo: {error}", file=sys.stderr)
        return 1
    if note:
        print(f"axcomp demo: {note}", file=sys.stderr)
    if remembering:
        print("Plant without memory\n")
    print(table(results))
    if remembering:
        print(f"\n{MEMORY}\n")
        print(table(remembering, remembering=True))
    width = shutil.get_terminal_size((120, 25)).columns
    print(f"\n{textwrap.fill(NOTE, width)}\n\n{args.output / PICTURE}\n{NEXT}")
    return 0
