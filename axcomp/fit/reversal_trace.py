"""How a list's friction current should reverse, from the reversals in a trace.

At a reversal friction goes from −F to F over some travel; a list lets its current decay to 0 over
``reversal_lookahead`` cycles before, and build up over ``position_delay`` after. Both are those that come closest by
least squares; the drive follows the setpoint late, so the current comes as many cycles late (``delay_cycles``).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..engine import Array
from ..kernel import LOOKAHEAD_MAX
from ..measurement import AxisTrace

TRAVEL = 1.0
"""After a reversal, within which friction is looked at, mm or °."""
LATE_MAX = 20
"""Cycles by which a drive may follow its setpoint."""
BUILD_UPS = np.geomspace(1e-4, 0.5, 120)


class ReversalSettings(NamedTuple):
    """What is proposed, from how many reversals; ``delay_cycles`` is None where setpoint or position is missing."""

    position_delay: float
    reversal_lookahead: int
    delay_cycles: int | None
    reversals: int


def reversals_of(
    trace: AxisTrace, speeds: Array, friction: Array, offset: float, inertia: float
) -> ReversalSettings | None:
    """Return what is proposed, None if the axis does not reverse in motion.

    Parameters
    ----------
    trace : AxisTrace
        With a current.
    speeds, friction : array, shape (m,)
        The table: current against motion over the speed.
    offset, inertia : float
        Constant current, and current per acceleration.
    """
    velocity, way = trace.velocity(), trace.travelled()
    share = trace.columns["current"] - offset - inertia * trace.acceleration()
    share = share / np.interp(np.abs(velocity), speeds, friction)
    least = max(1e-3, 0.02 * float(np.quantile(np.abs(velocity), 0.9)))
    travel, after, before = [], [], []
    for at in np.flatnonzero(velocity[:-1] * velocity[1:] < 0.0) + 1:
        sign = 1.0 if velocity[at] > 0.0 else -1.0
        gone = sign * (way[at:] - way[at])
        beyond = np.flatnonzero((gone > TRAVEL) | (gone < -1e-3 * TRAVEL))
        end = at + int(beyond[0] if len(beyond) else len(gone))
        came = -sign * velocity[max(0, at - 50) : at]
        if (
            end - at < 5
            or gone[end - at - 1] < 0.1 * TRAVEL
            or len(came) < 50
            or came.max() < least
            or (came < 0.0).any()
        ):
            continue
        travel.append(gone[: end - at])
        after.append(sign * share[at:end])
        before.append(-sign * share[at - LOOKAHEAD_MAX : at])
    if not travel:
        return None
    s, r = np.concatenate(travel), np.clip(np.concatenate(after), -1.0, 1.5)
    # Each bit of travel counts alike, however fast it was gone.
    weights = np.clip(np.concatenate([np.gradient(t) for t in travel]), 0.0, None)
    costs = [float(np.sum(weights * (r - np.minimum(s / d, 1.0)) ** 2)) for d in BUILD_UPS]
    decay = np.median(np.array(before), axis=0)
    left = np.arange(LOOKAHEAD_MAX, 0, -1) - 1.0  # cycles to the reversal, the last one before it has 0
    ahead = [
        float(np.sum((decay - np.minimum(left / n, 1.0)) ** 2)) if n else float(np.sum((decay - 1.0) ** 2))
        for n in range(5)
    ]
    late = _late(trace)
    lookahead = int(np.argmin(ahead[: LOOKAHEAD_MAX + 1]))
    if late is not None:
        lookahead = min(lookahead, late)
    return ReversalSettings(round(float(BUILD_UPS[int(np.argmin(costs))]), 4), lookahead, late, len(travel))


def _late(trace: AxisTrace) -> int | None:
    """Return by how many cycles the position follows the setpoint, None where one of them is missing."""
    if not (trace.has("setpoint") and trace.has("position")):
        return None
    setpoint, position = trace.columns["setpoint"], trace.columns["position"]
    count = len(setpoint) - LATE_MAX
    if count < 2 * LATE_MAX:
        return None
    off = [float(np.mean((position[n : n + count] - setpoint[:count]) ** 2)) for n in range(LATE_MAX)]
    return int(np.argmin(off))
