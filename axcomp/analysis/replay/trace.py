"""A trace recorded on a controller: its columns by the names of the engine's inputs and outputs, and in their units."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...engine.engine import Engine
from ...engine.motion import Array
from ...engine.trajectory import TIME, Columns, InputError, InputFile, read_table
from ...interface.variable import Variable
from ...measurement.columns import ANGLES, LENGTHS
from ...model.machine import CYCLE_TIME, CYCLE_TIME_MAX, Machine

ON_TIME = 0.25
"""Share of a cycle by which the instants of the rows may be off: stamps are rounded."""

_BRACKET = re.compile(r"(.*?)\s*[\[(]([^\[\]()]*)[\])]\s*\Z")
_UNIT = re.compile(r"\s*(\d*\.?\d*)\s*([a-z]*)\s*(?:/\s*(s2|s|min))?\s*\Z")
_BASES = {
    "mm": {name: factor / LENGTHS["mm"] for name, factor in LENGTHS.items()},
    "deg": {name: factor / ANGLES["deg"] for name, factor in ANGLES.items()},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
}
_PER = {"min": ("s", 1.0 / 60.0), "s": ("s", 1.0), "s2": ("s2", 1.0)}
_PLAIN = str.maketrans({"µ": "u", "μ": "u", "²": "2", "^": None, ",": "."})


@dataclass(frozen=True, eq=False)
class Trace:
    """A recording.

    Attributes
    ----------
    inputs : InputFile
        Columns that the engine takes, in its units.
    outputs : mapping of str to array, shape (rows,)
        Columns to compare with what it puts out.
    lines : tuple of int
        Of the file, where each row stands.
    start : float
        Instant of the first row, s.
    cycle_time : float
        s.
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
        whole = np.round(cycles)
        at: Array = np.where(np.abs(cycles - whole) < 1e-6, whole, cycles)
        return at

    def trajectory(self) -> Columns:
        """Return the inputs, a value a cycle."""
        return self.inputs.sampled(self.cycle_time)


def read_trace(path: Path, machine: Machine, mapping: Sequence[str] = (), cycle_time: float | None = None) -> Trace:
    """Read a trace.

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

    Raises
    ------
    InputError
        The file or the mapping cannot be used: a sentence that names the file.
    """
    if cycle_time is not None and not 0.0 < cycle_time < CYCLE_TIME_MAX:
        raise InputError(f"--cycle-time: {cycle_time:g} s is no cycle time.")
    table = read_table(path)
    known = {v.name: v for v in Engine(machine).variables} | {TIME: Variable(TIME, 0, "input", 0.0, "", "s")}
    chosen = _chosen(path, table.names, mapping, known)
    columns = {}
    for name, (place, unit) in chosen.items():
        factor = _factor(unit, known[name].unit)
        if factor is None:
            wanted = known[name].unit
            raise InputError(
                f"{path}: {unit!r} is no unit of {name}; it counts in {wanted}, or in um, arcsec and so on."
            )
        columns[name] = factor * table.numbers(place, name)
    time = columns.pop(TIME, None)
    outputs = {name: values for name, values in columns.items() if known[name].causality == "output"}
    inputs = {name: values for name, values in columns.items() if name not in outputs}
    if not any(name.endswith(".setpoint") for name in inputs):
        raise InputError(
            f"{path}: There is no setpoint in it: --map X.setpoint=COLUMN names one. {_columns(table.names)}"
        )
    if not outputs:
        raise InputError(f"{path}: There is nothing to compare: --map X.correction=COLUMN. {_columns(table.names)}")
    used = {place for place, _ in chosen.values()}
    ignored = [name for place, name in enumerate(table.names) if place not in used]
    notes = [f"Columns that are not used: {', '.join(ignored)}."] if ignored else []
    if time is not None and (np.diff(time) <= 0.0).any():
        line = table.lines[int(np.argmax(np.diff(time) <= 0.0)) + 1]
        raise InputError(f"{path}:{line}: {TIME} must ascend from row to row; {TIME}= leaves it out.")
    start = 0.0 if time is None else float(time[0])
    cycle, kept = _clock(time, cycle_time, notes)
    return Trace(InputFile(inputs, kept), outputs, table.lines, start, cycle, tuple(notes))


def _columns(names: Sequence[str]) -> str:
    return f"The columns are {', '.join(names)}."


def _chosen(
    path: Path, names: Sequence[str], mapping: Sequence[str], known: Mapping[str, Variable]
) -> dict[str, tuple[int, str]]:
    """Return place and unit of the column of each input and output."""
    titles: dict[str, tuple[int, str]] = {}
    for place, title in enumerate(names):
        found = None if title in known else _BRACKET.match(title)
        titles[title] = (place, found[2] if found else "")
        if found:
            titles.setdefault(found[1], titles[title])
    chosen = {name: titles[name] for name in known if name in titles}
    for word in filter(str.strip, ",".join(mapping).split(",")):
        name, equals, column = (part.strip() for part in word.partition("="))
        if not equals:
            raise InputError(f"--map: “{word}” is no NAME=COLUMN.")
        if name not in known:
            near = difflib.get_close_matches(name, known, 4, 0.5) or list(known)[:8]
            raise InputError(f"--map: {name} is neither an input nor an output; there are {', '.join(near)} …")
        found = _BRACKET.match(column)
        if column in titles:
            chosen[name] = titles[column]
        elif found and found[1] in titles:
            chosen[name] = (titles[found[1]][0], found[2])
        elif column:
            raise InputError(f"{path}: There is no column {column!r}. {_columns(names)}")
        else:
            chosen.pop(name, None)
    return chosen


def _factor(written: str, unit: str) -> float | None:
    """Return what a unit is worth in ``unit``: mm, 0.1um, deg/min, or a bare factor; None if it is none of it."""
    found = _UNIT.match(written.replace("°", "deg").translate(_PLAIN).lower())
    if found is None:
        return None if unit else 1.0
    factor = float(found[1] or 1.0) if found[1] != "." else 1.0
    base, _, per = unit.partition("/")
    if found[2] and base:
        given, share = _PER.get(found[3], ("", 1.0))
        if found[2] not in _BASES[base] or given != per:
            return None
        factor *= _BASES[base][found[2]] * share
    return factor


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
