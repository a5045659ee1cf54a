"""What stands out from its surroundings: quadrant peaks."""

from __future__ import annotations

import numpy as np

from ..engine import Array


def peak_of(values: Array) -> float:
    """Return what stands out farthest, with its sign, from the line between the first and the last value."""
    out = values - np.linspace(values[0], values[-1], len(values))
    return float(out[np.argmax(np.abs(out))])
