"""Positioning measurements: how far an axis, or one that follows it, is off at targets approached several times.

Deviations are *actual − target* in the unit that small values are shown in: µm, or ″.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..model import shown, symbol
from .columns import ANGLES, LENGTHS, Column, Columns, MeasurementError, of_axis, read_all_columns
from .outliers import Outlier, find_outliers
from .readings import Readings, whole_runs
from .renishaw import is_rtl, read_rtl

_SPAN, _FOLLOWS = 1.0, 0.02
"""Deviations that are the targets but for this share of their span are positions; of smaller spans it is not told."""

TARGET_DIGITS = 6
"""Targets that agree to so many decimals of 1 mm or 1° are one."""

COLUMNS = (
    Column(
        "target", LENGTHS | ANGLES, "mm", aliases=("position", "setpoint", "nominal", "soll", "sollposition", "ziel")
    ),
    Column("run", aliases=("cycle", "lauf", "zyklus")),
    Column("direction", direction=True, aliases=("richtung",)),
    Column("deviation", LENGTHS | ANGLES, "um", aliases=("error", "abweichung"), spread=True),
    Column(
        "actual",
        LENGTHS | ANGLES,
        "mm",
        optional=True,
        aliases=("measured", "ist", "istposition"),
        instead_of="deviation",
        spread=True,
    ),
)


@dataclass(frozen=True, eq=False)
class Positioning(Readings):
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

    def outliers(self) -> tuple[Outlier, ...]:
        """Return the readings that stand apart from those of the same target and direction."""
        targets, target = np.unique(np.round(self.targets, TARGET_DIGITS), return_inverse=True)
        down = self.directions < 0

        def named(i: int) -> str:
            return f"target {self.targets[i]:g} {symbol(self.unit)} {'↓' if down[i] else '↑'}"

        runs, over = 2 * self.runs + down, np.column_stack([down, self.targets])
        found = find_outliers(
            target + len(targets) * down, runs, self.deviations, named, self.deviation_unit, over=over
        )
        return tuple(replace(one, run=int(self.runs[one.place])) for one in found)

    def without(self, outliers: Sequence[Outlier]) -> Positioning:
        """Return the measurement without some readings."""
        return self.only(~np.isin(np.arange(len(self.runs)), [one.place for one in outliers]))

    def with_deviations(self, deviations: Array) -> Positioning:
        """Return the measurement with other deviations, (n,)."""
        return replace(self, deviations=deviations)


def read_positioning(path: str | Path, axis: str = "", *, of_another_axis: bool = False) -> Positioning:
    """Read a measurement: see ``read_positionings``; ``axis``: the one that is meant where there are several.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it; it names file and line.
    """
    return of_axis(read_positionings(path, of_another_axis=of_another_axis), axis, str(path))


def read_positionings(path: str | Path, *, of_another_axis: bool = False) -> tuple[Positioning, ...]:
    """Read all measurements in a file, one for each axis.

    Renishaw ``.rtl``, else tables with ``target, run, direction`` and ``deviation`` or ``actual``, or with one column a
    run. ``of_another_axis``: not the axis at the targets deviates but one that follows it; targets may then be angles
    and deviations lengths.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it; it names file and line.
    """
    path = Path(path)
    if is_rtl(path):
        readings, details = read_rtl(path)
        return (Positioning(*readings, axis=details.get("axis", ""), source=str(path), details=details),)
    return tuple(_from_columns(columns, of_another_axis) for columns in read_all_columns(path, COLUMNS))


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
    given = "actual" if "actual" in columns.values else "deviation"
    rotary = angular(columns, "target", *(() if of_another_axis else (given,)))
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
        _deviations(columns, of_another_axis),
        unit_of(rotary),
        columns.details.get("axis", ""),
        columns.file,
        columns.details,
        unit_of(angular(columns, given)) if of_another_axis else "",
    )


def _deviations(columns: Columns, of_another_axis: bool) -> Array:
    """Return actual − target in µm or ″; MeasurementError where they are the actual positions themselves."""
    targets = columns.values["target"]
    if "actual" in columns.values:
        if of_another_axis:
            sentence = (
                "Positions of the master do not say where the slave should be: deviations do, not actual positions."
            )
            raise MeasurementError(columns.file, 0, sentence)
        return np.asarray(columns.values["actual"] - targets)
    deviations = columns.values["deviation"]
    units = LENGTHS | ANGLES
    written, at = (columns.values[name] / units[columns.units[name]] for name in ("deviation", "target"))
    span = float(np.ptp(at))
    if len(set(at)) > 2 and span > _SPAN and np.max(np.abs(written - at)) < _FOLLOWS * span:
        sentence = "The deviations follow the targets one to one: if they are positions, the column is called actual."
        raise MeasurementError(columns.file, int(columns.lines[0]), sentence)
    return deviations
