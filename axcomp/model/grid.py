"""Values over two quantities: bilinear on a grid, or linear in triangles between scattered places."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from .delaunay import Triangulation, triangulate
from .quantity import Quantity

ON_EDGE = -1e-7
"""Barycentric coordinate of a place that rounding puts just outside a triangle."""

Place: TypeAlias = tuple[float, float]


@dataclass(frozen=True, repr=False)
class Grid:
    """Values on a grid: bilinear between the points, the edge held outside.

    Attributes
    ----------
    x, y : tuple of float
        Points along both quantities, strictly ascending, at least one each.
    values : tuple of tuple of float, shape (points of y, points of x)
    over : two Quantity
        Of ``x`` and of ``y``.
    of : Quantity
        Of the values.
    label, entry, note : str
        As those of ``Curve``; the entry is ``kw.crosscomp2.table[j][i].correction``.

    Examples
    --------
    >>> from axcomp import Grid
    >>> from axcomp.model import Quantity
    >>> x, y, z = (Quantity(name, "mm", axis) for name, axis in (("position", "X"), ("position", "Y"), ("error", "Z")))
    >>> Grid((0.0, 10.0), (0.0, 10.0), ((0.0, 1.0), (2.0, 3.0)), (x, y), z).at(5.0, 5.0)
    1.5
    """

    x: tuple[float, ...]
    y: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]
    over: tuple[Quantity, Quantity]
    of: Quantity
    label: str = ""
    entry: str = ""
    note: str = ""

    def __repr__(self) -> str:
        return f"Grid({self.of} over {self.over[0]} and {self.over[1]}, {len(self.x)} × {len(self.y)} points)"

    def at(self, x: float, y: float) -> float:
        """Return the value at the place ``x``, ``y``."""
        i, share = _cell(self.x, x)
        j, share_up = _cell(self.y, y)
        below = _between(self.values[j], i, share)
        # A side of one point is constant along it.
        return below if share_up == 0.0 else below + share_up * (_between(self.values[j + 1], i, share) - below)

    def minus(self, other: Grid) -> Grid:
        """Return the difference to ``other``, on the points of both."""
        x, y = (tuple(sorted({*mine, *theirs})) for mine, theirs in ((self.x, other.x), (self.y, other.y)))
        values = tuple(tuple(self.at(u, v) - other.at(u, v) for u in x) for v in y)
        return replace(self, x=x, y=y, values=values, of=self.of.changed())


@dataclass(frozen=True, repr=False)
class Scatter:
    """Values at scattered places: bilinear where these fill a grid, else linear in the triangles between them.

    Outside, the value is that at the nearest place of the hull.

    Attributes
    ----------
    places : tuple of (float, float)
        All different and not in a line.
    values : tuple of float
        One for each place.
    over, of, label, note
        As those of ``Grid``.
    deciding : tuple of tuple of float
        Values by which places on one circle are joined (see ``triangulate``); empty: by its own.

    Raises
    ------
    ValueError
        On asking for a value where all places are in a line.
    """

    places: tuple[Place, ...]
    values: tuple[float, ...]
    over: tuple[Quantity, Quantity]
    of: Quantity
    label: str = ""
    note: str = ""
    entry: str = ""
    deciding: tuple[tuple[float, ...], ...] = ()

    def __repr__(self) -> str:
        return f"Scatter({self.of} over {self.over[0]} and {self.over[1]}, {len(self.places)} places)"

    @cached_property
    def _grid(self) -> Grid | None:
        x, y = (tuple(sorted({place[k] for place in self.places})) for k in range(2))
        if len(self.places) != len(x) * len(y) or min(len(x), len(y)) == 1:
            return None
        known = dict(zip(self.places, self.values, strict=True))
        return Grid(x, y, tuple(tuple(known[u, v] for u in x) for v in y), self.over, self.of)

    @cached_property
    def _triangulation(self) -> Triangulation:
        deciding = self.deciding or [(value,) for value in self.values]
        found = triangulate([x for x, _ in self.places], [y for _, y in self.places], deciding)
        if not found.triangles:
            raise ValueError("there are no three places that are not in a line")
        return found

    def at(self, x: float, y: float) -> float:
        """Return the value at a place."""
        if self._grid is not None:
            return self._grid.at(x, y)
        for corners in self._triangulation.triangles:
            (ax, ay), (bx, by), (cx, cy) = (self.places[k] for k in corners)
            a, b, c = (self.values[k] for k in corners)
            area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            beta = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
            gamma = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
            if beta >= ON_EDGE and gamma >= ON_EDGE and beta + gamma <= 1.0 - ON_EDGE:
                return a + beta * (b - a) + gamma * (c - a)
        nearest = (self._on_edge(edge, x, y) for edge in self._triangulation.edges)
        return min(nearest, key=lambda found: found[0])[1]

    def _on_edge(self, edge: tuple[int, int], x: float, y: float) -> tuple[float, float]:
        """Return the squared distance from the nearest place of an edge, and the value there."""
        (ax, ay), (bx, by) = (self.places[k] for k in edge)
        ex, ey, px, py = bx - ax, by - ay, x - ax, y - ay
        share = min(max((px * ex + py * ey) / (ex * ex + ey * ey), 0.0), 1.0)
        a, b = (self.values[k] for k in edge)
        return (px - share * ex) ** 2 + (py - share * ey) ** 2, a + share * (b - a)


def _cell(points: Sequence[float], place: float) -> tuple[int, float]:
    """Return the number of the point before a place, and which share of the way to the next one is covered."""
    if place <= points[0]:
        return 0, 0.0
    if place >= points[-1]:
        return len(points) - 1, 0.0
    before = bisect_right(points, place) - 1
    return before, (place - points[before]) / (points[before + 1] - points[before])


def _between(row: Sequence[float], before: int, share: float) -> float:
    return row[before] if share == 0.0 else row[before] + share * (row[before + 1] - row[before])
