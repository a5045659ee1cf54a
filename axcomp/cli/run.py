"""``axcomp run``: a program of setpoints and NC commands, row by row through a machine."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..analysis.diagnosis import write_named_diagnoses
from ..engine import COMMAND, TIME, Engine, NcError, read_table
from ..lists import read_machine
from ..model import CYCLE_TIME, machine_path
from .reading_options import add_reading_options

_ON_TIME = 1e-6
"""Share of a cycle by which the instants of the rows may be off."""

EPILOG = """\
PROGRAM.csv has one row for each cycle. Its columns are inputs as the FMU names them (X.setpoint, X.cross.switch, …),
and, if there are any, the time in s and the NC commands of the row. An empty cell repeats the one above it.

  time,X.setpoint,command
  0,10,X[COMP ON LEAD]
  0.001,10.01,#VOLCOMP OFF [ID=0 NO_MOVE]

The results are all outputs, one row for each cycle. What cannot be carried out is told with its line and character.

examples:
  axcomp run program.csv --machine models/three_axis --output result.csv
  axcomp run program.csv --machine lists/hochlauf.lis --cycle-time 0.002
"""


class _Program(NamedTuple):
    """A program: inputs by name, NC commands or "", lines of the rows, s between them or None, first instant."""

    inputs: dict[str, NDArray[np.float64]]
    commands: list[str]
    lines: list[int]
    spacing: float | None
    start: float = 0.0


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the sub-command."""
    parser = subparsers.add_parser(
        "run",
        description="Run a program of setpoints and NC commands through the compensations of a machine.",
        epilog=EPILOG,
    )
    parser.add_argument("program", type=Path, metavar="PROGRAM.csv", help="one row for each cycle")
    parser.add_argument(
        "--machine",
        type=machine_path,
        required=True,
        metavar="PATH",
        help="hochlauf.lis, a folder with one, or a single achskw*.lis",
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="CSV with the outputs; default: standard output")
    parser.add_argument(
        "--cycle-time", type=float, metavar="S", help=f"default: the rows' distance in time, else {CYCLE_TIME} s"
    )
    parser.add_argument(
        "--naming", choices=("structured", "flat"), default="structured", help="X.setpoint (default) or X_setpoint"
    )
    add_reading_options(parser)
    parser.set_defaults(do=_do_run)


def _do_run(args: argparse.Namespace) -> int:
    program = _read(args.program)
    cycle_time = args.cycle_time or program.spacing or CYCLE_TIME
    if program.spacing is not None and abs(program.spacing - cycle_time) > _ON_TIME * cycle_time:
        raise ValueError(f"{args.program}: the rows are {program.spacing:g} s apart, the cycles {cycle_time:g} s")
    lists = args.machine
    engine = Engine(lists, cycle_time, args.naming, args.axis_type, args.allow_outside)
    engine.runtime.start_time = program.start

    def write_diagnosis(index: int | None = None) -> Iterator[str]:
        """Write what the controller writes at start-up and with every UPDATE."""
        reading = read_machine(lists, axis_type=args.axis_type, allow_outside=args.allow_outside)
        for said in write_named_diagnoses(reading, index):
            yield f"{said} is written." if isinstance(said, Path) else said

    engine.nc.on_update = write_diagnosis
    notices = list(write_diagnosis()) if any(one.diagnosis_file for one in engine.machine.volumetric) else []
    for finding in engine.findings:
        print(finding, file=sys.stderr)
    if _report_commands(engine, args.program, program):
        return 1
    trajectory: Mapping[str, object] = {**program.inputs, COMMAND: program.commands}
    try:
        result = engine.run(trajectory)  # type: ignore[arg-type]
    except KeyError as error:
        raise ValueError(f"{args.program}:1: {error.args[0]}") from None
    for notice in (*notices, *result.notices):
        print(f"{args.program}: note: {notice}", file=sys.stderr)
    if args.output is None:
        sys.stdout.writelines(f"{line}\n" for line in result.csv_lines())
    else:
        result.to_csv(args.output)
        print(f"{args.output}: {result.cycles} cycles, {len(result)} outputs")
    return 0


def _report_commands(engine: Engine, path: Path, program: _Program) -> int:
    """Print what is wrong with the commands before anything runs; return how many cannot be carried out."""
    count = 0
    for line, block in zip(program.lines, program.commands, strict=True):
        try:
            engine.nc.check(block)
        except NcError as error:
            count += 1
            print(f"{path}:{line}: {error}", file=sys.stderr)
    return count


def _read(path: Path) -> _Program:
    """Return a program; ValueError that names file and line for what is none."""
    table = read_table(path, comments=False)
    inputs = {name: table.numbers(k, name, repeated=True) for k, name in enumerate(table.names) if name != COMMAND}
    place = table.names.index(COMMAND) if COMMAND in table.names else None
    commands = [""] * len(table.rows) if place is None else [row[place] for row in table.rows]
    time = inputs.pop(TIME, None)
    if time is None:
        return _Program(inputs, commands, list(table.lines), None)
    return _Program(inputs, commands, list(table.lines), _spacing(path, table.lines, time), float(time[0]))


def _spacing(path: Path, lines: Sequence[int], time: NDArray[np.float64]) -> float | None:
    """Return the distance of the rows in s, None for a single row; ValueError unless they are equally far apart."""
    if len(time) < 2:
        return None
    spacing = float(f"{(time[-1] - time[0]) / (len(time) - 1):.9g}")
    off = np.flatnonzero(~(np.abs(time - time[0] - spacing * np.arange(len(time))) <= _ON_TIME * abs(spacing)))
    if not spacing > 0.0 or len(off):
        line = lines[int(off[0])] if len(off) else lines[1]
        raise ValueError(f"{path}:{line}: the rows are not equally far apart in time: one is needed for each cycle")
    return spacing
