"""An update of the tables while the machine runs: what is on stays on, with the new values from the next cycle on.

Only a volumetric compensation switches off, without motion; an automatic one then switches on again.
"""

from __future__ import annotations

from .records import (
    ERROR_CROSS_POINTS,
    ERROR_FRICTION_POINTS,
    ERROR_LEADSCREW_POINTS,
    ERROR_PLANE_POINTS,
    ERROR_UPDATE,
    AxisOutputs,
    AxisState,
    AxisTable,
    Lookup,
    Outputs,
    State,
    SwitchState,
    SwitchTable,
    Tables,
)
from .switching import ramp
from .volumetric_switching import adopt_volumetric


def update_error(before: AxisTable, after: AxisTable) -> int:
    """Return why an axis cannot take new tables, 0 if it can.

    Sizes that were reserved cannot change, and a compensation that was not there has no variables.
    """
    if before.number != after.number:
        return ERROR_UPDATE
    if appears(before.cross.switching, after.cross.switching) or appears(before.plane.switching, after.plane.switching):
        return ERROR_UPDATE
    if appears(before.crosstalk.switching, after.crosstalk.switching):
        return ERROR_UPDATE
    if appears(before.leadscrew.switching, after.leadscrew.switching):
        return ERROR_UPDATE
    if appears(before.friction.switching, after.friction.switching):
        return ERROR_UPDATE
    if after.leadscrew.switching.configured and before.leadscrew.max_points != after.leadscrew.max_points:
        return ERROR_LEADSCREW_POINTS
    if after.cross.switching.configured and before.cross.max_points != after.cross.max_points:
        return ERROR_CROSS_POINTS
    if after.plane.switching.configured and before.plane.max_points != after.plane.max_points:
        return ERROR_PLANE_POINTS
    if after.friction.switching.configured and before.friction.max_points != after.friction.max_points:
        return ERROR_FRICTION_POINTS
    return 0


def appears(before: SwitchTable, after: SwitchTable) -> bool:
    """Tell whether a compensation is configured that was not."""
    return after.configured and not before.configured


def adopt_volumetrics(before: Tables, after: Tables, state: State, outputs: Outputs) -> None:
    """Make the state of the volumetric compensations fit their new tables."""
    for k in range(before.volumetrics):
        adopt_volumetric(before.volumetric[k], after.volumetric[k], state.volumetric[k])
        outputs.volumetric[k].active = False


def adopt_axis(before: AxisTable, after: AxisTable, axis: AxisState, out: AxisOutputs) -> None:
    """Make the state of an axis fit its new tables (``update_error`` is 0); what no longer exists puts out 0."""
    adopt_switch(before.cross.switching, after.cross.switching, axis.cross.switching)
    adopt_switch(before.plane.switching, after.plane.switching, axis.plane.switching)
    adopt_switch(before.crosstalk.switching, after.crosstalk.switching, axis.crosstalk.switching)
    adopt_switch(before.leadscrew.switching, after.leadscrew.switching, axis.leadscrew.switching)
    adopt_switch(before.friction.switching, after.friction.switching, axis.friction.switching)
    forget(axis.cross.lookup)
    forget(axis.crosstalk.lookup)
    forget(axis.crosstalk.lookup2)
    forget(axis.leadscrew.lookup)
    forget(axis.friction.lookup)
    axis.leadscrew.reversal_step = 0 if axis.leadscrew.backward else after.leadscrew.reversal_cycles
    axis.shift.step = min(axis.shift.step, after.shift_cycles)
    axis.friction.since_reversal = min(axis.friction.since_reversal, after.friction.lookahead)

    if not after.cross.switching.configured:
        out.cross_correction = 0.0
        out.cross_active = False
    if not after.plane.switching.configured:
        out.plane_correction = 0.0
        out.plane_active = False
    if not after.crosstalk.switching.configured:
        out.crosstalk_correction = 0.0
        out.crosstalk_active = False
    if not after.leadscrew.switching.configured:
        out.leadscrew_correction = 0.0
        out.leadscrew_active = False
    if not after.friction.switching.configured:
        out.current = 0.0
        out.friction_active = False


def adopt_switch(before: SwitchTable, after: SwitchTable, state: SwitchState) -> None:
    """Keep a switch where it stands between off and on."""
    if not after.configured:
        state.step = 0
    elif state.step >= before.cycles and state.step > 0:
        state.step = after.cycles
    else:
        state.step = min(state.step, after.cycles)
    state.weight = ramp(state.step, after.cycles)
    state.absorbed = 0.0


def forget(lookup: Lookup) -> None:
    """Start the next search from the front: the new table may be shorter."""
    lookup.interval = 0
