"""The errors of a machine at a position: interpolation over any number of axes (manual 003, 6.4).

On a grid: multilinear, the edge held outside. Scattered: Shepard's weights 1/distance², exact at the nodes. On a path:
at the foot of the perpendicular on the nearest section of a polyline, linear along it, the ends held; where the path
crosses itself the section that is followed counts.
"""

from __future__ import annotations

from typing import Annotated

from .interpolation import fold, nearest, within
from .record import Vec, zeros
from .volumetric_records import (
    BOXES,
    ERRORS,
    IN_BOX,
    INTERPOLATE_GRID,
    INTERPOLATE_SCATTER,
    LETTERS,
    TOGETHER,
    ErrorBlock,
    VolumetricTable,
)

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
    while high - low > 1:  # at most 32 times
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
    """Add the mean of all nodes, weighted by 1/distance²; at a node its own values.

    One pass, four nodes at a time: their weighted values are summed before they are added to the sum of those before.
    """
    total = 0.0
    sums = zeros(ERRORS)
    square = zeros(TOGETHER)
    weight = zeros(TOGETHER)
    last = block.nodes - 1
    for group in range(last // TOGETHER + 1):
        n = group * TOGETHER
        square_distances(pool, block, n, x, square)
        for k in range(TOGETHER):
            if square[k] <= AT_NODE:
                add_node(pool, block, block.values + min(n + k, last) * block.errors, 1.0, errors)
                return
        for k in range(TOGETHER):
            weight[k] = 1.0 / square[k]
        for k in range(last + 1 - n, TOGETHER):
            weight[k] = 0.0
        w0 = weight[0]
        w1 = weight[1]
        w2 = weight[2]
        w3 = weight[3]
        total += w0 + w1 + w2 + w3
        at0 = block.values + n * block.errors
        at1 = block.values + min(n + 1, last) * block.errors
        at2 = block.values + min(n + 2, last) * block.errors
        at3 = block.values + min(n + 3, last) * block.errors
        for p in range(block.errors):
            sums[p] += w0 * pool[at0 + p] + w1 * pool[at1 + p] + w2 * pool[at2 + p] + w3 * pool[at3 + p]
    for p in range(block.errors):
        errors[int(pool[block.error + p])] += sums[p] / total


def square_distances(
    pool: Vec, block: ErrorBlock, n: int, x: Annotated[list[float], LETTERS], square: Annotated[list[float], TOGETHER]
) -> None:
    """Put the squared distances of a position from node n and those behind it, round the circle where there is one."""
    at = block.knots[0] + n * block.arguments
    for k in range(TOGETHER):
        square[k] = 0.0
    for d in range(block.arguments):
        for k in range(TOGETHER):
            difference = x[d] - pool[at + k]
            if block.period[d] > 0.0:
                difference = nearest(difference, block.period[d])
            square[k] += difference * difference
        at += TOGETHER


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
    shortest = -1.0
    for n in range(max(followed - 2, 0), min(followed + 1, block.nodes - 1) if followed > 0 else 0):
        distance = square_from_section(pool, block, n, share_along(pool, block, n, x), x)
        if shortest < 0.0 or distance < shortest:
            shortest = distance
            section = n
    share = share_along(pool, block, section, x) if block.nodes > 1 else 0.0
    at_end = (section == 0 and share == 0.0) or (section == block.nodes - 2 and share == 1.0)
    if block.nodes > 1 and (shortest < 0.0 or at_end or shortest >= BESIDE):
        other = nearest_section(pool, block, x, section)
        share_there = share_along(pool, block, other, x)
        if shortest < 0.0 or at_end or shortest >= 4.0 * square_from_section(pool, block, other, share_there, x):
            section = other
            share = share_there
    at = block.values + section * block.errors
    add_node(pool, block, at, 1.0 - share, errors)
    if share > 0.0:
        add_node(pool, block, at + block.errors, share, errors)
    return section + 1


def nearest_section(pool: Vec, block: ErrorBlock, x: Annotated[list[float], LETTERS], near: int) -> int:
    """Return the section that is nearest, the first of those as near; ``near``: one to begin with.

    Boxes that are farther away than the nearest section so far are left out: at most 2 · points[0] boxes and all
    sections are looked at, mostly a few.
    """
    found = near
    shortest = square_from_section(pool, block, near, share_along(pool, block, near, x), x)
    waiting = zeros(BOXES)
    waiting[0] = 1.0
    count = 1
    while count > 0:
        count -= 1
        box = int(waiting[count])
        if square_from_box(pool, block, box, x) > shortest:
            continue
        if box < block.points[0]:
            # The nearer one is looked into first.
            first = 1 if square_from_box(pool, block, 2 * box, x) > square_from_box(pool, block, 2 * box + 1, x) else 0
            waiting[count] = float(2 * box + 1 - first)
            waiting[count + 1] = float(2 * box + first)
            count += 2
        else:
            begin = (box - block.points[0]) * IN_BOX
            for n in range(begin, min(begin + IN_BOX, block.nodes - 1)):
                distance = square_from_section(pool, block, n, share_along(pool, block, n, x), x)
                if distance < shortest or (distance == shortest and n < found):
                    shortest = distance
                    found = n
    return found


def square_from_box(pool: Vec, block: ErrorBlock, box: int, x: Annotated[list[float], LETTERS]) -> float:
    """Return the squared distance from a box, 0 within."""
    at = block.steps[0] + 2 * block.arguments * box
    distance = 0.0
    for d in range(block.arguments):
        below = max(pool[at + 2 * d] - x[d], 0.0)
        outside = max(x[d] - pool[at + 2 * d + 1], below)
        distance += outside * outside
    return distance


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
