"""Measured deviations of the tool tip, for the identification of the errors of a machine."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..measurement.columns import ANGLES, LENGTHS, Column, read_columns
from ..measurement.positioning import whole_runs
from ..model.volumetric import LETTERS, LINEAR, ROTARY

COLUMNS = (
    *(Column(letter.lower(), LENGTHS, "mm") for letter in LINEAR),
    *(Column(f"d{letter.lower()}", LENGTHS, "um") for letter in LINEAR),
    *(Column(letter.lower(), ANGLES, "deg", optional=True) for letter in ROTARY),
    Column("tool_length", LENGTHS, "mm", optional=True),
    Column("run", optional=True, aliases=("cycle",)),
)


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
    values = columns.values
    return TcpDeviations(
        np.column_stack([columns.positions(letter.lower()) for letter in LETTERS]),
        columns.positions("tool_length"),
        np.column_stack([values[f"d{letter.lower()}"] for letter in LINEAR]),
        whole_runs(columns),
        "".join(letter for letter in LETTERS if letter.lower() in values),
        columns.file,
    )
