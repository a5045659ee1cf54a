"""What each kind of table says at a position, a second time: from the words of the manuals, with NumPy and SciPy.

Nothing here knows the kernel. Positions are in mm or °, accelerations in mm/s².
"""

from __future__ import annotations

import math
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, Delaunay

from axcomp.kinds import Cross, Crosstalk, CrosstalkCurve, Leadscrew, Plane
from axcomp.model import Axis

FIELDS = ("accelerate_positive", "accelerate_negative", "decelerate_positive", "decelerate_negative")


def centred(position: float, first: float, last: float, axis: Axis) -> float:
    """Return a position of an axis in the turn that is centred on a table, if the axis counts modulo."""
    if axis.modulo is None:
        return position
    middle, turn = 0.5 * (first + last), axis.modulo.length
    return position - turn * math.floor((position - middle) / turn + 0.5)


def leadscrew_errors(screw: Leadscrew, axis: Axis, position: float) -> tuple[float, float]:
    """Return actual − programmed position in positive and in negative motion."""
    x = list(screw.positions)
    columns = [list(screw.positive), list(screw.positive if screw.negative is None else screw.negative)]
    if screw.modulo and axis.modulo is not None:
        turn = axis.modulo.length
        position = x[0] + (position - x[0]) % turn
        if x[-1] < x[0] + turn:
            x.append(x[0] + turn)
            columns = [[*column, column[0]] for column in columns]
    else:
        position = centred(position, x[0], x[-1], axis)
    positive, negative = (float(np.interp(position, x, column)) for column in columns)
    return positive, negative


def cross_correction(cross: Cross, master: Axis, position: float) -> float:
    """Return what a cross compensation adds at a position of its master."""
    at = centred(position, cross.positions[0], cross.positions[-1], master)
    return float(np.interp(at, cross.positions, cross.corrections))


def plane_correction(plane: Plane, masters: tuple[Axis, Axis], positions: tuple[float, float]) -> float:
    """Return what a plane compensation adds: linear in the first master's rows, then between these."""
    x1 = plane.start1 + plane.interval1 * np.arange(len(plane.corrections[0]))
    x2 = plane.start2 + plane.interval2 * np.arange(len(plane.corrections))
    at1 = centred(positions[0], x1[0], x1[-1], masters[0])
    at2 = centred(positions[1], x2[0], x2[-1], masters[1])
    along = [np.interp(at1, x1, row) for row in plane.corrections]
    return float(np.interp(at2, x2, along))


def crosstalk_correction(
    crosstalk: Crosstalk, adaptation: list[Axis], positions: list[float], acceleration: float, direction: int
) -> float:
    """Return what a crosstalk compensation of the new variant adds; ``direction``: of the master, 1 or −1."""
    sign = 1 if direction > 0 or not crosstalk.velocity_dependent else -1
    phase, tested = (
        ("accelerate", crosstalk.acceleration) if acceleration >= 0 else ("decelerate", crosstalk.deceleration)
    )
    field = f"{phase}_{'positive' if sign > 0 else 'negative'}"
    return _measured(crosstalk, field, adaptation, positions) * min(acceleration / tested, 1.0)


def curve_correction(curve: CrosstalkCurve, acceleration: float) -> float:
    """Return what a crosstalk compensation of the old variant adds."""
    return float(np.interp(acceleration, curve.accelerations, curve.corrections))


def _measured(crosstalk: Crosstalk, field: str, adaptation: list[Axis], positions: list[float]) -> float:
    tests = crosstalk.tests
    if crosstalk.mode == 1:
        return float(getattr(tests[0], field))
    if crosstalk.mode == 2:
        ordered = sorted(tests, key=lambda test: test.position1)
        x = [test.position1 for test in ordered]
        at = centred(positions[0], x[0], x[-1], adaptation[0])
        return float(np.interp(at, x, [getattr(test, field) for test in ordered]))
    places = np.array([(test.position1, test.position2) for test in tests])
    at = np.array([centred(p, places[:, i].min(), places[:, i].max(), adaptation[i]) for i, p in enumerate(positions)])
    x1, x2 = sorted(set(places[:, 0].tolist())), sorted(set(places[:, 1].tolist()))
    values = {(test.position1, test.position2): float(getattr(test, field)) for test in tests}
    if set(values) == set(product(x1, x2)):
        along = [np.interp(at[0], x1, [values[a, b] for a in x1]) for b in x2]
        return float(np.interp(at[1], x2, along))
    return _in_triangles(tuple(map(tuple, places.tolist())), np.array([values[p] for p in values]), at)


@cache
def _triangles(places: tuple[tuple[float, float], ...]) -> tuple[Delaunay, ConvexHull]:
    return Delaunay(np.array(places)), ConvexHull(np.array(places))


def _in_triangles(
    places: tuple[tuple[float, float], ...], values: NDArray[np.float64], at: NDArray[np.float64]
) -> float:
    """Return the value in the triangle around a place, outside that at the nearest place of the hull."""
    triangles, hull = _triangles(places)
    points = np.array(places)
    inside = int(triangles.find_simplex(at))
    if inside >= 0:
        corners = triangles.simplices[inside]
        system = np.vstack([(points[corners] - at).T, np.ones(3)])
        return float(np.linalg.solve(system, [0.0, 0.0, 1.0]) @ values[corners])
    best = (math.inf, 0.0)
    for i, j in hull.simplices:
        side = points[j] - points[i]
        share = min(max(float((at - points[i]) @ side / (side @ side)), 0.0), 1.0)
        distance = float(np.hypot(*(points[i] + share * side - at)))
        best = min(best, (distance, float(values[i] + share * (values[j] - values[i]))))
    return best[1]
