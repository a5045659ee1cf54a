"""Whether tables can be trusted: every offset lies in the pool, every index means an axis, every divisor is not 0.

The table compiler makes only such tables; tables that come from a file are looked at before they are used.
"""

from __future__ import annotations

from .compensations import KINDS, compensation_fits
from .friction import DELAY_LINE
from .motion import AXES
from .record import Vec
from .records import AxisTable, Tables
from .switching import CYCLES_MAX, switch_fits
from .volumetric_fit import volumetric_fits
from .volumetric_records import VOLUMETRICS


def tables_fit(tables: Tables, pool: Vec, numbers: int) -> bool:
    """Tell whether the tables can be used with a pool of so many numbers."""
    if not (tables.cycle_time > 0.0 and 0 <= tables.axis_count <= AXES):
        return False
    for i in range(tables.axis_count):
        if not axis_fits(tables.axis[i], pool, tables.axis_count, numbers):
            return False
    if not 0 <= tables.volumetrics <= VOLUMETRICS:
        return False
    for k in range(tables.volumetrics):
        if not volumetric_fits(pool, tables.volumetric[k], tables.axis_count, numbers):
            return False
    return True


def axis_fits(table: AxisTable, pool: Vec, axes: int, numbers: int) -> bool:
    """Tell whether the tables of one axis can be used; what is not configured is not looked at."""
    if not table.modulo_range >= 0.0 or not 1 <= table.shift_cycles <= CYCLES_MAX:
        return False
    if not (0 <= table.first <= numbers and 0 <= table.numbers <= numbers - table.first):
        return False
    if not 0 <= table.compensation.friction.delay < DELAY_LINE:  # there is a delay line in any case
        return False
    if not 0 <= table.kinds <= KINDS:
        return False
    for k in range(table.kinds):
        if not 0 <= table.kind[k] < KINDS:
            return False
    for kind in range(KINDS):
        if table.switching[kind].configured:
            if not switch_fits(table.switching[kind], axes):
                return False
            if not compensation_fits(kind, pool, table.compensation, axes, numbers):
                return False
    return True
