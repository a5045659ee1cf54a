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
    """What may be measured while the machine runs; at the start it is what the lists say."""

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
    if given.offset == state.offset and given.coefficient == state.coefficient:
        return 0.0
    if not (abs(given.offset) < LARGEST and abs(given.coefficient) < LARGEST):
        return 0.0
    before = temperature_value(table, state, position)
    state.offset = given.offset
    state.coefficient = given.coefficient
    return before - temperature_value(table, state, position)


def begin_temperature(table: TemperatureTable, given: TemperatureInputs) -> None:
    """Set the inputs to what the lists say."""
    given.offset = table.offset
    given.coefficient = table.coefficient


def adopt_temperature(before: TemperatureTable, after: TemperatureTable, given: TemperatureInputs) -> None:
    """Go on with other lists: an input that is as the old ones said follows the new ones."""
    if given.offset == before.offset:
        given.offset = after.offset
    if given.coefficient == before.coefficient:
        given.coefficient = after.coefficient


def temperature_fits(table: TemperatureTable) -> bool:
    """Tell whether the table can be used: sums with its numbers do not overflow."""
    return abs(table.position) < LARGEST and abs(table.offset) < LARGEST and abs(table.coefficient) < LARGEST
