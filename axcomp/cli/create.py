"""``axcomp create``: compensation tables from measurements, put into lists."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from ..fit.create_crosstalk import create_crosstalk, read_acceleration_tests
from ..fit.create_curves import create_cross, create_leadscrew
from ..fit.create_friction import create_friction, read_friction_readings
from ..fit.create_plane import create_plane, read_flatness
from ..fit.creation import Creation, Options
from ..fit.target_list import TargetList
from ..measurement.positioning import joined, read_positioning
from . import create_volumetric
from .creating import carry_out


class _Kind(NamedTuple):
    """How a kind of table is made: reader and maker, columns of the measurement, an example, further options."""

    read: Callable[[Path], Any]
    create: Callable[[Any, TargetList, Options], Creation]
    meaning: str
    columns: str
    example: str
    options: tuple[str, ...] = ()


_KINDS = {
    "leadscrew": _Kind(
        read_positioning,
        create_leadscrew,
        "leadscrew table from a positioning measurement",
        "Renishaw .rtl, or columns target, run, direction, deviation (mm, µm)",
        "axcomp create leadscrew --from x.rtl --into achskw1.lis --bound 0.5",
        ("on_top", "one_sided"),
    ),
    "cross": _Kind(
        partial(read_positioning, of_another_axis=True),
        create_cross,
        "cross (sag) table from the deviation of a slave over a master",
        "columns target (of the master), run, direction, deviation (of the slave; mm, µm)",
        "axcomp create cross --from sag.csv --into achskw3.lis --master 1",
        ("on_top", "master"),
    ),
    "plane": _Kind(
        read_flatness,
        create_plane,
        "plane table from the deviation of a slave over two masters",
        "columns master1, master2, deviation (mm, µm), and run where there are several",
        "axcomp create plane --from table.csv --into achskw3.lis --masters 1 2 --bound 1",
        ("on_top", "masters"),
    ),
    "friction": _Kind(
        read_friction_readings,
        create_friction,
        "friction table from motor currents at constant velocities",
        "columns velocity (mm/s), current, and run where there are several",
        "axcomp create friction --from currents.csv --into achskw1.lis --bound 20",
    ),
    "crosstalk": _Kind(
        read_acceleration_tests,
        create_crosstalk,
        "crosstalk table from acceleration tests",
        "columns acceleration (mm/s²), direction, deviation (of the slave; µm), and where they vary position1, "
        "position2 (mm), run",
        "axcomp create crosstalk --from tests.csv --into achskw2.lis --master 1 --adaptation 1 3",
        ("master", "adaptation"),
    ),
}

_OPTIONS: dict[str, dict[str, Any]] = {
    "on_top": {"action": "store_true", "help": "the compensation acted during the measurement: add to its table"},
    "one_sided": {"action": "store_true", "help": "one curve for both directions, their mean"},
    "master": {"type": int, "metavar": "N", "help": "logical number of the master (default: as the list says)"},
    "masters": {
        "type": int,
        "nargs": 2,
        "metavar": "N",
        "help": "logical numbers of the masters (default: as the list says)",
    },
    "adaptation": {
        "type": int,
        "nargs": "+",
        "metavar": "N",
        "help": "logical numbers of the axes of position1 and position2 (default: as the list says)",
    },
}


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "create",
        description="Makes a compensation table from measurements and puts it into a list; the rest of the list stays.",
        epilog="example:\n  axcomp create leadscrew --from x.rtl --into achskw1.lis --bound 0.5",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True)
    for name, kind in _KINDS.items():
        _add_kind(kinds, name, kind)
    create_volumetric.add_kind(kinds)


def _add_kind(kinds: argparse._SubParsersAction[argparse.ArgumentParser], name: str, kind: _Kind) -> None:
    parser = kinds.add_parser(
        name,
        help=kind.meaning,
        description=f"Makes a {kind.meaning}. A measurement has {kind.columns}; other units stand in the first row: "
        "deviation [mm].",
        epilog=f"example:\n  {kind.example}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--from", dest="files", nargs="+", type=Path, required=True, metavar="MEASUREMENT", help="files, as one"
    )
    parser.add_argument("--into", type=Path, required=True, metavar="LIST", help="list; made if it is not there")
    parser.add_argument("--output", type=Path, metavar="FILE", help="write there instead")
    parser.add_argument("--dry-run", action="store_true", help="write nothing")
    unit = "drive unit" if name == "friction" else "µm"
    within = "thin, but stay within this of the measured means" + (" (rotary axes: ″)" if unit == "µm" else "")
    parser.add_argument("--bound", type=float, metavar=unit, help=within)
    if name != "crosstalk":
        parser.add_argument("--max-points", type=int, metavar="N", help="let the list reserve so many entries")
    parser.add_argument("--axis", type=int, metavar="N", help="logical axis number of a new list")
    parser.add_argument("--name", default="", help="name of the axis in a new list")
    for option in kind.options:
        parser.add_argument(f"--{option.replace('_', '-')}", **_OPTIONS[option])
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw measurement, table and what is left")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    parser.set_defaults(do=_do_create, kind=kind)


def _do_create(args: argparse.Namespace) -> int:
    kind: _Kind = args.kind

    def make() -> Creation:
        measurement = joined([kind.read(path) for path in args.files])
        return kind.create(measurement, TargetList(args.into, args.axis, args.name), _options(args))

    return carry_out(args, make, _print)


def _options(args: argparse.Namespace) -> Options:
    given = vars(args)
    if given.get("max_points") is not None and args.max_points < 2:
        raise ValueError("a table has two entries at least")
    masters = tuple(given.get("masters") or (given.get("master") or 0, 0))
    adaptation = (*(given.get("adaptation") or ()), 0, 0)[:2]
    return Options(
        bound=args.bound,
        max_points=given.get("max_points"),
        on_top=given.get("on_top", False),
        one_sided=given.get("one_sided", False),
        masters=(masters[0], masters[1]),
        adaptation=(adaptation[0], adaptation[1]),
    )


def _print(creation: Creation, written: Path | None) -> None:
    from ..plot.terminal import compared, console

    out = console()
    out.print(compared(f"{creation.kind} into {creation.path}", creation.figures, creation.labels, creation.unit))
    within = f"within {creation.deviation:.2f} {creation.unit} of the measured means"
    out.print(f"{creation.points} of {creation.capacity} points; the table is {within}.")
    for note in creation.notes:
        out.print(f"Note: {note}")
    out.print("Nothing was written." if written is None else f"Written to {written}.")
