"""Machines with one of everything, small enough to check by hand."""

from __future__ import annotations

import numpy as np

from axcomp.kinds import Cross, Crosstalk, CrosstalkCurve, CrosstalkTest, Friction, Leadscrew, Plane
from axcomp.model import Axis, AxisType, ErrorTable, Machine, ModuloRange, Volumetric

SCREW = Leadscrew((0.0, 10.0, 40.0), (0.0, 0.004, -0.002), (0.001, 0.006, 0.001))
PLANE = Plane(2, 3, -10.0, 5.0, 10.0, 20.0, ((0.0, 0.01, 0.02), (0.004, -0.01, 0.0)))
SCATTERED = ((-200.0, 0.0), (100.0, 50.0), (0.0, 200.0), (250.0, -100.0), (60.0, -150.0))


def _test(position1: float, position2: float, *um: float) -> CrosstalkTest:
    return CrosstalkTest(position1, position2, *(value * 1e-3 for value in um))


ONE_TEST = Crosstalk(2, 3000.0, -2500.0, 1, (_test(0, 0, 12, 10, -9, -8),), velocity_dependent=True)
LINE = Crosstalk(
    1,
    3000.0,
    -2500.0,
    2,
    tuple(_test(p, 0, p, 1, -p, 2) for p in (-50.0, 0.0, 80.0)),
    adaptation1=3,
    velocity_dependent=True,
)
SURFACE = Crosstalk(
    1,
    3000.0,
    -2500.0,
    3,
    tuple(_test(p, q, p / 50 + q * q / 4000, 0, p, 0) for p, q in SCATTERED),
    adaptation1=1,
    adaptation2=2,
)
MACHINE = Machine(
    (
        Axis(1, "X", leadscrew=SCREW, plane=PLANE, crosstalk=ONE_TEST),
        Axis(2, "Y", cross=Cross(1, (0.0, 100.0), (0.0, 0.02)), crosstalk=LINE),
        Axis(3, "Z", friction=Friction((1.0, 10.0, 100.0), (300.0, 250.0, 400.0), scaling=0.5), crosstalk=SURFACE),
        Axis(4, "W", crosstalk=CrosstalkCurve(1, (-1000.0, 0.0, 2000.0), (-0.002, 0.0, 0.005))),
        Axis(
            5,
            "C",
            AxisType.ROTARY,
            ModuloRange(),
            leadscrew=Leadscrew((0.0, 90.0, 180.0, 270.0), (0.0, 0.001, 0.003, 0.002), modulo=True),
        ),
    )
)


def table(name: str, argument: str, places: list[float], values: list[float]) -> ErrorTable:
    return ErrorTable(name, tuple(values), argument, tuple((place,) for place in places))


X_GRID, Y_GRID = np.linspace(-100.0, 100.0, 3).tolist(), np.linspace(-50.0, 50.0, 3).tolist()
VOLUMETRIC = Volumetric(
    0,
    (("X", 1), ("Y", 2), ("Z", 3)),
    "YXZ",
    errors=(
        table("EXX", "X", [-100.0, 0.0, 100.0], [-0.01, 0.0, 0.02]),
        table("EYX", "X", [-100.0, 100.0], [0.003, 0.001]),
        table("ECX", "X", [-100.0, 100.0], [-2e-5, 3e-5]),
        table("EZZ", "Z", [0.0, 200.0], [0.0, 0.004]),
        ErrorTable("C0Y", (30e-6,)),
        ErrorTable(
            "EZY",
            tuple(1e-6 * x + 2e-6 * y for x in X_GRID for y in Y_GRID),
            "XY",
            tuple((x, y) for x in X_GRID for y in Y_GRID),
        ),
    ),
)
MEASURED = Machine(
    tuple(Axis(number, name, volumetric_limit=1.0) for number, name in ((1, "X"), (2, "Y"), (3, "Z"))), (VOLUMETRIC,)
)
