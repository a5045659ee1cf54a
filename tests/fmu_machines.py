"""Machines and trajectories for the tests of the FMU."""

from __future__ import annotations

import math
from typing import Any

from axcomp.kinds import Cross, Crosstalk, CrosstalkTest, Friction, Leadscrew, Plane
from axcomp.model import Axis, AxisType, Machine, ModuloRange


def three_axes(scale: float = 1.0) -> Machine:
    """X, Y-ACHSE and a modulo axis C; every kind of compensation acts on Y-ACHSE."""
    screw = tuple(round(scale * v, 4) for v in (0.01, -0.02, 0.03, 0.005))
    x = Axis(
        1,
        "X",
        backlash_cycles=4,
        leadscrew=Leadscrew((-100.0, -20.0, 30.0, 100.0), screw, (0.02, 0.01, 0.0, -0.01)),
        # the delay line is the look-ahead: nothing has to be predicted, and there is nothing to say
        friction=Friction(
            (0.5, 5.0, 50.0), (100.0, 60.0, 80.0), position_delay=0.001, reversal_lookahead=2, delay_cycles=2
        ),
    )
    y = Axis(
        2,
        "Y-ACHSE",
        cross=Cross(1, (-100.0, 0.0, 100.0), (0.02, 0.0, 0.04), n_cycles=5),
        plane=Plane(1, 3, -50.0, 0.0, 50.0, 180.0, ((0.01, 0.02, 0.01), (0.0, 0.03, -0.01)), n_cycles=3),
        crosstalk=Crosstalk(
            master=1,
            acceleration=1000.0,
            deceleration=-800.0,
            mode=2,
            tests=(
                CrosstalkTest(-50.0, 0.0, 0.01, 0.02, 0.03, 0.04),
                CrosstalkTest(0.0, 0.0, 0.015, 0.01, 0.02, 0.0),
                CrosstalkTest(50.0, 0.0, 0.02, 0.01, 0.0, 0.01),
            ),
            adaptation1=1,
            velocity_dependent=True,
            n_cycles=4,
        ),
        leadscrew=Leadscrew((0.0, 50.0, 100.0), (0.0, 0.01, -0.01)),
        friction=Friction((0.5, 10.0), (40.0, 20.0), delay_cycles=3, reversal_lookahead=1),
    )
    c = Axis(
        3,
        "C",
        AxisType.ROTARY,
        ModuloRange(0.0, 360.0),
        leadscrew=Leadscrew((0.0, 120.0, 240.0), (0.001, 0.002, -0.003), modulo=True),
    )
    return Machine((x, y, c))


def trajectory(cycles: int, start: int = 0) -> list[dict[str, Any]]:
    """Every axis in motion, reversals, a few commands in between."""
    rows: list[dict[str, Any]] = []
    for k in range(start, start + cycles):
        t = k / 1000.0
        row: dict[str, Any] = {}
        for name, amplitude, omega in (("X", 90.0, 9.0), ("Y_ACHSE", 40.0, 23.0), ("C", 400.0, 7.0)):
            row[f"{name}.setpoint"] = amplitude * math.sin(omega * t)
            row[f"{name}.velocity"] = amplitude * omega * math.cos(omega * t)
            row[f"{name}.acceleration"] = -amplitude * omega * omega * math.sin(omega * t)
            row[f"{name}.actual_position"] = row[f"{name}.setpoint"] - 0.1
        row["X.leadscrew.switch"] = -1 if 40 <= k < 60 else k // 30 % 2
        row["Y_ACHSE.unreferenced"] = 80 <= k < 90
        row["Y_ACHSE.friction.switch"] = 1 if k % 70 > 5 else -1
        row["C.no_move"] = k % 50 > 30
        row["C.leadscrew.switch"] = 0 if k % 64 > 15 else -1
        rows.append(row)
    return rows
