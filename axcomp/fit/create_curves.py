"""Leadscrew and cross compensations from positioning measurements: tables over one position."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ..engine.motion import Array
from ..kinds import Cross, Leadscrew
from ..measurement.iso230 import SYMBOLS, evaluate
from ..measurement.positioning import Positioning
from ..model.curve import Curve
from ..model.quantity import Quantity, shown, symbol
from ..plot.style import DOWN, UP, labelled
from .creation import (
    LEFT_OUT,
    MEASURED,
    PREDICTED,
    CannotCreateError,
    Creation,
    Options,
    chosen_points,
    leave_one_run_out,
    listed,
    lost_by_rounding,
    put_on_top,
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


Sides = tuple[Curve, Curve]
"""Errors over one position in positive and in negative direction, µm or ″."""


def _sides(positions: Array, values: Array, deviating: str, period: float | None = None) -> Sides:
    """Return errors (2, m), in µm or ″, of an axis that counts in ``deviating``; outside the end values hold."""
    if period is not None and np.ptp(positions) > period + _SPAN_TOLERANCE:
        raise CannotCreateError(f"a modulo table spans {period:g}° at most, not {np.ptp(positions):g}°")
    over, of = Quantity("position", "mm or °"), Quantity("error", shown(deviating).unit)
    x = tuple(positions.tolist())
    up, down = (Curve(x, tuple(side), over, of, period) for side in values.tolist())
    return up, down


def _at(sides: Sides, readings: Positioning) -> Array:
    """Return the errors at readings, of the direction of each."""
    up, down = (side.at(readings.targets) for side in sides)
    return np.where(readings.directions > 0, up, down)


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
    before = put_on_top(target, "leadscrew", options)
    old, factor = None, shown(measurement.deviating).factor
    if before is not None:
        values = factor * np.array((before.positive, before.negative or before.positive))
        old = _sides(np.array(before.positions), values, measurement.deviating, period if before.modulo else None)
    capacity = options.max_points or target.capacity("kw.ssfk.max_points")

    def make(readings: Positioning) -> Sides:
        positions, means = _means(readings, both)
        if period is not None:
            means = _closed(positions, means, period)
        measured = _sides(positions, means, measurement.deviating, period)
        return _table(measured, old, capacity, options.bound, measurement)

    table = make(measurement)
    up, down = (tuple(rounded(np.array(side.y) / factor).tolist()) for side in table)
    compensation = Leadscrew(table[0].x, up, down if both else None)
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
    before = put_on_top(target, "cross", options)
    old, factor = None, shown(measurement.deviating).factor
    if before is not None:
        # Curves hold errors, the list corrections.
        values = -factor * np.tile(before.corrections, (2, 1))
        old = _sides(np.array(before.positions), values, measurement.deviating)
    capacity = options.max_points or target.capacity("kw.crosscomp.max_points")

    def make(readings: Positioning) -> Sides:
        positions, means = _means(readings, both=False)
        return _table(_sides(positions, means, measurement.deviating), old, capacity, options.bound, measurement)

    table = make(measurement)
    corrections = rounded(-np.array(table[0].y) / factor)
    compensation = Cross(master, table[0].x, tuple(corrections.tolist()))
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


def _table(measured: Sides, old: Sides | None, capacity: int, bound: float | None, measurement: Positioning) -> Sides:
    """Return what a list will hold: thinned, rounded, on top of an old table where there is one."""
    positions, values = np.array(measured[0].x), np.array([side.y for side in measured])
    if old is not None:
        positions = np.union1d(positions, rounded(np.array(old[0].x)))
        values = np.array([side.at(positions) for side in measured]) + [side.at(positions) for side in old]
    unit = measurement.deviating
    chosen = chosen_points(positions, values, capacity, bound, measurement.deviation_unit, lost_by_rounding(unit))
    return _sides(positions[chosen], listed(values[:, chosen], unit), unit, measured[0].period)


def _creation(
    compensation: Leadscrew | Cross,
    measurement: Positioning,
    target: TargetList,
    options: Options,
    make: Callable[[Positioning], Sides],
    old: Sides | None,
    capacity: int,
) -> Creation:
    kind = "leadscrew" if isinstance(compensation, Leadscrew) else "cross"

    def left(table: Sides, readings: Positioning) -> Array:
        removed = _at(table, readings)
        if old is not None:
            removed = removed - _at(old, readings)
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
        points=len(table[0].x),
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


def _deviation(table: Sides, old: Sides | None, measurement: Positioning, both: bool) -> float:
    """Return how far a table is from the means it was made of, at most."""
    positions, means = _means(measurement, both)
    if table[0].period is not None:
        means = _closed(positions, means, table[0].period)
    wanted = means if old is None else means + [side.at(positions) for side in old]
    return float(np.max(np.abs(np.array([side.at(positions) for side in table]) - wanted)))


def _draw(ax: Axes, measurement: Positioning, remaining: Positioning, table: Sides, kind: str) -> None:
    """Draw mean deviations, the table's points and what is left."""
    before, after = evaluate(measurement), evaluate(remaining)
    for colour, arrow, old, new in (
        (UP, "↑", before.mean_up, after.mean_up),
        (DOWN, "↓", before.mean_down, after.mean_down),
    ):
        if not np.all(np.isnan(old)):
            ax.plot(before.positions, old, "-", color=colour, lw=1.3, label=f"measured x̄{arrow}")
            ax.plot(before.positions, new, "--", color=colour, lw=1.1, label=f"predicted x̄{arrow}")
    for place, side in enumerate(table if table[0].y != table[1].y else table[:1]):
        label = "table" if kind == "leadscrew" else "table × (−1)"
        ax.plot(side.x, side.y, ".", color="0.2", ms=5, label=None if place else label)
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    labelled(ax, "", f"position [{symbol(measurement.unit)}]", f"deviation [{measurement.deviation_unit}]")
    ax.legend(loc="best", ncols=2, fontsize=10)
