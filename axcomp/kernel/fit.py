"""Whether tables and states can be trusted: every offset lies in the pool, every index means an axis or a point.

The table compiler makes only such tables, the kernel only such states; those that come from a file are looked at before
they are used. Whatever passes leads no cycle out of its memory, and no number to a conversion that it cannot bear.
"""

from __future__ import annotations

from .compensations import KINDS, compensation_absent, compensation_fits, compensation_state_fits
from .friction import DELAY_LINE
from .interpolation import LARGEST, period_fits
from .motion import AXES, motion_fits
from .record import Vec, decided, sound
from .records import AxisState, AxisTable, Inputs, Outputs, State, Tables
from .shift import shift_state_fits
from .switching import CYCLES_MAX, switch_fits, switch_state_fits
from .volumetric_fit import volumetric_fits, volumetric_state_fits
from .volumetric_records import VOLUMETRICS


def tables_fit(tables: Tables, pool: Vec, numbers: int) -> bool:
    """Tell whether the tables can be used with a pool of so many numbers."""
    if not (tables.cycle_time > 0.0 and 0 <= tables.axis_count <= AXES):
        return False
    for k in range(numbers):
        if not abs(pool[k]) < LARGEST:
            return False
    for i in range(tables.axis_count):
        if not sound(tables.axis[i]) or not axis_fits(tables.axis[i], pool, tables.axis_count, numbers):
            return False
    if not 0 <= tables.volumetrics <= VOLUMETRICS:
        return False
    for k in range(tables.volumetrics):
        if not sound(tables.volumetric[k]) or not volumetric_fits(
            pool, tables.volumetric[k], tables.axis_count, numbers
        ):
            return False
    return True


def axis_fits(table: AxisTable, pool: Vec, axes: int, numbers: int) -> bool:
    """Tell whether the tables of one axis can be used; what is not configured is not looked at."""
    if not period_fits(table.modulo_range) or not 1 <= table.shift_cycles <= CYCLES_MAX:
        return False
    if not (0 <= table.first <= numbers and 0 <= table.numbers <= numbers - table.first):
        return False
    if not 0 <= table.compensation.friction.delay < DELAY_LINE:  # there is a delay line in any case
        return False
    if not 0 <= table.kinds <= KINDS:
        return False
    for k in range(table.kinds):
        if not 0 <= table.kind[k] < KINDS or (k > 0 and table.kind[k] <= table.kind[k - 1]):
            return False
    for kind in range(KINDS):
        if not switch_fits(table.switching[kind], axes):
            return False
        if table.switching[kind].configured:
            if not compensation_fits(kind, pool, table.compensation, axes, numbers):
                return False
        elif not compensation_absent(kind, table.compensation):
            return False
    return True


def state_fits(tables: Tables, state: State) -> bool:
    """Tell whether a state is one of these tables."""
    if state.tool_length - state.tool_length != 0.0:
        return False
    for i in range(tables.axis_count):
        if not (sound(state.axis[i]) and sound(state.motion.axis[i]) and motion_fits(state.motion.axis[i])):
            return False
        if not axis_state_fits(tables.axis[i], state.axis[i]):
            return False
    for k in range(tables.volumetrics):
        if not (sound(state.volumetric[k]) and volumetric_state_fits(tables.volumetric[k], state.volumetric[k])):
            return False
    return True


def axis_state_fits(table: AxisTable, state: AxisState) -> bool:
    """Tell whether the state of an axis belongs to its tables; what is not configured remembers nothing."""
    for kind in range(KINDS):
        if not switch_state_fits(table.switching[kind], state.switching[kind]):
            return False
        if not compensation_state_fits(kind, table.compensation, state.compensation):
            return False
    return shift_state_fits(table.shift_cycles, state.shift)


def given_fits(tables: Tables, inputs: Inputs, outputs: Outputs) -> bool:
    """Tell whether inputs and outputs can be used: numbers may be anything, Booleans are 0 or 1."""
    if not decided(inputs):
        return False
    for i in range(tables.axis_count):
        if not (decided(inputs.axis[i]) and decided(outputs.axis[i])):
            return False
    for k in range(tables.volumetrics):
        if not (decided(inputs.volumetric[k]) and decided(outputs.volumetric[k])):
            return False
    return True
