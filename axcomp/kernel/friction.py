"""Friction compensation (frict_comp): an additional motor current over the setpoint velocity v.

I = scaling · sign(v) · F(|v|) · w_before · w_after, then delayed by delay_cycles. w_after builds the current up over
position_delay after a reversal (the start counts as one), w_before takes it down over the last reversal_lookahead
cycles before one: the cycle n cycles before the last one of the old direction has w_before = n/reversal_lookahead.
"""

from __future__ import annotations

from .interpolation import curve_value, nearest
from .record import Vec, whole
from .records import DELAY_LINE, FrictionState, FrictionTable


def friction_current(
    pool: Vec,
    table: FrictionTable,
    state: FrictionState,
    position: float,
    velocity: float,
    acceleration: float,
    cycle_time: float,
    modulo_range: float,
) -> float:
    """Return the current of this cycle at full weight, and keep the delay line."""
    sign = 0
    if velocity > 0.0:
        sign = 1
    elif velocity < 0.0:
        sign = -1
    if sign != 0 and sign != state.direction:
        if table.delay >= table.lookahead:
            decay_delayed(table, state)
        state.direction = sign
        state.reversal_position = position
        state.built_up = False
        state.since_reversal = 0

    current = 0.0
    if sign != 0:
        current = table.scaling * sign * curve_value(pool, table.curve, abs(velocity), state.lookup)
        current = current * build_up(table, state, position, modulo_range)
        if table.delay < table.lookahead:
            current = current * decay_predicted(table, velocity, acceleration, cycle_time)
    if state.since_reversal < table.lookahead:
        state.since_reversal += 1
    return delayed(table, state, current)


def build_up(table: FrictionTable, state: FrictionState, position: float, modulo_range: float) -> float:
    """Return w_after = min(1, |s − s_reversal| / position_delay); once 1 it stays until the next reversal."""
    if not state.built_up:
        distance = abs(nearest(position - state.reversal_position, modulo_range))
        if distance < table.position_delay:
            return distance / table.position_delay
        state.built_up = True
    return 1.0


def decay_delayed(table: FrictionTable, state: FrictionState) -> None:
    """Weight the last cycles of the old direction, which still wait in the delay line: exact."""
    at = state.head
    for n in range(state.since_reversal):
        at = at - 1 if at > 0 else DELAY_LINE - 1
        state.line[at] = state.line[at] * n / table.lookahead


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
    at = state.head - table.delay
    if at < 0:
        at += DELAY_LINE
    state.head = state.head + 1 if state.head < DELAY_LINE - 1 else 0
    return state.line[at]
