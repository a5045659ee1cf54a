"""Numbers of the lists in mm, °, mm/s, °/s or as a factor, and back: each correctly rounded."""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Context, Decimal
from fractions import Fraction

from .parameter import Quantity

EXACT = Context(prec=1000)
"""In which decimals lose nothing."""


Gear = Fraction
"""How many 0.1 µm (or 0.0001°) an encoder increment of an axis is, exactly: 1/R."""

METRIC = Gear(1)
"""Values that stand in 0.1 µm or 0.0001° already."""


def convert(value: int | Decimal, divisor: int, gear: Gear = METRIC) -> float:
    """Return value · gear / divisor, correctly rounded, so that what is written reads back to the same number."""
    if isinstance(value, int):
        return value * gear.numerator / (gear.denominator * divisor)
    if gear == METRIC:
        return float(value.scaleb(1 - len(str(divisor)), EXACT))
    return float(Fraction(value) * gear / divisor)


def equidistant(
    start: int | Decimal, interval: int | Decimal, count: int, divisor: int, gear: Gear = METRIC
) -> list[float]:
    """Return start, start + interval, … converted, each correctly rounded."""
    if isinstance(start, int) and isinstance(interval, int):
        return [convert(start + i * interval, divisor, gear) for i in range(count)]
    exact_start, exact_interval = Fraction(start), Fraction(interval)
    return [float((exact_start + i * exact_interval) * gear / divisor) for i in range(count)]


def in_list(value: float, quantity: Quantity, divisor: int = 0) -> int | Decimal:
    """Return mm, °, mm/s, °/s or a factor in the unit of the lists, so that it reads back to the same float.

    That is an integer where one does, else a decimal; ValueError if the value is not finite. ``divisor``: where it is
    not the one of the quantity, a power of ten.
    """
    divisor = divisor or quantity.divisor
    scaled = value * divisor
    if not math.isfinite(scaled):
        raise ValueError(f"{value} cannot stand in a list")
    whole = round(scaled)
    if whole / divisor == value:
        return whole
    return Decimal(repr(float(value))).scaleb(len(str(divisor)) - 1, EXACT)


def span(values: Sequence[float], unit: str = "") -> str:
    """Return the range of some values in words."""
    return f"{min(values):g} … {max(values):g}{unit}" if values else "empty"
