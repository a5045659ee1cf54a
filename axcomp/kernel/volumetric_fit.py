"""Whether the tables of a volumetric compensation can be trusted (see ``fit``)."""

from __future__ import annotations

from .interpolation import LARGEST, ascending, period_fits, range_fits
from .record import Vec
from .volumetric_records import (
    A0,
    EA,
    ERRORS,
    ERRORS_OF_AXIS,
    EX,
    IN_BOX,
    INTERPOLATE_GRID,
    INTERPOLATE_PATH,
    INTERPOLATE_SCATTER,
    LETTERS,
    LINEAR,
    MEMBERS,
    TOGETHER,
    ErrorBlock,
    VolumetricState,
    VolumetricTable,
)

ALL_LINEAR = 7  # X, Y and Z as bits
ANGLE_LARGEST = 1e4  # rad; sums of two are still reduced


def volumetric_fits(pool: Vec, table: VolumetricTable, axes: int, numbers: int) -> bool:
    """Tell whether a volumetric compensation can be used; one that is not configured is not looked at."""
    if not table.configured:
        return True
    if table.cycles < 1 or not members_fit(table, axes) or not chain_fits(table):
        return False
    for d in range(LINEAR):
        if not (table.velocity[d] >= 0.0 and abs(table.tool_position[d]) < LARGEST):
            return False
    if table.constants > 0:
        if table.constants > ERRORS or not range_fits(table.constant, 2 * table.constants, numbers):
            return False
        if not counts(pool, table.constant, table.constants, ERRORS):
            return False
        for k in range(table.constants):
            if not error_fits(int(pool[table.constant + k]), pool[table.constant + table.constants + k]):
                return False
    if not 0 <= table.blocks <= ERRORS:
        return False
    for b in range(table.blocks):
        if not block_fits(pool, table.block[b], numbers):
            return False
    return True


def members_fit(table: VolumetricTable, axes: int) -> bool:
    """Tell whether members and letters mean axes."""
    if not 0 <= table.members <= MEMBERS:
        return False
    for m in range(table.members):
        if not (0 <= table.member[m] < axes and 0 <= table.member_letter[m] < LETTERS):
            return False
    for d in range(LETTERS):
        if not 0 <= table.axis[d] < axes:
            return False
        if not abs(table.offset[d]) < LARGEST:
            return False
    return True


def chain_fits(table: VolumetricTable) -> bool:
    """Tell whether the kinematic chain is X, Y, Z and some of A, B, C, each once, and the columns those of X, Y, Z."""
    if not (LINEAR <= table.chain_length <= LETTERS and 0 <= table.workpiece_axes <= table.chain_length):
        return False
    letters = 0
    for k in range(table.chain_length):
        if not 0 <= table.chain[k] < LETTERS or (letters >> table.chain[k]) & 1 == 1:
            return False
        letters += 1 << table.chain[k]
    columns = 0
    for d in range(LINEAR):
        if not 0 <= table.column[d] < LINEAR:
            return False
        columns += 1 << table.column[d]
    return letters & ALL_LINEAR == ALL_LINEAR and columns == ALL_LINEAR


def block_fits(pool: Vec, block: ErrorBlock, numbers: int) -> bool:
    """Tell whether errors over common nodes lie in the pool, with knots that ascend."""
    if not (1 <= block.errors <= ERRORS and 1 <= block.arguments <= LETTERS):
        return False
    if not (
        INTERPOLATE_GRID <= block.interpolation <= INTERPOLATE_PATH and 1 <= block.nodes <= numbers // block.errors
    ):
        return False
    if not (range_fits(block.error, block.errors, numbers) and counts(pool, block.error, block.errors, ERRORS)):
        return False
    if not range_fits(block.values, block.nodes * block.errors, numbers):
        return False
    for p in range(block.errors):
        for n in range(block.nodes):
            if not error_fits(int(pool[block.error + p]), pool[block.values + n * block.errors + p]):
                return False
    for d in range(block.arguments):
        if not (0 <= block.argument[d] < LETTERS and abs(block.start[d]) < LARGEST and period_fits(block.period[d])):
            return False
    if block.interpolation == INTERPOLATE_GRID:
        return knots_fit(pool, block, numbers)
    nodes = block.nodes
    if block.interpolation == INTERPOLATE_SCATTER:
        nodes = (nodes + TOGETHER - 1) // TOGETHER * TOGETHER
    if nodes > numbers // block.arguments:
        return False
    if not range_fits(block.knots[0], nodes * block.arguments, numbers):
        return False
    return block.interpolation != INTERPOLATE_PATH or boxes_fit(block, numbers)


def boxes_fit(block: ErrorBlock, numbers: int) -> bool:
    """Tell whether the boxes around the sections of a path lie in the pool, and hold all sections."""
    leaves = 1
    while leaves < (block.nodes + IN_BOX - 2) // IN_BOX:
        leaves += leaves
    if block.points[0] != leaves or leaves > numbers // (4 * block.arguments):
        return False
    return range_fits(block.steps[0], 4 * block.arguments * leaves, numbers)


def error_fits(number: int, value: float) -> bool:
    """Tell whether an error can be as large: a length that can be added to a position, an angle that can be reduced."""
    place = number % ERRORS_OF_AXIS
    if A0 <= place < EX or place >= EA:
        return abs(value) <= ANGLE_LARGEST
    return abs(value) < LARGEST


def volumetric_state_fits(table: VolumetricTable, state: VolumetricState) -> bool:
    """Tell whether the state belongs to such a compensation: the sections of its paths are there."""
    for b in range(ERRORS):
        if state.section[b] < 0 or (b < table.blocks and state.section[b] > table.block[b].nodes):
            return False
    return 0.0 <= state.progress <= 1.0 and 0.0 <= state.tool_progress <= 1.0


def knots_fit(pool: Vec, block: ErrorBlock, numbers: int) -> bool:
    """Tell whether the knots along each argument ascend, and make the nodes."""
    nodes = 1
    for d in range(block.arguments):
        points = block.points[d]
        if points < 1 or points > block.nodes // nodes or not ascending(pool, block.knots[d], points, numbers):
            return False
        nodes *= points
        if points > 1 and not steps_fit(pool, block, d, numbers):
            return False
    return nodes == block.nodes


def steps_fit(pool: Vec, block: ErrorBlock, d: int, numbers: int) -> bool:
    """Tell whether every equal step along an argument leads to one of its knots."""
    points = block.points[d]
    if not (range_fits(block.steps[d], points + 1, numbers) and counts(pool, block.steps[d], points + 1, points)):
        return False
    length = pool[block.knots[d] + points - 1] - pool[block.knots[d]]
    if not (block.steps_per_unit[d] >= 0.0 and length * block.steps_per_unit[d] < points):
        return False
    # The last cell begins a knot before the last one.
    return counts(pool, block.steps[d], int(length * block.steps_per_unit[d]) + 1, points - 1)


def counts(pool: Vec, first: int, count: int, limit: int) -> bool:
    """Tell whether so many numbers of the pool are at least 0 and below a limit."""
    for k in range(count):
        if not 0.0 <= pool[first + k] < limit:
            return False
    return True
