"""Leadscrew error compensation (kw.ssfk): out = in − Δ(in), Δ = actual − programmed position.

Bilateral tables have a Δ for either direction of motion. At a reversal their difference is spread by sin² over the
cycles of lr_param.n_backlash_cyc; turning again midway turns round where it is.
"""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import Curve, Lookup, curve_fits, curve_value, forget, lookup_fits, move_curve, nearest, period_fits
from .motion import Argument, AxisMotion, argument_fits, folded, is_motion
from .record import Vec
from .switching import CYCLES_MAX, mapped_step, ramp


@dataclass(slots=True)
class LeadscrewTable:
    """Errors of an axis over its position; both directions share the interpolation points."""

    argument: Argument  # the axis itself
    positive: Curve
    negative: Curve
    bilateral: bool
    without_other: bool  # the position does not contain the other corrections (P-COMP-00057)
    modulo_range: float  # of the axis; 0: it does not count modulo
    reversal_cycles: int  # of the change-over between the directions, at least 1 (1: at once)


@dataclass(slots=True)
class LeadscrewState:
    """What the leadscrew compensation remembers."""

    lookup: Lookup
    started: bool
    counted: float  # input when it last moved
    backward: bool  # its last motion was negative
    reversal_step: int  # reversal_cycles: positive values, 0: negative values


def leadscrew_input(table: LeadscrewTable, setpoint: float, added: float) -> float:
    """Return the input of the compensation; ``added``: what stands before it besides the setpoint."""
    return setpoint if table.without_other else setpoint + added


def leadscrew_value(pool: Vec, table: LeadscrewTable, state: LeadscrewState, position: float) -> float:
    """Return −Δ at full weight; ``position``: the input of the compensation, whose changes give the direction."""
    if not state.started:
        begin_leadscrew(table, state, position)
    change = nearest(position - state.counted, table.modulo_range)
    if is_motion(change):
        state.counted = position
        state.backward = change < 0.0
    if state.backward:
        if state.reversal_step > 0:
            state.reversal_step -= 1
    elif state.reversal_step < table.reversal_cycles:
        state.reversal_step += 1

    return leadscrew_at(pool, table, state, position)


def leadscrew_at(pool: Vec, table: LeadscrewTable, state: LeadscrewState, position: float) -> float:
    """Return −Δ at a position where a reversal stands."""
    x = folded(table.argument, position)
    if not table.bilateral or state.reversal_step == table.reversal_cycles:
        return -curve_value(pool, table.positive, x, state.lookup)
    if state.reversal_step == 0:
        return -curve_value(pool, table.negative, x, state.lookup)
    positive = curve_value(pool, table.positive, x, state.lookup)
    negative = curve_value(pool, table.negative, x, state.lookup)
    return -(negative + ramp(state.reversal_step, table.reversal_cycles) * (positive - negative))


def begin_leadscrew(table: LeadscrewTable, state: LeadscrewState, position: float) -> None:
    """Set the state before the first cycle with a table: no reversal is under way."""
    state.started = True
    state.counted = position
    state.reversal_step = 0 if state.backward else table.reversal_cycles


def adopt_leadscrew(
    before: LeadscrewTable, after: LeadscrewTable, state: LeadscrewState, motion: AxisMotion, added: float
) -> None:
    """Go on with another table; a reversal that is under way stays as far as it is, another input is no motion.

    Where there was no table the direction of the axis' last motion counts, positive before any.
    """
    forget(state.lookup)
    if before.reversal_cycles == 0:
        state.started = False
        state.backward = motion.direction < 0
    elif before.without_other != after.without_other:
        state.counted = leadscrew_input(after, motion.setpoint, added)
    state.reversal_step = mapped_step(state.reversal_step, before.reversal_cycles, after.reversal_cycles)


def move_leadscrew(table: LeadscrewTable, by: int) -> None:
    """Follow the numbers of the table to another place in the pool."""
    move_curve(table.positive, by)
    move_curve(table.negative, by)


def leadscrew_fits(pool: Vec, table: LeadscrewTable, axes: int, numbers: int) -> bool:
    """Tell whether the table can be used."""
    if not (1 <= table.reversal_cycles <= CYCLES_MAX and period_fits(table.modulo_range)):
        return False
    if not (argument_fits(table.argument, axes) and curve_fits(pool, table.positive, numbers)):
        return False
    return not table.bilateral or (
        table.negative.points == table.positive.points and curve_fits(pool, table.negative, numbers)
    )


def leadscrew_state_fits(table: LeadscrewTable, state: LeadscrewState) -> bool:
    """Tell whether the state belongs to such a table; both directions have the same points."""
    return lookup_fits(state.lookup, table.positive.points) and 0 <= state.reversal_step <= table.reversal_cycles
