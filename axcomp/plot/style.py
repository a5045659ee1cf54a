"""How all pictures look: 1200 pixels wide, colours that colour-blind readers tell apart, units on every axis."""

from __future__ import annotations

import io
import re
from base64 import b64encode
from itertools import cycle, islice
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Literal
from urllib.parse import quote

import numpy as np
import numpy.typing as npt
from matplotlib import colormaps, rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.path import Path
from PIL import Image

from ..saving import write_whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..model import Quantity

Array = npt.NDArray[np.float64]

WIDTH, HEIGHT, DPI = 10.0, 5.6, 120
"""Inches and dots per inch: 1200 by 672 pixels."""

UP, DOWN = "#0b62a4", "#c4511a"
"""Colours of motion in positive and in negative direction."""
COLOURS = (UP, DOWN, "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
"""Of the lines in one picture, in their order; blue and vermilion are positive and negative motion everywhere."""
MARKERS = ("o", "s", "^", "D", "v", "P")
DIVERGING = "PuOr_r"
"""Colour map of values with a sign; white is 0."""


COLOURS_MAX = 64
"""Of a PNG file; what lies between the colours of lines is smoothing."""
ROUNDING = 1e-6
"""Share of what is drawn that arithmetic may leave: no contour runs through it."""
POINTS_MAX = 2800
"""From about so many points on a figure is smaller as PNG than as SVG."""
AXES_POINTS = 600
"""What axes with their ticks and texts count for."""
_SAFE = " !$'*+,-./;<=>?@[]^_`{|}~"
"""Left as they are in a URI: not the colon and the bracket of addresses, of which the page has none."""
_FINEST = {"µm": 0.1, "″": 0.36, "µrad": 0.1}
"""What the last digit of a list stands for, by the unit it is shown in."""


def finest(of: Quantity) -> float:
    """Return the least range that a scale of values has: less than a list resolves is not blown up to full size."""
    return _FINEST.get(of.unit, 1e-9)


def new_figure(rows: float = 1.0, layout: Literal["constrained"] | None = "constrained") -> Figure:
    """Return an empty figure that is laid out as it is drawn; ``rows``: its height in ordinary pictures."""
    figure = Figure(figsize=(WIDTH, HEIGHT * rows), dpi=DPI, layout=layout)
    FigureCanvasAgg(figure)
    return figure


def framed_figure(rows: float = 1.0, heading: bool = False) -> Figure:
    """Return an empty figure with room for labels as numbers need it: laying it out would take as long as drawing it.

    ``heading``: a title stands above the titles of its parts.
    """
    figure = new_figure(rows, layout=None)
    row = 1.0 / (HEIGHT * rows)  # an inch
    figure.subplots_adjust(0.082, 0.6 * row, 0.985, 1.0 - (0.65 if heading else 0.35) * row, 0.08, 0.17)
    return figure


def thinned(x: Array, y: Array) -> tuple[Array, Array]:
    """Return what can be seen of a line in a picture: no point that is closer than half a pixel to its neighbours'."""
    size = np.array([DPI * WIDTH / (np.ptp(x) or 1.0), DPI * HEIGHT / (np.ptp(y) or 1.0)])
    path = Path(np.column_stack([x, y]) * size)
    path.should_simplify = True
    path.simplify_threshold = 0.5
    kept = path.cleaned(simplify=True)
    seen_x, seen_y = (np.asarray(kept.vertices, float)[kept.codes != Path.STOP] / size).T
    return seen_x, seen_y


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
    """Return a figure as a PNG file of few colours; the same figure gives the same bytes."""
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    shown = Image.fromarray(np.asarray(canvas.buffer_rgba()), "RGBA").convert("RGB")
    few = shown.quantize(COLOURS_MAX, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    # Paper stays white.
    palette, paper = few.getpalette() or [], np.asarray(few)[0, 0]
    palette[3 * paper : 3 * paper + 3] = [255, 255, 255]
    few.putpalette(palette)
    stream = io.BytesIO()
    few.save(stream, "PNG", compress_level=6)
    return stream.getvalue()


def svg(figure: Figure) -> str:
    """Return a figure as SVG with its texts as texts; the same figure gives the same text."""
    stream = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "axcomp", "path.simplify_threshold": 0.3}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    drawn = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", stream.getvalue(), flags=re.S)
    # What the groups are called nobody asks, and a tenth of a point is finer than any screen.
    drawn = re.sub(r' id="[a-zA-Z0-9.]+_\d+"', "", drawn)
    drawn = re.sub(r"font-family: [^;\"]*", "font-family: DejaVu Sans, sans-serif", drawn)
    drawn = re.sub(r"(\.\d)\d+", r"\1", drawn)
    # A URI has no line ends.
    return " ".join(drawn[drawn.index("<svg") :].split())


def embedded(figure: Figure) -> str:
    """Return a figure as a data URI: as SVG where it has so few points that this is the smaller file, else as PNG."""
    flat = not any(ax.name == "3d" for ax in figure.axes)
    drawn = [artist for ax in figure.axes for artist in (*ax.lines, *ax.patches, *ax.collections)]
    points = sum(np.shape(path.vertices)[0] for artist in drawn for path in _paths(artist))
    if flat and points + AXES_POINTS * len(figure.axes) < POINTS_MAX:
        return "data:image/svg+xml," + quote(svg(figure).replace('"', "'"), safe=_SAFE)
    return f"data:image/png;base64,{b64encode(png(figure)).decode()}"


def _paths(artist: Any) -> list[Path]:
    if hasattr(artist, "get_paths"):
        return list(artist.get_paths())
    return [artist.get_path()]


def save(figure: Figure, path: FilePath) -> None:
    """Write a figure as what the suffix says, PNG where there is none; ValueError if that cannot be drawn."""
    form = path.suffix[1:].lower() or "png"
    stream = io.BytesIO()
    if form != "png":
        figure.savefig(stream, format=form)
    write_whole(path, stream.getvalue() or png(figure))
