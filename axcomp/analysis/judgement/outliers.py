"""Outliers: a single point far off its neighbours, as a slip of the keyboard or a disturbed measurement leaves it.

Three straight lines say where a point should be: through its neighbours on both sides, on from the two before it, and
on from the two behind it. A smooth curve lies on different sides of the first and of the others, a kink or a step
agrees with one of them; only a single point is off all three to the same side. By how much counts is decided against
the ordinary distance from the neighbours, the median over the table (robust: outliers do not change it).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ...lists.findings import Findings
from ...model.machine import Machine
from .curves import PER_MILLE, PLANE_ENTRY, Array, Curve, Grid, curves_of, grids_of, thousandth_of, unit_of
from .positions import Positions

Indices = npt.NDArray[np.intp]

JUDGED_LEAST = 7
"""Points with neighbours on both sides that are needed: an outlier is in three distances of the median."""
SIGMAS = 6.0
"""Distance from the neighbours that makes an outlier, in standard deviations by the median."""
SIGMA_OF_MEDIAN = 1.4826
"""Standard deviation of a normal distribution over the median of its absolute values."""
RESOLUTION = 1e-4
"""Of the lists, mm or °; ordinary distances are not taken for less."""


class Spikes(NamedTuple):
    """How far points are off their neighbours; NaN where that cannot be told.

    Attributes
    ----------
    distance : array
        From the line through the neighbours on both sides, in the unit of the values, with sign.
    score : array
        The least of the three distances, 0 where they do not agree in sign.
    ordinary : float
        Standard deviation of ``distance`` by its median, at least ``RESOLUTION``.
    """

    distance: Array
    score: Array
    ordinary: float

    @property
    def found(self) -> npt.NDArray[np.bool_]:
        """Return whether each point is an outlier."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self.score > SIGMAS * self.ordinary)


def spikes(x: Array, y: Array, period: float | None = None) -> Spikes:
    """Return how far each point of a table is off its neighbours.

    Parameters
    ----------
    x : array, shape (n,)
        Positions, ascending.
    y : array, shape (n, ...)
        Values.
    period : float or None
        The table repeats after it, so that the first and the last points have neighbours on both sides; ``x`` then
        holds no point twice. None: the first two and the last two points are not judged.
    """
    if period is not None:
        x = np.concatenate([x[-2:] - period, x, x[:2] + period])
        y = np.concatenate([y[-2:], y, y[:2]])
    n = len(x)
    distance, score = np.full(y.shape, np.nan), np.full(y.shape, np.nan)
    at = np.arange(2, n - 2)
    if len(at) >= JUDGED_LEAST:
        lines = np.stack(
            [y[at] - _line(x, y, a, b, at) for a, b in ((at - 1, at + 1), (at - 2, at - 1), (at + 1, at + 2))]
        )
        agree = np.abs(np.sign(lines).sum(axis=0)) == len(lines)
        score[at] = np.where(agree, np.abs(lines).min(axis=0), 0.0)
        distance[at] = lines[0]
    known = np.abs(distance[~np.isnan(distance)])
    ordinary = max(SIGMA_OF_MEDIAN * float(np.median(known)) if known.size else 0.0, RESOLUTION)
    if period is not None:
        distance, score = distance[2:-2], score[2:-2]
    return Spikes(distance, score, ordinary)


def _line(x: Array, y: Array, a: Indices, b: Indices, at: Indices) -> Array:
    """Return the values at the places ``at`` of the straight lines through the points ``a`` and ``b``."""
    share = ((x[at] - x[a]) / (x[b] - x[a])).reshape(-1, *(1,) * (y.ndim - 1))
    value: Array = y[a] + share * (y[b] - y[a])
    return value


def judge_outliers(machine: Machine, positions: Positions, findings: Findings) -> None:
    """Note the outliers of all leadscrew, cross and plane tables."""
    for curve in curves_of(machine):
        for index, distance, ordinary in _of_curve(curve):
            unit = thousandth_of(curve.axis)
            # As it stands in the list: leadscrew values are subtracted.
            sign = -1.0 if curve.kind == "leadscrew" else 1.0
            value = sign * PER_MILLE * curve.values[index]
            at = f"{curve.positions[index]:g} {unit_of(curve.over)}"
            message = (
                f"The value {value:.1f} {unit} at {at} is {_off(sign * distance, ordinary, unit)} in {curve.name}."
            )
            position = positions.of_table(curve.axis.number, curve.entry, index)
            findings.add("AXC-OUTLIER", *position, message)
    for grid in grids_of(machine):
        for row, column, distance, ordinary in _of_grid(grid):
            unit = thousandth_of(grid.axis)
            at = (
                f"{grid.first.name} = {grid.across[column]:g} {unit_of(grid.first)}, "
                f"{grid.second.name} = {grid.up[row]:g} {unit_of(grid.second)}"
            )
            value = PER_MILLE * grid.values[row, column]
            message = f"The value {value:.1f} {unit} at {at} is {_off(distance, ordinary, unit)} in {grid.name}."
            position = positions.of_table(grid.axis.number, PLANE_ENTRY, row, column)
            findings.add("AXC-OUTLIER", *position, message)


def _off(distance: float, ordinary: float, unit: str) -> str:
    usual = PER_MILLE * ordinary
    return f"{PER_MILLE * distance:+.1f} {unit} off its neighbours, where ±{usual:.1f} {unit} is ordinary"


def _of_curve(curve: Curve) -> Iterator[tuple[int, float, float]]:
    x, y, period = curve.positions, curve.values, curve.table.period
    if period is not None:
        # The last one repeats the first one.
        x, y = x[:-1], y[:-1]
    found = spikes(x, y, period)
    for index in np.flatnonzero(found.found).tolist():
        yield index, float(found.distance[index]), found.ordinary


def _of_grid(grid: Grid) -> Iterator[tuple[int, int, float, float]]:
    """Yield row and column of points that are off along both sides; near an edge only one side can tell."""
    along = spikes(grid.up, grid.values)
    across = spikes(grid.across, grid.values.T)
    found = np.ones(grid.values.shape, dtype=bool)
    known = np.zeros(grid.values.shape, dtype=bool)
    for one, turned in ((along, False), (across, True)):
        score, is_spike = (one.score.T, one.found.T) if turned else (one.score, one.found)
        found &= is_spike | np.isnan(score)
        known |= ~np.isnan(score)
    for row, column in np.argwhere(found & known).tolist():
        distances = [along.distance[row, column], across.distance[column, row]]
        nearest = int(np.nanargmin(np.abs(distances)))
        yield row, column, float(distances[nearest]), (along, across)[nearest].ordinary
