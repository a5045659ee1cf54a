"""Whether tables can be trusted: every offset lies in the pool, every index means an axis, every divisor is not 0.

The table compiler makes only such tables; tables that come from a file are looked at before they are used.
"""

from __future__ import annotations

from .crosstalk import CROSSTALK_CURVE, CROSSTALK_GRID, CROSSTALK_LINE, CROSSTALK_TRIANGLES
from .interpolation import ascending, range_fits
from .record import Vec
from .records import (
    AXES,
    DELAY_LINE,
    AxisTable,
    CrossTable,
    CrosstalkTable,
    Curve,
    FrictionTable,
    LeadscrewTable,
    PlaneTable,
    SwitchTable,
    Tables,
)
from .volumetric_fit import volumetric_fits
from .volumetric_records import VOLUMETRICS

CYCLES_MAX = 20  # of a transition (P-COMP-00026, P-AXIS-00243)
LOOKAHEAD_MAX = 4  # P-COMP-00044


def tables_fit(tables: Tables, numbers: int) -> bool:
    """Tell whether the tables can be used with a pool of so many numbers."""
    if not (tables.cycle_time > 0.0 and 0 <= tables.axis_count <= AXES):
        return False
    for i in range(tables.axis_count):
        if not axis_fits(tables.axis[i].pool, tables.axis[i], tables.axis_count, numbers):
            return False
    if not 0 <= tables.volumetrics <= VOLUMETRICS:
        return False
    for k in range(tables.volumetrics):
        if not volumetric_fits(tables.pool, tables.volumetric[k], tables.axis_count, numbers):
            return False
    return True


def axis_fits(pool: Vec, table: AxisTable, axes: int, numbers: int) -> bool:
    """Tell whether the tables of one axis can be used; what is not configured is not looked at."""
    if table.modulo_range < 0.0 or not 1 <= table.shift_cycles <= CYCLES_MAX:
        return False
    if table.cross.switching.configured and not cross_fits(pool, table.cross, axes, numbers):
        return False
    if table.plane.switching.configured and not plane_fits(table.plane, axes, numbers):
        return False
    if table.crosstalk.switching.configured and not crosstalk_fits(pool, table.crosstalk, axes, numbers):
        return False
    if table.leadscrew.switching.configured:
        if table.leadscrew.modulo and table.modulo_range == 0.0:
            return False
        if not leadscrew_fits(pool, table.leadscrew, numbers):
            return False
    return not table.friction.switching.configured or friction_fits(pool, table.friction, numbers)


def cross_fits(pool: Vec, table: CrossTable, axes: int, numbers: int) -> bool:
    """Tell whether a cross compensation can be used."""
    return switch_fits(table.switching) and index_fits(table.master, axes) and curve_fits(pool, table.curve, numbers)


def plane_fits(table: PlaneTable, axes: int, numbers: int) -> bool:
    """Tell whether a plane compensation can be used."""
    if not (switch_fits(table.switching) and index_fits(table.master1, axes) and index_fits(table.master2, axes)):
        return False
    if not (table.interval1 > 0.0 and table.interval2 > 0.0 and table.points1 > 0 and table.points2 > 0):
        return False
    if (
        table.start1 - table.start1 != 0.0 or table.start2 - table.start2 != 0.0
    ):  # not finite: a cell would be any number
        return False
    if table.points1 > numbers // table.points2:
        return False
    return range_fits(table.values, table.points1 * table.points2, numbers)


def crosstalk_fits(pool: Vec, table: CrosstalkTable, axes: int, numbers: int) -> bool:
    """Tell whether a crosstalk compensation can be used."""
    if not (switch_fits(table.switching) and index_fits(table.master, axes)):
        return False
    if not (index_fits(table.adaptation1, axes) and index_fits(table.adaptation2, axes)):
        return False
    if table.variant == CROSSTALK_CURVE:
        return curve_fits(pool, table.curve, numbers)
    if not (CROSSTALK_CURVE < table.variant <= CROSSTALK_TRIANGLES and 1 <= table.tests <= numbers // 4):
        return False
    if not (table.acceleration > 0.0 and table.deceleration < 0.0):
        return False
    if not range_fits(table.values, 4 * table.tests, numbers):
        return False
    if table.variant == CROSSTALK_LINE:
        return table.tests > 1 and ascending(pool, table.x1, table.tests, numbers)
    if table.variant == CROSSTALK_GRID:
        return grid_fits(pool, table, numbers)
    return table.variant != CROSSTALK_TRIANGLES or triangles_fit(pool, table, numbers)


def grid_fits(pool: Vec, table: CrosstalkTable, numbers: int) -> bool:
    """Tell whether the grid of tests can be used."""
    if not (1 < table.points1 <= table.tests and 1 < table.points2 <= table.tests):
        return False
    if table.points2 != table.tests // table.points1 or table.tests % table.points1 != 0:
        return False
    return ascending(pool, table.x1, table.points1, numbers) and ascending(pool, table.x2, table.points2, numbers)


def triangles_fit(pool: Vec, table: CrosstalkTable, numbers: int) -> bool:
    """Tell whether the triangles and the hull of scattered tests can be used."""
    if not (range_fits(table.x1, table.tests, numbers) and range_fits(table.x2, table.tests, numbers)):
        return False
    if not (1 <= table.triangles <= numbers // 3 and 1 <= table.edges <= numbers // 2):
        return False
    if not range_fits(table.triangle, 3 * table.triangles, numbers):
        return False
    if not range_fits(table.edge, 2 * table.edges, numbers):
        return False
    for k in range(3 * table.triangles):
        if not 0.0 <= pool[table.triangle + k] < table.tests:
            return False
    for k in range(2 * table.edges):
        if not 0.0 <= pool[table.edge + k] < table.tests:
            return False
    return True


def leadscrew_fits(pool: Vec, table: LeadscrewTable, numbers: int) -> bool:
    """Tell whether a leadscrew compensation can be used."""
    if not (switch_fits(table.switching) and 1 <= table.reversal_cycles <= CYCLES_MAX):
        return False
    if not curve_fits(pool, table.positive, numbers):
        return False
    return not table.bilateral or curve_fits(pool, table.negative, numbers)


def friction_fits(pool: Vec, table: FrictionTable, numbers: int) -> bool:
    """Tell whether a friction compensation can be used."""
    if not (switch_fits(table.switching) and curve_fits(pool, table.curve, numbers)):
        return False
    return 0 <= table.delay < DELAY_LINE and 0 <= table.lookahead <= LOOKAHEAD_MAX and table.position_delay >= 0.0


def switch_fits(table: SwitchTable) -> bool:
    """Tell whether a transition has a possible length."""
    return 1 <= table.cycles <= CYCLES_MAX


def curve_fits(pool: Vec, curve: Curve, numbers: int) -> bool:
    """Tell whether a curve lies in the pool and its abscissae ascend."""
    return ascending(pool, curve.x, curve.points, numbers) and range_fits(curve.y, curve.points, numbers)


def index_fits(index: int, axes: int) -> bool:
    """Tell whether an index means an axis."""
    return 0 <= index < axes
