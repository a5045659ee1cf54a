"""Fewer points for curves that are read off linearly between them, with a bound on what is lost.

The points that stay are measured ones; every curve is as measured there. Of all choices of points the fewest that keep
within a bound are found, and of all choices of n points the one that deviates least: a point can follow another if the
straight line between them passes all points in between, and a chain of as few links as possible leads from end to end
(Imai and Iri, Polygonal approximations of a curve, 1988).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..engine import Array

Places = npt.NDArray[np.int64]

_RELATIVE = 1e-6
"""How finely the least bound is sought, relative to the curves' range."""

_ROUNDING = 1e-12
"""Relative to the curves' range, what counts as passing through a point."""

_WINDOW = 64
"""Points a link is first looked for among."""


def fewest(positions: Array, curves: Array, bound: float) -> Places:
    """Return the places of the fewest points with which every curve is off by ``bound`` at most where it was measured.

    Parameters
    ----------
    positions : array, shape (m,)
        Strictly ascending.
    curves : array, shape (k, m)
        Values at the positions.
    bound : float
        Largest deviation, in the unit of the curves; with 0 only points on straight lines go.
    """
    places = _shortest_chain(positions, curves, bound)
    return closest(positions, curves, len(places))


def closest(positions: Array, curves: Array, count: int) -> Places:
    """Return the places of at most ``count`` ≥ 2 points, the ends among them, with which the curves deviate least."""
    m = len(positions)
    if m <= count:
        return np.arange(m)
    ends = np.array([0, m - 1])
    low, high = 0.0, deviation(positions, curves, ends)
    best = ends
    tolerance = _RELATIVE * max(float(np.ptp(curves)), np.finfo(float).tiny)
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        places = _shortest_chain(positions, curves, middle)
        if len(places) <= count:
            best, high = places, min(middle, deviation(positions, curves, places))
        else:
            low = middle
    return best


def deviation(positions: Array, curves: Array, places: Places) -> float:
    """Return how far the curves through some of their points are off at all of them, at most."""
    return max(
        float(np.max(np.abs(np.interp(positions, positions[places], curve[places]) - curve))) for curve in curves
    )


def _shortest_chain(positions: Array, curves: Array, bound: float) -> Places:
    """Return the places of the points of a chain with the fewest links that deviates by ``bound`` at most."""
    m = len(positions)
    links = np.full(m, m)
    links[0] = 0
    before = np.zeros(m, dtype=np.int64)
    slack = bound + _ROUNDING * float(np.ptp(curves))
    for i in range(m - 1):
        reached = i + _reachable(positions[i:], curves[:, i:], slack)
        shorter = reached[links[reached] > links[i] + 1]
        links[shorter] = links[i] + 1
        before[shorter] = i
    chain = [m - 1]
    while chain[-1] > 0:
        chain.append(int(before[chain[-1]]))
    return np.array(chain[::-1])


def _reachable(positions: Array, curves: Array, bound: float) -> Places:
    """Return the places of the points to which the line from the first one passes all those in between."""
    window = _WINDOW
    while True:
        distance = positions[1:window] - positions[0]
        rise = curves[:, 1:window] - curves[:, :1]
        least = np.maximum.accumulate((rise - bound) / distance, axis=1)
        most = np.minimum.accumulate((rise + bound) / distance, axis=1)
        if window >= len(positions) or np.any(least[:, -1] > most[:, -1]):
            slope = rise / distance
            return 1 + np.flatnonzero(np.all((least <= slope) & (slope <= most), axis=0))
        window *= 2
