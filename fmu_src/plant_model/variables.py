"""The variables of the plant's FMU: all Real, the same for every axis, and nowhere declared but here.

The value reference of variable k of axis i is ``BLOCK · i + k``, k being its place in ``OF_AXIS``.
"""

from __future__ import annotations

from typing import NamedTuple

BLOCK = 8


class Declaration(NamedTuple):
    """A variable of each axis; {} in the unit stands for mm or deg."""

    name: str
    causality: str
    unit: str
    description: str


OF_AXIS = (
    Declaration("setpoint", "input", "{}", "Corrected setpoint, for the drive's interpolator"),
    Declaration("current", "input", "mA", "Additional motor current"),
    Declaration("true_position", "output", "{}", "Position of the tool: measured position and geometric errors"),
    Declaration("measured_position", "output", "{}", "Position of the encoder"),
    Declaration("velocity", "output", "{}/s", "Velocity of the encoder"),
    Declaration("motor_current", "output", "mA", "Motor current, which at constant velocity overcomes friction"),
    Declaration("following_error", "output", "{}", "Interpolated setpoint - measured position"),
)

SETPOINT, CURRENT, TRUE_POSITION, MEASURED_POSITION, VELOCITY, MOTOR_CURRENT, FOLLOWING_ERROR = range(len(OF_AXIS))
