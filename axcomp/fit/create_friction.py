"""Friction compensations from pairs of velocity and motor current or torque."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..kinds import Friction
from ..measurement.columns import Column, read_columns
from ..measurement.positioning import whole_runs
from ..plot.style import labelled
from .creation import (
    LEFT_OUT,
    MEASURED,
    PREDICTED,
    SPREAD_LABELS,
    CannotCreateError,
    Creation,
    Options,
    chosen_points,
    leave_one_run_out,
    spread_figures,
)
from .target_list import TargetList

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VELOCITIES = {
    "mm/s": 1.0,
    "um/s": 1e-3,
    "m/s": 1e3,
    "mm/min": 1.0 / 60.0,
    "m/min": 1e3 / 60.0,
    "deg/s": 1.0,
    "rpm": 6.0,
}
"""Units of velocity, in mm/s or °/s."""

COLUMNS = (
    Column("velocity", VELOCITIES, "mm/s", aliases=("speed",)),
    Column("current", aliases=("torque", "force")),
    Column("run", optional=True, aliases=("cycle",)),
)

UNIT = "drive unit"
_VELOCITY_RESOLUTION = 1e-3
_LEVELS_MAX = 200
_WHOLE_FROM = 100.0
_BIAS_SHOWN = 0.01


@dataclass(frozen=True, eq=False)
class FrictionReadings:
    """What the motor needs at constant velocities.

    Attributes
    ----------
    velocities : array, shape (n,)
        With sign, mm/s or °/s.
    currents : array, shape (n,)
        With sign, in the unit the drive takes the additional current in.
    runs : array of int, shape (n,)
        1 everywhere if there is one run only.
    source : str
        The file.
    """

    velocities: Array
    currents: Array
    runs: npt.NDArray[np.int64]
    source: str = ""

    def only(self, chosen: npt.NDArray[np.bool_]) -> FrictionReadings:
        """Return some of the readings."""
        return replace(self, velocities=self.velocities[chosen], currents=self.currents[chosen], runs=self.runs[chosen])


def read_friction_readings(path: str | Path) -> FrictionReadings:
    """Read a table with ``velocity, current`` (or ``torque``) and, if there are several, ``run``.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it.
    """
    columns = read_columns(Path(path), COLUMNS)
    return FrictionReadings(columns.values["velocity"], columns.values["current"], whole_runs(columns), columns.file)


def create_friction(readings: FrictionReadings, target: TargetList, options: Options | None = None) -> Creation:
    """Make a friction table: the current over the amount of the velocity, the mean of both directions.

    The factor that the list has already (``scaling_factor``) stays, and the table is divided by it.

    Raises
    ------
    CannotCreateError
        There is no reading in motion, the table does not fit, or the factor is 0.
    """
    options = options or Options()
    scaling = target.values.converted("frict_comp.scaling_factor")
    if scaling == 0.0:
        raise CannotCreateError("frict_comp.scaling_factor of the list is 0: no table has an effect")
    moving = readings.velocities != 0.0
    if not moving.any():
        raise CannotCreateError("there is no reading in motion")
    capacity = options.max_points or target.capacity("frict_comp.max_points")
    moved = readings.only(moving)
    resolution = _resolution(moved.currents / scaling)

    def make(some: FrictionReadings) -> tuple[Array, Array]:
        speeds, currents = _levels(some)
        step = resolution * abs(scaling)
        places = chosen_points(speeds, currents[None, :], capacity, options.bound, UNIT, 0.5 * step)
        return speeds[places], np.round(currents[places] / scaling / resolution) * resolution * scaling

    def left(table: tuple[Array, Array], some: FrictionReadings) -> Array:
        return some.currents - np.sign(some.velocities) * np.interp(np.abs(some.velocities), *table)

    table = make(moved)
    figures = {MEASURED: spread_figures(moved.currents), PREDICTED: spread_figures(left(table, moved))}
    held_out = leave_one_run_out(moved.runs, lambda some, others: left(make(moved.only(some)), moved.only(others)))
    notes = [*target.notes("friction"), *_notes(readings, moved)]
    if held_out is None:
        notes.append("With one run there is no check by leaving runs out.")
    else:
        figures[LEFT_OUT] = spread_figures(held_out)
    speeds, currents = _levels(moved)
    compensation = Friction(
        tuple(table[0].tolist()),
        tuple((np.round(table[1] / scaling / resolution) * resolution).round(9).tolist()),
        scaling,
    )
    return Creation(
        kind="friction",
        compensation=compensation,
        path=target.path,
        data=target.with_compensation("friction", compensation, options.max_points),
        points=len(table[0]),
        capacity=capacity,
        deviation=float(np.max(np.abs(np.interp(speeds, *table) - currents))),
        unit=UNIT,
        figures=figures,
        labels=SPREAD_LABELS,
        notes=tuple(notes),
        draw=lambda ax: _draw(ax, moved, table),
    )


def _resolution(currents: Array) -> float:
    """Return what currents are rounded to: whole numbers, as the manual has them, unless these are too coarse."""
    largest = float(np.max(np.abs(currents)))
    return 1.0 if largest >= _WHOLE_FROM or largest == 0.0 else 10.0 ** (math.floor(math.log10(largest)) - 2)


def _levels(readings: FrictionReadings) -> tuple[Array, Array]:
    """Return speeds, ascending, and the mean current at each of them, the directions counting alike."""
    speeds = np.round(np.abs(readings.velocities) / _VELOCITY_RESOLUTION) * _VELOCITY_RESOLUTION
    levels, level = np.unique(np.round(speeds, 9), return_inverse=True)
    if len(levels) > _LEVELS_MAX:
        # A recording rather than a series of levels: levels of equal ratio, as friction changes most at low speed.
        edges = np.geomspace(max(levels[0], _VELOCITY_RESOLUTION), levels[-1], _LEVELS_MAX + 1)
        _, level = np.unique(np.searchsorted(edges[1:-1], speeds), return_inverse=True)
    count = int(level.max()) + 1
    sums, counts = np.zeros((2, count)), np.zeros((2, count))
    side = (readings.velocities < 0.0).astype(int)
    np.add.at(sums, (side, level), readings.currents * np.sign(readings.velocities))
    np.add.at(counts, (side, level), 1.0)
    total = np.zeros(count)
    np.add.at(total, level, speeds)
    speed = total / counts.sum(axis=0)
    speed = np.round(np.round(speed / _VELOCITY_RESOLUTION) * _VELOCITY_RESOLUTION, 9)
    means = np.where(counts > 0.0, sums / np.maximum(counts, 1.0), 0.0)
    current = means.sum(axis=0) / (counts > 0.0).sum(axis=0)
    first = np.concatenate(([True], np.diff(speed) > 0.0))
    return speed[first], current[first]


def _notes(readings: FrictionReadings, moved: FrictionReadings) -> list[str]:
    notes = []
    if len(moved.velocities) < len(readings.velocities):
        notes.append(f"{len(readings.velocities) - len(moved.velocities)} readings at standstill are left out.")
    forward, backward = moved.velocities > 0.0, moved.velocities < 0.0
    if forward.any() and backward.any():
        bias = 0.5 * float(moved.currents[forward].mean() + moved.currents[backward].mean())
        if abs(bias) > _BIAS_SHOWN * float(np.mean(np.abs(moved.currents))):
            notes.append(
                f"There is a constant current of {bias:.3g} beside friction, which no friction table can hold."
            )
    else:
        notes.append("One direction was measured: a weight or a bias of the drive would count as friction.")
    return notes


def _draw(ax: Axes, readings: FrictionReadings, table: tuple[Array, Array]) -> None:
    """Draw readings and table over the speed."""
    speeds, currents = np.abs(readings.velocities), readings.currents * np.sign(readings.velocities)
    ax.plot(speeds, currents, ".", color="0.55", ms=4, label="measured")
    between = np.linspace(0.0, table[0][-1], 4000)
    ax.plot(between, np.interp(between, *table), "-", color="#0b62a4", lw=1.4)
    ax.plot(*table, "o", color="#0b62a4", ms=4, label="table × scaling")
    ax.set_xscale("symlog", linthresh=1.0)
    labelled(ax, "", "|velocity| [mm/s or °/s]", f"current [{UNIT}]")
    ax.legend(loc="best", fontsize=10)
