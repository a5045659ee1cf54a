"""An update of the tables while the machine runs: what is on stays on, and the new values blend in (semantics §2).

Only a volumetric compensation switches off, without motion; an automatic one then switches on again.
"""

from __future__ import annotations

from .compensations import KINDS, adopt_compensation, adopt_inputs, move_compensation
from .records import ERROR_UPDATE, AxisInputs, AxisState, AxisTable, Outputs, State, Tables
from .switching import adopt_switch
from .volumetric_switching import adopt_volumetric


def update_error(before: AxisTable, after: AxisTable) -> int:
    """Return why an axis cannot take new tables, 0 if it can.

    ``before`` says what was declared at the start: a compensation that the axis did not activate has no variables, and
    the room that was reserved for a table cannot change.
    """
    if before.number != after.number:
        return ERROR_UPDATE
    for kind in range(KINDS):
        if after.switching[kind].configured and before.switching[kind].reserved == 0:
            return ERROR_UPDATE
    for kind in range(KINDS):
        declared = before.switching[kind].reserved
        reserved = after.switching[kind].reserved
        if declared != reserved and declared > 0 and reserved > 0 and before.switching[kind].points_error != 0:
            return before.switching[kind].points_error
    return 0


def adopt_axis(before: AxisTable, after: AxisTable, axis: AxisState, given: AxisInputs) -> None:
    """Make the state of an axis fit its new tables (``update_error`` is 0); what was declared stays declared."""
    for kind in range(KINDS):
        adopt_switch(before.switching[kind], after.switching[kind], axis.switching[kind])
        adopt_compensation(kind, before.compensation, after.compensation, axis.compensation)
        if not after.switching[kind].configured:
            after.switching[kind].blend_cycles = before.switching[kind].blend_cycles
    keep_declared(before, after)
    adopt_inputs(before.compensation, after.compensation, given.compensation)
    axis.shift.step = min(axis.shift.step, after.shift_cycles)


def keep_declared(before: AxisTable, after: AxisTable) -> None:
    """Let what an axis activated at the start count for the next update too."""
    for kind in range(KINDS):
        after.switching[kind].reserved = before.switching[kind].reserved
        after.switching[kind].points_error = before.switching[kind].points_error


def adopt_volumetrics(before: Tables, after: Tables, state: State, outputs: Outputs) -> None:
    """Make the state of the volumetric compensations fit their new tables."""
    after.volumetrics = max(before.volumetrics, after.volumetrics)
    for k in range(after.volumetrics):
        adopt_volumetric(before.volumetric[k], after.volumetric[k], state.volumetric[k])
        outputs.volumetric[k].active = False


def move_axis_table(table: AxisTable, first: int) -> None:
    """Follow the numbers of an axis to another place in the pool, where they begin at ``first``."""
    by = first - table.first
    table.first = first
    for kind in range(KINDS):
        move_compensation(kind, table.compensation, by)
