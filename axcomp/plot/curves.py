"""Curves over one quantity: leadscrew, cross, friction, most crosstalk tables and errors of an axis."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ..model import Curve, Quantity
from .content import Content, Records, span
from .style import COLOURS, Array, finest, framed_figure, labelled, line_styles, printed, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE_RATIO = 50.0
"""From this ratio of the largest to the smallest point on, points are drawn on a logarithmic scale where it helps."""
MARKED_MAX = 150
"""More points than this are not marked: they would hide the line."""


@dataclass(frozen=True, eq=False)
class Curves(Content):
    """Some curves in one picture.

    Attributes
    ----------
    lines : tuple of Curve
        At least one, all over and of the same quantities, in the unit they are shown in; closed where they repeat.
    reversal : bool
        There are two lines whose difference is of interest: it is drawn below them.
    logarithmic : bool
        The points may be drawn on a logarithmic scale.
    zero_if_absent : bool
        A line that another machine lacks is 0 there.
    """

    lines: tuple[Curve, ...]
    reversal: bool = False
    logarithmic: bool = False
    zero_if_absent: bool = False

    @property
    def x(self) -> Quantity:
        """Of the points."""
        return self.lines[0].over

    @property
    def y(self) -> Quantity:
        """Of the values."""
        return self.lines[0].of

    def points(self) -> Array:
        """Return the points of all lines, ascending."""
        return np.unique(np.concatenate([line.x for line in self.lines]))

    def figure(self) -> Figure:
        """Return the curves, and below them their difference where it is of interest."""
        if not (self.reversal and len(self.lines) == 2):
            figure = framed_figure()
            plot_curves(figure.add_subplot(), self)
            return figure
        figure = framed_figure(1.3)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
        plot_curves(upper, self).set_xlabel("")
        plot_reversal(lower, self)
        return figure

    def records(self) -> Records:
        """Return point and values, a row for each point."""
        x = self.points()
        columns = [np.array(line.at(x)) for line in self.lines]
        names = [f"{line.label} [{self.y.unit}]" for line in self.lines]
        if self.reversal and len(columns) == 2:
            columns.append(columns[0] - columns[1])
            names.append(f"difference [{self.y.unit}]")
        return Records((str(self.x), *names), np.column_stack([x, *columns]).tolist())

    def summary(self) -> tuple[str, str, str]:
        """Return the number of points, the range of the points and of the values."""
        x = self.points()
        values = np.concatenate([line.y for line in self.lines])
        sides = f" × {len(self.lines)}" if len(self.lines) > 1 else ""
        return f"{len(x)}{sides}", span(x.tolist(), self.x.unit), span(np.round(values, 4).tolist(), self.y.unit)

    def against(self, other: Content) -> CurvesDifference:
        """Return the difference to curves of the same kind, line by line, at all points of both."""
        if not isinstance(other, Curves) or (self.x, self.y) != (other.x, other.y):
            self.not_comparable("the two tables are over different quantities")
        longer = other if len(other.lines) > len(self.lines) else self
        names = dict.fromkeys(line.label for line in (*longer.lines, *self.lines, *other.lines))
        known = {line.label for line in longer.lines}
        lines = [
            replace(theirs.minus(mine), label=name)
            for name in names
            if (mine := self._partner(name, known)) is not None and (theirs := other._partner(name, known)) is not None
        ]
        if not lines:
            self.not_comparable("the two tables have no curve in common")
        return CurvesDifference(
            self.subject, tuple(lines), logarithmic=self.logarithmic, note="other − this one", pair=(self, other)
        )

    def _partner(self, label: str, known: set[str]) -> Curve | None:
        """Return a line by name: the only one serves for all ``known``, what is absent may be 0; else None."""
        for line in self.lines:
            if line.label == label:
                return line
        if self.zero_if_absent:
            ends = tuple(dict.fromkeys(self.points()[[0, -1]].tolist()))
            return Curve(ends, (0.0,) * len(ends), self.x, self.y)
        return self.lines[0] if len(self.lines) == 1 and label in known else None


@dataclass(frozen=True, eq=False, kw_only=True)
class CurvesDifference(Curves):
    """What the second of a pair of curves has more."""

    pair: tuple[Curves, Curves]

    def figure(self) -> Figure:
        """Return both sets in one picture, and their difference below."""
        figure = framed_figure(1.3)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
        one, other = self.pair
        plot_curves(upper, one, suffix=", this one")
        plot_curves(upper, other, suffix=", other", style="--", hollow=True)
        upper.set_title(f"{self.subject.title}: two machines", fontsize=12)
        upper.set_xlabel("")
        plot_curves(lower, self)
        lower.set_title("other − this one", fontsize=11)
        lower.set_ylabel(f"difference [{one.y.unit}]", fontsize=11)
        return figure

    def against(self, other: Content) -> CurvesDifference:
        """Refuse: a difference is compared no further."""
        other.not_comparable("a difference has no difference")


def plot_curves(ax: Axes, curves: Curves, *, suffix: str = "", style: str = "-", hollow: bool = False) -> Axes:
    """Draw curves with their points into ``ax``; return it."""
    logarithmic = curves.logarithmic and _is_wide(curves.points())
    # Of two the second is thinner: where they lie upon each other both are seen.
    for index, (line, (colour, marker)) in enumerate(zip(curves.lines, line_styles(len(curves.lines)), strict=True)):
        many = len(line.x) > MARKED_MAX
        x, y = np.array(line.x), np.array(line.y)
        ax.plot(
            *(thinned(x, y) if many and not logarithmic else (x, y)),
            style,
            color=colour,
            lw=2.2 if index == 0 and len(curves.lines) == 2 else 1.4,
            marker=None if many else marker,
            ms=4.5 if len(line.x) <= MARKED_MAX // 3 else 3.0,
            markerfacecolor="white" if hollow else colour,
            label=printed(line.label + suffix),
        )
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    _widen(ax, curves.y)
    if logarithmic:
        ax.set_xscale("log")
        ax.xaxis.set_major_formatter("{x:g}")
    if len(curves.lines) > 1 or suffix:
        ax.legend(loc="best", fontsize=10, framealpha=0.9, ncols=2 if len(curves.lines) > 3 else 1)
    return labelled(ax, curves.title, str(curves.x), str(curves.y))


def plot_reversal(ax: Axes, curves: Curves) -> Axes:
    """Draw the first of two curves minus the second into ``ax``; return it."""
    first, second = curves.lines
    x = curves.points()
    difference = np.array(first.at(x)) - second.at(x)
    seen = thinned(x, difference) if len(x) > MARKED_MAX else (x, difference)
    ax.fill_between(*seen, color=COLOURS[2], alpha=0.2, lw=0)
    ax.plot(*seen, "-", color=COLOURS[2], lw=1.4)
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    _widen(ax, curves.y)
    title = f"{first.label} − {second.label}: {difference.min():.1f} … {difference.max():.1f} {curves.y.unit}"
    labelled(ax, title, str(curves.x), f"difference [{curves.y.unit}]")
    ax.title.set_fontsize(11)
    return ax


def _widen(ax: Axes, of: Quantity) -> None:
    """Let rounding look as small as it is."""
    low, high = ax.get_ylim()
    if high - low < finest(of):
        middle, half = 0.5 * (low + high), 0.5 * finest(of)
        ax.set_ylim(middle - half, middle + half)


def _is_wide(x: Array) -> bool:
    return bool(len(x) > 1 and x[0] > 0.0 and x[-1] / x[0] >= WIDE_RATIO)
