"""The volumetric compensations of one cycle, each from the raw setpoints of its axes (semantics §10).

The sum of all corrections of an axis stays below its limit, as that of the gantry slaves that follow it. Where it does
not, its last value becomes a shift, the axes are asked to stop, and every compensation of the axis switches off.
"""

from __future__ import annotations

from typing import Annotated

from .record import Vec, zeros
from .records import ERROR_INPUT, Inputs, Outputs, State, Tables
from .volumetric_model import correction_at
from .volumetric_records import ERROR_LIMIT_EXCEEDED, ERROR_SINGULAR, LETTERS, LINEAR, VolumetricState, VolumetricTable
from .volumetric_switching import (
    advance_filters,
    drop_axis,
    release_shifts,
    request_stops,
    set_error,
    smooth,
    stop_without_motion,
    switch_volumetric,
)

LARGEST_TOOL = 1e6  # mm


def compensate_volume(tables: Tables, pool: Vec, state: State, inputs: Inputs, outputs: Outputs) -> None:
    """Put the sum of all volumetric corrections and shifts into the state of every axis."""
    for i in range(tables.axis_count):
        state.axis[i].volumetric_correction = 0.0
        state.axis[i].volumetric_shift = 0.0
        if inputs.reset:
            state.axis[i].stop_request = False
    if is_tool_length(inputs.tool_length):
        state.tool_length = inputs.tool_length
    for k in range(tables.volumetrics):
        table = tables.volumetric[k]
        if table.configured:
            volumetric = state.volumetric[k]
            switch_volumetric(table, volumetric, inputs.volumetric[k], inputs, state)
            filter_values(pool, table, volumetric, state)
            add_to_axes(table, volumetric, state)
    for k in range(tables.volumetrics):
        if state.volumetric[k].progress > 0.0:
            check_limits(tables.volumetric[k], state.volumetric[k], state)
    for i in range(tables.axis_count):
        state.axis[i].volumetric_correction = 0.0
    for k in range(tables.volumetrics):
        if tables.volumetric[k].configured:
            contribute(tables.volumetric[k], state.volumetric[k], state)
            outputs.volumetric[k].active = state.volumetric[k].progress > 0.0


def is_tool_length(length: float) -> bool:
    """Tell whether a tool can be that long."""
    return -LARGEST_TOOL <= length <= LARGEST_TOOL


def report_tool_length(tables: Tables, inputs: Inputs, outputs: Outputs) -> None:
    """Report a tool length that cannot be used at X, Y and Z of all compensations."""
    if not is_tool_length(inputs.tool_length):
        for k in range(tables.volumetrics):
            if tables.volumetric[k].configured:
                for d in range(LINEAR):
                    outputs.axis[tables.volumetric[k].axis[d]].error = ERROR_INPUT


def filter_values(pool: Vec, table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Compute the corrections at full weight and let all filters go on; an error switches off."""
    acts = volumetric.on or volumetric.progress > 0.0
    if volumetric.progress == 0.0 or not volumetric.started:
        volumetric.tool_length = state.tool_length
        volumetric.new_tool_length = state.tool_length
        volumetric.tool_progress = 1.0
    usable = True
    if acts:
        usable = compute_values(pool, table, volumetric, state, volumetric.tool_length, volumetric.value)
        if usable and state.tool_length != volumetric.new_tool_length:
            volumetric.old_tool_length = volumetric.tool_length
            volumetric.new_tool_length = state.tool_length
            volumetric.tool_progress = 0.0
            usable = compute_values(pool, table, volumetric, state, state.tool_length, volumetric.tool_change)
            for d in range(LINEAR):
                volumetric.tool_change[d] -= volumetric.value[d]
    changes_tool = volumetric.tool_progress < 1.0
    advance_filters(table, volumetric, state)
    if usable and acts and changes_tool:
        way = volumetric.new_tool_length - volumetric.old_tool_length
        volumetric.tool_length = volumetric.old_tool_length + smooth(volumetric.tool_progress) * way
        usable = compute_values(pool, table, volumetric, state, volumetric.tool_length, volumetric.value)
    if not usable:
        volumetric.command = False
        stop_without_motion(volumetric, True)
        set_error(table, state, ERROR_SINGULAR)
    volumetric.started = True


def compute_values(
    pool: Vec,
    table: VolumetricTable,
    volumetric: VolumetricState,
    state: State,
    tool_length: float,
    value: Annotated[list[float], LINEAR],
) -> bool:
    """Put the corrections at full weight into ``value``; False: there are none here, and it stays."""
    position = zeros(LETTERS)
    for letter in range(LETTERS):
        position[letter] = state.motion.axis[table.axis[letter]].setpoint + table.offset[letter]
    correction = zeros(LINEAR)
    if not correction_at(pool, table, position, tool_length, volumetric.section, correction):
        return False
    for d in range(LINEAR):
        value[d] = table.sign[d] * volumetric.factor[d] * correction[d]
    return True


def correction_of(volumetric: VolumetricState, letter: int) -> float:
    """Return the correction of X, Y or Z in this cycle."""
    if volumetric.taking_part[letter]:
        return volumetric.weight * volumetric.value[letter]
    return 0.0


def add_to_axes(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Add the corrections of this cycle to their axes."""
    for m in range(table.members):
        letter = table.member_letter[m]
        if letter < LINEAR:
            state.axis[table.member[m]].volumetric_correction += correction_of(volumetric, letter)


def check_limits(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Drop the axes whose corrections are too large together, stop all others, and let their corrections run down."""
    exceeded = False
    for m in range(table.members):
        letter = table.member_letter[m]
        axis = state.axis[table.member[m]]
        if letter < LINEAR and not abs(axis.volumetric_correction) <= table.member_limit[m]:
            exceeded = True
            drop_axis(volumetric, letter)
            axis.error = ERROR_LIMIT_EXCEEDED
    if exceeded:
        volumetric.command = False
        volumetric.on = False
        release_shifts(volumetric)
        request_stops(table, state)


def contribute(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Add corrections and shifts to the axes; a change that must not move an axis goes into its shift."""
    for d in range(LINEAR):
        contribution = correction_of(volumetric, d)
        if volumetric.absorbed[d]:
            volumetric.shift[d] += volumetric.contribution[d] - contribution
            volumetric.release[d] = 0.0
            volumetric.held_shift[d] = 0.0
        volumetric.contribution[d] = contribution
    add_to_axes(table, volumetric, state)
    for m in range(table.members):
        letter = table.member_letter[m]
        if letter < LINEAR:
            state.axis[table.member[m]].volumetric_shift += volumetric.shift[letter]
