"""Friction compensations from pairs of velocity and motor current or torque."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..kinds import Friction
from ..measurement import RUN, Column, Readings
from ..plot import labelled
from .creation import CannotCreateError, Report
from .driver import MAX_POINTS, NEW_LIST, Fit, bound

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

UNIT = "drive unit"
_VELOCITY_RESOLUTION = 1e-3
_LEVELS_MAX = 200
_WHOLE_FROM = 100.0
_BIAS_SHOWN = 0.01


@dataclass(frozen=True, eq=False)
class FrictionReadings(Readings):
    """What the motor needs at constant velocities.

    Attributes
    ----------
    velocities : array, shape (n,)
        With sign, mm/s or °/s.
    currents : array, shape (n,)
        With sign, in the unit the drive takes the additional current in.
    """

    velocities: Annotated[Array, Column("velocity", VELOCITIES, "mm/s", aliases=("speed",))]
    currents: Annotated[Array, Column("current", aliases=("torque", "force"))]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    source: str = ""


class FrictionFit(Fit[FrictionReadings, tuple[Array, Array]]):
    """The current over the amount of the velocity, the mean of both directions.

    The factor that the list has already (``scaling_factor``) stays, and the table is divided by it.
    """

    name = "friction"
    counted = "velocities"
    meaning = "friction table from motor currents at constant velocities"
    columns = "columns velocity (mm/s), current, and run where there are several"
    example = "axcomp create friction --from currents.csv --into achskw1.lis --bound 20"
    arguments: ClassVar = {"bound": bound(UNIT, ""), "max-points": MAX_POINTS, **NEW_LIST}
    read = FrictionReadings.read

    def counts_in(self) -> str:
        """Return what the axis is known to count in: velocities of either fit."""
        return self.target.unit or "mm"

    def prepare(self) -> None:
        """Look at the factor of the list, and leave out what stands still."""
        super().prepare()
        self.scaling = self.target.values.converted("frict_comp.scaling_factor")
        if self.scaling == 0.0:
            raise CannotCreateError("frict_comp.scaling_factor of the list is 0: no table has an effect")
        moving = self.readings.velocities != 0.0
        if not moving.any():
            raise CannotCreateError("there is no reading in motion")
        self.standing = int(np.sum(~moving))
        self.readings = self.readings.only(moving)
        self.resolution = _resolution(self.readings.currents / self.scaling)
        self.small, self.lost = UNIT, 0.5 * self.resolution * abs(self.scaling)

    def measured(self, readings: FrictionReadings) -> Array:
        """Return the currents."""
        return readings.currents

    def means(self, readings: FrictionReadings) -> FrictionReadings:
        """Return the mean current at each speed."""
        speeds, currents = _levels(readings)
        return FrictionReadings(speeds, currents, np.ones(len(speeds), dtype=np.int64))

    def table(self, means: FrictionReadings) -> tuple[Array, Array]:
        """Return speeds, and currents as the list's factor makes them of whole steps."""
        places = self.chosen(means.velocities, means.currents[None, :])
        currents = np.round(means.currents[places] / self.scaling / self.resolution)
        return means.velocities[places], currents * self.resolution * self.scaling

    def removed(self, table: tuple[Array, Array], readings: FrictionReadings) -> Array:
        """Return the current against the direction of motion."""
        direction = np.where(readings.velocities < 0.0, -1.0, 1.0)
        return np.asarray(direction * np.interp(np.abs(readings.velocities), *table))

    def compensation(self, table: tuple[Array, Array]) -> Friction:
        """Return the table divided by the factor."""
        steps = np.round(table[1] / self.scaling / self.resolution)
        return Friction(tuple(table[0].tolist()), tuple((steps * self.resolution).round(9).tolist()), self.scaling)

    def report(self, table: tuple[Array, Array]) -> Report:
        """Say what does not count, and what no table can hold, too."""
        standing = f"{self.standing} readings at standstill are left out." if self.standing else ""
        velocities, currents = self.readings.velocities, self.readings.currents
        forward, backward = velocities > 0.0, velocities < 0.0
        shape = ""
        if not (forward.any() and backward.any()):
            shape = "One direction was measured: a weight or a bias of the drive would count as friction."
        else:
            bias = 0.5 * float(currents[forward].mean() + currents[backward].mean())
            if abs(bias) > _BIAS_SHOWN * float(np.mean(np.abs(currents))):
                shape = f"There is a constant current of {bias:.3g} beside friction, which no friction table can hold."
        return super().report(table).noted(standing, shape)

    def draw(self, ax: Axes, table: tuple[Array, Array]) -> None:
        """Draw readings and table over the speed."""
        velocities = self.readings.velocities
        ax.plot(
            np.abs(velocities), self.readings.currents * np.sign(velocities), ".", color="0.55", ms=4, label="measured"
        )
        between = np.linspace(0.0, table[0][-1], 4000)
        ax.plot(between, np.interp(between, *table), "-", color="#0b62a4", lw=1.4)
        ax.plot(*table, "o", color="#0b62a4", ms=4, label="table × scaling")
        ax.set_xscale("symlog", linthresh=1.0)
        labelled(ax, "", "|velocity| [mm/s or °/s]", f"current [{UNIT}]")
        ax.legend(loc="best", fontsize=10)


FIT = FrictionFit


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
    speed = np.bincount(level, speeds) / counts.sum(axis=0)
    speed = np.round(np.round(speed / _VELOCITY_RESOLUTION) * _VELOCITY_RESOLUTION, 9)
    current = (sums / np.maximum(counts, 1.0)).sum(axis=0) / (counts > 0.0).sum(axis=0)
    first = np.concatenate(([True], np.diff(speed) > 0.0))
    return speed[first], current[first]
