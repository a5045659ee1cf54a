"""Plane compensation (kw.crosscomp2): the slave is corrected over a grid of two masters, bilinear. Added."""

from __future__ import annotations

from .record import Vec
from .records import PlaneTable


def plane_value(pool: Vec, table: PlaneTable, master1: float, master2: float) -> float:
    """Return the correction at full weight at the masters' raw setpoints; outside the grid the edge is held."""
    u = grid_coordinate(master1, table.start1, table.interval1, table.points1)
    v = grid_coordinate(master2, table.start2, table.interval2, table.points2)
    i = grid_cell(u, table.points1)
    j = grid_cell(v, table.points2)
    right = 1 if table.points1 > 1 else 0
    below = table.points1 if table.points2 > 1 else 0

    at = table.values + j * table.points1 + i
    s = u - i
    near = pool[at] + s * (pool[at + right] - pool[at])
    far = pool[at + below] + s * (pool[at + below + right] - pool[at + below])
    return near + (v - j) * (far - near)


def grid_coordinate(x: float, start: float, interval: float, points: int) -> float:
    """Return the position in intervals from the start, clamped to the grid: 0 … points − 1."""
    u = (x - start) / interval
    if u <= 0.0:
        return 0.0
    return min(u, points - 1.0)


def grid_cell(u: float, points: int) -> int:
    """Return the cell of a grid coordinate; the last point belongs to the last cell."""
    i = int(u)
    return i if i < points - 1 or i == 0 else points - 2
