"""Pictures of judgements."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ...engine.motion import Array
from ...model.quantity import shown, symbol
from ...plot.style import DOWN, UP, labelled, new_figure
from .dynamics import DynamicsResult
from .positions import sentence
from .sign import WITHOUT, WRITTEN, SignResult

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_sign(result: SignResult, ax: Axes | None = None) -> Axes:
    """Draw the mean deviations without the compensation and with the table as it is written."""
    ax = new_figure().add_subplot() if ax is None else ax
    unit = result.evaluations[WITHOUT].unit
    for name, style in ((WITHOUT, "--"), (WRITTEN, "-")):
        evaluation = result.evaluations[name]
        for arrow, mean, colour in (("↑", evaluation.mean_up, UP), ("↓", evaluation.mean_down, DOWN)):
            known = ~np.isnan(mean)
            if known.any():
                label = f"{'without' if name == WITHOUT else 'with the table'} {arrow}"
                ax.plot(evaluation.positions[known], mean[known], style, marker="o", ms=3.5, color=colour, label=label)
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    ax.legend(ncols=2, fontsize=10)
    position = symbol(result.evaluations[WITHOUT].position_unit)
    figures = f"{result.symbol} {result.error(WITHOUT):.1f} → {result.error(WRITTEN):.1f} {unit}"
    title = f"{sentence(result.name)}: {figures}"
    return labelled(ax, title, f"target position [{position}]", f"deviation, actual − target [{unit}]")


def plot_dynamics(result: DynamicsResult, ax: Axes | None = None) -> Axes:
    """Draw the slope over the position; a second scale is the velocity it adds at the feed."""
    ax = new_figure().add_subplot() if ax is None else ax
    unit, over = symbol(result.axis.unit), symbol(result.over.unit)
    small = shown(result.axis.unit)
    if len(result.slopes):
        ax.stairs(small.factor * result.slopes, result.x, color=UP, lw=1.5, baseline=None)
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    if result.feed:
        factor = result.feed / small.factor

        def to_velocity(slope: npt.ArrayLike) -> Array:
            return np.asarray(slope, dtype=float) * factor

        def to_slope(velocity: npt.ArrayLike) -> Array:
            return np.asarray(velocity, dtype=float) / factor

        second = ax.secondary_yaxis("right", functions=(to_velocity, to_slope))
        second.set_ylabel(f"added velocity at {result.feed:g} {over}/s [{unit}/s]", fontsize=11)
    ax.set_axisbelow(True)
    label = f"slope [{small.unit}/{over}]"
    title = f"{sentence(result.name)}: slope"
    return labelled(ax, title, f"position of {result.over.name} [{over}]", label)
