"""An update of the tables while the machine runs: what is on stays on, and the new values blend in (semantics §2).

Only a volumetric compensation switches off, without motion; an automatic one then switches on again.
"""

from __future__ import annotations

from .activation import is_referenced
from .compensations import KINDS, adopt_compensation, move_compensation, settled_value
from .record import Vec
from .records import ERROR_UPDATE, AxisInputs, AxisTable, Outputs, State, Tables
from .shift import adopt_shift
from .switching import SwitchState, SwitchTable, adopt_switch, blend_in
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


def adopt_axis(
    before: AxisTable, before_pool: Vec, after: AxisTable, after_pool: Vec, state: State, given: AxisInputs, i: int
) -> None:
    """Make the state of axis i fit its new tables (``update_error`` is 0); what was declared stays declared.

    Where the new tables say something else for the position where the axis is, the difference is blended in.
    """
    axis = state.axis[i]
    axis.settled = False
    keep_declared(before, after)
    for k in range(after.kinds):
        kind = after.kind[k]
        own = axis.switching[kind]
        switching = after.switching[kind]
        weight = own.weight
        value = 0.0
        if weight > 0.0:
            value = weight * settled_value(
                kind, before_pool, before.compensation, axis.compensation, state.motion, i, axis.added
            )
        adopt_switch(before.switching[kind], switching, own, given.wanted[kind])
        adopt_compensation(
            kind, before.compensation, after.compensation, axis.compensation, state.motion.axis[i], axis.added
        )
        if axis.started and switching.configured:
            if not before.switching[kind].configured and comes_on_at_once(switching, own, state):
                own.step = 1
                own.weight = 1.0
                weight = 1.0
            value -= weight * settled_value(
                kind, after_pool, after.compensation, axis.compensation, state.motion, i, axis.added
            )
        blend_in(switching, own, value)
    adopt_shift(before.shift_cycles, after.shift_cycles, axis.shift)


def comes_on_at_once(table: SwitchTable, own: SwitchState, state: State) -> bool:
    """Tell whether a table that comes will be on in one step, so that its values have to come in softly."""
    return table.cycles == 1 and own.step == 0 and own.granted and is_referenced(table, state)


def keep_declared(before: AxisTable, after: AxisTable) -> None:
    """Let what an axis activated at the start count for the next update too, and what was dropped go on running out."""
    after.kinds = before.kinds
    for kind in range(KINDS):
        after.kind[kind] = before.kind[kind]
        after.switching[kind].reserved = before.switching[kind].reserved
        after.switching[kind].points_error = before.switching[kind].points_error
        if not after.switching[kind].configured:
            after.switching[kind].blend_cycles = before.switching[kind].blend_cycles


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
