"""What the slave finds beside the lists: where they lie, and for which axes the model description was written.

The lists in an unpacked FMU may be changed, its variables not: whatever is read is fitted to the axes they belong to.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace
from typing import Any

from ..lists import TypeName
from ..model.machine import AXES_MAX, CYCLE_TIME, Axis, AxisType, Machine

FILE_NAME = "axcomp.json"
"""Name of the file in ``resources``."""


@dataclass(frozen=True)
class InterfaceAxis:
    """An axis that has variables; ``type``: value of its AxisType."""

    number: int
    name: str
    type: int

    def bare(self) -> Axis:
        """Return this axis without compensations: its corrected setpoint is its setpoint."""
        return Axis(self.number, self.name, AxisType(self.type))


@dataclass(frozen=True)
class Interface:
    """What does not change when the lists do.

    Attributes
    ----------
    lists : str
        Start-up list or single list, relative to ``resources``, with ``/``.
    cycle_time : float
        Of the position controller, s.
    axes : tuple of InterfaceAxis
        In the order of the variables.
    axis_type : str or None
        What was said of axes without axis lists (``read_machine``).
    """

    lists: str = ""
    cycle_time: float = CYCLE_TIME
    axes: tuple[InterfaceAxis, ...] = ()
    axis_type: TypeName | None = None

    @classmethod
    def of(cls, machine: Machine, lists: str, cycle_time: float, axis_type: TypeName | None = None) -> Interface:
        """Return the interface of an FMU built for a machine."""
        axes = tuple(InterfaceAxis(axis.number, axis.name, axis.type.value) for axis in machine.axes)
        return cls(lists, cycle_time, axes, axis_type)

    @classmethod
    def from_json(cls, text: str) -> Interface:
        """Return what ``to_json`` wrote; ValueError, KeyError or TypeError if it is something else."""
        values: dict[str, Any] = json.loads(text)
        axes = tuple(InterfaceAxis(**axis) for axis in values["axes"])
        return cls(str(values["lists"]), float(values["cycle_time"]), axes, values.get("axis_type"))

    def to_json(self) -> str:
        """Return the text of the file."""
        return json.dumps(asdict(self), indent=2) + "\n"

    def bare(self) -> Machine:
        """Return a machine that corrects nothing."""
        return Machine(tuple(axis.bare() for axis in self.axes))

    def fit(self, machine: Machine) -> tuple[Machine, list[str]]:
        """Return the machine with its axes in the order of the variables, and what does not fit, in sentences."""
        complaints: list[str] = []
        found = {axis.number: axis for axis in machine.axes}
        axes: list[Axis] = []
        for wanted in self.axes:
            axis = found.pop(wanted.number, None)
            if axis is None:
                complaints.append(f"axis {wanted.name} is not in the lists: it is not corrected")
                axis = wanted.bare()
            elif axis.unit != wanted.bare().unit:
                complaints.append(f"axis {wanted.name} has become {axis.type.name.lower()}: its units are wrong")
            axes.append(replace(axis, name=wanted.name))
        for axis in found.values():
            complaints.append(f"axis {axis.number} has no variables: its setpoint stays 0")
            axes.append(axis)
        if len(axes) > AXES_MAX:
            complaints.append(f"more than {AXES_MAX} axes: nothing is corrected")
            return self.bare(), complaints
        return replace(machine, axes=tuple(axes)), complaints
