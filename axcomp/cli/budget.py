"""``axcomp budget``: what each compensation and each volumetric error contributes along a path."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from ..analysis.budget import (
    COVERAGE,
    PLACES,
    POINTS,
    TRIALS,
    Budget,
    TcpUncertainty,
    budget_of,
    largest,
    read_uncertainties,
    rms,
    tcp_uncertainty,
)
from ..engine import read_input
from ..model import CYCLE_TIME
from .lists import add_lists_command, failed, read_lists

ROWS = 15

_EPILOG = """\
The input has a column for each setpoint (X.setpoint, ...), and for other inputs of the FMU where they matter; with a
column time its rows may lie at any distance. Velocities that are not given follow from the setpoints.

Axis compensations: what they add to the setpoint. Volumetric errors: the correction of X, Y and Z that each of the 72
alone leads to. The last lines of a table compare their sum with the correction of all of them together, and with what
the engine puts out.

Uncertainties are a table of their own, in mm and rad unless the column unit says otherwise:

  parameter,standard_uncertainty,unit,correlation
  EXX,0.8,um,common        one offset of the whole table (what counts if nothing is said)
  EAX,2,urad,nodes         each interpolation point by itself
  X.leadscrew,0.5,um       tables of axis compensations too

examples:
  axcomp budget models/three_axis --input models/three_axis/input.csv
  axcomp budget models/five_axis --input models/five_axis/input.csv --uncertainty u.csv --plot budget.png
  axcomp budget models/five_axis --input path.csv --tool-length 120 --format json
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    description = "Show how many µm each compensation and each volumetric error contributes along a path."
    parser = add_lists_command(subparsers, "budget", description, _EPILOG, _do_budget)
    parser.add_argument("--input", type=Path, required=True, metavar="FILE", help="the path: inputs as CSV")
    parser.add_argument("--uncertainty", type=Path, metavar="FILE", help="how well errors are known, as CSV")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="waterfalls, and the uncertainty")
    parser.add_argument("--tool-length", type=float, metavar="mm", help="default: the column tool_length, else 0")
    parser.add_argument("--cycle-time", type=float, default=CYCLE_TIME, metavar="s", help="default: %(default)s")
    parser.add_argument("--points", type=int, default=POINTS, metavar="N", help="places of the path (%(default)s)")
    parser.add_argument("--trials", type=int, default=TRIALS, metavar="N", help="of Monte Carlo (%(default)s)")
    parser.add_argument("--places", type=int, default=PLACES, metavar="N", help="for uncertainties (%(default)s)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the random numbers (%(default)s)")
    parser.add_argument("--rows", type=int, default=ROWS, metavar="N", help="of a table (%(default)s); 0: all")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")


def _do_budget(args: argparse.Namespace) -> int:
    machine = read_lists(args.path, args.allow_outside).machine
    if args.points < 2 or args.cycle_time <= 0.0 or args.trials < 2 or args.places < 1 or args.seed < 0:
        sentence = "--points and --trials are at least 2, --places 1, --seed 0, and --cycle-time is above 0"
        return failed("budget", sentence)
    if not machine.axes:
        return failed("budget", f"{args.path}: there is no axis in these lists")
    uncertainty: TcpUncertainty | None = None
    try:
        uncertainties = read_uncertainties(args.uncertainty, machine) if args.uncertainty else ()
        path = read_input(args.input)
        budget = budget_of(machine, path, points=args.points, cycle_time=args.cycle_time, tool_length=args.tool_length)
        if uncertainties:
            options = {"trials": args.trials, "places": args.places, "seed": args.seed}
            uncertainty = tcp_uncertainty(budget, uncertainties, **options)
    except KeyError as error:
        return failed("budget", f"{args.input}: {error.args[0]}")
    except ValueError as error:
        return failed("budget", str(error))
    if args.plot is not None:
        from ..analysis.budget import budget_figure
        from ..plot import save

        save(budget_figure(budget, uncertainty), args.plot)
    if args.format == "json":
        figures = budget.to_dict() | ({} if uncertainty is None else {"uncertainty": uncertainty.to_dict()})
        print(json.dumps(figures, indent=2, ensure_ascii=False))
    else:
        _print(budget, uncertainty, args.rows)
    return 0


def _print(budget: Budget, uncertainty: TcpUncertainty | None, rows: int) -> None:
    from ..plot import console, figure, table

    def cells(*values: float) -> list[str]:
        return [figure(value, 3) for value in values]

    out = console()
    for axis, total in budget.totals.items():
        every = budget.of_axis(axis)
        if not every:
            continue
        worst, unit = budget.worst(axis), budget.units[axis]
        listed = every[: rows or len(every)]
        lines = [[c.source, *cells(c.max, c.rms, c.at(worst))] for c in listed]
        if len(every) > len(listed):
            rest = sum(c.at(worst) for c in every[len(listed) :])
            lines.append([f"{len(every) - len(listed)} others", "", "", *cells(rest)])
        lines.append(["all, by the engine", *cells(largest(total), rms(total), total[worst])])
        head = ["contribution", "largest", "rms", f"at {budget.time[worst]:.3f} s"]
        out.print(table(f"Axis {axis}: corrections in {unit}", head, lines))
        if axis in budget.joint:
            joint = f"{budget.gap_to_joint(axis):.2g} {unit}"
            out.print(f"Volumetric errors, sum of each alone − all together: at most {joint}")
        out.print(f"Sum of all contributions − engine: at most {budget.gap_to_engine(axis):.2g} {unit}\n")
    if budget.currents:
        lines = [[axis, *cells(largest(one), rms(one))] for axis, one in budget.currents.items()]
        out.print(table("Friction: currents in the drive's own unit", ["axis", "largest", "rms"], lines))
    if uncertainty is not None:
        lines = [[label, *cells(*values.max(axis=0))] for label, values in uncertainty.sources.items()]
        lines.sort(key=lambda line: -max(map(float, line[1:])))
        lines.append(["all, by linear propagation", *cells(*uncertainty.linear.max(axis=0))])
        lines.append([f"all, by {uncertainty.trials} trials", *cells(*uncertainty.standard.max(axis=0))])
        head = ["largest along the path", *uncertainty.axes]
        out.print(table("Tool tip: standard uncertainties in µm", head, lines))
        radius = f"{uncertainty.radius.max():.3f} µm"
        out.print(f"{COVERAGE:.0%} of all trials are within {radius} everywhere on the path.\n")
