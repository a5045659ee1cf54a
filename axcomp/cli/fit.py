"""``axcomp fit``: friction parameters from a circular test, tuned on the plant until the quadrant peaks are least."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..fit import CannotCreateError, TargetList, TunedAxis, plant_description, tune_on_circle
from ..lists import Reading, Severity, read_machine
from ..measurement import MeasurementError, evaluate_circular, joined_tests, read_circular
from ..model import machine_path
from ..saving import write_all

SETTLED = ("scaling_factor", "position_delay", "reversal_lookahead", "delay_cycles")
"""Entries that are tuned."""

_EPILOG = """\
The plant is plant.json beside the lists, or --plant: drives with their control, and friction to begin with. Its
friction is changed until it shows the measured peaks; then the list's parameters are moved until the plant shows least
of them. The table stays: axcomp create friction makes it.

examples:
  axcomp fit ccw.csv cw.csv --machine models/three_axis
  axcomp fit circle.csv --machine lists --plant plant.json --acting --write
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "fit",
        description="Tunes the parameters of friction compensations on the plant until the quadrant peaks of a "
        "circular test are least, and predicts what is left of them.",
        epilog=_EPILOG,
    )
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="circular tests, as for measure")
    parser.add_argument("--machine", type=machine_path, required=True, metavar="PATH", help="the controller's lists")
    parser.add_argument("--plant", type=Path, metavar="FILE", help="default: plant.json beside the lists")
    parser.add_argument("--acting", action="store_true", help="the friction compensations acted during the test")
    parser.add_argument("--radius", type=float, metavar="mm", help="nominal radius, where the file does not say it")
    parser.add_argument("--feed", type=float, metavar="mm/min", help="where the file does not say it")
    parser.add_argument("--write", action="store_true", help="put the parameters into the lists")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    parser.set_defaults(do=_do_fit)


def _do_fit(args: argparse.Namespace) -> int:
    try:
        reading = read_machine(args.machine)
        for finding in reading.findings:
            if finding.severity is Severity.ERROR:
                print(finding, file=sys.stderr)
        test = joined_tests([read_circular(path, args.radius, args.feed) for path in args.files])
        folder = args.machine if args.machine.is_dir() else args.machine.parent
        description = plant_description(args.plant or folder / "plant.json")
        frictions = {axis.name: axis.friction for axis in reading.machine.axes if axis.friction is not None}
        tuned = tune_on_circle(evaluate_circular(test), description, frictions, args.acting)
        written = _write(reading, tuned) if args.write else []
    except MeasurementError as error:
        print(error, file=sys.stderr)
        return 1
    except (CannotCreateError, ValueError) as error:
        print(f"axcomp fit: {error}", file=sys.stderr)
        return 1
    if args.format == "json":
        print(json.dumps([_to_dict(one) for one in tuned], indent=2, ensure_ascii=False))
    else:
        _print(tuned, written)
    return 0


def _write(reading: Reading, tuned: Sequence[TunedAxis]) -> list[Path]:
    """Put the parameters into the compensation lists, all or none; return these."""
    files = {}
    for one in tuned:
        axis = reading.machine.axis(one.axis)
        document = reading.compensation_list(axis.number)
        if document is None:
            raise CannotCreateError(f"there is no compensation list of {one.axis}")
        data = TargetList(document.path).with_compensation("friction", one.tuned.friction, settled=SETTLED)
        files[Path(document.path)] = data
    write_all(files)
    return list(files)


def _to_dict(one: TunedAxis) -> dict[str, Any]:
    friction = one.tuned.friction
    return {
        "axis": one.axis,
        "measured": one.measured._asdict(),
        "modelled": one.modelled._asdict(),
        "unexplained_rms": one.left,
        "presliding": one.presliding,
        "level": one.level,
        "asymmetry": one.asymmetry,
        "play": one.play,
        "predicted": {
            "without": one.tuned.without._asdict(),
            "as_listed": one.tuned.before._asdict(),
            "tuned": one.tuned.left._asdict(),
        },
        "parameters": {
            "scaling": friction.scaling,
            "position_delay": friction.position_delay,
            "reversal_lookahead": friction.reversal_lookahead,
            "delay_cycles": friction.delay_cycles,
        },
    }


def _print(tuned: Sequence[TunedAxis], written: Sequence[Path]) -> None:
    from ..plot import console, figure, table

    out, rows = console(), []
    for one in tuned:
        states = {"measured": one.measured, "the plant shows": one.modelled, "predicted without": one.tuned.without}
        states |= {"predicted as listed": one.tuned.before, "predicted as tuned": one.tuned.left}
        rows += [[one.axis, name, figure(peaks.positive), figure(peaks.negative)] for name, peaks in states.items()]
    out.print(table("Quadrant peaks in µm, outward positive", ["", "", "positive end", "negative end"], rows))
    for one in tuned:
        friction = one.tuned.friction
        out.print(
            f"{one.axis}: pre-sliding {1e3 * one.presliding:.1f} µm, friction {one.level:.2f} times that of the plant "
            f"({100.0 * one.asymmetry:+.0f} % in the positive direction), play {one.play:.1f} µm; "
            f"{one.left:.2f} µm (rms) of the measured error around the reversals is not explained."
        )
        out.print(
            f"{one.axis}: frict_comp.scaling_factor {1e3 * friction.scaling:.0f}, position_delay "
            f"{1e4 * friction.position_delay:.0f}, reversal_lookahead {friction.reversal_lookahead}, delay_cycles "
            f"{friction.delay_cycles}; no parameters are known that leave less than {one.tuned.left.largest:.2f} µm."
        )
    out.print(f"Written to {' and '.join(map(str, written))}." if written else "Nothing was written; --write does.")
