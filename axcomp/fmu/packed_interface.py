"""What the slave finds beside the lists: where they lie, and for which axes the model description was written.

The lists in an unpacked FMU may be changed, its variables not: whatever is read is fitted to the axes they belong to.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import Any

from ..interface import Types
from ..lists import TypeName
from ..model import AXES_MAX, CYCLE_TIME, Axis, AxisType, Machine

FILE_NAME = "axcomp.json"
"""Name of the file in ``resources``."""

FOLDER = "machine"
"""Folder of the lists in ``resources``."""


@dataclass(frozen=True)
class Interface:
    """What does not change when the lists do.

    ``lists``: start-up list or single list, relative to ``resources``, with ``/``; ``cycle_time``: of the position
    controller, s; ``axes``: those that have variables, in their order, without compensations: a corrected setpoint is
    the setpoint; ``axis_type``: what was said of axes without axis lists (``read_machine``); ``types``: of the
    variables.
    """

    lists: str = ""
    cycle_time: float = CYCLE_TIME
    axes: tuple[Axis, ...] = ()
    axis_type: TypeName | None = None
    types: Types = "own"

    @classmethod
    def of(
        cls, machine: Machine, lists: str, cycle_time: float, axis_type: TypeName | None = None, types: Types = "own"
    ) -> Interface:
        """Return the interface of an FMU built for a machine."""
        axes = tuple(Axis(axis.number, axis.name, axis.type) for axis in machine.axes)
        return cls(lists, cycle_time, axes, axis_type, types)

    @classmethod
    def from_json(cls, text: str) -> Interface:
        """Return what ``to_json`` wrote; ValueError, KeyError or TypeError if it is something else."""
        values: dict[str, Any] = json.loads(text)
        axes = tuple(Axis(**{**axis, "type": AxisType(axis["type"])}) for axis in values["axes"])
        return cls(str(values["lists"]), float(values["cycle_time"]), axes, values.get("axis_type"), values["types"])

    def to_json(self) -> str:
        """Return the text of the file."""
        axes = [{"number": axis.number, "name": axis.name, "type": axis.type.value} for axis in self.axes]
        values = {name: getattr(self, name) for name in ("lists", "cycle_time", "axis_type", "types")} | {"axes": axes}
        return json.dumps(values, indent=2) + "\n"

    def bare(self) -> Machine:
        """Return a machine that corrects nothing."""
        return Machine(self.axes)

    def fit(self, machine: Machine) -> tuple[Machine, list[str]]:
        """Return the machine with its axes in the order of the variables, and what does not fit, in sentences."""
        complaints: list[str] = []
        found = {axis.number: axis for axis in machine.axes}
        axes: list[Axis] = []
        for wanted in self.axes:
            axis = found.pop(wanted.number, None)
            if axis is None:
                complaints.append(f"axis {wanted.name} is not in the lists: it is not corrected")
                axis = wanted
            elif axis.unit != wanted.unit:
                complaints.append(f"axis {wanted.name} has become {axis.type.name.lower()}: its units are wrong")
            axes.append(replace(axis, name=wanted.name))
        for axis in found.values():
            complaints.append(f"axis {axis.number} has no variables: its setpoint stays 0")
            axes.append(axis)
        if len(axes) > AXES_MAX:
            complaints.append(f"more than {AXES_MAX} axes: nothing is corrected")
            return self.bare(), complaints
        return replace(machine, axes=tuple(axes)), complaints
