"""Switching a compensation on and off: commands, conditions, standstill, and the sin² in between (semantics §4).

w(k) = sin²(π/2 · k/n), k = 1 … n; off runs back; a change of mind midway turns round where it is. New values that come
while a compensation acts blend in along the same sin².
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .trigonometry import HALF_PI, sine

NEEDS = 3  # a plane needs two masters and its slave
CYCLES_MAX = 20  # of a transition (P-COMP-00026, P-AXIS-00243)


@dataclass(slots=True)
class SwitchTable:
    """How a compensation switches on and off."""

    configured: bool  # there is a table
    manual: bool  # by command only; reset, program end and release switch off
    at_standstill: bool  # a command waits until the slave stands still
    cycles: int  # of the transition, at least 1 (1: at once)
    blend_cycles: int  # over which new values come in, at least 1 (1: at once)
    reserved: int  # entries the controller keeps free for its table; 0: the axis does not activate it
    points_error: int  # of an update that changes what is reserved; 0: it may
    needs: int  # axes that must be referenced
    need: Annotated[list[int], NEEDS]


@dataclass(slots=True)
class SwitchState:
    """Where a compensation stands between off and on, and what it adds."""

    wanted: int  # the input in the last cycle: its changes are the commands
    command: bool  # what was last commanded
    granted: bool  # the command, once it may act
    no_move: bool  # the command came with NO_MOVE
    step: int  # k of w(k)
    weight: float  # w(k), 0 … 1
    absorbed: float  # change of the weight that NO_MOVE takes out of the output, this cycle only
    difference: float  # what it added with its old values, less what it adds with the new ones, when those came
    blend_step: int  # of the transition to the new values: blend_cycles … 0


def ramp(step: int, cycles: int) -> float:
    """Return sin²(π/2 · step/cycles), 0 ≤ step ≤ cycles."""
    if step >= cycles:
        return 1.0
    if step <= 0:
        return 0.0
    s = sine(HALF_PI * step / cycles)
    return s * s


def is_command(wanted: int) -> bool:
    """Tell whether the input of a switch commands something: 0 as the lists say, 1 on, −1 off."""
    return -1 <= wanted <= 1


def is_on(manual: bool, wanted: int) -> bool:
    """Tell whether a switch commands on; what is no command counts as 0, what the lists say."""
    return wanted == 1 or (wanted != -1 and not manual)


def begin_switch(table: SwitchTable, state: SwitchState, wanted: int, ready: bool, released: bool) -> None:
    """Set the state at the start of a simulation: what is on begins at full weight."""
    state.wanted = wanted
    state.command = is_on(table.manual, wanted) and not is_refused(table, ready, released)
    state.granted = state.command
    state.no_move = False
    state.step = table.cycles if state.granted and ready else 0
    state.weight = 1.0 if state.step > 0 else 0.0
    state.absorbed = 0.0


def is_refused(table: SwitchTable, ready: bool, released: bool) -> bool:
    """Tell whether a command to switch on is refused: a manual one, before its references or while it is released."""
    return table.manual and (released or not ready)


def heed_command(
    table: SwitchTable, state: SwitchState, wanted: int, ready: bool, released: bool, no_move: bool
) -> None:
    """Take the command of this cycle, if there is one: ``wanted`` changes, or a manual compensation is released.

    ``ready``: the conditions hold. ``released``: reset, program end or release of the axis. ``no_move``: the command
    is to move nothing, whenever it acts.
    """
    if wanted != state.wanted:
        state.wanted = wanted
        on = is_on(table.manual, wanted)
        if is_command(wanted) and not (on and is_refused(table, ready, released)):
            state.command = on
            state.no_move = no_move
    if table.manual and state.command and released:
        state.command = False
        state.no_move = no_move


def advance_switch(table: SwitchTable, state: SwitchState, ready: bool, moving: bool) -> bool:
    """Advance the weight by one cycle; True: it has settled until a command, a reference or a release changes it.

    ``ready``: the conditions hold (references); while they do not, the weight runs down and a command need not wait.
    ``moving``: the slave is in motion.
    """
    switched = False
    if state.command != state.granted and not (moving and ready and table.at_standstill):
        state.granted = state.command
        switched = True

    state.absorbed = 0.0
    step = state.step
    at_once = switched and state.no_move and ready
    if at_once:
        step = table.cycles if state.granted else 0
    elif state.granted and ready:
        if step < table.cycles:
            step += 1
    elif step > 0:
        step -= 1
    if step != state.step:
        weight = ramp(step, table.cycles)
        if at_once:
            state.absorbed = weight - state.weight
        state.step = step
        state.weight = weight
    end = table.cycles if state.granted and ready else 0
    return step == end and state.command == state.granted and state.absorbed == 0.0


def contribution_of(table: SwitchTable, state: SwitchState, value: float) -> float:
    """Return what a compensation adds in this cycle; ``value``: at full weight."""
    contribution = state.weight * value
    if state.blend_step > 0:
        state.blend_step -= 1
        contribution += ramp(state.blend_step, table.blend_cycles) * state.difference
    return contribution


def blend_in(table: SwitchTable, state: SwitchState, difference: float) -> None:
    """Let new values come in softly; ``difference``: what it adds with the old ones, less that with the new ones."""
    if difference != 0.0:
        state.difference = ramp(state.blend_step, table.blend_cycles) * state.difference + difference
        state.blend_step = table.blend_cycles


def adopt_switch(before: SwitchTable, after: SwitchTable, state: SwitchState, wanted: int) -> None:
    """Keep a switch where it stands between off and on: its step becomes the one of about the same weight.

    What now activates automatically and did not, or had no table, needs no command: it comes on as soon as its
    conditions hold, unless it is commanded off.
    """
    if after.configured and not after.manual and (before.manual or not before.configured):
        state.wanted = wanted
        state.command = is_on(after.manual, wanted)
        state.no_move = False
        if not before.configured:
            state.granted = state.command
    state.step = mapped_step(state.step, before.cycles, after.cycles)
    if not after.configured:
        state.step = 0
    state.weight = ramp(state.step, after.cycles) if state.step > 0 else 0.0
    state.absorbed = 0.0
    if state.blend_step > 0:
        rest = ramp(state.blend_step, before.blend_cycles) * state.difference
        state.blend_step = max(mapped_step(state.blend_step, before.blend_cycles, after.blend_cycles), 1)
        state.difference = rest / ramp(state.blend_step, after.blend_cycles)


def mapped_step(step: int, before: int, after: int) -> int:
    """Return the step of a transition of another length that is nearest to as far."""
    if step <= 0 or before <= 0:
        return 0
    if step >= before:
        return after
    return (2 * step * after + before) // (2 * before)


def switch_fits(table: SwitchTable, axes: int) -> bool:
    """Tell whether a switch has transitions of a possible length and needs axes that are there."""
    if not (1 <= table.cycles <= CYCLES_MAX and 1 <= table.blend_cycles <= CYCLES_MAX):
        return False
    if not 0 <= table.needs <= NEEDS:
        return False
    for k in range(table.needs):
        if not 0 <= table.need[k] < axes:
            return False
    return True


def switch_state_fits(table: SwitchTable, state: SwitchState) -> bool:
    """Tell whether the state belongs to such a switch; without a table nothing acts, but a blend may run out."""
    if not (0 <= state.step <= table.cycles and 0 <= state.blend_step <= table.blend_cycles):
        return False
    return 0.0 <= state.weight <= 1.0 and (table.configured or (state.step == 0 and state.weight == 0.0))
