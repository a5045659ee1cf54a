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
from .motion import AxisMotion, Motion, move_axis
from .record import Vec
from .records import ERROR_INPUT, AxisInputs, AxisOutputs, AxisState, AxisTable, Inputs, Outputs, State, Tables
from .shift import absorb_switch, release_shift
from .switching import blend_in, contribution_of
from .volumetric import compensate_volume, report_tool_length


def cycle(tables: Tables, pool: Vec, state: State, inputs: Inputs, outputs: Outputs) -> None:
    """Run one cycle: the outputs belong to these inputs."""
    references_changed = False
    for i in range(tables.axis_count):
        own = state.axis[i]
        given = inputs.axis[i]
        accept(tables.axis[i].modulo_range, own, state.motion.axis[i], given, inputs.derive_motion, tables.cycle_time)
        if given.unreferenced != own.unreferenced:
            own.unreferenced = given.unreferenced
            references_changed = True
    if tables.volumetrics > 0:
        compensate_volume(tables, pool, state, inputs, outputs)
    for i in range(tables.axis_count):
        table = tables.axis[i]
        axis = state.axis[i]
        out = outputs.axis[i]
        if inputs.reset:
            axis.error = 0
        given = inputs.axis[i]
        motion = state.motion.axis[i]
        activate_if_stirred(table, axis, state, inputs, given, out, motion.moving, references_changed)
        if axis.held:
            out.error = ERROR_INPUT
        else:
            correct_axis(table, pool, axis, state.motion, motion, given, out, tables.cycle_time)
            out.error = axis.error
    if tables.volumetrics > 0:
        report_tool_length(tables, inputs, outputs)


def accept(
    modulo_range: float, axis: AxisState, motion: AxisMotion, given: AxisInputs, derive_motion: bool, cycle_time: float
) -> None:
    """Take an axis' inputs if they are finite; else the last good ones stay, and the axis is held for this cycle."""
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
        if derive_motion:
            way = nearest(given.setpoint - motion.setpoint, modulo_range)
            velocity = way / cycle_time
            acceleration = (velocity - motion.velocity) / cycle_time
        move_axis(motion, given.setpoint, velocity, cycle_time, modulo_range)
        motion.acceleration = acceleration


def correct_axis(
    table: AxisTable,
    pool: Vec,
    axis: AxisState,
    motions: Motion,
    motion: AxisMotion,
    given: AxisInputs,
    out: AxisOutputs,
    cycle_time: float,
) -> None:
    """Correct one axis, whose motion is among ``motions``."""
    if axis.shift.pending:
        release_shift(table.shift_cycles, axis.shift, motion.moving)

    correction = 0.0
    for k in range(table.kinds):
        kind = table.kind[k]
        contribution = correct_by(kind, table, pool, axis, motions, motion, given, out, correction, cycle_time)
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
    kind: int,
    table: AxisTable,
    pool: Vec,
    axis: AxisState,
    motions: Motion,
    motion: AxisMotion,
    given: AxisInputs,
    out: AxisOutputs,
    correction: float,
    cycle_time: float,
) -> float:
    """Return what a kind adds to an axis in this cycle, after ``correction``.

    What NO_MOVE absorbs of it goes into the shift. Without a table it adds what is left of the one it had.
    """
    switching = table.switching[kind]
    own = axis.switching[kind]
    value = 0.0
    if kind == LEADSCREW:
        axis.added = correction + axis.shift.before.now
    if switching.configured:
        if has_inputs(kind):
            lost = renew(kind, table.compensation, axis.compensation, given.compensation, motion.setpoint)
            if axis.started:
                blend_in(switching, own, own.weight * lost)
        value = compensation_value(
            kind,
            pool,
            table.compensation,
            axis.compensation,
            given.compensation,
            motions,
            motion,
            axis.added,
            cycle_time,
        )
    contribution = contribution_of(switching, own, value)
    if not axis.settled and kind < FRICTION:
        absorb_switch(axis.shift, kind < LEADSCREW, own.absorbed * value)
    out.contribution[kind] = contribution
    return contribution
