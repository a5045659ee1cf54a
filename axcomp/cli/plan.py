"""``axcomp plan``: what to measure next, and how well the tool tip will be known then."""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

from ..fit import TcpDeviations, fit_of, plan_volumetric, rows_of
from ..measurement import MeasurementError, joined
from ..model import LETTERS, symbol
from ..saving import write_whole

_RANGE = re.compile(r"([XYZABC])=(-?[\d.]+)\.\.(-?[\d.]+)\Z", re.I)
_KINDS = ("deviation", "point", "length", "displacement")
_EPILOG = """\
The list says the kinematics. Of readings at random places those are taken that together tell most about the errors
(D-optimal), on top of what was measured already (--from). The table that is written has the columns that
axcomp create volumetric reads, but for the readings.

example:
  axcomp plan volumetric vol_comp0.lis --volume X=0..600 Y=0..500 Z=-400..0 --kind displacement \\
    --station -200 -200 -700 --station 900 -300 -600 --station 300 900 -650 --count 200 --output plan.csv
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "plan",
        description="Proposes what to measure next.",
        epilog="example:\n  axcomp plan volumetric vol_comp0.lis --volume X=0..600 Y=0..500 Z=-400..0",
    )
    kinds = parser.add_subparsers(metavar="KIND", required=True)
    one = kinds.add_parser(
        "volumetric",
        help="readings of the tool tip",
        description="Proposes the readings of the tool tip that tell most about the errors of a machine.",
        epilog=_EPILOG,
    )
    one.add_argument("list", type=Path, metavar="LIST", help="vol_comp*.lis; or the options of a new one")
    one.add_argument("--volume", nargs="+", required=True, metavar="X=0..600", help="where each axis may go, mm or °")
    one.add_argument("--count", type=int, default=100, metavar="N", help="readings to propose (default: 100)")
    one.add_argument(
        "--kind",
        choices=_KINDS,
        default=_KINDS[0],
        metavar="NAME",
        help=f"what is read: {', '.join(_KINDS)} (default: {_KINDS[0]})",
    )
    one.add_argument(
        "--station",
        nargs=3,
        type=float,
        action="append",
        default=[],
        metavar="mm",
        help="where one is, about; repeatable",
    )
    one.add_argument("--tool-lengths", nargs="+", type=float, default=[0.0], metavar="mm", help="default: 0")
    one.add_argument("--from", dest="files", nargs="+", type=Path, default=[], metavar="FILE", help="measured already")
    one.add_argument("--output", type=Path, metavar="FILE.csv", help="where the places go")
    one.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    for option, how in fit_of("volumetric").arguments.items():
        one.add_argument(f"--{option}", **how)
    one.set_defaults(do=_do_plan)


def _do_plan(args: argparse.Namespace) -> int:
    try:
        target = fit_of("volumetric").open(args.list, vars(args))
        measured = joined([TcpDeviations.read(path) for path in args.files]) if args.files else None
        plan = plan_volumetric(
            target.volumetric,
            _volume(args.volume),
            args.count,
            args.kind,
            stations=args.station,
            tool_lengths=args.tool_lengths,
            errors=args.errors,
            scatter=1.0 if args.scatter is None else args.scatter,
            measured=measured,
            **({} if args.nodes is None else {"nodes": args.nodes}),
        )
    except (MeasurementError, ValueError) as error:
        print(f"axcomp plan: {error}", file=sys.stderr)
        return 1
    names, rows = rows_of(plan, target.volumetric.chain, args.kind)
    text = ",".join(names) + "\n" + "".join(",".join(f"{value:g}" for value in row) + "\n" for row in rows)
    if args.output is not None:
        write_whole(args.output, text)
    states = {"so far": plan.before, "with these readings": plan.uncertainty, "with as many at random": plan.random}
    shown: dict[str, Any] = {
        name: {"median": float(np.median(one)), "largest": float(one.max())}
        for name, one in states.items()
        if not np.isnan(one).any()
    }
    if args.format == "json":
        places = [dict(zip(names, map(float, row), strict=True)) for row in rows]
        print(json.dumps({"tip_uncertainty": shown, "exchanged": plan.exchanged, "readings": places}, indent=2))
        return 0
    if args.output is None:
        print(text, end="")
    print(f"{len(rows)} readings; the tool tip will be known within (95 %, µm):")
    for name, figures in shown.items():
        print(f"  {name:<24} {figures['median']:8.2f} in the median, {figures['largest']:8.2f} at worst")
    return 0


def _volume(words: list[str]) -> dict[str, tuple[float, float]]:
    found = {}
    for word in words:
        match = _RANGE.match(word)
        try:
            letter, first, last = (match[1].upper(), float(match[2]), float(match[3])) if match else ("", 0.0, 0.0)
        except ValueError:
            letter, first, last = "", 0.0, 0.0
        if not letter or not first < last:
            unit = symbol("deg")
            raise ValueError(
                f"--volume: “{word}” is no range of an axis {', '.join(LETTERS)} in mm or {unit}: X=0..600"
            )
        found[letter] = (first, last)
    return found
