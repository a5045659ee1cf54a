"""Which compensations of an axis are on: what must be referenced, and the commands of the switches.

Leadscrew, backlash and temperature need their axis referenced, cross its master, plane both masters and the slave,
crosstalk the adaptation axes; friction needs nothing (semantics §5–§9, §12, §13).
"""

from __future__ import annotations

from .records import ERROR_SWITCH, AxisInputs, AxisOutputs, AxisState, AxisTable, Inputs, State
from .switching import SwitchTable, advance_switch, begin_switch, heed_command, is_command


def activate_if_stirred(
    table: AxisTable,
    axis: AxisState,
    state: State,
    inputs: Inputs,
    given: AxisInputs,
    out: AxisOutputs,
    moving: bool,
    references_changed: bool,
) -> None:
    """Advance the switches of an axis by one cycle, unless they have settled and nothing is commanded or has changed.

    Manual compensations go off by reset, program end, or the edge with which the axis is released.
    """
    released = inputs.reset or inputs.program_end or (given.released and not axis.released)
    axis.released = given.released
    stirred = released or references_changed or not axis.settled
    for k in range(table.kinds):
        kind = table.kind[k]
        if given.wanted[kind] != axis.switching[kind].wanted and table.switching[kind].configured:
            stirred = True
    if stirred:
        activate(table, axis, state, given, out, released, moving)


def activate(
    table: AxisTable, axis: AxisState, state: State, given: AxisInputs, out: AxisOutputs, released: bool, moving: bool
) -> None:
    """Advance the switches of all compensations of an axis by one cycle; the first cycle sets them.

    While the axis is held its switches stay where they are, but commands are heard: a reset is never missed.
    """
    axis.settled = axis.started and not axis.held
    for k in range(table.kinds):
        kind = table.kind[k]
        own = axis.switching[kind]
        if table.switching[kind].configured:
            ready = is_referenced(table.switching[kind], state)
            if given.wanted[kind] != own.wanted and not is_command(given.wanted[kind]):
                axis.error = ERROR_SWITCH
            if not axis.started:
                begin_switch(table.switching[kind], own, given.wanted[kind], ready, released)
            else:
                heed_command(table.switching[kind], own, given.wanted[kind], ready, released, given.no_move)
                if not axis.held:
                    settled = advance_switch(table.switching[kind], own, ready, moving)
                    axis.settled = axis.settled and settled
        elif not axis.started:
            own.wanted = given.wanted[kind]
        if not axis.held:
            out.active[kind] = own.step > 0


def is_referenced(table: SwitchTable, state: State) -> bool:
    """Tell whether the axes that a compensation needs have their reference."""
    for k in range(table.needs):
        if state.axis[table.need[k]].unreferenced:
            return False
    return True
