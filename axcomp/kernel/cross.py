"""Cross compensation (kw.crosscomp): the slave is corrected by what stands at the master's raw setpoint. Added."""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import Curve, Lookup, curve_fits, curve_value, forget, lookup_fits, move_curve
from .motion import Argument, Motion, argument_fits, position_of
from .record import Vec


@dataclass(slots=True)
class CrossTable:
    """Correction of the slave over the position of its master."""

    master: Argument
    curve: Curve


@dataclass(slots=True)
class CrossState:
    """What the cross compensation remembers."""

    lookup: Lookup


def cross_value(pool: Vec, table: CrossTable, state: CrossState, motion: Motion) -> float:
    """Return the correction at full weight."""
    return curve_value(pool, table.curve, position_of(motion, table.master), state.lookup)


def adopt_cross(state: CrossState) -> None:
    """Go on with another table."""
    forget(state.lookup)


def move_cross(table: CrossTable, by: int) -> None:
    """Follow the numbers of the table to another place in the pool."""
    move_curve(table.curve, by)


def cross_fits(pool: Vec, table: CrossTable, axes: int, numbers: int) -> bool:
    """Tell whether the table can be used."""
    return argument_fits(table.master, axes) and curve_fits(pool, table.curve, numbers)


def cross_state_fits(table: CrossTable, state: CrossState) -> bool:
    """Tell whether the state belongs to such a table."""
    return lookup_fits(state.lookup, table.curve.points)
