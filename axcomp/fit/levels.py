"""Currents at levels of velocity, each direction by itself, with uncertainty, and what both directions do not share."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.stats import t as student

from ..engine import Array
from .monotone import least_turning

Mask = npt.NDArray[np.bool_]

RESOLUTION = 1e-3
"""Of velocities in a list, mm/s or °/s."""
LEVELS_MAX = 40
OUTLYING = 5.0
"""Standard deviations, by the median, beyond which a reading of a level does not count."""


class Sides(NamedTuple):
    """What a table that both directions share cannot hold, each with its expanded uncertainty (95 %).

    ``offset``: a constant current, as of a weight; ``asymmetry``: share by which friction is larger than the mean of
    both directions in the positive one, and smaller in the negative one. NaN where it cannot be told.
    """

    offset: float
    offset_uncertainty: float
    asymmetry: float
    asymmetry_uncertainty: float


class Levels(NamedTuple):
    """Currents against motion at levels, m of them.

    Attributes
    ----------
    speeds : array, shape (m,)
        Ascending, in the resolution of the list.
    sides : array, shape (2, m)
        Mean current against motion in positive and in negative direction, NaN where none was measured.
    errors : array, shape (2, m)
        Their standard errors, NaN where readings do not tell.
    dropped : int
        Readings that did not count.
    """

    speeds: Array
    sides: Array
    errors: Array
    dropped: int

    @property
    def both(self) -> Mask:
        """Levels measured in both directions, shape (m,), bool."""
        return np.asarray(np.isfinite(self.sides).all(axis=0))

    def shares(self) -> Sides:
        """Return offset and asymmetry: (I↑ − I↓) / 2 = offset + asymmetry · (I↑ + I↓) / 2 over the levels."""
        both = self.both
        if not both.any():
            return Sides(*4 * (np.nan,))
        half, friction = 0.5 * (self.sides[0] - self.sides[1])[both], self.sides[:, both].mean(axis=0)
        errors = 0.5 * np.hypot(*self.errors[:, both])
        known = bool(np.isfinite(errors).all() and (errors > 0.0).all())
        weights = 1.0 / errors if known else np.ones(len(half))
        if len(half) < 3 or np.ptp(friction) < 1e-6 * np.abs(friction).max():
            return Sides(float(half.mean()), np.nan, np.nan, np.nan)
        matrix = np.column_stack([np.ones(len(half)), friction]) * weights[:, None]
        solution = np.linalg.lstsq(matrix, half * weights, rcond=None)[0]
        degrees = len(half) - 2
        left = float(np.sum((half * weights - matrix @ solution) ** 2)) / degrees
        scale = max(left, 1.0) if known else left
        deviations = np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix)) * scale) * student.ppf(0.975, degrees)
        return Sides(float(solution[0]), float(deviations[0]), float(solution[1]), float(deviations[1]))

    def friction(self) -> tuple[Array, Array]:
        """Return the current that both directions share and its standard error, shape (m,) each.

        Where one direction was not measured, what is constant beside friction is taken off the other.
        """
        shares = self.shares()
        offset = 0.0 if np.isnan(shares.offset) else shares.offset
        asymmetry = 0.0 if np.isnan(shares.asymmetry) else shares.asymmetry
        alone = np.array([(self.sides[0] - offset) / (1 + asymmetry), (self.sides[1] + offset) / (1 - asymmetry)])
        both = self.both
        mean = np.where(both, self.sides.mean(axis=0), np.where(np.isfinite(self.sides[0]), alone[0], alone[1]))
        error = np.where(both, 0.5 * np.hypot(*self.errors), np.nansum(self.errors, axis=0))
        return mean, error

    def curve(self) -> Array:
        """Return the friction that turns as rarely as the readings allow, shape (m,)."""
        mean, error = self.friction()
        return least_turning(self.speeds, mean, error)


def levels_of(velocities: Array, currents: Array, errors: Array, within: float) -> Levels:
    """Return the levels of readings, shape (n,) each; speeds within a share ``within`` of the lowest one are a level.

    ``errors``: standard errors of the readings, NaN where they are not known.
    """
    speeds = np.abs(velocities)
    order = np.argsort(speeds, kind="stable")
    level, number, start = np.empty(len(speeds), dtype=np.int64), -1, -1.0
    ratio = max(1.0 + within, (speeds.max() / max(speeds.min(), RESOLUTION)) ** (1.0 / LEVELS_MAX))
    for at in order:
        if number < 0 or speeds[at] > max(start * ratio, start + RESOLUTION):
            number, start = number + 1, speeds[at]
        level[at] = number
    count = number + 1
    sides, known = np.full((2, count), np.nan), np.full((2, count), np.nan)
    spreads, sizes, dropped = np.full((2, count), np.nan), np.zeros((2, count)), 0
    for way, sign in enumerate((1.0, -1.0)):
        for k in range(count):
            here = (level == k) & (np.sign(velocities) == sign)
            if not here.any():
                continue
            values, own = sign * currents[here], errors[here]
            good = _good(values)
            dropped += int(np.sum(~good))
            values, own = values[good], own[good]
            sizes[way, k], sides[way, k] = len(values), values.mean()
            known[way, k] = np.sqrt(np.sum(own**2)) / len(own)
            if len(values) > 1:
                spreads[way, k] = values.std(ddof=1)
    if np.isfinite(spreads).any():
        # Few readings a level tell little about their own scatter: all together tell more.
        freedom = np.maximum(sizes - 1.0, 0.0)
        pooled = np.sqrt(np.nansum(freedom * spreads**2) / max(freedom.sum(), 1.0))
        scatter = np.where(sizes > 3, np.fmax(spreads, 0.5 * pooled), pooled) / np.sqrt(np.maximum(sizes, 1.0))
        known = np.where(sizes > 0, np.fmax(known, scatter), np.nan)
    mean = np.bincount(level, speeds) / np.bincount(level)
    rounded = np.round(np.maximum(np.round(mean / RESOLUTION), 1.0) * RESOLUTION, 9)
    return Levels(rounded, sides, known, dropped)


def _good(values: Array) -> Mask:
    """Tell which of the values do not lie far out; of fewer than four all count."""
    if len(values) < 4:
        return np.ones(len(values), dtype=bool)
    away = np.abs(values - np.median(values))
    spread = 1.4826 * float(np.median(away))
    return np.asarray(away <= OUTLYING * spread + 1e-9 * np.abs(values).max())
