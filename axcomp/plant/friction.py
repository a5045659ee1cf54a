"""Friction of a drive: without memory, or with bristles that give way before they slide (LuGre).

Steady friction is the same Stribeck curve in both, with v the speed::

    φ(v) = β · (coulomb + (static − coulomb) · exp(−(v / stribeck)²) + viscous · v)          β = 1 / mass

Without memory it opposes motion and holds what stands up to φ(0). LuGre has a deflection z of the bristles, with
g(v) = φ(v) without its viscous part, each direction with its own share (1 ± asymmetry) of g and of the viscous part::

    z' = v − σ₀ |v| z / g(v)          friction = σ₀ z + σ₁ z' + β · viscous · v          σ₀ = β · coulomb / presliding

so at constant velocity z = g/σ₀ and friction is φ(v); after a reversal it builds up over some ``presliding`` of travel.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any


class Memoryless:
    """Stribeck friction, by ``static``, ``coulomb``, ``viscous`` (N, N, N per mm/s) and ``stribeck_velocity``."""

    def __init__(self, description: Mapping[str, Any], per_force: float) -> None:
        self.coulomb = per_force * float(description["coulomb"])
        self.stiction = per_force * (float(description["static"]) - float(description["coulomb"]))
        self.stribeck = 1.0 / float(description["stribeck_velocity"])
        self.viscous = per_force * float(description["viscous"])
        self.deflection = 0.0

    def after(self, velocity: float, push: float, dt: float) -> float:
        """Return the velocity after ``dt`` s of an acceleration ``push`` by the motor.

        Friction opposes motion but never reverses it: what would pass through zero stops there and may stick.
        """
        speed = abs(velocity)
        slow = speed * self.stribeck
        brake = (self.coulomb + self.stiction * math.exp(-slow * slow) + self.viscous * speed) * dt
        free = velocity + push * dt
        return free - brake if free > brake else free + brake if free < -brake else 0.0


class LuGre(Memoryless):
    """Friction with memory, besides by ``presliding`` (mm), ``bristle_damping`` (N per mm/s) and ``asymmetry``.

    ``deflection``: z, mm. A step takes the speed in |v| z/g from its beginning and is implicit in all else: linear in
    what is sought, so stable whatever the stiffness.
    """

    def __init__(self, description: Mapping[str, Any], per_force: float) -> None:
        super().__init__(description, per_force)
        presliding, asymmetry = float(description["presliding"]), float(description.get("asymmetry", 0.0))
        if not (presliding > 0.0 and -1.0 < asymmetry < 1.0):
            raise ValueError(f"presliding {presliding:g} is not above 0, or asymmetry {asymmetry:g} not in −1 … 1")
        self.stiffness = self.coulomb / presliding
        self.damping = per_force * float(description.get("bristle_damping", 0.0))
        self.forward, self.backward = 1.0 + asymmetry, 1.0 - asymmetry

    def after(self, velocity: float, push: float, dt: float) -> float:
        """Return the velocity after ``dt`` s of an acceleration ``push`` by the motor."""
        speed = abs(velocity)
        slow = speed * self.stribeck
        share = self.forward if velocity >= 0.0 else self.backward
        sliding = share * (self.coulomb + self.stiction * math.exp(-slow * slow))
        stiffness, damping, before = self.stiffness, self.damping, self.deflection
        kept = 1.0 / (1.0 + stiffness * speed * dt / sliding)
        # z⁺ = kept · (z + v⁺ dt), z' = (z⁺ − z) / dt; the force of both is linear in v⁺.
        held = stiffness * kept * before + damping * (kept - 1.0) * before / dt
        resists = kept * (stiffness * dt + damping) + share * self.viscous
        after = (velocity + dt * (push - held)) / (1.0 + dt * resists)
        self.deflection = kept * (before + after * dt)
        return after


def friction_of(description: Mapping[str, Any], per_force: float, memoryless: bool) -> Memoryless:
    """Return the friction that a ``model``, ``memoryless`` (default) or ``lugre``, says; ``per_force``: β."""
    model = description.get("model", "memoryless")
    if model not in ("memoryless", "lugre"):
        raise ValueError(f"there is no friction model {model!r}, only memoryless and lugre")
    return (Memoryless if memoryless or model == "memoryless" else LuGre)(description, per_force)
