"""``axcomp replay``: a trace recorded on a controller against the engine."""

from __future__ import annotations

import argparse
import json
import sys
import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path

from ..analysis.replay import EXPLAINED, WITHIN, WITHIN_OTHER, Comparison, compare, read_trace
from ..lists import Severity, read_machine
from ..model import machine_path
from .reading_options import add_allow_outside

_EPILOG = f"""\
The trace has a row for each cycle (or a column time), names in its first row, and at least a setpoint and one output of
the engine: X.correction, X.corrected_setpoint, X.current, X.leadscrew.correction … Velocity and acceleration, and the
inputs that switch (X.cross.switch …), are taken if they are there; without them they follow from the setpoints.

--map NAME=COLUMN[UNIT],… says what the columns are; those that are called as in the engine need no word. A unit may
stand in the title too: SollX [mm]. There are m mm um nm 0.1um deg arcsec mdeg rad …, /s /min /s2, and bare factors.

Where an output differs, the engine runs again with each sign, order, ramp and delay that could be meant otherwise; what
leaves {EXPLAINED:.0%} of the difference or less is told. Exit status: 0 no difference, 1 a difference, 2 not run.

examples:
  axcomp replay trace.csv --machine models/three_axis
  axcomp replay trace.csv --machine lists --map "X.setpoint=SollX,X.correction=KorrX[0.1um],time=T[ms]" --plot x.png
"""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "replay",
        description="Compare a trace recorded on a controller with the engine, and say what explains a difference.",
        epilog=_EPILOG,
    )
    parser.add_argument("trace", type=Path, metavar="TRACE.csv", help="the recording")
    parser.add_argument("--machine", type=machine_path, required=True, metavar="PATH", help="the controller's lists")
    parser.add_argument("--map", action="append", default=[], metavar="COLUMNS", help="NAME=COLUMN[UNIT],…; repeatable")
    parser.add_argument("--cycle-time", type=float, metavar="s", help="of the controller; default: the rows' distance")
    parser.add_argument(
        "--within",
        action="append",
        default=[],
        metavar="[OUTPUT=]VALUE",
        help=f"difference that counts as none ({WITHIN:g} µm or ″, {WITHIN_OTHER:g} of a current)",
    )
    parser.add_argument("--skip", type=float, default=0.0, metavar="s", help="at the beginning, not compared (0)")
    parser.add_argument("--plot", type=Path, metavar="FILE.png", help="trace, engine and their difference")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    add_allow_outside(parser)
    parser.set_defaults(do=_do_replay)


def _do_replay(args: argparse.Namespace) -> int:
    reading = read_machine(args.machine, allow_outside=args.allow_outside)
    for finding in reading.findings:
        if finding.severity is Severity.ERROR:
            print(finding, file=sys.stderr)
    try:
        if not reading.machine.axes:
            raise ValueError(f"{args.machine}: There is no axis in these lists.")
        trace = read_trace(args.trace, reading.machine, args.map, args.cycle_time)
        comparisons, notices = compare(trace, reading.machine, _limits(args.within, trace.outputs), args.skip)
        if args.plot is not None:
            from ..analysis.replay import replay_figure
            from ..plot import save

            save(replay_figure(comparisons), args.plot)
    except (ValueError, OSError) as error:
        print(f"axcomp replay: {error}", file=sys.stderr)
        return 2
    notes = [*trace.notes, *notices]
    if args.format == "json":
        figures = {"trace": str(args.trace), "cycle_time": trace.cycle_time, "notes": notes}
        outputs = [one.to_dict() for one in comparisons]
        print(json.dumps(figures | {"outputs": outputs}, indent=2, ensure_ascii=False))
    else:
        for note in notes:
            print(f"{args.trace}: note: {note}", file=sys.stderr)
        _print(comparisons)
    return 0 if all(one.agrees for one in comparisons) else 1


def _limits(words: Sequence[str], outputs: Iterable[str]) -> dict[str, float]:
    """Return differences that count as none by output, "" for all others."""
    found = {}
    for word in words:
        name, _, value = word.rpartition("=")
        try:
            found[name] = float(value)
        except ValueError:
            found[name] = -1.0
        if not found[name] >= 0.0 or (name and name not in outputs):
            raise ValueError(f"--within: “{word}” is no [OUTPUT=]VALUE; the outputs are {', '.join(outputs)}")
    return found


def _print(comparisons: Sequence[Comparison]) -> None:
    from ..plot import console, figure, table

    lines = []
    for one in comparisons:
        figures = (figure(one.largest, 3), figure(one.rms, 3), one.unit, figure(float(one.time[one.row]), 4))
        lines.append([one.output, *figures, str(one.line), "agrees" if one.agrees else "differs"])
    console().print(table("Trace − engine", ["output", "largest", "rms", "", "at s", "line", ""], lines))
    for one in comparisons:
        print(textwrap.fill(one.sentence(), 80, break_long_words=False))
