"""``axcomp sweep``: many runs over varied lists, inputs and parameters."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from .lists import STATUS_MAX
from .progress import progress

if TYPE_CHECKING:
    from ..sweep import Sweep

ROWS_SHOWN = 12
ERRORS_SHOWN = 5
SUFFIXES = (".parquet", ".csv")

_EPILOG = """\
SPEC is a TOML file, or JSON with the same keys; paths count from where it lies:

  machine = "models/three_axis"           # lists, or an FMU; a list of several is varied too
  cycle_time = 0.001                      # s
  duration = 10.0                         # s; left out: as long as the input is

  [input]
  file = "input.csv"                      # columns as in the FMU, or a motion that is repeated until the end:
  # start = { X = 0, Y = 0 }
  # moves = [{ X = 100, Y = 50, velocity = 200 }, { dwell = 0.1 }, { X = 0 }]
  # sine = { Z = { centre = 0, amplitude = 10, frequency = 0.5, phase = 90 } }
  # velocity = 350                        # of moves, and acceleration, jerk

  [vary]                                  # every combination of these values
  "achskw1.lis: kw.crosscomp2.n_cycles" = [0, 10, 20]
  "scale achskw1.lis: kw.crosscomp2.table[][].correction" = [0.9, 1.0, 1.1]
  "scale Y.leadscrew" = { from = 0, to = 1, count = 5 }
  "input Z.cross.switch" = [1, -1]
  "scale input X.velocity" = [0.5, 1.0]
  "parameter cycle_time" = [0.001, 0.002]

  [[runs]]                                # and explicit ones: the whole grid with each of them
  "achsmd1.lis: lr_param.n_backlash_cyc" = 5

  [results]                               # max, min, peak, mean, rms, last, at SECONDS
  "largest correction" = "peak X.correction"
  "path error" = "rms X.corrected_setpoint - X.setpoint"
  "half way" = "at 5.0 Y.corrected_setpoint"

Rows have the order of SPEC, whatever ends first. Stopped and started again, a sweep goes on where it was: FILE.journal
holds what is done. A run that fails has its error in the row. Workers of a cluster need axcomp[sweep] too.

examples:
  axcomp sweep sweep.toml --output results.parquet
  axcomp sweep sweep.toml --output results.csv --scheduler tcp://10.0.0.5:8786
  axcomp sweep sweep.toml --output results.csv --plot result.png --x "scale Y.leadscrew" --y "path error"
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "sweep",
        description="Run a machine many times over varied lists, inputs and parameters. Exit status: failed runs.",
        epilog=_EPILOG,
    )
    parser.add_argument("spec", type=Path, metavar="SPEC", help="what is varied, and what is kept: TOML or JSON")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE", help="results.parquet or results.csv")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster; default: this machine")
    parser.add_argument("--workers", type=int, metavar="N", help="processes on this machine; default: one a processor")
    parser.add_argument("--retry", action="store_true", help="try again what has failed before")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="draw --y over --x")
    parser.add_argument("--x", metavar="COLUMN", help="for --plot")
    parser.add_argument("--y", metavar="COLUMN", help="for --plot")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="of what is printed; default: text")
    parser.set_defaults(do=_do_sweep)


def _do_sweep(args: argparse.Namespace) -> int:
    fault = _fault(args)
    if fault:
        print(f"axcomp sweep: {fault}", file=sys.stderr)
        return 1
    from ..sweep import ERROR, FINDINGS, RUN, job_of, read_spec, run_sweep

    spec = read_spec(args.spec)
    job, findings = job_of(spec)
    for finding in findings:
        print(finding, file=sys.stderr)
    with progress("runs") as show:
        try:
            sweep = run_sweep(
                spec, job, args.output, scheduler=args.scheduler, workers=args.workers, retry=args.retry, progress=show
            )
        except KeyboardInterrupt:
            print("axcomp sweep: stopped; the same command goes on from here", file=sys.stderr)
            raise
    if args.plot is not None:
        from ..plot import save

        save(sweep.plot(args.x, args.y).figure, args.plot)
    if args.format == "json":
        print(sweep.table.to_json(orient="records", indent=2, force_ascii=False, double_precision=15))
    else:
        _print(args.output, sweep)
    news = sweep.table[sweep.table[FINDINGS] != ""]
    for number, text in list(zip(news[RUN], news[FINDINGS], strict=True))[:ERRORS_SHOWN]:
        for finding in text.split("\n"):
            print(f"run {number}: {finding}", file=sys.stderr)
    failed = sweep.failed
    for number, error in list(zip(failed[RUN], failed[ERROR], strict=True))[:ERRORS_SHOWN]:
        print(f"axcomp sweep: run {number}: {error}", file=sys.stderr)
    if len(failed):
        print(f"axcomp sweep: {len(failed)} of {spec.count} runs failed", file=sys.stderr)
    return min(len(failed), STATUS_MAX)


def _fault(args: argparse.Namespace) -> str:
    """Return what is wrong with the command line."""
    if args.output.suffix.lower() not in SUFFIXES:
        return f"{args.output} must end in {' or '.join(SUFFIXES)}"
    if args.workers is not None and args.workers < 1:
        return "there must be at least one worker"
    if args.plot is not None and (args.x is None or args.y is None):
        return "--plot needs --x and --y"
    return ""


def _print(output: Path, sweep: Sweep) -> None:
    import pandas as pd

    from ..plot import terminal
    from ..sweep import ERROR, FINDINGS

    table = sweep.table
    # Texts have no room in a table.
    shown = table.drop(columns=[FINDINGS, ERROR]).head(ROWS_SHOWN)
    rows = [
        ["–" if pd.isna(v) else f"{v:.6g}" if isinstance(v, float) else str(v) for v in row]
        for row in shown.itertuples(index=False)
    ]
    before = f", {sweep.taken_over} of them from before" if sweep.taken_over else ""
    more = f" (the first {ROWS_SHOWN})" if len(table) > ROWS_SHOWN else ""
    terminal.console().print(
        terminal.table(
            f"{output}: {len(table)} runs{before}{more}", [sweep.labelled(str(name)) for name in shown], rows
        )
    )
