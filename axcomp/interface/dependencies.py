"""Which inputs an output of an axis is computed from, for ModelStructure.

An output changes only if one of these inputs changes (or time goes on, or a table is read again: ``reload``).
"""

from __future__ import annotations

from ..model.machine import Axis, Crosstalk, Machine
from ..model.volumetric import Volumetric

Input = tuple[int | None, str]
"""Place of the axis in the machine (None: of the whole machine) and name of the input."""

Inputs = frozenset[Input]

COMMANDS_OF_VOLUMETRIC = ("enable", "no_move", "factor_x", "factor_y", "factor_z")

SETPOINT_KINDS = ("cross", "plane", "crosstalk", "leadscrew")
COMMANDS = ((None, "reset"), (None, "program_end"), (None, "reload"))


def volumetric_input(volumetric: Volumetric, name: str) -> str:
    """Return what an input of a volumetric compensation is called among those of the machine."""
    return f"volumetric[{volumetric.index}].{name}"


def volumetric_switch(machine: Machine, volumetric: Volumetric) -> Inputs:
    """Return what decides whether a volumetric compensation is on: s_limit makes it depend on its corrections."""
    members = machine.members(volumetric)
    own: list[Input] = [(place, name) for place in members for name in ("setpoint", "referenced", "fault")]
    own += [(None, volumetric_input(volumetric, name)) for name in COMMANDS_OF_VOLUMETRIC]
    return frozenset(own).union(((None, "tool_length"), *COMMANDS))


class Dependencies:
    """The dependencies of one axis' outputs; ``index``: its place in the machine."""

    def __init__(self, machine: Machine, index: int) -> None:
        self.machine = machine
        self.index = index
        self.axis: Axis = machine.axes[index]

    def of(self, output: str) -> Inputs:
        """Return the inputs that the output called ``output`` (``corrected_setpoint``, ``cross.active`` …) needs."""
        if output in ("stop_request", "volumetric.correction"):
            return self._volumetric()
        kind, _, quantity = output.rpartition(".")
        if quantity == "active":
            return self._switch(kind)
        if kind:
            return self._switch(kind) | self._value(kind)
        if output == "current":
            return self._switch("friction") | self._own("setpoint", "velocity", "acceleration")
        if output == "error":
            own = self._own("setpoint", "velocity", "acceleration", "actual_position").union(COMMANDS)
            return own | self._volumetric()
        correction = self._all_corrections()
        if output == "corrected_setpoint":
            return correction | self._own("setpoint")
        if output == "display_position":
            return correction | self._own("actual_position")
        return correction

    def _all_corrections(self) -> Inputs:
        kinds = tuple(kind for kind in SETPOINT_KINDS if getattr(self.axis, kind) is not None)
        return self._corrections(kinds) | self._volumetric()

    def _volumetric(self) -> Inputs:
        found = [one for one in self.machine.volumetric if self.axis.number in self.machine.corrected_by(one)]
        return frozenset[Input]().union(*(volumetric_switch(self.machine, one) for one in found))

    def _corrections(self, kinds: tuple[str, ...]) -> Inputs:
        return frozenset[Input]().union(*(self._switch(kind) | self._value(kind) for kind in kinds))

    def _switch(self, kind: str) -> Inputs:
        """Return what decides whether a compensation is on; ``setpoint`` and ``velocity`` tell a standstill."""
        own = self._own("setpoint", "velocity", "referenced", "no_move", f"{kind}.enable").union(COMMANDS)
        return own.union((place, "referenced") for place in self._conditions(kind))

    def _conditions(self, kind: str) -> list[int]:
        """Return the other axes that must be referenced."""
        if kind == "cross" and self.axis.cross is not None:
            return self._places(self.axis.cross.master)
        if kind == "plane" and self.axis.plane is not None:
            return self._places(self.axis.plane.master1, self.axis.plane.master2)
        if isinstance(self.axis.crosstalk, Crosstalk) and kind == "crosstalk":
            return self._places(self.axis.crosstalk.adaptation1, self.axis.crosstalk.adaptation2)
        return []

    def _value(self, kind: str) -> Inputs:
        """Return what the value of a correction at full weight is looked up with."""
        if kind == "leadscrew":
            other = tuple(k for k in SETPOINT_KINDS[:-1] if getattr(self.axis, k) is not None)
            if self.axis.leadscrew is not None and self.axis.leadscrew.without_other_compensations:
                other = ()
            return self._own("setpoint") | self._corrections(other)
        masters = frozenset[Input]((place, "setpoint") for place in self._conditions(kind))
        if kind == "crosstalk" and self.axis.crosstalk is not None:
            for master in self._places(self.axis.crosstalk.master):
                masters |= {(master, "acceleration"), (master, "velocity")}
        return masters

    def _own(self, *names: str) -> Inputs:
        return frozenset((self.index, name) for name in names)

    def _places(self, *numbers: int | None) -> list[int]:
        return [place for place, axis in enumerate(self.machine.axes) if axis.number in numbers]
