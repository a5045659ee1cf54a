"""The errors of a machine at a position: interpolation over any number of axes (manual 003, 6.4).

On a grid: multilinear, the edge held outside. Scattered: Shepard's weights 1/distance², exact at the nodes. On a path:
at the foot of the perpendicular on the nearest section of a polyline, linear along it, the ends held; where the path
crosses itself the section that is followed counts.
"""

from __future__ import annotations

from typing import Annotated

from .interpolation import fold, nearest, within
from .record import Vec, zeros
from .volumetric_records import ERRORS, INTERPOLATE_GRID, INTERPOLATE_SCATTER, LETTERS, ErrorBlock, VolumetricTable

AT_NODE = 1e-30  # squared distance below which a position is a node
BESIDE = 1.0  # mm², squared distance from the section of a path that is followed, up to which it is never left


def errors_at(
    pool: Vec,
    table: VolumetricTable,
    position: Annotated[list[float], LETTERS],
    section: Annotated[list[int], ERRORS],
    errors: Annotated[list[float], ERRORS],
) -> None:
    """Put the errors at a position (mm, °) into ``errors``, which is 0 before.

    ``section``: for each block the section of its path that is followed, counted from 1; 0: not known yet.
    """
    for k in range(table.constants):
        errors[int(pool[table.constant + k])] = pool[table.constant + table.constants + k]
    x = zeros(LETTERS)
    for b in range(table.blocks):
        block = table.block[b]
        for d in range(block.arguments):
            x[d] = position[block.argument[d]]
            if block.period[d] > 0.0:
                x[d] = fold(x[d], block.start[d], block.period[d])
        if block.interpolation == INTERPOLATE_GRID and block.arguments == 1 and block.points[0] > 1:
            add_from_line(pool, block, x[0], errors)
        elif block.interpolation == INTERPOLATE_GRID:
            add_from_grid(pool, block, x, errors)
        elif block.interpolation == INTERPOLATE_SCATTER:
            add_from_scatter(pool, block, x, errors)
        else:
            section[b] = add_from_path(pool, block, x, section[b], errors)


def add_from_line(pool: Vec, block: ErrorBlock, x: float, errors: Annotated[list[float], ERRORS]) -> None:
    """Add what ``add_from_grid`` adds, for one argument: most tables have no more."""
    first = block.knots[0]
    u = within(x, pool[first], pool[first + block.points[0] - 1])
    i = find_cell(pool, block, 0, u)
    share = (u - pool[first + i]) / (pool[first + i + 1] - pool[first + i])
    near = block.values + i * block.errors
    far = near + block.errors
    for p in range(block.errors):
        errors[int(pool[block.error + p])] += (1.0 - share) * pool[near + p] + share * pool[far + p]


def add_from_grid(
    pool: Vec, block: ErrorBlock, x: Annotated[list[float], LETTERS], errors: Annotated[list[float], ERRORS]
) -> None:
    """Add multilinear values: each corner of the cell counts by the volume opposite to it."""
    share = zeros(LETTERS)  # of the upper neighbour along each argument
    stride = zeros(LETTERS)  # from the lower to the upper neighbour
    at = block.values
    step = block.errors
    for k in range(block.arguments):
        argument = block.arguments - 1 - k
        first = block.knots[argument]
        last = block.points[argument] - 1
        if last > 0:
            u = within(x[argument], pool[first], pool[first + last])
            i = find_cell(pool, block, argument, u)
            share[argument] = (u - pool[first + i]) / (pool[first + i + 1] - pool[first + i])
            stride[argument] = float(step)
            at += i * step
        step *= block.points[argument]
    for corner in range(1 << block.arguments):
        weight = 1.0
        node = at
        for d in range(block.arguments):
            if (corner >> d) & 1 == 1:
                weight *= share[d]
                node += int(stride[d])
            else:
                weight *= 1.0 - share[d]
        if weight != 0.0:
            add_node(pool, block, node, weight, errors)


def find_cell(pool: Vec, block: ErrorBlock, d: int, x: float) -> int:
    """Return i with knot[i] ≤ x < knot[i + 1] along argument d; the last knot belongs to the last cell.

    Equal steps along the argument know the last knot before them, so only a few knots are left to bisect.
    """
    first = block.knots[d]
    step = block.steps[d] + int((x - pool[first]) * block.steps_per_unit[d])
    low = int(pool[step])
    high = min(int(pool[step + 1]) + 1, block.points[d] - 1)
    while high - low > 1:
        middle = (low + high) >> 1
        if x < pool[first + middle]:
            high = middle
        else:
            low = middle
    return low


def add_node(pool: Vec, block: ErrorBlock, at: int, weight: float, errors: Annotated[list[float], ERRORS]) -> None:
    """Add the weighted values of the node whose values begin at ``at``."""
    for p in range(block.errors):
        errors[int(pool[block.error + p])] += weight * pool[at + p]


def add_from_scatter(
    pool: Vec, block: ErrorBlock, x: Annotated[list[float], LETTERS], errors: Annotated[list[float], ERRORS]
) -> None:
    """Add the mean of all nodes, weighted by 1/distance²; at a node its own values."""
    total = 0.0
    for n in range(block.nodes):
        square = square_distance(pool, block, n, x)
        if square <= AT_NODE:
            add_node(pool, block, block.values + n * block.errors, 1.0, errors)
            return
        total += 1.0 / square
    for n in range(block.nodes):
        weight = 1.0 / square_distance(pool, block, n, x) / total
        add_node(pool, block, block.values + n * block.errors, weight, errors)


def square_distance(pool: Vec, block: ErrorBlock, n: int, x: Annotated[list[float], LETTERS]) -> float:
    """Return the squared distance of a position from node n, round the circle where there is one."""
    square = 0.0
    for d in range(block.arguments):
        difference = nearest(x[d] - pool[block.knots[0] + n * block.arguments + d], block.period[d])
        square += difference * difference
    return square


def add_from_path(
    pool: Vec,
    block: ErrorBlock,
    x: Annotated[list[float], LETTERS],
    followed: int,
    errors: Annotated[list[float], ERRORS],
) -> int:
    """Add the values at the nearest point of the polyline, and return its section, counted from 1.

    Of sections as near the first one counts; one that is followed, and its neighbours, until another is much nearer.
    """
    section = 0
    share = 0.0
    shortest = -1.0
    own = 0
    own_share = 0.0
    own_shortest = -1.0
    for n in range(block.nodes - 1):
        s = share_along(pool, block, n, x)
        distance = square_from_section(pool, block, n, s, x)
        if shortest < 0.0 or distance < shortest:
            shortest = distance
            section = n
            share = s
        if followed > 0 and abs(n + 1 - followed) <= 1 and (own_shortest < 0.0 or distance < own_shortest):
            own_shortest = distance
            own = n
            own_share = s
    at_end = (own == 0 and own_share == 0.0) or (own == block.nodes - 2 and own_share == 1.0)
    if own_shortest >= 0.0 and not at_end and (own_shortest < BESIDE or own_shortest < 4.0 * shortest):
        section = own
        share = own_share
    at = block.values + section * block.errors
    add_node(pool, block, at, 1.0 - share, errors)
    if share > 0.0:
        add_node(pool, block, at + block.errors, share, errors)
    return section + 1


def share_along(pool: Vec, block: ErrorBlock, n: int, x: Annotated[list[float], LETTERS]) -> float:
    """Return where the point of a section that is nearest lies along it, 0 … 1."""
    start = block.knots[0] + n * block.arguments
    along = 0.0
    square = 0.0
    for d in range(block.arguments):
        direction = pool[start + block.arguments + d] - pool[start + d]
        along += (x[d] - pool[start + d]) * direction
        square += direction * direction
    if square > 0.0:
        return min(max(along / square, 0.0), 1.0)
    return 0.0


def square_from_section(pool: Vec, block: ErrorBlock, n: int, s: float, x: Annotated[list[float], LETTERS]) -> float:
    """Return the squared distance from the point at share s of a section."""
    start = block.knots[0] + n * block.arguments
    distance = 0.0
    for d in range(block.arguments):
        foot = pool[start + d] + s * (pool[start + block.arguments + d] - pool[start + d])
        distance += (x[d] - foot) * (x[d] - foot)
    return distance
