"""Delaunay triangles of a few points in the plane, in exact arithmetic on coordinates rounded to 1 pm.

At most 15 acceleration tests (P-COMP-00083) need them, so every triple of points is looked at: a triangle belongs to
the triangulation if its circumcircle holds no other point. Points on one circle allow several triangulations: what
stands at the points decides. A triangle so flat that interpolation over it would be rounding (three
points that are meant to be in a line) is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import combinations
from typing import Any, NamedTuple

UNITS = 1e9
"""Whole coordinates per mm or °: points in a line of the lists' 0.1 µm are so in the rounded coordinates too."""

FLAT = 10**8
"""A triangle whose longest side is more than this many times its height is left out."""


Triangle = tuple[int, int, int]
"""Numbers of three points, counterclockwise."""

Side = tuple[int, int]
"""Numbers of two points that are joined, the smaller one first."""


class Point(NamedTuple):
    """A point with whole coordinates."""

    x: int
    y: int


class Triangulation(NamedTuple):
    """Triangles and hull of a set of points, as numbers of the points; both counterclockwise."""

    triangles: list[Triangle]
    edges: list[tuple[int, int]]


def triangulate(x: Sequence[float], y: Sequence[float], values: Sequence[Sequence[float]] = ()) -> Triangulation:
    """Return the Delaunay triangulation of some points; empty where all of them are in a line.

    Parameters
    ----------
    x, y : sequence of float, shape (n,)
        Coordinates, mm or °; their order makes no difference.
    values : sequence of sequence of float, shape (n, any)
        What stands at the points: of points on one circle those are joined that differ least (semantics §8), and of
        points that differ as little those whose coordinates are smaller.
    """
    points = _whole_points(x, y)
    candidates = _candidates(tuple(points))
    joined: list[Side] = []
    for side in sorted({frozenset(pair) for t in candidates for pair in combinations(t, 2)}, key=_rank(points, values)):
        a, b = sorted(side)
        if not any(_cross(points, (a, b), other) for other in joined):
            joined.append((a, b))
    triangles = [t for t in candidates if all(tuple(sorted(pair)) in joined for pair in combinations(t, 2))]
    sides = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
    return Triangulation(triangles, [(a, b) for a, b in sides if (b, a) not in sides])


@lru_cache(maxsize=32)
def _candidates(points: tuple[Point, ...]) -> list[Triangle]:
    """Return the triangles whose circumcircle is empty; the tests of all axes often stand at the same places."""
    candidates = []
    for a, b, c in combinations(range(len(points)), 3):
        turn = _turn(points[a], points[b], points[c])
        if abs(turn) * FLAT > _longest_side_squared(points[a], points[b], points[c]):
            triangle = (a, b, c) if turn > 0 else (a, c, b)
            if _circle_is_empty(points, triangle):
                candidates.append(triangle)
    return candidates


def width(x: Sequence[float], y: Sequence[float]) -> float:
    """Return the width of the narrowest strip along two of the points that holds all of them."""
    narrowest = math.inf
    for (ax, ay), (bx, by) in combinations(set(zip(x, y, strict=True)), 2):
        length = math.hypot(bx - ax, by - ay)
        far = max(abs((bx - ax) * (v - ay) - (by - ay) * (u - ax)) for u, v in zip(x, y, strict=True))
        narrowest = min(narrowest, far / length)
    return narrowest if math.isfinite(narrowest) else 0.0


def _rank(points: Sequence[Point], values: Sequence[Sequence[float]]) -> Callable[[frozenset[int]], tuple[Any, ...]]:
    """Return the key by which sides are joined: by the difference of the values, then by coordinates."""

    def rank(side: frozenset[int]) -> tuple[Any, ...]:
        a, b = side
        different = sum(abs(u - v) for u, v in zip(values[a], values[b], strict=True)) if values else 0.0
        return different, sorted((points[a], points[b]))

    return rank


def _cross(points: Sequence[Point], one: Side, other: Side) -> bool:
    """Tell whether two sides meet between their ends."""
    if set(one) & set(other):
        return False
    (a, b), (c, d) = ((points[i], points[j]) for i, j in (one, other))
    return _turn(a, b, c) * _turn(a, b, d) < 0 and _turn(c, d, a) * _turn(c, d, b) < 0


def _whole_points(x: Sequence[float], y: Sequence[float]) -> list[Point]:
    return [Point(round(u * UNITS), round(v * UNITS)) for u, v in zip(x, y, strict=True)]


def _turn(a: Point, b: Point, c: Point) -> int:
    """> 0 where a → b → c turns left, 0 where they are in a line."""
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)


def _longest_side_squared(a: Point, b: Point, c: Point) -> int:
    return max((p.x - q.x) ** 2 + (p.y - q.y) ** 2 for p, q in ((a, b), (b, c), (c, a)))


def _circle_is_empty(points: Sequence[Point], triangle: Triangle) -> bool:
    """No point lies strictly inside the circumcircle (the in-circle determinant)."""
    a, b, c = (points[i] for i in triangle)
    for i, p in enumerate(points):
        if i in triangle:
            continue
        ax, ay, bx, by, cx, cy = a.x - p.x, a.y - p.y, b.x - p.x, b.y - p.y, c.x - p.x, c.y - p.y
        determinant = (
            (ax * ax + ay * ay) * (bx * cy - by * cx)
            - (bx * bx + by * by) * (ax * cy - ay * cx)
            + (cx * cx + cy * cy) * (ax * by - ay * bx)
        )
        if determinant > 0:
            return False
    return True
