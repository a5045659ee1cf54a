"""An update of the tables while the machine runs: what is on stays on, with the new values from the next cycle on."""

from __future__ import annotations

from .records import AxisOutputs, AxisState, AxisTable, Lookup, Outputs, State, SwitchState, SwitchTable, Tables
from .switching import ramp


def adopt(old: Tables, new: Tables, state: State, outputs: Outputs) -> None:
    """Make the state fit the new tables; both have the same axes."""
    for i in range(new.axis_count):
        adopt_axis(old.axis[i], new.axis[i], state.axis[i], outputs.axis[i])


def adopt_axis(old: AxisTable, new: AxisTable, axis: AxisState, out: AxisOutputs) -> None:
    """Make the state of one axis fit its new tables; outputs that no longer exist become 0."""
    adopt_switch(old.cross.switch, new.cross.switch, axis.cross.switch)
    adopt_switch(old.plane.switch, new.plane.switch, axis.plane.switch)
    adopt_switch(old.crosstalk.switch, new.crosstalk.switch, axis.crosstalk.switch)
    adopt_switch(old.leadscrew.switch, new.leadscrew.switch, axis.leadscrew.switch)
    adopt_switch(old.friction.switch, new.friction.switch, axis.friction.switch)
    forget(axis.cross.lookup)
    forget(axis.crosstalk.lookup)
    forget(axis.crosstalk.lookup2)
    forget(axis.leadscrew.lookup)
    forget(axis.friction.lookup)
    axis.leadscrew.reversal_step = 0 if axis.leadscrew.backward else new.leadscrew.reversal_cycles
    axis.shift.step = min(axis.shift.step, new.shift_cycles)
    axis.friction.since_reversal = min(axis.friction.since_reversal, new.friction.lookahead)

    out.cross_correction = 0.0
    out.plane_correction = 0.0
    out.crosstalk_correction = 0.0
    out.leadscrew_correction = 0.0
    out.current = 0.0
    out.cross_active = False
    out.plane_active = False
    out.crosstalk_active = False
    out.leadscrew_active = False
    out.friction_active = False


def adopt_switch(old: SwitchTable, new: SwitchTable, state: SwitchState) -> None:
    """Keep a switch where it stands between off and on."""
    if not new.configured:
        state.step = 0
    elif state.step >= old.cycles and state.step > 0:
        state.step = new.cycles
    else:
        state.step = min(state.step, new.cycles)
    state.weight = ramp(state.step, new.cycles)
    state.absorbed = 0.0


def forget(lookup: Lookup) -> None:
    """Start the next search from the front: the new table may be shorter."""
    lookup.interval = 0
