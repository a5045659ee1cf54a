"""An axis of a plant that reverses on a circle: its quadrant peaks, and the friction parameters that leave least.

A circle of radius R at a feed f moves an axis by R · cos(f/R · t). Around a reversal its error, outward positive, is
looked at from ``BEFORE`` to ``AFTER`` cycles; the peak is what stands out farthest from the line between both ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..engine import Array, Engine, Limits, Setpoints, move
from ..kinds import Friction
from ..measurement import peak_of
from ..model import CYCLE_TIME, Axis, Machine, shown
from ..plant import Plant

BEFORE, AFTER = 10, 120
"""Cycles around a reversal in which its peak is looked for."""
RUN_UP = 0.35
"""Angle before the reversal at which the motion begins, rad."""
LATENCY = 2
"""Cycles by which the drives' reference, the mean of two setpoints, lags the setpoint, current and setpoint alike."""


class Circle(NamedTuple):
    """A test: radius in mm or °, feed in mm/s or °/s."""

    radius: float = 25.0
    feed: float = 50.0


class Peaks(NamedTuple):
    """Of the reversals at the positive and at the negative end, µm or ″, outward positive."""

    positive: float
    negative: float

    @property
    def largest(self) -> float:
        """The larger amount."""
        return max(abs(self.positive), abs(self.negative))


class ReversingAxis:
    """An axis of a plant that reverses at either end of a circle, the others at rest.

    Parameters
    ----------
    plant : Plant
    axis : str
        Its name there.
    circle : Circle
    before, after : int
        Cycles around the reversal that are looked at.
    plays : pair of float
        By which the slide stays behind after it, at the positive and at the negative end, mm or °.
    take_up : float
        Travel over which that is taken up, mm or °.
    """

    def __init__(
        self,
        plant: Plant,
        axis: str,
        circle: Circle,
        before: int = BEFORE,
        after: int = AFTER,
        plays: tuple[float, float] = (0.0, 0.0),
        take_up: float = 1e-3,
    ) -> None:
        self.plant, self.axis = plant, axis
        self.index = plant.names.index(axis)
        self.unit = plant.units[self.index]
        self.before, self.after = before, after
        self.plays, self.take_up = plays, take_up
        self._known: dict[Friction, Array] = {}
        rate = circle.feed / circle.radius
        quick = Limits(rate, 20.0 * rate, 1e3 * rate)
        angle = move(-RUN_UP, RUN_UP + (after + 100) * rate * CYCLE_TIME, CYCLE_TIME, quick)
        self.reversal = int(np.argmin(np.abs(angle)))
        angle = angle[: self.reversal + after + LATENCY + 2]
        self.setpoints = Setpoints.through(circle.radius * np.cos(angle), CYCLE_TIME)

    def errors(self, friction: Friction | None) -> Iterator[Array]:
        """Yield the error around the positive and the negative end, shape (before + after + 1,), µm or ″ outward."""
        current = self._current(friction)
        for end in (1.0, -1.0):
            yield shown(self.unit).factor * self._error(end * self.setpoints.position, end * current, end)

    def peaks(self, friction: Friction | None) -> Peaks:
        """Return the peaks with a friction compensation, or without any."""
        return Peaks(*(peak_of(error) for error in self.errors(friction)))

    def _current(self, friction: Friction | None) -> Array:
        """Return the current at the positive end; at the negative one it has the other sign."""
        if friction is None:
            return np.zeros(len(self.setpoints.position))
        late = friction.delay_cycles - friction.reversal_lookahead
        if late > 0 or friction.scaling != 1.0:
            # Weights do not depend on a delay that is long enough for them: the current only comes later.
            soon = replace(friction, scaling=1.0, delay_cycles=friction.delay_cycles - max(late, 0))
            if soon not in self._known:
                self._known[soon] = self._current(soon)
            current = friction.scaling * self._known[soon]
            return current if late <= 0 else np.concatenate([np.zeros(late), current[:-late]])
        engine = Engine(Machine((Axis(1, "A", friction=friction),)))
        names = {"setpoint": "position", "velocity": "velocity", "acceleration": "acceleration"}
        return np.asarray(engine.run({f"A.{n}": getattr(self.setpoints, of) for n, of in names.items()})["A.current"])

    def _error(self, raw: Array, current: Array, end: float) -> Array:
        """Return slide − setpoint around the reversal, mm or ° outward: play, and friction, which acts on the drive."""
        drive, count = self.plant.drives[self.index], max(1, math.ceil(CYCLE_TIME / self.plant.sub_step - 1e-6))
        drive.rest_at(float(raw[0]))
        measured = np.empty(len(raw))
        for cycle, (position, added) in enumerate(zip(raw.tolist(), current.tolist(), strict=True)):
            drive.advance(position, added, CYCLE_TIME, count)
            measured[cycle] = drive.position
        measured *= end
        # The encoder goes back before the slide does, which stays outside by all of its play in the end.
        back = np.maximum.accumulate(measured) - measured
        slide = measured + self.plays[end < 0.0] * np.minimum(back / self.take_up, 1.0)
        reference = 0.5 * end * (raw[1:] + raw[:-1])
        around = slice(self.reversal - self.before, self.reversal + self.after + 1)
        return np.asarray(slide[LATENCY - 1 :][around] - reference[LATENCY - 2 :][around])


@dataclass(frozen=True)
class Tuned:
    """Friction parameters that leave least of the peaks.

    Attributes
    ----------
    friction : Friction
        With them.
    without, before, left : Peaks
        Without compensation, with the parameters there were, and with these.
    """

    friction: Friction
    without: Peaks
    before: Peaks
    left: Peaks


DELAYS_MAX = 4
"""Cycles of delay that are tried."""
BUILD_UPS = (0.0, *(float(x) for x in np.geomspace(0.0002, 0.2, 16)))
"""Distances over which the current builds up that are tried at first, mm or °."""


def tune(axis: ReversingAxis, friction: Friction) -> Tuned:
    """Return the parameters ``scaling``, ``position_delay``, ``reversal_lookahead``, ``delay_cycles`` that serve best.

    The table stays. Look-ahead is not larger than the delay, where it is exact. One parameter after another is moved
    until none serves better, in the resolution of the lists.
    """
    known: dict[Friction, Peaks] = {}

    def rank(candidate: Friction) -> float:
        if candidate not in known:
            known[candidate] = axis.peaks(candidate)
        return known[candidate].largest

    def best(candidates: list[Friction]) -> Friction:
        return min(candidates, key=rank)

    found = best(
        [
            replace(friction, position_delay=round(d, 4), delay_cycles=n, reversal_lookahead=min(n, 1))
            for n in range(3)
            for d in BUILD_UPS[::3]
        ]
    )
    found = best([replace(found, position_delay=round(d, 4)) for d in BUILD_UPS] + [found])
    step = 0.3
    while step > 0.05:
        near = [
            *(replace(found, position_delay=round(found.position_delay * f, 4)) for f in (1.0 - step, 1.0 + step)),
            *(replace(found, scaling=round(found.scaling * f, 3)) for f in (1.0 - step / 3.0, 1.0 + step / 3.0)),
            *(
                replace(found, delay_cycles=n, reversal_lookahead=m)
                for n in range(max(0, found.delay_cycles - 1), min(DELAYS_MAX, found.delay_cycles + 1) + 1)
                for m in range(max(0, found.reversal_lookahead - 1), min(n, found.reversal_lookahead + 1) + 1)
            ),
        ]
        better = best([found, *near])
        if better == found:
            step *= 0.5
        found = better
    return Tuned(found, axis.peaks(None), axis.peaks(friction), known[found])
