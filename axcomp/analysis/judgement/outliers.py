"""Outliers: a single point far off its neighbours, as a slip of the keyboard or a disturbed measurement leaves it.

Three straight lines say where a point should be: through its neighbours on both sides, on from the two before it, and
on from the two behind it. A smooth curve lies on different sides of the first and of the others, a kink or a step
agrees with one of them; only a single point is off all three to the same side. By how much counts is decided against
the ordinary distance from the neighbours, the median over the table (robust: outliers do not change it).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

from ...kinds import tables_of
from ...lists import Findings
from ...model import Curve, Grid, Machine, Quantity
from .judgement import JUDGED_LEAST
from .positions import Positions

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

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
    distance : list of float
        From the line through the neighbours on both sides, in the unit of the values, with sign.
    score : list of float
        The least of the three distances, 0 where they do not agree in sign.
    ordinary : float
        Standard deviation of ``distance`` by its median, at least ``RESOLUTION``.
    """

    distance: list[float]
    score: list[float]
    ordinary: float

    def is_spike(self, index: int) -> bool:
        """Tell whether a point is an outlier."""
        return self.score[index] > SIGMAS * self.ordinary

    @property
    def found(self) -> npt.NDArray[np.bool_]:
        """Whether each point is an outlier, shape (n,)."""
        import numpy as np

        return np.array([self.is_spike(index) for index in range(len(self.score))])


def spikes(x: Sequence[float], y: Sequence[float], period: float | None = None) -> Spikes:
    """Return how far each point x, ascending, of a table with values y is off its neighbours.

    With a ``period`` the first and the last points have neighbours on both sides, and ``x`` holds no point twice;
    without one the first two and the last two points are not judged.
    """
    return _spikes(x, [y], period)[0]


def _spikes(x: Sequence[float], rows: Sequence[Sequence[float]], period: float | None = None) -> list[Spikes]:
    """Return the same for several rows of values over the same points, which share what is ordinary."""
    around = 0 if period is None else 2
    places = list(x)
    if period is not None:
        places = [*(place - period for place in places[-2:]), *places, *(place + period for place in places[:2])]
    n = len(places)
    # Where between its neighbours, and how far beyond the two before or behind it, each point lies.
    shares = [
        ((d[2] - d[1]) / (d[3] - d[1]), (d[2] - d[0]) / (d[1] - d[0]), (d[2] - d[3]) / (d[4] - d[3]))
        for d in (places[i - 2 : i + 3] for i in range(2, n - 2))
        if n >= JUDGED_LEAST
    ]
    found = []
    for row in rows:
        values = [*row[len(row) - around :], *row, *row[:around]]
        distance, score = [math.nan] * n, [math.nan] * n
        for i, (middle, on, back) in enumerate(shares, 2):
            a, b, y, c, d = values[i - 2 : i + 3]
            lines = (y - b - middle * (c - b), y - a - on * (b - a), y - c - back * (d - c))
            low, high = min(lines), max(lines)
            # All three see an outlier as it is; beside one, the lines that run through it see it and the third not.
            least, most = (low, high) if low > 0.0 else (-high, -low)
            distance[i] = lines[0]
            score[i] = least if least > 0.0 and least >= most / 4.0 else 0.0
        found.append((distance[around : n - around], score[around : n - around]))
    known = [abs(value) for distance, _ in found for value in distance if not math.isnan(value)]
    ordinary = max(SIGMA_OF_MEDIAN * median(known) if known else 0.0, RESOLUTION)
    return [Spikes(distance, score, ordinary) for distance, score in found]


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
    x, y = curve.x, curve.y
    if curve.period is not None and curve.closed() is curve:
        # The last one repeats the first one.
        x, y = x[:-1], y[:-1]
    found = spikes(x, y, curve.period)
    yield from ((i, found.distance[i], found.ordinary) for i in range(len(x)) if found.is_spike(i))


def _of_grid(grid: Grid) -> Iterator[tuple[int, int, float, float]]:
    """Yield row and column of points that are off along both sides; near an edge only one side can tell."""
    columns = _spikes(grid.y, list(zip(*grid.values, strict=True)))
    for row, across in enumerate(_spikes(grid.x, grid.values)):
        for column, along in enumerate(columns):
            sides = [
                (spikes, at) for spikes, at in ((along, row), (across, column)) if not math.isnan(spikes.score[at])
            ]
            if sides and all(spikes.is_spike(at) for spikes, at in sides):
                nearest, at = min(sides, key=lambda side: abs(side[0].distance[side[1]]))
                yield row, column, nearest.distance[at], nearest.ordinary
