"""Switching a compensation on and off: commands, conditions, standstill, and the sin² in between (semantics §4).

w(k) = sin²(π/2 · k/n), k = 1 … n; off runs back; a change of mind midway turns round where it is.
"""

from __future__ import annotations

from .records import SwitchState, SwitchTable
from .trigonometry import HALF_PI, sine


def ramp(step: int, cycles: int) -> float:
    """Return sin²(π/2 · step/cycles), 0 ≤ step ≤ cycles."""
    if step >= cycles:
        return 1.0
    if step <= 0:
        return 0.0
    s = sine(HALF_PI * step / cycles)
    return s * s


def begin_switch(table: SwitchTable, state: SwitchState, enable: bool, ready: bool, released: bool) -> None:
    """Set the state at the start of a simulation: what is on begins at full weight."""
    state.enable = enable
    state.command = enable and not (table.manual and (released or not ready))
    state.granted = state.command
    state.step = table.cycles if state.granted and ready else 0
    state.weight = 1.0 if state.step > 0 else 0.0
    state.absorbed = 0.0


def advance_switch(
    table: SwitchTable,
    state: SwitchState,
    enable: bool,
    ready: bool,
    released: bool,
    moving: bool,
    no_move: bool,
) -> None:
    """Advance the weight by one cycle.

    ``ready``: the conditions hold (references). ``released``: reset, program end or loss of the slave's reference.
    ``moving``: the slave is in motion. ``no_move``: a command acts at once, and its effect is absorbed.
    """
    state.absorbed = 0.0
    if enable != state.enable:
        state.enable = enable
        state.command = enable
    if table.manual and (released or not ready):
        state.command = False
    switched = False
    if state.command != state.granted and not (moving and table.at_standstill):
        state.granted = state.command
        switched = True

    step = state.step
    if not ready:
        step = 0
    elif switched and no_move:
        step = table.cycles if state.granted else 0
    elif state.granted:
        if step < table.cycles:
            step += 1
    elif step > 0:
        step -= 1
    if step != state.step:
        weight = ramp(step, table.cycles)
        if switched and no_move and ready:
            state.absorbed = weight - state.weight
        state.step = step
        state.weight = weight
