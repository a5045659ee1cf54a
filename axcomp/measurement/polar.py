"""The polar picture of a circular test."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from ..plot import DOWN, UP

if TYPE_CHECKING:
    from matplotlib.projections.polar import PolarAxes

    from .iso230_4 import CircularResult


def draw_polar(result: CircularResult, ax: PolarAxes | None = None) -> Any:
    """Draw deviations of the paths as distances from the nominal circle; return the axes."""
    polar: Any = ax
    if ax is None:
        polar = Figure(figsize=(8.0, 8.4), dpi=120, layout="constrained").add_subplot(projection="polar")
    extent = max(float(np.max(np.abs(path.deviations))) for path in result.paths) or 1.0
    scale = 10.0 ** np.floor(np.log10(extent))
    step = next(scale * k for k in (0.5, 1.0, 2.0, 5.0, 10.0) if 3.0 * scale * k >= extent)
    base = 4.0 * step
    ring = np.linspace(0.0, 2.0 * np.pi, 361)
    polar.plot(ring, np.full_like(ring, base), color="0.35", lw=1.0)
    for path in result.paths:
        color, arrow = (UP, "↺") if path.direction > 0 else (DOWN, "↻")
        label = f"{arrow}  G = {path.G:.2f} µm"
        polar.plot(np.radians(path.angles), base + path.deviations, color=color, lw=1.3, label=label)
    polar.set_rlim(0.0, base + 3.5 * step)
    ticks = [base + k * step for k in (-3, -2, -1, 0, 1, 2, 3)]
    polar.set_rgrids(ticks, [f"{tick - base:+g}" if tick != base else "0 µm" for tick in ticks], angle=22.5, fontsize=8)
    first, second = result.test.axes
    polar.set_thetagrids([0, 90, 180, 270], [f"+{first}", f"+{second}", f"−{first}", f"−{second}"])
    both = "" if np.isnan(result.G_bidirectional) else f",  G(b) = {result.G_bidirectional:.2f} µm"
    polar.set_title(f"ISO 230-4, R = {result.test.radius:g} mm{both}")
    polar.legend(loc="upper right", fontsize=9)
    return polar
