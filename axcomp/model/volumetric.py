"""What the volumetric lists mean: the error model of a machine after ISO 230-1 and ISO/TR 16907 (manual 003).

Parameter values keep the unit of their files: lengths in mm, angles in **rad**. Arguments, that is positions of axes,
are in mm and °, as everywhere behind the reader. Errors are actual − nominal, right-handed.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

LINEAR = "XYZ"
ROTARY = "ABC"
LETTERS = LINEAR + ROTARY
"""The axes of the model, in the order of every array over axes."""

COMPENSATIONS_MAX = 5
"""Volumetric compensations of a controller (P-STUP-00101)."""

FILES_MAX = 10
"""Parameter files of a compensation (P-VOLC-00012)."""

ERRORS = tuple(
    f"{kind}{axis}" for axis in LETTERS for kind in (*(f"{k}0" for k in LETTERS), *(f"E{k}" for k in LETTERS))
)
"""The 72 errors, twelve an axis: six position errors ``X0`` … ``C0``, six component errors ``EX`` … ``EC``."""

TOOL_POSITION = ("P0X", "P0Y", "P0Z")
TOOL_ORIENTATION = ("N0X", "N0Y", "N0Z")
CENTERS = tuple(tuple(f"P{k}{axis}" for k in LINEAR) for axis in ROTARY)
DIRECTIONS = tuple(tuple(f"V{k}{axis}" for k in LINEAR) for axis in LETTERS)
OFFSETS = tuple(f"ID{axis}" for axis in LETTERS)
AXIS_NUMBERS = tuple(f"LN{axis}" for axis in LETTERS)

DESCRIPTION = (
    *TOOL_POSITION,
    *TOOL_ORIENTATION,
    *(name for center in CENTERS for name in center),
    *(name for direction in DIRECTIONS for name in direction),
    *OFFSETS,
    *AXIS_NUMBERS,
)
"""Parameters that describe the machine rather than its errors; they have one value each."""

PARAMETERS = frozenset(ERRORS + DESCRIPTION)

ANGLE_MAX = 1.0
"""Largest angular error that is taken for one, rad; beyond it the file is not in rad."""
OFFSET_MAX = 6.2832
"""Largest offset of a rotary axis, rad."""
LENGTH_MAX = 1e6
"""Largest length, mm."""
FULL_TURN = 360.0
"""Degrees after which a rotary axis stands where it stood."""

Triple = tuple[float, float, float]
NO_VECTOR: Triple = (0.0, 0.0, 0.0)
NOMINAL_DIRECTIONS: tuple[Triple, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)) * 2
UNIT_TOLERANCE = 1e-6
"""How far the length of a scaled vector may be from 1."""
COPLANAR = 1e-6
"""Volume spanned by the directions of X, Y and Z below which they lie in one plane."""


def is_angle(name: str) -> bool:
    """Tell whether a parameter is an angle (rad) rather than a length (mm) or a bare number."""
    if name in OFFSETS:
        return name[-1] in ROTARY
    return name in ERRORS and (name[1] if name[0] == "E" else name[0]) in ROTARY


def largest(name: str) -> float:
    """Return the largest value of a parameter that is plausible, mm or rad."""
    if not is_angle(name):
        return LENGTH_MAX
    return OFFSET_MAX if name in OFFSETS else ANGLE_MAX


class Interpolation(enum.Enum):
    """How a parameter is interpolated over its arguments (P-VOLC-00014)."""

    GRID = "GRID"
    SCATTER = "SCATTER"
    PATH = "PATH"
    PATH_XY = "PATH_XY"


@dataclass(frozen=True, repr=False)
class ErrorTable:
    """One of the 72 errors over the positions of some axes.

    Attributes
    ----------
    name : str
        One of ``ERRORS``.
    values : tuple of float
        mm or rad, one for each node.
    arguments : str
        Letters of the axes it depends on, in the order of ``LETTERS``; "" for a constant.
    nodes : tuple of tuple of float, shape (len(values), len(arguments))
        mm or °. Ascending for GRID and SCATTER, the first argument changing slowest; in the order of the polyline for
        PATH and PATH_XY. Tables of one block share one tuple.
    interpolation : Interpolation
        GRID for a constant.
    """

    name: str
    values: tuple[float, ...]
    arguments: str = ""
    nodes: tuple[tuple[float, ...], ...] = ((),)
    interpolation: Interpolation = Interpolation.GRID

    def positions(self, letter: str) -> list[float]:
        """Return the positions of one of the arguments' axes, node by node."""
        column = self.arguments.index(letter)
        return [node[column] for node in self.nodes]

    def __repr__(self) -> str:
        if not self.arguments:
            return f"ErrorTable({self.name} = {self.values[0]:g})"
        return f"ErrorTable({self.name} over {self.arguments}, {len(self.nodes)} nodes, {self.interpolation.value})"


@dataclass(frozen=True, repr=False)
class Volumetric:
    """A volumetric compensation: corrects X, Y and Z so that the tool is where it would be without the errors.

    Attributes
    ----------
    index : int
        0..4, its place in the start-up list (P-STUP-00101) and ID in ``#VOLCOMP``.
    axes : tuple of (str, int)
        Letter and logical number of the axes taking part, in the order of ``LETTERS`` (P-VOLC-00001..00006, ``LN*``).
    chain : str
        The axes from the workpiece to the tool (P-VOLC-00007).
    workpiece_axes : int
        How many of them, counted from the workpiece, carry the workpiece (P-VOLC-00008).
    errors : tuple of ErrorTable
        At most one table for each error; an error that has none is zero. Lists give them in the order of ``ERRORS``.
    tool_position : (float, float, float)
        Tool tip at tool length 0 when all axes are at 0, mm (``P0*``).
    tool_orientation : (float, float, float)
        Unit vector from the flange to the tool tip (``N0*``); zero: the tool length does not matter.
    centers : three (float, float, float)
        Points on the axes A, B and C, mm (``PXA`` …).
    directions : six (float, float, float)
        Unit vectors of the axes (``VXX`` …).
    offsets : six floats
        Added to the setpoints before anything else, mm and **rad** (``ID*``).
    alternative_model : bool
        Rotary axes turn about their displaced axis (P-VOLC-00011).
    negate, set_to_zero : str
        Letters of the linear axes whose correction changes its sign or is left out (P-VOLC-00009, P-VOLC-00010).
    manual_activation : bool
        On only by command (P-VOLC-00017).
    filter_steps : int
        Cycles of a switch, 0: at once (P-VOLC-00018).
    associate_to_channel : bool
        Program end while on is an error (P-VOLC-00019).
    max_records : int
        Records the controller reserves (P-STUP-00100).
    files : tuple of str
        Parameter files as the list names them; they do not count in comparisons (P-VOLC-00012).
    diagnosis_file : str
        Where a spreadsheet of all records goes, "": nowhere; does not count in comparisons (P-VOLC-00016).
    """

    index: int
    axes: tuple[tuple[str, int], ...]
    chain: str = LINEAR
    workpiece_axes: int = 0
    errors: tuple[ErrorTable, ...] = ()
    tool_position: Triple = NO_VECTOR
    tool_orientation: Triple = NO_VECTOR
    centers: tuple[Triple, ...] = (NO_VECTOR,) * 3
    directions: tuple[Triple, ...] = NOMINAL_DIRECTIONS
    offsets: tuple[float, ...] = (0.0,) * 6
    alternative_model: bool = False
    negate: str = ""
    set_to_zero: str = ""
    manual_activation: bool = False
    filter_steps: int = 20
    associate_to_channel: bool = False
    max_records: int = 1000
    files: tuple[str, ...] = field(default=(), compare=False)
    diagnosis_file: str = field(default="", compare=False)

    def sign(self, letter: str) -> float:
        """Return what counts of the correction of a linear axis: −1 where it is negated, 0 where it is left out."""
        return 0.0 if letter in self.set_to_zero else -1.0 if letter in self.negate else 1.0

    def description(self) -> Iterator[tuple[str, float]]:
        """Yield name and value of the describing parameters that are not at their defaults (never ``LN*``)."""
        rows: list[tuple[tuple[str, ...], Triple, Triple]]
        rows = [(TOOL_POSITION, self.tool_position, NO_VECTOR), (TOOL_ORIENTATION, self.tool_orientation, NO_VECTOR)]
        rows += [(names, center, NO_VECTOR) for names, center in zip(CENTERS, self.centers, strict=True)]
        rows += list(zip(DIRECTIONS, self.directions, NOMINAL_DIRECTIONS, strict=True))
        for names, values, defaults in rows:
            if values != defaults:
                yield from zip(names, values, strict=True)
        yield from ((name, value) for name, value in zip(OFFSETS, self.offsets, strict=True) if value != 0.0)

    def records(self) -> int:
        """Return the number of records: one for each parameter and argument tuple."""
        return sum(len(table.values) for table in self.errors) + sum(1 for _ in self.description())

    def __repr__(self) -> str:
        axes = " ".join(f"{letter}={number}" for letter, number in self.axes)
        side = f", {self.chain[: self.workpiece_axes]} carrying the workpiece" if self.workpiece_axes else ""
        return f"Volumetric({self.index}: {axes}, chain {self.chain}{side}, {len(self.errors)} errors)"


def is_grid(nodes: Sequence[tuple[float, ...]]) -> bool:
    """Tell whether distinct nodes fill a grid: every combination of the coordinates that occur is there."""
    if not nodes:
        return False
    return math.prod(len(set(coordinates)) for coordinates in zip(*nodes, strict=True)) == len(nodes)


def turn_of(first: float, last: float, modulo: float | None) -> tuple[float, float] | None:
    """Return start and length of the turn into which positions of a rotary axis are folded, °; None: they are not.

    A table over a full turn begins it, wherever that is; any other one, on a modulo axis, is in its middle.
    ``modulo`` is the range of the axis.
    """
    if last - first >= FULL_TURN:
        return first, FULL_TURN
    return None if modulo is None else (0.5 * (first + last - modulo), modulo)


def jump_of(table: ErrorTable, argument: str, modulo: float | None) -> tuple[float, float]:
    """Return where a table on a grid jumps when a rotary axis goes on turning, °, and its largest jump, mm or rad.

    No jump: (0, 0). ``modulo`` is the range of the axis, None if it does not count modulo.
    """
    d = table.arguments.index(argument)
    rows: dict[tuple[float, ...], list[tuple[float, float]]] = {}
    for node, value in sorted(zip(table.nodes, table.values, strict=True)):
        rows.setdefault(node[:d] + node[d + 1 :], []).append((node[d], value))
    first, last = table.nodes[0][d], max(node[d] for node in table.nodes)
    turn = turn_of(first, last, modulo)
    if turn is None or table.interpolation is not Interpolation.GRID:
        return 0.0, 0.0
    start, length = turn
    return start, max((row[0][1] - _value(row, start + length) for row in rows.values()), key=abs)


def _value(row: Sequence[tuple[float, float]], x: float) -> float:
    """Return the value of a curve at x, its end value held."""
    for (a, low), (b, high) in pairwise(row):
        if x < b:
            return low + (high - low) * (x - a) / (b - a)
    return row[-1][1]
