"""Measured deviations of the tool tip, for the identification of the errors of a machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..measurement.columns import ANGLES, LENGTHS, Column, Columns
from ..measurement.readings import RUN, Readings
from ..model.volumetric import LETTERS, LINEAR, ROTARY

_DEVIATIONS = tuple(Column(f"d{letter.lower()}", LENGTHS, "um") for letter in LINEAR)
_POSITIONS = (
    *(Column(letter.lower(), LENGTHS, "mm") for letter in LINEAR),
    *(Column(letter.lower(), ANGLES, "deg", optional=True) for letter in ROTARY),
)


@dataclass(frozen=True, eq=False)
class TcpDeviations(Readings):
    """Measured deviations of the tool tip, actual − nominal on the workpiece, in any order.

    Attributes
    ----------
    positions : array, shape (n, 6)
        Of X, Y, Z, A, B, C, mm and °; 0 where an axis is not given.
    tool_lengths : array, shape (n,)
        mm.
    deviations : array, shape (n, 3)
        In X, Y, Z of the workpiece, µm.
    given : str
        Letters of the axes whose positions the file gives.
    """

    positions: Annotated[Array, *_POSITIONS]
    tool_lengths: Annotated[Array, Column("tool_length", LENGTHS, "mm", optional=True)]
    deviations: Annotated[Array, *_DEVIATIONS]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    given: str = LETTERS
    source: str = ""

    @classmethod
    def about(cls, columns: Columns) -> dict[str, Any]:
        """Return which axes are given."""
        given = "".join(letter for letter in LETTERS if letter.lower() in columns.values)
        return {**super().about(columns), "given": given}
