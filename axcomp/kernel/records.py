"""The four records of the engine: what is fixed (Tables), remembered (State), given (Inputs) and returned (Outputs).

Positions are in mm or °, velocities and accelerations in the same unit per s and s². A table of numbers is an offset
into the pool. An axis is meant by its index, 0 … ``axis_count`` − 1, a kind of compensation by its number.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .compensations import KINDS, CompensationInputs, CompensationStates, CompensationTables
from .motion import AXES, Motion
from .record import APART
from .shift import ShiftState
from .switching import SwitchState, SwitchTable
from .volumetric_records import VOLUMETRICS, VolumetricInputs, VolumetricOutputs, VolumetricState, VolumetricTable

ERROR_INPUT = 901  # AXC-901: an input of the axis is not a finite number
ERROR_UPDATE = 902  # AXC-902: an update does not fit the running machine
ERROR_SWITCH = 904  # AXC-904: the input of a switch is neither −1, 0 nor 1


@dataclass(slots=True)
class AxisTable:
    """What is fixed for an axis."""

    number: int  # logical axis number
    first: int  # of its numbers in the pool
    numbers: int
    modulo_range: float  # 0: no modulo axis
    shift_cycles: int  # over which a shift is released, at least 1
    kinds: int  # that the axis activates, with or without a table
    kind: Annotated[list[int], KINDS]  # their numbers, ascending
    switching: Annotated[list[SwitchTable], KINDS]
    compensation: CompensationTables


@dataclass(slots=True)
class AxisState:
    """What an axis remembers."""

    started: bool
    held: bool  # this cycle's inputs cannot be used
    settled: bool  # no switch changes until a command, a reference or a release does
    unreferenced: bool  # the input in the last cycle
    released: bool  # the input in the last cycle
    error: int  # stays until reset
    stop_request: bool  # stays until reset, or until a volumetric compensation is switched on again
    added: float  # to the setpoint before the leadscrew, in the last cycle
    volumetric_correction: float  # of all volumetric compensations, this cycle
    volumetric_shift: float  # what they have absorbed
    shift: ShiftState
    switching: Annotated[list[SwitchState], KINDS]
    compensation: CompensationStates


@dataclass(slots=True)
class AxisInputs:
    """What the controller says about an axis in this cycle."""

    setpoint: float
    velocity: float
    acceleration: float
    actual_position: float
    unreferenced: bool
    fault: bool
    no_move: bool
    released: bool  # a rising edge: the axis is given back, manual compensations off
    wanted: Annotated[list[int], KINDS]  # switches: 0 as the lists say, 1 on, −1 off
    compensation: CompensationInputs


@dataclass(slots=True)
class AxisOutputs:
    """What the engine returns for an axis."""

    corrected_setpoint: float
    display_position: float
    correction: float  # sum of all
    contribution: Annotated[list[float], KINDS]  # to the setpoint; of friction: to the current
    active: Annotated[list[bool], KINDS]
    volumetric_correction: float
    setpoint_shift: float
    stop_request: bool
    error: int


@dataclass(slots=True)
class Tables:
    """Everything that is fixed while the machine runs, besides the pool of numbers."""

    cycle_time: float
    axis_count: int
    axis: Annotated[list[AxisTable], AXES, APART]
    volumetrics: int  # the last configured one and those before it
    volumetric: Annotated[list[VolumetricTable], VOLUMETRICS, APART]


@dataclass(slots=True)
class State:
    """Everything that is remembered from cycle to cycle; a copy with its lists is a snapshot."""

    motion: Motion
    axis: Annotated[list[AxisState], AXES, APART]
    tool_length: float  # mm; the last one that was finite
    volumetric: Annotated[list[VolumetricState], VOLUMETRICS, APART]


@dataclass(slots=True)
class Inputs:
    """Everything that is given in a cycle."""

    reset: bool
    program_end: bool
    derive_motion: bool  # velocities and accelerations are not given: they follow from the setpoints
    axis: Annotated[list[AxisInputs], AXES, APART]
    tool_length: float  # mm
    volumetric: Annotated[list[VolumetricInputs], VOLUMETRICS, APART]


@dataclass(slots=True)
class Outputs:
    """Everything that a cycle returns."""

    axis: Annotated[list[AxisOutputs], AXES, APART]
    volumetric: Annotated[list[VolumetricOutputs], VOLUMETRICS, APART]
