"""Which compensations of an axis are on: what must be referenced, and the commands of the enable inputs.

Leadscrew, backlash and temperature need their axis referenced, cross its master, plane both masters and the slave,
crosstalk the adaptation axes; friction needs nothing (semantics §5–§9, §12, §13).
"""

from __future__ import annotations

from .compensations import KINDS, is_renewed
from .records import AxisInputs, AxisState, AxisTable, Inputs
from .switching import SwitchTable, advance_switch, begin_switch, heed_command


def activate(table: AxisTable, axis: AxisState, inputs: Inputs, given: AxisInputs, moving: bool) -> None:
    """Advance the switches of all compensations of an axis by one cycle; the first cycle sets them.

    While the axis is held its switches stay where they are, but commands are heard: a reset is never missed.
    """
    released = inputs.reset or inputs.program_end or (given.released and not axis.released)
    axis.released = given.released
    for kind in range(KINDS):
        if table.switching[kind].configured:
            state = axis.switching[kind]
            ready = is_referenced(table.switching[kind], inputs)
            if not axis.started:
                is_renewed(kind, axis.compensation, given.compensation)
                begin_switch(table.switching[kind], state, given.enable[kind], ready, released)
            else:
                heed_command(table.switching[kind], state, given.enable[kind], released, given.no_move)
                if not axis.held:
                    state.renewed = is_renewed(kind, axis.compensation, given.compensation) or state.renewed
                    advance_switch(table.switching[kind], state, ready, moving)


def is_referenced(table: SwitchTable, inputs: Inputs) -> bool:
    """Tell whether the axes that a compensation needs have their reference."""
    for k in range(table.needs):
        if not inputs.axis[table.need[k]].referenced:
            return False
    return True
