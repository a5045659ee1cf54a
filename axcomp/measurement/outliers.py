"""Readings that stand apart from their like: gross errors of an instrument or of a hand, not scatter.

Readings of one group (a target in one direction) differ by scatter alone, and by what a run has in common with itself.
So the residual of a reading is its distance from the median of its group, less the median of that over its run. The
scatter of all residuals is that which three quarters of them show, corrected for what medians of small groups take off.
A reading further off than ``LIMIT`` times that is an outlier; clean series of 100 normal readings hardly ever have one.
What is not found by it moves a mean of n ≥ 2 readings by less than twice its expanded uncertainty 2 σ/√n, for
6 σ/n < 4 σ/√n.

Groups of one or two readings do not tell which is wrong: both directions then count as one, less their median distance,
and of two readings the one nearer to the line through the neighbouring groups is the right one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..engine import Array

LIMIT = 6.0
"""Standard deviations a reading has to be off; of two alike 3.6 √2."""
ALONE = 10.0
"""The same where a group has one reading only: the error curve itself may have corners."""
FINEST = 0.1
"""Scatter below it, µm or ″, is not told from the resolution of a list."""

_QUARTILE = 1.1503
"""Standard deviations that three quarters of normal residuals are within."""
_OF_MEDIANS = {1: 1.0, 2: 0.69, 3: 0.79, 4: 0.80, 5: 0.89}
"""Scatter of so many normal readings around their median by that, relative to σ (simulated); beyond, 1 − 0.6/n."""
_RUN = 8
"""Readings of a run that tell what they have in common."""


@dataclass(frozen=True)
class Outlier:
    """A reading that stands apart.

    Attributes
    ----------
    place : int
        Its index among the readings.
    run : int
    at : str
        Where it was taken, for a sentence.
    size : float
        How far it is off its like, with sign, µm or ″.
    limit : float
        How far a reading may be.
    unit : str
    """

    place: int
    run: int
    at: str
    size: float
    limit: float
    unit: str = "µm"

    def __str__(self) -> str:
        return f"run {self.run}, {self.at}: {self.size:+.1f} {self.unit} off its like (limit {self.limit:.1f})"


def find_outliers(
    groups: npt.NDArray[np.int64],
    runs: npt.NDArray[np.int64],
    values: Array,
    named: Callable[[int], str],
    unit: str = "µm",
    *,
    over: Array | None = None,
) -> tuple[Outlier, ...]:
    """Return the outliers among readings, the largest first.

    Parameters
    ----------
    groups, runs : array of int, shape (n,)
        Readings of one group are of the same; what those of one run have in common does not count.
    values : array, shape (n,)
        In ``unit``.
    named : callable
        Says where the reading of an index was taken.
    unit : str
        Of the values.
    over : array, shape (n, 2), optional
        Curve that each reading belongs to, and where on it its group is; without it groups of less than three readings
        have no outliers.
    """
    found: list[Outlier] = []
    if over is not None and np.unique(groups, return_counts=True)[1].max() < 3:
        groups, values, over = _both_curves(groups, values, over)
    left = np.arange(len(values))
    while len(left) > 2:
        places = None if over is None else over[left]
        off, limits = _residuals(groups[left], runs[left], values[left], places)
        beyond = np.where(np.abs(off) > limits, np.abs(off), 0.0)
        worst = int(np.argmax(beyond))
        if not beyond[worst]:
            break
        # One at a time: a gross error moves what its like are compared with.
        i = int(left[worst])
        found.append(Outlier(i, int(runs[i]), named(i), float(off[worst]), float(limits[worst]), unit))
        left = np.delete(left, worst)
    return tuple(found)


def _residuals(
    groups: npt.NDArray[np.int64], runs: npt.NDArray[np.int64], values: Array, over: Array | None
) -> tuple[Array, Array]:
    """Return how far readings are off their like, and how far they may be."""
    _, group, counts = np.unique(groups, return_inverse=True, return_counts=True)
    size = counts[group]
    middle = np.array([np.median(values[group == g]) for g in range(len(counts))])
    residuals = _less_runs(values - middle[group], runs)
    many = size > 1
    limits = np.full(len(values), np.inf)
    if many.any():
        limits[many] = np.minimum(LIMIT, 3.6 * np.sqrt(size[many])) * _scatter(residuals[many], size[many], values)
    if over is None or not (size < 3).any():
        limits[size < 3] = np.inf
        return residuals, limits
    beside = _from_neighbours(group, middle, over)
    off = _less_runs(values - beside[group], runs)
    for g in np.flatnonzero(counts == 2):
        first, second = np.flatnonzero(group == g)
        apart = values[first] - values[second]
        better, worse = (second, first) if abs(off[first]) > abs(off[second]) else (first, second)
        # Half of what they are apart is its residual; the one nearer to the neighbours' line is the right one.
        residuals[worse], residuals[better] = (apart if worse == first else -apart) / np.sqrt(2.0), 0.0
    alone = (size == 1) & np.isfinite(off)
    if alone.sum() > 4:
        limits[alone] = ALONE * _scatter(off[alone], np.ones(int(alone.sum()), int), values)
        limits[_beside_a_larger(off, over, alone)] = np.inf
    return np.where(size == 1, np.nan_to_num(off), residuals), limits


def _both_curves(
    groups: npt.NDArray[np.int64], values: Array, over: Array
) -> tuple[npt.NDArray[np.int64], Array, Array]:
    """Return readings with both directions as one: less what these differ by in the median."""
    curves = np.unique(over[:, 0])
    if len(curves) != 2:
        return groups, values, over
    sides = [
        {x: np.median(values[here & (over[:, 1] == x)]) for x in np.unique(over[here, 1])}
        for here in (over[:, 0] == curve for curve in curves)
    ]
    both = [sides[1][x] - sides[0][x] for x in sides[0] if x in sides[1]]
    if not both:
        return groups, values, over
    merged = values - np.median(both) * (over[:, 0] == curves[1])
    place = np.unique(over[:, 1], return_inverse=True)[1].ravel()
    return place, merged, np.column_stack([np.zeros(len(over)), over[:, 1]])


def _less_runs(residuals: Array, runs: npt.NDArray[np.int64]) -> Array:
    """Return residuals without what those of a run have in common, where there are enough to tell."""
    found = residuals.copy()
    for run in np.unique(runs):
        mine = runs == run
        if mine.sum() >= _RUN and len(np.unique(runs)) > 1:
            found[mine] -= np.nanmedian(residuals[mine])
    return found


def _scatter(residuals: Array, sizes: npt.NDArray[np.int64], values: Array) -> float:
    """Return the robust standard deviation of readings from residuals of groups of these sizes."""
    shrunk = np.array([_OF_MEDIANS.get(int(n), 1.0 - 0.6 / n) for n in sizes])
    steps = np.diff(np.unique(values))
    least = min(FINEST, float(steps.min())) if len(steps) else FINEST
    return max(float(np.quantile(np.abs(residuals) / shrunk, 0.75)) / _QUARTILE, least)


def _from_neighbours(group: npt.NDArray[np.int64], middle: Array, over: Array) -> Array:
    """Return for each group what its neighbours on the curve make expect there; nan where there are none."""
    expected = np.full(len(middle), np.nan)
    place = np.array([over[np.flatnonzero(group == g)[0]] for g in range(len(middle))])
    for curve in np.unique(place[:, 0]):
        mine = np.flatnonzero(place[:, 0] == curve)
        mine = mine[np.argsort(place[mine, 1])]
        at, y = place[mine, 1], middle[mine]
        for k, g in enumerate(mine):
            # The median of the lines through pairs of neighbours: one wrong neighbour does not matter.
            first = min(max(0, k - 2), max(0, len(mine) - 5))
            near = [i for i in range(first, min(len(mine), first + 5)) if i != k]
            lines = [y[i] + (y[j] - y[i]) * (at[k] - at[i]) / (at[j] - at[i]) for i in near for j in near if i < j]
            expected[g] = np.median(lines) if len(lines) > 2 else np.nan
    return expected


def _beside_a_larger(off: Array, over: Array, alone: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Tell of which readings a neighbour within two on the curve is further off: that one is to blame."""
    found = np.zeros(len(off), dtype=bool)
    for curve in np.unique(over[alone, 0]):
        mine = np.flatnonzero(alone & (over[:, 0] == curve))
        mine = mine[np.argsort(over[mine, 1])]
        for k, i in enumerate(mine):
            near = [j for j in mine[max(0, k - 2) : k + 3] if j != i]
            found[i] = any(abs(off[j]) > abs(off[i]) for j in near)
    return found
