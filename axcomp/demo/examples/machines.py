"""The example machines as they are commissioned: which compensations there are, and where they are measured.

The values come from measurements on the plant (``measurement.simulated``), rounded to the resolution of the lists.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from ...kinds import Cross, Crosstalk, CrosstalkCurve, CrosstalkTest, Friction, Leadscrew, Plane
from ...model import Axis, AxisType, Machine, ModuloRange
from ...plant import Plant, acceleration_test, flatness, friction_current, positioning, straightness
from .five_axis import five_axis

X, Y, Z, C = 1, 2, 3, 6
"""Logical axis numbers."""

_SLOW = (0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
VELOCITIES = (*_SLOW, 15.0, 20.0, 50.0, 100.0, 200.0, 300.0, 400.0, 500.0)
"""Of the friction measurement, mm/s or °/s; the drives' friction is least between 5 and 10."""


def three_axis(plant: Plant) -> Machine:
    """Return X, Y, Z with all five kinds of compensation, measured on ``models/three_axis``."""
    x = Axis(
        X,
        "X",
        backlash_cycles=20,
        plane=Plane(
            master1=Y,
            master2=Z,
            start1=-300.0,
            start2=-400.0,
            interval1=6.0,
            interval2=4.0,
            corrections=tuple(
                _listed(-d for d in row)
                for row in flatness(plant, "X", ("Y", "Z"), _steps(-300.0, 6.0, 101), _steps(-400.0, 4.0, 101))
            ),
            n_cycles=10,
        ),
        leadscrew=_leadscrew(plant, "X", _worn_screw(140, 500.0), bilateral=True, without_other=True),
        friction=_friction(plant, "X"),
    )
    y = Axis(
        Y,
        "Y",
        crosstalk=_crosstalk_over_xz(plant),
        leadscrew=_leadscrew(plant, "Y", _steps(-300.0, 10.0, 61)),
        friction=_friction(plant, "Y"),
    )
    sag_at = _steps(-500.0, 20.0, 51)
    accelerations = (-3000.0, -1500.0, 0.0, 1500.0, 3000.0)
    z = Axis(
        Z,
        "Z",
        cross=Cross(
            master=X,
            positions=tuple(sag_at),
            corrections=_listed(-d for d in straightness(plant, "Z", "X", sag_at)),
            n_cycles=10,
        ),
        crosstalk=CrosstalkCurve(
            master=Y,
            accelerations=accelerations,
            corrections=_listed(
                -acceleration_test(plant, "Z", "Y", {"Z": -200.0}, a, 1) if a else 0.0 for a in accelerations
            ),
            n_cycles=10,
        ),
        leadscrew=_leadscrew(plant, "Z", _steps(-400.0, 10.0, 41)),
        friction=_friction(plant, "Z"),
    )
    return Machine((x, y, z))


def rotary_table(plant: Plant) -> Machine:
    """Return a modulo axis C, measured on ``models/rotary_table``."""
    positions = _steps(0.0, 5.0, 73)
    c = Axis(
        C,
        "C",
        AxisType.ROTARY,
        ModuloRange(0.0, 360.0),
        backlash_cycles=10,
        leadscrew=_leadscrew(plant, "C", positions, bilateral=True, modulo=True),
        friction=_friction(plant, "C"),
    )
    return Machine((c,))


MACHINES: dict[str, Callable[[Plant], Machine]] = {f.__name__: f for f in (three_axis, rotary_table, five_axis)}
"""The models whose lists are measured, by the name of their folder."""


def _listed(values: Iterable[float]) -> tuple[float, ...]:
    """Round to the resolution of the lists, 0.1 µm or 0.0001°."""
    return tuple(round(value, 4) + 0.0 for value in values)


def _steps(start: float, interval: float, count: int) -> list[float]:
    return [round(start + i * interval, 4) for i in range(count)]


def _worn_screw(count: int, end: float) -> list[float]:
    """Return interpolation points from −end to end, closest in the middle where the screw is used most."""
    u = np.linspace(-1.0, 1.0, count)
    return [round(float(q), 4) for q in end * (u - 0.12 * np.sin(np.pi * u))]


def _leadscrew(
    plant: Plant,
    name: str,
    positions: Sequence[float],
    *,
    bilateral: bool = False,
    modulo: bool = False,
    without_other: bool = False,
) -> Leadscrew:
    return Leadscrew(
        positions=tuple(positions),
        positive=_listed(positioning(plant, name, positions, 1)),
        negative=_listed(positioning(plant, name, positions, -1)) if bilateral else None,
        modulo=modulo,
        without_other_compensations=without_other,
    )


def _friction(plant: Plant, name: str) -> Friction:
    return Friction(
        velocities=VELOCITIES,
        currents=tuple(float(round(friction_current(plant, name, v))) for v in VELOCITIES),
        position_delay=0.0005,
        reversal_lookahead=1,
        delay_cycles=1,
    )


def _crosstalk_over_xz(plant: Plant) -> Crosstalk:
    """Y while X accelerates, at three positions of X and of Z each."""
    acceleration = 2500.0

    def test(x: float, z: float) -> CrosstalkTest:
        corrections = _listed(
            -acceleration_test(plant, "Y", "X", {"X": x, "Z": z}, a, direction)
            for a in (acceleration, -acceleration)
            for direction in (1, -1)
        )
        return CrosstalkTest(x, z, *corrections)

    return Crosstalk(
        master=X,
        acceleration=acceleration,
        deceleration=-acceleration,
        mode=3,
        tests=tuple(test(x, z) for z in (-400.0, -200.0, 0.0) for x in (-400.0, 0.0, 400.0)),
        adaptation1=X,
        adaptation2=Z,
        velocity_dependent=True,
        n_cycles=10,
    )
