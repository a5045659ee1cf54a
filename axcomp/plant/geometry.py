"""The geometric errors of the machine: how far the tool is from where the encoders say it is.

``true position = measured position + error``; an error is actual − nominal, positive along the axis. Each kind is a
class with ``error(motion)``; ``AxisErrors`` adds those of one axis.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from .curves import MILLI, Curve, Surface


class Motion:
    """Where all axes are and how they move, in the order of the plant's axes.

    Attributes
    ----------
    positions, velocities, accelerations : list of float
        As the encoders see them: mm or °, per s, per s².
    approach : list of float
        −1 … 1: from which side the play of each axis was taken up last; ±1 is steady motion in that direction.
    """

    def __init__(self, count: int) -> None:
        self.positions = [0.0] * count
        self.velocities = [0.0] * count
        self.accelerations = [0.0] * count
        self.approach = [1.0] * count


class Kind(Protocol):
    """One kind of error of one axis."""

    def error(self, motion: Motion) -> float:
        """Return the error in mm or °."""


class PitchError:
    """Error of the own screw or gear: one curve for either direction, ``approach`` fades between them."""

    def __init__(self, description: Mapping[str, Any], axis: int) -> None:
        self.axis = axis
        self.positive = Curve(description["positive"])
        self.negative = Curve(description.get("negative", description["positive"]))

    def error(self, motion: Motion) -> float:
        """Return the error at the axis' own position."""
        position = motion.positions[self.axis]
        share = 0.5 * (1.0 + motion.approach[self.axis])
        return MILLI * (share * self.positive(position) + (1.0 - share) * self.negative(position))


class Sag:
    """Sag of the axis, a curve over the position of one other."""

    def __init__(self, description: Mapping[str, Any], names: Sequence[str]) -> None:
        self.master = names.index(description["master"])
        self.curve = Curve(description["curve"])

    def error(self, motion: Motion) -> float:
        """Return the error at the master's position."""
        return MILLI * self.curve(motion.positions[self.master])


class PlaneError:
    """Error of the axis over the positions of two others."""

    def __init__(self, description: Mapping[str, Any], names: Sequence[str]) -> None:
        self.master1, self.master2 = (names.index(name) for name in description["masters"])
        self.surface = Surface(description["terms"])

    def error(self, motion: Motion) -> float:
        """Return the error at the masters' positions."""
        return MILLI * self.surface(motion.positions[self.master1], motion.positions[self.master2])


class Crosstalk:
    """Deflection of the axis while another accelerates: ``compliance · a · (1 + stiffening · a²) · (1 ± direction)``.

    ``compliance`` is a surface over the axes ``over`` in thousandths of the unit per m/s², a in m/s², ``stiffening`` in
    (m/s²)⁻², ``direction`` the share by which motion in positive direction deflects more than in negative; around
    standstill the direction fades over ``FADE``.
    """

    FADE = 1.0
    """mm/s or °/s"""

    def __init__(self, description: Mapping[str, Any], names: Sequence[str]) -> None:
        self.master = names.index(description["master"])
        self.over1, self.over2 = (names.index(name) for name in description["over"])
        self.compliance = Surface(description["compliance"])
        self.stiffening = float(description.get("stiffening", 0.0))
        self.direction = float(description.get("direction", 0.0))

    def error(self, motion: Motion) -> float:
        """Return the error at the master's acceleration."""
        a = MILLI * motion.accelerations[self.master]
        side = 1.0 + self.direction * math.tanh(motion.velocities[self.master] / self.FADE)
        compliance = self.compliance(motion.positions[self.over1], motion.positions[self.over2])
        return MILLI * compliance * a * (1.0 + self.stiffening * a * a) * side


class AxisErrors:
    """All geometric errors of one axis.

    Attributes
    ----------
    lost_motion : float
        Travel after a reversal over which the axis takes up its play, mm or °: the pitch error changes its curve there.
    """

    def __init__(self, description: Mapping[str, Any], axis: int, names: Sequence[str]) -> None:
        pitch = description.get("pitch")
        self.lost_motion = float(pitch.get("lost_motion", 0.0)) if pitch else 0.0
        self.kinds: list[Kind] = [PitchError(pitch, axis)] if pitch else []
        self.kinds += [Sag(d, names) for d in description.get("sag", [])]
        self.kinds += [PlaneError(d, names) for d in description.get("plane", [])]
        self.kinds += [Crosstalk(d, names) for d in description.get("crosstalk", [])]

    def error(self, motion: Motion) -> float:
        """Return true − measured position, mm or °."""
        return sum(kind.error(motion) for kind in self.kinds)

    def take_up(self, approach: float, travel: float) -> float:
        """Return ``approach`` after ``travel`` mm or °."""
        if self.lost_motion <= 0.0:
            return math.copysign(1.0, travel) if travel else approach
        return max(-1.0, min(1.0, approach + 2.0 * travel / self.lost_motion))
