"""Crosstalk compensation (kw.crosstalk): the slave is corrected while the master accelerates. Added.

With a the master's setpoint acceleration: a ≥ 0: C = C_acc · min(a/acceleration, 1); a < 0: C = C_dec ·
min(a/deceleration, 1). C_acc and C_dec may depend on the direction of the master and on the positions of one or two
adaptation axes. The old variant (manual 001) is a curve over a.
"""

from __future__ import annotations

from .interpolation import curve_value, find_interval
from .record import Vec
from .records import CrosstalkState, CrosstalkTable, Lookup

CROSSTALK_CURVE = 0  # manual 001: linear over the acceleration
CROSSTALK_CONSTANT = 1  # mode 1
CROSSTALK_LINE = 2  # mode 2
CROSSTALK_GRID = 3  # mode 3, tests on a full rectangular grid
CROSSTALK_TRIANGLES = 4  # mode 3, scattered tests

ON_EDGE = -1e-7  # barycentric coordinate of a point that rounding puts just outside a triangle, as flat as they come


def crosstalk_value(
    pool: Vec,
    table: CrosstalkTable,
    state: CrosstalkState,
    acceleration: float,
    velocity: float,
    position1: float,
    position2: float,
) -> float:
    """Return the correction at full weight, from the master's motion and the adaptation axes' positions."""
    if velocity > 0.0:
        state.negative = False
    elif velocity < 0.0:
        state.negative = True
    if table.variant == CROSSTALK_CURVE:
        return curve_value(pool, table.curve, acceleration, state.lookup)

    block = 0
    share = acceleration / table.acceleration
    if acceleration < 0.0:
        block = 2
        share = acceleration / table.deceleration
    if table.velocity_dependent and state.negative:
        block = block + 1
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
    x = min(max(x, pool[abscissae]), pool[abscissae + points - 1])
    i = find_interval(pool, abscissae, points, x, lookup)
    x0 = pool[abscissae + i]
    s = (x - x0) / (pool[abscissae + i + 1] - x0)
    return pool[values + i] + s * (pool[values + i + 1] - pool[values + i])


def grid_value(pool: Vec, table: CrosstalkTable, state: CrosstalkState, values: int, x1: float, x2: float) -> float:
    """Return the value bilinear between tests on a grid, the edge held outside."""
    state.outside = state.outside or outside_grid(pool, table, x1, x2)
    x2 = min(max(x2, pool[table.x2]), pool[table.x2 + table.points2 - 1])
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
