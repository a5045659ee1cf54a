"""Coverage: positions and accelerations that an input file uses but a table does not hold.

Outside its points a table holds its end values (semantics §5 … §8): the machine is then corrected by a guess.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engine import Array
from ...interface import identifier
from ...kinds import ACCELERATION, POSITION, tables_of
from ...lists import Findings, Position
from ...model import FULL_TURN, LETTERS, LINEAR, Axis, Machine, Volumetric, symbol, turn_of
from .positions import Positions, sentence

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
            for used, held, where, sign in zip(self.used, self.held, ("below", "above"), (-1.0, 1.0), strict=True)
            if sign * (used - held) > TOLERANCE
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


def judge_coverage(
    machine: Machine, trajectory: Mapping[str, Array], positions: Positions, findings: Findings
) -> list[Coverage]:
    """Note where a file leaves the tables, and return what it uses of every table whose quantities it moves.

    ``trajectory``: ``X.setpoint`` and so on, (rows,), mm, ° or mm/s², as ``engine.trajectory.read_input`` gives it.

    Raises
    ------
    ValueError
        The file moves no axis of the machine.
    """
    moved = setpoints(trajectory, machine)
    results = [*_of_tables(machine, trajectory, moved, positions)]
    for volumetric in machine.volumetric:
        results += _of_volumetric(volumetric, machine, moved, positions)
    for result in results:
        if result.outside > 0.0:
            findings.add("AXC-COVERAGE", *result.position, sentence(result.message))
    return results


def setpoints(trajectory: Mapping[str, Array], machine: Machine) -> dict[int, Array]:
    """Return the setpoints by axis number, of the axes that the file moves.

    Raises
    ------
    ValueError
        It moves none.
    """
    found = {axis.number: _column(trajectory, axis, "setpoint") for axis in machine.axes}
    moved = {number: column for number, column in found.items() if column is not None}
    if not moved:
        names = ", ".join(f"{identifier(axis.name)}.setpoint" for axis in machine.axes[:3]) or "none, it has no axis"
        raise ValueError(f"the input file has no setpoint of an axis of this machine: {names}")
    return moved


def _column(trajectory: Mapping[str, Array], axis: Axis, quantity: str) -> Array | None:
    """Return a quantity of an axis, ``X.setpoint`` or ``X_setpoint``; None if the file has no such column."""
    name = identifier(axis.name)
    return trajectory.get(f"{name}.{quantity}", trajectory.get(f"{name}_{quantity}"))


def _of_tables(
    machine: Machine, trajectory: Mapping[str, Array], moved: dict[int, Array], positions: Positions
) -> Iterator[Coverage]:
    for tables in tables_of(machine):
        for over, low, high, entry in tables.ranges():
            axis = machine.axis(over.axis)
            used = _column(trajectory, axis, ACCELERATION) if over.name == ACCELERATION else moved.get(axis.number)
            quantity = {POSITION: axis.name, ACCELERATION: f"the acceleration of {axis.name}"}.get(over.name)
            if used is not None and quantity is not None:
                position = positions.of_table(tables.axis.number, entry)
                yield _coverage(tables.name, quantity, over.unit, (low, high), used, position)


def _of_volumetric(
    volumetric: Volumetric, machine: Machine, moved: dict[int, Array], positions: Positions
) -> Iterator[Coverage]:
    """Yield the coverage of each axis by the narrowest of its error tables."""
    for letter, number in volumetric.axes:
        tables = [table for table in volumetric.errors if letter in table.arguments]
        axis = machine.numbered(number)
        nodes = [table.positions(letter) for table in tables]
        # A table over a full turn of a rotary axis has no outside.
        nodes = [own for own in nodes if letter in LINEAR or max(own) - min(own) < FULL_TURN]
        if number not in moved or not nodes:
            continue
        held = (max(map(min, nodes)), min(map(max, nodes)))
        used = moved[number] + volumetric.offsets[LETTERS.index(letter)] * (1.0 if letter in LINEAR else 180.0 / np.pi)
        turn = None if letter in LINEAR else turn_of(*held, None if axis.modulo is None else axis.modulo.length)
        if turn is not None:
            used = turn[0] + np.mod(used - turn[0], turn[1])
        errors = " ".join([*(table.name for table in tables[:3]), *(["…"] if len(tables) > 3 else [])])
        name = f"volumetric compensation {volumetric.index} ({errors})"
        position = positions.of_volumetric(volumetric.index)
        yield _coverage(name, axis.name, symbol(axis.unit), held, used, position)


def _coverage(
    table: str, quantity: str, unit: str, held: tuple[float, float], used: Array, position: Position
) -> Coverage:
    outside = float(np.mean((used < held[0] - TOLERANCE) | (used > held[1] + TOLERANCE)))
    return Coverage(table, quantity, unit, held, (float(used.min()), float(used.max())), outside, position)
