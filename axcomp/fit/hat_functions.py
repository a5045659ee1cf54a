"""Linear interpolation as a matrix: from values at knots to values at places."""

from __future__ import annotations

import numpy as np

from ..engine import Array


def hats(knots: Array, at: Array) -> Array:
    """Return the weights of linear interpolation, shape (places, knots); outside, the end value has them all.

    Parameters
    ----------
    knots : array, shape (k,)
        Strictly ascending; a single one has all weights.
    at : array, shape (n,)
        Places.
    """
    weights = np.zeros((len(at), len(knots)))
    if len(knots) == 1:
        weights[:, 0] = 1.0
        return weights
    clamped = np.clip(at, knots[0], knots[-1])
    left = np.clip(np.searchsorted(knots, clamped, side="right") - 1, 0, len(knots) - 2)
    share = (clamped - knots[left]) / (knots[left + 1] - knots[left])
    rows = np.arange(len(at))
    weights[rows, left] = 1.0 - share
    weights[rows, left + 1] += share
    return weights
