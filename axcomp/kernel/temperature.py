"""Temperature compensation (lr_param.temp_comp): growth of the axis, linear over its position. Added.

Δs = offset_0 + coefficient · (s − position_0), s the raw setpoint. Offset and coefficient may change while it acts
(P-AXIS-00271 … 00275); the new ones come in over temp_comp_n_cycles.
"""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import LARGEST


@dataclass(slots=True)
class TemperatureTable:
    """What the lists say."""

    position: float  # position_0, mm or °
    offset: float  # offset_0, mm or °
    coefficient: float  # mm per mm or ° per °


@dataclass(slots=True)
class TemperatureInputs:
    """What is measured while the machine runs: it is added to what the lists say."""

    offset: float
    coefficient: float


@dataclass(slots=True)
class TemperatureState:
    """The values in force: the last ones that were finite."""

    offset: float
    coefficient: float


def temperature_value(table: TemperatureTable, state: TemperatureState, position: float) -> float:
    """Return the correction at full weight; ``position``: the raw setpoint."""
    return state.offset + state.coefficient * (position - table.position)


def take_temperature(
    table: TemperatureTable, state: TemperatureState, given: TemperatureInputs, position: float
) -> float:
    """Take over offset and coefficient if they are finite; return how much less is added with them at a position."""
    offset = table.offset + given.offset
    coefficient = table.coefficient + given.coefficient
    if offset == state.offset and coefficient == state.coefficient:
        return 0.0
    if not (abs(offset) < LARGEST and abs(coefficient) < LARGEST):
        return 0.0
    before = temperature_value(table, state, position)
    state.offset = offset
    state.coefficient = coefficient
    return before - temperature_value(table, state, position)


def temperature_fits(table: TemperatureTable) -> bool:
    """Tell whether the table can be used: sums with its numbers do not overflow."""
    return abs(table.position) < LARGEST and abs(table.offset) < LARGEST and abs(table.coefficient) < LARGEST
