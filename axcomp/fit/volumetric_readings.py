"""What instruments say of the tool tip: deviations, points of a tracker, lengths to a station, places of a sphere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..measurement import ANGLES, LENGTHS, RUN, Column, Columns, MeasurementError, Readings, read_columns, whole_runs
from ..model import LETTERS, LINEAR, ROTARY

DEVIATION, POINT, LENGTH, DISPLACEMENT, SPHERE = range(5)
"""Kinds of readings: of the tip's deviation, its place seen by a station, its distance from one, the same but for the
dead path, and where axes stand while the tip is at the centre of a sphere."""

KINDS = ("deviation", "point", "length", "displacement", "sphere")

POSITIONS = (
    *(Column(letter.lower(), LENGTHS, "mm") for letter in LINEAR),
    *(Column(letter.lower(), ANGLES, "deg", optional=True) for letter in ROTARY),
)
DEVIATIONS = tuple(Column(f"d{letter.lower()}", LENGTHS, "um", optional=True) for letter in LINEAR)
POINTS = tuple(Column(f"p{letter.lower()}", LENGTHS, "mm", optional=True) for letter in LINEAR)
_TOOL = Column("tool_length", LENGTHS, "mm", optional=True)
_LENGTH = Column("length", LENGTHS, "mm", optional=True)
_DISPLACEMENT = Column("displacement", LENGTHS, "mm", optional=True)
_STATION, _SPHERE = Column("station", optional=True), Column("sphere", optional=True)
COLUMNS = (*POSITIONS, *DEVIATIONS, *POINTS, _LENGTH, _DISPLACEMENT, _STATION, _SPHERE, _TOOL, RUN)


@dataclass(frozen=True, eq=False)
class TcpDeviations(Readings):
    """Readings of the tool tip, in any order and of any kinds.

    Attributes
    ----------
    positions : array, shape (n, 6)
        Of X, Y, Z, A, B, C, mm and °; 0 where an axis is not given.
    tool_lengths : array, shape (n,)
        mm.
    deviations : array, shape (n, 3)
        DEVIATION: actual − nominal in X, Y, Z of the workpiece, µm; SPHERE: how far its centre is from the tip, in X,
        Y, Z of the machine, µm; else 0.
    runs : array of int, shape (n,)
    given : str
        Letters of the axes whose positions the file gives.
    source : str
    kinds, stations : array of int, shape (n,)
        One of the kinds; number of the station or sphere, 0 where there is none.
    measured : array, shape (n, 3)
        POINT: where the station sees the tip, mm; LENGTH and DISPLACEMENT: the length in the first column, mm; else 0.
    """

    positions: Array
    tool_lengths: Array
    deviations: Array
    runs: npt.NDArray[np.int64]
    given: str = LETTERS
    source: str = ""
    kinds: npt.NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    stations: npt.NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    measured: Array = field(default_factory=lambda: np.zeros((0, 3)))

    def __post_init__(self) -> None:
        n = len(self.runs)
        if len(self.kinds) != n:
            object.__setattr__(self, "kinds", np.zeros(n, dtype=np.int64))
        if len(self.stations) != n:
            object.__setattr__(self, "stations", np.zeros(n, dtype=np.int64))
        if len(self.measured) != n:
            object.__setattr__(self, "measured", np.zeros((n, 3)))

    @classmethod
    def read(cls, path: str | Path, axis: str = "") -> Self:
        """Read a file; MeasurementError if it cannot be read, or a line of it, or its columns do not go together."""
        return cls.of(read_columns(Path(path), COLUMNS, axis, needed=(*POSITIONS[:3], *DEVIATIONS)))

    @classmethod
    def of(cls, found: Columns) -> Self:
        """Return the readings in columns."""
        n, values = len(found.lines), found.values
        kind = _kind_of(found)
        deviations, measured = np.zeros((n, 3)), np.zeros((n, 3))
        if kind in (DEVIATION, SPHERE) and "dx" in values:
            deviations = np.column_stack([values[column.name] for column in DEVIATIONS])
        if kind == POINT:
            measured = np.column_stack([found.positions(column.name) for column in POINTS])
        elif kind in (LENGTH, DISPLACEMENT):
            measured[:, 0] = found.positions(KINDS[kind])
        return cls(
            positions=np.column_stack([found.positions(letter.lower()) for letter in LETTERS]),
            tool_lengths=found.positions("tool_length"),
            deviations=deviations,
            runs=whole_runs(found),
            given="".join(letter for letter in LETTERS if letter.lower() in values),
            source=found.file,
            kinds=np.full(n, kind),
            stations=_numbers(found, "sphere" if kind == SPHERE else "station", 0 if kind == DEVIATION else 1),
            measured=measured,
        )


def _kind_of(found: Columns) -> int:
    """Return the kind of readings that columns say; MeasurementError if they say none or several."""
    have = set(found.values)
    kinds = [
        *([POINT] if {column.name for column in POINTS} & have else []),
        *([LENGTH] if "length" in have else []),
        *([DISPLACEMENT] if "displacement" in have else []),
        *([SPHERE] if "sphere" in have else []),
    ]
    deviations = {column.name for column in DEVIATIONS}
    if deviations & have and not kinds:
        kinds = [DEVIATION]
    if len(kinds) != 1 or (deviations & have and kinds[0] not in (DEVIATION, SPHERE)):
        choice = "dx, dy, dz; px, py, pz; length; displacement; or sphere"
        raise MeasurementError(found.file, 0, f"The columns have to be of one kind of readings: {choice}.")
    wanted: Sequence[Column] = POINTS if kinds[0] == POINT else DEVIATIONS if deviations & have else ()
    missing = ", ".join(column.name for column in wanted if column.name not in have)
    if missing:
        raise MeasurementError(found.file, 0, f"There is no column for {missing}.")
    return kinds[0]


def _numbers(found: Columns, name: str, default: int) -> npt.NDArray[np.int64]:
    """Return numbers of stations or spheres; MeasurementError if one is not whole."""
    values: Any = found.values.get(name, np.full(len(found.lines), float(default)))
    for line, value in zip(found.lines, values, strict=True):
        if value != np.floor(value) or not 0 <= value < 1000:
            raise MeasurementError(found.file, int(line), f"{value:g} is no number of a {name}; 1, 2, … are.")
    return np.asarray(values).astype(np.int64)
