"""The picture of a positioning test as ISO 230-2 draws it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..engine.motion import Array
from ..model.quantity import symbol
from ..plot.style import DOWN, UP, labelled, new_figure
from .iso230 import SYMBOLS, Iso230Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot(result: Iso230Result, ax: Axes | None = None) -> Axes:
    """Draw a result into ``ax``, or into a new figure; return the axes."""
    ax = new_figure().add_subplot() if ax is None else ax
    readings = result.readings
    sides = ((UP, 1, "↑", result.mean_up, result.s_up), (DOWN, -1, "↓", result.mean_down, result.s_down))
    for colour, direction, arrow, mean, s in sides:
        there = ~np.isnan(mean)
        if not there.any():
            continue
        chosen = readings.directions == direction
        ax.plot(readings.targets[chosen], readings.deviations[chosen], ".", color=colour, ms=3.5, alpha=0.35)
        known = there & ~np.isnan(s)
        if known.any():
            _band(ax, result.positions[known], mean[known], s[known], colour, f"x̄{arrow} ± 2s{arrow}")
        ax.plot(result.positions[there], mean[there], "o-", color=colour, ms=4, lw=1.4, label=f"x̄{arrow}")
    if np.any(~np.isnan(result.mean)):
        ax.plot(result.positions, result.mean, "--", color="0.25", lw=1.1, label="x̄")
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    figures = [
        f"{SYMBOLS[name]} = {value:.1f}"
        for name, value in result.parameters().items()
        if name in ("A", "E", "R", "M", "B") and not math.isnan(value)
    ]
    title = f"Positioning of axis {result.axis}" if result.axis else "Positioning"
    title += f":  {',  '.join(figures)} {result.unit}" if figures else ""
    labelled(
        ax, title, f"target position [{symbol(result.position_unit)}]", f"deviation, actual − target [{result.unit}]"
    )
    ax.legend(loc="best", ncols=3, fontsize=10, framealpha=0.9)
    return ax


def _band(ax: Axes, positions: Array, mean: Array, s: Array, colour: str, label: str) -> None:
    ax.fill_between(positions, mean - 2.0 * s, mean + 2.0 * s, color=colour, alpha=0.13, lw=0, label=label)
    for side in (-2.0, 2.0):
        ax.plot(positions, mean + side * s, color=colour, lw=0.7, alpha=0.7)
