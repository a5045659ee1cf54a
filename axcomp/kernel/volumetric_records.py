"""Records of the volumetric compensation. Lengths in mm, positions of rotary axes in °, angular errors in rad.

An axis of the model is meant by its letter's number: X, Y, Z, A, B, C = 0 … 5. Its twelve errors begin at
``ERRORS_OF_AXIS · letter``: the position errors X0 Y0 Z0 A0 B0 C0, then the component errors EX EY EZ EA EB EC.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

VOLUMETRICS = 5  # P-STUP-00101
MEMBERS = 32
LINEAR = 3
LETTERS = 6
ERRORS_OF_AXIS = 12
ERRORS = LETTERS * ERRORS_OF_AXIS

X0 = 0  # first of the position errors of an axis, lengths: X0, Y0, Z0
A0 = 3  # and angles: A0, B0, C0
B0 = 4
C0 = 5
EX = 6  # first of its component errors: EX, EY, EZ
EA = 9  # and EA, EB, EC
EB = 10
EC = 11

INTERPOLATE_GRID = 0
INTERPOLATE_SCATTER = 1
INTERPOLATE_PATH = 2
TOGETHER = 4  # scattered nodes whose coordinates stand together
IN_BOX = 8  # sections of a path that share a box
BOXES = 64  # that wait at most while the nearest section is looked for

ERROR_LIMIT_UNDEFINED = 911  # AXC-911: no s_limit where one is needed
ERROR_LIMIT_EXCEEDED = 912  # AXC-912: a correction is larger than s_limit
ERROR_SINGULAR = 913  # AXC-913: X, Y and Z cannot move the tool in three directions here
ERROR_PROGRAM_END = 914  # AXC-914: program end while a compensation of its channel was on


@dataclass(slots=True)
class ErrorBlock:
    """Errors over the same nodes.

    Value p of node n is at ``values + n * errors + p`` in the pool, the number of error p at ``error + p``. On a grid
    the last argument changes fastest. Otherwise coordinate d of node n is at ``knots[0] + n * arguments + d``.
    Of scattered nodes coordinate d of the ``TOGETHER`` from node n on is at ``knots[0] + n * arguments + d * TOGETHER``
    and behind; the last node is repeated until these are full.
    A path has boxes around its sections: box 1 around all, boxes 2k and 2k + 1 around the halves of what is in box k,
    the last ``points[0]`` of them, a power of 2, around ``IN_BOX`` sections each; the least coordinate d of box k is at
    ``steps[0] + 2 * (k * arguments + d)``, the greatest behind.
    """

    interpolation: int  # one of the INTERPOLATE_ constants
    nodes: int
    errors: int
    error: int
    values: int
    arguments: int  # 0 … 6
    argument: Annotated[list[int], LETTERS]  # letter of each
    start: Annotated[list[float], LETTERS]  # of the turn that its position is folded into
    period: Annotated[list[float], LETTERS]  # length of that turn; 0: not folded
    points: Annotated[list[int], LETTERS]  # of the grid along it
    knots: Annotated[list[int], LETTERS]  # where they are in the pool, ascending
    steps: Annotated[list[int], LETTERS]  # where the pool has for each of points + 1 equal steps the knot before it
    steps_per_unit: Annotated[list[float], LETTERS]


@dataclass(slots=True)
class VolumetricTable:
    """What is fixed for a volumetric compensation; a member is an axis that takes part, gantry slaves included."""

    configured: bool
    manual: bool  # by command only
    associated: bool  # program end while on is an error
    cycles: int  # of a switch, at least 1 (1: at once)
    members: int
    member: Annotated[list[int], MEMBERS]  # index of the axis
    member_letter: Annotated[list[int], MEMBERS]
    member_limit: Annotated[list[float], MEMBERS]  # largest correction; 0: not defined
    axis: Annotated[list[int], LETTERS]  # index of the axis that is X … C; 0 where there is none
    offset: Annotated[list[float], LETTERS]  # added to its setpoint
    chain_length: int
    chain: Annotated[list[int], LETTERS]  # letters from the workpiece to the tool
    workpiece_axes: int
    exact: Annotated[list[bool], LETTERS]  # the axis has no errors
    steepness: float  # bound of how much the lengths among the errors change with X, Y and Z, mm per mm
    angular_steepness: float  # the same of the angles, rad per mm
    reach: float  # lever of an angle besides X, Y, Z and the tool length, mm
    velocity: Annotated[list[float], LINEAR]  # largest change by a filter in a cycle, mm; 0: not limited
    column: Annotated[list[int], LINEAR]  # how many linear axes are between X, Y or Z and the tool
    alternative: bool
    tool_position: Annotated[list[float], LINEAR]
    tool_orientation: Annotated[list[float], LINEAR]
    center: Annotated[list[float], 9]  # of A, B, C
    direction: Annotated[list[float], 18]  # of X … C, unit vectors
    sign: Annotated[list[float], LINEAR]  # −1: negated, 0: set to zero
    constants: int  # errors that do not depend on anything
    constant: int  # their numbers in the pool, and behind them their values
    blocks: int
    block: Annotated[list[ErrorBlock], ERRORS]


@dataclass(slots=True)
class VolumetricState:
    """What a volumetric compensation remembers.

    Its filters go from 0 to 1 and back along ``smooth``: of the switch, of the tool length, and of releasing shifts.
    """

    started: bool
    wanted: int  # the input in the last cycle: its changes are the commands
    command: bool  # what was last commanded
    no_move: bool  # the command came with NO_MOVE
    wanted_factor: Annotated[list[float], LINEAR]  # CFACT of the command
    on: bool  # the command, while it can be obeyed
    progress: float  # of the switch
    weight: float  # the same along the filter
    factor: Annotated[list[float], LINEAR]  # the wanted one when it was last switched on
    taking_part: Annotated[list[bool], LINEAR]  # False: dropped, its correction has become a shift
    absorbed: Annotated[list[bool], LINEAR]  # what its correction changes in this cycle goes into the shift
    waiting: Annotated[list[bool], LINEAR]  # its axis is still in the motion in which this came about
    value: Annotated[list[float], LINEAR]  # correction at full weight
    section: Annotated[list[int], ERRORS]  # of its path that a block follows, counted from 1; 0: not known yet
    contribution: Annotated[list[float], LINEAR]  # weight · value
    shift: Annotated[list[float], LINEAR]  # what was absorbed: it stays until the next motion or switch
    held_shift: Annotated[list[float], LINEAR]  # the shift when its release began
    release: Annotated[list[float], LINEAR]  # how much of its release is left
    tool_length: float  # in use, mm
    old_tool_length: float  # in use when the last change came
    new_tool_length: float  # as it was last given
    tool_progress: float
    tool_change: Annotated[list[float], LINEAR]  # of the correction by the change that is under way


@dataclass(slots=True)
class VolumetricInputs:
    """What the controller says about a volumetric compensation in this cycle."""

    wanted: int  # switch: 0 as the lists say, 1 on, −1 off
    no_move: bool
    reduction_x: float  # 1 − CFACT_X; it belongs to the command in whose cycle it is given, as no_move does
    reduction_y: float
    reduction_z: float


@dataclass(slots=True)
class VolumetricOutputs:
    """What the engine returns for a volumetric compensation."""

    active: bool
