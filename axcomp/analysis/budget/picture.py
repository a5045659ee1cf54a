"""The budget as waterfalls, and the uncertainty of the tool tip along the path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ...plot import DOWN, UP, labelled, line_styles, new_figure, printed
from .contributions import VOLUMETRIC, Budget
from .propagation import COVERAGE, TcpUncertainty

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHOWN = 10
"""Contributions with a bar of their own; the others share one."""
TOTAL = "0.35"
"""Colour of the sum."""


def budget_figure(budget: Budget, uncertainty: TcpUncertainty | None = None) -> Figure:
    """Return a waterfall for each axis that is corrected, and the uncertainty where there is one."""
    axes = [axis for axis in budget.totals if budget.of_axis(axis)]
    rows = len(axes) + (uncertainty is not None)
    figure = new_figure(max(1.0, 0.62 * rows))
    for row, axis in enumerate(axes, 1):
        plot_waterfall(budget, axis, figure.add_subplot(max(rows, 1), 1, row))
    if uncertainty is not None:
        plot_uncertainty(uncertainty, figure.add_subplot(rows, 1, rows))
    return figure


def plot_waterfall(budget: Budget, axis: str, ax: Axes | None = None) -> Axes:
    """Draw how the contributions to one axis add up where its correction is largest."""
    ax = new_figure().add_subplot() if ax is None else ax
    cycle = budget.worst(axis)
    values = [(c.source, c.at(cycle)) for c in budget.of_axis(axis)]
    values.sort(key=lambda pair: -abs(pair[1]))
    if len(values) > SHOWN + 1:
        rest = values[SHOWN:]
        values = [*values[:SHOWN], (f"{len(rest)} others", sum(value for _, value in rest))]
    names = [name for name, _ in values]
    heights = np.array([value for _, value in values])
    starts = np.concatenate([[0.0], np.cumsum(heights)])
    colours = [UP if height >= 0.0 else DOWN for height in heights]
    at = np.arange(len(values) + 1)
    ax.bar(at[:-1], heights, bottom=starts[:-1], color=colours, width=0.62)
    ax.bar(at[-1:], starts[-1:], color=TOTAL, width=0.62)
    for k in range(len(values)):
        ax.plot([k - 0.31, k + 1.31], [starts[k + 1]] * 2, color="0.4", lw=0.8)
    tops = np.concatenate([np.maximum(starts[:-1], starts[1:]), [max(starts[-1], 0.0)]])
    for k, value in enumerate([*heights, starts[-1]]):
        ax.annotate(
            printed(f"{value:.3g}"), (k, tops[k]), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=9
        )
    ax.axhline(0.0, color="0.3", lw=0.8)
    ax.set_xticks(at, [_short(name) for name in (*names, "sum")], fontsize=9)
    # Room for the figures: bars keep the limits where they end otherwise.
    low, high = float(starts.min()), float(starts.max())
    room = 0.12 * max(high - low, 1e-9)
    ax.set_ylim(low - (room if low < 0.0 else 0.0), high + room)
    title = f"Axis {axis}: contributions where its correction is largest, {budget.time[cycle]:.3f} s"
    labelled(ax, title, "", f"correction [{budget.units[axis]}]")
    ax.set_axisbelow(True)
    ax.grid(visible=False, axis="x")
    return ax


def _short(source: str) -> str:
    """Return a source on two lines that a bar has room for."""
    first, _, rest = source.partition(" ")
    return (
        f"{rest}\n{first.replace(VOLUMETRIC, 'vol. ')}" if first.startswith(VOLUMETRIC) else source.replace(" ", "\n")
    )


def plot_uncertainty(uncertainty: TcpUncertainty, ax: Axes | None = None) -> Axes:
    """Draw the uncertainty of the tool tip along the path."""
    ax = new_figure().add_subplot() if ax is None else ax
    styles = line_styles(len(uncertainty.axes))
    for d, (name, (colour, marker)) in enumerate(zip(uncertainty.axes, styles, strict=True)):
        label = f"standard uncertainty along {name}"
        ax.plot(uncertainty.time, uncertainty.standard[:, d], color=colour, marker=marker, ms=3, lw=1.2, label=label)
        ax.plot(uncertainty.time, uncertainty.linear[:, d], color=colour, ls=":", lw=1.2)
    ax.plot(uncertainty.time, uncertainty.radius, color="0.2", lw=1.8, label=f"{COVERAGE:.0%} of all trials are within")
    ax.plot([], [], color="0.4", ls=":", lw=1.2, label="by linear propagation")
    ax.set_ylim(0.0, 1.35 * max(float(uncertainty.radius.max()), float(uncertainty.linear.max()), 1e-6))
    ax.legend(fontsize=9, loc="upper center", ncols=3)
    return labelled(ax, f"Tool tip, {uncertainty.trials} trials", "time [s]", "uncertainty [µm]")
