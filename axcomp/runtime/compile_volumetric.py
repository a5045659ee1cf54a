"""Volumetric → the kernel's tables: errors over the same nodes share a block, so that one search serves them all."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from ..kernel import (
    IN_BOX,
    INTERPOLATE_GRID,
    INTERPOLATE_PATH,
    INTERPOLATE_SCATTER,
    TOGETHER,
    ErrorBlock,
    Tables,
    Vec,
    VolumetricTable,
    zero,
)
from ..kinds import CompileError, append
from ..model import (
    COMPENSATIONS_MAX,
    ERRORS,
    FULL_TURN,
    LENGTH_MAX,
    LETTERS,
    LINEAR,
    ROTARY,
    UNIT_TOLERANCE,
    ErrorTable,
    Interpolation,
    Machine,
    Volumetric,
    is_angle,
    is_grid,
    largest,
    turn_of,
)

CYCLES_MAX = 2**31 - 1  # of a switch; at 1 ms more than three weeks
ROUNDING = 1e-6  # mm, more than rounding makes of any length
SHORTEST = 1e-9  # mm or °; along less than this, searching is left to the bisection

_INTERPOLATIONS = {
    Interpolation.GRID: INTERPOLATE_GRID,
    Interpolation.SCATTER: INTERPOLATE_SCATTER,
    Interpolation.PATH: INTERPOLATE_PATH,
    Interpolation.PATH_XY: INTERPOLATE_PATH,
}


def compile_volumetric(machine: Machine, tables: Tables, pool: Vec) -> None:
    """Fill the volumetric tables of a machine.

    Raises
    ------
    CompileError
        If an axis is missing, the chain is none, nodes are no grid or twice the same, or a number is out of range.
    """
    indices = [volumetric.index for volumetric in machine.volumetric]
    if len(set(indices)) < len(indices) or not set(indices) <= set(range(COMPENSATIONS_MAX)):
        raise CompileError(
            f"volumetric compensations have different numbers 0 … {COMPENSATIONS_MAX - 1}, not {indices}"
        )
    tables.volumetrics = max(indices, default=-1) + 1
    tables.volumetric = [zero(VolumetricTable) for _ in range(tables.volumetrics)]
    for volumetric in machine.volumetric:
        _Compiler(machine, volumetric, tables.volumetric[volumetric.index], pool, tables.cycle_time).compile()


def _knots_before(knots: Sequence[float], steps_per_unit: float) -> list[float]:
    """Return for each equal step along the knots the last knot that is in an earlier step, 0 if there is none."""
    before: list[float] = []
    for i, knot in enumerate(knots):
        # The same operations as in the kernel: rounding then never puts a position and its knot in a wrong order.
        step = int((knot - knots[0]) * steps_per_unit)
        before += [max(i - 1.0, 0.0)] * (step + 1 - len(before))
    before += [len(knots) - 1.0] * (len(knots) + 1 - len(before))
    return before


def _boxes_of(nodes: Sequence[Sequence[float]]) -> tuple[int, list[float]]:
    """Return how many boxes around ``IN_BOX`` sections a path has, and all its boxes as the kernel wants them."""
    pieces = [nodes[n : n + IN_BOX + 1] for n in range(0, max(len(nodes) - 1, 1), IN_BOX)]
    leaves = 1 << (len(pieces) - 1).bit_length()
    pieces += pieces[-1:] * (leaves - len(pieces))
    # A little wider than the sections: rounding never puts one outside its box.
    level = [[(min(x) - ROUNDING, max(x) + ROUNDING) for x in zip(*piece, strict=True)] for piece in pieces]
    levels = [level]
    while len(level) > 1:
        pairs = zip(level[::2], level[1::2], strict=True)
        level = [[(min(a[0], b[0]), max(a[1], b[1])) for a, b in zip(*pair, strict=True)] for pair in pairs]
        levels.append(level)
    unused = [0.0] * (2 * len(nodes[0]))
    return leaves, unused + [x for level in reversed(levels) for box in level for side in box for x in side]


def _neighbours(nodes: Sequence[tuple[float, ...]], d: int) -> list[tuple[int, int, float]]:
    """Return the pairs of nodes that follow each other along argument d, with their distance."""
    # Nodes that differ in this argument only are neighbours when it is sorted last.
    rows = sorted(((*node[:d], *node[d + 1 :]), node[d], i) for i, node in enumerate(nodes))
    return [(i, j, b - a) for (row, a, i), (other, b, j) in pairwise(rows) if row == other]


class _Compiler:
    """Fills the tables of one compensation."""

    def __init__(
        self, machine: Machine, volumetric: Volumetric, table: VolumetricTable, pool: Vec, cycle_time: float
    ) -> None:
        self.machine = machine
        self.volumetric = volumetric
        self.table = table
        self.pool = pool
        self.cycle_time = cycle_time
        # Errors of one block share their nodes.
        self._checked: set[tuple[int, str, Interpolation]] = set()
        self._pairs: dict[tuple[int, int], list[tuple[int, int, float]]] = {}

    def compile(self) -> None:
        volumetric, table = self.volumetric, self.table
        self._require(volumetric.filter_steps >= 0, "filter_steps is not negative")
        table.configured = True
        table.manual = volumetric.manual_activation
        table.associated = volumetric.associate_to_channel
        table.cycles = min(max(1, volumetric.filter_steps), CYCLES_MAX)
        self._axes()
        self._model(table)
        for d, letter in enumerate(LINEAR):
            sign = -1.0 if letter in volumetric.negate else 1.0
            table.sign[d] = 0.0 if letter in volumetric.set_to_zero else sign
        self._errors()

    def _axes(self) -> None:
        """Assign machine axes to letters; gantry slaves follow their masters."""
        volumetric, table = self.volumetric, self.table
        chain, assigned = volumetric.chain, [letter for letter, _ in volumetric.axes]
        self._require(
            len(set(chain)) == len(chain) and set(LINEAR) <= set(chain) <= set(LETTERS),
            f"the chain is X, Y, Z and some of A, B, C, each once, not {chain}",
        )
        self._require(set(chain) <= set(assigned), f"an axis of the chain {chain} is not assigned")
        self._require(set(assigned) <= set(LETTERS), "axes are called X, Y, Z, A, B, C")
        self._require(0 <= volumetric.workpiece_axes <= len(chain), "workpiece_axes is larger than the chain")
        numbers = [number for _, number in volumetric.axes]
        self._require(len(set(numbers)) == len(numbers), "an axis is assigned twice")
        table.chain_length = len(chain)
        table.chain[: len(chain)] = [LETTERS.index(letter) for letter in chain]
        table.workpiece_axes = volumetric.workpiece_axes
        from_tool = [letter for letter in reversed(chain) if letter in LINEAR]
        table.column[:] = [from_tool.index(letter) for letter in LINEAR]
        for letter, number in volumetric.axes:
            try:
                table.axis[LETTERS.index(letter)] = self.machine.index_of(number)
            except KeyError:
                raise CompileError(f"{self._name()}: its axis {letter} = {number} does not exist") from None
        for m, (place, letter) in enumerate(self.machine.members(volumetric).items()):
            table.member[m] = place
            table.member_letter[m] = LETTERS.index(letter)
            table.member_limit[m] = self.machine.axes[place].volumetric_limit or 0.0
            table.members = m + 1
            velocity = self.machine.axes[place].volumetric_velocity
            if velocity is not None and letter in LINEAR:
                self._require(velocity > 0.0, "v_limit is above 0")
                allowed, d = velocity * self.cycle_time, LINEAR.index(letter)
                table.velocity[d] = min(allowed, table.velocity[d] or allowed)

    def _model(self, table: VolumetricTable) -> None:
        volumetric = self.volumetric
        table.alternative = volumetric.alternative_model
        table.tool_position[:] = self._lengths(volumetric.tool_position)
        if any(volumetric.tool_orientation):
            table.tool_orientation[:] = self._unit(volumetric.tool_orientation)
        table.center[:] = self._lengths([x for center in volumetric.centers for x in center])
        table.direction[:] = [x for direction in volumetric.directions for x in self._unit(direction)]
        offsets = self._lengths(volumetric.offsets)
        table.offset[:] = [math.degrees(x) if LETTERS[d] in ROTARY else x for d, x in enumerate(offsets)]
        self._require(
            len(table.center) == 9 and len(table.direction) == 18 and len(table.offset) == 6, "a vector lacks"
        )

    def _errors(self) -> None:
        """Sort the errors that act into constants and blocks."""
        names = [error.name for error in self.volumetric.errors]
        self._require(len(set(names)) == len(names), "an error has two tables")
        constants: list[tuple[int, float]] = []
        blocks: dict[tuple[str, Interpolation, tuple[tuple[float, ...], ...]], list[ErrorTable]] = {}
        for error in self.volumetric.errors:
            self._check(error)
            if error.name[-1] not in self.volumetric.chain or not any(error.values):
                continue
            if error.arguments:
                blocks.setdefault((error.arguments, error.interpolation, error.nodes), []).append(error)
            else:
                constants.append((ERRORS.index(error.name), error.values[0]))
        table = self.table
        acting = {error.name[-1] for error in self.volumetric.errors if any(error.values)}
        table.exact[:] = [letter not in acting for letter in LETTERS]
        table.constants = len(constants)
        table.constant = self._append([float(number) for number, _ in constants])
        self._append([value for _, value in constants])
        table.blocks = len(blocks)
        self._steepness()
        for block, errors in zip(table.block, blocks.values(), strict=False):
            self._block(block, errors)

    def _check(self, error: ErrorTable) -> None:
        name, assigned = error.name, [letter for letter, _ in self.volumetric.axes]
        self._require(name in ERRORS, f"{name} is no error")
        self._require(len(error.nodes) == len(error.values) > 0, f"{name} has not one value for each node")
        self._require(len(set(error.arguments)) == len(error.arguments), f"{name} depends on an axis twice")
        self._require(set(error.arguments) <= set(assigned), f"{name} depends on an axis that is not assigned")
        bound = largest(name)
        self._require(all(abs(value) <= bound for value in error.values), f"{name} has a value beyond ±{bound:g}")
        block = (id(error.nodes), error.arguments, error.interpolation)
        if block not in self._checked:
            self._checked.add(block)
            self._check_nodes(error)

    def _check_nodes(self, error: ErrorTable) -> None:
        name = error.name
        self._require(
            all(
                len(node) == len(error.arguments) and max(map(abs, node), default=0.0) <= LENGTH_MAX
                for node in error.nodes
            ),
            f"{name} has a node that is no position of {error.arguments}",
        )
        if error.interpolation in (Interpolation.PATH, Interpolation.PATH_XY):
            self._require(set(error.arguments) <= set(LINEAR), f"{name} has no path over {error.arguments}")
            self._require(
                all(a != b for a, b in zip(error.nodes, error.nodes[1:], strict=False)), f"{name} stands still"
            )
        else:
            self._require(len(set(error.nodes)) == len(error.nodes), f"{name} has two values at one node")
        if error.interpolation is Interpolation.GRID:
            self._require(is_grid(error.nodes), f"the nodes of {name} fill no grid")

    def _block(self, block: ErrorBlock, errors: Sequence[ErrorTable]) -> None:
        first = errors[0]
        nodes = first.nodes
        order = list(range(len(nodes)))
        block.interpolation = _INTERPOLATIONS[first.interpolation]
        block.nodes = len(nodes)
        block.errors = len(errors)
        block.error = self._append([float(ERRORS.index(error.name)) for error in errors])
        block.arguments = len(first.arguments)
        for d, letter in enumerate(first.arguments):
            block.argument[d] = LETTERS.index(letter)
            positions = [node[d] for node in nodes]
            self._fold(block, d, letter, min(positions), max(positions))
        if first.interpolation is Interpolation.GRID:
            order.sort(key=nodes.__getitem__)
            for d in range(block.arguments):
                knots = sorted({node[d] for node in nodes})
                block.points[d] = len(knots)
                block.knots[d] = self._append(knots)
                if len(knots) > 1:
                    length = knots[-1] - knots[0]
                    block.steps_per_unit[d] = (len(knots) - 1) / length if length > SHORTEST else 0.0
                    block.steps[d] = self._append(_knots_before(knots, block.steps_per_unit[d]))
        else:
            together = TOGETHER if block.interpolation == INTERPOLATE_SCATTER else 1
            filled = [*nodes, *nodes[-1:] * (-len(nodes) % together)]
            groups = (filled[n : n + together] for n in range(0, len(filled), together))
            block.knots[0] = self._append([x for group in groups for same in zip(*group, strict=True) for x in same])
            if block.interpolation == INTERPOLATE_PATH:
                block.points[0], boxes = _boxes_of(nodes)
                block.steps[0] = self._append(boxes)
        block.values = self._append([error.values[n] for n in order for error in errors])

    def _steepness(self) -> None:
        """Bound how fast the errors change with X, Y and Z: it says when they need no further evaluation."""
        table = self.table
        for error in self.volumetric.errors:
            if error.name[-1] not in self.volumetric.chain or not any(error.values):
                continue
            steepest = sum(self._steepest(error, d) for d, letter in enumerate(error.arguments) if letter in LINEAR)
            if is_angle(error.name):
                table.angular_steepness += steepest
            else:
                table.steepness += steepest
        table.reach = sum(map(abs, (*table.tool_position, *table.center)))

    def _steepest(self, error: ErrorTable, d: int) -> float:
        """Return the largest change of an error per mm along argument d; what is no grid can change as it likes."""
        if error.interpolation is not Interpolation.GRID:
            return 1.0
        key = (id(error.nodes), d)
        if key not in self._pairs:
            self._pairs[key] = _neighbours(error.nodes, d)
        values = error.values
        return max((abs((values[j] - values[i]) / gap) for i, j, gap in self._pairs[key]), default=0.0)

    def _fold(self, block: ErrorBlock, d: int, letter: str, first: float, last: float) -> None:
        """Say into which turn the position of a rotary axis is folded; among scattered records all ways go round."""
        if letter not in ROTARY:
            return
        modulo = self.machine.axes[self.table.axis[LETTERS.index(letter)]].modulo
        length = None if modulo is None else modulo.length
        turn = turn_of(first, last, length)
        if block.interpolation == INTERPOLATE_SCATTER and turn is None:
            turn = (first, FULL_TURN)
        if turn is not None:
            block.start[d], block.period[d] = turn

    def _append(self, values: Sequence[float]) -> int:
        return append(self.pool, values, self._name())

    def _lengths(self, values: Sequence[float]) -> Sequence[float]:
        self._require(all(abs(value) <= LENGTH_MAX for value in values), f"a length is beyond {LENGTH_MAX:g} mm")
        return values

    def _unit(self, vector: Sequence[float]) -> list[float]:
        """Return a direction scaled as exactly as floats allow: the model inverts rotations by transposing them."""
        length = math.hypot(*vector)
        self._require(abs(length - 1.0) <= UNIT_TOLERANCE, f"the direction {vector} is not scaled to length 1")
        return [x / length for x in vector]

    def _name(self) -> str:
        return f"volumetric compensation {self.volumetric.index}"

    def _require(self, condition: bool, message: str) -> None:
        if not condition:
            raise CompileError(f"{self._name()}: {message}")
