"""A trace against the engine, output by output."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ...engine import Array
from ...interface import Variable, by_name, variables_of
from ...kinds import Friction
from ...model import Axis, Machine, shown, symbol
from .explanations import Bench, Outputs
from .trace import Trace

EXPLAINED = 0.2
"""A reading explains a difference if this share of it, or less, is left."""
SHIFT_MAX = 50
"""Cycles by which an output is tried earlier and later."""
WITHIN, WITHIN_OTHER = 0.5, 1.0
"""Differences that are none, if nothing else is asked for: µm or ″, and the unit of other numbers."""


@dataclass(frozen=True)
class Explanation:
    """A reading that explains a difference: its words, and the largest difference that is left by it."""

    text: str
    left: float


@dataclass(frozen=True, eq=False)
class Comparison:
    """One output of a trace.

    Attributes
    ----------
    output : str
        Its name.
    unit : str
        µm, ″, or the output's own.
    time : array, shape (rows,)
        s.
    trace, engine : array, shape (rows,)
        Values, in the unit; NaN in rows that are not compared.
    row, line : int
        Where they differ most, and where that stands in the file.
    places : str
        Setpoints there, of the output's axis or of all.
    within : float
        Difference that counts as none.
    explanations : tuple of Explanation
        The best first.
    """

    output: str
    unit: str
    time: Array
    trace: Array
    engine: Array
    row: int
    line: int
    places: str
    within: float
    explanations: tuple[Explanation, ...] = ()

    @property
    def difference(self) -> Array:
        """Return trace − engine, shape (rows,)."""
        return self.trace - self.engine

    @property
    def largest(self) -> float:
        """Return the largest size of the difference."""
        return float(np.abs(self.difference[self.row]))

    @property
    def rms(self) -> float:
        """Return the root of its mean square."""
        return float(np.sqrt(np.nanmean(np.square(self.difference))))

    @property
    def agrees(self) -> bool:
        """Tell whether there is no difference."""
        return self.largest <= self.within

    def sentence(self) -> str:
        """Return what there is to say."""
        unit = f" {self.unit}".rstrip()
        where = f"t = {self.time[self.row]:.6g} s ({', '.join(filter(None, (f'line {self.line}', self.places)))})"
        said = f"{self.output} differs by at most {self.largest:.4g}{unit} at {where}"
        if self.agrees:
            return f"{said}."
        if not self.explanations:
            return f"{said}; no sign, order, ramp or delay that was tried explains it."
        best, *others = self.explanations
        also = "; ".join(f"{one.text} ({one.left:.2g}{unit})" for one in others[:3])
        said = f"{said}; with {best.text} {best.left:.2g}{unit} are left."
        return f"{said} Explained as well by: {also}." if also else said

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON."""
        names = ("output", "unit", "largest", "rms", "within", "agrees", "line", "places")
        figures = {name: getattr(self, name) for name in names} | {"time": float(self.time[self.row])}
        return figures | {"explanations": [asdict(one) for one in self.explanations]}


def compare(
    trace: Trace, machine: Machine, within: Mapping[str, float] | None = None, skip: float = 0.0
) -> tuple[list[Comparison], tuple[str, ...]]:
    """Run a trace through the engine; return a comparison for each of its outputs, and what the engine has to say.

    Parameters
    ----------
    trace : Trace
        The recording.
    machine : Machine
        What its controller has.
    within : mapping of str to float
        Differences that count as none, by output, "" for all others; in µm, ″, or the output's own unit.
    skip : float
        Seconds at the beginning that are not compared: what a controller remembers is not in a trace.

    Raises
    ------
    ValueError
        There is no row to compare.
    """
    bench = Bench(machine, trace.inputs.sampled(trace.cycle_time), trace.cycle_time)
    variables = by_name(variables_of(machine))
    at = np.where(trace.at * trace.cycle_time < skip, np.nan, trace.at)
    time = trace.start + trace.at * trace.cycle_time
    limits: Mapping[str, float] = within or {}
    readings: dict[int, list[tuple[str, Outputs]]] = {}
    found = []
    for name, recorded in trace.outputs.items():
        variable, axis = variables[name], variables[name].axis
        factor, unit = shown(variable.unit)
        values, engine = factor * recorded, factor * _sampled(bench.outputs[name], at)
        if np.isnan(values - engine).all():
            raise ValueError(f"{name}: there is no row to compare")
        limit = limits.get(name, limits.get("", WITHIN if unit or variable.type != "Real" else WITHIN_OTHER))
        row = int(np.nanargmax(np.abs(values - engine)))
        places = _places(trace, bench, axis, row)
        made = Comparison(name, unit, time, values, engine, row, trace.lines[row], places, limit)
        if not made.agrees and axis is not None:
            if axis not in readings:
                readings[axis] = list(bench.readings(axis, trace.outputs))
            tried = [(text, _sampled(outputs[name], at)) for text, outputs in readings[axis]]
            tried += _shifted(bench.outputs[name], variable, machine.axes[axis], at)
            left = (_explanation(text, made.difference, values - factor * other) for text, other in tried)
            kept = sorted(filter(None, left), key=lambda one: one.left)
            made = replace(made, explanations=tuple(kept))
        found.append(made)
    return found, bench.result.notices


def _sampled(values: Array, at: Array) -> Array:
    """Return an output where rows are, NaN before the first cycle and behind the last."""
    cycles = np.arange(len(values), dtype=np.float64)
    there = np.interp(at, cycles, np.asarray(values, dtype=np.float64), left=np.nan, right=np.nan)
    sampled: Array = np.where(np.isnan(at), np.nan, there)  # interp takes NaN for the only cycle of a short trace
    return sampled


def _explanation(text: str, before: Array, rest: Array) -> Explanation | None:
    """Return a reading that leaves ``rest``, None if that is too much of what there was in the same rows."""
    both = ~np.isnan(before + rest)
    left = float(np.max(np.abs(rest[both]), initial=0.0))
    return Explanation(text, left) if left < EXPLAINED * np.max(np.abs(before[both]), initial=0.0) else None


def _shifted(output: Array, variable: Variable, axis: Axis, at: Array) -> Iterator[tuple[str, Array]]:
    """Yield an output of the engine whole cycles later and earlier."""
    friction = axis.of(Friction)
    most = min(SHIFT_MAX, int(np.nanmax(at) - np.nanmin(at)) // 4)
    for cycles in (*range(-most, 0), *range(1, most + 1)):
        text = f"the engine's output {abs(cycles)} cycle{'s'[: abs(cycles) - 1]} {'later' if cycles > 0 else 'earlier'}"
        if variable.quantity == "current" and friction is not None and friction.delay_cycles + cycles >= 0:
            text = f"delay_cycles {friction.delay_cycles + cycles} instead of {friction.delay_cycles}"
        yield text, _sampled(output, at - cycles)


def _places(trace: Trace, bench: Bench, axis: int | None, row: int) -> str:
    """Return the setpoints in a row in words: of an axis, or of all."""
    said = []
    for place, one in enumerate(bench.machine.axes):
        column = trace.inputs.columns.get(bench.names[place, "setpoint"])
        if column is not None and axis in (None, place):
            said.append(f"{one.name} = {column[row]:.6g} {symbol(one.unit)}")
    return ", ".join(said)
