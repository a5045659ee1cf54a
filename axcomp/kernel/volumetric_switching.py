"""Switching the volumetric compensations: what is on, with which weight, and what is absorbed without motion.

A switch takes ``filter_steps`` cycles along 10u³ − 15u⁴ + 6u⁵, more where it would be faster than ``v_limit``; a change
of mind midway turns round where it is. Where an axis must not move, what its correction loses or gains becomes a shift.
It is released along the same filter with the axis' next motion, or with the next switch that may move (semantics §10).
"""

from __future__ import annotations

from .records import ERROR_SWITCH, Inputs, State
from .switching import is_command, is_on
from .volumetric_records import (
    ERROR_LIMIT_UNDEFINED,
    ERROR_PROGRAM_END,
    ERRORS,
    LINEAR,
    VolumetricInputs,
    VolumetricState,
    VolumetricTable,
)

STEEPEST = 1.875  # slope of ``smooth`` in its middle
ARRIVED = 1e-9  # a filter that is nearer to its end is there


def smooth(u: float) -> float:
    """Return 10u³ − 15u⁴ + 6u⁵, 0 ≤ u ≤ 1: velocity and acceleration are 0 at both ends."""
    return u * u * u * (10.0 + u * (6.0 * u - 15.0))


def switch_volumetric(
    table: VolumetricTable, volumetric: VolumetricState, given: VolumetricInputs, inputs: Inputs, state: State
) -> None:
    """Follow commands and conditions; what is on in the first cycle has full weight."""
    for d in range(LINEAR):
        volumetric.absorbed[d] = False
    if not volumetric.started or given.wanted != volumetric.wanted:
        volumetric.wanted = given.wanted
        if not is_command(given.wanted):
            set_error(table, state, ERROR_SWITCH)
        if not volumetric.started or is_command(given.wanted):
            take_command(volumetric, given, is_on(table.manual, given.wanted))
    ready = drop_members(table, volumetric, inputs, state)
    if inputs.reset:
        volumetric.command = False
        stop_without_motion(volumetric, True)
    elif inputs.program_end and table.associated and volumetric.on:
        volumetric.command = False
        stop_without_motion(volumetric, True)
        set_error(table, state, ERROR_PROGRAM_END)
    elif table.manual and volumetric.command and not ready:
        take_command(volumetric, given, False)

    if volumetric.on and not (volumetric.command and ready):
        if ready and volumetric.no_move:
            stop_without_motion(volumetric, False)
        else:
            volumetric.on = False
            release_shifts(volumetric)
    elif not volumetric.on and volumetric.command and ready and can_turn_round(volumetric):
        switch_on(table, volumetric, state)


def take_command(volumetric: VolumetricState, given: VolumetricInputs, command: bool) -> None:
    """Keep a command until it can be obeyed, and what came with it."""
    volumetric.command = command
    volumetric.no_move = given.no_move
    for d in range(LINEAR):
        volumetric.wanted_factor[d] = factor_of(given, d)


def adopt_volumetric(before: VolumetricTable, after: VolumetricTable, volumetric: VolumetricState) -> None:
    """Switch off without motion for an update; a manual compensation needs a new command, an automatic one none."""
    stop_without_motion(volumetric, True)
    if after.manual:
        volumetric.command = False
    elif before.manual:
        volumetric.command = volumetric.wanted != -1
        volumetric.no_move = False
        for d in range(LINEAR):
            volumetric.wanted_factor[d] = 1.0
    for b in range(ERRORS):
        volumetric.section[b] = 0
    for d in range(LINEAR):
        volumetric.shift[d] += volumetric.contribution[d]
        volumetric.contribution[d] = 0.0
        volumetric.release[d] = 0.0
        volumetric.held_shift[d] = 0.0
        if before.axis[d] != after.axis[d]:
            volumetric.shift[d] = 0.0


def drop_members(table: VolumetricTable, volumetric: VolumetricState, inputs: Inputs, state: State) -> bool:
    """Take out the axes that are in error or have lost their reference; True: there are none.

    An error while the compensation is on stops all the others.
    """
    ready = True
    failed = False
    for m in range(table.members):
        given = inputs.axis[table.member[m]]
        if given.fault or given.unreferenced:
            ready = False
            failed = failed or (given.fault and volumetric.on)
            if table.member_letter[m] < LINEAR:
                drop_axis(volumetric, table.member_letter[m])
    if failed:
        volumetric.command = False
        request_stops(table, state)
        for m in range(table.members):
            if inputs.axis[table.member[m]].fault:
                state.axis[table.member[m]].stop_request = False
    return ready


def request_stops(table: VolumetricTable, state: State) -> None:
    """Ask all axes that take part to stop, gantry masters and slaves included."""
    for m in range(table.members):
        state.axis[table.member[m]].stop_request = True


def drop_axis(volumetric: VolumetricState, letter: int) -> None:
    """Let the correction of X, Y or Z end without motion; it comes back when the compensation is switched on again."""
    if volumetric.taking_part[letter]:
        volumetric.taking_part[letter] = False
        volumetric.absorbed[letter] = True
        volumetric.waiting[letter] = True


def stop_without_motion(volumetric: VolumetricState, waiting: bool) -> None:
    """Switch off at once; the corrections become shifts. ``waiting``: these outlast a motion that is under way."""
    volumetric.on = False
    volumetric.progress = 0.0
    volumetric.weight = 0.0
    for d in range(LINEAR):
        volumetric.absorbed[d] = True
        volumetric.waiting[d] = waiting


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
        volumetric.progress = 1.0
    elif volumetric.no_move:
        volumetric.progress = 1.0
        for d in range(LINEAR):
            volumetric.absorbed[d] = True
            volumetric.waiting[d] = False
    else:
        release_shifts(volumetric)


def factor_of(given: VolumetricInputs, letter: int) -> float:
    """Return CFACT of X, Y or Z, held within 0 … 1; where its reduction is no number it is 0."""
    factor = 1.0 - given.reduction_x
    if letter == 1:
        factor = 1.0 - given.reduction_y
    elif letter == LINEAR - 1:
        factor = 1.0 - given.reduction_z
    if factor >= 0.0:
        return min(factor, 1.0)
    return 0.0


def can_turn_round(volumetric: VolumetricState) -> bool:
    """Tell whether a compensation that is running down can go up again; else it has to be down before."""
    if volumetric.progress == 0.0:
        return True
    for d in range(LINEAR):
        if not volumetric.taking_part[d] or volumetric.factor[d] != volumetric.wanted_factor[d]:
            return False
    return True


def release_shifts(volumetric: VolumetricState) -> None:
    """Begin to take back the shifts of the axes that may move, along with this switch."""
    for d in range(LINEAR):
        if not volumetric.absorbed[d]:
            take_shift_back(volumetric, d)


def take_shift_back(volumetric: VolumetricState, letter: int) -> None:
    """Begin to take back a shift."""
    volumetric.held_shift[letter] = volumetric.shift[letter]
    volumetric.release[letter] = 1.0 if volumetric.shift[letter] != 0.0 else 0.0


def advance_filters(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Let all filters go on by one cycle; a shift whose axis begins to move is released."""
    for d in range(LINEAR):
        if not state.motion.axis[table.axis[d]].moving:
            volumetric.waiting[d] = False
        elif volumetric.shift[d] != 0.0 and volumetric.release[d] == 0.0 and not volumetric.waiting[d]:
            take_shift_back(volumetric, d)
    share = share_of_cycle(table, volumetric)
    volumetric.progress = advanced(volumetric.progress, share if volumetric.on else -share)
    volumetric.weight = smooth(volumetric.progress)
    volumetric.tool_progress = advanced(volumetric.tool_progress, share)
    for d in range(LINEAR):
        if volumetric.release[d] > 0.0:
            volumetric.release[d] = advanced(volumetric.release[d], -share)
            volumetric.shift[d] = volumetric.held_shift[d] * smooth(volumetric.release[d])


def share_of_cycle(table: VolumetricTable, volumetric: VolumetricState) -> float:
    """Return how much of its way every filter goes in a cycle: together they are no faster than the axes may be."""
    share = 1.0 / table.cycles
    for d in range(LINEAR):
        way = 0.0
        if 0.0 < volumetric.progress < 1.0 or volumetric.on != (volumetric.progress > 0.0):
            way += abs(volumetric.value[d])
        if volumetric.tool_progress < 1.0:
            way += abs(volumetric.tool_change[d])
        if volumetric.release[d] > 0.0:
            way += abs(volumetric.held_shift[d])
        if table.velocity[d] > 0.0 and STEEPEST * way * share > table.velocity[d]:
            share = table.velocity[d] / (STEEPEST * way)
    return share


def advanced(progress: float, by: float) -> float:
    """Return the progress of a filter after one more cycle."""
    progress += by
    if progress > 1.0 - ARRIVED:
        return 1.0
    return progress if progress > ARRIVED else 0.0


def set_error(table: VolumetricTable, state: State, error: int) -> None:
    """Report an error at X, Y and Z."""
    for d in range(LINEAR):
        state.axis[table.axis[d]].error = error
