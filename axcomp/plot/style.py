"""How all pictures look: 1200 pixels wide, colours that colour-blind readers tell apart, units on every axis."""

from __future__ import annotations

import io
import re
from itertools import cycle, islice
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from ..saving import write_whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, HEIGHT, DPI = 10.0, 5.6, 120
"""Inches and dots per inch: 1200 by 672 pixels."""

UP, DOWN = "#0b62a4", "#c4511a"
"""Colours of motion in positive and in negative direction."""
COLOURS = (UP, DOWN, "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
"""Of the lines in one picture, in their order; blue and vermilion are positive and negative motion everywhere."""
MARKERS = ("o", "s", "^", "D", "v", "P")
DIVERGING = "PuOr_r"
"""Colour map of values with a sign; white is 0."""


def new_figure(rows: float = 1.0) -> Figure:
    """Return an empty figure; ``rows``: its height in ordinary pictures."""
    figure = Figure(figsize=(WIDTH, HEIGHT * rows), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def line_styles(count: int) -> list[tuple[str, str]]:
    """Return colour and marker for each of several lines."""
    return list(islice(cycle(zip(COLOURS, MARKERS, strict=True)), count))


def labelled(ax: Axes, title: str, x: str, y: str) -> Axes:
    """Put title, labels and a grid into a picture."""
    ax.set_title(printed(title), fontsize=12)
    ax.set_xlabel(x, fontsize=11)
    ax.set_ylabel(y, fontsize=11)
    ax.grid(visible=True, color="0.9", lw=0.7)
    return ax


def sequential() -> ListedColormap:
    """Return the colour map of sizes: viridis without its palest end, which white paper would swallow."""
    return ListedColormap(colormaps["viridis"](np.linspace(0.0, 0.88, 256)))


def printed(text: str) -> str:
    """Return a text with true minus signs in front of its numbers."""
    return re.sub(r"(?<![\w-])-(?=[\d.])", "−", text)


def png(figure: Figure) -> bytes:
    """Return a figure as a PNG file; the same figure gives the same bytes."""
    return _drawn(figure, "png")


def _drawn(figure: Figure, form: str) -> bytes:
    stream = io.BytesIO()
    figure.savefig(stream, format=form, metadata={"Software": None} if form == "png" else None)
    return stream.getvalue()


def save(figure: Figure, path: Path) -> None:
    """Write a figure as what the suffix says, PNG where there is none; ValueError if that cannot be drawn."""
    write_whole(path, _drawn(figure, path.suffix[1:].lower() or "png"))
