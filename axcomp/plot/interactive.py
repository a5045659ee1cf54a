"""Arrow fields to be turned with the mouse, by Plotly: the nominal volume, the deformed one, and the way through it."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

import numpy as np

from .style import Array

if TYPE_CHECKING:
    from .field import Field

HEIGHT = 640
"""Pixels."""
FRAME_TIME = 120
"""ms that the animation stays at a place."""


class NoPlotlyError(RuntimeError):
    """Plotly is not installed; the message says how to get it."""


def _plotly() -> Any:
    try:
        import plotly.graph_objects
        import plotly.offline
        import plotly.subplots
    except ImportError:
        raise NoPlotlyError("interactive pictures need Plotly: pip install 'axcomp[interactive]'") from None
    return plotly


def script() -> str:
    """Return what the pictures of a page need, once, so that it needs nothing beside it; NoPlotlyError without it."""
    return f"<script>{_plotly().offline.get_plotlyjs()}</script>"


def interactive(field: Field, scale: float) -> str:
    """Return a field as HTML: what is nominal on the left, what is real on the right, with one scale of colours.

    Errors are drawn ``scale`` mm for each µm. A button lets a tool travel through both, from node to node.
    """
    go = _plotly().graph_objects
    titles = ("nominal, coloured by the error", f"as it is, errors {1e3 * scale:,.0f} times as large")
    scenes = [[{"type": "scene"}, {"type": "scene"}]]
    figure = _plotly().subplots.make_subplots(1, 2, specs=scenes, subplot_titles=titles, horizontal_spacing=0.02)
    sizes, real = field.sizes(), field.positions + scale * field.vectors
    limit = field.largest() or 1.0
    hover = [
        f"X {x:g} Y {y:g} Z {z:g} mm<br>error {a:.2f}, {b:.2f}, {c:.2f} µm<br>size {size:.2f} µm"
        for (x, y, z), (a, b, c), size in zip(field.positions, field.vectors, sizes, strict=True)
    ]
    for column, places in enumerate((field.positions, real), 1):
        lines = _lattice(field.positions, places)
        grid = dict(zip("xyz", lines.T, strict=True))
        figure.add_trace(
            go.Scatter3d(**grid, mode="lines", line={"color": "#9aa3aa", "width": 2}, hoverinfo="skip"), 1, column
        )
        bar = {"title": "error [µm]", "thickness": 14} if column == 2 else None
        marker = {"size": 4, "color": sizes, "colorscale": "Viridis", "cmin": 0.0, "cmax": limit, "colorbar": bar}
        nodes = dict(zip("xyz", places.T, strict=True))
        figure.add_trace(go.Scatter3d(**nodes, mode="markers", marker=marker, text=hover, hoverinfo="text"), 1, column)
    _add_tool(figure, field, real)
    axes: dict[str, Any] = {f"{axis}axis": {"title": f"{axis.upper()} [mm]"} for axis in "xyz"}
    axes["camera"] = {"eye": {"x": -1.3, "y": -1.9, "z": 0.9}}
    figure.update_layout(
        title={"text": field.title, "x": 0.5},
        height=HEIGHT,
        showlegend=False,
        scene=axes,
        scene2=axes,
        margin={"l": 0, "r": 0, "b": 0},
    )
    html: str = figure.to_html(
        full_html=False, include_plotlyjs=False, auto_play=False, div_id=f"{field.subject.name}-3d"
    )
    return html


def _add_tool(figure: Any, field: Field, real: Array) -> None:
    """Let a marker travel through both volumes, along X and to and fro, as a measurement does."""
    go = _plotly().graph_objects
    order = _tour(field.positions)
    first = len(figure.data)

    def at(place: Array) -> Any:
        x, y, z = ([coordinate] for coordinate in place.tolist())
        return go.Scatter3d(x=x, y=y, z=z, mode="markers", marker={"size": 9, "color": "#c4511a"}, hoverinfo="skip")

    for column, places in enumerate((field.positions, real), 1):
        figure.add_trace(at(places[order[0]]), 1, column)
    figure.frames = [
        go.Frame(
            data=[at(field.positions[i]), at(real[i])],
            traces=[first, first + 1],
            layout={"title": {"text": f"{field.title}: {field.sizes()[i]:.1f} µm"}},
        )
        for i in order
    ]
    timing = {"frame": {"duration": FRAME_TIME}, "transition": {"duration": 0}, "fromcurrent": True}
    stop = {"frame": {"duration": 0}, "mode": "immediate"}
    buttons = [
        {"label": "travel", "method": "animate", "args": [None, timing]},
        {"label": "stop", "method": "animate", "args": [[None], stop]},
    ]
    figure.update_layout(updatemenus=[{"type": "buttons", "buttons": buttons, "direction": "right", "x": 0, "y": 1.1}])


def _lattice(positions: Array, places: Array) -> Array:
    """Return the lines between neighbouring nodes, shape (n, 3), a nan between two lines."""
    sides = [np.unique(side).tolist() for side in positions.T]
    index = {tuple(position): i for i, position in enumerate(positions.tolist())}
    gap = [np.nan] * 3
    lines: list[list[float]] = []
    for d, side in enumerate(sides):
        for others in product(*(sides[e] for e in range(3) if e != d)):
            row = [index[(*others[:d], x, *others[d:])] for x in side]
            for a, b in pairwise(row):
                lines += [places[a].tolist(), places[b].tolist(), gap]
    return np.array(lines or [gap])


def _tour(positions: Array) -> list[int]:
    """Return the nodes so that each is beside the one before it."""
    x, y, z = (np.unique(side).tolist() for side in positions.T)
    index = {tuple(position): i for i, position in enumerate(positions.tolist())}
    order = []
    for k, height in enumerate(z):
        for j, depth in enumerate(y if k % 2 == 0 else y[::-1]):
            along = x if (k * len(y) + j) % 2 == 0 else x[::-1]
            order += [index[place, depth, height] for place in along]
    return order
