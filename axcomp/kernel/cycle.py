"""One cycle of the whole engine (semantics §3).

For every axis: cross, plane, crosstalk and temperature, each from raw setpoints; the leadscrew from raw + these; then
backlash; the volumetric compensations from the raw setpoints of all their axes; corrected setpoint = raw + all
corrections + shift; the friction current from the setpoint velocity; display position = measured position − (corrected
− raw).
"""

from __future__ import annotations

from .activation import activate_if_stirred
from .compensations import FRICTION, LEADSCREW, compensation_value, has_inputs, renew
from .interpolation import LARGEST, nearest
from .motion import AxisMotion, move_axis
from .record import Vec
from .records import ERROR_INPUT, AxisInputs, AxisOutputs, AxisState, Inputs, Outputs, State, Tables
from .shift import absorb_switch, release_shift
from .switching import blend_in, contribution_of
from .volumetric import compensate_volume, report_tool_length


def cycle(tables: Tables, pool: Vec, state: State, inputs: Inputs, outputs: Outputs) -> None:
    """Run one cycle: the outputs belong to these inputs."""
    references_changed = False
    for i in range(tables.axis_count):
        accept(tables, state.axis[i], state.motion.axis[i], inputs, i)
        if inputs.axis[i].referenced != state.axis[i].referenced:
            state.axis[i].referenced = inputs.axis[i].referenced
            references_changed = True
    if tables.volumetrics > 0:
        compensate_volume(tables, pool, state, inputs, outputs)
    for i in range(tables.axis_count):
        axis = state.axis[i]
        if inputs.reset:
            axis.error = 0
        moving = state.motion.axis[i].moving
        activate_if_stirred(tables.axis[i], axis, inputs, inputs.axis[i], outputs.axis[i], moving, references_changed)
        if axis.held:
            outputs.axis[i].error = ERROR_INPUT
        else:
            correct_axis(tables, pool, state, inputs.axis[i], outputs.axis[i], i)
            outputs.axis[i].error = axis.error
    if tables.volumetrics > 0:
        report_tool_length(tables, inputs, outputs)


def accept(tables: Tables, axis: AxisState, motion: AxisMotion, inputs: Inputs, i: int) -> None:
    """Take an axis' inputs if they are finite; else the last good ones stay, and the axis is held for this cycle."""
    given = inputs.axis[i]
    axis.held = not (
        -LARGEST < given.setpoint < LARGEST
        and -LARGEST < given.velocity < LARGEST
        and -LARGEST < given.acceleration < LARGEST
        and -LARGEST < given.actual_position < LARGEST
    )
    if not axis.held:
        if not axis.started:
            motion.counted = given.setpoint
            motion.setpoint = given.setpoint
        velocity = given.velocity
        acceleration = given.acceleration
        if inputs.derive_motion:
            way = nearest(given.setpoint - motion.setpoint, tables.axis[i].modulo_range)
            velocity = way / tables.cycle_time
            acceleration = (velocity - motion.velocity) / tables.cycle_time
        move_axis(motion, given.setpoint, velocity, tables.cycle_time, tables.axis[i].modulo_range)
        motion.acceleration = acceleration


def correct_axis(tables: Tables, pool: Vec, state: State, given: AxisInputs, out: AxisOutputs, i: int) -> None:
    """Correct one axis."""
    table = tables.axis[i]
    axis = state.axis[i]
    motion = state.motion.axis[i]
    if axis.shift.pending:
        release_shift(table.shift_cycles, axis.shift, motion.moving)

    correction = 0.0
    for k in range(table.kinds):
        kind = table.kind[k]
        contribution = correct_by(kind, tables, pool, state, given, out, i, correction)
        if kind < FRICTION:
            correction += contribution
    out.volumetric_correction = axis.volumetric_correction
    correction += out.volumetric_correction
    out.correction = correction
    out.setpoint_shift = axis.shift.before.now + axis.shift.behind.now + axis.volumetric_shift
    out.stop_request = axis.stop_request
    out.corrected_setpoint = motion.setpoint + (correction + out.setpoint_shift)
    out.display_position = given.actual_position - (correction + out.setpoint_shift)
    axis.started = True


def correct_by(
    kind: int, tables: Tables, pool: Vec, state: State, given: AxisInputs, out: AxisOutputs, i: int, correction: float
) -> float:
    """Return what a kind adds to axis i in this cycle, after ``correction``.

    What NO_MOVE absorbs of it goes into the shift. Without a table it adds what is left of the one it had.
    """
    table = tables.axis[i]
    axis = state.axis[i]
    switching = table.switching[kind]
    own = axis.switching[kind]
    value = 0.0
    if switching.configured:
        position = state.motion.axis[i].setpoint
        if has_inputs(kind):
            lost = renew(kind, table.compensation, axis.compensation, given.compensation, position)
            if axis.started:
                blend_in(switching, own, own.weight * lost)
        if kind == LEADSCREW:
            position = position + (correction + axis.shift.before.now)
        value = compensation_value(
            kind,
            pool,
            table.compensation,
            axis.compensation,
            given.compensation,
            state.motion,
            i,
            position,
            tables.cycle_time,
        )
    contribution = contribution_of(switching, own, value)
    if not axis.settled and kind < FRICTION:
        absorb_switch(axis.shift, kind < LEADSCREW, own.absorbed * value)
    out.contribution[kind] = contribution
    return contribution
