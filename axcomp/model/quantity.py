"""What a number is of, in which unit it counts, and in which one it is shown where it is small.

Corrections are a few thousandths of what axes move by: they are shown in µm and ″ (seconds of arc), angular errors of a
volumetric model in µrad.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple


class Shown(NamedTuple):
    """The unit in which small values are shown, and how many of them make one unit of the values."""

    factor: float
    unit: str


_SHOWN = {"mm": Shown(1e3, "µm"), "°": Shown(3600.0, "″"), "deg": Shown(3600.0, "″"), "rad": Shown(1e6, "µrad")}


def shown(unit: str) -> Shown:
    """Return factor and unit in which small values are shown that count in ``mm``, ``°`` (``deg``) or ``rad``.

    Values in any other unit are shown as they are.
    """
    return _SHOWN.get(unit, Shown(1.0, unit))


def symbol(unit: str) -> str:
    """Return a unit as sentences and pictures have it: ``°`` for ``deg``."""
    return "°" if unit == "deg" else unit


@dataclass(frozen=True)
class Quantity:
    """What a number is of, and its unit.

    Attributes
    ----------
    name : str
        ``position``, ``correction``, ``acceleration`` …
    unit : str
        ``mm``, ``°``, ``rad``, ``mm/s``, ``mm/s²`` …, or one that small values are shown in.
    axis : str
        Name of the axis it is of; "" where it is of none.
    """

    name: str
    unit: str
    axis: str = ""

    def __str__(self) -> str:
        return f"{self.name} of {self.axis} [{self.unit}]" if self.axis else f"{self.name} [{self.unit}]"

    @property
    def factor(self) -> float:
        """How many units that small values are shown in make one unit."""
        return shown(self.unit).factor

    def scaled(self) -> Quantity:
        """Return the quantity in the unit that small values are shown in."""
        return replace(self, unit=shown(self.unit).unit)

    def changed(self) -> Quantity:
        """Return the difference of two such numbers."""
        return replace(self, name=f"Δ {self.name}")
