"""What the lists mean: the compensations of a machine in mm, degrees and seconds.

Positions and corrections of a translatory axis are in mm, of a rotary axis or spindle in °; velocities in mm/s or °/s,
accelerations in mm/s². Only what acts is here: a compensation that its axis does not activate, or whose table is not
plausible, is None. The classes are frozen; two machines are equal when they correct equally.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .volumetric import LINEAR, Volumetric

AXES_MAX = 32
"""Compensation lists a start-up list can name (P-STUP-00016), and so the axes of a machine."""


class AxisType(enum.Enum):
    """Kind of an axis (P-AXIS-00018); the value is the number in the list."""

    TRANSLATORY = 1
    ROTARY = 2
    SPINDLE = 4


def _span(values: Sequence[float], unit: str = "") -> str:
    return f"{min(values):g} … {max(values):g}{unit}" if values else "empty"


@dataclass(frozen=True, repr=False)
class Leadscrew:
    """Leadscrew error compensation (``kw.ssfk``): subtracted from the setpoint of its own axis.

    Attributes
    ----------
    positions : tuple of float
        Interpolation points, strictly ascending (P-COMP-00018/00019/00025).
    positive : tuple of float
        Actual − programmed position in positive motion, one for each point (P-COMP-00023).
    negative : tuple of float or None
        The same in negative motion (P-COMP-00024); None: unilateral, ``positive`` serves both (P-COMP-00021).
    modulo : bool
        The position is folded into one modulo range of the axis, beginning at the first point (P-COMP-00022).
    without_other_compensations : bool
        Table position and direction come from the raw setpoint (P-COMP-00057).
    manual_activation : bool
        On only by command (P-COMP-00028).
    max_points : int
        Entries the controller reserves; cannot change while it runs (P-COMP-00059).
    """

    positions: tuple[float, ...]
    positive: tuple[float, ...]
    negative: tuple[float, ...] | None = None
    modulo: bool = False
    without_other_compensations: bool = False
    manual_activation: bool = False
    max_points: int = 1500

    def __repr__(self) -> str:
        sides = "unilateral" if self.negative is None else "bilateral"
        return f"Leadscrew({len(self.positions)} points {_span(self.positions)}, {sides})"


@dataclass(frozen=True, repr=False)
class Cross:
    """Cross (sag) compensation (``kw.crosscomp``): added to the slave, looked up at the master's raw setpoint.

    Attributes
    ----------
    master : int
        Logical number of the master axis (P-COMP-00005).
    positions : tuple of float
        Master positions, strictly ascending (P-COMP-00006).
    corrections : tuple of float
        Correction of the slave, one for each position (P-COMP-00007).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00026).
    manual_activation : bool
        On only by command (P-COMP-00029).
    max_points : int
        Entries the controller reserves (P-COMP-00060).
    """

    master: int
    positions: tuple[float, ...]
    corrections: tuple[float, ...]
    n_cycles: int = 0
    manual_activation: bool = False
    max_points: int = 1001

    def __repr__(self) -> str:
        return f"Cross(master {self.master}, {len(self.positions)} points {_span(self.positions)})"


@dataclass(frozen=True, repr=False)
class Plane:
    """Plane compensation (``kw.crosscomp2``): added to the slave, bilinear over the raw setpoints of two masters.

    Attributes
    ----------
    master1, master2 : int
        Logical numbers of the master axes (P-COMP-00014, P-COMP-00015).
    start1, start2 : float
        First grid position of either master (P-COMP-00012, P-COMP-00013).
    interval1, interval2 : float
        Distance of grid positions, > 0 (P-COMP-00009, P-COMP-00032, P-COMP-00033).
    corrections : tuple of tuple of float, shape (points of master 2, points of master 1)
        ``corrections[j][i]``: the first index belongs to the second master (P-COMP-00016).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00027).
    manual_activation : bool
        On only by command (P-COMP-00030).
    max_points : int or None
        Entries the controller reserves (P-COMP-00061); None where the list does not say: 10201, at most 101 each.
    """

    master1: int
    master2: int
    start1: float
    start2: float
    interval1: float
    interval2: float
    corrections: tuple[tuple[float, ...], ...]
    n_cycles: int = 0
    manual_activation: bool = False
    max_points: int | None = None

    def __repr__(self) -> str:
        rows, columns = len(self.corrections), len(self.corrections[0])
        return f"Plane(masters {self.master1} and {self.master2}, {columns} × {rows} points)"


@dataclass(frozen=True, repr=False)
class Friction:
    """Friction compensation (``frict_comp``): an additional motor current over the setpoint velocity.

    Attributes
    ----------
    velocities : tuple of float
        Velocities of the table, ≥ 0, strictly ascending, mm/s or °/s (P-COMP-00046).
    currents : tuple of float
        Current at each velocity, in the drive's own unit (P-COMP-00047).
    scaling : float
        Factor of all currents: ``scaling_factor``/1000 (P-COMP-00045).
    position_delay : float
        Distance from a reversal over which the current builds up, mm or ° (P-COMP-00043).
    reversal_lookahead : int
        Cycles over which it decays before a reversal, 0..4 (P-COMP-00044).
    delay_cycles : int
        Cycles by which the current is put out late, 0..248 (P-COMP-00058).
    max_points : int
        Entries the controller reserves (P-COMP-00062).
    """

    velocities: tuple[float, ...]
    currents: tuple[float, ...]
    scaling: float = 1.0
    position_delay: float = 0.0
    reversal_lookahead: int = 0
    delay_cycles: int = 0
    max_points: int = 20

    def __repr__(self) -> str:
        return f"Friction({len(self.velocities)} points {_span(self.velocities, '/s')}, {self.scaling:g} ×)"


@dataclass(frozen=True)
class CrosstalkTest:
    """One acceleration test of the crosstalk compensation (``kw.crosstalk.position[i]``), all in mm.

    Attributes
    ----------
    position1, position2 : float
        Positions of the adaptation axes (P-COMP-00085, P-COMP-00086).
    accelerate_positive, accelerate_negative : float
        Correction at the acceleration of the tests, by direction of motion (P-COMP-00087, P-COMP-00088).
    decelerate_positive, decelerate_negative : float
        Correction at the deceleration of the tests (P-COMP-00089, P-COMP-00090).
    """

    position1: float = 0.0
    position2: float = 0.0
    accelerate_positive: float = 0.0
    accelerate_negative: float = 0.0
    decelerate_positive: float = 0.0
    decelerate_negative: float = 0.0


@dataclass(frozen=True, repr=False)
class Crosstalk:
    """Crosstalk compensation (``kw.crosstalk``) of manual 000: added to the slave while the master accelerates.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    acceleration, deceleration : float
        Of the tests, mm/s²: > 0 and < 0 (P-COMP-00066, P-COMP-00067).
    mode : int
        1: one test; 2: linear over ``adaptation1``; 3: over both adaptation axes (P-COMP-00082).
    tests : tuple of CrosstalkTest
        1 to 15 of them (P-COMP-00083).
    adaptation1, adaptation2 : int or None
        Logical numbers of the adaptation axes (P-COMP-00080, P-COMP-00081); None where the mode needs none.
    velocity_dependent : bool
        Corrections differ by the direction of the master (P-COMP-00084).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00065).
    """

    master: int
    acceleration: float
    deceleration: float
    mode: int
    tests: tuple[CrosstalkTest, ...]
    adaptation1: int | None = None
    adaptation2: int | None = None
    velocity_dependent: bool = False
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"Crosstalk(master {self.master}, mode {self.mode}, {len(self.tests)} tests)"


@dataclass(frozen=True, repr=False)
class CrosstalkCurve:
    """Crosstalk compensation (``kw.crosstalk``) of manual 001: linear over the master's acceleration.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    accelerations : tuple of float
        mm/s², strictly ascending, with sign; 1 to 5 of them (P-COMP-00066).
    corrections : tuple of float
        mm, one for each acceleration (P-COMP-00067).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00073).
    """

    master: int
    accelerations: tuple[float, ...]
    corrections: tuple[float, ...]
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"CrosstalkCurve(master {self.master}, {len(self.accelerations)} points {_span(self.accelerations)})"


@dataclass(frozen=True)
class ModuloRange:
    """Range of a modulo axis in ° (P-AXIS-00127, P-AXIS-00126): positions repeat every ``end − start``."""

    start: float = 0.0
    end: float = 360.0


@dataclass(frozen=True, repr=False)
class Axis:
    """An axis with the compensations that act on it.

    Attributes
    ----------
    number : int
        Logical axis number, 1..65535, unique (P-AXIS-00016, P-COMP-00001).
    name : str
        ``kopf.log_achs_name``, else ``axis<number>``; unique.
    type : AxisType
        P-AXIS-00018.
    modulo : ModuloRange or None
        None for an axis without modulo counting (P-AXIS-00015).
    backlash_cycles : int
        Cycles over which the leadscrew compensation changes direction, 0..20 (P-AXIS-00243).
    volumetric_limit : float or None
        Largest volumetric correction, mm; None: not defined, which keeps the compensation off (P-AXIS-00525).
    gantry_master : int or None
        Logical number of the axis whose volumetric corrections it gets too; None: it is no gantry slave (P-AXIS-00070).
    """

    number: int
    name: str
    type: AxisType = AxisType.TRANSLATORY
    modulo: ModuloRange | None = None
    backlash_cycles: int = 0
    volumetric_limit: float | None = None
    gantry_master: int | None = None
    cross: Cross | None = None
    plane: Plane | None = None
    crosstalk: Crosstalk | CrosstalkCurve | None = None
    leadscrew: Leadscrew | None = None
    friction: Friction | None = None

    @property
    def unit(self) -> str:
        """Unit of the axis' positions: ``mm`` or ``deg``."""
        return "mm" if self.type is AxisType.TRANSLATORY else "deg"

    def compensations(self) -> Iterator[tuple[str, object]]:
        """Yield (kind, compensation) for those that act, in the order of a cycle."""
        for kind in KINDS:
            compensation = getattr(self, kind)
            if compensation is not None:
                yield kind, compensation

    def __repr__(self) -> str:
        parts = [f"{self.number} {self.name}", self.type.name.lower(), *(repr(c) for _, c in self.compensations())]
        return f"Axis({', '.join(parts)})"


KINDS = ("cross", "plane", "crosstalk", "leadscrew", "friction")
"""The axis compensations in the order of a cycle, as they are called everywhere: fields, FMU variables, commands."""


@dataclass(frozen=True, repr=False)
class Machine:
    """All axes of a machine in the order of its lists.

    Attributes
    ----------
    axes : tuple of Axis
        At most ``AXES_MAX``; numbers and names are unique.
    volumetric : tuple of Volumetric
        Compensations over several axes, at most five with different ``index``.
    """

    axes: tuple[Axis, ...] = ()
    volumetric: tuple[Volumetric, ...] = ()

    def index_of(self, number: int) -> int:
        """Return the place in ``axes`` of the axis with a logical number; KeyError if there is none."""
        for index, axis in enumerate(self.axes):
            if axis.number == number:
                return index
        raise KeyError(number)

    def axis(self, name: str) -> Axis:
        """Return the axis called ``name``; KeyError if there is none."""
        for axis in self.axes:
            if axis.name == name:
                return axis
        raise KeyError(name)

    def members(self, volumetric: Volumetric) -> dict[int, str]:
        """Return place in ``axes`` → letter of the axes that take part; gantry slaves have their master's letter."""
        letters = {number: letter for letter, number in volumetric.axes}
        leaders = [axis.number if axis.number in letters else axis.gantry_master for axis in self.axes]
        return {place: letters[number] for place, number in enumerate(leaders) if number in letters}

    def corrected_by(self, volumetric: Volumetric) -> frozenset[int]:
        """Return the numbers of the axes that a volumetric compensation corrects: X, Y, Z and their gantry slaves."""
        members = self.members(volumetric)
        return frozenset(self.axes[place].number for place, letter in members.items() if letter in LINEAR)

    def __repr__(self) -> str:
        return "Machine(\n" + "".join(f"  {part!r},\n" for part in (*self.axes, *self.volumetric)) + ")"
