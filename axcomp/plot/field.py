"""Arrow fields: where the tool really is, all over the work volume."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..model import shown
from .content import Content, Records, span
from .interactive import interactive
from .style import Array, new_figure, printed, sequential

LONGEST = 0.9
"""Length of the longest arrow, in mean distances of neighbouring positions."""
ROUNDING = 1e-6
"""µm that the arithmetic of the model may leave."""
FLATTEST = 0.35
"""Least height of the picture's box in its longest side: flat volumes are drawn higher."""


@dataclass(frozen=True, eq=False)
class Field(Content):
    """Vectors at positions in space.

    Attributes
    ----------
    positions : ndarray, shape (n, 3)
        X, Y and Z in mm.
    vectors : ndarray, shape (n, 3)
        In µm.
    """

    positions: Array
    vectors: Array

    def sizes(self) -> Array:
        """Return the lengths of the vectors, shape (n,), µm."""
        sizes: Array = np.linalg.norm(self.vectors, axis=1)
        return sizes

    def largest(self) -> float:
        """Return the length of the longest vector, µm; 0 where there is nothing but rounding."""
        largest = float(self.sizes().max())
        return largest if largest > ROUNDING else 0.0

    @property
    def enlargement(self) -> float:
        """How many mm each µm is drawn, so that the longest arrow is a little shorter than the way between places."""
        largest = self.largest()
        return float(f"{LONGEST * _distance(self.positions) / largest:.2g}") if largest else 0.0

    def interactive(self) -> str:
        """Return the volume as it should be and as it is, to be turned and travelled through."""
        return interactive(self, self.enlargement)

    def figure(self) -> Figure:
        """Return the arrows, much enlarged, coloured by their size."""
        figure = new_figure(1.3)
        ax: Any = figure.add_subplot(projection="3d")
        largest = self.largest()
        scale = self.enlargement
        mappable = ScalarMappable(Normalize(0.0, largest or 1.0), sequential())
        # The collection holds all shafts, then all left and all right strokes of the heads.
        colours = np.tile(mappable.to_rgba(self.sizes()), (3, 1))
        arrows = scale * self.vectors
        if largest:
            ax.quiver(*self.positions.T, *arrows.T, colors=colours, lw=2.4, arrow_length_ratio=0.35).set_clip_on(False)
        ax.scatter(*self.positions.T, s=7, color="0.45", depthshade=False)
        ends = np.concatenate([self.positions, self.positions + arrows])
        for limits, side in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), ends.T, strict=True):
            limits(side.min() - 1.0, side.max() + 1.0)
        sides = np.ptp(ends, axis=0)
        ax.set_box_aspect(np.maximum(sides, FLATTEST * max(float(sides.max()), 1.0)), zoom=1.1)
        for name, label in zip("XYZ", (ax.set_xlabel, ax.set_ylabel, ax.set_zlabel), strict=True):
            label(f"{name} [mm]", fontsize=11, labelpad=8)
        ax.view_init(elev=22.0, azim=-60.0)
        enlarged = scale * shown("mm").factor
        size = f"up to {largest:.1f} µm, drawn {enlarged:,.0f} times as large" if largest else "none at these places"
        ax.set_title(printed(f"{self.title}: {size}"), fontsize=12)
        figure.colorbar(mappable, ax=ax, shrink=0.75, pad=0.09).set_label("size of the error [µm]", fontsize=11)
        return figure

    def records(self) -> Records:
        """Return position, vector and its size, a row for each position."""
        columns = ("X [mm]", "Y [mm]", "Z [mm]", "eX [µm]", "eY [µm]", "eZ [µm]", "size [µm]")
        table = np.column_stack([self.positions, self.vectors, self.sizes()])
        return Records(columns, table.tolist())

    def summary(self) -> tuple[str, str, str]:
        """Return the number of positions, their ranges, and that of the sizes."""
        count = f"{len(self.positions)} place{'s'[: len(self.positions) - 1]}"
        ranges = "; ".join(span(side.tolist(), "mm") for side in self.positions.T)
        return count, ranges, span(np.round(self.sizes(), 4).tolist(), "µm")

    def against(self, other: Content) -> Field:
        """Return other − this one; both must be at the same positions."""
        if not isinstance(other, Field) or not np.array_equal(self.positions, other.positions):
            self.not_comparable("the two machines have different work volumes")
        return Field(self.subject, self.positions, other.vectors - self.vectors, note="other − this one")


def _distance(positions: Array) -> float:
    """Return the mean distance of neighbouring positions along the axes, 1 mm where there is but one."""
    gaps = [float(np.diff(np.unique(side)).mean()) for side in positions.T if np.ptp(side) > 0.0]
    return sum(gaps) / len(gaps) if gaps else 1.0
