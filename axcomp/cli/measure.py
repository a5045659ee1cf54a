"""``axcomp measure``: positioning measurements evaluated by ISO 230-2."""

from __future__ import annotations

import argparse
import json
import math
import sys
from dataclasses import fields
from pathlib import Path

from ..measurement import (
    SYMBOLS,
    BeforeAfter,
    Conditions,
    Iso230Result,
    MeasurementError,
    Positioning,
    evaluate_robustly,
    is_circular,
    joined,
    of_axis,
    read_positionings,
)
from ..model import symbol
from . import circular
from .lists import STATUS_MAX

_EPILOG = """\
A table, as text or .xlsx, has the columns target, run, direction, deviation (mm and µm unless the first row says
otherwise: "deviation [mm]"), or actual for deviation, or one column a run ("1 +", "1 -"); a column axis may be there.

examples:
  axcomp measure x.rtl
  axcomp measure x.csv --plot x.png --device 0.5 --drift 0.8
  axcomp measure x_before.csv x_after.csv --compare --plot both.png
  axcomp measure ccw.csv cw.csv --together --plot circle.png
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "measure",
        description="Evaluates positioning measurements by ISO 230-2 (accuracy, repeatability, reversal) and circular "
        "tests by ISO 230-4 (columns angle or time and deviation, or x and y).",
        epilog=_EPILOG,
    )
    parser.add_argument(
        "files", nargs="+", type=Path, metavar="FILE", help="Renishaw .rtl, or a table as text or .xlsx"
    )
    parser.add_argument("--together", action="store_true", help="the files are runs of one measurement")
    parser.add_argument("--compare", action="store_true", help="the first file is before, the second after")
    parser.add_argument("--axis", metavar="NAME", default="", help="the one to evaluate of files with several")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw means, ±2s bands and readings")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    circular.add_options(parser)
    conditions = parser.add_argument_group("conditions of the test, for expanded uncertainties (k = 2); linear axes")
    for one in fields(Conditions):
        name, about = f"--{one.name.replace('_', '-')}", one.metadata
        conditions.add_argument(name, type=float, metavar=about["unit"], help=about["meaning"])
    parser.set_defaults(do=_do_measure)


def _do_measure(args: argparse.Namespace) -> int:
    if all(is_circular(path) for path in args.files):
        return circular.measure(args)
    measurements: list[Positioning] = []
    errors = 0
    for path in args.files:
        try:
            found = read_positionings(path)
            measurements += [of_axis(found, args.axis, str(path))] if args.axis else found
        except MeasurementError as error:
            print(error, file=sys.stderr)
            errors += 1
    results: list[Iso230Result] = []
    compared: BeforeAfter | None = None
    try:
        conditions = _conditions(args)
        if args.together and measurements:
            measurements = [joined(measurements)]
        results = [evaluate_robustly(measurement, conditions) for measurement in measurements]
        if args.compare and not errors:
            compared = _compared(results)
        if args.plot is not None and results:
            _plot(results, compared, args.plot)
    except OSError as error:
        # The evaluation stands, whatever became of its picture.
        print(f"axcomp measure: {error.filename}: {error.strerror}", file=sys.stderr)
        errors += 1
    except (MeasurementError, ValueError) as error:
        print(f"axcomp measure: {error}", file=sys.stderr)
        errors += 1
    if args.format == "json":
        shown = [result.to_dict() for result in results] + ([] if compared is None else [compared.to_dict()])
        print(json.dumps(shown, indent=2, ensure_ascii=False))
    else:
        for result in results:
            _print(result)
        if compared is not None:
            _print_differences(compared)
    return min(errors, STATUS_MAX)


def _conditions(args: argparse.Namespace) -> Conditions | None:
    """Return the conditions that were given, None if none was."""
    given = {one.name: getattr(args, one.name) for one in fields(Conditions) if getattr(args, one.name) is not None}
    return Conditions(**given) if given else None


def _compared(results: list[Iso230Result]) -> BeforeAfter:
    if len(results) != 2:
        raise ValueError(f"--compare takes two measurements, before and after, not {len(results)}")
    return BeforeAfter(*results)


def _plot(results: list[Iso230Result], compared: BeforeAfter | None, file: Path) -> None:
    from matplotlib.figure import Figure  # takes long to load

    from ..plot import save

    if compared is not None:
        save(compared.figure(), file)
        return
    drawing = Figure(figsize=(10.0, 5.6 * len(results)), dpi=120, layout="constrained")
    for number, result in enumerate(results, 1):
        ax = result.plot(drawing.add_subplot(len(results), 1, number))
        if len(results) > 1:
            ax.set_title(f"{Path(result.source).name}\n{ax.get_title()}", fontsize=12)
    save(drawing, file)


def _print(result: Iso230Result) -> None:
    from ..plot import console, figure, table

    out = console()
    frame = result.table()
    rows = [
        [
            f"{position:g}",
            *(figure(float(v), 0 if str(name).startswith("n") else 2) for name, v in zip(frame, row, strict=True)),
        ]
        for position, row in zip(result.positions, frame.to_numpy(), strict=True)
    ]
    header = [f"target [{symbol(result.position_unit)}]", *map(str, frame)]
    axis = f", axis {result.axis}" if result.axis else ""
    out.print(table(f"{result.source}{axis}: by target, in {result.unit}", header, rows))
    robust = result.robust
    figures = [
        [
            SYMBOLS[name],
            figure(value),
            figure(result.uncertainty.get(name, math.nan)),
            *([] if robust is None else [figure(getattr(robust, name))]),
        ]
        for name, value in result.parameters().items()
    ]
    beside = [] if robust is None else ["without outliers"]
    out.print(table("ISO 230-2:2014", ["", result.unit, "U (k = 2)", *beside], figures))
    for note in result.notes:
        out.print(f"Note: {note}")
    if result.notes:
        out.print()


def _print_differences(compared: BeforeAfter) -> None:
    from ..plot import console, figure, table

    rows = [[name, *map(figure, values), figure(left, 0)] for name, *values, left in compared.differences()]
    header = ["", "before", "after", "after − before", "left [%]"]
    out = console()
    out.print(table(f"Before and after, in {compared.before.unit}", header, rows))
    for note in compared.notes():
        out.print(f"Note: {note}")
