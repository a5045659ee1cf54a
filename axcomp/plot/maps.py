"""Maps: values over two quantities, as a plane compensation and crosstalk over two adaptation axes have them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from contourpy import contour_generator
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..model import Grid, Quantity, Scatter
from .content import Content, Records, picked, span, spread
from .style import DIVERGING, ROUNDING, Array, finest, framed_figure, labelled, printed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import ContourSet

COLUMNS_SHOWN = 9
"""Columns of a map in the terminal."""
CONTOURS = 9
LABELS_MAX = 40
"""Pieces of contours that are drawn at most: more of them would be a tangle, and the bands of colour tell as much."""
BANDS = 25
"""Colours from the least to the greatest value, one of them white around 0."""
CELLS = 150
"""Points along each side that a picture can show."""
FLAT, FLAT_SHARE = 0.02, 0.1
"""Values below this share of the largest are 0; where so many of them are, a contour along 0 would be noise."""


@dataclass(frozen=True, eq=False)
class Layer:
    """One map: whatever has a value ``at`` every point, such as a ``Grid`` or a ``Scatter``.

    ``label`` tells several in one picture apart; ``over`` are the quantities across and upwards, ``of`` that of the
    values.
    """

    label: str
    over: tuple[Quantity, Quantity]
    of: Quantity
    at: Callable[[float, float], float]

    @classmethod
    def shown(cls, table: Grid | Scatter) -> Layer:
        """Return a table in the unit that it is shown in."""
        return cls(table.label, table.over, table.of.scaled(), lambda x, y: table.of.factor * table.at(x, y))

    def minus(self, other: Layer) -> Layer:
        """Return the difference."""
        difference = replace(self, of=self.of.changed(), at=lambda x, y: self.at(x, y) - other.at(x, y))
        return replace(difference, label=self.label or other.label)


@dataclass(frozen=True, eq=False)
class Map(Content):
    """One or several maps over the same two quantities.

    Attributes
    ----------
    layers : tuple of Layer
        At least one, all over and of the same quantities, in the unit they are shown in.
    across, up : ndarray, shape (nx,) and (ny,)
        The grid that is drawn and listed, ascending.
    points : ndarray, shape (n, 2)
        Where the values are given if not on the grid: marked.
    """

    layers: tuple[Layer, ...]
    across: Array
    up: Array
    points: Array

    @property
    def x(self) -> Quantity:
        """Across."""
        return self.layers[0].over[0]

    @property
    def y(self) -> Quantity:
        """Upwards."""
        return self.layers[0].over[1]

    @property
    def z(self) -> Quantity:
        """Of the values."""
        return self.layers[0].of

    def at(self, across: Array, up: Array) -> Array:
        """Return the values on any grid, shape (layers, ny, nx)."""
        return np.array([[[layer.at(x, y) for x in across.tolist()] for y in up.tolist()] for layer in self.layers])

    def values(self) -> Array:
        """Return the values on the grid, shape (layers, ny, nx)."""
        return self._values

    @cached_property
    def _values(self) -> Array:
        return self.at(self.across, self.up)

    def figure(self) -> Figure:
        """Return the maps side by side with one scale of colours."""
        columns = min(len(self.layers), 2)
        rows = -(-len(self.layers) // columns)
        figure = framed_figure(1.25 if rows == 1 else 0.85 * rows, heading=len(self.layers) > 1)
        figure.subplots_adjust(right=0.94)
        values = self.values()
        limit = max(float(np.abs(values).max()), finest(self.z))
        axes = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True)
        for layer, shown, ax in zip(self.layers, values, axes.flat, strict=True):
            filled = plot_map(ax, self, shown, limit)
            ax.label_outer()
            ax.set_title(printed(layer.label or self.title), fontsize=12)
        bar = figure.colorbar(filled, ax=axes, fraction=0.03, pad=0.02, aspect=30, ticks=MaxNLocator(CONTOURS))
        bar.set_label(str(self.z), fontsize=11)
        if len(self.layers) > 1:
            figure.suptitle(printed(self.title), fontsize=13)
        return figure

    def records(self) -> Records:
        """Return a row for each marked point, else for each point of the grid: point and value of each layer."""
        names = [f"{layer.label or self.z.name} [{self.z.unit}]" for layer in self.layers]
        if len(self.points):
            points = self.points
            values = np.array([[layer.at(x, y) for layer in self.layers] for x, y in points.tolist()])
        else:
            points = np.stack(np.meshgrid(self.across, self.up), axis=-1).reshape(-1, 2)
            values = self.values().reshape(len(self.layers), -1).T
        return Records((str(self.x), str(self.y), *names), np.column_stack([points, values]).tolist())

    def extract(self, rows: int) -> Records:
        """Return the marked points; else the map as a sheet, rows for one quantity and columns for the other."""
        if len(self.points):
            return super().extract(rows)
        columns = spread(len(self.across), COLUMNS_SHOWN)
        sheet = np.column_stack([self.up, self.values()[0][:, columns]]).tolist()
        head = (f"{self.y} \\ {self.x}", *(printed(f"{self.across[i]:.5g}") for i in columns))
        return Records(head, picked(sheet, rows)[::-1])

    def summary(self) -> tuple[str, str, str]:
        """Return the size of the grid, the ranges of both quantities and of the values."""
        ranges = f"{span(self.across.tolist(), self.x.unit)}; {span(self.up.tolist(), self.y.unit)}"
        size = f"{len(self.points)} tests" if len(self.points) else f"{len(self.across)} × {len(self.up)}"
        return size, ranges, span(np.round(self.values(), 4).ravel().tolist(), self.z.unit)

    def against(self, other: Content) -> Map:
        """Return other − this one, on the grid of both."""
        if not isinstance(other, Map) or (self.x, self.y, self.z) != (other.x, other.y, other.z):
            self.not_comparable("the two tables are over different quantities")
        if len({len(self.layers), len(other.layers)} - {1}) > 1:
            self.not_comparable(f"{len(self.layers)} maps against {len(other.layers)}")
        mine, theirs = (
            content.layers * (max(len(self.layers), len(other.layers)) // len(content.layers))
            for content in (self, other)
        )
        return replace(
            self,
            layers=tuple(b.minus(a) for a, b in zip(mine, theirs, strict=True)),
            across=np.union1d(self.across, other.across),
            up=np.union1d(self.up, other.up),
            points=np.empty((0, 2)),
            note="other − this one",
        )


def plot_map(ax: Axes, content: Map, values: Array, limit: float) -> ContourSet:
    """Draw one map into ``ax``, its colours from −limit to limit (> 0), with contours; return it for their scale.

    ``values``, shape (ny, nx), are those of one layer. ``ax`` gets labels, but no title.
    """
    across, up = (_widened(side) for side in (content.across, content.up))
    wide = np.pad(values, ((0, len(up) - len(content.up)), (0, len(across) - len(content.across))), mode="edge")
    chosen = np.ix_(spread(len(up), CELLS), spread(len(across), CELLS))
    across, up, wide = across[chosen[1].ravel()], up[chosen[0].ravel()], wide[chosen]
    bands = np.linspace(-limit, limit, BANDS + 1)
    filled = ax.contourf(across, up, np.clip(wide, -limit, limit), levels=bands, cmap=DIVERGING, antialiased=False)
    if np.ptp(values) > 2.0 * limit * ROUNDING and min(values.shape) > 1:
        levels = _levels(values)
        drawn = contour_generator(across, up, wide)
        if sum(len(drawn.lines(level)) for level in levels) <= LABELS_MAX:
            lines = ax.contour(across, up, wide, levels=levels, colors="0.15", linewidths=0.6)
            for label in ax.clabel(lines, fontsize=9, fmt=lambda level: printed(f"{level:.3g}")):
                label.set_bbox({"facecolor": "white", "alpha": 0.7, "pad": 0.6, "lw": 0})
    if len(content.points):
        ax.plot(*content.points.T, "o", ms=5, color="black", markeredgecolor="white", clip_on=False, zorder=5)
    labelled(ax, "", str(content.x), str(content.y)).grid(visible=False)
    ax.locator_params(nbins=6)
    return filled


def _levels(values: Array) -> list[float]:
    """Return where contours run; along 0 only where 0 is a line and not an area."""
    levels = MaxNLocator(CONTOURS).tick_values(float(values.min()), float(values.max()))
    flat = np.mean(np.abs(values) < FLAT * np.abs(values).max()) > FLAT_SHARE
    return [float(level) for level in levels if not (flat and level == 0.0)]


def _widened(side: Array) -> Array:
    """Return a side with a second point if it has but one: an area needs two."""
    return side if len(side) > 1 else np.array([side[0], side[0] + 1.0])
