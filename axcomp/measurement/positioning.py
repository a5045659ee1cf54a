"""Positioning measurements: how far an axis, or one that follows it, is off at targets approached several times.

Deviations are *actual − target* in thousandths of the axis' unit: µm, or 0.001°.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from .columns import ANGLES, LENGTHS, Column, Columns, MeasurementError, read_columns
from .motion import Array
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
    """Readings at targets, in any order.

    Attributes
    ----------
    targets : array, shape (n,)
        Where each reading was taken, mm or °.
    runs : array of int, shape (n,)
        Number of the run, counted from 1 in each direction.
    directions : array of int, shape (n,)
        1 or −1: from which side the target was approached.
    deviations : array, shape (n,)
        Actual − target, µm or 0.001°.
    unit : str
        Of the targets: ``mm`` or ``deg``.
    axis : str
        Its name, "" if the file does not say.
    source : str
        The file or files.
    details : mapping of str to str
        What else the file says about the measurement.
    """

    targets: Array
    runs: npt.NDArray[np.int64]
    directions: npt.NDArray[np.int64]
    deviations: Array
    unit: str = "mm"
    axis: str = ""
    source: str = ""
    details: Mapping[str, str] = field(default_factory=dict)

    @property
    def deviation_unit(self) -> str:
        """Unit of the deviations and of everything computed from them."""
        return "µm" if self.unit == "mm" else "0.001°"

    def grid(self) -> tuple[Array, npt.NDArray[np.int64], Array]:
        """Return targets (m,), runs (k,) and deviations (2, m, k): first positive direction, NaN where nothing is."""
        targets, place = np.unique(np.round(self.targets, TARGET_DIGITS), return_inverse=True)
        runs, run = np.unique(self.runs, return_inverse=True)
        deviations = np.full((2, len(targets), len(runs)), np.nan)
        deviations[(self.directions < 0).astype(int), place, run] = self.deviations
        return targets, runs, deviations

    def only(self, chosen: npt.NDArray[np.bool_]) -> Positioning:
        """Return the measurement with some of its readings."""
        return self.with_deviations(self.deviations, chosen)

    def with_deviations(self, deviations: Array, chosen: npt.NDArray[np.bool_] | None = None) -> Positioning:
        """Return the measurement with other deviations, (n,)."""
        keep = np.ones(len(self.targets), dtype=bool) if chosen is None else chosen
        return Positioning(
            self.targets[keep],
            self.runs[keep],
            self.directions[keep],
            deviations[keep],
            self.unit,
            self.axis,
            self.source,
            self.details,
        )


def read_positioning(path: str | Path) -> Positioning:
    """Read a measurement: Renishaw ``.rtl``, else a table with ``target, run, direction, deviation``.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it; it names the place.
    """
    path = Path(path)
    if is_rtl(path):
        linear = read_rtl(path)
        return Positioning(
            linear.targets,
            linear.runs,
            linear.directions,
            linear.deviations,
            axis=linear.details.get("axis", ""),
            source=str(path),
            details=linear.details,
        )
    return _from_columns(read_columns(path, COLUMNS))


def joined(measurements: Sequence[Positioning]) -> Positioning:
    """Return several measurements of one axis as one; the runs of later ones are counted on.

    Raises
    ------
    MeasurementError
        They are not of the same unit.
    """
    first = measurements[0]
    runs, last = [], 0
    for measurement in measurements:
        if measurement.unit != first.unit:
            raise MeasurementError(
                measurement.source,
                0,
                f"Its targets are in {measurement.unit}, those of {first.source} in {first.unit}.",
            )
        runs.append(measurement.runs + last)
        last += int(measurement.runs.max())
    return Positioning(
        np.concatenate([m.targets for m in measurements]),
        np.concatenate(runs),
        np.concatenate([m.directions for m in measurements]),
        np.concatenate([m.deviations for m in measurements]),
        first.unit,
        first.axis,
        ", ".join(dict.fromkeys(m.source for m in measurements)),
        first.details,
    )


def whole_runs(columns: Columns) -> npt.NDArray[np.int64]:
    """Return the column ``run``, 1 everywhere where there is none; MeasurementError if a run is no whole number."""
    runs = columns.values.get("run", np.ones(len(columns.lines)))
    for line, run in zip(columns.lines, runs, strict=True):
        if run != np.floor(run) or not 0 <= run < 10**6:
            raise MeasurementError(columns.file, int(line), f"{run:g} is no number of a run; 1, 2, … are.")
    return runs.astype(np.int64)


def angular(columns: Columns, *names: str) -> bool:
    """Tell whether columns are angles; MeasurementError if some are lengths and some angles."""
    kinds = {name: columns.units[name] in ANGLES for name in names if name in columns.units}
    if len(set(kinds.values())) > 1:
        units = ", ".join(f"{name} in {columns.units[name]}" for name in kinds)
        raise MeasurementError(columns.file, 0, f"Lengths do not go with angles: {units}.")
    return any(kinds.values())


def _from_columns(columns: Columns) -> Positioning:
    runs = whole_runs(columns)
    rotary = angular(columns, "target", "deviation")
    targets = columns.values["target"] * 1e-3
    directions = columns.values["direction"].astype(np.int64)
    seen: dict[tuple[float, int, int], int] = {}
    for *key, line in zip(np.round(targets, TARGET_DIGITS), runs, directions, columns.lines, strict=True):
        place = (float(key[0]), int(key[1]), int(key[2]))
        if place in seen:
            sentence = f"Target {place[0]:g} of run {place[1]} is there already, in line {seen[place]}."
            raise MeasurementError(columns.file, int(line), sentence)
        seen[place] = int(line)
    return Positioning(
        targets,
        runs,
        directions,
        columns.values["deviation"],
        "deg" if rotary else "mm",
        columns.details.get("axis", ""),
        columns.file,
        columns.details,
    )
