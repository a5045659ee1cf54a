"""Measurement uncertainty of a positioning test, expanded with k = 2.

The contributions are those of ISO 230-2:2014, Annex A. Where only bounds of an influence are known it is uniformly
distributed between them: a range R contributes ``U = 2 · R / √12 = R/√3`` (JCGM 100:2008, 4.3.7). With the travel L::

    U_DEVICE       = device · L                           calibration of the instrument, stated with k = 2
    U_MISALIGNMENT = misalignment² / (2 √3 L)             the cosine error is between 0 and misalignment² / 2L
    U_M            = α · L · temperature_range / √3       how warm the machine is, is known within this range
    U_E            = α_range · L · |ΔT| / √3              α is known within this range, ΔT from 20 °C
    U_EVE          = drift / √3                           range of the readings of an axis at rest during the test

The first four, ``U_L`` together, act on every length alike; drift acts on every reading by itself. Propagated by JCGM
100:2008, 5.1, with n runs in each direction (a mean has U_EVE/√n, a difference of two such means √2 as much)::

    U(B) = U(B̄) = √(2/n) U_EVE                            U(M)² = U_L² + 1/n U_EVE²
    U(E)² = U(E↑)² = U_L² + 2/n U_EVE²                    U(R↑) = 2 U_EVE: what drift alone would show as 4 s
    U(R)² = U(R↑)² + U(B)²                                U(A)² = U(A↑)² = U(E)² + U(R↑)²
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import Any

from ..model import shown

UNIFORM = 1.0 / math.sqrt(3.0)
"""Expanded uncertainty (k = 2) of an influence known within a range of 1."""

MICRO = shown("mm").factor
"""mm to µm."""


def _condition(unit: str, meaning: str, default: float = 0.0) -> Any:
    return field(default=default, metadata={"unit": unit, "meaning": meaning})


@dataclass(frozen=True)
class Conditions:
    """Of a test on a linear axis; what is left at 0 does not contribute.

    Attributes
    ----------
    device : float
        Expanded uncertainty (k = 2) of the instrument, µm/m.
    misalignment : float
        How far instrument and axis may be out of line over the travel, mm.
    temperature_range, temperature_offset : float
        Range within which it is known how warm the machine is, and how much warmer than 20 °C it is, K.
    expansion, expansion_range : float
        Expansion coefficient of the machine's scale, and the range within which it is known, 1e-6/K.
    drift : float
        Range of readings at rest (E_VE), µm.

    Examples
    --------
    >>> from axcomp import Conditions
    >>> round(Conditions(device=0.5, drift=0.8).of_parameters(travel=1000.0, runs=5)["B"], 3)
    0.292

    Raises
    ------
    ValueError
        One is negative (other than ``temperature_offset``) or not finite.
    """

    device: float = _condition("µm/m", "expanded uncertainty (k = 2) of the instrument")
    misalignment: float = _condition("mm", "how far instrument and axis may be out of line over the travel")
    temperature_range: float = _condition("K", "range within which it is known how warm the machine is")
    temperature_offset: float = _condition("K", "how much warmer than 20 °C the machine is")
    expansion: float = _condition("1e-6/K", "expansion coefficient of the machine's scale", 11.7)
    expansion_range: float = _condition("1e-6/K", "range within which that is known", 2.0)
    drift: float = _condition("µm", "environmental variation error E_VE: range of readings at rest")

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            if not math.isfinite(value) or (value < 0.0 and item.name != "temperature_offset"):
                raise ValueError(f"{item.name.replace('_', ' ')} cannot be {value:g}")

    def contributions(self, travel: float) -> dict[str, float]:
        """Return U_DEVICE, U_MISALIGNMENT, U_M, U_E and U_EVE in µm for a ``travel`` in mm."""
        length = travel / MICRO
        return {
            "U_DEVICE": self.device * length,
            "U_MISALIGNMENT": 0.5 * UNIFORM * self.misalignment**2 / travel * MICRO if travel > 0.0 else 0.0,
            "U_M": UNIFORM * self.expansion * length * self.temperature_range,
            "U_E": UNIFORM * self.expansion_range * length * abs(self.temperature_offset),
            "U_EVE": UNIFORM * self.drift,
        }

    def of_parameters(self, travel: float, runs: int) -> dict[str, float]:
        """Return the expanded uncertainty of each figure of ISO 230-2 in µm, for a ``travel`` in mm and ``runs``."""
        *lengths, drift = self.contributions(travel).values()
        common = math.hypot(*lengths)
        reversal = math.sqrt(2.0 / runs) * drift
        systematic = math.hypot(common, reversal)
        repeatability = 2.0 * drift
        accuracy = math.hypot(systematic, repeatability)
        return {
            **dict.fromkeys(("A", "A_up", "A_down"), accuracy),
            "R": math.hypot(repeatability, reversal),
            **dict.fromkeys(("R_up", "R_down"), repeatability),
            **dict.fromkeys(("E", "E_up", "E_down"), systematic),
            "M": math.hypot(common, drift / math.sqrt(runs)),
            **dict.fromkeys(("B", "B_mean"), reversal),
        }
