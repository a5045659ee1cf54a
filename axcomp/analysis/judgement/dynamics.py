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
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ...engine import Array
from ...kinds import Tables, tables_of
from ...lists import Findings
from ...model import CYCLE_TIME, Axis, Machine, shown, symbol
from .positions import Positions, sentence

if TYPE_CHECKING:
    from matplotlib.axes import Axes


Shape: TypeAlias = tuple[Array, Array, Array, Array, Array]


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


@dataclass(frozen=True)
class Ramp:
    """A correction of some mm or ° that comes or goes over some cycles (of ``cycle_time`` s) by sin²."""

    size: float
    cycles: int
    cycle_time: float

    @property
    def velocity(self) -> float:
        """Largest velocity, mm/s or °/s."""
        return self.size * ramp_rates(self.cycles)[0] / self.cycle_time

    @property
    def acceleration(self) -> float:
        """Largest acceleration, mm/s² or °/s²."""
        return self.size * ramp_rates(self.cycles)[1] / self.cycle_time**2


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
    x : array, shape (n + 1,)
        Points of the table, mm or °.
    slopes : array, shape (n,)
        Of what is added in each interval; of several rows or directions the size of the largest.
    kinks : array, shape (n,) or (n + 2,)
        Largest change of the slope between one interval and the next.
    kinks_at : array, shape as kinks
        Where.
    curvatures : array, shape as kinks
        Change of the slope over the distance between the middles of both intervals, 1/mm or 1/°.
    jump : Ramp
        The largest correction, which switching makes; a plane's stands with its first master.
    reversal : Ramp
        The largest difference of the directions, 0 for tables without.
    cycle_time : float
        s.
    """

    name: str
    axis: Axis
    over: Axis
    entry: str
    feed: float
    x: Array
    slopes: Array
    kinks: Array
    kinks_at: Array
    curvatures: Array
    jump: Ramp
    reversal: Ramp
    cycle_time: float

    @property
    def steepest(self) -> int:
        """Index of the interval with the largest slope."""
        return int(np.argmax(np.abs(self.slopes)))

    @property
    def sharpest_at(self) -> float:
        """Where the largest kink is."""
        return float(self.kinks_at[np.argmax(self.kinks)])

    @property
    def slope(self) -> float:
        """Size of the largest slope."""
        return float(np.abs(self.slopes).max(initial=0.0))

    @property
    def added_velocity(self) -> float:
        """Slope · feed, mm/s or °/s."""
        return self.slope * self.feed

    @property
    def added_acceleration(self) -> float:
        """Δslope · feed / cycle time at the sharpest kink, mm/s² or °/s²."""
        return float(self.kinks.max(initial=0.0)) * self.feed / self.cycle_time

    @property
    def smooth_acceleration(self) -> float:
        """Curvature · feed², which a table of the same curvature without kinks would ask for."""
        return float(self.curvatures.max(initial=0.0)) * self.feed**2

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON, in mm or ° and s."""
        figures: dict[str, Any] = {
            "table": self.name,
            "axis": self.axis.name,
            "over": self.over.name,
            "feed": self.feed,
            "slope": self.slope,
            "kink": float(self.kinks.max(initial=0.0)),
            "curvature": float(self.curvatures.max(initial=0.0)),
        }
        for name in ("added_velocity", "added_acceleration", "smooth_acceleration"):
            figures[name] = getattr(self, name)
        for name, ramp in (("jump", self.jump), ("reversal", self.reversal)):
            figures |= {name: ramp.size, f"{name}_cycles": ramp.cycles}
            figures |= {f"{name}_velocity": ramp.velocity, f"{name}_acceleration": ramp.acceleration}
        return figures

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the slope over the position, with the velocity it adds; return the axes."""
        from ...plot import UP, labelled, new_figure

        ax = new_figure().add_subplot() if ax is None else ax
        unit, over = symbol(self.axis.unit), symbol(self.over.unit)
        small = shown(self.axis.unit)
        if len(self.slopes):
            ax.stairs(small.factor * self.slopes, self.x, color=UP, lw=1.5, baseline=None)
        ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
        if self.feed:
            factor = self.feed / small.factor
            scales = (lambda slope: np.asarray(slope) * factor, lambda velocity: np.asarray(velocity) / factor)
            second = ax.secondary_yaxis("right", functions=scales)
            second.set_ylabel(f"added velocity at {self.feed:g} {over}/s [{unit}/s]", fontsize=11)
        ax.set_axisbelow(True)
        x, y = f"position of {self.over.name} [{over}]", f"slope [{small.unit}/{over}]"
        return labelled(ax, f"{sentence(self.name)}: slope", x, y)


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
        for name, over, entry, shape, jump, reversal in _sides(tables):
            yield DynamicsResult(
                name,
                axis,
                machine.axis(over),
                entry,
                demand.of(demand.feed, over, 0.0),
                *shape,
                Ramp(jump, cycles, demand.cycle_time),
                Ramp(reversal, axis.backlash_cycles, demand.cycle_time),
                demand.cycle_time,
            )


def _sides(tables: Tables) -> Iterator[tuple[str, str, str, Shape, float, float]]:
    """Yield name, axis that moves, entry, shape, largest correction and reversal of a table, a plane's twice."""
    if tables.curves:
        sides = [curve.added().closed() for curve in tables.curves]
        first, rows = sides[0], np.array([side.y for side in sides])
        jump, reversal = float(np.abs(rows).max()), float(np.abs(rows[0] - rows[-1]).max())
        shape = _shape(np.array(first.x), rows, first.period is not None)
        yield tables.name, first.over.axis, first.entry, shape, jump, reversal
    for grid in tables.grids:
        values = np.array(grid.values)
        jumps = (float(np.abs(values).max()), 0.0)
        for along, x, rows, jump in zip(grid.over, (grid.x, grid.y), (values, values.T), jumps, strict=True):
            name = f"the {tables.kind} table of {tables.axis.name} along {along.axis}"
            yield name, along.axis, grid.entry, _shape(np.array(x), rows, False), jump, 0.0


def _shape(x: Array, rows: Array, repeats: bool) -> Shape:
    """Return points, slopes, kinks, their positions and curvatures of rows, (m, n) over n points: the largest of all.

    Where it repeats the last point is the first one again; else what lies outside is held, so the slope there is 0, and
    no curvature belongs to the kinks at the ends.
    """
    if len(x) < 2:
        nothing = np.empty(0)
        return x, nothing, nothing, nothing, nothing
    widths = np.diff(x)
    slopes = np.diff(rows) / widths
    if repeats:
        steps = np.diff(slopes, append=slopes[:, :1])
        kinks_at, distances = x[1:], 0.5 * (widths + np.roll(widths, -1))
    else:
        steps = np.diff(slopes, prepend=0.0, append=0.0)
        kinks_at, distances = x, np.concatenate([[np.inf], 0.5 * (widths[1:] + widths[:-1]), [np.inf]])
    kinks = np.abs(steps).max(axis=0)
    largest = slopes[0] if len(slopes) == 1 else np.abs(slopes).max(axis=0)
    return x, largest, kinks, kinks_at, kinks / distances


def judge_dynamics(machine: Machine, demand: Demand, positions: Positions, findings: Findings) -> list[DynamicsResult]:
    """Note and return what tables ask for: the figures at a feed, and whatever is beyond the limits."""
    results = list(dynamics_of(machine, demand))
    for result in results:
        position = positions.of_table(result.axis.number, result.entry)
        for code, message in _said(result, demand):
            findings.add(code, *position, message)
    return results


def _said(result: DynamicsResult, demand: Demand) -> Iterator[tuple[str, str]]:
    """Yield code and sentence of each finding."""
    unit, name, begin = symbol(result.axis.unit), result.axis.name, sentence(result.name)
    velocity_limit = demand.of(demand.velocity, name, math.inf)
    acceleration_limit = demand.of(demand.acceleration, name, math.inf)
    if result.feed and len(result.slopes):
        yield "AXC-DYNAMICS", f"{begin} {_asks(result)}."
        own = demand.of(demand.feed, name, 0.0)
        if own + result.added_velocity > velocity_limit:
            yield (
                "AXC-DYNAMICS-VELOCITY",
                f"{begin} adds {rate(result.added_velocity)} {unit}/s to the {own:g} {unit}/s of {name}: that is "
                f"above its {velocity_limit:g} {unit}/s.",
            )
        if result.added_acceleration > acceleration_limit:
            yield (
                "AXC-DYNAMICS-KINK",
                f"The kink at {result.sharpest_at:g} {symbol(result.over.unit)} of {result.name} asks {name} for "
                f"{rate(result.added_acceleration)} {unit}/s² within a cycle, above its "
                f"{acceleration_limit:g} {unit}/s².",
            )
    for what, ramp in (("Switching", result.jump), ("A reversal on", result.reversal)):
        above = [
            f"{rate(value)} {per}, above its {limit:g} {per}"
            for value, limit, per in (
                (ramp.velocity, velocity_limit, f"{unit}/s"),
                (ramp.acceleration, acceleration_limit, f"{unit}/s²"),
            )
            if value > limit
        ]
        if above:
            over = f"over {ramp.cycles} cycles" if ramp.cycles > 1 else "at once"
            factor, small = shown(result.axis.unit)
            moved = f"{factor * ramp.size:.1f} {small}"
            message = f"{what} {result.name} moves {name} by up to {moved} {over}: {', and '.join(above)}."
            yield "AXC-DYNAMICS-JUMP", message


def _asks(result: DynamicsResult) -> str:
    unit, over = symbol(result.axis.unit), symbol(result.over.unit)
    low, high = result.x[result.steepest : result.steepest + 2]
    factor, small = shown(result.axis.unit)
    return (
        f"adds up to {rate(result.added_velocity)} {unit}/s at {result.feed:g} {over}/s ({factor * result.slope:.3g} "
        f"{small}/{over} at {low:g} … {high:g} {over}) and, at the kink at {result.sharpest_at:g} {over}, "
        f"{rate(result.added_acceleration)} {unit}/s² within a cycle; its curvature without kinks would add "
        f"{rate(result.smooth_acceleration)} {unit}/s²"
    )
