"""Tables on equidistant points, which is all that several controllers take, and their least cost in µm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..model.curve import Curve
from .table import CompensationTable
from .text import CannotHoldError

ON_GRID = 1e-4
"""How far a point may lie off its position and still count as equidistant, mm or °: what the lists resolve."""
EXACT = 1e-9
"""Differences up to this, in mm or °, come from the arithmetic alone."""


def on_equidistant_points(table: CompensationTable, max_points: int, within: float | None) -> CompensationTable:
    """Return the table on exactly equidistant points; a table that repeats ends one period after it begins.

    ``within``: how many µm (″) another choice of points may change the corrections; None: the points stay as they are.

    Raises
    ------
    CannotHoldError
        If the points are not equidistant and no bound is stated, the bound cannot be met, or there are too many points.
    """
    full = table.mapped(Curve.closed)
    x = full.positions
    if len(x) == 1:
        # A constant: any second point makes a distance.
        return full.mapped(lambda curve: replace(curve, x=(x[0], x[0] + 1.0), y=curve.y * 2))
    even = np.linspace(x[0], x[-1], len(x))
    if np.max(np.abs(even - x)) <= ON_GRID:
        if len(x) > max_points:
            raise CannotHoldError(f"{table.name} has {len(x)} points; there is room for {max_points}")
        return full.mapped(lambda curve: replace(curve, x=tuple(even.tolist())))
    factor, unit = table.shown
    if within is None:
        gaps = np.diff(x)
        raise CannotHoldError(
            f"the points of {table.name} are {gaps.min():g} to {gaps.max():g} {table.over_unit} apart, but must be "
            f"equidistant: say how many {unit} other points may cost (--within)"
        )
    least = np.inf
    for count in range(2, max_points + 1):
        points = np.linspace(x[0], x[-1], count)
        off = max(_off(curve, points) for curve in (full.positive, full.negative) if curve is not None)
        if off <= within / factor + EXACT:
            return full.mapped(lambda curve, points=points: curve.on(points.tolist()))  # type: ignore[misc]
        least = min(least, factor * off)
    raise CannotHoldError(
        f"{table.name} on up to {max_points} equidistant points is {least:.3f} {unit} off at best, "
        f"not {within:g} {unit}"
    )


def _off(curve: Curve, points: np.ndarray) -> float:
    """Return how far a curve is off through other points of its own: the largest difference is at the old ones."""
    through = np.interp(curve.x, points, np.interp(points, curve.x, curve.y))
    return float(np.max(np.abs(through - curve.y)))
