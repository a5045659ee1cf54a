"""The error model of a machine for fits: how the tool tip deviates with given errors, and with which errors how much.

The kernel's own model is evaluated, so what is identified is what the controller corrects.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..compile import compile_tables
from ..kernel.record import zeros
from ..kernel.volumetric_errors import errors_at
from ..kernel.volumetric_model import FRAME, carry_to_workpiece
from ..machine import Axis, AxisType, Machine
from ..volumetric import ERRORS, LETTERS, LINEAR, ROTARY, Volumetric
from .columns import ANGLES, LENGTHS, Column, read_columns
from .motion import Array
from .positioning import whole_runs

COLUMNS = (
    *(Column(letter.lower(), LENGTHS, "mm") for letter in LINEAR),
    *(Column(f"d{letter.lower()}", LENGTHS, "um") for letter in LINEAR),
    *(Column(letter.lower(), ANGLES, "deg", optional=True) for letter in ROTARY),
    Column("tool_length", LENGTHS, "mm", optional=True),
    Column("run", optional=True, aliases=("cycle",)),
)

_STEP = 1e-4
"""mm and rad by which errors are changed to see what they do; the model is all but linear in them."""


@dataclass(frozen=True, eq=False)
class TcpDeviations:
    """Measured deviations of the tool tip, actual − nominal on the workpiece, in any order.

    Attributes
    ----------
    positions : array, shape (n, 6)
        Of X, Y, Z, A, B, C, mm and °; 0 where an axis is not given.
    tool_lengths : array, shape (n,)
        mm.
    deviations : array, shape (n, 3)
        In X, Y, Z of the workpiece, µm.
    runs : array of int, shape (n,)
        1 everywhere if there is one run only.
    given : str
        Letters of the axes whose positions the file gives.
    source : str
        The file.
    """

    positions: Array
    tool_lengths: Array
    deviations: Array
    runs: npt.NDArray[np.int64]
    given: str = LETTERS
    source: str = ""

    def only(self, chosen: npt.NDArray[np.bool_]) -> TcpDeviations:
        """Return some of the readings."""
        return replace(
            self,
            positions=self.positions[chosen],
            tool_lengths=self.tool_lengths[chosen],
            deviations=self.deviations[chosen],
            runs=self.runs[chosen],
        )


def read_tcp_deviations(path: str | Path) -> TcpDeviations:
    """Read a table with ``x, y, z, dx, dy, dz`` and, where there are any, ``a, b, c, tool_length, run``.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it.
    """
    columns = read_columns(Path(path), COLUMNS)
    values, none = columns.values, np.zeros(len(columns.lines))
    return TcpDeviations(
        np.column_stack([values.get(letter.lower(), none) * 1e-3 for letter in LETTERS]),
        values.get("tool_length", none) * 1e-3,
        np.column_stack([values[f"d{letter.lower()}"] for letter in LINEAR]),
        whole_runs(columns),
        "".join(letter for letter in LETTERS if letter.lower() in values),
        columns.file,
    )


class TcpModel:
    """A machine with a volumetric compensation whose errors can be given.

    Parameters
    ----------
    volumetric : Volumetric
        Its chain, centres, directions, offsets and so on, and the errors that are known.
    """

    def __init__(self, volumetric: Volumetric) -> None:
        types = {letter: AxisType.TRANSLATORY if letter in LINEAR else AxisType.ROTARY for letter in LETTERS}
        axes = tuple(Axis(number, letter, types[letter]) for letter, number in volumetric.axes)
        tables = compile_tables(Machine(axes, (replace(volumetric, index=0),)))
        self._pool, self._table = tables.pool, tables.volumetric[0]
        # Axes without known errors get some here.
        self._table.exact[:] = [False] * len(LETTERS)

    def places(self, positions: Array) -> Array:
        """Return where the axes are for the model, (n, 6): with the offsets of the machine."""
        result: Array = positions + np.array(self._table.offset)
        return result

    def known_errors(self, places: Array) -> Array:
        """Return the 72 errors that are known at places, (n, 72), mm and rad."""
        found = np.empty((len(places), len(ERRORS)))
        for row, place in zip(found, places.tolist(), strict=True):
            errors = zeros(len(ERRORS))
            errors_at(self._pool, self._table, place, errors)
            row[:] = errors
        return found

    def deviations(self, places: Array, tool_lengths: Array, errors: Array) -> Array:
        """Return actual − nominal tool tip on the workpiece, (n, 3), mm, with errors (n, 72)."""
        found = np.empty((len(places), len(LINEAR)))
        rows = zip(found, places.tolist(), tool_lengths.tolist(), errors.tolist(), strict=True)
        for row, place, tool_length, wrong in rows:
            nominal, actual = zeros(FRAME), zeros(FRAME)
            carry_to_workpiece(self._table, place, tool_length, wrong, nominal, actual)
            row[:] = [actual[d] - nominal[d] for d in range(len(LINEAR))]
        return found

    def derivatives(self, places: Array, tool_lengths: Array, errors: Array, which: Sequence[int]) -> Array:
        """Return what each of some errors does to the tool tip, (n, 3, errors), mm per mm or rad."""
        found = np.empty((len(places), len(LINEAR), len(which)))
        for column, error in enumerate(which):
            sides = []
            for step in (_STEP, -_STEP):
                changed = errors.copy()
                changed[:, error] += step
                sides.append(self.deviations(places, tool_lengths, changed))
            found[:, :, column] = (sides[0] - sides[1]) / (2.0 * _STEP)
        return found
