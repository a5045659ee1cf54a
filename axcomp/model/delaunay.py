"""Delaunay triangles of a few points in the plane, in exact arithmetic on coordinates rounded to 1 pm.

At most 15 acceleration tests (P-COMP-00083) need them, so every triple of points is looked at: a triangle belongs to
the triangulation if its circumcircle holds no other point. Points on one circle allow several triangulations; the
first triangles that do not overlap are taken. A triangle so flat that interpolation over it would be rounding (three
points that are meant to be in a line) is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

UNITS = 1e9
"""Whole coordinates per mm or °: points in a line of the lists' 0.1 µm are so in the rounded coordinates too."""

FLAT = 10**8
"""A triangle whose longest side is more than this many times its height is left out."""


class Point(NamedTuple):
    """A point with whole coordinates."""

    x: int
    y: int


class Triangulation(NamedTuple):
    """Triangles and hull of a set of points, as numbers of the points; both counterclockwise."""

    triangles: list[tuple[int, int, int]]
    edges: list[tuple[int, int]]


def triangulate(x: Sequence[float], y: Sequence[float]) -> Triangulation:
    """Return the Delaunay triangulation of the points (x[i], y[i]); empty where all points are in a line."""
    points = _whole_points(x, y)
    triangles: list[tuple[int, int, int]] = []
    for a, b, c in combinations(range(len(points)), 3):
        turn = _turn(points[a], points[b], points[c])
        if abs(turn) * FLAT <= _longest_side_squared(points[a], points[b], points[c]):
            continue
        triangle = (a, b, c) if turn > 0 else (a, c, b)
        if _circle_is_empty(points, triangle) and not any(_overlap(points, triangle, other) for other in triangles):
            triangles.append(triangle)
    sides = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
    return Triangulation(triangles, [(a, b) for a, b in sides if (b, a) not in sides])


def _whole_points(x: Sequence[float], y: Sequence[float]) -> list[Point]:
    return [Point(round(u * UNITS), round(v * UNITS)) for u, v in zip(x, y, strict=True)]


def _turn(a: Point, b: Point, c: Point) -> int:
    """> 0 where a → b → c turns left, 0 where they are in a line."""
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)


def _longest_side_squared(a: Point, b: Point, c: Point) -> int:
    return max((p.x - q.x) ** 2 + (p.y - q.y) ** 2 for p, q in ((a, b), (b, c), (c, a)))


def _circle_is_empty(points: Sequence[Point], triangle: tuple[int, int, int]) -> bool:
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


def _overlap(points: Sequence[Point], one: tuple[int, int, int], other: tuple[int, int, int]) -> bool:
    """Whether two counterclockwise triangles share inner points: no side of either separates them."""
    for t, u in ((one, other), (other, one)):
        for k in range(3):
            a, b = points[t[k]], points[t[(k + 1) % 3]]
            if all(_turn(a, b, points[i]) <= 0 for i in u):
                return False
    return True
