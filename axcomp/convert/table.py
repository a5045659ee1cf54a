"""What every format is converted through: one axis corrected over the position of one axis.

Sign: a value is what is **added to the setpoint**, whatever the format calls it. A leadscrew table of the lists holds
actual − programmed and is subtracted (semantics §5), so it changes its sign here; a cross table is added as it is (§6).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Unit = Literal["mm", "deg"]

MM_PER_INCH = 25.4
ROUNDING = 1e-12
"""Relative error that sums of distances may have."""
DENSE = 10_001
"""Places at which two tables are compared besides their interpolation points."""
BEYOND = 0.1
"""Share of the range by which the comparison goes beyond both ends, where the end values are held."""


class FormatError(ValueError):
    """A file that is not of its format, with the line that shows it (counted from 1; 0: the file as a whole)."""

    def __init__(self, line: int, message: str) -> None:
        self.line = line
        self.message = message
        super().__init__(f"line {line}: {message}" if line else message)


class CannotHoldError(ValueError):
    """A table that the other format has no room for: the message says which one and what is missing."""


@dataclass(frozen=True, repr=False)
class CompensationTable:
    """Corrections of one axis over the position of an axis: linear between the points, the end values held outside.

    Attributes
    ----------
    axis : str
        The axis that is corrected.
    over : str
        The axis whose position is looked up; the same one for a leadscrew compensation.
    positions : tuple of float
        Interpolation points, strictly ascending, in ``over_unit``.
    positive : tuple of float
        Added to the setpoint in positive motion of ``over``, one for each point, in ``unit``.
    negative : tuple of float or None
        The same in negative motion; None: ``positive`` serves both.
    period : float or None
        The table repeats every ``period``, beginning at the first point; from the last point on it leads back to the
        first one. None: it does not repeat.
    unit, over_unit : str
        ``mm`` or ``deg``, by the type of either axis.
    """

    axis: str
    over: str
    positions: tuple[float, ...]
    positive: tuple[float, ...]
    negative: tuple[float, ...] | None = None
    period: float | None = None
    unit: Unit = "mm"
    over_unit: Unit = "mm"

    def __post_init__(self) -> None:
        if not self.positions:
            raise ValueError(f"{self.name} has no points")
        curves = (self.positive,) if self.negative is None else (self.positive, self.negative)
        if any(len(curve) != len(self.positions) for curve in curves):
            raise ValueError(f"{self.name} has not one value for each of its {len(self.positions)} points")
        if not all(math.isfinite(number) for row in (self.positions, *curves) for number in row):
            raise ValueError(f"{self.name} holds a number that is not finite")
        if any(a >= b for a, b in pairwise(self.positions)):
            raise ValueError(f"the points of {self.name} do not ascend")
        span = self.positions[-1] - self.positions[0]
        if self.period is not None and not 0.0 < span * (1.0 - ROUNDING) <= self.period < math.inf:
            raise ValueError(f"{self.name} is longer than the {self.period:g} {self.over_unit} after which it repeats")

    @property
    def kind(self) -> str:
        """``leadscrew`` or ``cross``."""
        return "leadscrew" if self.axis == self.over else "cross"

    @property
    def name(self) -> str:
        """The table in words, as messages call it."""
        over = "" if self.axis == self.over else f" over {self.over}"
        return f"the {self.kind} table of {self.axis}{over}"

    def __repr__(self) -> str:
        sides = "unilateral" if self.negative is None else "bilateral"
        span = f"{self.positions[0]:g} … {self.positions[-1]:g}"
        return f"CompensationTable({self.axis} over {self.over}, {len(self.positions)} points {span}, {sides})"

    def curve(self, direction: int) -> tuple[float, ...]:
        """Return the values for a direction of motion, +1 or −1."""
        return self.positive if direction > 0 or self.negative is None else self.negative

    def at(self, positions: npt.ArrayLike, direction: int = 1) -> Array:
        """Return the corrections at positions of ``over``, any shape, moving in a direction (+1 or −1)."""
        x = np.asarray(positions, dtype=float)
        table = closed(self)
        if table.period is not None:
            start = table.positions[0]
            folded = x - table.period * np.floor((x - start) / table.period)
            x = np.where(folded < start + table.period, folded, start)
        corrections: Array = np.interp(x, table.positions, table.curve(direction))
        return corrections


def closed(table: CompensationTable) -> CompensationTable:
    """Return the table with the way back to its first point as a point of its own, where it repeats."""
    if table.period is None or table.positions[-1] - table.positions[0] >= table.period * (1.0 - ROUNDING):
        return table
    return replace(
        table,
        positions=(*table.positions, table.positions[0] + table.period),
        positive=(*table.positive, table.positive[0]),
        negative=None if table.negative is None else (*table.negative, table.negative[0]),
    )


def beginning_at(table: CompensationTable, start: float) -> CompensationTable:
    """Return a table that repeats with its first point elsewhere, and the last one a period behind it.

    Raises
    ------
    CannotHoldError
        If the table jumps where it begins again.
    """
    assert table.period is not None
    full = closed(table)
    if any(full.curve(direction)[0] != full.curve(direction)[-1] for direction in (1, -1)):
        if full.positions[0] == start:
            return full
        raise CannotHoldError(
            f"{table.name} jumps at {full.positions[0]:g} {table.over_unit}: it cannot begin at {start:g}"
        )
    period = table.period
    inside = {start + (position - start) % period for position in table.positions}
    positions = tuple(sorted({start, *(position for position in inside if position < start + period), start + period}))
    curves = [tuple(full.at(positions, direction).tolist()) for direction in (1, -1)]
    negative = None if full.negative is None else curves[1]
    return replace(full, positions=positions, positive=curves[0], negative=negative)


def unilateral_if_equal(table: CompensationTable) -> CompensationTable:
    """Return the table without a second curve where it is the same as the first."""
    return replace(table, negative=None) if table.negative == table.positive else table


class Difference(NamedTuple):
    """The largest difference of two tables: how much (µm or m°), at which position, in which direction (±1)."""

    size: float
    position: float
    direction: int


def largest_difference(one: CompensationTable, other: CompensationTable) -> Difference:
    """Compare two tables at all their points, between them and beyond their ends, in both directions."""
    x = _places(one, other)
    worst = Difference(-1.0, 0.0, 1)
    for direction in (1, -1):
        gaps = np.abs(one.at(x, direction) - other.at(x, direction))
        place = int(np.argmax(gaps))
        if gaps[place] * 1e3 > worst.size:
            worst = Difference(float(gaps[place]) * 1e3, float(x[place]), direction)
    return worst


def _places(one: CompensationTable, other: CompensationTable) -> Array:
    points = np.unique(np.concatenate([one.positions, other.positions]))
    low, high = points[0], points[-1]
    margin = max(BEYOND * (high - low), 1.0)
    x = np.union1d(points, np.linspace(low - margin, high + margin, DENSE))
    for table in (one, other):
        if table.period is not None and table.positive[0] != closed(table).positive[-1]:
            # A table that jumps where it begins again has two values there: stay beside the jump.
            phase = np.abs((x - table.positions[0]) / table.period - np.round((x - table.positions[0]) / table.period))
            x = x[phase > 1e-9]
    return x
