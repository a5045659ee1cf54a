"""Which inputs an output of an axis is computed from, for ModelStructure.

An output changes only if one of these inputs changes (or time goes on, or a table is read again: ``reload``).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..kinds import KINDS, Kind, kinds_of
from ..model import Axis, Machine, Volumetric

Input = tuple[int | None, str]
"""Place of the axis in the machine (None: of the whole machine) and name of the input."""

Inputs = frozenset[Input]

COMMANDS_OF_VOLUMETRIC = ("switch", "no_move", "reduction_x", "reduction_y", "reduction_z")

OF_MEMBERS = ("setpoint", "velocity", "unreferenced", "fault")

COMMANDS = ((None, "reset"), (None, "program_end"), (None, "reload"))


def volumetric_input(volumetric: Volumetric, name: str) -> str:
    """Return what an input of a volumetric compensation is called among those of the machine."""
    return f"volumetric[{volumetric.index}].{name}"


def volumetric_switch(machine: Machine, volumetric: Volumetric) -> Inputs:
    """Return what decides whether a volumetric compensation is on: s_limit makes it depend on its corrections."""
    members = machine.members(volumetric)
    own: list[Input] = [(place, name) for place in members for name in OF_MEMBERS]
    own += [(None, volumetric_input(volumetric, name)) for name in COMMANDS_OF_VOLUMETRIC]
    return frozenset(own).union(((None, "tool_length"), *COMMANDS))


class Dependencies:
    """The dependencies of one axis' outputs; ``index``: its place in the machine."""

    def __init__(self, machine: Machine, index: int) -> None:
        self.machine = machine
        self.index = index
        self.axis: Axis = machine.axes[index]
        self._place: dict[int | None, int] = {axis.number: place for place, axis in enumerate(machine.axes)}

    def of(self, output: str) -> Inputs:
        """Return the inputs that the output called ``output`` (``corrected_setpoint``, ``cross.active`` …) needs."""
        if output in ("stop_request", "volumetric.correction"):
            return self._volumetric()
        name, _, quantity = output.rpartition(".")
        if quantity == "active":
            return self._switch(KINDS[name])
        if name:
            return self._correction(KINDS[name])
        if output == "current":
            return self._union(self._correction(kind) for kind in self._kinds("current"))
        if output == "error":
            switches = [f"{kind.name}.switch" for kind in kinds_of(self.axis)]
            own = self._own("setpoint", "velocity", "acceleration", "actual_position", *switches).union(COMMANDS)
            return own | self._volumetric()
        correction = self._union(self._correction(kind) for kind in self._kinds("setpoint")) | self._volumetric()
        if output == "corrected_setpoint":
            return correction | self._own("setpoint")
        if output == "display_position":
            return correction | self._own("actual_position")
        return correction

    def _kinds(self, adds_to: str) -> list[Kind[Any]]:
        return [kind for kind in kinds_of(self.axis) if kind.adds_to == adds_to]

    def _volumetric(self) -> Inputs:
        """Return what volumetric compensations need; s_limit bounds their sum, so one depends on the other."""
        if not any(self.index in self.machine.members(one) for one in self.machine.volumetric):
            return frozenset()
        return self._union(volumetric_switch(self.machine, one) for one in self.machine.volumetric)

    def _correction(self, kind: Kind[Any]) -> Inputs:
        """Return what a contribution is computed from: its weight, and its value at full weight.

        A kind without a table may get one by an update, which needs ``reload``: so much is known of it.
        """
        compensation = getattr(self.axis, kind.name)
        if compensation is None:
            return self._switch(kind)
        looked_up = (
            (place, name) for number, name in kind.looks_up(compensation, self.axis) for place in self._places(number)
        )
        value = frozenset[Input](looked_up)
        if kind.follows(compensation):
            value |= self._union(self._correction(other) for other in kinds_of(self.axis) if other.number < kind.number)
        return self._switch(kind) | value

    def _switch(self, kind: Kind[Any]) -> Inputs:
        """Return what decides whether a compensation is on; ``setpoint`` and ``velocity`` tell a standstill."""
        own = self._own("setpoint", "velocity", "released", "no_move", f"{kind.name}.switch").union(COMMANDS)
        compensation = getattr(self.axis, kind.name)
        needed = () if compensation is None else kind.needs(compensation, self.axis)
        return own.union((place, "unreferenced") for place in self._places(*needed))

    @staticmethod
    def _union(parts: Iterable[Inputs]) -> Inputs:
        return frozenset[Input]().union(*parts)

    def _own(self, *names: str) -> Inputs:
        return frozenset((self.index, name) for name in names)

    def _places(self, *numbers: int | None) -> list[int]:
        places = [self._place[number] for number in numbers if number in self._place]
        return sorted(set(places))
