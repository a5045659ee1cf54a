"""Traces of one axis as a controller records them: setpoint, position, velocity, current … over time.

Columns are told by their names, ``X.`` before them or not, by aliases, or by a mapping as in ``axcomp replay``:
``velocity=v_ist[mm/s],current=I``. What is not recorded follows from what is: velocity from the setpoint or the
position, acceleration from the velocity; noise is smoothed over some cycles.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.signal import savgol_filter

from ..engine import Array, InputError, read_table
from ..model import CYCLE_TIME
from .columns import MeasurementError
from .mapping import columns_chosen, unit_factor

UNITS = {
    "time": "s",
    "setpoint": "mm",
    "position": "mm",
    "actual": "mm",
    "deviation": "mm",
    "velocity": "mm/s",
    "acceleration": "mm/s2",
    "current": "",
    "position1": "mm",
    "position2": "mm",
    "master_setpoint": "mm",
    "master_position": "mm",
    "master_velocity": "mm/s",
    "master_acceleration": "mm/s2",
}
"""What a trace may have, and units; ``actual``: where the slide is, ``position``: what the motor's encoder sees."""

ALIASES = {"torque": "current", "force": "current", "actual_position": "position", "speed": "velocity"}
"""Other names of the same."""

SMOOTH = 0.01
"""Over which noise is smoothed, s."""


@dataclass(frozen=True, eq=False)
class AxisTrace:
    """A recording, arrays of shape (n,).

    Attributes
    ----------
    time : array
        s, ascending.
    columns : mapping of str to array
        What was recorded, by the names in ``UNITS``, in mm or °, per s, s²; currents as they are.
    unit : str
        ``mm`` or ``deg``.
    source : str
        The file.
    notes : tuple of str
        How it was taken.
    """

    time: Array
    columns: Mapping[str, Array]
    unit: str
    source: str
    notes: tuple[str, ...] = ()

    @property
    def cycle(self) -> float:
        """Median distance of rows, s."""
        return float(np.median(np.diff(self.time)))

    def has(self, *names: str) -> bool:
        """Tell whether one of these was recorded."""
        return any(name in self.columns for name in names)

    def velocity(self, prefix: str = "") -> Array:
        """Return the velocity, of the axis or with ``master_`` of its master; MeasurementError if nothing says it."""
        if f"{prefix}velocity" in self.columns:
            return self._smooth(self.columns[f"{prefix}velocity"])
        return self._smooth(self._way(prefix), 1)

    def acceleration(self, prefix: str = "") -> Array:
        """Return the acceleration."""
        if f"{prefix}acceleration" in self.columns:
            return self.columns[f"{prefix}acceleration"]
        if f"{prefix}velocity" in self.columns:
            return self._smooth(self.columns[f"{prefix}velocity"], 1)
        return self._smooth(self._way(prefix), 2)

    def travelled(self, prefix: str = "") -> Array:
        """Return where the axis is, from any place where only its velocity was recorded."""
        if self.has(f"{prefix}setpoint", f"{prefix}position"):
            return self._way(prefix)
        v = self.velocity(prefix)
        steps = 0.5 * (v[1:] + v[:-1]) * np.diff(self.time)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def _way(self, prefix: str) -> Array:
        for name in (f"{prefix}setpoint", f"{prefix}position"):
            if name in self.columns:
                return self.columns[name]
        raise MeasurementError(self.source, 0, f"Nothing says how the {prefix.strip('_') or 'axis'} moves.")

    def _smooth(self, values: Array, derivative: int = 0) -> Array:
        """Return values or a derivative by parabolas over ``SMOOTH`` s."""
        window = min(max(5, 2 * round(0.5 * SMOOTH / self.cycle) + 1), (len(values) - 1) // 2 * 2 + 1)
        return np.asarray(savgol_filter(values, window, min(3, window - 1), deriv=derivative, delta=self.cycle))


def is_trace(path: str | Path) -> bool:
    """Tell whether a file has a column of times: it is a recording then, not a series of readings."""
    try:
        names = read_table(Path(path)).names
    except InputError:
        return False
    return any(name.partition("[")[0].strip().lower() in ("time", "t") for name in names)


def read_axis_trace(path: str | Path, mapping: Sequence[str] = (), cycle_time: float | None = None) -> AxisTrace:
    """Read a trace; MeasurementError, with file and line, if it or the mapping cannot be used.

    Parameters
    ----------
    path : str or Path
        A table with names in its first row, which may have units: ``v [mm/min]``.
    mapping : sequence of str
        ``velocity=v_ist[mm/s],current=I``.
    cycle_time : float, optional
        Distance of rows in a file without time, s.
    """
    try:
        table = read_table(Path(path))
        chosen = columns_chosen(table.names, mapping, UNITS)
        for title in table.names:
            name = title.partition("[")[0].partition("(")[0].strip().rpartition(".")[2].lower()
            name = {"t": "time", **ALIASES}.get(name, name)
            taken = {column for column, _ in chosen.values()}
            if name in UNITS and name not in chosen and title not in taken:
                unit = title.partition("[")[2].rstrip("] ")
                chosen[name] = (title, unit)
        columns, units = {}, set()
        for name, (title, written) in chosen.items():
            if title not in table.names:
                raise InputError(f"{path}: There is no column {title!r}. The columns are {', '.join(table.names)}.")
            factor, unit = _worth(written, UNITS[name])
            if factor is None:
                raise InputError(f"{path}: {written!r} is no unit of {name}, which counts in {UNITS[name]}.")
            units |= {unit} if written and unit else set()
            columns[name] = factor * table.numbers(table.names.index(title), name)
        if len(units) > 1:
            raise InputError(f"{path}: Some columns are lengths and some are angles.")
        for name, values in columns.items():
            wrong = ~np.isfinite(values)
            if wrong.any():
                line = table.lines[int(np.argmax(wrong))]
                raise InputError(f"{path}:{line}: {name} is no finite number.")
        time, note = _times(columns.pop("time", None), cycle_time, table.lines, str(path))
    except InputError as error:
        raise _as_measurement(error) from None
    unused = [title for title in table.names if title not in {title for title, _ in chosen.values()}]
    notes = ([f"Columns that are not used: {', '.join(unused)}."] if unused else []) + note
    return AxisTrace(time, columns, units.pop() if units else "mm", str(path), tuple(notes))


def _worth(written: str, unit: str) -> tuple[float | None, str]:
    """Return what a unit is worth in ``unit``, or in the same of degrees, and which of both it is."""
    if not written or not unit.startswith("mm"):
        return (unit_factor(written, unit) if written else 1.0), ""
    for base in ("mm", "deg"):
        factor = unit_factor(written, unit.replace("mm", base))
        if factor is not None:
            return factor, base
    return None, ""


def _times(given: Array | None, cycle_time: float | None, lines: Sequence[int], file: str) -> tuple[Array, list[str]]:
    """Return the instants of the rows, evenly spread where stamps only are rounded."""
    if len(lines) < 20:
        raise MeasurementError(file, 0, f"{len(lines)} rows are too few for a trace.")
    rows = np.arange(len(lines), dtype=np.float64)
    if given is None:
        note = [] if cycle_time else [f"No time is recorded: a row is taken for a cycle of {CYCLE_TIME:g} s."]
        return rows * (cycle_time or CYCLE_TIME), note
    if (np.diff(given) <= 0.0).any():
        raise MeasurementError(file, lines[int(np.argmax(np.diff(given) <= 0.0)) + 1], "time must ascend.")
    steps = np.diff(given)
    if steps.max() > 1.5 * np.median(steps):
        at = lines[int(np.argmax(steps)) + 1]
        return given, [f"Rows are missing or unevenly far apart, most before line {at}: derivatives are off there."]
    return given, []


def _as_measurement(error: InputError) -> MeasurementError:
    file, _, sentence = str(error).partition(": ")
    name, _, line = file.rpartition(":")
    return MeasurementError(name, int(line), sentence) if line.isdigit() else MeasurementError(file, 0, sentence)
