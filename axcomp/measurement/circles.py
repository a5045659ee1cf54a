"""Circles through points: by least squares, and the two concentric ones of least separation that hold all points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares, linprog

from ..engine import Array

_STEPS = 50
_ENOUGH = 1e-10
"""Change of the centre with which the search ends, relative to the radius."""


class Circle(NamedTuple):
    """A centre, shape (2,), and a radius."""

    centre: Array
    radius: float

    def deviations(self, points: Array) -> Array:
        """Return how far points, shape (n, 2), are outside."""
        return np.asarray(np.hypot(*(points - self.centre).T) - self.radius)


class Zone(NamedTuple):
    """Two concentric circles with all points between them."""

    centre: Array
    inner: float
    outer: float

    @property
    def width(self) -> float:
        """Their separation."""
        return self.outer - self.inner


def least_squares_circle(points: Array) -> Circle:
    """Return the circle with the least squares of the distances of points, shape (n, 2), n ≥ 3."""
    middle = points.mean(axis=0)
    matrix = np.column_stack([2.0 * (points - middle), np.ones(len(points))])
    first = np.linalg.lstsq(matrix, np.sum((points - middle) ** 2, axis=1), rcond=None)[0]
    start = [*first[:2], np.sqrt(max(first[2] + first[0] ** 2 + first[1] ** 2, 0.0))]

    def out(x: Array) -> Array:
        return np.asarray(np.hypot(*(points - middle - x[:2]).T) - x[2])

    def slopes(x: Array) -> Array:
        away = points - middle - x[:2]
        return np.column_stack([-away / np.hypot(*away.T)[:, None], -np.ones(len(points))])

    found = least_squares(out, start, jac=slopes, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return Circle(middle + found[:2], float(found[2]))


def minimum_zone(points: Array) -> Zone:
    """Return the minimum zone circles of points, shape (n, 2), n ≥ 4, that lie near a circle.

    With distances linear in the centre this is a linear programme, solved around the last centre until that stays; at
    last the points that touch the circles determine it exactly.
    """
    circle = least_squares_circle(points)
    centre, touching = circle.centre, np.empty(0, dtype=np.int64)
    n = len(points)
    for _ in range(_STEPS):
        away = points - centre
        distances = np.hypot(*away.T)
        units = away / distances[:, None]
        middle, scale = float(distances.mean()), max(float(np.ptp(distances)), 1e-300)
        # In units of the separation: outer − d + u·δ ≥ 0, d − u·δ − inner ≥ 0, least outer − inner.
        level = (distances - middle) / scale
        ones, zeros = np.ones((n, 1)), np.zeros((n, 1))
        sides = np.vstack([np.hstack([-units, -ones, zeros]), np.hstack([units, zeros, ones])])
        reach = 0.5 * middle / scale
        bounds = [(-reach, reach)] * 2 + [(None, None)] * 2
        solved = linprog([0.0, 0.0, 1.0, -1.0], A_ub=sides, b_ub=np.concatenate([-level, level]), bounds=bounds)
        step = scale * np.asarray(solved.x)[:2]
        centre = centre + step
        touching = np.flatnonzero(solved.ineqlin.marginals < -1e-9)
        if np.hypot(*step) <= _ENOUGH * middle:
            break
    best = _zone(points, centre)
    if len(touching) == 4:
        exact = _zone(points, _touching_centre(points, centre, touching))
        best = min(best, exact, key=lambda zone: zone.width)
    return best


def _zone(points: Array, centre: Array) -> Zone:
    distances = np.hypot(*(points - centre).T)
    return Zone(centre, float(distances.min()), float(distances.max()))


def _touching_centre(points: Array, centre: Array, touching: npt.NDArray[np.int64]) -> Array:
    """Return the centre from which the points on either circle are equally far; four of them in all."""
    n, unknown = len(points), np.concatenate([centre, [0.0, 0.0]])
    outside = touching < n
    chosen = points[touching % n]
    for _ in range(20):
        away = chosen - unknown[:2]
        distances = np.hypot(*away.T)
        equations = distances - np.where(outside, unknown[2], unknown[3])
        matrix = np.column_stack([-away / distances[:, None], -1.0 * outside, -1.0 * ~outside])
        try:
            unknown = unknown - np.linalg.solve(matrix, equations)
        except np.linalg.LinAlgError:
            return centre
    return unknown[:2]
