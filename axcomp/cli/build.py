"""``axcomp build``: the FMU of a machine from its lists."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from ..compile import CYCLE_TIME
from ..fmu.archive import BuildError
from ..fmu.package import Built, package_axcomp, package_plant
from ..places import models

EXAMPLE = """\
Without --machine and --output, axcomp.fmu and plant.fmu of the example machine are built in the current folder.
What there is to say about the lists is printed; what is wrong in them does not act, but stops nothing.

examples:
  axcomp build
  axcomp build --machine lists/hochlauf.lis --output machine.fmu --cycle-time 0.002
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "build",
        help="build the FMU of a machine from its lists",
        description="Build an FMI 2.0 co-simulation FMU that corrects setpoints as the controller's lists say.",
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--machine", type=Path, metavar="PATH", help="hochlauf.lis, a folder with one, or a single achskw*.lis"
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="default: axcomp.fmu in the current folder")
    parser.add_argument(
        "--cycle-time",
        type=float,
        default=CYCLE_TIME,
        metavar="S",
        help="of the position controller in s (default: %(default)s)",
    )
    parser.add_argument(
        "--naming",
        choices=("structured", "flat"),
        default="structured",
        help="X.leadscrew.correction (default) or X_leadscrew_correction",
    )
    parser.add_argument(
        "--no-external-tool",
        action="store_true",
        help="do not say in the FMU that it needs Python: some hosts refuse what needs something",
    )
    parser.set_defaults(do=_do_build)


def _do_build(args: argparse.Namespace) -> int:
    external_tool = not args.no_external_tool
    example = models() / "three_axis"
    try:
        built = package_axcomp(
            args.machine or example,
            args.output or Path.cwd(),
            cycle_time=args.cycle_time,
            naming=args.naming,
            external_tool=external_tool,
        )
        for finding in built.findings:
            print(finding, file=sys.stderr)
        for line in _summary(built):
            print(line)
        if args.machine is None and args.output is None:
            print(package_plant(example, Path.cwd(), external_tool=external_tool).name)
    except BuildError as error:
        print(f"axcomp build: {error}", file=sys.stderr)
        return 1
    return 0


def _summary(built: Built) -> Iterator[str]:
    """Say what the FMU holds, axis by axis."""
    count = {causality: sum(v.causality == causality for v in built.variables) for causality in ("input", "output")}
    yield f"{built.path.name}: {count['input']} inputs, {count['output']} outputs"
    for axis in built.machine.axes:
        kinds = ", ".join(kind for kind, _ in axis.compensations()) or "no compensation"
        yield f"  {axis.name}: {kinds}"
