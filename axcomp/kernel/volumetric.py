"""The volumetric compensations of one cycle, each from the raw setpoints of its axes (semantics §10).

Every correction stays below the limits of its axis and of the gantry slaves that follow it. Where one does not, its
last value becomes a shift, the axis is asked to stop, and the compensation switches off.
"""

from __future__ import annotations

from .record import Vec, zeros
from .records import Inputs, Outputs, State, Tables
from .volumetric_model import correction_at
from .volumetric_records import (
    ERROR_LIMIT_EXCEEDED,
    ERROR_SINGULAR,
    LETTERS,
    LINEAR,
    VolumetricState,
    VolumetricTable,
)
from .volumetric_switching import drop_axis, release_shifts, set_error, stop_without_motion, switch_volumetric

LARGEST_TOOL = 1e6  # mm


def compensate_volume(tables: Tables, pool: Vec, state: State, inputs: Inputs, outputs: Outputs) -> None:
    """Put the sum of all volumetric corrections and shifts into the state of every axis."""
    for i in range(tables.axis_count):
        state.axis[i].volumetric_correction = 0.0
        state.axis[i].volumetric_shift = 0.0
        if inputs.reset:
            state.axis[i].stop_request = False
    if -LARGEST_TOOL < inputs.tool_length < LARGEST_TOOL:
        state.tool_length = inputs.tool_length
    for k in range(tables.volumetrics):
        table = tables.volumetric[k]
        if table.configured:
            volumetric = state.volumetric[k]
            switch_volumetric(table, volumetric, inputs.volumetric[k], inputs, state)
            if volumetric.step > 0:
                compute_values(pool, table, volumetric, state)
            contribute(table, volumetric, state)
            outputs.volumetric[k].active = volumetric.step > 0


def compute_values(pool: Vec, table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Compute the corrections at full weight; an error switches off."""
    position = zeros(LETTERS)
    for letter in range(LETTERS):
        position[letter] = state.motion.axis[table.axis[letter]].setpoint + table.offset[letter]
    correction = zeros(LINEAR)
    if not correction_at(pool, table, position, state.tool_length, volumetric.section, correction):
        volumetric.command = False
        stop_without_motion(volumetric)
        set_error(table, state, ERROR_SINGULAR)
        return
    for d in range(LINEAR):
        volumetric.value[d] = volumetric.factor[d] * correction[d]
    check_limits(table, volumetric, state)


def check_limits(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Drop the axes whose correction is too large, and let the others run down."""
    size = zeros(LETTERS)
    for d in range(LINEAR):
        if volumetric.taking_part[d]:
            size[d] = abs(volumetric.value[d])
    exceeded = False
    for m in range(table.members):
        letter = table.member_letter[m]
        if letter < LINEAR and not size[letter] <= table.member_limit[m]:
            exceeded = True
            drop_axis(volumetric, letter)
            axis = state.axis[table.member[m]]
            axis.error = ERROR_LIMIT_EXCEEDED
            axis.stop_request = True
    if exceeded:
        volumetric.command = False
        volumetric.on = False
        release_shifts(table, volumetric)


def contribute(table: VolumetricTable, volumetric: VolumetricState, state: State) -> None:
    """Add corrections and shifts to the axes; a change that must not move an axis goes into its shift."""
    for d in range(LINEAR):
        contribution = 0.0
        if volumetric.taking_part[d]:
            contribution = volumetric.weight * volumetric.value[d]
        if volumetric.absorbed[d]:
            volumetric.shift[d] += volumetric.contribution[d] - contribution
            volumetric.release_step[d] = 0
        volumetric.contribution[d] = contribution
    for m in range(table.members):
        letter = table.member_letter[m]
        if letter < LINEAR:
            axis = state.axis[table.member[m]]
            axis.volumetric_correction += volumetric.contribution[letter]
            axis.volumetric_shift += volumetric.shift[letter]
