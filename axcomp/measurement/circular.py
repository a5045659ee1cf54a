"""Circular tests: paths of a ball-bar or a grid encoder, clockwise and counter-clockwise.

A table has ``angle`` (°) and ``deviation`` (of the radius, µm), or ``time`` (s) and ``deviation``, or ``x`` and ``y``
(mm); ``direction`` (+ counter-clockwise, −) and ``run`` may be there. Comments say what else there is to know:
``# radius: 100`` (mm), ``# feed: 1000`` (mm/min), ``# start: 0`` (°), ``# direction: -``, ``# plane: XY``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..engine import Array, SheetError, read_sheets
from ..model import shown
from .columns import ANGLES, LENGTHS, Column, Columns, MeasurementError, read_columns
from .readings import RUN, whole_runs

_DIRECTION = Column("direction", direction=True, optional=True)
_DEVIATION = Column("deviation", LENGTHS, "um", aliases=("radial", "radial_deviation", "error"))
_KINDS = {
    "x": (Column("x", LENGTHS, "mm"), Column("y", LENGTHS, "mm"), _DIRECTION, RUN),
    "angle": (Column("angle", ANGLES, "deg", aliases=("theta",)), _DEVIATION, _DIRECTION, RUN),
    "time": (Column("time", {"s": 1.0, "ms": 1e-3}, "s"), _DEVIATION, _DIRECTION, RUN),
}
_WORDS = {"-": -1, "−": -1, "cw": -1, "+": 1, "ccw": 1}
LEAST = 16
"""Points of a path."""


@dataclass(frozen=True, eq=False)
class CircularPath:
    """A path once round, or a part of it.

    Attributes
    ----------
    direction : int
        1 counter-clockwise, −1 clockwise.
    points : array, shape (n, 2)
        In the order they were passed, mm.
    source : str
    """

    direction: int
    points: Array
    source: str


@dataclass(frozen=True, eq=False)
class CircularTest:
    """Paths of one circle; ``radius``: nominal, mm; ``feed``: mm/s, None if unknown; ``axes``: names of x and y."""

    paths: tuple[CircularPath, ...]
    radius: float
    feed: float | None = None
    axes: tuple[str, str] = ("X", "Y")

    @property
    def source(self) -> str:
        """The files."""
        return ", ".join(dict.fromkeys(path.source for path in self.paths))


def is_circular(path: str | Path) -> bool:
    """Tell whether the first row names the columns of a circular test."""
    return bool(_kind(Path(path)))


def _kind(path: Path) -> str:
    """Return the column that tells the points of a circular test apart, "" where the file is none."""
    try:
        sheets = read_sheets(path)
    except SheetError:
        return ""
    cells = sheets[0].rows[0].cells if sheets else ()
    names = {re.split(r"[\[(]", cell)[0].strip().lower().replace(" ", "_") for cell in cells}
    names = {re.sub(r"_(mm|deg|um|s)\Z", "", name) for name in names}
    if {"x", "y"} <= names and not names & {"z", "dx"}:
        return "x"
    if not names & {"deviation", "radial", "radial_deviation", "error"} or names & {"target", "position", "setpoint"}:
        return ""
    return "angle" if names & {"angle", "theta"} else "time" if "time" in names else ""


def read_circular(path: str | Path, radius: float | None = None, feed: float | None = None) -> CircularTest:
    """Read a test; MeasurementError, with file and line, if it cannot be.

    ``radius``: nominal, mm, ``feed``: mm/min; both where the file does not say them in a comment.
    """
    file = str(path)
    kind = _kind(Path(path))
    if not kind:
        sentence = "This is no circular test: it has the columns angle or time and deviation, or x and y."
        raise MeasurementError(file, 0, sentence)
    found = read_columns(Path(path), _KINDS[kind])
    radius = _detail(found, "radius") if radius is None else radius
    feed = _detail(found, "feed") if feed is None else feed
    if radius is None and kind == "x":
        points = np.column_stack([found.values["x"], found.values["y"]])
        radius = float(np.round(np.ptp(points, axis=0).mean() / shown("mm").factor / 2.0, 0))
    if radius is None or not radius > 0.0:
        sentence = "The nominal radius is not known: “# radius: 100” (mm) in the file, or --radius, says it."
        raise MeasurementError(file, 0, sentence)
    given = _WORDS.get(found.details.get("direction", "").strip().lower(), 0)
    directions = found.values.get("direction", np.full(len(found.lines), float(given)))
    runs = whole_runs(found)
    paths, change = [], np.flatnonzero((np.diff(directions) != 0.0) | (np.diff(runs) != 0)) + 1
    for rows in np.split(np.arange(len(runs)), change):
        paths += _paths(found, kind, rows, radius, None if feed is None else feed / 60.0, int(directions[rows[0]]))
    plane = found.details.get("plane", "XY").strip().upper()
    axes = (plane[0], plane[1]) if len(plane) == 2 else ("X", "Y")
    return CircularTest(tuple(paths), radius, None if feed is None else feed / 60.0, axes)


def joined_tests(tests: Sequence[CircularTest]) -> CircularTest:
    """Return several files as one test; MeasurementError if they are of different circles."""
    first = tests[0]
    for other in tests[1:]:
        if (other.radius, other.axes) != (first.radius, first.axes):
            raise MeasurementError(other.source, 0, f"It is another circle than that of {first.source}.")
    return replace(first, paths=tuple(path for test in tests for path in test.paths))


def _paths(
    found: Columns, kind: str, rows: npt.NDArray[np.int64], radius: float, feed: float | None, given: int
) -> list[CircularPath]:
    values, line = found.values, int(found.lines[rows[0]])
    if len(rows) < LEAST:
        raise MeasurementError(found.file, line, f"A path of {len(rows)} points; at least {LEAST} are needed.")
    if kind == "x":
        points = np.column_stack([values["x"], values["y"]])[rows] / shown("mm").factor
        middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        angle = np.unwrap(np.arctan2(*(points - middle).T[::-1]))
    elif kind == "angle":
        angle = np.radians(values["angle"][rows] / shown("deg").factor)
    else:
        if feed is None:
            sentence = "Times need the feed: “# feed: 1000” (mm/min) in the file, or --feed, says it."
            raise MeasurementError(found.file, line, sentence)
        if not given:
            sentence = "Times do not say the direction: a column direction or “# direction: -” does."
            raise MeasurementError(found.file, line, sentence)
        start = np.radians(_detail(found, "start") or 0.0)
        angle = start + given * feed / radius * (values["time"][rows] - values["time"][rows[0]])
    unwrapped = np.unwrap(angle)
    turned = float(unwrapped[-1] - unwrapped[0])
    if given and turned * given < 0.0:
        raise MeasurementError(found.file, line, "The points go round the other way than the direction says.")
    if kind != "x":
        around = radius + values["deviation"][rows] / shown("mm").factor
        points = np.column_stack([around * np.cos(angle), around * np.sin(angle)])
    return [CircularPath(given or (1 if turned > 0.0 else -1), points, found.file)]


def _detail(found: Columns, name: str) -> float | None:
    words = found.details.get(name, "").replace(",", ".").split()
    try:
        return float(words[0]) if words else None
    except ValueError:
        raise MeasurementError(found.file, 0, f"“{words[0]}” is no number, as {name} has to be.") from None
