"""Machines of any size to measure with: every axis has all five compensations."""

from __future__ import annotations

import math

from ..kinds import Cross, Crosstalk, CrosstalkTest, Friction, Leadscrew, Plane
from ..model import AXES_MAX, Axis, Machine


def machine_of(axes: int, points: int) -> Machine:
    """Return a machine of translatory axes ``A0`` … whose curves have ``points`` points and whose planes about as many.

    There are 2 … 32 ``axes``; the masters of an axis are its neighbours. ``points`` are at least 4; a plane has
    ⌊√points⌋ in either direction.
    """
    return Machine(tuple(_axis(index, axes, points, math.isqrt(points)) for index in range(axes)))


def largest_machine() -> Machine:
    """Return the machine whose lists are the longest that the default sizes allow: 32 axes, every table full."""
    return Machine(tuple(_axis(index, AXES_MAX, 1001, 101, leadscrew=1500, friction=20) for index in range(AXES_MAX)))


def _axis(index: int, axes: int, points: int, side: int, *, leadscrew: int = 0, friction: int = 0) -> Axis:
    master, other = (index + 1) % axes + 1, (index + 2) % axes + 1
    x = _abscissae(points)
    screw = _abscissae(leadscrew or points)
    speeds = tuple(0.5 * (k + 1) for k in range(friction or min(points, 1000)))
    tests = tuple(
        CrosstalkTest(100.0 * i, 100.0 * j, 0.01, 0.011, -0.01, -0.012 + 0.001 * i) for j in range(3) for i in range(5)
    )
    return Axis(
        index + 1,
        f"A{index}",
        backlash_cycles=10,
        cross=Cross(master, x, _listed(0.05, x), n_cycles=10, max_points=max(1001, points + 1)),
        plane=Plane(
            master,
            other,
            -500.0,
            -500.0,
            1000.0 / side,
            1000.0 / side,
            tuple(_listed(0.001 * (j % 7 + 1), _abscissae(side)) for j in range(side)),
            n_cycles=10,
            max_points=None if side <= 101 else side * side,
        ),
        crosstalk=Crosstalk(master, 3000.0, -3000.0, 3, tests, master, other, velocity_dependent=True, n_cycles=10),
        leadscrew=Leadscrew(screw, _listed(0.02, screw), _listed(0.015, screw), max_points=max(1500, len(screw))),
        friction=Friction(speeds, tuple(10.0 + v for v in speeds), 1.0, 0.001, 3, 5, max_points=max(20, len(speeds))),
    )


def _abscissae(points: int) -> tuple[float, ...]:
    """Spread points over −500 … 500 mm, in whole 0.1 µm and not quite evenly."""
    return tuple(
        round(1e4 * (-500.0 + 1000.0 * (k + 0.2 * math.sin(k)) / max(points - 1, 1))) / 1e4 for k in range(points)
    )


def _listed(amplitude: float, x: tuple[float, ...]) -> tuple[float, ...]:
    """Return a curve over ``x`` in whole 0.1 µm."""
    return tuple(round(1e4 * amplitude * math.sin(0.02 * position)) / 1e4 for position in x)
