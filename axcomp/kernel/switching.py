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
    state.no_move = False
    state.step = table.cycles if state.granted and ready else 0
    state.weight = 1.0 if state.step > 0 else 0.0
    state.absorbed = 0.0


def heed_command(
    table: SwitchTable, state: SwitchState, enable: bool, ready: bool, released: bool, no_move: bool
) -> None:
    """Take the command of this cycle, if there is one: an edge of ``enable``, or a manual compensation is released.

    ``ready``: the conditions hold (references). ``released``: reset or program end. ``no_move``: the command is to move
    nothing, whenever it acts.
    """
    if enable != state.enable:
        state.enable = enable
        state.command = enable
        state.no_move = no_move
    if table.manual and state.command and (released or not ready):
        state.command = False
        state.no_move = no_move


def advance_switch(table: SwitchTable, state: SwitchState, ready: bool, moving: bool) -> None:
    """Advance the weight by one cycle.

    ``ready``: the conditions hold (references); while they do not, nothing is put out and a command need not wait.
    ``moving``: the slave is in motion.
    """
    switched = False
    if state.command != state.granted and not (moving and ready and table.at_standstill):
        state.granted = state.command
        switched = True

    at_once = switched and state.no_move
    step = state.step
    if not ready:
        step = 0
    elif at_once:
        step = table.cycles if state.granted else 0
    elif state.granted:
        if step < table.cycles:
            step += 1
    elif step > 0:
        step -= 1
    state.absorbed = 0.0
    if step != state.step:
        weight = ramp(step, table.cycles)
        if at_once and ready:
            state.absorbed = weight - state.weight
        state.step = step
        state.weight = weight
