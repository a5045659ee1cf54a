"""The four records of the engine: what is fixed (Tables), remembered (State), given (Inputs) and returned (Outputs).

Positions are in mm or °, velocities and accelerations in the same unit per s and s². A table of numbers is an offset
into a pool. An axis is meant by its index, 0 … ``axis_count`` − 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .record import Vec
from .volumetric_records import VOLUMETRICS, VolumetricInputs, VolumetricOutputs, VolumetricState, VolumetricTable

AXES = 32
DELAY_LINE = 249  # delay_cycles < 249 (P-COMP-00058)

ERROR_INPUT = 901  # AXC-901: an input of the axis is not a finite number
ERROR_UPDATE = 902  # AXC-902: an update does not fit the running machine
ERROR_LEADSCREW_POINTS = 110638  # an update changes max_points (P-COMP-00059)
ERROR_CROSS_POINTS = 110639  # P-COMP-00060
ERROR_PLANE_POINTS = 110640  # P-COMP-00061
ERROR_FRICTION_POINTS = 110641  # P-COMP-00062


@dataclass(slots=True)
class SwitchTable:
    """How a compensation switches on and off."""

    configured: bool
    manual: bool  # by command only; reset, program end and release switch off
    at_standstill: bool  # a command waits until the slave stands still
    cycles: int  # of the transition, at least 1 (1: at once)


@dataclass(slots=True)
class SwitchState:
    """Where a compensation stands between off and on."""

    enable: bool  # the input in the last cycle: its edges are the commands
    command: bool  # what was last commanded
    granted: bool  # the command, once it may act
    no_move: bool  # the command came with NO_MOVE
    step: int  # k of w(k)
    weight: float  # w(k), 0 … 1
    absorbed: float  # change of the weight that NO_MOVE takes out of the output, this cycle only


@dataclass(slots=True)
class Curve:
    """Piecewise linear y(x): ``points`` abscissae and as many ordinates in the pool."""

    points: int
    x: int
    y: int


@dataclass(slots=True)
class Lookup:
    """Where a search ended last time."""

    interval: int


@dataclass(slots=True)
class CrossTable:
    """Cross compensation (kw.crosscomp)."""

    switching: SwitchTable
    max_points: int  # entries the controller reserves
    master: int
    curve: Curve


@dataclass(slots=True)
class CrossState:
    """What the cross compensation remembers."""

    switching: SwitchState
    lookup: Lookup


@dataclass(slots=True)
class PlaneTable:
    """Plane compensation (kw.crosscomp2); correction[j][i] at values + j * points1 + i."""

    switching: SwitchTable
    max_points: int  # entries the controller reserves
    master1: int
    master2: int
    start1: float
    start2: float
    interval1: float
    interval2: float
    points1: int
    points2: int
    values: int


@dataclass(slots=True)
class PlaneState:
    """What the plane compensation remembers."""

    switching: SwitchState


@dataclass(slots=True)
class CrosstalkTable:
    """Crosstalk compensation (kw.crosstalk).

    ``values`` has four blocks of ``tests`` numbers: acceleration in positive and negative motion, deceleration in
    positive and negative motion. In the old variant ``curve`` is the correction over the signed acceleration.
    """

    switching: SwitchTable
    variant: int  # one of the CROSSTALK_ constants
    master: int
    adaptation1: int
    adaptation2: int
    acceleration: float
    deceleration: float  # < 0
    velocity_dependent: bool
    curve: Curve
    tests: int
    values: int
    points1: int  # grid: abscissae of the first adaptation axis; values are [j][i] as in a plane
    points2: int
    x1: int  # abscissae of the first adaptation axis, or the tests' positions
    x2: int
    triangles: int  # scattered tests: three test numbers each
    triangle: int
    edges: int  # hull of the tests: two test numbers each
    edge: int


@dataclass(slots=True)
class CrosstalkState:
    """What the crosstalk compensation remembers."""

    switching: SwitchState
    lookup: Lookup
    lookup2: Lookup
    negative: bool  # the master's last motion was negative
    outside: bool  # the adaptation axes have left the hull of the tests


@dataclass(slots=True)
class LeadscrewTable:
    """Leadscrew error compensation (kw.ssfk); both directions share the interpolation points."""

    switching: SwitchTable
    max_points: int  # entries the controller reserves
    positive: Curve
    negative: Curve
    bilateral: bool
    without_other: bool
    modulo: bool
    reversal_cycles: int  # of the change-over between the directions, at least 1 (1: at once)


@dataclass(slots=True)
class LeadscrewState:
    """What the leadscrew compensation remembers."""

    switching: SwitchState
    lookup: Lookup
    position: float  # input when it last changed
    backward: bool  # its last change was negative
    reversal_step: int  # reversal_cycles: positive values, 0: negative values


@dataclass(slots=True)
class FrictionTable:
    """Friction compensation (frict_comp)."""

    switching: SwitchTable
    max_points: int  # entries the controller reserves
    curve: Curve
    scaling: float
    position_delay: float
    lookahead: int
    delay: int


@dataclass(slots=True)
class FrictionState:
    """What the friction compensation remembers."""

    switching: SwitchState
    lookup: Lookup
    direction: int  # sign of the last velocity that was not 0
    reversal_position: float
    built_up: bool  # the axis has gone position_delay since
    since_reversal: int  # cycles, at most lookahead
    head: int  # where the delay line is written next
    line: Annotated[list[float], DELAY_LINE]


@dataclass(slots=True)
class ShiftState:
    """The offsets that NO_MOVE has taken out of the output: what waits, and what is being released."""

    before_leadscrew: float  # of cross, plane and crosstalk, in force now: the leadscrew's input contains it
    leadscrew: float
    waiting_before_leadscrew: float  # absorbed since the last release began
    waiting_leadscrew: float
    released_before_leadscrew: float  # as it was when the release began
    released_leadscrew: float
    step: int  # of the release: shift_cycles … 0; 0: none is under way


@dataclass(slots=True)
class AxisTable:
    """What is fixed for an axis; its tables lie in its pool."""

    number: int  # logical axis number
    pool: Vec
    modulo_range: float  # 0: no modulo axis
    shift_cycles: int  # over which a shift is released, at least 1
    cross: CrossTable
    plane: PlaneTable
    crosstalk: CrosstalkTable
    leadscrew: LeadscrewTable
    friction: FrictionTable


@dataclass(slots=True)
class AxisState:
    """What an axis remembers. Its setpoint, velocity and acceleration are the last ones that were finite."""

    started: bool
    held: bool  # this cycle's inputs cannot be used
    moving: bool  # the setpoint changes or a velocity is commanded
    setpoint: float
    velocity: float
    acceleration: float
    error: int  # stays until reset
    stop_request: bool  # stays until reset, or until a volumetric compensation is switched on again
    volumetric_correction: float  # of all volumetric compensations, this cycle
    volumetric_shift: float  # what they have absorbed
    shift: ShiftState
    cross: CrossState
    plane: PlaneState
    crosstalk: CrosstalkState
    leadscrew: LeadscrewState
    friction: FrictionState


@dataclass(slots=True)
class AxisInputs:
    """What the controller says about an axis in this cycle."""

    setpoint: float
    velocity: float
    acceleration: float
    actual_position: float
    referenced: bool
    fault: bool
    no_move: bool
    cross_enable: bool
    plane_enable: bool
    crosstalk_enable: bool
    leadscrew_enable: bool
    friction_enable: bool


@dataclass(slots=True)
class AxisOutputs:
    """What the engine returns for an axis."""

    corrected_setpoint: float
    current: float
    display_position: float
    correction: float  # sum of all
    cross_correction: float
    plane_correction: float
    crosstalk_correction: float
    leadscrew_correction: float
    volumetric_correction: float
    setpoint_shift: float
    cross_active: bool
    plane_active: bool
    crosstalk_active: bool
    leadscrew_active: bool
    friction_active: bool
    stop_request: bool
    error: int


@dataclass(slots=True)
class Tables:
    """Everything that is fixed while the machine runs."""

    cycle_time: float
    axis_count: int
    axis: Annotated[list[AxisTable], AXES]
    volumetrics: int  # the last configured one and those before it
    volumetric: Annotated[list[VolumetricTable], VOLUMETRICS]
    pool: Vec  # of the volumetric compensations


@dataclass(slots=True)
class State:
    """Everything that is remembered from cycle to cycle; it holds no references, a copy is a snapshot."""

    axis: Annotated[list[AxisState], AXES]
    tool_length: float  # mm; the last one that was finite
    volumetric: Annotated[list[VolumetricState], VOLUMETRICS]


@dataclass(slots=True)
class Inputs:
    """Everything that is given in a cycle."""

    reset: bool
    program_end: bool
    axis: Annotated[list[AxisInputs], AXES]
    tool_length: float  # mm
    volumetric: Annotated[list[VolumetricInputs], VOLUMETRICS]


@dataclass(slots=True)
class Outputs:
    """Everything that a cycle returns."""

    axis: Annotated[list[AxisOutputs], AXES]
    volumetric: Annotated[list[VolumetricOutputs], VOLUMETRICS]
