"""Errors that remember: a structure that swings, and growth with temperature.

Each has a ``state`` of floats, is put to ``rest``, goes on with ``advance``, and returns an ``error``, mm or °. What of
it depends on neither position nor acceleration at the moment is ``beyond`` every table.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import Any, Protocol

from .motion import ErrorOf, MotionState

MICRO = 1e-6


class Remembering(Protocol):
    """An error with a state."""

    state: list[float]

    def rest(self, motion: MotionState) -> None:
        """Begin anew."""

    def advance(self, motion: MotionState, duration: float) -> None:
        """Go on for ``duration`` s with the motion as it is now."""

    def error(self, motion: MotionState) -> float:
        """Return true − measured position."""

    def beyond(self, motion: MotionState) -> float:
        """Return the part of it that no table holds."""


class Swinging:
    """A deflection that follows its static value as a mass on a spring: m x'' + d x' + k (x − static) = 0.

    ``mass`` in kg, ``stiffness`` in N/µm, ``damping`` in N·s/m. The step is the exact solution for a static value that
    is constant over it, so it is stable whatever the frequency. ``state``: x and x', mm and mm/s.
    """

    def __init__(self, static: ErrorOf, held: ErrorOf, description: Mapping[str, Any]) -> None:
        self.static, self.held = static, held
        mass, stiffness = float(description["mass"]), 1e6 * float(description["stiffness"])
        damping = float(description["damping"])
        if not (mass > 0.0 and stiffness > 0.0 and damping >= 0.0):
            raise ValueError("a mode has a mass and a stiffness above 0 and a damping that is not below")
        # Roots of m s² + d s + k, moved off each other where they meet: the solution is continuous in them.
        half, square = 0.5 * damping / mass, stiffness / mass
        apart = cmath.sqrt(half * half - square) or 1e-6 * math.sqrt(square)
        self.roots = -half + apart, -half - apart
        self.state = [0.0, 0.0]

    def rest(self, motion: MotionState) -> None:
        """Be where the structure stands."""
        self.state = [self.static(motion), 0.0]

    def advance(self, motion: MotionState, duration: float) -> None:
        """Go on for ``duration`` s."""
        goal = self.static(motion)
        away, speed = self.state[0] - goal, self.state[1]
        first, second = self.roots
        one = (speed - second * away) / (first - second)
        other = away - one
        one, other = one * cmath.exp(first * duration), other * cmath.exp(second * duration)
        self.state = [goal + (one + other).real, (first * one + second * other).real]

    def error(self, motion: MotionState) -> float:  # noqa: ARG002
        """Return x."""
        return self.state[0]

    def beyond(self, motion: MotionState) -> float:
        """Return x less what a table over accelerations and positions holds."""
        return self.state[0] - self.held(motion)


class Growth:
    """A screw or scale that grows: ``coefficient · rise · (q − origin)``, 1e-6/K, K, and mm or °.

    ``rise' = (heating · friction power − rise) / time_constant``, K/W, W and s; it begins with ``start`` K.
    ``state``: the rise.
    """

    def __init__(self, description: Mapping[str, Any], axis: int) -> None:
        self.axis = axis
        self.coefficient, self.origin, self.heating, self.start = (
            float(description.get(name, 0.0)) for name in ("coefficient", "origin", "heating", "start")
        )
        self.rate = 1.0 / float(description["time_constant"])
        self.state = [self.start]

    def rest(self, motion: MotionState) -> None:  # noqa: ARG002
        """Be as warm as in the beginning."""
        self.state = [self.start]

    def advance(self, motion: MotionState, duration: float) -> None:
        """Go on for ``duration`` s."""
        goal = self.heating * motion.powers[self.axis]
        self.state = [goal + (self.state[0] - goal) * math.exp(-duration * self.rate)]

    def error(self, motion: MotionState) -> float:
        """Return how far the axis has grown."""
        return MICRO * self.coefficient * self.state[0] * (motion.positions[self.axis] - self.origin)

    def beyond(self, motion: MotionState) -> float:
        """Return all of it: no table over positions knows how warm the machine is."""
        return self.error(motion)


class Yielding:
    """A deflection at once, of which a table holds a part."""

    def __init__(self, static: ErrorOf, held: ErrorOf) -> None:
        self.static, self.held = static, held
        self.state: list[float] = []

    def rest(self, motion: MotionState) -> None:
        """Do nothing: it remembers nothing."""

    def advance(self, motion: MotionState, duration: float) -> None:
        """Do nothing."""

    def error(self, motion: MotionState) -> float:
        """Return the deflection."""
        return self.static(motion)

    def beyond(self, motion: MotionState) -> float:
        """Return what the table does not hold."""
        return self.static(motion) - self.held(motion)
