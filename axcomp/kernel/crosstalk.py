"""Crosstalk compensation (kw.crosstalk): the slave is corrected while the master accelerates. Added.

With a the master's setpoint acceleration: a ≥ 0: C = C_acc · min(a/acceleration, 1); a < 0: C = C_dec ·
min(a/deceleration, 1). C_acc and C_dec may depend on the direction of the master and on the positions of one or two
adaptation axes. The old variant (manual 001) is a curve over a.
"""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import (
    Curve,
    Lookup,
    ascending,
    curve_fits,
    curve_value,
    find_interval,
    forget,
    lookup_fits,
    move_curve,
    range_fits,
    within,
)
from .motion import Argument, Motion, argument_fits, position_of
from .record import Vec

CROSSTALK_CURVE = 0  # manual 001: linear over the acceleration
CROSSTALK_CONSTANT = 1  # mode 1
CROSSTALK_LINE = 2  # mode 2
CROSSTALK_GRID = 3  # mode 3, tests on a full rectangular grid
CROSSTALK_TRIANGLES = 4  # mode 3, scattered tests

ON_EDGE = -1e-7  # barycentric coordinate of a point that rounding puts just outside a triangle, as flat as they come


@dataclass(slots=True)
class CrosstalkTable:
    """Correction of the slave while its master accelerates.

    ``values`` has four blocks of ``tests`` numbers: acceleration in positive and negative motion, deceleration in
    positive and negative motion. In the old variant ``curve`` is the correction over the signed acceleration.
    """

    variant: int  # one of the CROSSTALK_ constants
    master: int
    adaptation1: Argument
    adaptation2: Argument
    acceleration: float
    deceleration: float  # < 0
    velocity_dependent: bool
    curve: Curve
    tests: int
    values: int
    points1: int  # grid: abscissae of the first adaptation axis; values are [j][i] as in a plane
    points2: int
    x1: int  # abscissae of the first adaptation axis, or the tests' positions
    x2: int
    triangles: int  # scattered tests: three test numbers each
    triangle: int
    edges: int  # hull of the tests: two test numbers each
    edge: int


@dataclass(slots=True)
class CrosstalkState:
    """What the crosstalk compensation remembers."""

    lookup: Lookup
    lookup2: Lookup
    outside: bool  # the adaptation axes have left the hull of the tests


def crosstalk_value(pool: Vec, table: CrosstalkTable, state: CrosstalkState, motion: Motion) -> float:
    """Return the correction at full weight, from the master's motion and the adaptation axes' positions."""
    acceleration = motion.axis[table.master].acceleration
    if table.variant == CROSSTALK_CURVE:
        return curve_value(pool, table.curve, acceleration, state.lookup)

    block = 0
    share = acceleration / table.acceleration
    if acceleration < 0.0:
        block = 2
        share = acceleration / table.deceleration
    if table.velocity_dependent and motion.axis[table.master].direction < 0:
        block = block + 1
    position1 = position_of(motion, table.adaptation1)
    position2 = position_of(motion, table.adaptation2)
    value = test_value(pool, table, state, table.values + block * table.tests, position1, position2)
    return value * min(share, 1.0)


def test_value(
    pool: Vec, table: CrosstalkTable, state: CrosstalkState, values: int, position1: float, position2: float
) -> float:
    """Return one of the four corrections, interpolated between the tests; ``values``: where its block begins."""
    if table.variant == CROSSTALK_CONSTANT:
        return pool[values]
    if table.variant == CROSSTALK_LINE:
        return line_value(pool, table.x1, values, table.tests, position1, state.lookup)
    if table.variant == CROSSTALK_GRID:
        return grid_value(pool, table, state, values, position1, position2)
    return scattered_value(pool, table, state, values, position1, position2)


def line_value(pool: Vec, abscissae: int, values: int, points: int, x: float, lookup: Lookup) -> float:
    """Return the value linear between the points, the end values held outside."""
    x = within(x, pool[abscissae], pool[abscissae + points - 1])
    i = find_interval(pool, abscissae, points, x, lookup)
    x0 = pool[abscissae + i]
    s = (x - x0) / (pool[abscissae + i + 1] - x0)
    return pool[values + i] + s * (pool[values + i + 1] - pool[values + i])


def grid_value(pool: Vec, table: CrosstalkTable, state: CrosstalkState, values: int, x1: float, x2: float) -> float:
    """Return the value bilinear between tests on a grid, the edge held outside."""
    state.outside = state.outside or outside_grid(pool, table, x1, x2)
    x2 = within(x2, pool[table.x2], pool[table.x2 + table.points2 - 1])
    j = find_interval(pool, table.x2, table.points2, x2, state.lookup2)
    row = values + j * table.points1
    near = line_value(pool, table.x1, row, table.points1, x1, state.lookup)
    far = line_value(pool, table.x1, row + table.points1, table.points1, x1, state.lookup)
    y0 = pool[table.x2 + j]
    return near + (x2 - y0) / (pool[table.x2 + j + 1] - y0) * (far - near)


def outside_grid(pool: Vec, table: CrosstalkTable, x1: float, x2: float) -> bool:
    """Tell whether a point lies outside the grid of the tests."""
    if x1 < pool[table.x1] or x1 > pool[table.x1 + table.points1 - 1]:
        return True
    return x2 < pool[table.x2] or x2 > pool[table.x2 + table.points2 - 1]


def scattered_value(pool: Vec, table: CrosstalkTable, state: CrosstalkState, values: int, x: float, y: float) -> float:
    """Return the value linear in the triangle that holds (x, y), else at the nearest point of the hull."""
    for k in range(table.triangles):
        a = int(pool[table.triangle + 3 * k])
        b = int(pool[table.triangle + 3 * k + 1])
        c = int(pool[table.triangle + 3 * k + 2])
        bx = pool[table.x1 + b] - pool[table.x1 + a]
        by = pool[table.x2 + b] - pool[table.x2 + a]
        cx = pool[table.x1 + c] - pool[table.x1 + a]
        cy = pool[table.x2 + c] - pool[table.x2 + a]
        px = x - pool[table.x1 + a]
        py = y - pool[table.x2 + a]
        area = bx * cy - by * cx
        beta = (px * cy - py * cx) / area
        gamma = (bx * py - by * px) / area
        if beta >= ON_EDGE and gamma >= ON_EDGE and beta + gamma <= 1.0 - ON_EDGE:
            va = pool[values + a]
            return va + beta * (pool[values + b] - va) + gamma * (pool[values + c] - va)
    state.outside = True
    return hull_value(pool, table, values, x, y)


def hull_value(pool: Vec, table: CrosstalkTable, values: int, x: float, y: float) -> float:
    """Return the value at the point of the hull that is nearest to (x, y)."""
    value = 0.0
    shortest = -1.0
    for k in range(table.edges):
        a = int(pool[table.edge + 2 * k])
        b = int(pool[table.edge + 2 * k + 1])
        ex = pool[table.x1 + b] - pool[table.x1 + a]
        ey = pool[table.x2 + b] - pool[table.x2 + a]
        px = x - pool[table.x1 + a]
        py = y - pool[table.x2 + a]
        t = min(max((px * ex + py * ey) / (ex * ex + ey * ey), 0.0), 1.0)
        dx = px - t * ex
        dy = py - t * ey
        distance = dx * dx + dy * dy
        if shortest < 0.0 or distance < shortest:
            shortest = distance
            value = pool[values + a] + t * (pool[values + b] - pool[values + a])
    return value


def adopt_crosstalk(state: CrosstalkState) -> None:
    """Go on with another table."""
    forget(state.lookup)
    forget(state.lookup2)


def move_crosstalk(table: CrosstalkTable, by: int) -> None:
    """Follow the numbers of the table to another place in the pool."""
    move_curve(table.curve, by)
    table.values += by
    table.x1 += by
    table.x2 += by
    table.triangle += by
    table.edge += by


def crosstalk_fits(pool: Vec, table: CrosstalkTable, axes: int, numbers: int) -> bool:
    """Tell whether the table can be used."""
    if not 0 <= table.master < axes:
        return False
    if not (argument_fits(table.adaptation1, axes) and argument_fits(table.adaptation2, axes)):
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
        return test_grid_fits(pool, table, numbers)
    return table.variant != CROSSTALK_TRIANGLES or triangles_fit(pool, table, numbers)


def crosstalk_state_fits(table: CrosstalkTable, state: CrosstalkState) -> bool:
    """Tell whether the state belongs to such a table."""
    if table.variant == CROSSTALK_CURVE:
        return lookup_fits(state.lookup, table.curve.points)
    if table.variant == CROSSTALK_LINE:
        return lookup_fits(state.lookup, table.tests)
    if table.variant == CROSSTALK_GRID:
        return lookup_fits(state.lookup, table.points1) and lookup_fits(state.lookup2, table.points2)
    return True


def test_grid_fits(pool: Vec, table: CrosstalkTable, numbers: int) -> bool:
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
