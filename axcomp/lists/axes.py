"""The axis lists: what an axis is, and which compensations it activates."""

from __future__ import annotations

from dataclasses import dataclass

from ..kinds import KINDS, METRIC, Gear
from ..model import AXES_MAX, SHORTEST_RANGE, AxisType, ModuloRange
from .catalogue import parameter
from .findings import Findings
from .values import ListValues

_MODULO_BIT = 0x4
_NAME = "kopf.log_achs_name"
_GEAR = "getriebe[i]."
_INCREMENTS = f"{_GEAR}incr_per_rev"
_PATH = (f"{_GEAR}wegaufz", f"{_GEAR}wegaufn")
_TURNS = (f"{_GEAR}gear_fact_num", f"{_GEAR}gear_fact_denom")
_FEED = (f"{_GEAR}feed_const_num", f"{_GEAR}feed_const_denom")


@dataclass
class AxisSettings:
    """What the lists say about one axis besides its compensation tables.

    Attributes
    ----------
    number : int
        Logical axis number.
    name : str
        "" where no list names it.
    name_at : tuple of file and line
        Where it is named.
    type : AxisType
    modulo : ModuloRange or None
    backlash_cycles : int
        P-AXIS-00243.
    gear : Gear
        What an encoder increment is.
    activated : dict of str to bool
        By kind of compensation. None: there is no axis list at all, whatever is plausible acts.
    values : ListValues or None
        Its axis list, where there is one.
    s_limit, v_limit : float
        Limits of a volumetric correction in mm and mm/s (P-AXIS-00525, P-AXIS-00526); 0: not defined.
    gantry_master : int
        Logical number of the gantry master, 0 if there is none (P-AXIS-00070).
    """

    number: int
    name: str = ""
    name_at: tuple[str, int] = ("", 0)
    type: AxisType = AxisType.TRANSLATORY
    modulo: ModuloRange | None = None
    backlash_cycles: int = 0
    gear: Gear = METRIC
    activated: dict[str, bool] | None = None
    values: ListValues | None = None
    s_limit: float = 0.0
    v_limit: float = 0.0
    gantry_master: int = 0

    def take_name(self, values: ListValues) -> None:
        """Take the name that a list gives the axis itself, unless it has one."""
        if not self.name and values.given(_NAME):
            self.name = values.text(_NAME)
            self.name_at = values.place(_NAME)


def read_axis(number: int, values: ListValues, findings: Findings) -> AxisSettings:
    """Return the settings of an axis from its list, which falls back on the list for all axes."""
    axis = AxisSettings(
        number=number,
        type=AxisType(values.integer("kenngr.achs_typ")),
        modulo=_modulo(values, findings) if values.integer("kenngr.achs_mode") & _MODULO_BIT else None,
        backlash_cycles=values.integer("lr_param.n_backlash_cyc"),
        gear=_gear(values, findings),
        activated={name: kind.is_activated(values) for name, kind in KINDS.items()},
        values=values,
        s_limit=values.converted("lr_param.vol_comp.s_limit"),
        v_limit=values.converted("lr_param.vol_comp.v_limit"),
        gantry_master=values.integer("kenngr.gantry_ax_nr"),
    )
    axis.take_name(values)
    return axis


def _gear(values: ListValues, findings: Findings) -> Gear:
    """Return what an encoder increment is, by the first gear step (``getriebe[0]``)."""

    def note(code: str, name: str, message: str) -> None:
        findings.add(code, *values.place(name, 0), parameter(values.kind, name).named(0), message)

    path, turns, feed = (Gear(*(values.integer(name, 0) for name in names)) for names in (_PATH, _TURNS, _FEED))
    if all(values.integer(name, 0) == 1 for name in _FEED):
        return 1 / path
    # Older builds of the controller have no entries of their own for the gear.
    old = not any(values.line(name, 0) for name in _TURNS)
    if path != 1 and not old:
        note("AXC-UNUSED", _PATH[0], "wegaufz and wegaufn are not used: feed constant and gear give the resolution.")
    increments = values.integer(_INCREMENTS, 0)
    if not increments:
        increments = int(parameter(values.kind, _INCREMENTS).default)
        note(
            "AXC-RESOLUTION",
            _INCREMENTS,
            f"incr_per_rev is 0, although there is a feed constant; {increments} is used.",
        )
    return feed / (increments * (path if old else turns))


def _modulo(values: ListValues, findings: Findings) -> ModuloRange:
    low, high = "getriebe[i].modulou", "getriebe[i].moduloo"
    modulo = ModuloRange(values.converted(low, 0), values.converted(high, 0))
    if modulo.length > SHORTEST_RANGE:
        return modulo
    file, line = values.place(high if values.line(high, 0) else low, 0)
    message = f"The modulo range {modulo.start:g} … {modulo.end:g} is no turn of an axis; 0 … 360 is used."
    findings.add("110052", file, line, "getriebe[0].moduloo", message)
    return ModuloRange()


class Axes:
    """The axes of a machine in the order of its lists, by logical number; at most ``AXES_MAX``.

    Parameters
    ----------
    findings : Findings
        Gets told of axes there is no room for.
    invent : bool
        Whether a master that no list describes becomes an axis of its own: so it is without any axis list.
    """

    def __init__(self, findings: Findings, invent: bool) -> None:
        self._findings = findings
        self._axes: dict[int, AxisSettings] = {}
        self.invent = invent

    def __contains__(self, number: int) -> bool:
        """Whether there is an axis of that number."""
        return number in self._axes

    def all(self) -> list[AxisSettings]:
        """Return the axes in their order."""
        return list(self._axes.values())

    def add(self, axis: AxisSettings, file: str, line: int, parameter: str) -> bool:
        """Take an axis in; a finding at the given place and False if there is no room."""
        if len(self._axes) >= AXES_MAX:
            message = f"Axis {axis.number} would be one more than {AXES_MAX} axes; it is left out."
            self._findings.add("AXC-AXES", file, line, parameter, message)
            return False
        self._axes[axis.number] = axis
        return True

    def get(self, number: int) -> AxisSettings:
        """Return an axis; KeyError if there is none."""
        return self._axes[number]

    def names(self) -> dict[int, str]:
        """Return a name for each axis, all different: its own, else ``axis<number>``."""
        names: dict[int, str] = {}
        taken: set[str] = set()
        for axis in self.all():
            name = axis.name or f"axis{axis.number}"
            if name in taken:
                name = self._another(name, axis, taken)
            names[axis.number] = name
            taken.add(name)
        return names

    def _another(self, name: str, axis: AxisSettings, taken: set[str]) -> str:
        other = f"{name}_{axis.number}"
        while other in taken:
            other += "_"
        message = f"Another axis is called {name}; axis {axis.number} is called {other}."
        self._findings.add("AXC-NAME", *axis.name_at, _NAME, message)
        return other
