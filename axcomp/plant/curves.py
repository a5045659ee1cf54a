"""Smooth functions of one or two positions, from the coefficients in ``plant.json``.

Values are in thousandths of the axis' unit (µm, or 0.001°) as they stand in the file, and in mm or ° as they come out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

MILLI = 1e-3
TURN = 2.0 * math.pi


class Curve:
    """``Σ polynomial[i] · u^i + Σ amplitude · sin(2π · q / period + phase)`` with ``u = (q − origin) / scale``.

    Attributes
    ----------
    description : Mapping
        ``origin`` (0), ``scale`` (1), ``polynomial`` ([]) and ``waves`` ([]), each of these with ``amplitude``,
        ``period`` and ``phase`` (0, in °); positions in mm or °.
    """

    def __init__(self, description: Mapping[str, Any]) -> None:
        self.origin = float(description.get("origin", 0.0))
        self.scale = float(description.get("scale", 1.0))
        self.polynomial = [float(c) for c in description.get("polynomial", [])]
        self.waves = [
            (float(w["amplitude"]), TURN / float(w["period"]), math.radians(float(w.get("phase", 0.0))))
            for w in description.get("waves", [])
        ]

    def __call__(self, position: float) -> float:
        """Return the value at a position, in the unit of the coefficients."""
        u = (position - self.origin) / self.scale
        value = 0.0
        for coefficient in reversed(self.polynomial):
            value = value * u + coefficient
        for amplitude, wave_number, phase in self.waves:
            value += amplitude * math.sin(wave_number * position + phase)
        return value


class Surface:
    """``Σ first(q1) · second(q2)`` over pairs of curves."""

    def __init__(self, terms: Sequence[Mapping[str, Any]]) -> None:
        self.terms = [(Curve(term["first"]), Curve(term["second"])) for term in terms]

    def __call__(self, position1: float, position2: float) -> float:
        """Return the value at a pair of positions, in the unit of the coefficients."""
        return sum(first(position1) * second(position2) for first, second in self.terms)
