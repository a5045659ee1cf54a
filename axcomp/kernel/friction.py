"""Friction compensation (frict_comp): an additional motor current over the setpoint velocity v.

I = scaling · sign(v) · F(|v|) · w_before · w_after, then delayed by delay_cycles. w_after builds the current up over
position_delay after a reversal (the start counts as one), w_before takes it down over the last reversal_lookahead
cycles before one: the cycle n cycles before the last one of the old direction has w_before = n/reversal_lookahead.
What is to come is in the delay line, or given, or predicted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .interpolation import (
    LARGEST,
    Curve,
    Lookup,
    curve_fits,
    curve_value,
    forget,
    lookup_fits,
    move_curve,
    nearest,
    period_fits,
)
from .motion import AxisMotion, way_sign
from .record import APART, Vec, whole, zeros

DELAY_LINE = 249  # delay_cycles < 249 (P-COMP-00058)
LOOKAHEAD_MAX = 4  # P-COMP-00044


@dataclass(slots=True)
class FrictionTable:
    """Current over the speed."""

    curve: Curve
    scaling: float
    position_delay: float
    lookahead: int
    delay: int
    modulo_range: float  # of the axis; 0: it does not count modulo


@dataclass(slots=True)
class FrictionInputs:
    """What is known of the motion to come."""

    ahead_known: bool
    velocity_ahead: Annotated[list[float], LOOKAHEAD_MAX]  # of the next cycles


@dataclass(slots=True)
class FrictionState:
    """What the friction compensation remembers."""

    lookup: Lookup
    direction: int  # sign of the last velocity that was not 0
    reversal_position: float
    built_up: bool  # the axis has gone position_delay since
    since_reversal: int  # cycles, at most lookahead
    head: int  # where the delay line, of delay + 1 elements, is written next
    predicted: bool  # a reversal has been predicted from velocity and acceleration, for want of velocities to come
    line: Annotated[list[float], DELAY_LINE, APART]


def friction_current(
    pool: Vec, table: FrictionTable, state: FrictionState, given: FrictionInputs, motion: AxisMotion, cycle_time: float
) -> float:
    """Return the current of this cycle at full weight, and keep the delay line."""
    sign = motion.sign
    if sign != 0 and sign != state.direction:
        if table.delay >= table.lookahead:
            decay_delayed(table, state)
        state.direction = sign
        state.reversal_position = motion.setpoint
        state.built_up = False
        state.since_reversal = 0

    current = 0.0
    if sign != 0:
        current = table.scaling * sign * curve_value(pool, table.curve, abs(motion.velocity), state.lookup)
        current = current * build_up(table, state, motion.setpoint)
        if table.delay < table.lookahead:
            if given.ahead_known:
                current = current * decay_known(table, given, sign, cycle_time)
            else:
                state.predicted = True
                current = current * decay_predicted(table, motion.velocity, motion.acceleration, cycle_time)
    if state.since_reversal < table.lookahead:
        state.since_reversal += 1
    return delayed(table, state, current)


def build_up(table: FrictionTable, state: FrictionState, position: float) -> float:
    """Return w_after = min(1, |s − s_reversal| / position_delay); once 1 it stays until the next reversal."""
    if not state.built_up:
        distance = abs(nearest(position - state.reversal_position, table.modulo_range))
        if distance < table.position_delay:
            return distance / table.position_delay
        state.built_up = True
    return 1.0


def decay_delayed(table: FrictionTable, state: FrictionState) -> None:
    """Weight the last cycles of the old direction, which still wait in the delay line: exact."""
    at = state.head
    for n in range(state.since_reversal):
        at = at - 1 if at > 0 else table.delay
        state.line[at] = state.line[at] * n / table.lookahead


def decay_known(table: FrictionTable, given: FrictionInputs, sign: int, cycle_time: float) -> float:
    """Return w_before from the velocities to come: exact; an axis that only slows down is not weighted."""
    for n in range(table.lookahead):
        if way_sign(given.velocity_ahead[n] * cycle_time) == -sign:
            return n / table.lookahead
    return 1.0


def decay_predicted(table: FrictionTable, velocity: float, acceleration: float, cycle_time: float) -> float:
    """Return w_before when velocity and acceleration stay as they are: the velocity crosses 0 after t = −v/a."""
    if velocity * acceleration >= 0.0:
        return 1.0
    cycles = -velocity / acceleration / cycle_time
    if cycles >= table.lookahead:
        return 1.0
    return whole(cycles) / table.lookahead


def delayed(table: FrictionTable, state: FrictionState, current: float) -> float:
    """Put a current into the delay line and return the one of ``delay`` cycles ago."""
    state.line[state.head] = current
    state.head = state.head + 1 if state.head < table.delay else 0
    return state.line[state.head]


def adopt_friction(before: FrictionTable, after: FrictionTable, state: FrictionState) -> None:
    """Go on with another table; where there was none, begin: nothing waits in the delay line."""
    forget(state.lookup)
    if before.curve.points == 0:
        state.direction = 0
        state.line[0] = 0.0
    if after.delay != before.delay:
        stretch(before.delay, after.delay, state)
    state.since_reversal = min(state.since_reversal, after.lookahead)


def stretch(before: int, after: int, state: FrictionState) -> None:
    """Make the delay line one of another delay: what waits goes on waiting, behind it the oldest current is held."""
    waiting = zeros(DELAY_LINE)
    for age in range(after + 1):
        at = state.head - 1 - min(age, before)
        if at < 0:
            at += before + 1
        waiting[age] = state.line[at]
    for age in range(after + 1):
        state.line[after - age] = waiting[age]
    state.head = 0


def move_friction(table: FrictionTable, by: int) -> None:
    """Follow the numbers of the table to another place in the pool."""
    move_curve(table.curve, by)


def friction_fits(pool: Vec, table: FrictionTable, numbers: int) -> bool:
    """Tell whether the table can be used."""
    if not (curve_fits(pool, table.curve, numbers) and period_fits(table.modulo_range)):
        return False
    if not (abs(table.scaling) < LARGEST and 0.0 <= table.position_delay < LARGEST):
        return False
    return 0 <= table.delay < DELAY_LINE and 0 <= table.lookahead <= LOOKAHEAD_MAX


def friction_state_fits(table: FrictionTable, state: FrictionState) -> bool:
    """Tell whether the state belongs to such a table."""
    if not (-1 <= state.direction <= 1 and 0 <= state.since_reversal <= table.lookahead):
        return False
    for k in range(table.delay + 1):
        if state.line[k] - state.line[k] != 0.0:
            return False
    return 0 <= state.head <= table.delay and lookup_fits(state.lookup, table.curve.points)
