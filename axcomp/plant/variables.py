"""The variables of the plant's FMU: all Real, and nowhere declared but here.

The value reference of variable k of axis i is ``BLOCK · i + k``, k being its index in ``OF_AXIS``; behind the axes
follow those of the whole machine in the order of ``OF_MACHINE``.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

BLOCK = 16


class Declaration(NamedTuple):
    """A variable of each axis or of the machine; {} in the unit stands for mm or deg.

    ``of_bodies``: only plants with rigid bodies have it.
    """

    name: str
    causality: Literal["input", "output"]
    unit: str
    description: str
    of_bodies: bool = False


OF_AXIS = (
    Declaration("setpoint", "input", "{}", "Corrected setpoint, for the drive's interpolator"),
    Declaration("current", "input", "mA", "Additional motor current"),
    Declaration("true_position", "output", "{}", "Measured position and geometric errors of the axis on its own"),
    Declaration("measured_position", "output", "{}", "Position of the encoder"),
    Declaration("velocity", "output", "{}/s", "Velocity of the encoder"),
    Declaration("motor_current", "output", "mA", "Motor current, which at constant velocity overcomes friction"),
    Declaration("following_error", "output", "{}", "Interpolated setpoint - measured position"),
    Declaration("commanded_position", "input", "{}", "Setpoint before compensation, for tcp.nominal only", True),
    Declaration("beyond_tables", "output", "{}", "Part of true - measured position that no table holds"),
)

(
    SETPOINT,
    CURRENT,
    TRUE_POSITION,
    MEASURED_POSITION,
    VELOCITY,
    MOTOR_CURRENT,
    FOLLOWING_ERROR,
    COMMANDED_POSITION,
    BEYOND,
) = range(len(OF_AXIS))

OF_MACHINE = (
    Declaration("tool_length", "input", "mm", "Length of the tool", True),
    *(Declaration(f"tcp.{k}", "output", "mm", f"Tool tip as the workpiece sees it, {k}", True) for k in "xyz"),
    *(
        Declaration(f"tcp.nominal_{k}", "output", "mm", f"Where the commanded positions mean it to be, {k}", True)
        for k in "xyz"
    ),
)

TOOL_LENGTH, TCP, NOMINAL_TCP = 0, 1, 4
"""Indices in ``OF_MACHINE``, the last two of the first of three."""
