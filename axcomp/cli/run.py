"""``axcomp run``: a program of setpoints and NC commands, row by row through a machine."""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..analysis.diagnosis import write_named_diagnoses
from ..engine import COMMAND, Engine, NcError
from ..lists import read_machine
from ..model import CYCLE_TIME, machine_path
from .reading_options import add_reading_options

TIME = "time"
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
        formatter_class=argparse.RawDescriptionHelpFormatter,
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
        print(f"{args.output}: {len(result)} cycles, {len(result.values)} outputs")
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
    with path.open(encoding="utf-8-sig", newline="") as file:
        reader = csv.reader(file)
        names = [name.strip() for name in next(reader, [])]
        if not names or len(set(names)) < len(names):
            raise ValueError(f"{path}:1: the first line must name the columns, each once")
        rows, lines = [], []
        before = 1
        for row in reader:
            if any(cell.strip() for cell in row):
                if len(row) != len(names):
                    raise ValueError(f"{path}:{before + 1}: {len(row)} cells, but {len(names)} columns")
                rows.append(row)
                lines.append(before + 1)
            before = reader.line_num
    if not rows:
        raise ValueError(f"{path}: there is no row below the names of the columns")
    columns = dict(zip(names, zip(*rows, strict=True), strict=True))
    commands = list(columns.pop(COMMAND, [""] * len(rows)))
    time = columns.pop(TIME, None)
    inputs = {name: _numbers(path, lines, name, cells) for name, cells in columns.items()}
    if time is None:
        return _Program(inputs, commands, lines, None)
    instants = _numbers(path, lines, TIME, time)
    return _Program(inputs, commands, lines, _spacing(path, lines, instants), float(instants[0]))


def _numbers(path: Path, lines: Sequence[int], name: str, cells: Sequence[str]) -> NDArray[np.float64]:
    values = np.empty(len(cells))
    words = {"true": 1.0, "false": 0.0}
    for row, cell in enumerate(cells):
        text = cell.strip().lower()
        try:
            values[row] = values[row - 1] if not text and row else words.get(text) if text in words else float(text)
        except ValueError:
            raise ValueError(f"{path}:{lines[row]}: {name}: {cell.strip()!r} is no number") from None
    return values


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
