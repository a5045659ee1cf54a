"""Coverage: positions and accelerations that an input file uses but a table does not hold.

Outside its points a table holds its end values (semantics §5 … §8): the machine is then corrected by a guess.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from ...engine.motion import Array
from ...kinds import tables_of
from ...kinds.shown import ACCELERATION, POSITION
from ...lists import Position
from ...lists.findings import Findings
from ...model.machine import Axis, AxisType, Machine
from ...model.quantity import symbol
from ...model.volumetric import FULL_TURN, ErrorTable, Volumetric, turn_of
from .positions import Positions
from .trajectory import column_of, setpoints

TOLERANCE = 1e-6
"""mm or °: what lies outside by less is rounding."""


@dataclass(frozen=True)
class Coverage:
    """What a file uses of a table's range.

    Attributes
    ----------
    table : str
        The table in words.
    quantity, unit : str
        Over what the range is: ``X`` in mm, ``acceleration of X`` in mm/s².
    held : tuple of two floats
        First and last point of the table.
    used : tuple of two floats
        Least and largest value in the file.
    outside : float
        Share of the file's rows outside the range, 0 … 1.
    position : Position
        Of the table in its list.
    """

    table: str
    quantity: str
    unit: str
    held: tuple[float, float]
    used: tuple[float, float]
    outside: float
    position: Position

    @property
    def message(self) -> str:
        """Return the finding's sentence."""
        beyond = [
            f"{abs(used - held):g} {self.unit} {where}"
            for used, held, where, is_out in (
                (self.used[0], self.held[0], "below", self.used[0] < self.held[0] - TOLERANCE),
                (self.used[1], self.held[1], "above", self.used[1] > self.held[1] + TOLERANCE),
            )
            if is_out
        ]
        return (
            f"{self.quantity} goes from {self.used[0]:g} to {self.used[1]:g} {self.unit}, {self.table} from "
            f"{self.held[0]:g} to {self.held[1]:g}: up to {' and '.join(beyond)}, and in "
            f"{100.0 * self.outside:.3g} % of the rows its end value is held."
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON."""
        names = ("table", "quantity", "unit", "held", "used", "outside")
        return {name: getattr(self, name) for name in names}


def coverage_of(machine: Machine, trajectory: Mapping[str, Array], positions: Positions) -> Iterator[Coverage]:
    """Yield what a file uses of every table whose quantities it moves.

    Parameters
    ----------
    machine : Machine
        Whose tables.
    trajectory : mapping of str to array, shape (rows,)
        As ``sweep.trajectory.read_input(path).columns``: ``X.setpoint`` and the like in mm, °, mm/s² …
    positions : Positions
        Of its lists.

    Raises
    ------
    ValueError
        The file moves no axis of the machine.
    """
    moved = setpoints(trajectory, machine)
    names = {axis.number: axis for axis in machine.axes}
    for tables in tables_of(machine):
        for over, low, high, entry in tables.ranges():
            position = positions.of_table(tables.axis.number, entry, *([0] * entry.count("[")))
            axis = machine.axis(over.axis)
            used = column_of(trajectory, axis, ACCELERATION) if over.name == ACCELERATION else moved.get(axis.number)
            quantity = {POSITION: axis.name, ACCELERATION: f"the acceleration of {axis.name}"}.get(over.name)
            if used is not None and quantity is not None:
                yield _coverage(tables.name, quantity, over.unit, (low, high), used, position)
    for volumetric in machine.volumetric:
        yield from _of_volumetric(volumetric, names, moved, positions)


def judge_coverage(
    machine: Machine, trajectory: Mapping[str, Array], positions: Positions, findings: Findings
) -> list[Coverage]:
    """Note where a file leaves the tables, and return what it uses of each.

    Raises
    ------
    ValueError
        As ``coverage_of`` does.
    """
    results = list(coverage_of(machine, trajectory, positions))
    for result in results:
        if result.outside > 0.0:
            findings.add("AXC-COVERAGE", *result.position, f"{result.message[0].upper()}{result.message[1:]}")
    return results


def _coverage(
    table: str, quantity: str, unit: str, held: tuple[float, float], used: Array, position: Position
) -> Coverage:
    outside = float(np.mean((used < held[0] - TOLERANCE) | (used > held[1] + TOLERANCE)))
    return Coverage(table, quantity, unit, held, (float(used.min()), float(used.max())), outside, position)


def _of_volumetric(
    volumetric: Volumetric, names: dict[int, Axis], moved: dict[int, Array], positions: Positions
) -> Iterator[Coverage]:
    """Yield the coverage of each axis by the narrowest of its error tables."""
    position = positions.of_volumetric(volumetric.index)
    for letter, number in volumetric.axes:
        axis = names[number]
        tables = [table for table in volumetric.errors if letter in table.arguments]
        if axis.type is not AxisType.TRANSLATORY:
            tables = [table for table in tables if np.ptp(_range(table, letter)) < FULL_TURN]
        if number not in moved or not tables:
            continue
        ranges = [_range(table, letter) for table in tables]
        held = (max(low for low, _ in ranges), min(high for _, high in ranges))
        used = moved[number] + volumetric.offsets["XYZABC".index(letter)] * (1.0 if letter in "XYZ" else 180.0 / np.pi)
        turn = turn_of(*held, None if axis.modulo is None else axis.modulo.length)
        if turn is not None:
            used = turn[0] + np.mod(used - turn[0], turn[1])
        errors = " ".join(chain((table.name for table in tables[:3]), ["…"] if len(tables) > 3 else []))
        name = f"volumetric compensation {volumetric.index} ({errors})"
        yield _coverage(name, axis.name, symbol(axis.unit), held, used, position)


def _range(table: ErrorTable, letter: str) -> tuple[float, float]:
    positions = [node[table.arguments.index(letter)] for node in table.nodes]
    return min(positions), max(positions)
