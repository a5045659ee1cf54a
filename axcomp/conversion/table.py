"""What every format is converted through: one axis corrected over the position of one axis.

Sign: a value is what is **added to the setpoint**, whatever the format calls it. A leadscrew table of the lists holds
actual − programmed and is subtracted (semantics §5), so it changes its sign here; a cross table is added as it is (§6).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..model import Curve, Quantity, Shown, shown, symbol
from .text import CannotHoldError, Unit

_UNITS: dict[str, Unit] = {"mm": "mm", "°": "deg"}

ON_GRID = 1e-4
"""How far a point may lie off its position and still count as equidistant, mm or °: what the lists resolve."""
EXACT = 1e-9
"""Differences up to this, in mm or °, come from the arithmetic alone."""


@dataclass(frozen=True, repr=False)
class CompensationTable:
    """Corrections of one axis over the position of an axis.

    Attributes
    ----------
    axis : str
        The axis that is corrected.
    over : str
        The axis whose position is looked up; the same one for a leadscrew compensation.
    positive : Curve
        Added to the setpoint in positive motion of ``over``.
    negative : Curve or None
        The same in negative motion, at the same points; None: ``positive`` serves both.
    """

    axis: str
    over: str
    positive: Curve
    negative: Curve | None = None

    @classmethod
    def of(
        cls,
        axis: str,
        over: str,
        positions: Sequence[float],
        positive: Sequence[float],
        negative: Sequence[float] | None = None,
        period: float | None = None,
        unit: Unit = "mm",
        over_unit: Unit = "mm",
    ) -> CompensationTable:
        """Return the table of these values; two equal columns serve both directions as one.

        Raises
        ------
        ValueError
            Points or values are not what a ``Curve`` takes.
        """
        sides = [positive] if negative is None or tuple(negative) == tuple(positive) else [positive, negative]
        quantities = Quantity("position", symbol(over_unit), over), Quantity("correction", symbol(unit), axis)
        name = name_of(axis, over)
        return cls(axis, over, *(Curve(tuple(positions), tuple(side), *quantities, period, name) for side in sides))

    @property
    def kind(self) -> str:
        """``leadscrew`` or ``cross``."""
        return "leadscrew" if self.axis == self.over else "cross"

    @property
    def name(self) -> str:
        """The table in words, as messages call it."""
        return name_of(self.axis, self.over)

    @property
    def positions(self) -> tuple[float, ...]:
        """Points of both curves."""
        return self.positive.x

    @property
    def period(self) -> float | None:
        """It repeats after it; None: it does not."""
        return self.positive.period

    @property
    def unit(self) -> Unit:
        """``mm`` or ``deg``: of the corrections."""
        return _UNITS[self.positive.of.unit]

    @property
    def over_unit(self) -> Unit:
        """``mm`` or ``deg``: of the positions."""
        return _UNITS[self.positive.over.unit]

    @property
    def shown(self) -> Shown:
        """Unit in which differences of its corrections are shown, µm or ″, with its factor."""
        return shown(self.positive.of.unit)

    def __repr__(self) -> str:
        sides = "unilateral" if self.negative is None else "bilateral"
        span = f"{self.positions[0]:g} … {self.positions[-1]:g}"
        return f"CompensationTable({self.axis} over {self.over}, {len(self.positions)} points {span}, {sides})"

    def curve(self, direction: int) -> Curve:
        """Return the curve for a direction of motion, +1 or −1."""
        return self.positive if direction > 0 or self.negative is None else self.negative

    def at(self, positions: Iterable[float], direction: int = 1) -> list[float]:
        """Return the corrections at positions of ``over``, moving in a direction (+1 or −1)."""
        return self.curve(direction).at(positions)

    def mapped(self, change: Callable[[Curve], Curve]) -> CompensationTable:
        """Return the table with all its curves changed."""
        negative = None if self.negative is None else change(self.negative)
        return CompensationTable(self.axis, self.over, change(self.positive), negative)


def name_of(axis: str, over: str) -> str:
    """Return a table in words: ``the cross table of Z over X``."""
    return f"the leadscrew table of {axis}" if axis == over else f"the cross table of {axis} over {over}"


def beginning_at(table: CompensationTable, start: float) -> CompensationTable:
    """Return a table that repeats with its first point elsewhere, and the last one a period behind it.

    Raises
    ------
    CannotHoldError
        If the table jumps where it begins again.
    """
    begins = table.positions[0]
    if begins != start and any(table.curve(direction).jumps for direction in (1, -1)):
        raise CannotHoldError(f"{table.name} jumps at {begins:g} {table.over_unit}: it cannot begin at {start:g}")
    return table.mapped(lambda curve: curve.beginning_at(start))


def on_equidistant_points(table: CompensationTable, max_points: int, within: float | None) -> CompensationTable:
    """Return the table on exactly equidistant points; a table that repeats ends one period after it begins.

    ``within``: how many µm (″) another choice of points may change the corrections; None: the points stay as they are.

    Raises
    ------
    CannotHoldError
        If the points are not equidistant and no bound is stated, the bound cannot be met, or there are too many points.
    """
    full = table.mapped(Curve.closed)
    x = full.positions
    if len(x) == 1:
        # A constant: any second point makes a distance.
        return full.mapped(lambda curve: replace(curve, x=(x[0], x[0] + 1.0), y=curve.y * 2))
    even = np.linspace(x[0], x[-1], len(x))
    if np.max(np.abs(even - x)) <= ON_GRID:
        if len(x) > max_points:
            raise CannotHoldError(f"{table.name} has {len(x)} points; there is room for {max_points}")
        return full.mapped(lambda curve: replace(curve, x=tuple(even.tolist())))
    factor, unit = table.shown
    if within is None:
        gaps = np.diff(x)
        raise CannotHoldError(
            f"the points of {table.name} are {gaps.min():g} to {gaps.max():g} {table.over_unit} apart, but must be "
            f"equidistant: say how many {unit} other points may cost (--within)"
        )
    least = np.inf
    for count in range(2, max_points + 1):
        points = np.linspace(x[0], x[-1], count)
        off = max(_off(curve, points) for curve in (full.positive, full.negative) if curve is not None)
        if off <= within / factor + EXACT:
            return full.mapped(lambda curve, points=points: curve.on(points.tolist()))  # type: ignore[misc]
        least = min(least, factor * off)
    raise CannotHoldError(
        f"{table.name} on up to {max_points} equidistant points is {least:.3f} {unit} off at best, "
        f"not {within:g} {unit}"
    )


def _off(curve: Curve, points: np.ndarray) -> float:
    """Return how far a curve is off through other points of its own: the largest difference is at the old ones."""
    through = np.interp(curve.x, points, np.interp(points, curve.x, curve.y))
    return float(np.max(np.abs(through - curve.y)))


class Difference(NamedTuple):
    """The largest difference of two tables: how much (µm or ″), at which position, in which direction (±1)."""

    size: float
    position: float
    direction: int


def largest_difference(one: CompensationTable, other: CompensationTable) -> Difference:
    """Compare two tables in both directions."""
    gaps = [(one.curve(direction).largest_gap(other.curve(direction)), direction) for direction in (1, -1)]
    (size, position), direction = max(gaps, key=lambda gap: gap[0].size)
    return Difference(one.shown.factor * size, position, direction)
