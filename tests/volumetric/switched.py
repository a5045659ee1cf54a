"""A running machine whose volumetric compensations are switched, and what it does then."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from rigid_bodies import machine_of, volumetric, with_constant_errors

from axcomp.model import Machine, Volumetric
from axcomp.runtime import Runtime

SHIFTS = {"X0X": 0.01, "Y0Y": 0.02, "Z0Z": -0.04}
VALUES = np.array([-0.01, -0.02, 0.04])
N = 20


def shifted(**parameters: Any) -> Volumetric:
    """Return a compensation that adds ``VALUES`` everywhere."""
    return with_constant_errors(volumetric("CXYZ", **parameters), SHIFTS)


def doubled(**parameters: Any) -> Volumetric:
    """Return a compensation that adds twice ``VALUES``."""
    return with_constant_errors(volumetric("CXYZ", **parameters), {name: 2 * value for name, value in SHIFTS.items()})


def smooth(steps: NDArray[np.int64], n: int = N) -> NDArray[np.float64]:
    u = np.clip(steps / n, 0, 1)
    return 10 * u**3 - 15 * u**4 + 6 * u**5


class Bench:
    """A running machine: ``run`` returns total offsets, corrections and shifts of X, Y, Z over some cycles."""

    def __init__(self, *compensations: Volumetric, machine: Machine | None = None) -> None:
        self.runtime = Runtime(machine or machine_of(*compensations))
        self.inputs = self.runtime.inputs
        self.given = self.inputs.volumetric

    def run(self, cycles: int = 1) -> NDArray[np.float64]:
        rows = []
        for _ in range(cycles):
            self.runtime.cycle()
            axes = zip(self.runtime.outputs.axis[:3], self.inputs.axis, strict=False)
            rows.append([axis.corrected_setpoint - given.setpoint for axis, given in axes])
        return np.array(rows)

    def set_factors(self, x: float, y: float, z: float) -> None:
        given = self.given[0]
        given.reduction_x, given.reduction_y, given.reduction_z = 1.0 - x, 1.0 - y, 1.0 - z

    @property
    def corrections(self) -> list[float]:
        return [axis.volumetric_correction for axis in self.runtime.outputs.axis[:3]]

    @property
    def shifts(self) -> list[float]:
        return [axis.setpoint_shift for axis in self.runtime.outputs.axis[:3]]

    @property
    def errors(self) -> list[int]:
        return [axis.error for axis in self.runtime.outputs.axis]

    @property
    def stops(self) -> list[bool]:
        return [axis.stop_request for axis in self.runtime.outputs.axis]

    def active(self, index: int = 0) -> bool:
        return self.runtime.outputs.volumetric[index].active
