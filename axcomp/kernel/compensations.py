"""The compensations of an axis in the order of a cycle (semantics §3), and what each does when its turn comes.

A new kind stands here as a number, as a field of the three records, and in the functions below; everything else that
the engine does with compensations are loops over the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

from .backlash import (
    BacklashState,
    BacklashTable,
    adopt_backlash,
    backlash_at,
    backlash_fits,
    backlash_state_fits,
    backlash_value,
)
from .cross import CrossState, CrossTable, adopt_cross, cross_fits, cross_state_fits, cross_value, move_cross
from .crosstalk import (
    CrosstalkState,
    CrosstalkTable,
    adopt_crosstalk,
    crosstalk_fits,
    crosstalk_state_fits,
    crosstalk_value,
    move_crosstalk,
)
from .friction import (
    FrictionInputs,
    FrictionState,
    FrictionTable,
    adopt_friction,
    friction_current,
    friction_fits,
    friction_state_fits,
    move_friction,
)
from .leadscrew import (
    LeadscrewState,
    LeadscrewTable,
    adopt_leadscrew,
    begin_leadscrew,
    leadscrew_at,
    leadscrew_fits,
    leadscrew_input,
    leadscrew_state_fits,
    leadscrew_value,
    move_leadscrew,
)
from .motion import AxisMotion, Motion
from .plane import PlaneTable, move_plane, plane_fits, plane_value
from .record import Vec
from .temperature import (
    TemperatureInputs,
    TemperatureState,
    TemperatureTable,
    take_temperature,
    temperature_fits,
    temperature_value,
)

CROSS = 0
PLANE = 1
CROSSTALK = 2
TEMPERATURE = 3
LEADSCREW = 4  # those before it are computed from raw setpoints; it takes its position with them
BACKLASH = 5
FRICTION = 6  # those before it correct the setpoint; it adds to the motor current
KINDS = 7


@dataclass(slots=True)
class CompensationTables:
    """What is fixed for the compensations of an axis."""

    cross: CrossTable
    plane: PlaneTable
    crosstalk: CrosstalkTable
    temperature: TemperatureTable
    leadscrew: LeadscrewTable
    backlash: BacklashTable
    friction: FrictionTable


@dataclass(slots=True)
class CompensationStates:
    """What the compensations of an axis remember."""

    cross: CrossState
    crosstalk: CrosstalkState
    temperature: TemperatureState
    leadscrew: LeadscrewState
    backlash: BacklashState
    friction: FrictionState


@dataclass(slots=True)
class CompensationInputs:
    """What the compensations of an axis are given besides its motion."""

    temperature: TemperatureInputs
    friction: FrictionInputs


def compensation_value(
    kind: int,
    pool: Vec,
    tables: CompensationTables,
    states: CompensationStates,
    given: CompensationInputs,
    motion: Motion,
    own: AxisMotion,
    added: float,
    cycle_time: float,
) -> float:
    """Return what a kind adds to the setpoint or the current of an axis at full weight.

    ``own``: the motion of the axis; ``added``: to its setpoint before the leadscrew.
    """
    if kind == CROSS:
        return cross_value(pool, tables.cross, states.cross, motion)
    if kind == PLANE:
        return plane_value(pool, tables.plane, motion)
    if kind == CROSSTALK:
        return crosstalk_value(pool, tables.crosstalk, states.crosstalk, motion)
    if kind == TEMPERATURE:
        return temperature_value(tables.temperature, states.temperature, own.setpoint)
    if kind == LEADSCREW:
        position = leadscrew_input(tables.leadscrew, own.setpoint, added)
        return leadscrew_value(pool, tables.leadscrew, states.leadscrew, position)
    if kind == BACKLASH:
        return backlash_value(tables.backlash, states.backlash, own.direction)
    return friction_current(pool, tables.friction, states.friction, given.friction, own, cycle_time)


def settled_value(
    kind: int,
    pool: Vec,
    tables: CompensationTables,
    states: CompensationStates,
    motion: Motion,
    axis: int,
    added: float,
) -> float:
    """Return what a kind added last at full weight, as its table says it; nothing goes on. A current counts as 0."""
    if kind == LEADSCREW:
        position = leadscrew_input(tables.leadscrew, motion.axis[axis].setpoint, added)
        if not states.leadscrew.started:
            begin_leadscrew(tables.leadscrew, states.leadscrew, position)
        return leadscrew_at(pool, tables.leadscrew, states.leadscrew, position)
    if kind == BACKLASH:
        return backlash_at(tables.backlash, states.backlash)
    if kind == CROSS:
        return cross_value(pool, tables.cross, states.cross, motion)
    if kind == PLANE:
        return plane_value(pool, tables.plane, motion)
    if kind == CROSSTALK:
        return crosstalk_value(pool, tables.crosstalk, states.crosstalk, motion)
    if kind == TEMPERATURE:
        return temperature_value(tables.temperature, states.temperature, motion.axis[axis].setpoint)
    return 0.0


def has_inputs(kind: int) -> bool:
    """Tell whether a kind is given what its values change by."""
    return kind == TEMPERATURE


def renew(
    kind: int, tables: CompensationTables, states: CompensationStates, given: CompensationInputs, position: float
) -> float:
    """Take over the inputs of a kind; return how much less it adds at full weight with them."""
    if kind == TEMPERATURE:
        return take_temperature(tables.temperature, states.temperature, given.temperature, position)
    return 0.0


def has_notice(kind: int, states: CompensationStates) -> bool:
    """Tell whether a kind has been used beyond its table, or had to guess: the machine's user should know."""
    if kind == CROSSTALK:
        return states.crosstalk.outside
    return kind == FRICTION and states.friction.predicted


def adopt_compensation(
    kind: int,
    before: CompensationTables,
    after: CompensationTables,
    states: CompensationStates,
    motion: AxisMotion,
    added: float,
) -> None:
    """Make the state of a kind fit its new table; ``added``: to the setpoint before the leadscrew."""
    if kind == CROSS:
        adopt_cross(states.cross)
    elif kind == CROSSTALK:
        adopt_crosstalk(states.crosstalk)
    elif kind == LEADSCREW:
        adopt_leadscrew(before.leadscrew, after.leadscrew, states.leadscrew, motion, added)
    elif kind == BACKLASH:
        adopt_backlash(before.backlash, after.backlash, states.backlash)
    elif kind == FRICTION:
        adopt_friction(before.friction, after.friction, states.friction)


def move_compensation(kind: int, tables: CompensationTables, by: int) -> None:
    """Follow the numbers of a kind to another place in the pool."""
    if kind == CROSS:
        move_cross(tables.cross, by)
    elif kind == PLANE:
        move_plane(tables.plane, by)
    elif kind == CROSSTALK:
        move_crosstalk(tables.crosstalk, by)
    elif kind == LEADSCREW:
        move_leadscrew(tables.leadscrew, by)
    elif kind == FRICTION:
        move_friction(tables.friction, by)


def compensation_fits(kind: int, pool: Vec, tables: CompensationTables, axes: int, numbers: int) -> bool:
    """Tell whether the table of a kind can be used: every index means something, every divisor is not 0."""
    if kind == CROSS:
        return cross_fits(pool, tables.cross, axes, numbers)
    if kind == PLANE:
        return plane_fits(tables.plane, axes, numbers)
    if kind == CROSSTALK:
        return crosstalk_fits(pool, tables.crosstalk, axes, numbers)
    if kind == TEMPERATURE:
        return temperature_fits(tables.temperature)
    if kind == LEADSCREW:
        return leadscrew_fits(pool, tables.leadscrew, axes, numbers)
    if kind == BACKLASH:
        return backlash_fits(tables.backlash)
    return friction_fits(pool, tables.friction, numbers)


def compensation_absent(kind: int, tables: CompensationTables) -> bool:
    """Tell whether a kind without a table has no lengths either: an update goes by them."""
    if kind == LEADSCREW:
        return tables.leadscrew.reversal_cycles == 0
    if kind == BACKLASH:
        return tables.backlash.reversal_cycles == 0
    return kind != FRICTION or (tables.friction.curve.points == 0 and tables.friction.lookahead == 0)


def compensation_state_fits(kind: int, tables: CompensationTables, states: CompensationStates) -> bool:
    """Tell whether the state of a kind belongs to its table: every index means something in it."""
    if kind == CROSS:
        return cross_state_fits(tables.cross, states.cross)
    if kind == CROSSTALK:
        return crosstalk_state_fits(tables.crosstalk, states.crosstalk)
    if kind == LEADSCREW:
        return leadscrew_state_fits(tables.leadscrew, states.leadscrew)
    if kind == BACKLASH:
        return backlash_state_fits(tables.backlash, states.backlash)
    return kind != FRICTION or friction_state_fits(tables.friction, states.friction)
