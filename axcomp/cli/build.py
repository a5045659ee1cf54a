"""``axcomp build``: the FMU of a machine from its lists."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from ..analysis.diagnosis import write_named_diagnoses
from ..fmu import NAME, BuildError, Built, NoCompilerError, package_axcomp, package_native, write_image
from ..lists import Severity
from ..model import CYCLE_TIME, machine_path, models
from ..native import PLATFORMS
from ..plant import package_plant
from .axis_type import add_axis_type
from .lists import STATUS_MAX

EXAMPLE = """\
Without --machine and --output, axcomp.fmu and plant.fmu of the example machine are built in the current folder.
What there is to say about the lists is printed; what is wrong in them does not act, but stops nothing.

The native FMU holds a library for each platform and its C sources; it needs nothing, and no compiler is needed to
build it. That of --runtime python needs Python in the host.

--image writes the tables of the lists, which a running native FMU takes by its input reload; the exit status is then
the number of errors in the lists, at most 100: such an image is written, and reload refuses it.

A diagnosis file that a volumetric list names is written too, as axcomp diagnose does.

examples:
  axcomp build
  axcomp build --machine lists/hochlauf.lis --output machine.fmu --cycle-time 0.002
  axcomp build --platforms linux64,win64
  axcomp build --runtime python
  axcomp build --machine lists/hochlauf.lis --image new.bin
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "build",
        description="Build an FMI 2.0 co-simulation FMU that corrects setpoints as the controller's lists say.",
        epilog=EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--machine", type=machine_path, metavar="PATH", help="hochlauf.lis, a folder with one, or a single achskw*.lis"
    )
    outputs = parser.add_mutually_exclusive_group()
    outputs.add_argument("--output", type=Path, metavar="FILE", help="default: NAME.fmu in the current folder")
    outputs.add_argument("--image", type=Path, metavar="FILE", help="write an image of the tables, and no FMU")
    parser.add_argument(
        "--runtime", choices=("native", "python"), default="native", help="what runs in the FMU (default: native)"
    )
    parser.add_argument(
        "--platforms",
        type=_platforms,
        default=(),
        metavar="NAMES",
        help=f"of the native FMU: {','.join(PLATFORMS)} or some of them (default: all)",
    )
    parser.add_argument(
        "--name",
        default=NAME,
        metavar="NAME",
        help="name and identifier of the model, so that several can be linked into one program (default: %(default)s)",
    )
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
        "--types",
        choices=("own", "real"),
        default="own",
        help="real: Real instead of Boolean and Integer, for importers that take everything as Real",
    )
    parser.add_argument(
        "--no-lists",
        action="store_true",
        help="put no list into the FMU, only the tables compiled from them (native FMU only)",
    )
    parser.add_argument(
        "--no-external-tool",
        action="store_true",
        help="do not say in a Python FMU that it needs Python: some hosts refuse what needs something",
    )
    add_axis_type(parser)
    parser.set_defaults(do=_do_build)


def _platforms(text: str) -> tuple[str, ...]:
    names = tuple(dict.fromkeys(name.strip() for name in text.split(",")))
    for name in names:
        if name not in PLATFORMS:
            raise argparse.ArgumentTypeError(f"there is no platform {name!r}; there are {', '.join(PLATFORMS)}")
    return names


def _do_build(args: argparse.Namespace) -> int:
    example = models() / "three_axis"
    if args.machine is None:
        if args.output is not None or args.image is not None:
            print("axcomp build: --machine is missing: whose lists are to be in it?", file=sys.stderr)
            return 2
        print("axcomp build: no --machine: the example machine models/three_axis and its plant", file=sys.stderr)
    try:
        built = _build(args, args.machine or example)
        for finding in built.findings:
            print(finding, file=sys.stderr)
        if built.note:
            print(f"note: {built.note}", file=sys.stderr)
        for line in _summary(built):
            print(line)
        for said in write_named_diagnoses(built.reading):
            if isinstance(said, Path):
                print(said)
            else:
                print(f"note: {said}", file=sys.stderr)
        if args.machine is None and args.output is None and args.image is None:
            print(package_plant(example, Path.cwd(), external_tool=not args.no_external_tool).name)
    except NoCompilerError as error:
        print(f"axcomp build: {error}\n--runtime python needs no compiler.", file=sys.stderr)
        return 1
    except BuildError as error:
        print(f"axcomp build: {error}", file=sys.stderr)
        return 1
    if args.image is None:
        return 0
    return min(sum(finding.severity is Severity.ERROR for finding in built.findings), STATUS_MAX)


def _build(args: argparse.Namespace, lists: Path) -> Built:
    if args.image is not None:
        return write_image(lists, args.image, cycle_time=args.cycle_time, axis_type=args.axis_type)
    output = args.output or Path.cwd()
    if args.runtime == "native":
        return package_native(
            lists,
            output,
            cycle_time=args.cycle_time,
            naming=args.naming,
            platforms=args.platforms,
            axis_type=args.axis_type,
            name=args.name,
            types=args.types,
            with_lists=not args.no_lists,
        )
    if args.platforms:
        raise BuildError("--platforms is for the native FMU: pythonfmu brings libraries of its own.")
    if args.no_lists:
        raise BuildError("--no-lists is for the native FMU: the one that runs in Python reads the lists.")
    return package_axcomp(
        lists,
        output,
        cycle_time=args.cycle_time,
        naming=args.naming,
        external_tool=not args.no_external_tool,
        axis_type=args.axis_type,
        name=args.name,
        types=args.types,
    )


def _summary(built: Built) -> Iterator[str]:
    """Say what the file holds, axis by axis."""
    count = {causality: sum(v.causality == causality for v in built.variables) for causality in ("input", "output")}
    yield f"{built.path.name}: {count['input']} inputs, {count['output']} outputs"
    volumetric = built.machine.volumetric
    for axis in built.machine.axes:
        kinds = [one.kind for one in axis.compensations]
        kinds += [f"volumetric[{one.index}]" for one in volumetric if axis.number in dict(one.axes).values()]
        yield f"  {axis.name}: {', '.join(kinds) or 'no compensation'}"
