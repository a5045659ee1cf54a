"""The tables of a machine as variables of FMI 3.0: arrays that a host reads and calibrates."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

from ..kernel import Tables
from ..kinds import KINDS, TableArray
from ..model import COMPENSATIONS_MAX, Machine
from .declarations import MACHINE_BLOCK, VOLUMETRIC_BLOCK
from .variable import BLOCK
from .variables import Naming, prefixes_of

TABLE_BLOCK = VOLUMETRIC_BLOCK + COMPENSATIONS_MAX
"""First of the blocks with the tables of an axis each."""

TIME_REFERENCE = BLOCK * MACHINE_BLOCK + BLOCK - 1
"""Value reference of the independent variable, which FMI 3.0 asks for."""


@dataclass(frozen=True)
class ArrayVariable:
    """Numbers of a table; ``shape``: points, or rows and points; ``start``: all of them, row by row."""

    name: str
    reference: int
    description: str
    unit: str
    shape: tuple[int, ...]
    start: tuple[float, ...]


def arrays_of(machine: Machine, tables: Tables, pool: Sequence[float], naming: Naming) -> tuple[ArrayVariable, ...]:
    """Return the arrays of a machine's FMU; ``tables``, ``pool``: what its lists were compiled to."""
    dot = "." if naming == "structured" else "_"
    return tuple(
        ArrayVariable(
            dot.join((prefix, kind, array.name)),
            BLOCK * (TABLE_BLOCK + index) + identifier,
            f"{array.description}; a change blends in",
            array.unit.format(machine.axes[_looked_up_with(table, array, index)].unit),
            shape,
            tuple(pool[first : first + _product(shape)]),
        )
        for index, prefix in enumerate(prefixes_of(machine, naming))
        for kind, identifier, array in every_array()
        for table in (getattr(tables.axis[index].compensation, kind),)
        for first, shape in (_place(table, array),)
        if _product(shape) > 0
    )


def every_array() -> Iterator[tuple[str, int, TableArray]]:
    """Yield kind, identifier and declaration of every array that an axis can have."""
    for name, kind in KINDS.items():
        for array in kind.arrays:
            yield name, kind.identifier + array.number, array


def _place(table: Any, array: TableArray) -> tuple[int, tuple[int, ...]]:
    counts = [path for path in (array.rows, array.points) if path]
    return _field(table, array.at), tuple(_field(table, path) for path in counts)


def _looked_up_with(table: Any, array: TableArray, axis: int) -> int:
    return _field(table, f"{array.argument}.axis") if array.argument else axis


def _field(table: Any, path: str) -> int:
    found: int = reduce(getattr, path.split("."), table)
    return found


def _product(shape: tuple[int, ...]) -> int:
    return reduce(int.__mul__, shape)
