"""One cycle of the whole engine (semantics §3).

For every axis: cross, plane and crosstalk, each from the masters' raw setpoints; the leadscrew from raw + these; the
volumetric compensations from the raw setpoints of all their axes; then corrected setpoint = raw + all corrections +
shift; the friction current from the setpoint velocity; the display position = measured position − (corrected − raw).
"""

from __future__ import annotations

from .activation import activate
from .cross import cross_value
from .crosstalk import crosstalk_value
from .friction import friction_current
from .leadscrew import begin_leadscrew, leadscrew_value
from .plane import plane_value
from .record import Vec
from .records import ERROR_INPUT, AxisInputs, AxisOutputs, AxisState, AxisTable, Inputs, Outputs, State, Tables
from .shift import absorb_before_leadscrew, absorb_leadscrew, release_shift
from .volumetric import compensate_volume

LARGEST = 1e15  # an input beyond this is taken for infinite: sums with it could overflow


def cycle(tables: Tables, state: State, inputs: Inputs, outputs: Outputs) -> None:
    """Run one cycle: the outputs belong to these inputs."""
    for i in range(tables.axis_count):
        accept(state.axis[i], inputs.axis[i])
    if tables.volumetrics > 0:
        compensate_volume(tables, state, inputs, outputs)
    for i in range(tables.axis_count):
        axis = state.axis[i]
        if inputs.reset:
            axis.error = 0
        activate(tables.axis[i], axis, inputs, inputs.axis[i])
        if axis.held:
            outputs.axis[i].error = ERROR_INPUT
        else:
            correct_axis(tables, state, inputs, outputs.axis[i], i)
            outputs.axis[i].error = axis.error


def accept(axis: AxisState, given: AxisInputs) -> None:
    """Take an axis' inputs if they are finite; else the last good ones stay, and the axis is held for this cycle."""
    axis.held = not (
        -LARGEST < given.setpoint < LARGEST
        and -LARGEST < given.velocity < LARGEST
        and -LARGEST < given.acceleration < LARGEST
        and -LARGEST < given.actual_position < LARGEST
    )
    if not axis.held:
        axis.moving = axis.started and (given.setpoint != axis.setpoint or given.velocity != 0.0)
        axis.setpoint = given.setpoint
        axis.velocity = given.velocity
        axis.acceleration = given.acceleration


def correct_axis(tables: Tables, state: State, inputs: Inputs, out: AxisOutputs, i: int) -> None:
    """Correct one axis."""
    table = tables.axis[i]
    axis = state.axis[i]
    given = inputs.axis[i]
    release_shift(table, axis.shift, axis.moving)

    if table.cross.switching.configured:
        correct_by_cross(table.pool, table, axis, state.axis[table.cross.master], out)
    if table.plane.switching.configured:
        correct_by_plane(table.pool, table, axis, state, out)
    if table.crosstalk.switching.configured:
        correct_by_crosstalk(table.pool, table, axis, state, out)
    correction = out.cross_correction + out.plane_correction + out.crosstalk_correction
    if table.leadscrew.switching.configured:
        position = axis.setpoint
        if not table.leadscrew.without_other:
            position += correction + axis.shift.before_leadscrew
        if not axis.started:
            begin_leadscrew(table.leadscrew, axis.leadscrew, position)
        correct_by_leadscrew(table.pool, table, axis, position, out)
        correction += out.leadscrew_correction
    out.volumetric_correction = axis.volumetric_correction
    correction += out.volumetric_correction

    out.correction = correction
    out.setpoint_shift = axis.shift.before_leadscrew + axis.shift.leadscrew + axis.volumetric_shift
    out.stop_request = axis.stop_request
    out.corrected_setpoint = axis.setpoint + (correction + out.setpoint_shift)
    out.display_position = given.actual_position - (correction + out.setpoint_shift)
    if table.friction.switching.configured:
        add_friction_current(tables, table, axis, out)
    axis.started = True


def correct_by_cross(pool: Vec, table: AxisTable, axis: AxisState, master: AxisState, out: AxisOutputs) -> None:
    """Cross compensation of the slave ``axis``."""
    value = cross_value(pool, table.cross, axis.cross, master.setpoint)
    out.cross_correction = axis.cross.switching.weight * value
    out.cross_active = axis.cross.switching.step > 0
    absorb_before_leadscrew(axis.shift, axis.cross.switching.absorbed * value)


def correct_by_plane(pool: Vec, table: AxisTable, axis: AxisState, state: State, out: AxisOutputs) -> None:
    """Plane compensation of the slave ``axis``."""
    master1 = state.axis[table.plane.master1].setpoint
    master2 = state.axis[table.plane.master2].setpoint
    value = plane_value(pool, table.plane, master1, master2)
    out.plane_correction = axis.plane.switching.weight * value
    out.plane_active = axis.plane.switching.step > 0
    absorb_before_leadscrew(axis.shift, axis.plane.switching.absorbed * value)


def correct_by_crosstalk(pool: Vec, table: AxisTable, axis: AxisState, state: State, out: AxisOutputs) -> None:
    """Crosstalk compensation of the slave ``axis``."""
    master = state.axis[table.crosstalk.master]
    position1 = state.axis[table.crosstalk.adaptation1].setpoint
    position2 = state.axis[table.crosstalk.adaptation2].setpoint
    value = crosstalk_value(
        pool, table.crosstalk, axis.crosstalk, master.acceleration, master.velocity, position1, position2
    )
    out.crosstalk_correction = axis.crosstalk.switching.weight * value
    out.crosstalk_active = axis.crosstalk.switching.step > 0
    absorb_before_leadscrew(axis.shift, axis.crosstalk.switching.absorbed * value)


def correct_by_leadscrew(pool: Vec, table: AxisTable, axis: AxisState, position: float, out: AxisOutputs) -> None:
    """Leadscrew error compensation at an input position."""
    value = leadscrew_value(pool, table.leadscrew, axis.leadscrew, position, table.modulo_range)
    out.leadscrew_correction = axis.leadscrew.switching.weight * value
    out.leadscrew_active = axis.leadscrew.switching.step > 0
    absorb_leadscrew(axis.shift, axis.leadscrew.switching.absorbed * value)


def add_friction_current(tables: Tables, table: AxisTable, axis: AxisState, out: AxisOutputs) -> None:
    """Friction compensation."""
    current = friction_current(
        table.pool,
        table.friction,
        axis.friction,
        axis.setpoint,
        axis.velocity,
        axis.acceleration,
        tables.cycle_time,
        table.modulo_range,
    )
    out.current = axis.friction.switching.weight * current
    out.friction_active = axis.friction.switching.step > 0
