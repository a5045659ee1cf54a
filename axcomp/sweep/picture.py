"""A result over what was varied."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pandas as pd

from ..plot.style import labelled, line_styles, new_figure
from .spec import ERROR

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINES_NAMED = 12
"""Lines that a legend has room for."""


def plot_sweep(table: pd.DataFrame, varied: Sequence[str], x: str, y: str, ax: Axes | None = None) -> Axes:
    """Draw a result over a column, a line for each combination of the others that were varied.

    These need not be numbers, ``x`` has to be. ValueError if a column is not there.
    """
    for name in (x, y):
        if name not in table or not pd.api.types.is_numeric_dtype(table[name]):
            numeric = [str(n) for n in table.columns if pd.api.types.is_numeric_dtype(table[n])]
            raise ValueError(f"there is no column {name} of numbers; there are {', '.join(numeric)}")
    ax = new_figure().add_subplot() if ax is None else ax
    done = table[table[ERROR] == ""]
    others = [name for name in varied if name != x and done[name].nunique(dropna=False) > 1]
    groups = list(done.groupby(others, dropna=False, sort=False)) if others else [((), done)]
    for (values, group), (colour, marker) in zip(groups, line_styles(len(groups)), strict=True):
        ordered = group.sort_values(x)
        label = ", ".join(
            f"{n} = {v:g}" if isinstance(v, float) else f"{n} = {v}" for n, v in zip(others, values, strict=True)
        )
        ax.plot(ordered[x], ordered[y], color=colour, marker=marker, ms=4, lw=1.2, label=label or None)
    if others and len(groups) <= LINES_NAMED:
        ax.legend(fontsize=9)
    title = (
        f"{y} over {x}, {len(groups)} lines by {', '.join(others)}" if len(groups) > LINES_NAMED else f"{y} over {x}"
    )
    return labelled(ax, title, x, y)
