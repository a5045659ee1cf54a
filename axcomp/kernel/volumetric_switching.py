"""Switching the volumetric compensations: what is on, with which weight, and what is absorbed without motion.

A switch takes ``filter_steps`` cycles along 10u³ − 15u⁴ + 6u⁵; a change of mind midway turns round where it is. Where
an axis must not move, what its correction loses or gains becomes a shift that stays until the next switch (semantics
§10).
"""

from __future__ import annotations

from .records import Inputs, State
from .volumetric_records import (
    ERROR_LIMIT_UNDEFINED,
    ERROR_PROGRAM_END,
    LINEAR,
    VolumetricInputs,
    VolumetricState,
    VolumetricTable,
)


def smooth(step: int, cycles: int) -> float:
    """Return 10u³ − 15u⁴ + 6u⁵, u = step/cycles, 0 ≤ step ≤ cycles: velocity and acceleration are 0 at both ends."""
    if step >= cycles:
        return 1.0
    u = step / cycles
    return u * u * u * (10.0 + u * (6.0 * u - 15.0))


def switch_volumetric(
    table: VolumetricTable, volumetric: VolumetricState, given: VolumetricInputs, inputs: Inputs, state: State
) -> None:
    """Follow commands and conditions and advance the weight by one cycle; what is on in the first has full weight."""
    for d in range(LINEAR):
        volumetric.absorbed[d] = False
    if not volumetric.started or given.enable != volumetric.enable:
        volumetric.enable = given.enable
        take_command(table, volumetric, given, given.enable)
    ready = drop_members(table, volumetric, inputs)
    if inputs.reset:
        volumetric.command = False
        stop_without_motion(volumetric)
    elif inputs.program_end and table.associated and volumetric.on:
        volumetric.command = False
        stop_without_motion(volumetric)
        set_error(table, state, ERROR_PROGRAM_END)
    elif table.manual and volumetric.command and (inputs.program_end or not ready):
        take_command(table, volumetric, given, False)

    if volumetric.on and not (volumetric.command and ready):
        if ready and volumetric.no_move:
            stop_without_motion(volumetric)
        else:
            volumetric.on = False
            release_shifts(table, volumetric)
    elif not volumetric.on and volumetric.command and ready and (volumetric.step == 0 or can_turn_round(volumetric)):
        switch_on(table, volumetric, state)
    advance_weight(table, volumetric)
    volumetric.started = True


def take_command(table: VolumetricTable, volumetric: VolumetricState, given: VolumetricInputs, command: bool) -> None:
    """Keep a command until it can be obeyed, and what came with it."""
    volumetric.command = command
    volumetric.no_move = given.no_move
    for d in range(LINEAR):
        volumetric.wanted_factor[d] = signed_factor(table, given, d)


def adopt_volumetric(before: VolumetricTable, after: VolumetricTable, volumetric: VolumetricState) -> None:
    """Switch off without motion for an update; a manual compensation needs a new command."""
    stop_without_motion(volumetric)
    if after.manual:
        volumetric.command = False
    for d in range(LINEAR):
        volumetric.shift[d] += volumetric.contribution[d]
        volumetric.contribution[d] = 0.0
        volumetric.release_step[d] = 0
        if before.axis[d] != after.axis[d]:
            volumetric.shift[d] = 0.0


def drop_members(table: VolumetricTable, volumetric: VolumetricState, inputs: Inputs) -> bool:
    """Take out the axes that are in error or have lost their reference; True: there are none."""
    ready = True
    for m in range(table.members):
        given = inputs.axis[table.member[m]]
        if given.fault or not given.referenced:
            ready = False
            if given.fault and volumetric.on:
                volumetric.command = False
            if table.member_letter[m] < LINEAR:
                drop_axis(volumetric, table.member_letter[m])
    return ready


def drop_axis(volumetric: VolumetricState, letter: int) -> None:
    """Let the correction of X, Y or Z end without motion; it comes back when the compensation is switched on again."""
    if volumetric.taking_part[letter]:
        volumetric.taking_part[letter] = False
        volumetric.absorbed[letter] = True


def stop_without_motion(volumetric: VolumetricState) -> None:
    """Switch off at once; the corrections become shifts."""
    volumetric.on = False
    volumetric.step = 0
    volumetric.weight = 0.0
    for d in range(LINEAR):
        volumetric.absorbed[d] = True


def switch_on(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Switch on, provided that every limit is defined."""
    for m in range(table.members):
        if table.member_letter[m] < LINEAR and table.member_limit[m] <= 0.0:
            volumetric.command = False
            state.axis[table.member[m]].error = ERROR_LIMIT_UNDEFINED
    if not volumetric.command:
        return
    volumetric.on = True
    for d in range(LINEAR):
        volumetric.taking_part[d] = True
        volumetric.factor[d] = volumetric.wanted_factor[d]
    for m in range(table.members):
        state.axis[table.member[m]].stop_request = False
    if not volumetric.started:
        volumetric.step = table.cycles
    elif volumetric.no_move:
        volumetric.step = table.cycles
        for d in range(LINEAR):
            volumetric.absorbed[d] = True
    else:
        release_shifts(table, volumetric)


def signed_factor(table: VolumetricTable, given: VolumetricInputs, letter: int) -> float:
    """Return sign · CFACT of X, Y or Z, the factor held within 0 … 1; what is no number counts as 0."""
    factor = given.factor_x
    if letter == 1:
        factor = given.factor_y
    elif letter == LINEAR - 1:
        factor = given.factor_z
    if factor >= 0.0:
        return table.sign[letter] * min(factor, 1.0)
    return 0.0


def can_turn_round(volumetric: VolumetricState) -> bool:
    """Tell whether a compensation that is running down can go up again; else it has to be down before."""
    for d in range(LINEAR):
        if not volumetric.taking_part[d] or volumetric.factor[d] != volumetric.wanted_factor[d]:
            return False
    return True


def release_shifts(table: VolumetricTable, volumetric: VolumetricState) -> None:
    """Begin to take back the shifts of the axes that may move, along with this switch."""
    for d in range(LINEAR):
        if not volumetric.absorbed[d]:
            volumetric.held_shift[d] = volumetric.shift[d]
            volumetric.release_step[d] = table.cycles


def advance_weight(table: VolumetricTable, volumetric: VolumetricState) -> None:
    """Advance weight and shifts by one cycle."""
    if volumetric.on:
        if volumetric.step < table.cycles:
            volumetric.step += 1
    elif volumetric.step > 0:
        volumetric.step -= 1
    volumetric.weight = smooth(volumetric.step, table.cycles)
    for d in range(LINEAR):
        if volumetric.release_step[d] > 0:
            volumetric.release_step[d] -= 1
            volumetric.shift[d] = volumetric.held_shift[d] * smooth(volumetric.release_step[d], table.cycles)


def set_error(table: VolumetricTable, state: State, error: int) -> None:
    """Report an error at X, Y and Z."""
    for d in range(LINEAR):
        state.axis[table.axis[d]].error = error
