"""Tables on equidistant points, which is all that several controllers take, and their least cost in µm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .table import CannotHoldError, CompensationTable, closed

ON_GRID = 1e-4
"""How far a point may lie off its place and still count as equidistant, mm or °: what the lists resolve."""
EXACT = 1e-6
"""Differences up to this many µm come from the arithmetic alone."""


def on_equidistant_points(table: CompensationTable, max_points: int, within: float | None) -> CompensationTable:
    """Return the table on exactly equidistant points; a table that repeats ends one period after it begins.

    Parameters
    ----------
    table : CompensationTable
        Any.
    max_points : int
        The most the other controller takes.
    within : float or None
        How many µm (m°) another choice of points may change the corrections; None: the points stay as they are.

    Raises
    ------
    CannotHoldError
        If the points are not equidistant and no bound is stated, the bound cannot be met, or there are too many points.
    """
    full = closed(table)
    if len(full.positions) == 1:
        # A constant: any second point makes a distance.
        negative = None if full.negative is None else full.negative * 2
        positions = (full.positions[0], full.positions[0] + 1.0)
        return replace(full, positions=positions, positive=full.positive * 2, negative=negative)
    count = len(full.positions)
    grid = np.linspace(full.positions[0], full.positions[-1], count)
    if np.max(np.abs(grid - full.positions)) <= ON_GRID:
        if count > max_points:
            raise CannotHoldError(f"{table.name} has {count} points; there is room for {max_points}")
        return replace(full, positions=tuple(grid.tolist()))
    gaps = np.diff(full.positions)
    if within is None:
        raise CannotHoldError(
            f"the points of {table.name} are {gaps.min():g} to {gaps.max():g} {table.over_unit} apart, but must be "
            "equidistant: say how many µm other points may cost (--within)"
        )
    return _fewest_points(full, max_points, within)


def _fewest_points(table: CompensationTable, max_points: int, within: float) -> CompensationTable:
    """Try one number of points after the other.

    The new points lie on the old curve and both are straight between their points: the largest difference is found at
    the old ones.
    """
    old = np.asarray(table.positions)
    curves = [np.asarray(curve) for curve in (table.positive, table.negative) if curve is not None]
    least = np.inf
    for count in range(2, max_points + 1):
        grid = np.linspace(old[0], old[-1], count)
        values = [np.interp(grid, old, curve) for curve in curves]
        off = max(
            float(np.max(np.abs(np.interp(old, grid, new) - curve))) for new, curve in zip(values, curves, strict=True)
        )
        if off * 1e3 <= within + EXACT:
            return replace(
                table,
                positions=tuple(grid.tolist()),
                positive=tuple(values[0].tolist()),
                negative=None if table.negative is None else tuple(values[1].tolist()),
            )
        least = min(least, off * 1e3)
    raise CannotHoldError(
        f"{table.name} on up to {max_points} equidistant points is {least:.3f} µm off at best, not {within:g} µm"
    )
