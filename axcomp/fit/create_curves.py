"""Leadscrew and cross compensations from positioning measurements: tables over one position."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..measurement.iso230 import SYMBOLS, evaluate
from ..measurement.positioning import Positioning
from ..model.machine import Cross, Leadscrew
from ..plot.style import DOWN, UP
from .creation import (
    LEFT_OUT,
    MEASURED,
    PREDICTED,
    THOUSANDTHS,
    CannotCreateError,
    Creation,
    Options,
    chosen_points,
    leave_one_run_out,
    rounded,
)
from .target_list import TargetList

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DIRECTIONS = (1, -1)
FULL_TURN = 360.0
_SPAN_TOLERANCE = 1e-6
SHOWN = {
    **{name: SYMBOLS[name] for name in ("A", "A_up", "A_down", "E", "E_up", "E_down", "R", "M", "B", "B_mean")},
    "largest": "largest reading",
}


@dataclass(frozen=True, eq=False)
class Curves:
    """A table over one position, for each direction.

    Attributes
    ----------
    positions : array, shape (m,)
        Ascending, mm or °.
    values : array, shape (2, m)
        In positive and in negative direction, µm or 0.001°.
    period : float or None
        Positions repeat after it.
    """

    positions: Array
    values: Array
    period: float | None = None

    def at(self, positions: Array, directions: npt.NDArray[np.int64]) -> Array:
        """Return the values at positions; outside the end values hold."""
        up, down = (np.interp(positions, self.positions, side, period=self.period) for side in self.values)
        result: Array = np.where(directions > 0, up, down)
        return result


def create_leadscrew(measurement: Positioning, target: TargetList, options: Options | None = None) -> Creation:
    """Make a leadscrew table: actual − programmed, as the controller subtracts it.

    Both directions measured give a bilateral table. Positions are those of the measurement, thinned where the list does
    not take so many or a bound allows fewer.

    Raises
    ------
    CannotCreateError
        The measurement does not suffice, or the table does not fit.
    """
    options = options or Options()
    target.check_unit(measurement.unit)
    period = _period(target)
    both = not options.one_sided and set(measurement.directions) == set(DIRECTIONS)
    before = target.present("leadscrew") if options.on_top else None
    if options.on_top and before is None:
        raise CannotCreateError("no leadscrew compensation of this axis acts, so nothing can be put on top of it")
    old = None
    if before is not None:
        sides = (before.positive, before.negative or before.positive)
        old = Curves(np.array(before.positions), np.array(sides) * THOUSANDTHS, period if before.modulo else None)
    capacity = options.max_points or target.capacity("kw.ssfk.max_points")

    def make(readings: Positioning) -> Curves:
        positions, means = _means(readings, both)
        if period is not None:
            means = _closed(positions, means, period)
        return _table(Curves(positions, means, period), old, capacity, options.bound, measurement.deviation_unit)

    table = make(measurement)
    if table.period is not None and np.ptp(table.positions) > table.period + _SPAN_TOLERANCE:
        raise CannotCreateError(f"a modulo table spans {table.period:g}° at most, not {np.ptp(table.positions):g}°")
    up, down = (tuple(side.tolist()) for side in rounded(table.values / THOUSANDTHS))
    compensation = Leadscrew(tuple(table.positions.tolist()), up, down if both else None)
    return _creation(compensation, measurement, target, options, make, old, capacity)


def create_cross(measurement: Positioning, target: TargetList, options: Options | None = None) -> Creation:
    """Make a cross table: minus the deviation of the slave, whose list it is, over the position of the master.

    Targets are positions of the master. The table knows no direction: what differs by direction is left.

    Raises
    ------
    CannotCreateError
        The measurement does not suffice, the master is not known, or the table does not fit.
    """
    options = options or Options()
    target.check_unit(measurement.deviating_unit or measurement.unit)
    master = options.masters[0] or target.values.integer("kw.crosscomp.master_ax_nr")
    if not master:
        raise CannotCreateError("the list does not say which axis is the master (kw.crosscomp.master_ax_nr)")
    before = target.present("cross") if options.on_top else None
    if options.on_top and before is None:
        raise CannotCreateError("no cross compensation of this axis acts, so nothing can be put on top of it")
    old = None
    if before is not None:
        # Curves hold errors, the list corrections.
        old = Curves(np.array(before.positions), np.tile(before.corrections, (2, 1)) * -THOUSANDTHS)
    capacity = options.max_points or target.capacity("kw.crosscomp.max_points")

    def make(readings: Positioning) -> Curves:
        positions, means = _means(readings, both=False)
        return _table(Curves(positions, means), old, capacity, options.bound, measurement.deviation_unit)

    table = make(measurement)
    corrections = rounded(-table.values[0] / THOUSANDTHS)
    compensation = Cross(master, tuple(table.positions.tolist()), tuple(corrections.tolist()))
    return _creation(compensation, measurement, target, options, make, old, capacity)


def _period(target: TargetList) -> float | None:
    """Return the modulo range where the list's table repeats with it."""
    if not target.values.flag("kw.ssfk.modulo"):
        return None
    modulo = None if target.axis is None else target.axis.modulo
    return FULL_TURN if modulo is None else modulo.end - modulo.start


def _means(readings: Positioning, both: bool) -> tuple[Array, Array]:
    """Return targets (m,) and mean deviations (2, m) where there are enough readings."""
    result = evaluate(readings)
    positions = rounded(result.positions)
    if both:
        means = np.array([result.mean_up, result.mean_down])
    elif np.all(np.isnan(result.mean)):
        means = np.tile(np.where(np.isnan(result.mean_up), result.mean_down, result.mean_up), (2, 1))
    else:
        means = np.tile(result.mean, (2, 1))
    known = ~np.isnan(means).any(axis=0)
    positions, means = positions[known], means[:, known]
    if len(positions) == 0:
        raise CannotCreateError("no target was measured in every direction that is needed")
    if np.any(np.diff(positions) <= 0.0):
        raise CannotCreateError("there are targets less than 0.0001 apart, which a list cannot hold")
    return positions, means


def _closed(positions: Array, means: Array, period: float) -> Array:
    """Return means whose ends agree where they are the same place of a modulo axis."""
    if abs(positions[-1] - positions[0] - period) > _SPAN_TOLERANCE:
        return means
    means = means.copy()
    means[:, [0, -1]] = means[:, [0, -1]].mean(axis=1, keepdims=True)
    return means


def _table(measured: Curves, old: Curves | None, capacity: int, bound: float | None, unit: str) -> Curves:
    """Return what a list will hold: thinned, rounded, on top of an old table where there is one."""
    positions, values = measured.positions, measured.values
    if old is not None:
        positions = np.union1d(positions, rounded(old.positions))
        up, down = (np.full(len(positions), d) for d in DIRECTIONS)
        values = np.array([measured.at(positions, d) + old.at(positions, d) for d in (up, down)])
    places = chosen_points(positions, values, capacity, bound, unit)
    return Curves(positions[places], rounded(values[:, places] / THOUSANDTHS) * THOUSANDTHS, measured.period)


def _creation(
    compensation: Leadscrew | Cross,
    measurement: Positioning,
    target: TargetList,
    options: Options,
    make: Callable[[Positioning], Curves],
    old: Curves | None,
    capacity: int,
) -> Creation:
    kind = "leadscrew" if isinstance(compensation, Leadscrew) else "cross"

    def left(table: Curves, readings: Positioning) -> Array:
        removed = table.at(readings.targets, readings.directions)
        if old is not None:
            removed = removed - old.at(readings.targets, readings.directions)
        return readings.deviations - removed

    table = make(measurement)
    remaining = measurement.with_deviations(left(table, measurement))
    figures = {MEASURED: _figures(measurement), PREDICTED: _figures(remaining)}
    held_out = leave_one_run_out(
        measurement.runs, lambda some, others: left(make(measurement.only(some)), measurement.only(others))
    )
    notes = target.notes(kind)
    if held_out is not None:
        figures[LEFT_OUT] = _figures(measurement.with_deviations(held_out))
    else:
        notes.append("With one run there is no check by leaving runs out.")
    missing = len(measurement.grid()[0]) - len(_means(measurement, _is_bilateral(compensation))[0])
    if missing:
        notes.append(f"{missing} targets lack readings in a direction that is needed; they are left out.")
    if options.max_points is not None and target.exists:
        notes.append("A controller that runs refuses another max_points (110638, 110639): start it up anew.")
    return Creation(
        kind=kind,
        compensation=compensation,
        path=target.path,
        data=target.with_compensation(kind, compensation, options.max_points),
        points=len(table.positions),
        capacity=capacity,
        deviation=_deviation(table, old, measurement, _is_bilateral(compensation)),
        unit=measurement.deviation_unit,
        figures=figures,
        labels=SHOWN,
        notes=tuple(notes),
        draw=lambda ax: _draw(ax, measurement, remaining, table, kind),
    )


def _figures(measurement: Positioning) -> dict[str, float]:
    return {**evaluate(measurement).parameters(), "largest": float(np.max(np.abs(measurement.deviations)))}


def _is_bilateral(compensation: Leadscrew | Cross) -> bool:
    return isinstance(compensation, Leadscrew) and compensation.negative is not None


def _deviation(table: Curves, old: Curves | None, measurement: Positioning, both: bool) -> float:
    """Return how far a table is from the means it was made of, at most."""
    positions, means = _means(measurement, both)
    if table.period is not None:
        means = _closed(positions, means, table.period)
    worst = 0.0
    for side, direction in zip(means, DIRECTIONS, strict=True):
        directions = np.full(len(positions), direction)
        wanted = side if old is None else side + old.at(positions, directions)
        worst = max(worst, float(np.max(np.abs(table.at(positions, directions) - wanted))))
    return worst


def _draw(ax: Axes, measurement: Positioning, remaining: Positioning, table: Curves, kind: str) -> None:
    """Draw mean deviations, the table's points and what is left."""
    before, after = evaluate(measurement), evaluate(remaining)
    for colour, arrow, old, new in (
        (UP, "↑", before.mean_up, after.mean_up),
        (DOWN, "↓", before.mean_down, after.mean_down),
    ):
        if not np.all(np.isnan(old)):
            ax.plot(before.positions, old, "-", color=colour, lw=1.3, label=f"measured x̄{arrow}")
            ax.plot(before.positions, new, "--", color=colour, lw=1.1, label=f"predicted x̄{arrow}")
    sides = table.values if np.ptp(table.values, axis=0).any() else table.values[:1]
    for place, side in enumerate(sides):
        label = "table" if kind == "leadscrew" else "table × (−1)"
        ax.plot(table.positions, side, ".", color="0.2", ms=5, label=None if place else label)
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    ax.set_xlabel(f"position [{'mm' if measurement.unit == 'mm' else '°'}]", fontsize=11)
    ax.set_ylabel(f"deviation [{measurement.deviation_unit}]", fontsize=11)
    ax.grid(visible=True, color="0.9", lw=0.7)
    ax.legend(loc="best", ncols=2, fontsize=10)
