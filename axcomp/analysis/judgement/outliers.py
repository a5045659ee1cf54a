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

from ...engine import Array
from ...kinds import tables_of
from ...lists import Findings
from ...model import Curve, Grid, Machine, Quantity
from .judgement import JUDGED_LEAST
from .positions import Positions

Indices = npt.NDArray[np.intp]

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
    """Return how far each point x (n,), ascending, of a table with values y (n, …) is off its neighbours.

    With a ``period`` the first and the last points have neighbours on both sides, and ``x`` holds no point twice;
    without one the first two and the last two points are not judged.
    """
    if period is not None:
        x = np.concatenate([x[-2:] - period, x, x[:2] + period])
        y = np.concatenate([y[-2:], y, y[:2]])
    n = len(x)
    distance, score = np.full(y.shape, np.nan), np.full(y.shape, np.nan)
    at = np.arange(2, n - 2)
    if n >= JUDGED_LEAST:
        pairs = ((at - 1, at + 1), (at - 2, at - 1), (at + 1, at + 2))
        lines = np.stack([y[at] - _line(x, y, a, b, at) for a, b in pairs])
        size = np.abs(lines)
        # All three see an outlier as it is; beside one, the lines that run through it see it and the third does not.
        agree = (np.abs(np.sign(lines).sum(axis=0)) == len(lines)) & (size.min(axis=0) >= size.max(axis=0) / 4.0)
        score[at] = np.where(agree, size.min(axis=0), 0.0)
        distance[at] = lines[0]
    known = np.abs(distance[~np.isnan(distance)])
    ordinary = max(SIGMA_OF_MEDIAN * float(np.median(known)) if known.size else 0.0, RESOLUTION)
    if period is not None:
        distance, score = distance[2:-2], score[2:-2]
    return Spikes(distance, score, ordinary)


def _line(x: Array, y: Array, a: Indices, b: Indices, at: Indices) -> Array:
    """Return the values at the points ``at`` of the straight lines through the points ``a`` and ``b``."""
    share = ((x[at] - x[a]) / (x[b] - x[a])).reshape(-1, *(1,) * (y.ndim - 1))
    value: Array = y[a] + share * (y[b] - y[a])
    return value


def judge_outliers(machine: Machine, positions: Positions, findings: Findings) -> None:
    """Note the outliers of all tables over positions; values are said as they stand in the list."""
    for tables in tables_of(machine):
        number = tables.axis.number
        for curve in tables.curves:
            for index, distance, ordinary in _of_curve(curve):
                at = f"{curve.x[index]:g} {curve.over.unit}"
                message = _message(curve.y[index], at, distance, ordinary, curve.of, tables.named(curve))
                findings.add("AXC-OUTLIER", *positions.of_table(number, curve.entry, index), message)
        for grid in tables.grids:
            for row, column, distance, ordinary in _of_grid(grid):
                sides = zip(grid.over, (grid.x[column], grid.y[row]), strict=True)
                at = ", ".join(f"{over.axis} = {position:g} {over.unit}" for over, position in sides)
                message = _message(grid.values[row][column], at, distance, ordinary, grid.of, tables.name)
                findings.add("AXC-OUTLIER", *positions.of_table(number, grid.entry, row, column), message)


def _message(value: float, at: str, distance: float, ordinary: float, of: Quantity, name: str) -> str:
    factor, unit = of.factor, of.scaled().unit
    return (
        f"The value {factor * value:.1f} {unit} at {at} is {factor * distance:+.1f} {unit} off its neighbours, "
        f"where ±{factor * ordinary:.1f} {unit} is ordinary in {name}."
    )


def _of_curve(curve: Curve) -> Iterator[tuple[int, float, float]]:
    x, y = np.array(curve.x), np.array(curve.y)
    if curve.period is not None and curve.closed() is curve:
        # The last one repeats the first one.
        x, y = x[:-1], y[:-1]
    found = spikes(x, y, curve.period)
    for index in np.flatnonzero(found.found).tolist():
        yield index, float(found.distance[index]), found.ordinary


def _of_grid(grid: Grid) -> Iterator[tuple[int, int, float, float]]:
    """Yield row and column of points that are off along both sides; near an edge only one side can tell."""
    values = np.array(grid.values)
    along, across = spikes(np.array(grid.y), values), spikes(np.array(grid.x), values.T)
    found, known = np.ones(values.shape, dtype=bool), np.zeros(values.shape, dtype=bool)
    for one, turned in ((along, False), (across, True)):
        score, is_spike = (one.score.T, one.found.T) if turned else (one.score, one.found)
        found &= is_spike | np.isnan(score)
        known |= ~np.isnan(score)
    for row, column in np.argwhere(found & known).tolist():
        distances = [along.distance[row, column], across.distance[column, row]]
        nearest = int(np.nanargmin(np.abs(distances)))
        yield row, column, float(distances[nearest]), (along, across)[nearest].ordinary
