"""A trace recorded on a controller: its columns by the names of the engine's inputs and outputs, and in their units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engine import TIME, Array, Engine, InputError, InputFile, read_table
from ...interface import Variable
from ...measurement import columns_chosen, unit_factor
from ...model import CYCLE_TIME, CYCLE_TIME_MAX, Machine

ON_TIME = 0.25
"""Share of a cycle by which the instants of the rows may be off: stamps are rounded."""


@dataclass(frozen=True, eq=False)
class Trace:
    """A recording: columns that the engine takes, and columns to compare with what it puts out.

    Attributes
    ----------
    inputs : InputFile
        In the engine's units; without instants if each row is a cycle.
    outputs : mapping of str to array, shape (rows,)
        In the engine's units.
    lines : tuple of int
        Of the file, where each row stands.
    start, cycle_time : float
        Instant of the first row, and the controller's cycle, s.
    notes : tuple of str
        How the file was taken, a sentence each.
    """

    inputs: InputFile
    outputs: Mapping[str, Array]
    lines: tuple[int, ...]
    start: float
    cycle_time: float
    notes: tuple[str, ...]

    @property
    def at(self) -> Array:
        """Return when each row was recorded, shape (rows,), in cycles since the first."""
        if self.inputs.time is None:
            return np.arange(len(self.lines), dtype=np.float64)
        cycles = (self.inputs.time - self.inputs.time[0]) / self.cycle_time
        at: Array = np.where(np.abs(cycles - np.round(cycles)) < 1e-6, np.round(cycles), cycles)
        return at


def read_trace(path: Path, machine: Machine, mapping: Sequence[str] = (), cycle_time: float | None = None) -> Trace:
    """Read a trace; InputError, a sentence that names the file, if it or the mapping cannot be used.

    Parameters
    ----------
    path : Path
        A table with names in its first row, which may have units: ``SollX [mm]``.
    machine : Machine
        Says which inputs and outputs there are.
    mapping : sequence of str
        ``X.setpoint=SollX``, ``X.correction=KorrX[0.1um]``, ``time=T[ms]``; several with commas between. What is
        called as in the engine needs none, and is left out by ``X.correction=``.
    cycle_time : float or None
        Of the controller, s; None: the distance of the rows.
    """
    if cycle_time is not None and not 0.0 < cycle_time < CYCLE_TIME_MAX:
        raise InputError(f"--cycle-time: {cycle_time:g} s is no cycle time.")
    table = read_table(path)
    there = f"The columns are {', '.join(table.names)}."
    known = {v.name: v for v in Engine(machine).variables} | {TIME: Variable(TIME, 0, "input", 0.0, "", "s")}
    columns, used = {}, set()
    for name, (title, unit) in columns_chosen(table.names, mapping, known).items():
        factor = unit_factor(unit, known[name].unit)
        if title not in table.names:
            raise InputError(f"{path}: There is no column {title!r}. {there}")
        if factor is None:
            raise InputError(f"{path}: {unit!r} is no unit of {name}, which counts in {known[name].unit}, um, mdeg …")
        used.add(title)
        columns[name] = factor * table.numbers(table.names.index(title), name)
    time = columns.pop(TIME, None)
    outputs = {name: values for name, values in columns.items() if known[name].causality == "output"}
    inputs = {name: values for name, values in columns.items() if name not in outputs}
    if not outputs or not any(name.endswith(".setpoint") for name in inputs):
        example = "X.setpoint=COLUMN,X.correction=COLUMN"
        raise InputError(f"{path}: A setpoint and an output are needed at least: --map {example}. {there}")
    if time is not None and (np.diff(time) <= 0.0).any():
        line = table.lines[int(np.argmax(np.diff(time) <= 0.0)) + 1]
        raise InputError(f"{path}:{line}: {TIME} must ascend from row to row; --map {TIME}= leaves it out.")
    ignored = [title for title in table.names if title not in used]
    notes = [f"Columns that are not used: {', '.join(ignored)}."] if ignored else []
    needed = {name for output in outputs for name in known[output].depends_on or () if name.endswith(".setpoint")}
    if absent := sorted(needed - inputs.keys()):
        notes.append(f"Not in the trace, taken as 0, though outputs depend on it: {', '.join(absent)}.")
    cycle, kept = _clock(time, cycle_time, notes)
    start = 0.0 if time is None else float(time[0])
    return Trace(InputFile(inputs, kept), outputs, table.lines, start, cycle, tuple(notes))


def _clock(time: Array | None, wanted: float | None, notes: list[str]) -> tuple[float, Array | None]:
    """Return the cycle time, and the instants unless each row is a cycle; add what there is to say."""
    if time is None or len(time) < 2:
        if wanted is None:
            notes.append(f"No time is given: a row is taken for a cycle of {CYCLE_TIME:g} s.")
        return wanted or CYCLE_TIME, None
    steps = np.arange(len(time))
    mean = float(f"{(time[-1] - time[0]) / (len(time) - 1):.9g}")
    even = bool((np.abs(time - time[0] - mean * steps) <= ON_TIME * mean).all())
    cycle = wanted or (mean if even else float(f"{np.median(np.diff(time)):.9g}"))
    if (np.abs(time - time[0] - cycle * steps) <= ON_TIME * cycle).all():
        return cycle, None
    distance = f"{mean:g} s apart" if even else "not equally far apart"
    notes.append(f"The rows are {distance}, a cycle takes {cycle:g} s: between rows the inputs are taken as linear.")
    return cycle, time
