"""The inputs of a run: columns of a file, or a motion that is generated, one value a cycle."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from .completion import differences
from .motion import Array, Course, Limits, Setpoints
from .sheet import SheetError, number, read_sheets

Columns = dict[str, npt.NDArray[Any]]
"""Inputs by name, shape (cycles,): float64, or bool."""

TIME = "time"
_BOOLEANS = {"true": 1.0, "false": 0.0}
_SETPOINT, _VELOCITY, _ACCELERATION, _ACTUAL = "setpoint", "velocity", "acceleration", "actual_position"


class InputError(ValueError):
    """An input file that cannot be used; the message begins with ``file:line:``."""


@dataclass(frozen=True, eq=False)
class InputFile:
    """Inputs from a table with a column for each, shape (rows,), by name.

    ``time``: ascending, s, shape (rows,); None: a row a cycle.
    """

    columns: Mapping[str, Array]
    time: Array | None = None

    def sampled(self, cycle_time: float, duration: float | None = None) -> Columns:
        """Return a value a cycle: linear between the rows, after the last one held.

        Without a duration there are as many cycles as the file has rows or its time has room for. Columns of −1, 0
        and 1 are not interpolated: what they switch comes with its row.
        """
        rows = len(next(iter(self.columns.values())))
        at = np.arange(rows) * cycle_time if self.time is None else self.time - self.time[0]
        cycles = _cycles(float(at[-1]) + cycle_time if duration is None else duration, cycle_time)
        instants = np.arange(cycles) * cycle_time
        held = np.searchsorted(at, instants * (1.0 + 1e-12) + 1e-9 * cycle_time, side="right") - 1
        # Rows at the instants themselves are taken as they are, whatever rounding makes of their times.
        exact = np.abs(at[held] - instants) <= 1e-6 * cycle_time
        found: Columns = {}
        for name, values in self.columns.items():
            switches = np.isin(values, (-1.0, 0.0, 1.0)).all()
            found[name] = np.where(exact | switches, values[held], np.interp(instants, at, values))
        return found


@dataclass(frozen=True)
class Sine:
    """Motion of an axis to and fro, mm or °; Hz, and ° at the start."""

    centre: float
    amplitude: float
    frequency: float
    phase: float = 0.0


@dataclass(frozen=True)
class Motion:
    """A motion that is generated.

    ``start``: where the axes of the moves begin, mm or °. ``moves``: targets by axis, with ``velocity``,
    ``acceleration``, ``jerk`` of their own; or ``dwell`` in s; over and over again until the duration is over.
    ``sines``: by axis. ``limits``: of the moves that say nothing else.
    """

    start: Mapping[str, float] = field(default_factory=dict)
    moves: Sequence[Mapping[str, float]] = ()
    sines: Mapping[str, Sine] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)

    def sampled(self, cycle_time: float, duration: float | None = None) -> Columns:
        """Return a value a cycle; without a duration the moves are made once."""
        setpoints: dict[str, Setpoints] = {}
        if self.start:
            course = Course(self.start, cycle_time)
            wanted = math.inf if duration is None else _cycles(duration, cycle_time)
            while True:
                before = course.cycles
                self._once(course)
                if duration is None or course.cycles >= wanted:
                    break
                if course.cycles == before:
                    course.dwell((wanted - course.cycles) * cycle_time)
            setpoints = course.setpoints()
            duration = course.cycles * cycle_time if duration is None else duration
        cycles = _cycles(duration or 0.0, cycle_time)
        at = 2.0 * np.pi * np.arange(cycles) * cycle_time
        for axis, sine in self.sines.items():
            angle, speed = sine.frequency * at + np.radians(sine.phase), 2.0 * np.pi * sine.frequency
            swing, rate = sine.amplitude * np.sin(angle), sine.amplitude * speed * np.cos(angle)
            setpoints[axis] = Setpoints(sine.centre + swing, rate, -sine.amplitude * speed**2 * np.sin(angle))
        found: Columns = {}
        for axis, commands in setpoints.items():
            found[f"{axis}.{_SETPOINT}"] = commands.position[:cycles]
            found[f"{axis}.{_VELOCITY}"] = commands.velocity[:cycles]
            found[f"{axis}.{_ACCELERATION}"] = commands.acceleration[:cycles]
        return found

    def _once(self, course: Course) -> None:
        for step in self.moves:
            if "dwell" in step:
                course.dwell(step["dwell"])
                continue
            own = {name: step.get(name, getattr(self.limits, name)) for name in LIMITS}
            course.move({axis: target for axis, target in step.items() if axis not in LIMITS}, Limits(**own))


LIMITS = ("velocity", "acceleration", "jerk")


def completed(
    columns: Columns, known: set[str], cycle_time: float, modulo: Mapping[str, float] = MappingProxyType({})
) -> Columns:
    """Return the inputs with what follows from the setpoints, where a machine knows it and it is not given.

    Velocity and acceleration by differences over a cycle (semantics §4), the actual position equal to the setpoint.
    ``modulo``: after how many ° the positions of an axis repeat, by its name in the columns.
    """
    found = dict(columns)
    for name, position in columns.items():
        prefix, _, last = name.rpartition(".")
        if last != _SETPOINT:
            continue
        velocity = differences(np.asarray(position, dtype=np.float64), position[0], cycle_time, modulo.get(prefix, 0.0))
        acceleration = differences(velocity, 0.0, cycle_time)
        for kind, values in ((_VELOCITY, velocity), (_ACCELERATION, acceleration), (_ACTUAL, position)):
            if f"{prefix}.{kind}" in known:
                found.setdefault(f"{prefix}.{kind}", values)
    return found


@dataclass(frozen=True)
class TextTable:
    """A table as text; numbers are made of the columns that are asked for.

    Attributes
    ----------
    path : Path
    names : tuple of str
        Of the columns, each once.
    lines : tuple of int
        Where each row stands.
    rows : tuple of sequences of str
        At least one, all as long as ``names``.
    """

    path: Path
    names: tuple[str, ...]
    lines: tuple[int, ...]
    rows: tuple[Sequence[str], ...]

    def numbers(self, place: int, name: str, *, repeated: bool = False) -> Array:
        """Return a column, shape (rows,); InputError, with ``name`` as what it is, for a cell that is no number.

        ``repeated``: an empty cell is the one above it.
        """
        values = np.empty(len(self.rows))
        for number_, (line, row) in enumerate(zip(self.lines, self.rows, strict=True)):
            empty = repeated and number_ > 0 and not row[place].strip()
            values[number_] = values[number_ - 1] if empty else self._number(line, name, row[place])
        return values

    def _number(self, line: int, name: str, cell: str) -> float:
        try:
            value: float | None = float(cell)
        except ValueError:
            word = cell.strip().lower()
            value = _BOOLEANS[word] if word in _BOOLEANS else number(cell)
        if value is None:
            raise InputError(f"{self.path}:{line}: {cell.strip()!r} is no number, as {name} has to be.")
        if name == TIME and not math.isfinite(value):
            raise InputError(f"{self.path}:{line}: {cell!r} is no time in s.")
        return value


def read_table(path: Path, *, comments: bool = True) -> TextTable:
    """Read a table with names in its first row, in any dialect of ``read_sheets``, which has ``comments`` too.

    Raises
    ------
    InputError
        The file cannot be read, a row is incomplete, there is none, or there are several tables.
    """
    try:
        sheets = read_sheets(path, comments=comments)
    except SheetError as error:
        raise InputError(str(error)) from None
    if len(sheets) > 1:
        raise InputError(f"{path}: There are {len(sheets)} tables in it; one is needed.")
    rows = sheets[0].rows if sheets else []
    if not rows:
        raise InputError(f"{path}: There is no row of inputs in it.")
    names = rows[0].cells
    if len(set(names)) < len(names) or not all(names):
        raise InputError(f"{path}:{rows[0].line}: Every column needs a name of its own.")
    if len(rows) < 2:
        raise InputError(f"{path}: There is no row of inputs in it.")
    for row in rows[1:]:
        # A workbook does not have the empty cells at the end of a row.
        if len(row.cells) != len(names) and (comments or len(row.cells) > len(names)):
            raise InputError(f"{path}:{row.line}: There are {len(row.cells)} cells for {len(names)} columns.")
    filled = tuple((*row.cells, *[""] * (len(names) - len(row.cells))) for row in rows[1:])
    return TextTable(path, names, tuple(row.line for row in rows[1:]), filled)


def read_input(path: Path) -> InputFile:
    """Read a table with the inputs' names in its first row, as FMPy takes it.

    Raises
    ------
    InputError
        The file cannot be read, a row is incomplete, a cell is no number, or time does not ascend.
    """
    table = read_table(path)
    columns = {name: table.numbers(place, name) for place, name in enumerate(table.names)}
    time = columns.pop(TIME, None)
    if not columns:
        raise InputError(f"{path}: There is no input besides {TIME}.")
    if time is not None and (np.diff(time) <= 0.0).any():
        raise InputError(f"{path}: {TIME} must ascend from row to row.")
    return InputFile(columns, time)


def _cycles(duration: float, cycle_time: float) -> int:
    return max(1, round(duration / cycle_time))
