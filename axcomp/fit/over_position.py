"""What fits from positioning measurements have in common: readings at targets, in either direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, TypeVar

import numpy as np

from ..engine import Array
from ..measurement import SYMBOLS, Outlier, Positioning, evaluate, read_positioning
from ..model import Curve, Quantity, symbol
from ..plot import DOWN, UP, labelled
from .creation import CannotCreateError, Report
from .driver import Fit, rounded

if TYPE_CHECKING:
    from matplotlib.axes import Axes

T = TypeVar("T")
_SPAN_TOLERANCE = 1e-6


class OverPosition(Fit[Positioning, T]):
    """A fit from a positioning measurement.

    Attributes
    ----------
    both : bool
        Positive and negative direction count on their own; else their mean does.
    period : float or None
        The table repeats with it.
    """

    read = staticmethod(read_positioning)
    labels: ClassVar = {
        **{name: SYMBOLS[name] for name in ("A", "A_up", "A_down", "E", "E_up", "E_down", "R", "M", "B", "B_mean")},
        "largest": "largest reading",
    }
    both = False
    period: float | None = None

    def counts_in(self) -> str:
        """Return what the axis that deviates counts in."""
        return self.readings.deviating

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that stand apart from those of the same target and direction."""
        return self.readings.outliers()

    def figures(self, left: Array) -> dict[str, float]:
        """Return the figures of ISO 230-2, and the largest reading."""
        return {**evaluate(self.readings.with_deviations(left)).parameters(), "largest": float(np.max(np.abs(left)))}

    def means(self, readings: Positioning) -> Positioning:
        """Return mean deviations at targets with enough readings, first all in positive, then all in negative one."""
        result = evaluate(readings)
        positions = rounded(result.positions)
        if self.both:
            means = np.array([result.mean_up, result.mean_down])
        elif np.all(np.isnan(result.mean)):
            means = np.tile(np.where(np.isnan(result.mean_up), result.mean_down, result.mean_up), (2, 1))
        else:
            means = np.tile(result.mean, (2, 1))
        known = ~np.isnan(means).any(axis=0)
        positions, means = positions[known], means[:, known]
        if len(positions) == 0:
            raise CannotCreateError("no target was measured in every direction that is needed")
        if np.any(np.diff(positions) <= 0.0):
            raise CannotCreateError("there are targets less than 0.0001 apart, which a list cannot hold")
        if self.period is not None and abs(np.ptp(positions) - self.period) <= _SPAN_TOLERANCE:
            # Both ends are the same place of a modulo axis.
            means[:, [0, -1]] = means[:, [0, -1]].mean(axis=1, keepdims=True)
        count = len(positions)
        return replace(
            readings,
            targets=np.tile(positions, 2),
            runs=np.ones(2 * count, dtype=np.int64),
            directions=np.repeat([1, -1], count),
            deviations=means.ravel(),
        )

    def report(self, table: T) -> Report:
        """Say which targets do not count, too."""
        missing = len(self.readings.grid()[0]) - len(self.means(self.readings).targets) // 2
        sentence = f"{missing} targets lack readings in a direction that is needed; they are left out."
        return super().report(table).noted(sentence if missing else "")

    def draw(self, ax: Axes, table: T) -> None:
        """Draw mean deviations and what is left of them."""
        before = evaluate(self.readings)
        after = evaluate(self.readings.with_deviations(self.left(table, self.readings)))
        for colour, arrow, old, new in (
            (UP, "↑", before.mean_up, after.mean_up),
            (DOWN, "↓", before.mean_down, after.mean_down),
        ):
            if not np.all(np.isnan(old)):
                ax.plot(before.positions, old, "-", color=colour, lw=1.3, label=f"measured x̄{arrow}")
                ax.plot(before.positions, new, "--", color=colour, lw=1.1, label=f"predicted x̄{arrow}")
        self.draw_table(ax, table)
        ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
        labelled(ax, "", f"position [{symbol(self.readings.unit)}]", f"deviation [{self.small}]")
        ax.legend(loc="best", ncols=2, fontsize=10)

    def draw_table(self, ax: Axes, table: T) -> None:
        """Draw the points of the table."""


Sides = tuple[Curve, Curve]
"""Errors over one position in positive and in negative direction, µm or ″."""


class SidedFit(OverPosition[Sides]):
    """A fit of a table with errors over one position; ``shown_as``: what its points are called in the picture."""

    shown_as = "table"

    def sides(self, positions: Array, values: Array, period: float | None = None) -> Sides:
        """Return errors (2, m) in µm or ″ over positions (m,); outside the end values hold, or they repeat."""
        if period is not None and np.ptp(positions) > period + _SPAN_TOLERANCE:
            raise CannotCreateError(f"a modulo table spans {period:g}° at most, not {np.ptp(positions):g}°")
        over, of = Quantity("position", "mm or °"), Quantity("error", self.small)
        x = tuple(positions.tolist())
        up, down = (Curve(x, tuple(side), over, of, period) for side in values.tolist())
        return up, down

    def table(self, means: Positioning) -> Sides:
        """Return what a list will hold: thinned, rounded, on top of an old table where there is one."""
        positions, values = np.split(means.targets, 2)[0], means.deviations.reshape(2, -1)
        measured = self.sides(positions, values, self.period)
        if self.old is not None:
            positions = np.union1d(positions, rounded(np.array(self.old[0].x)))
            values = np.array([side.at(positions) for side in measured]) + [side.at(positions) for side in self.old]
        chosen = self.chosen(positions, values)
        return self.sides(positions[chosen], self.listed(values[:, chosen]), self.period)

    def removed(self, table: Sides, readings: Positioning) -> Array:
        """Return the errors of the direction of each reading."""
        up, down = (side.at(readings.targets) for side in table)
        return np.where(readings.directions > 0, up, down)

    def report(self, table: Sides) -> Report:
        """Say that a size cannot change at run time, too."""
        changed = self.options.max_points is not None and self.target.exists
        sentence = "A controller that runs refuses another max_points (110638, 110639): start it up anew."
        return super().report(table).noted(sentence if changed else "")

    def draw_table(self, ax: Axes, table: Sides) -> None:
        """Draw the points of each direction."""
        for place, side in enumerate(table if table[0].y != table[1].y else table[:1]):
            ax.plot(side.x, side.y, ".", color="0.2", ms=5, label=None if place else self.shown_as)
