"""Curves that turn as rarely as readings allow: least squares with rising and falling pieces.

Friction falls (Stribeck) and rises over the velocity, once each as a rule; what goes up and down from one velocity to
the next is scatter. A piece in between turns spans a ratio of velocities that a curve of friction needs to turn.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.optimize import isotonic_regression

from ..engine import Array

PIECES_MAX = 3
SPAN = 1.5
"""Ratio of velocities that a piece spans at least."""
GAIN = 4.0
"""By which factor a further piece has to reduce the squares where the scatter of the values is not known."""


def least_turning(velocities: Array, values: Array, errors: Array) -> Array:
    """Return the curve with the fewest pieces that is consistent with values, shape (n,).

    Parameters
    ----------
    velocities : array, shape (n,)
        Ascending, above 0.
    values, errors : array, shape (n,)
        Currents, and their standard errors; NaN or 0: not known, then all count alike.
    """
    n = len(values)
    known = bool(np.isfinite(errors).all() and (errors > 0.0).all())
    weights = 1.0 / np.square(errors) if known else np.ones(n)
    enough = n + 2.0 * np.sqrt(2.0 * n) if known else 1e-18 * float(np.sum(weights * values**2))
    best = _best(velocities, values, weights, 1)
    for pieces in range(2, PIECES_MAX + 1):
        if best[0] <= enough:
            break
        cost, curve = _best(velocities, values, weights, pieces)
        if cost * GAIN < best[0]:
            best = cost, curve
    return best[1]


def _best(velocities: Array, values: Array, weights: Array, pieces: int) -> tuple[float, Array]:
    """Return sum of squares and curve of exactly so many pieces at most, whichever way the first one goes."""
    n = len(values)
    fits: dict[tuple[int, int, bool], tuple[float, Array]] = {}

    def fit(first: int, last: int, rising: bool) -> tuple[float, Array]:
        key = first, last, rising
        if key not in fits:
            part = slice(first, last)
            curve = np.asarray(isotonic_regression(values[part], weights=weights[part], increasing=rising).x)
            fits[key] = float(np.sum(weights[part] * (values[part] - curve) ** 2)), curve
        return fits[key]

    def wide(first: int, last: int) -> bool:
        return bool(velocities[last - 1] >= SPAN * velocities[first])

    best: tuple[float, Array] = (np.inf, values)
    for rising in (True, False):
        turns: list[tuple[int, ...]] = [()] if pieces == 1 else [(i,) for i in range(1, n)]
        if pieces > 2:
            turns = [(i, j) for i in range(1, n) for j in range(i + 1, n) if wide(i - 1, j + 1 if j < n else n)]
        for turn in turns:
            ends = (0, *turn, n)
            parts = [fit(a, b, rising ^ bool(k % 2)) for k, (a, b) in enumerate(pairwise(ends))]
            cost = sum(part[0] for part in parts)
            if cost < best[0] - 1e-12 * abs(best[0] if np.isfinite(best[0]) else 0.0):
                best = cost, np.concatenate([part[1] for part in parts])
    return best
