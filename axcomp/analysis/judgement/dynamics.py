"""Dynamics: what a table asks of the drive of the axis it corrects, at a feed.

Along a table with slope s the axis gets ``s · feed`` in addition. Between two intervals the slope changes by Δs:
within one cycle T of the position controller the velocity changes by ``Δs · feed``, which is an acceleration of
``Δs · feed / T``; a table without kinks of the same curvature κ = Δs / distance would ask for ``κ · feed²``.
Switching a correction c over n cycles by sin² asks for ``c · Δw / T`` and ``c · Δ²w / T²``, with all of c at once for
n ≤ 1.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ...engine.motion import Array
from ...kinds import tables_of
from ...lists.findings import Findings
from ...model.machine import Axis, Machine
from ...model.quantity import shown, symbol
from .positions import Positions

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CYCLE_TIME = 1e-3


@dataclass(frozen=True)
class Demand:
    """How fast axes move and what they can do; for axes that are not named the value under "" holds.

    Attributes
    ----------
    feed : mapping of str to float
        By the axis' name, mm/s or °/s.
    velocity, acceleration : mapping of str to float
        Limits of axes, mm/s and mm/s² or °/s and °/s²; an axis without a limit is not judged by it.
    cycle_time : float
        Of the position controller, s.
    """

    feed: Mapping[str, float] = field(default_factory=dict)
    velocity: Mapping[str, float] = field(default_factory=dict)
    acceleration: Mapping[str, float] = field(default_factory=dict)
    cycle_time: float = CYCLE_TIME

    @staticmethod
    def of(values: Mapping[str, float], axis: str, default: float) -> float:
        """Return the value for an axis."""
        return values.get(axis, values.get("", default))


@dataclass(frozen=True, eq=False)
class DynamicsResult:
    """What a table asks for while one axis moves.

    Attributes
    ----------
    name : str
        The table in words.
    axis, over : Axis
        The axis that is corrected and the one that moves.
    entry : str
        Name of its entries in the list.
    feed : float
        Of the axis that moves, mm/s or °/s; 0: not given.
    intervals : array, shape (n, 2)
        Begin and end of the intervals, mm or °.
    slopes : array, shape (n,)
        Of what is added in each interval; of several rows or directions the size of the largest.
    kinks : array, shape (n − 1,) or (n,)
        Largest change of the slope between one interval and the next.
    kinks_at : array, shape as kinks
        Where.
    curvatures : array, shape as kinks
        Change of the slope over the distance between the middles of both intervals, 1/mm or 1/°.
    jump : float
        Largest correction that switching makes, mm or °; a plane's stands with its first master.
    jump_cycles : int
        Over so many cycles.
    reversal : float
        Largest difference of the directions, mm or °; 0 for tables without.
    reversal_cycles : int
        Over so many cycles.
    cycle_time : float
        s.
    """

    name: str
    axis: Axis
    over: Axis
    entry: str
    feed: float
    intervals: Array
    slopes: Array
    kinks: Array
    kinks_at: Array
    curvatures: Array
    jump: float
    jump_cycles: int
    reversal: float
    reversal_cycles: int
    cycle_time: float

    @property
    def steepest(self) -> int:
        """Index of the interval with the largest slope."""
        return int(np.argmax(np.abs(self.slopes)))

    @property
    def sharpest(self) -> int:
        """Index of the largest kink."""
        return int(np.argmax(self.kinks))

    @property
    def added_velocity(self) -> float:
        """Slope · feed, mm/s or °/s."""
        return float(np.abs(self.slopes).max(initial=0.0)) * self.feed

    @property
    def added_acceleration(self) -> float:
        """Δslope · feed / cycle time at the sharpest kink, mm/s² or °/s²."""
        return float(self.kinks.max(initial=0.0)) * self.feed / self.cycle_time

    @property
    def smooth_acceleration(self) -> float:
        """Curvature · feed², which a table of the same curvature without kinks would ask for."""
        return float(self.curvatures.max(initial=0.0)) * self.feed**2

    @property
    def jump_velocity(self) -> float:
        """Velocity of switching on or off."""
        return self.jump * ramp_rates(self.jump_cycles)[0] / self.cycle_time

    @property
    def jump_acceleration(self) -> float:
        """Acceleration of switching on or off."""
        return self.jump * ramp_rates(self.jump_cycles)[1] / self.cycle_time**2

    @property
    def reversal_velocity(self) -> float:
        """Velocity while the directions change over."""
        return self.reversal * ramp_rates(self.reversal_cycles)[0] / self.cycle_time

    @property
    def reversal_acceleration(self) -> float:
        """Acceleration while the directions change over."""
        return self.reversal * ramp_rates(self.reversal_cycles)[1] / self.cycle_time**2

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON, in mm or ° and s."""
        names = ["added_velocity", "added_acceleration", "smooth_acceleration"]
        names += ["jump", "jump_cycles", "jump_velocity", "jump_acceleration"]
        names += ["reversal", "reversal_cycles", "reversal_velocity", "reversal_acceleration"]
        head: dict[str, Any] = {"table": self.name, "axis": self.axis.name, "over": self.over.name, "feed": self.feed}
        return head | {
            "slope": float(np.abs(self.slopes).max(initial=0.0)),
            "kink": float(self.kinks.max(initial=0.0)),
            "curvature": float(self.curvatures.max(initial=0.0)),
            **{name: getattr(self, name) for name in names},
        }

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the slope over the position, with the velocity it adds; return the axes."""
        from .plots import plot_dynamics

        return plot_dynamics(self, ax)


def rate(value: float) -> str:
    """Return a velocity or an acceleration in words: four digits, never with an exponent where it is large."""
    return f"{value:.0f}" if abs(value) >= 1e3 else f"{value:.4g}"


def ramp_rates(cycles: int) -> tuple[float, float]:
    """Return the largest change of the weight sin²(π/2 · k/n) in a cycle, and the largest change of that change."""
    n = max(cycles, 1)
    weights = np.sin(0.5 * math.pi * np.arange(n + 1) / n) ** 2
    steps = np.concatenate([[0.0], np.diff(weights), [0.0]])
    return float(np.abs(steps).max()), float(np.abs(np.diff(steps)).max())


def dynamics_of(machine: Machine, demand: Demand) -> Iterator[DynamicsResult]:
    """Yield what each table over positions asks for, a plane's for either master."""
    for tables in tables_of(machine):
        axis, cycles = tables.axis, getattr(tables.compensation, "n_cycles", 0)
        if tables.curves:
            sides = [curve.added().closed() for curve in tables.curves]
            rows = np.array([side.y for side in sides])
            over = sides[0].over.axis
            yield DynamicsResult(
                tables.name,
                axis,
                machine.axis(over),
                sides[0].entry,
                demand.of(demand.feed, over, 0.0),
                *_shape(np.array(sides[0].x), rows, sides[0].period is not None),
                jump=float(np.abs(rows).max()),
                jump_cycles=cycles,
                reversal=float(np.abs(rows[0] - rows[-1]).max()),
                reversal_cycles=axis.backlash_cycles,
                cycle_time=demand.cycle_time,
            )
        for grid in tables.grids:
            values = np.array(grid.values)
            for place, (along, x) in enumerate(zip(grid.over, (grid.x, grid.y), strict=True)):
                yield DynamicsResult(
                    f"the {tables.kind} table of {axis.name} along {along.axis}",
                    axis,
                    machine.axis(along.axis),
                    grid.entry,
                    demand.of(demand.feed, along.axis, 0.0),
                    *_shape(np.array(x), values.T if place else values, False),
                    jump=0.0 if place else float(np.abs(values).max()),
                    jump_cycles=cycles,
                    reversal=0.0,
                    reversal_cycles=0,
                    cycle_time=demand.cycle_time,
                )


def _shape(x: Array, rows: Array, repeats: bool) -> tuple[Array, Array, Array, Array, Array]:
    """Return intervals, slopes, kinks, their places and curvatures; what lies outside is held, so the slope there is 0.

    Parameters
    ----------
    x : array, shape (n,)
        Points.
    rows : array, shape (m, n)
        Of each interval and kink the largest of all rows counts.
    repeats : bool
        The last point is the first one again.
    """
    if len(x) < 2:
        return np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0), np.empty(0)
    widths = np.diff(x)
    slopes = np.diff(rows) / widths
    inner = np.abs(np.diff(slopes))
    distance = 0.5 * (widths[1:] + widths[:-1])
    kinks, places, distances = inner, x[1:-1], distance
    if repeats:
        kinks = np.concatenate([inner, np.abs(slopes[:, :1] - slopes[:, -1:])], axis=1)
        places = x[1:]
        distances = np.append(distance, 0.5 * (widths[0] + widths[-1]))
    else:
        # Beyond the ends the slope is 0; no curvature belongs to these kinks.
        kinks = np.concatenate([np.abs(slopes[:, :1]), inner, np.abs(slopes[:, -1:])], axis=1)
        places = x
        distances = np.concatenate([[np.inf], distance, [np.inf]])
    largest = slopes[0] if len(slopes) == 1 else np.abs(slopes).max(axis=0)
    kink = kinks.max(axis=0)
    return np.column_stack([x[:-1], x[1:]]), largest, kink, places, kink / distances


def judge_dynamics(machine: Machine, demand: Demand, positions: Positions, findings: Findings) -> list[DynamicsResult]:
    """Note and return what tables ask for: the figures at a feed, and whatever is beyond the limits."""
    results = list(dynamics_of(machine, demand))
    for result in results:
        unit, name, size = symbol(result.axis.unit), result.axis.name, f"{result.name[0].upper()}{result.name[1:]}"
        position = positions.of_table(result.axis.number, result.entry, *([0] * result.entry.count("[")))
        velocity_limit = demand.of(demand.velocity, name, math.inf)
        acceleration_limit = demand.of(demand.acceleration, name, math.inf)
        if result.feed and len(result.slopes):
            findings.add("AXC-DYNAMICS", *position, f"{size} {_asks(result)}.")
            own = demand.of(demand.feed, name, 0.0)
            if own + result.added_velocity > velocity_limit:
                message = (
                    f"{size} adds {rate(result.added_velocity)} {unit}/s to the {own:g} {unit}/s of {name}: that is "
                    f"above its {velocity_limit:g} {unit}/s."
                )
                findings.add("AXC-DYNAMICS-VELOCITY", *position, message)
            if result.added_acceleration > acceleration_limit:
                at = f"{result.kinks_at[result.sharpest]:g} {symbol(result.over.unit)}"
                message = (
                    f"The kink at {at} of {result.name} asks {name} for {rate(result.added_acceleration)} {unit}/s² "
                    f"within a cycle, above its {acceleration_limit:g} {unit}/s²."
                )
                findings.add("AXC-DYNAMICS-KINK", *position, message)
        for what, jump, cycles, velocity, acceleration in (
            ("Switching", result.jump, result.jump_cycles, result.jump_velocity, result.jump_acceleration),
            (
                "A reversal on",
                result.reversal,
                result.reversal_cycles,
                result.reversal_velocity,
                result.reversal_acceleration,
            ),
        ):
            above = [
                f"{rate(value)} {per}, above its {limit:g} {per}"
                for value, limit, per in (
                    (velocity, velocity_limit, f"{unit}/s"),
                    (acceleration, acceleration_limit, f"{unit}/s²"),
                )
                if value > limit
            ]
            if above:
                over = f"over {cycles} cycles" if cycles > 1 else "at once"
                factor, small = shown(result.axis.unit)
                moved = f"{factor * jump:.1f} {small}"
                message = f"{what} {result.name} moves {name} by up to {moved} {over}: {', and '.join(above)}."
                findings.add("AXC-DYNAMICS-JUMP", *position, message)
    return results


def _asks(result: DynamicsResult) -> str:
    unit, over = symbol(result.axis.unit), symbol(result.over.unit)
    low, high = result.intervals[result.steepest]
    factor, small = shown(result.axis.unit)
    slope = factor * abs(result.slopes[result.steepest])
    at = f"{result.kinks_at[result.sharpest]:g} {over}"
    return (
        f"adds up to {rate(result.added_velocity)} {unit}/s at {result.feed:g} {over}/s ({slope:.3g} "
        f"{small}/{over} at {low:g} … {high:g} {over}) and, at the kink at {at}, "
        f"{rate(result.added_acceleration)} {unit}/s² within a cycle; its curvature without kinks would add "
        f"{rate(result.smooth_acceleration)} {unit}/s²"
    )
