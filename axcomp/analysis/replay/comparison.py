"""A trace against the engine, output by output."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ...engine.motion import Array
from ...interface.variable import Variable
from ...interface.variables import by_name, variables_of
from ...kinds import Friction
from ...model.machine import Axis, Machine
from ...model.quantity import shown, symbol
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
    line : int
        Of the file, where they differ most.
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
    line: int
    places: str
    within: float
    explanations: tuple[Explanation, ...] = ()

    @property
    def difference(self) -> Array:
        """Return trace − engine, shape (rows,)."""
        return self.trace - self.engine

    @property
    def row(self) -> int:
        """Return where they differ most."""
        return int(np.nanargmax(np.abs(self.difference)))

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
        return f"{said}; with {best.text} {best.left:.2g}{unit} are left." + (
            f" So would explain it: {also}." * bool(also)
        )

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
    bench = Bench(machine, trace.trajectory(), trace.cycle_time)
    variables = by_name(variables_of(machine))
    at = np.where(trace.at * trace.cycle_time < skip, np.nan, trace.at)
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
        made = Comparison(name, unit, trace.start + trace.at * trace.cycle_time, values, engine, 0, "", limit)
        places = _places(trace, machine, bench, axis, made.row)
        made = replace(made, line=trace.lines[made.row], places=places)
        if not made.agrees and axis is not None:
            if axis not in readings:
                readings[axis] = list(bench.readings(axis))
            tried = [(text, outputs.get(name, np.zeros(len(engine)))) for text, outputs in readings[axis]]
            sampled = [(text, _sampled(output, at)) for text, output in tried]
            sampled += _shifted(bench.outputs[name], variable, machine.axes[axis], at)
            largest = [(text, np.abs(values - factor * other)) for text, other in sampled]
            kept = [Explanation(text, float(np.nanmax(rest))) for text, rest in largest if not np.isnan(rest).all()]
            explaining = sorted((one for one in kept if one.left <= EXPLAINED * made.largest), key=lambda one: one.left)
            made = replace(made, explanations=tuple(explaining))
        found.append(made)
    return found, bench.result.notices


def _sampled(values: Array, at: Array) -> Array:
    """Return an output where rows are, NaN before the first cycle and behind the last."""
    cycles = np.arange(len(values), dtype=np.float64)
    return np.interp(at, cycles, np.asarray(values, dtype=np.float64), left=np.nan, right=np.nan)


def _shifted(output: Array, variable: Variable, axis: Axis, at: Array) -> Iterator[tuple[str, Array]]:
    """Yield an output of the engine whole cycles later and earlier."""
    friction = axis.of(Friction)
    most = min(SHIFT_MAX, len(at) // 4)
    for cycles in (*range(-most, 0), *range(1, most + 1)):
        text = f"the engine's output {abs(cycles)} cycle{'s'[: abs(cycles) - 1]} {'later' if cycles > 0 else 'earlier'}"
        if variable.quantity == "current" and friction is not None and friction.delay_cycles + cycles >= 0:
            text = f"delay_cycles {friction.delay_cycles + cycles} instead of {friction.delay_cycles}"
        yield text, _sampled(output, at - cycles)


def _places(trace: Trace, machine: Machine, bench: Bench, axis: int | None, row: int) -> str:
    """Return the setpoints in a row in words."""
    columns = {place: trace.inputs.columns.get(bench.names[place, "setpoint"]) for place in range(len(machine.axes))}
    shown_axes = (
        (machine.axes[k], column) for k, column in columns.items() if axis in (None, k) and column is not None
    )
    return ", ".join(f"{one.name} = {column[row]:.6g} {symbol(one.unit)}" for one, column in shown_axes)
