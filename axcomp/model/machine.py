"""What the lists mean: the axes of a machine with the compensations that act on them, in mm, degrees and seconds.

Positions and corrections of a translatory axis are in mm, of a rotary axis or spindle in °; velocities in mm/s or °/s,
accelerations in mm/s². Only what acts is here: a compensation that its axis does not activate, or whose table is not
plausible, is not. The classes are frozen; two machines are equal when they correct equally.
"""

from __future__ import annotations

import builtins
import enum
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, TypeVar

from .html import as_html
from .volumetric import LINEAR, Volumetric

AXES_MAX = 32
"""Compensation lists a start-up list can name (P-STUP-00016), and so the axes of a machine."""

CYCLE_TIME = 0.001
"""Default cycle time of the position controller in s: no list names it."""

LARGEST_STEP = 10_000_000
"""Cycles that a communication step may have, unless the host allows more: a longer one would seem to hang."""
CYCLE_TIME_MAX = 1e3
"""Cycle times are shorter, s."""


class AxisType(enum.Enum):
    """Kind of an axis (P-AXIS-00018); the value is the number in the list."""

    TRANSLATORY = 1
    ROTARY = 2
    SPINDLE = 4


class Compensation:
    """What acts on one axis; room ``kinds`` has a module for each kind.

    Attributes
    ----------
    kind : str
        Given where the class is defined; there are classes that share one.
    manual_activation : bool
        On only by command.
    n_cycles : int
        Cycles of smooth switching, 0..20.
    """

    kind: ClassVar[str]
    manual_activation: bool = False
    n_cycles: int = 0

    _order: ClassVar[dict[str, int]] = {}

    def __init_subclass__(cls, kind: str = "", **rest: Any) -> None:
        super().__init_subclass__(**rest)
        if kind:
            cls.kind = kind
            Compensation._order.setdefault(kind, len(Compensation._order))

    @staticmethod
    def arrange(kinds: Sequence[str]) -> None:
        """Say in which order kinds act in a cycle."""
        Compensation._order.update((kind, place) for place, kind in enumerate(kinds))

    @staticmethod
    def is_kind(name: str) -> bool:
        """Tell whether there is a kind of this name."""
        return name in Compensation._order

    @property
    def order(self) -> int:
        """Place of the kind in a cycle."""
        return Compensation._order[self.kind]


AnyCompensation = TypeVar("AnyCompensation", bound=Compensation)


SHORTEST_RANGE = 1e-6
"""Modulo ranges are longer, °."""


@dataclass(frozen=True)
class ModuloRange:
    """Range of a modulo axis in ° (P-AXIS-00127, P-AXIS-00126): positions repeat every ``end − start``."""

    start: float = 0.0
    end: float = 360.0

    @property
    def length(self) -> float:
        """Return after how many ° positions repeat."""
        return self.end - self.start


@dataclass(frozen=True, repr=False, init=False)
class Axis:
    """An axis with the compensations that act on it.

    A compensation is given and taken by the name of its kind: ``Axis(1, "X", cross=Cross(…))``, ``axis.cross``,
    ``replace(axis, cross=None)``; ``axis.of(Cross)`` is the same with a type.

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
        Cycles over which leadscrew and backlash compensation change direction, 0..20 (P-AXIS-00243).
    volumetric_limit : float or None
        Largest volumetric correction, mm; None: not defined, which keeps the compensation off (P-AXIS-00525).
    volumetric_velocity : float or None
        Largest velocity at which volumetric corrections are switched, mm/s; None: any (P-AXIS-00526).
    gantry_master : int or None
        Logical number of the axis whose volumetric corrections it gets too; None: it is no gantry slave (P-AXIS-00070).
    compensations : tuple of Compensation
        In the order of a cycle, at most one of each kind.
    reserved : mapping of str to int
        Kinds that the axis activates without a table that acts → entries the controller reserves for one: a table may
        come by an update.
    by_kind : Compensation
        More compensations, each by the name of its kind.

    Examples
    --------
    >>> from axcomp import Axis
    >>> from axcomp.kinds import Backlash
    >>> axis = Axis(1, "X", backlash_cycles=5, backlash=Backlash(0.01))
    >>> axis.unit, axis.kinds, axis.cross
    ('mm', ('backlash',), None)
    """

    number: int
    name: str
    type: AxisType
    modulo: ModuloRange | None
    backlash_cycles: int
    volumetric_limit: float | None
    volumetric_velocity: float | None
    gantry_master: int | None
    compensations: tuple[Compensation, ...]
    reserved: tuple[tuple[str, int], ...]

    def __init__(
        self,
        number: int,
        name: str,
        type: AxisType = AxisType.TRANSLATORY,  # noqa: A002
        modulo: ModuloRange | None = None,
        backlash_cycles: int = 0,
        volumetric_limit: float | None = None,
        volumetric_velocity: float | None = None,
        gantry_master: int | None = None,
        compensations: tuple[Compensation, ...] = (),
        reserved: Mapping[str, int] | tuple[tuple[str, int], ...] = (),
        **by_kind: Compensation | None,
    ) -> None:
        for kind in by_kind:
            if not Compensation.is_kind(kind):
                raise TypeError(f"there is no kind of compensation called {kind}")
        acting = {one.kind: one for one in compensations} | by_kind
        found = [one for one in acting.values() if one is not None]
        values = {
            "number": number,
            "name": name,
            "type": type,
            "modulo": modulo,
            "backlash_cycles": backlash_cycles,
            "volumetric_limit": volumetric_limit,
            "volumetric_velocity": volumetric_velocity,
            "gantry_master": gantry_master,
            "compensations": tuple(sorted(found, key=lambda one: one.order)),
            "reserved": tuple(sorted(dict(reserved).items())),
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    def __getattr__(self, kind: str) -> Any:
        """Return the compensation of a kind by its name, None if none acts."""
        if kind.startswith("_") or not Compensation.is_kind(kind):
            raise AttributeError(f"an axis has no {kind}")
        return next((one for one in self.compensations if one.kind == kind), None)

    def of(self, cls: builtins.type[AnyCompensation]) -> AnyCompensation | None:
        """Return the compensation of the class ``cls``, None if none acts."""
        return next((one for one in self.compensations if isinstance(one, cls)), None)

    def having(self, compensation: Compensation) -> Axis:
        """Return the same axis with ``compensation`` in the place of one of its kind."""
        return replace(self, compensations=(*self.compensations, compensation))

    @property
    def kinds(self) -> tuple[str, ...]:
        """Kinds that the axis activates, with or without a table, in the order of a cycle."""
        names = {one.kind for one in self.compensations}.union(kind for kind, _ in self.reserved)
        return tuple(sorted(names, key=Compensation._order.__getitem__))

    @property
    def unit(self) -> str:
        """Unit of the axis' positions: ``mm`` or ``deg``."""
        return "mm" if self.type is AxisType.TRANSLATORY else "deg"

    def __repr__(self) -> str:
        parts = [f"{self.number} {self.name}", self.type.name.lower(), *map(repr, self.compensations)]
        return f"Axis({', '.join(parts)})"


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
        """Return the place in ``axes`` of the axis with the logical ``number``; KeyError if there is none."""
        for index, axis in enumerate(self.axes):
            if axis.number == number:
                return index
        raise KeyError(number)

    def numbered(self, number: int) -> Axis:
        """Return the axis with the logical ``number``; KeyError if there is none."""
        return self.axes[self.index_of(number)]

    def axis(self, name: str) -> Axis:
        """Return the axis called ``name``; KeyError if there is none."""
        for axis in self.axes:
            if axis.name == name:
                return axis
        raise KeyError(name)

    def members(self, volumetric: Volumetric) -> dict[int, str]:
        """Return place in ``axes`` → letter of the axes of ``volumetric``; gantry slaves have their master's letter."""
        letters = {number: letter for letter, number in volumetric.axes}
        leaders = [axis.number if axis.number in letters else axis.gantry_master for axis in self.axes]
        return {place: letters[number] for place, number in enumerate(leaders) if number in letters}

    def corrected_by(self, volumetric: Volumetric) -> frozenset[int]:
        """Return the numbers of the axes that ``volumetric`` corrects: X, Y, Z and their gantry slaves."""
        members = self.members(volumetric)
        return frozenset(self.axes[place].number for place, letter in members.items() if letter in LINEAR)

    def error_nodes(self) -> dict[int, list[float]]:
        """Return the positions of each axis, by number, at which some volumetric error has a node, ascending.

        Those of all compensations: one of the rotary axes alone has no table over X, Y and Z.
        """
        found: dict[int, set[float]] = {}
        for one in self.volumetric:
            numbers = dict(one.axes)
            for table in one.errors:
                for letter in table.arguments:
                    found.setdefault(numbers[letter], set()).update(table.positions(letter))
        return {number: sorted(positions) for number, positions in found.items()}

    def _repr_html_(self) -> str:
        """Return its axes and what acts on them as a table, for notebooks."""
        rows = []
        for axis in self.axes:
            kinds = [one.kind for one in axis.compensations]
            kinds += [f"volumetric[{one.index}]" for one in self.volumetric if axis.number in self.corrected_by(one)]
            counted = axis.type.name.lower() + ("" if axis.modulo is None else ", modulo")
            rows.append([str(axis.number), axis.name, counted, ", ".join(kinds) or "none"])
        return as_html(["number", "axis", "type", "compensations"], rows, caption=f"Machine of {len(self.axes)} axes")

    def __repr__(self) -> str:
        return "Machine(\n" + "".join(f"  {part!r},\n" for part in (*self.axes, *self.volumetric)) + ")"
