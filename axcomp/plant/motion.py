"""How the axes of the plant move: what errors are functions of."""

from __future__ import annotations

from collections.abc import Callable


class MotionState:
    """Where all axes are and how they move, in the order of the plant's axes.

    Positions, velocities and accelerations are what the encoders see: mm or °, per s, per s². ``approach``, −1 … 1:
    from which side the play of each axis was taken up last; ±1 is steady motion in that direction. ``powers``: what
    friction turns into heat, W.
    """

    def __init__(self, count: int) -> None:
        self.positions = [0.0] * count
        self.velocities = [0.0] * count
        self.accelerations = [0.0] * count
        self.powers = [0.0] * count
        self.approach = [1.0] * count


ErrorOf = Callable[[MotionState], float]
"""Error of one axis in mm or °."""
