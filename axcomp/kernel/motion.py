"""How the axes move: their last usable setpoints, and the one decision whether an axis stands or which way it goes.

An axis stands while neither its velocity nor the summed changes of its setpoint reach ``STANDSTILL`` in a cycle: what
rounding leaves behind is no motion (semantics §4).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .interpolation import LARGEST, fold, nearest, period_fits
from .record import APART

AXES = 32
STANDSTILL = 1e-9  # mm or ° a cycle


@dataclass(slots=True)
class AxisMotion:
    """The motion of an axis in this cycle; setpoint, velocity and acceleration are the last ones that were finite."""

    setpoint: float
    velocity: float
    acceleration: float
    counted: float  # the setpoint when it last moved: changes that are no motion add up from there
    moving: bool
    sign: int  # of the velocity, 0 while that is no motion
    direction: int  # of the last motion, 1 or −1; 0 before any


@dataclass(slots=True)
class Motion:
    """The motion of all axes."""

    axis: Annotated[list[AxisMotion], AXES, APART]


@dataclass(slots=True)
class Argument:
    """What a table is looked up with: the raw setpoint of an axis.

    Of an axis that counts modulo it is folded into one turn, the one that is centred on the table (semantics §5).
    """

    axis: int
    start: float  # of the turn
    period: float  # 0: not folded


def move_axis(motion: AxisMotion, setpoint: float, velocity: float, cycle_time: float, modulo_range: float) -> None:
    """Take over a setpoint and a velocity, and decide whether and which way the axis moves."""
    way = velocity * cycle_time
    change = nearest(setpoint - motion.counted, modulo_range)
    motion.sign = way_sign(way)
    motion.moving = motion.sign != 0 or is_motion(change)
    if motion.moving:
        motion.direction = motion.sign
        if motion.sign == 0:
            motion.direction = 1 if change > 0.0 else -1
        motion.counted = setpoint
    motion.setpoint = setpoint
    motion.velocity = velocity


def way_sign(way: float) -> int:
    """Return the sign of the way of a cycle, 0 where it is no motion."""
    if way >= STANDSTILL:
        return 1
    if way <= -STANDSTILL:
        return -1
    return 0


def is_motion(change: float) -> bool:
    """Tell whether a change of position is more than rounding."""
    return change >= STANDSTILL or change <= -STANDSTILL


def position_of(motion: Motion, argument: Argument) -> float:
    """Return the raw setpoint of an axis as a table looks it up."""
    return folded(argument, motion.axis[argument.axis].setpoint)


def folded(argument: Argument, position: float) -> float:
    """Return a position within the turn of a table."""
    if argument.period > 0.0:
        return fold(position, argument.start, argument.period)
    return position


def argument_fits(argument: Argument, axes: int) -> bool:
    """Tell whether an argument means an axis and a turn."""
    return 0 <= argument.axis < axes and abs(argument.start) < LARGEST and period_fits(argument.period)


def motion_fits(motion: AxisMotion) -> bool:
    """Tell whether the state of a motion can be gone on from."""
    return -1 <= motion.sign <= 1 and -1 <= motion.direction <= 1
