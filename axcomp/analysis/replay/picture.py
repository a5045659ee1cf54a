"""A trace and the engine in one picture, and their difference."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from ...plot import COLOURS, DOWN, UP, labelled, new_figure
from .comparison import Comparison

SMALL = 1e4
"""Values up to it are drawn in the unit of differences, larger ones in thousands of it."""


def replay_figure(comparisons: Sequence[Comparison]) -> Figure:
    """Return a pair of pictures for each output: both values, and trace − engine where it is largest."""
    figure = new_figure(1.1 * len(comparisons))
    pairs = figure.subplots(
        2 * len(comparisons), 1, sharex=True, squeeze=False, height_ratios=(3, 2) * len(comparisons)
    )
    for k, one in enumerate(comparisons):
        upper, lower = pairs[2 * k, 0], pairs[2 * k + 1, 0]
        wide = one.unit in ("µm", "″") and float(np.nanmax(np.abs(one.trace))) > SMALL
        factor, unit = {"µm": (1e-3, "mm"), "″": (1.0 / 3600.0, "°")}[one.unit] if wide else (1.0, one.unit)
        upper.plot(one.time, factor * one.trace, color=UP, lw=2.4, label="trace")
        upper.plot(one.time, factor * one.engine, color=DOWN, lw=1.2, label="engine")
        upper.legend(loc="best", fontsize=10, ncols=2)
        labelled(upper, one.output, "", f"[{unit}]" if unit else "")
        lower.fill_between(one.time, -one.within, one.within, color="0.85", lw=0, label="counts as none")
        lower.plot(one.time, one.difference, color=COLOURS[2], lw=1.4)
        lower.plot(one.time[one.row], one.difference[one.row], "o", color=COLOURS[2], ms=6)
        lower.legend(loc="best", fontsize=9)
        worst = f"{one.difference[one.row]:+.4g} {one.unit}".rstrip()
        title = f"trace − engine: {worst} at {one.time[one.row]:.6g} s"
        labelled(lower, title, "time [s]" if one is comparisons[-1] else "", f"[{one.unit}]" if one.unit else "")
        lower.title.set_fontsize(11)
    return figure
