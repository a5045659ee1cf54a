"""Setpoints of smooth motions from rest to rest, one value a cycle.

A move is a rectangular pulse of velocity, averaged over the time of the acceleration and again over the time of its
rise: position, velocity and acceleration are continuous, the limits kept and the target hit exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Limits:
    """Of a move, per s, s² and s³ in mm or °."""

    velocity: float = 100.0
    acceleration: float = 1000.0
    jerk: float = 2e4


@dataclass(frozen=True)
class Setpoints:
    """What a controller commands one axis, shape (cycles,) each, in mm or °, per s and s²."""

    position: Array
    velocity: Array
    acceleration: Array

    @classmethod
    def through(cls, position: Array, cycle_time: float) -> Setpoints:
        """Return the path with positions given and the derivatives by central differences; at rest at both ends."""
        padded = np.concatenate([position[:1], position, position[-1:]])
        velocity = (padded[2:] - padded[:-2]) / (2.0 * cycle_time)
        acceleration = (padded[2:] - 2.0 * padded[1:-1] + padded[:-2]) / cycle_time**2
        return cls(position, velocity, acceleration)


def move(start: float, end: float, cycle_time: float, limits: Limits) -> Array:
    """Return the positions of a move from rest to rest, shape (cycles,), the last of them ``end``."""
    length = end - start
    if length == 0.0:
        return np.empty(0)
    spans = (abs(length) / limits.velocity, limits.velocity / limits.acceleration, limits.acceleration / limits.jerk)
    cruise, rise, round_off = (max(1, int(np.ceil(span / cycle_time - 1e-9))) for span in spans)
    if cruise < rise + round_off:
        # Acceleration turns into deceleration at once: equal pulses keep it within its limit, a change of twice its
        # size takes twice the time.
        cruise = rise = max(cruise, int(np.ceil(np.sqrt(abs(length) / limits.acceleration) / cycle_time)))
        round_off *= 2
    pulse = np.full(cruise, 1.0 / cruise)
    for width in (rise, round_off):
        pulse = np.convolve(pulse, np.full(width, 1.0 / width))
    positions: Array = start + length * np.cumsum(pulse)
    positions[-1] = end
    # Rounding must not carry it beyond the end, for it would come back then: a reversal.
    return np.clip(positions, min(start, end), max(start, end))


class Course:
    """A motion of several axes, put together piece by piece from where each stands at first, mm or °.

    ``cycles``: its length so far; the first cycle is the start.
    """

    def __init__(self, start: Mapping[str, float], cycle_time: float) -> None:
        self.cycle_time = cycle_time
        self.cycles = 1
        self._pieces = {name: [np.array([position])] for name, position in start.items()}

    def where(self, name: str) -> float:
        """Return where an axis stands now."""
        return float(self._pieces[name][-1][-1])

    def follow(self, positions: Mapping[str, Array]) -> int:
        """Go through given positions, one a cycle; who has fewer or none waits at the end. Return ``cycles``."""
        count = max((len(piece) for piece in positions.values()), default=0)
        if count:
            for name, pieces in self._pieces.items():
                piece = positions.get(name, np.empty(0))
                last = float(piece[-1]) if len(piece) else self.where(name)
                pieces.append(np.concatenate([piece, np.full(count - len(piece), last)]))
            self.cycles += count
        return self.cycles

    def move(self, targets: Mapping[str, float], limits: Limits = Limits()) -> int:
        """Move to the targets, each axis within the limits on its own. Return ``cycles``."""
        return self.follow({n: move(self.where(n), target, self.cycle_time, limits) for n, target in targets.items()})

    def dwell(self, duration: float) -> int:
        """Stand still for ``duration`` s. Return ``cycles``."""
        name = next(iter(self._pieces))
        return self.follow({name: np.full(round(duration / self.cycle_time), self.where(name))})

    def setpoints(self) -> dict[str, Setpoints]:
        """Return what the controller commands each axis, shape (cycles,) each."""
        return {n: Setpoints.through(np.concatenate(pieces), self.cycle_time) for n, pieces in self._pieces.items()}
