"""Positioning measurements: how far an axis, or one that follows it, is off at targets approached several times.

Deviations are *actual − target* in the unit that small values are shown in: µm, or ″.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..model.quantity import shown
from .columns import ANGLES, LENGTHS, Column, Columns, MeasurementError, read_columns
from .renishaw import is_rtl, read_rtl

TARGET_DIGITS = 6
"""Targets that agree to so many decimals of 1 mm or 1° are one."""

COLUMNS = (
    Column("target", LENGTHS | ANGLES, "mm", aliases=("position", "setpoint")),
    Column("run", aliases=("cycle",)),
    Column("direction", direction=True),
    Column("deviation", LENGTHS | ANGLES, "um", aliases=("error",)),
)


@dataclass(frozen=True, eq=False)
class Positioning:
    """Readings at targets, in any order; arrays have shape (n,).

    ``targets``: where each reading was taken, in ``unit``, ``mm`` or ``deg``; ``runs``: number of the run, counted from
    1 in each direction; ``directions``: 1 or −1, from which side the target was approached; ``deviations``: actual −
    target, µm or ″. ``axis`` is its name, "" if the file does not say, ``source`` the file or files, ``details`` what
    else the file says. Where another axis than the one at the targets deviates, ``deviating_unit`` is what that one
    counts in; else "".
    """

    targets: Array
    runs: npt.NDArray[np.int64]
    directions: npt.NDArray[np.int64]
    deviations: Array
    unit: str = "mm"
    axis: str = ""
    source: str = ""
    details: Mapping[str, str] = field(default_factory=dict)
    deviating_unit: str = ""

    @property
    def deviation_unit(self) -> str:
        """Unit of the deviations and of everything computed from them."""
        return shown(self.deviating).unit

    @property
    def deviating(self) -> str:
        """What the axis that deviates counts in: ``mm`` or ``deg``."""
        return self.deviating_unit or self.unit

    def grid(self) -> tuple[Array, npt.NDArray[np.int64], Array]:
        """Return targets (m,), runs (k,) and deviations (2, m, k): first positive direction, NaN where nothing is."""
        targets, target = np.unique(np.round(self.targets, TARGET_DIGITS), return_inverse=True)
        runs, run = np.unique(self.runs, return_inverse=True)
        deviations = np.full((2, len(targets), len(runs)), np.nan)
        deviations[(self.directions < 0).astype(int), target, run] = self.deviations
        return targets, runs, deviations

    def only(self, chosen: npt.NDArray[np.bool_]) -> Positioning:
        """Return the measurement with some of its readings."""
        return self.with_deviations(self.deviations, chosen)

    def with_deviations(self, deviations: Array, chosen: npt.NDArray[np.bool_] | None = None) -> Positioning:
        """Return the measurement with other deviations, (n,)."""
        keep = np.ones(len(self.targets), dtype=bool) if chosen is None else chosen
        return replace(
            self,
            targets=self.targets[keep],
            runs=self.runs[keep],
            directions=self.directions[keep],
            deviations=deviations[keep],
        )


def read_positioning(path: str | Path, *, of_another_axis: bool = False) -> Positioning:
    """Read a measurement: Renishaw ``.rtl``, else a table with ``target, run, direction, deviation``.

    ``of_another_axis``: not the axis at the targets deviates but one that follows it; targets may then be angles and
    deviations lengths.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it; it names file and line.
    """
    path = Path(path)
    if is_rtl(path):
        readings, details = read_rtl(path)
        return Positioning(*readings, axis=details.get("axis", ""), source=str(path), details=details)
    return _from_columns(read_columns(path, COLUMNS), of_another_axis)


class InRuns(Protocol):
    """A measurement: a dataclass of arrays with one element a reading, and of what these have in common."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def runs(self) -> npt.NDArray[np.int64]:
        """Run of each reading."""

    @property
    def source(self) -> str:
        """The file or files."""


Measurement = TypeVar("Measurement", bound=InRuns)


def joined(measurements: Sequence[Measurement]) -> Measurement:
    """Return several measurements of the same as one; the runs of later ones are counted on.

    Raises
    ------
    MeasurementError
        They are not of the same unit.
    """
    first = measurements[0]
    names = [item.name for item in fields(first)]
    for other in measurements[1:]:
        for name in names:
            if name.endswith("unit") and getattr(other, name) != getattr(first, name):
                sentence = f"It is in {getattr(other, name)}, {first.source} in {getattr(first, name)}."
                raise MeasurementError(other.source, 0, sentence)
    arrays = [name for name in names if isinstance(getattr(first, name), np.ndarray)]
    stacked: dict[str, Any] = {name: np.concatenate([getattr(m, name) for m in measurements]) for name in arrays}
    passed = np.cumsum([0, *(m.runs.max() for m in measurements[:-1])])
    stacked["runs"] = np.concatenate([m.runs + n for m, n in zip(measurements, passed, strict=True)])
    stacked["source"] = ", ".join(dict.fromkeys(m.source for m in measurements))
    return replace(first, **stacked)


def whole_runs(columns: Columns) -> npt.NDArray[np.int64]:
    """Return the column ``run``, 1 everywhere where there is none; MeasurementError if a run is no whole number."""
    runs = columns.values.get("run", np.ones(len(columns.lines)))
    for line, run in zip(columns.lines, runs, strict=True):
        if run != np.floor(run) or not 0 <= run < 10**6:
            raise MeasurementError(columns.file, int(line), f"{run:g} is no number of a run; 1, 2, … are.")
    return runs.astype(np.int64)


def unit_of(rotary: bool) -> str:
    """Return what a rotary or a translatory axis counts in."""
    return "deg" if rotary else "mm"


def angular(columns: Columns, *names: str) -> bool:
    """Tell whether columns are angles; MeasurementError if some are lengths and some angles."""
    kinds = {name: columns.units[name] in ANGLES for name in names if name in columns.units}
    if len(set(kinds.values())) > 1:
        units = ", ".join(f"{name} in {columns.units[name]}" for name in kinds)
        raise MeasurementError(columns.file, 0, f"Lengths do not go with angles: {units}.")
    return any(kinds.values())


def _from_columns(columns: Columns, of_another_axis: bool) -> Positioning:
    runs = whole_runs(columns)
    rotary = angular(columns, "target", *(() if of_another_axis else ("deviation",)))
    targets = columns.positions("target")
    directions = columns.values["direction"].astype(np.int64)
    seen: dict[tuple[float, int, int], int] = {}
    for *reading, line in zip(np.round(targets, TARGET_DIGITS), runs, directions, columns.lines, strict=True):
        first = seen.setdefault((reading[0], reading[1], reading[2]), line)
        if first != line:
            sentence = f"Target {reading[0]:g} of run {reading[1]} is there already, in line {first}."
            raise MeasurementError(columns.file, int(line), sentence)
    return Positioning(
        targets,
        runs,
        directions,
        columns.values["deviation"],
        unit_of(rotary),
        columns.details.get("axis", ""),
        columns.file,
        columns.details,
        unit_of(angular(columns, "deviation")) if of_another_axis else "",
    )
