"""Carrying NC commands out on a running machine: a command acts in the next cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from os import PathLike
from typing import Any

from ..kernel import is_motion
from ..kinds import KINDS
from ..lists import Severity, reread_volumetric
from ..model import Machine
from ..native import POKES_MAX, Poke, address_of
from ..runtime import Runtime
from .nc_commands import (
    AxisCommand,
    AxisVariable,
    Command,
    Variable,
    VolumetricSwitch,
    VolumetricUpdate,
    parse_block,
    parse_variable,
)
from .nc_scanner import Cursor, NcError, scan


class NcControl:
    """Switches the compensations of a machine by NC commands.

    Parameters
    ----------
    runtime : Runtime
    lists : path or None
        Where ``UPDATE`` reads; None: there are no lists.
    allow_outside : sequence of path
        As in ``read_machine``.

    Attributes
    ----------
    on_update : callable
        Called with the number of a volumetric compensation that was updated; what it returns is told, a sentence each.
    """

    def __init__(
        self, runtime: Runtime, lists: str | PathLike[str] | None, allow_outside: Sequence[str | PathLike[str]] = ()
    ) -> None:
        self._runtime = runtime
        self._lists = lists
        self._allow_outside = allow_outside
        self.on_update: Callable[[int], Iterable[str]] = lambda _: ()
        self._files: dict[tuple[int, int], str] = {}
        self._held: list[tuple[Any, str, Any, Any]] = []

    def check(self, block: str) -> tuple[Command, ...]:
        """Return the commands of a block; NcError if they are none of this machine."""
        commands = parse_block(block)
        machine = self._runtime.machine
        for command in commands:
            if isinstance(command, AxisCommand):
                _check_axis_command(command, machine)
            elif isinstance(command, VolumetricSwitch | VolumetricUpdate):
                self._check_index(command.index, command.place, "21749")
            elif isinstance(command, Variable | AxisVariable):
                self._check_variable(command)
            else:
                self._check_index(command.variable.index, command.variable.place)
                if isinstance(command.value, Variable):
                    self._check_index(command.value.index, command.value.place)
            if isinstance(command, VolumetricUpdate) and self._lists is None:
                raise NcError(command.place, "UPDATE reads lists, but this machine was not read from any")
        return commands

    def execute(self, block: str) -> tuple[str, ...]:
        """Carry a block out with the next cycle; return what it has to say, a sentence each.

        Raises
        ------
        NcError
            If the block is none, does not suit the machine, or an UPDATE is refused; what stands before it is done.
        """
        notices: list[str] = []
        for command in self.check(block):
            notices += self._execute(command)
        return tuple(notices)

    def after_cycle(self) -> None:
        """Put back what held for the cycle of a command only, NO_MOVE and CFACT, unless it was set otherwise."""
        for record, field, before, during in reversed(self._held):
            if getattr(record, field) == during:
                setattr(record, field, before)
        self._held.clear()

    def keep(self) -> tuple[Any, ...]:
        """Return where it reads and what was written, for ``take``."""
        return self._lists, self._allow_outside, dict(self._files)

    def take(self, kept: tuple[Any, ...]) -> None:
        """Go on where another one stood."""
        self._lists, self._allow_outside, files = kept
        self._files = dict(files)

    def read(self, name: str) -> str | bool:
        """Return the value of ``V.G.VOLCOMP[i].FILE[j]``, ``.ACTIVE`` or ``V.A.CROSS_COMP_ACTIVE.X`` and the like.

        NcError for any other name.
        """
        variable = _variable(name)
        self._check_variable(variable)
        return self._value(variable)

    def write(self, name: str, value: str) -> None:
        """Set ``V.G.VOLCOMP[i].FILE[j]``, for the next UPDATE; NcError for any other name."""
        variable = _variable(name)
        if isinstance(variable, AxisVariable):
            raise NcError(variable.place, f"{variable} can only be read")
        self._check_variable(variable)
        if variable.file is None:
            raise NcError(variable.place, f"{variable} can only be read")
        self._files[variable.index, variable.file] = value

    def _execute(self, command: Command) -> Iterator[str]:
        if isinstance(command, AxisCommand):
            yield from self._switch_axis(command)
        elif isinstance(command, VolumetricSwitch):
            yield from self._tell_motion(command.index)
            for volumetric in self._runtime.machine.volumetric:
                if command.index in (None, volumetric.index):
                    self._switch_volumetric(volumetric.index, command)
        elif isinstance(command, VolumetricUpdate):
            yield from self._update(command)
        elif isinstance(command, Variable | AxisVariable):
            yield f"{command} = {self._value(command)}"
        else:
            value = self._value(command.value) if isinstance(command.value, Variable) else command.value
            self.write(str(command.variable), str(value))

    def pokes(self, block: str) -> tuple[list[Poke], list[str]] | None:
        """Return what a block sets in the records of a compiled kernel, and what it has to say.

        None: what it does depends on the moment, ``execute`` has to do it. NcError as from ``check``.
        """
        commands = self.check(block)
        found: list[Poke] = []
        said: list[str] = []
        for command in commands:
            if not isinstance(command, AxisCommand):
                return None
            index, wanted, notices = self._switched(command)
            said += notices
            inputs, state = self._runtime.inputs, self._runtime.state
            found.append((address_of(inputs, f"axis[{index}].no_move"), int(command.no_move), True))
            for number, on in wanted.items():
                value = 1 if on else -1
                found.append((address_of(inputs, f"axis[{index}].wanted[{number}]"), value, False))
                found.append((address_of(state, f"axis[{index}].switching[{number}].wanted"), -value, False))
        return (found, said) if len(found) <= POKES_MAX else None

    def _switched(self, command: AxisCommand) -> tuple[int, dict[int, bool], list[str]]:
        """Return the index of the axis of a command, which kinds go on or off, and what there is to say."""
        machine = self._runtime.machine
        index = _axis_index(command, machine)
        configured = list(machine.axes[index].kinds)
        listed = ", ".join(configured) or "nothing"
        said = [f"{command.axis}[COMP ON] names no kind of compensation: {listed} is switched on."]
        wanted = dict.fromkeys(configured if command.all_off else command.off, False)
        wanted |= dict.fromkeys(configured if command.all_on else (), True) | dict.fromkeys(command.on, True)
        switched = {KINDS[kind].number: on for kind, on in wanted.items() if kind in configured}
        return index, switched, said if command.all_on else []

    def _switch_axis(self, command: AxisCommand) -> Iterator[str]:
        index, wanted, said = self._switched(command)
        yield from said
        given, state = self._runtime.inputs.axis[index], self._runtime.state.axis[index]
        self._hold(given, "no_move", command.no_move)
        for number, on in wanted.items():
            given.wanted[number] = 1 if on else -1
            # Changes of the input are the commands: one that repeats the last needs its change too.
            state.switching[number].wanted = -given.wanted[number]

    def _switch_volumetric(self, index: int, command: VolumetricSwitch) -> None:
        given, state = self._runtime.inputs.volumetric[index], self._runtime.state.volumetric[index]
        given.wanted = 1 if command.on else -1
        state.wanted = -given.wanted
        self._hold(given, "no_move", command.no_move)
        for letter, factor in zip("xyz", command.factors, strict=True):
            self._hold(given, f"reduction_{letter}", 1.0 - factor)

    def _hold(self, record: Any, field: str, value: Any) -> None:
        self._held.append((record, field, getattr(record, field), value))
        setattr(record, field, value)

    def _update(self, command: VolumetricUpdate) -> Iterator[str]:
        files = {j: name for (i, j), name in self._files.items() if i == command.index}
        volumetric, findings = reread_volumetric(self._lists or "", command.index, files, self._allow_outside)
        errors = [str(finding) for finding in findings if finding.severity is Severity.ERROR]
        if volumetric is None:
            what = f"volumetric compensation {command.index} keeps its old data"
            raise NcError(command.place, "; ".join([what, *errors]))
        self._runtime.update_volumetric(volumetric)
        yield from self._tell_motion(command.index)
        yield from self.on_update(command.index)
        yield from (str(finding) for finding in findings)

    def _tell_motion(self, index: int | None) -> Iterator[str]:
        """Tell which axes move that a command would stop on the controller."""
        runtime = self._runtime
        places: set[int] = set()
        for volumetric in runtime.machine.volumetric:
            if index in (None, volumetric.index):
                places.update(runtime.machine.members(volumetric))
        step = runtime.tables.cycle_time
        moving = [
            runtime.machine.axes[place].name
            for place in sorted(places)
            if runtime.state.motion.axis[place].moving or is_motion(runtime.inputs.axis[place].velocity * step)
        ]
        if moving:
            yield f"#VOLCOMP while {', '.join(moving)} moves: the controller stops the machine first."

    def _check_variable(self, variable: Variable | AxisVariable) -> None:
        if isinstance(variable, Variable):
            self._check_index(variable.index, variable.place)
            return
        machine = self._runtime.machine
        axis = machine.axes[_axis_index(variable, machine)]
        if variable.kind not in axis.kinds:
            raise NcError(variable.place, f"axis {axis.name} has no {variable.kind} compensation")

    def _value(self, variable: Variable | AxisVariable) -> str | bool:
        if isinstance(variable, AxisVariable):
            outputs = self._runtime.outputs.axis[_axis_index(variable, self._runtime.machine)]
            return outputs.active[KINDS[variable.kind].number]
        if variable.file is None:
            return self._runtime.outputs.volumetric[variable.index].active
        written = self._files.get((variable.index, variable.file))
        if written is not None:
            return written
        one = next(one for one in self._runtime.machine.volumetric if one.index == variable.index)
        return dict(enumerate(one.files)).get(variable.file, "")

    def _check_index(self, index: int | None, place: int, code: str = "70506") -> None:
        known = [one.index for one in self._runtime.machine.volumetric]
        if index is not None and index not in known:
            there = f"there is only {', '.join(map(str, known))}" if known else "there is none"
            raise NcError(place, f"there is no volumetric compensation {index}: {there}", code)


def _variable(name: str) -> Variable | AxisVariable:
    cursor = Cursor(scan(name))
    variable = parse_variable(cursor)
    cursor.expect_kind("end", "nothing more")
    return variable


def _axis_index(command: AxisCommand | AxisVariable, machine: Machine) -> int:
    for index, axis in enumerate(machine.axes):
        if axis.name.upper() == command.axis:
            return index
    names = ", ".join(axis.name for axis in machine.axes)
    raise NcError(command.place, f"an axis ({names}) is expected, not “{command.axis}”")


def _check_axis_command(command: AxisCommand, machine: Machine) -> None:
    axis = machine.axes[_axis_index(command, machine)]
    for kind in command.on:
        if kind not in axis.kinds:
            code = KINDS[kind].inactive_code
            code = "" if code.startswith("AXC") else code
            raise NcError(command.place, f"axis {axis.name} has no {kind} compensation to switch on", code)
