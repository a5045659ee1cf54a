"""``axcomp create volumetric``: the errors of a machine from deviations of the tool tip."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..fit.create_volumetric import VolumetricCreation, create_volumetric
from ..fit.volumetric_identification import NODES_MAX
from ..fit.volumetric_model import read_tcp_deviations
from ..fit.volumetric_target import VolumetricTarget
from ..measurement.positioning import joined
from ..model.volumetric import LETTERS, Volumetric
from .creating import carry_out

_EXAMPLE = """\
example:
  axcomp create volumetric --from tracker.csv --into vol_comp0.lis
  axcomp create volumetric --from tracker.csv --into vol_comp0.lis --chain YXZ --axes 1 2 3
"""


def add_kind(kinds: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the kind to ``axcomp create``."""
    parser = kinds.add_parser(
        "volumetric",
        help="errors of the machine from deviations of the tool tip",
        description="Finds the errors of a machine by least squares from deviations of the tool tip and puts them into "
        "the parameter file of a volumetric list. A measurement has columns x, y, z (mm), dx, dy, dz (actual − nominal "
        "on the workpiece, µm) and, where there are any, a, b, c (°), tool_length (mm), run. It is taken without any "
        "volumetric compensation.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--from", dest="files", nargs="+", type=Path, required=True, metavar="MEASUREMENT", help="files, as one"
    )
    parser.add_argument(
        "--into", type=Path, required=True, metavar="LIST", help="vol_comp*.lis; made if it is not there"
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="write the parameters there instead")
    parser.add_argument("--dry-run", action="store_true", help="write nothing")
    parser.add_argument("--errors", nargs="+", metavar="NAME", help="the errors to find (default: all of the chain)")
    parser.add_argument(
        "--nodes", type=int, default=NODES_MAX, metavar="N", help=f"values of an error at most (default: {NODES_MAX})"
    )
    parser.add_argument(
        "--scatter", type=float, metavar="µm", help="standard deviation of a reading, where it is known"
    )
    parser.add_argument("--chain", default="", help="of a new list: axes from the workpiece to the tool, e.g. YXZ")
    parser.add_argument("--axes", type=int, nargs="+", metavar="N", help="of a new list: logical numbers in that order")
    parser.add_argument("--workpiece-axes", type=int, default=0, metavar="N", help="of a new list: axes that carry it")
    for option, meaning in (
        ("position", "place of the tool tip at length 0, mm"),
        ("orientation", "unit vector to the tip"),
    ):
        parser.add_argument(
            f"--tool-{option}", type=float, nargs=3, default=(0.0,) * 3, metavar="N", help=f"of a new list: {meaning}"
        )
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw the deviations without and with the errors")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    parser.set_defaults(do=_do_create_volumetric)


def _do_create_volumetric(args: argparse.Namespace) -> int:
    def make() -> VolumetricCreation:
        measurement = joined([read_tcp_deviations(path) for path in args.files])
        if args.nodes < 2 or (args.scatter is not None and not args.scatter > 0.0):
            raise ValueError("an error has two nodes at least, and the scatter is above 0")
        target = VolumetricTarget(args.into, _new(args))
        return create_volumetric(measurement, target, args.errors, args.nodes, args.scatter)

    return carry_out(args, make, _print)


def _new(args: argparse.Namespace) -> Volumetric | None:
    """Return the kinematics for a new list, None if none are given."""
    if not args.chain and not args.axes:
        return None
    chain, numbers = args.chain.upper(), args.axes or []
    if not set("XYZ") <= set(chain) <= set(LETTERS) or len(set(chain)) < len(chain) or len(numbers) != len(chain):
        raise ValueError("--chain names X, Y, Z and some of A, B, C once each, --axes as many logical numbers")
    assigned = dict(zip(chain, numbers, strict=True))
    axes = tuple((letter, assigned[letter]) for letter in LETTERS if letter in assigned)
    position, orientation = (tuple(vector) for vector in (args.tool_position, args.tool_orientation))
    return Volumetric(0, axes, chain, args.workpiece_axes, tool_position=position, tool_orientation=orientation)


def _print(creation: VolumetricCreation, written: Path | None) -> None:
    from ..plot.terminal import compared, console, figure, table

    out = console()
    rows = []
    for error in creation.errors():
        largest = max(range(len(error["values"])), key=lambda i: abs(error["values"][i]))
        over = f"{error['over']}, {len(error['nodes'])} nodes" if error["over"] else ""
        value, uncertainty = error["values"][largest], max(error["uncertainty"])
        rows.append([error["name"], over, figure(value), figure(uncertainty) if uncertainty else "–", error["unit"]])
    out.print(table("Errors", ["", "over", "largest value", "largest U (k = 2)", "unit"], rows))
    out.print(compared(f"volumetric into {creation.path}", creation.figures, creation.labels, creation.unit))
    found = creation.identification
    out.print(
        f"{creation.points} records; readings scatter by {found.scatter:.2f} µm around the model, "
        f"{found.degrees_of_freedom} degrees of freedom."
    )
    if found.redundancies:
        out.print("\nWhat the measurement does not tell:")
    for redundancy in found.redundancies:
        out.print(f"  {redundancy}")
    out.print()
    for note in creation.notes:
        out.print(f"Note: {note}")
    if written is None:
        out.print("Nothing was written.")
    else:
        also = "" if creation.list_data is None or written != creation.path else f" and {creation.list_path}"
        out.print(f"Written to {written}{also}.")
