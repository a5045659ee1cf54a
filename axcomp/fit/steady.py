"""What a motor needs at constant velocity, from the trace of an axis: stretches, inertia, levels.

The current is taken as ``offset + direction · friction(|v|) + inertia · a``. Inertia comes from all that moves, by
robust least squares beside a friction that is linear between nodes in each direction; friction from stretches of
constant velocity, with what acceleration is left in them taken off.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from ..engine import Array
from ..measurement import AxisTrace, MeasurementError
from .hat_functions import hats

Mask = npt.NDArray[np.bool_]

STEADY = 0.02
"""Share of its velocity by which an axis may change it within ``SHORTEST`` and still move steadily."""
SHORTEST = 0.04
"""Of a stretch, s."""
SETTLING = 0.3
"""Share of a stretch at its beginning that does not count: the control settles there."""
SLIDING = 0.2
"""Travel after a reversal within which friction builds up, mm or °."""
NODES = 12
"""Of friction, in each direction, for the inertia."""
SAMPLES_MAX = 20_000
"""That the inertia is estimated from."""
BATCHES = 8
"""Parts of a stretch whose means tell how well its own mean is known: samples side by side are not independent."""


class Stretch(NamedTuple):
    """A stretch of constant velocity: velocity with sign, current without inertia, its standard error, samples."""

    velocity: float
    current: float
    error: float
    samples: int


class Steady(NamedTuple):
    """What a trace says: stretches, inertia (current per mm/s² or °/s²) with its standard error, how it was found."""

    stretches: tuple[Stretch, ...]
    inertia: float
    inertia_error: float
    notes: tuple[str, ...]


def steady_of(trace: AxisTrace) -> Steady:
    """Return the stretches of a trace; MeasurementError if nothing moves steadily."""
    if "current" not in trace.columns:
        raise MeasurementError(trace.source, 0, "There is no column for current (or torque, force).")
    current = trace.columns["current"]
    velocity, acceleration = trace.velocity(), trace.acceleration()
    noise = _noise(trace, velocity)
    sliding = _sliding(trace, velocity, max(3.0 * noise, 1e-3))
    if not sliding.any():
        raise MeasurementError(trace.source, 0, "The axis never moves.")
    inertia, error, notes = inertia_of(velocity, acceleration, current, sliding)
    runs = _runs(velocity, noise, trace.cycle) & sliding
    left = current - inertia * acceleration
    spans = [part for span in spans_of(runs) for part in _alike(velocity, noise, *span)]
    found = [one for span in spans if (one := _stretch(velocity, left, *span, trace.cycle))]
    if not found:
        sentence = f"There is no stretch of {SHORTEST:g} s with a velocity constant within {STEADY:.0%}."
        raise MeasurementError(trace.source, 0, sentence)
    return Steady(tuple(found), inertia, error, (*trace.notes, *notes))


def inertia_of(velocity: Array, acceleration: Array, current: Array, sliding: Mask) -> tuple[float, float, list[str]]:
    """Return the current per acceleration, its standard error, and what there is to say."""
    where = np.flatnonzero(sliding)
    where = where[:: max(1, len(where) // SAMPLES_MAX)]
    v, a, i = velocity[where], acceleration[where], current[where]
    scale = float(np.max(np.abs(a)))
    columns = []
    for sign in (1.0, -1.0):
        side = np.sign(v) == sign
        if side.any():
            # Nodes are as close as there are velocities, twice as many where it is slow.
            nodes = np.unique(np.quantile(np.abs(v[side]), np.linspace(0.0, 1.0, NODES) ** 1.5))
            columns.append(np.where(side[:, None], hats(nodes, np.abs(v)), 0.0))
    matrix = np.column_stack([*columns, a / (scale or 1.0)])
    used = np.linalg.norm(matrix, axis=0) > 0.0
    if not used[-1]:
        return 0.0, np.nan, ["Nothing accelerates: the inertia is not known, and taken as 0."]
    matrix = matrix[:, used]
    weights = np.ones(len(i))
    for _ in range(12):
        weighted = (matrix * weights[:, None]).T
        inverse = np.linalg.pinv(weighted @ matrix, hermitian=True)
        solution = inverse @ (weighted @ i)
        residuals = i - matrix @ solution
        spread = 1.4826 * float(np.median(np.abs(residuals))) + 1e-12
        weights = np.minimum(1.0, 1.5 * spread / np.maximum(np.abs(residuals), 1e-300))
    # Neighbours in time are alike: residuals count in groups.
    groups = np.array_split(np.arange(len(i)), min(40, len(i)))
    scores = np.array([(matrix[g] * (weights * residuals)[g, None]).sum(axis=0) for g in groups])
    variance = float((inverse @ (scores.T @ scores) @ inverse)[-1, -1])
    return float(solution[-1]) / scale, float(np.sqrt(max(variance, 0.0))) / scale, []


def _noise(trace: AxisTrace, velocity: Array) -> float:
    """Return the standard deviation of a smoothed velocity."""
    raw = trace.columns.get("velocity")
    if raw is None:
        return 0.0
    return 0.5 * 1.4826 * float(np.median(np.abs(raw - velocity)))


def _sliding(trace: AxisTrace, velocity: Array, least: float) -> Mask:
    """Tell where the axis moves, and has gone on from its last reversal or stop for some way."""
    moving = np.abs(velocity) > least
    way = np.sign(velocity) * moving
    change = np.flatnonzero(np.diff(way, prepend=0.0) != 0.0)
    last = np.full(len(way), -1)
    last[change] = change
    last = np.maximum.accumulate(last)
    travelled = trace.travelled()
    return np.asarray(moving & (np.abs(travelled - travelled[np.maximum(last, 0)]) > SLIDING))


def _runs(velocity: Array, noise: float, cycle: float) -> Mask:
    """Tell where the velocity is constant over ``SHORTEST`` s around."""
    window = max(3, round(SHORTEST / cycle))
    spread = maximum_filter1d(velocity, window) - minimum_filter1d(velocity, window)
    return np.asarray(spread <= np.maximum(STEADY * np.abs(velocity), 6.0 * noise))


def spans_of(mask: Mask) -> list[tuple[int, int]]:
    """Return where a mask is true: first and behind the last place of each stretch."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _alike(velocity: Array, noise: float, first: int, last: int) -> list[tuple[int, int]]:
    """Return a stretch, or the parts of one in which the velocity changes little by little."""
    speed = np.abs(velocity[first:last])
    if np.ptp(speed) <= max(2.0 * STEADY * float(speed.mean()), 8.0 * noise):
        return [(first, last)]
    step = np.floor(np.log(speed) / np.log(1.0 + 2.0 * STEADY))
    edges = [0, *(np.flatnonzero(np.diff(step)) + 1).tolist(), last - first]
    return [(first + a, first + b) for a, b in pairwise(edges)]


def _stretch(velocity: Array, current: Array, first: int, last: int, cycle: float) -> Stretch | None:
    """Return a stretch without its beginning, robustly; None if it is too short."""
    first += round(SETTLING * (last - first))
    if last - first < max(BATCHES, round(0.5 * SHORTEST / cycle)):
        return None
    v, i = velocity[first:last], current[first:last]
    middle = float(np.median(i))
    far = np.abs(i - middle) > 4.0 * 1.4826 * float(np.median(np.abs(i - middle))) + 1e-12
    i = np.where(far, middle, i)
    means = np.array([batch.mean() for batch in np.array_split(i, BATCHES)])
    return Stretch(float(np.mean(v)), float(i.mean()), float(means.std(ddof=1)) / BATCHES**0.5, len(i))
