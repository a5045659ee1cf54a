"""``axcomp build``: the FMU of a machine from its lists."""

from __future__ import annotations

import argparse
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..analysis.diagnosis import write_named_diagnoses
from ..fmu import NAME, BuildError, Built, NoCompilerError, Version, package_axcomp, package_native, write_image
from ..lists import Severity
from ..model import CYCLE_TIME, machine_path, models
from ..native import PLATFORMS
from ..plant import package_plant
from .lists import STATUS_MAX
from .reading_options import add_reading_options

VERSIONS: tuple[Version, ...] = ("2.0", "3.0")

EXAMPLE = """\
Without --machine and --output, axcomp.fmu and plant.fmu of the example machine are built in the current folder.
What there is to say about the lists is printed; what is wrong in them does not act, but stops nothing.

The native FMU holds a library for each platform and its C sources; it needs nothing, and no compiler is needed to
build it. That of --runtime python needs Python in the host.

With --fmi 3.0 a host that uses event mode gets outputs without the delay of a cycle, and can calibrate the tables,
which are parameters, while the machine runs.

--image writes the tables of the lists, which a running native FMU takes by its input reload; the exit status is then
the number of errors in the lists, at most 100: such an image is written, and reload refuses it.

Nothing that is there is replaced but what axcomp has written itself: an FMU, an image, a diagnosis file.

examples:
  axcomp build
  axcomp build --machine lists/hochlauf.lis --output machine.fmu --cycle-time 0.002
  axcomp build --platforms linux64,win64
  axcomp build --machine lists/hochlauf.lis --fmi 2.0 3.0
  axcomp build --runtime python
  axcomp build --ssp
  axcomp build --machine lists/hochlauf.lis --image new.bin
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "build",
        description="Build an FMI co-simulation FMU that corrects setpoints as the controller's lists say.",
        epilog=EXAMPLE,
    )
    parser.add_argument(
        "--machine", type=machine_path, metavar="PATH", help="hochlauf.lis, a folder with one, or a single achskw*.lis"
    )
    outputs = parser.add_mutually_exclusive_group()
    outputs.add_argument("--output", type=Path, metavar="FILE", help="default: NAME.fmu in the current folder")
    outputs.add_argument("--image", type=Path, metavar="FILE", help="write an image of the tables, and no FMU")
    outputs.add_argument(
        "--ssp",
        type=Path,
        nargs="?",
        const=Path("machine.ssp"),
        metavar="FILE",
        help="write compensation and plant as a system of SSP 1.0 (default: machine.ssp); the plant is plant.json "
        "beside the lists, input.csv there its commands",
    )
    parser.add_argument(
        "--runtime", choices=("native", "python"), default="native", help="what runs in the FMU (default: native)"
    )
    parser.add_argument(
        "--fmi",
        nargs="+",
        choices=VERSIONS,
        default=["2.0"],
        metavar="VERSION",
        help="2.0 (default), 3.0 (native FMU only), or both: that of FMI 3.0 then has _fmi3 behind its name",
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
    parser.add_argument("--verbose", action="store_true", help="name every file that is packed, and where it is from")
    parser.add_argument("--diagnosis", action="store_true", help="write the diagnosis files that the lists name, too")
    add_reading_options(parser)
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
        built, *others = _build(args, args.machine or example)
        for finding in built.findings:
            print(finding, file=sys.stderr)
        if built.note:
            print(f"note: {built.note}", file=sys.stderr)
        for line in _summary(built):
            print(line)
        if args.verbose:
            for line in _packed(built):
                print(line)
        for other in others:
            print(f"{other.path.name}: the same for FMI 3.0")
        for said in write_named_diagnoses(built.reading) if args.diagnosis else ():
            if isinstance(said, Path):
                print(said)
            else:
                print(f"note: {said}", file=sys.stderr)
        if args.machine is None and args.output is None and args.image is None and args.ssp is None:
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


def _build(args: argparse.Namespace, lists: Path) -> list[Built]:
    """Return what was built: an FMU for each version of FMI, or an image."""
    reading: dict[str, Any] = {
        "cycle_time": args.cycle_time,
        "axis_type": args.axis_type,
        "allow_outside": args.allow_outside,
    }
    if args.image is not None:
        return [write_image(lists, args.image, **reading)]
    if args.ssp is not None:
        from ..demo import write_ssp

        external_tool = not args.no_external_tool
        return [write_ssp(lists, args.ssp, platforms=args.platforms, external_tool=external_tool, **reading)]
    output = args.output or Path.cwd()
    reading |= {"naming": args.naming, "name": args.name, "types": args.types}
    if args.runtime == "native":
        versions = [version for version in VERSIONS if version in args.fmi]
        if output.is_dir():
            output /= f"{args.name}.fmu"
        return [
            package_native(
                lists,
                output.with_stem(f"{output.stem}_fmi3") if version != versions[0] else output,
                platforms=args.platforms,
                with_lists=not args.no_lists,
                fmi=version,
                **reading,
            )
            for version in versions
        ]
    if args.fmi != ["2.0"]:
        raise BuildError("--fmi 3.0 is for the native FMU: pythonfmu knows FMI 2.0 only.")
    if args.platforms:
        raise BuildError("--platforms is for the native FMU: pythonfmu brings libraries of its own.")
    if args.no_lists:
        raise BuildError("--no-lists is for the native FMU: the one that runs in Python reads the lists.")
    return [package_axcomp(lists, output, external_tool=not args.no_external_tool, **reading)]


def _packed(built: Built) -> Iterator[str]:
    """Name every file in an FMU, those of the lists with where they are from; of an image the lists it is made of."""
    sources = dict(zip(built.lists, built.reading.documents, strict=False))
    if zipfile.is_zipfile(built.path):
        with zipfile.ZipFile(built.path) as archive:
            for name in archive.namelist():
                source = sources.get(name.removeprefix("resources/"))
                yield f"packed: {name}" + (f" from {source}" if source else "")
    else:
        yield from (f"read: {source}" for source in sources.values())


def _summary(built: Built) -> Iterator[str]:
    """Say what the file holds, axis by axis."""
    count = {causality: sum(v.causality == causality for v in built.variables) for causality in ("input", "output")}
    yield f"{built.path.name}: {count['input']} inputs, {count['output']} outputs"
    volumetric = built.machine.volumetric
    for axis in built.machine.axes:
        kinds = [one.kind for one in axis.compensations]
        kinds += [f"volumetric[{one.index}]" for one in volumetric if axis.number in dict(one.axes).values()]
        yield f"  {axis.name}: {', '.join(kinds) or 'no compensation'}"
