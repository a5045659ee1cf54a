"""Which compensations of an axis are on: the conditions of each kind, and the commands of its enable input.

Leadscrew: the axis is referenced. Cross: its master is. Plane: both masters and the slave are. Crosstalk: the
adaptation axes are. Friction acts whether referenced or not (semantics §5–§9). A manual compensation is released with
its axis: it needs the axis' own reference too.
"""

from __future__ import annotations

from .crosstalk import CROSSTALK_GRID, CROSSTALK_LINE
from .records import AxisInputs, AxisState, AxisTable, Inputs, SwitchState, SwitchTable
from .switching import advance_switch, begin_switch, heed_command


def activate(table: AxisTable, axis: AxisState, inputs: Inputs, given: AxisInputs) -> None:
    """Advance the switches of all compensations of an axis by one cycle; the first cycle sets them.

    While the axis is held its switches stay where they are, but commands are heard: a reset is never missed.
    """
    released = inputs.reset or inputs.program_end
    if table.cross.switching.configured:
        ready = inputs.axis[table.cross.master].referenced
        advance(table.cross.switching, axis.cross.switching, axis, given, given.cross_enable, ready, released)
    if table.plane.switching.configured:
        ready = inputs.axis[table.plane.master1].referenced and inputs.axis[table.plane.master2].referenced
        ready = ready and given.referenced
        advance(table.plane.switching, axis.plane.switching, axis, given, given.plane_enable, ready, released)
    if table.crosstalk.switching.configured:
        ready = True
        if table.crosstalk.variant >= CROSSTALK_LINE:
            ready = inputs.axis[table.crosstalk.adaptation1].referenced
        if table.crosstalk.variant >= CROSSTALK_GRID:
            ready = ready and inputs.axis[table.crosstalk.adaptation2].referenced
        advance(
            table.crosstalk.switching, axis.crosstalk.switching, axis, given, given.crosstalk_enable, ready, released
        )
    if table.leadscrew.switching.configured:
        ready = given.referenced
        advance(
            table.leadscrew.switching, axis.leadscrew.switching, axis, given, given.leadscrew_enable, ready, released
        )
    if table.friction.switching.configured:
        advance(table.friction.switching, axis.friction.switching, axis, given, given.friction_enable, True, released)


def advance(
    table: SwitchTable,
    state: SwitchState,
    axis: AxisState,
    given: AxisInputs,
    enable: bool,
    ready: bool,
    released: bool,
) -> None:
    """Advance one switch by one cycle, or set it in the first."""
    usable = ready and (given.referenced or not table.manual)
    if not axis.started:
        begin_switch(table, state, enable, usable, released)
    elif axis.held:
        heed_command(table, state, enable, usable, released, given.no_move)
    else:
        heed_command(table, state, enable, usable, released, given.no_move)
        advance_switch(table, state, usable, axis.moving)
