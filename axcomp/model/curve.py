"""Values over one quantity: linear between the points, the end values held outside, or repeating."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple, overload

from .quantity import Quantity

ROUNDING = 1e-12
"""Relative error that sums of distances may have."""
BESIDE = 1e-8
"""Share of the period that counts as just beside a jump."""


class Gap(NamedTuple):
    """The largest difference of two curves, its size, and where it is."""

    size: float
    at: float


@dataclass(frozen=True, repr=False)
class Curve:
    """Values over one quantity.

    Attributes
    ----------
    x : tuple of float
        Points, finite and strictly ascending, at least one.
    y : tuple of float
        Finite values, one for each point.
    over, of : Quantity
        Of the points and of the values.
    period : float or None
        It repeats every ``period``, beginning at the first point; from the last point on it leads back to the first
        one. None: it does not repeat.
    label : str
        Tells curves of one table apart.
    entry : str
        List parameter that holds its values, ``kw.crosscomp.table[i].correction``; "" where they stand in none.
    sign : float
        1: the values are added to the setpoint; −1: they are subtracted.
    note : str
        What else holds for it, in words.

    Raises
    ------
    ValueError
        Points or values are not such; the sentence begins with the label.

    Examples
    --------
    >>> from axcomp import Curve
    >>> from axcomp.model import Quantity
    >>> curve = Curve((0.0, 100.0), (0.0, 0.01), Quantity("position", "mm", "X"), Quantity("correction", "mm", "X"))
    >>> curve.at([50.0, 200.0])
    [0.005, 0.01]
    """

    x: tuple[float, ...]
    y: tuple[float, ...]
    over: Quantity
    of: Quantity
    period: float | None = None
    label: str = ""
    entry: str = ""
    sign: float = 1.0
    note: str = ""

    def __post_init__(self) -> None:
        name = self.label or "the curve"
        if not self.x:
            raise ValueError(f"{name} has no points")
        if len(self.x) != len(self.y):
            raise ValueError(f"{name} has not one value for each of its {len(self.x)} points")
        if not all(math.isfinite(number) for number in (*self.x, *self.y)):
            raise ValueError(f"{name} holds a number that is not finite")
        if any(a >= b for a, b in pairwise(self.x)):
            raise ValueError(f"the points of {name} do not ascend")
        if self.period is not None and not max(self.span * (1.0 - ROUNDING), 0.0) < self.period < math.inf:
            raise ValueError(f"{name} is longer than the {self.period:g} {self.over.unit} after which it repeats")

    def __repr__(self) -> str:
        repeats = "" if self.period is None else f", repeats every {self.period:g}"
        return f"Curve({self.of} over {self.over}, {len(self.x)} points {self.x[0]:g} … {self.x[-1]:g}{repeats})"

    @property
    def span(self) -> float:
        """Distance of the last point from the first one."""
        return self.x[-1] - self.x[0]

    @property
    def jumps(self) -> bool:
        """Whether it repeats and does not begin with the value it ended with."""
        return self.period is not None and self._closed.y[0] != self._closed.y[-1]

    @cached_property
    def _closed(self) -> Curve:
        if self.period is None or self.span >= self.period * (1.0 - ROUNDING):
            return self
        return replace(self, x=(*self.x, self.x[0] + self.period), y=(*self.y, self.y[0]))

    def closed(self) -> Curve:
        """Return the curve with the way back to its first point as a point of its own, where it repeats."""
        return self._closed

    @overload
    def at(self, x: float) -> float: ...
    @overload
    def at(self, x: Iterable[float]) -> list[float]: ...
    def at(self, x: float | Iterable[float]) -> float | list[float]:
        """Return the value at the place ``x``, or the values at several."""
        if isinstance(x, Iterable):
            return [self._value(place) for place in x]
        return self._value(x)

    def _value(self, place: float) -> float:
        x, y = self._closed.x, self._closed.y
        if self.period is not None:
            place -= self.period * math.floor((place - x[0]) / self.period)
            if place >= x[0] + self.period:
                place = x[0]
        after = bisect_right(x, place)
        if after == 0:
            return y[0]
        if after == len(x):
            return y[-1]
        slope = (y[after] - y[after - 1]) / (x[after] - x[after - 1])
        return y[after - 1] + slope * (place - x[after - 1])

    def slopes(self) -> tuple[float, ...]:
        """Return the slope between each point and the next one."""
        return tuple((y2 - y1) / (x2 - x1) for (x1, y1), (x2, y2) in pairwise(zip(self.x, self.y, strict=True)))

    def scaled(self, factor: float) -> Curve:
        """Return the curve with all values multiplied by ``factor``."""
        return replace(self, y=tuple(factor * value + 0.0 for value in self.y))

    def shown(self) -> Curve:
        """Return the curve in the unit that small values are shown in."""
        return replace(self.scaled(self.of.factor), of=self.of.scaled())

    def added(self) -> Curve:
        """Return the curve with what is added to the setpoint as values."""
        return replace(self.scaled(self.sign), sign=1.0)

    def on(self, x: Iterable[float]) -> Curve:
        """Return the curve with the points ``x``, which lie between its first and its last one."""
        # Not at(): the end of a curve that repeats is a point of its own here.
        places = tuple(x)
        return replace(self, x=places, y=tuple(replace(self, period=None).at(places)))

    def beginning_at(self, start: float) -> Curve:
        """Return a curve that repeats with its first point at ``start``, and the last one a period behind it.

        Raises
        ------
        ValueError
            It does not repeat, or it jumps where it begins again: it cannot begin elsewhere.
        """
        if self.x[0] == start:
            return self._closed
        if self.period is None or self.jumps:
            raise ValueError(f"{self.label or 'the curve'} cannot begin at {start:g}")
        inside = {start + (place - start) % self.period for place in self.x}
        end = start + self.period
        x = tuple(sorted({start, *(place for place in inside if place < end), end}))
        return replace(self, x=x, y=tuple(self.at(x)))

    def minus(self, other: Curve) -> Curve:
        """Return the difference to ``other`` at the points of both."""
        x = tuple(sorted({*self._closed.x, *other.closed().x}))
        y = tuple(a - b for a, b in zip(self.at(x), other.at(x), strict=True))
        return replace(self, x=x, y=y, of=self.of.changed(), period=None)

    def largest_gap(self, other: Curve) -> Gap:
        """Return the largest difference to ``other``: at a point of one of them; both are straight between."""
        places = {*self._closed.x, *other.closed().x}
        if self.period != other.period:
            # Where one of them repeats, the turns before and behind it count too.
            for curve in (self, other):
                turn = curve.period or 0.0
                places |= {place + sign * turn for place in curve.closed().x for sign in (-1.0, 1.0)}
        for curve in (self, other):
            if curve.jumps:
                places = {beside for place in places for beside in curve.beside_jump(place)}
        x = sorted(places)
        gaps = [abs(a - b) for a, b in zip(self.at(x), other.at(x), strict=True)]
        worst = max(range(len(x)), key=gaps.__getitem__)
        return Gap(gaps[worst], x[worst])

    def beside_jump(self, place: float) -> tuple[float, ...]:
        """Return ``place``, or the two beside it where the curve jumps and has two values there."""
        assert self.period is not None
        turns = (place - self.x[0]) / self.period
        if abs(turns - round(turns)) >= 0.5 * BESIDE:
            return (place,)
        return (place - BESIDE * self.period, place + BESIDE * self.period)
