"""The geometric errors of the machine: how far the tool is from where the encoders say it is.

``true position = measured position + error``; an error is actual − nominal, positive along the axis. Each sort of error
is a function that takes its description in ``plant.json``; ``AxisErrors`` adds those of one axis.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from .curves import MILLI, Curve, Surface
from .memory import Growth, Remembering, Swinging, Yielding
from .motion import ErrorOf, MotionState

FADE = 1.0
"""Speed over which the direction of a deflection fades around standstill, mm/s or °/s."""


def pitch_error(description: Mapping[str, Any], axis: int) -> ErrorOf:
    """Return the error of the own screw or gear: one curve for either direction, ``approach`` fades between them."""
    positive = Curve(description["positive"])
    negative = Curve(description.get("negative", description["positive"]))

    def error(motion: MotionState) -> float:
        position, share = motion.positions[axis], 0.5 * (1.0 + motion.approach[axis])
        return MILLI * (share * positive(position) + (1.0 - share) * negative(position))

    return error


def sag(description: Mapping[str, Any], names: Sequence[str]) -> ErrorOf:
    """Return the sag of the axis, a curve over the position of one other."""
    master, curve = names.index(description["master"]), Curve(description["curve"])
    return lambda motion: MILLI * curve(motion.positions[master])


def plane_error(description: Mapping[str, Any], names: Sequence[str]) -> ErrorOf:
    """Return the error of the axis over the positions of two others."""
    master1, master2 = (names.index(name) for name in description["masters"])
    surface = Surface(description["terms"])
    return lambda motion: MILLI * surface(motion.positions[master1], motion.positions[master2])


def deflection(description: Mapping[str, Any], names: Sequence[str], memoryless: bool) -> ErrorOf | Swinging | Yielding:
    """Return the deflection while another accelerates: ``compliance · a · (1 + stiffening · a²) · (1 ± direction)``.

    ``compliance`` is a surface over the axes ``over`` in thousandths of the unit per m/s², a in m/s², ``stiffening`` in
    (m/s²)⁻², ``direction`` the share by which motion in positive direction deflects more than in negative. ``between``
    is a compliance in addition, that a table with a few tests misses; with a ``mode`` the structure swings.
    """
    master = names.index(description["master"])
    over1, over2 = (names.index(name) for name in description["over"])
    stiffening, direction = (float(description.get(name, 0.0)) for name in ("stiffening", "direction"))

    def static(compliance: Surface) -> ErrorOf:
        def error(motion: MotionState) -> float:
            a = MILLI * motion.accelerations[master]
            side = 1.0 + direction * math.tanh(motion.velocities[master] / FADE)
            at = compliance(motion.positions[over1], motion.positions[over2])
            return MILLI * at * a * (1.0 + stiffening * a * a) * side

        return error

    held = static(Surface(description["compliance"]))
    if memoryless or not description.keys() & {"between", "mode"}:
        return held
    whole = static(Surface([*description["compliance"], *description.get("between", [])]))
    return Swinging(whole, held, description["mode"]) if "mode" in description else Yielding(whole, held)


class AxisErrors:
    """All geometric errors of one axis.

    ``lost_motion``: travel after a reversal over which the axis takes up its play, mm or °: the ``backlash``, by which
    the slide stays behind, is taken up and the pitch error changes its curve there. ``remembering``: errors with a
    state.
    """

    def __init__(self, description: Mapping[str, Any], axis: int, names: Sequence[str], memoryless: bool) -> None:
        pitch = description.get("pitch", {})
        play = MILLI * float(description.get("backlash", 0.0))
        self.lost_motion = float(pitch.get("lost_motion", play))
        self.parts: list[ErrorOf] = [pitch_error(pitch, axis)] if pitch else []
        if play:
            self.parts.append(lambda motion: -0.5 * play * motion.approach[axis])
        for name, part in (("sag", sag), ("plane", plane_error)):
            self.parts += [part(d, names) for d in description.get(name, [])]
        self.remembering: list[Remembering] = []
        for d in description.get("crosstalk", []):
            made = deflection(d, names, memoryless)
            if isinstance(made, Swinging | Yielding):
                self.remembering.append(made)
            else:
                self.parts.append(made)
        if "thermal" in description and not memoryless:
            self.remembering.append(Growth(description["thermal"], axis))

    def error(self, motion: MotionState) -> float:
        """Return true − measured position, mm or °."""
        return sum(part(motion) for part in self.parts) + sum(part.error(motion) for part in self.remembering)

    def beyond(self, motion: MotionState) -> float:
        """Return the part of it that no table of positions and accelerations holds."""
        return sum(part.beyond(motion) for part in self.remembering)

    def take_up(self, approach: float, travel: float) -> float:
        """Return ``approach`` after ``travel`` mm or °."""
        if self.lost_motion <= 0.0:
            return math.copysign(1.0, travel) if travel else approach
        return max(-1.0, min(1.0, approach + 2.0 * travel / self.lost_motion))
