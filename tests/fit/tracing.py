"""Traces of an axis with LuGre friction, integrated by SciPy, and of axes of the example plant."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.ndimage import uniform_filter1d

CYCLE = 0.002


class LuGreAxis(NamedTuple):
    """N, kg, mm; ``asymmetry``: share in positive direction above the mean of both."""

    mass: float = 180.0
    static: float = 340.0
    coulomb: float = 300.0
    stribeck: float = 4.0
    viscous: float = 0.6
    presliding: float = 0.015
    damping: float = 10.0
    asymmetry: float = 0.1
    offset: float = -25.0

    def steady(self, speed):
        """Return the mean friction of both directions."""
        return (
            self.coulomb + (self.static - self.coulomb) * np.exp(-((speed / self.stribeck) ** 2)) + self.viscous * speed
        )

    def force(self, time, velocity):
        """Return the force of a motor that moves the mass just so, N."""
        stiffness = self.coulomb / self.presliding

        def parts(t, z):
            v = np.interp(t, time, velocity)
            share = 1.0 + np.where(v < 0.0, -1.0, 1.0) * self.asymmetry
            g = share * (self.steady(np.abs(v)) - self.viscous * np.abs(v))
            return v, share, v - stiffness * np.abs(v) * z / g

        solved = solve_ivp(
            lambda t, z: parts(t, z[0])[2][None],
            (time[0], time[-1]),
            [0.0],
            "LSODA",
            time,
            rtol=1e-6,
            atol=1e-9,
            max_step=0.01,
        )
        z = solved.y[0]
        v, share, rate = parts(time, z)
        inertia = self.mass * np.gradient(velocity, time) * 1e-3
        return stiffness * z + self.damping * rate + share * self.viscous * v + inertia + self.offset


def to_and_fro(speeds, cycle=CYCLE, hold=0.6, acceleration=800.0):
    """Return time and velocity of an axis that goes to and fro at each speed, with smooth changes."""
    pieces = [np.zeros(100)]
    for speed in speeds:
        for sign in (1.0, -1.0):
            ramp = sign * np.linspace(0.0, speed, max(10, round(speed / acceleration / cycle)))
            pieces += [ramp, np.full(round(hold / cycle), sign * speed), ramp[::-1]]
    velocity = uniform_filter1d(np.concatenate([*pieces, np.zeros(100)]), 9)
    return np.arange(len(velocity)) * cycle, velocity


def write_trace(path: Path, **columns) -> Path:
    """Write columns with these names."""
    rows = zip(*(np.asarray(column).tolist() for column in columns.values()), strict=True)
    path.write_text("\n".join([",".join(columns), *(",".join(f"{x:.7g}" for x in row) for row in rows)]) + "\n")
    return path
