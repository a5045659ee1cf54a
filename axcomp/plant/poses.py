"""Where a body is: a rotation and a translation, exact for any angle. Lengths in mm, angles in rad."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)


class Pose(NamedTuple):
    """Maps the coordinates of a carried body to those of the one that carries it: x ↦ rotation · x + position.

    ``rows`` are those of the rotation.
    """

    rows: tuple[Vector, Vector, Vector]
    position: Vector

    def place(self, point: Vector) -> Vector:
        """Return a point of the carried body as the carrying one sees it."""
        x, y, z = (row[0] * point[0] + row[1] * point[1] + row[2] * point[2] for row in self.rows)
        return x + self.position[0], y + self.position[1], z + self.position[2]

    def place_back(self, point: Vector) -> Vector:
        """Return a point of the carrying body as the carried one sees it: the inverse of ``place``."""
        x, y, z = (point[k] - self.position[k] for k in range(3))
        return vector([a * x + b * y + c * z for a, b, c in zip(*self.rows, strict=True)])


def vector(values: Sequence[float]) -> Vector:
    """Return three numbers; ValueError if there are more or fewer."""
    x, y, z = values
    return float(x), float(y), float(z)


def unit(values: Sequence[float]) -> Vector:
    """Return the direction of a vector; ZeroDivisionError if it has none."""
    x, y, z = vector(values)
    length = math.hypot(x, y, z)
    return x / length, y / length, z / length


def shifted(position: Vector) -> Pose:
    """Return a body that is not turned."""
    return Pose(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), position)


def turned(turn: Vector, center: Vector = ORIGIN) -> Pose:
    """Return a body that is turned about an axis through ``center`` (Rodrigues).

    ``turn`` is the rotation vector: along the axis, as long as the angle is large, right-handed.
    """
    angle = math.hypot(*turn)
    if angle == 0.0:
        return shifted(ORIGIN)
    x, y, z = (component / angle for component in turn)
    s, c = math.sin(angle), math.cos(angle)
    versine = 1.0 - c
    rows = (
        (c + versine * x * x, versine * x * y - s * z, versine * x * z + s * y),
        (versine * y * x + s * z, c + versine * y * y, versine * y * z - s * x),
        (versine * z * x - s * y, versine * z * y + s * x, c + versine * z * z),
    )
    held = Pose(rows, ORIGIN).place(center)
    return Pose(rows, (center[0] - held[0], center[1] - held[1], center[2] - held[2]))
