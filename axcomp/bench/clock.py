"""Timing: medians with their spread, never a single number."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Sample:
    """Repeated measurements of one cost.

    ``unit``: ``µs`` or ``ns`` for cycles, ``s`` or ``ms`` for what happens once, ``MB`` for memory and files, ``:1``
    for how much more something costs, ``×`` for how much faster it is. ``goal``: what it may be at most, in the same
    unit, of ``×`` at least; None: no figure is set.
    """

    name: str
    unit: str
    values: tuple[float, ...]
    goal: float | None = None

    @property
    def median(self) -> float:
        """Return the median."""
        return statistics.median(self.values)

    @property
    def at(self) -> str:
        """Say on which side of the goal the median should be."""
        return "at least" if self.unit == "×" else "at most"

    @property
    def missed(self) -> bool:
        """Whether there is a goal and the median is beyond it."""
        return self.goal is not None and (self.median < self.goal if self.unit == "×" else self.median > self.goal)

    @property
    def low(self) -> float:
        """Return the least value."""
        return min(self.values)

    @property
    def high(self) -> float:
        """Return the greatest value."""
        return max(self.values)


def ratio(name: str, one: Sample, others: tuple[Sample, ...], goal: float | None = None) -> Sample:
    """Return how much more one cost is than the medians of others together."""
    limit = sum(other.median for other in others)
    return Sample(name, ":1", tuple(value / limit for value in one.values), goal)


def sample(
    name: str, unit: str, work: Callable[[], object], *, repeats: int = 7, each: int = 1, goal: float | None = None
) -> Sample:
    """Run ``work`` a few times after a warm-up; ``each`` is the number of cycles that one call runs."""
    scale = {"s": 1.0, "ms": 1e3, "µs": 1e6}[unit] / each
    work()
    values = []
    for _ in range(repeats):
        begin = time.process_time()
        work()
        values.append(scale * (time.process_time() - begin))
    return Sample(name, unit, tuple(values), goal)
