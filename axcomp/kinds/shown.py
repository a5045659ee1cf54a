"""What is shown of a compensation: tables over positions, speeds or accelerations, and where they have values."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from ..model import Axis, Curve, Grid, Quantity, Scatter, symbol

Table: TypeAlias = Curve | Grid | Scatter

POSITION, SPEED, ACCELERATION = "position", "speed", "acceleration"
"""Names of the quantities that tables are over."""
POSITIVE, NEGATIVE, BOTH = "positive motion", "negative motion", "both directions"


def position_of(axis: Axis) -> Quantity:
    """Return the position of an axis with its unit."""
    return Quantity(POSITION, symbol(axis.unit), axis.name)


def correction_of(axis: Axis, name: str = "correction") -> Quantity:
    """Return a correction of an axis with its unit."""
    return Quantity(name, symbol(axis.unit), axis.name)


class Range(NamedTuple):
    """Over what a compensation has values of its own, from where to where, and the list entry that says so."""

    over: Quantity
    low: float
    high: float
    entry: str


def ranges_of(tables: tuple[Table, ...]) -> list[Range]:
    """Return the ranges of the first of some tables; beyond them the end values are held."""
    table = tables[0]
    if isinstance(table, Curve):
        return [] if table.period is not None else [Range(table.over, table.x[0], table.x[-1], table.entry)]
    columns = (table.x, table.y) if isinstance(table, Grid) else tuple(zip(*table.places, strict=True))
    return [Range(over, min(x), max(x), table.entry) for over, x in zip(table.over, columns, strict=True)]
