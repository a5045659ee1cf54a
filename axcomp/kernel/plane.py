"""Plane compensation (kw.crosscomp2): the slave is corrected over a grid of two masters, bilinear. Added."""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import LARGEST, range_fits
from .motion import Argument, Motion, argument_fits, position_of
from .record import Vec


@dataclass(slots=True)
class PlaneTable:
    """Correction of the slave over the positions of two masters; correction[j][i] at values + j * points1 + i."""

    master1: Argument
    master2: Argument
    start1: float
    start2: float
    interval1: float
    interval2: float
    points1: int
    points2: int
    values: int


def plane_value(pool: Vec, table: PlaneTable, motion: Motion) -> float:
    """Return the correction at full weight at the masters' raw setpoints; outside the grid the edge is held."""
    u = grid_coordinate(position_of(motion, table.master1), table.start1, table.interval1, table.points1)
    v = grid_coordinate(position_of(motion, table.master2), table.start2, table.interval2, table.points2)
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
    if not u > 0.0:
        return 0.0
    return min(u, points - 1.0)


def grid_cell(u: float, points: int) -> int:
    """Return the cell of a grid coordinate; the last point belongs to the last cell."""
    i = int(u)
    return i if i < points - 1 or i == 0 else points - 2


def move_plane(table: PlaneTable, by: int) -> None:
    """Follow the numbers of the table to another place in the pool."""
    table.values += by


def plane_fits(table: PlaneTable, axes: int, numbers: int) -> bool:
    """Tell whether the table can be used."""
    if not (argument_fits(table.master1, axes) and argument_fits(table.master2, axes)):
        return False
    if not (table.interval1 > 0.0 and table.interval2 > 0.0 and table.points1 > 0 and table.points2 > 0):
        return False
    if not (abs(table.start1) < LARGEST and abs(table.start2) < LARGEST):
        return False
    if table.points1 > numbers // table.points2:
        return False
    return range_fits(table.values, table.points1 * table.points2, numbers)
