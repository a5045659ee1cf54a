"""A machine in operation: tables, state, inputs and outputs, the clock, snapshots and updates.

The FMU's slave and the Engine are both thin layers over this. Standard library only.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ..kernel import (
    ERROR_SWITCH,
    ERROR_UPDATE,
    Inputs,
    Outputs,
    State,
    Tables,
    Vec,
    adopt_axis,
    adopt_volumetric,
    adopt_volumetrics,
    cycle,
    has_notice,
    keep_declared,
    move_axis_table,
    state_fits,
    update_error,
    zero,
)
from ..kinds import kinds_of
from ..model import CYCLE_TIME, Machine, Volumetric
from .compile import compile_tables
from .snapshot import SnapshotError, identity_of, pack, unpack

ON_INSTANT = 0.01
"""Share of a cycle by which a communication point may miss the instant of a cycle: hosts add up their steps."""


NO_COMMAND = "an input switch was neither -1, 0 nor 1; it commanded nothing"
"""What is told of an axis with ``ERROR_SWITCH``."""


CYCLES_MAX = 2.0**53
"""Cycles of a run are counted exactly."""


class UpdateError(ValueError):
    """An update that does not fit the running machine; nothing was changed."""


def initial_inputs(tables: Tables) -> Inputs:
    """Return the inputs before anybody sets them: all 0."""
    inputs = zero(Inputs)
    del inputs.axis[tables.axis_count :]
    del inputs.volumetric[tables.volumetrics :]
    return inputs


class Runtime:
    """A machine in operation.

    Parameters
    ----------
    machine : Machine
        Must compile (see ``compile_tables``).
    cycle_time : float
        Of the position controller in s.

    Attributes
    ----------
    inputs : Inputs
        Set them before ``advance``; they are held until set again.
    outputs : Outputs
        Of the last cycle.
    """

    def __init__(self, machine: Machine, cycle_time: float = CYCLE_TIME) -> None:
        self.machine = machine
        self.tables, self.pool = compile_tables(machine, cycle_time)
        self._identity: int | None = None
        self._volumetrics = {volumetric.index for volumetric in machine.volumetric}
        self.state, self.inputs, self.outputs = self._records()
        self.start_time = 0.0
        self.cycles = 0
        self._told: set[str] = set()
        self._tellable: tuple[Machine, list[tuple[int, int | None, str]]] | None = None

    def _records(self) -> tuple[State, Inputs, Outputs]:
        """Return records for a machine of this size."""
        state, outputs = zero(State), zero(Outputs)
        for axes in (state.axis, state.motion.axis, outputs.axis):
            del axes[self.tables.axis_count :]
        for volumetrics in (state.volumetric, outputs.volumetric):
            del volumetrics[self.tables.volumetrics :]
        return state, initial_inputs(self.tables), outputs

    def begin(self, time: float = 0.0) -> None:
        """Set the clock and compute the outputs of the first cycle without running it (end of initialization)."""
        self.start_time = time
        self.cycles = 0
        cycle(self.tables, self.pool, copy.deepcopy(self.state), self.inputs, self.outputs)

    def cycle(self) -> None:
        """Run one cycle: the outputs then belong to the present inputs."""
        cycle(self.tables, self.pool, self.state, self.inputs, self.outputs)
        self.cycles += 1

    def advance(self, time: float) -> None:
        """Run the cycles whose instants lie before ``time`` (s) and have not been run, with the inputs held."""
        for _ in range(self.due(time)):
            self.cycle()

    def due(self, time: float) -> int:
        """Return how many cycles ``advance`` would run; 0 or less: none."""
        return math.ceil((time - self.start_time) / self.tables.cycle_time - ON_INSTANT) - self.cycles

    def save(self) -> bytes:
        """Return a snapshot of everything that changes: state, inputs, outputs and the clock."""
        clock = [self.start_time, float(self.cycles)]
        return pack(self._machine_identity(), self.state, self.inputs, self.outputs, clock)

    def restore(self, data: bytes) -> None:
        """Go back to a snapshot of this machine; SnapshotError if it is none, and nothing has changed then.

        The machine is the one in force: a snapshot from before an ``update`` belongs to another one.
        """
        clock = [0.0, 0.0]
        records = (self.state, self.inputs, self.outputs, clock)
        before = pack(self._machine_identity(), *records)
        try:
            unpack(data, self._machine_identity(), *records)
            if not (state_fits(self.tables, self.state) and 0.0 <= clock[1] <= CYCLES_MAX and math.isfinite(clock[0])):
                raise SnapshotError("the snapshot has numbers that no run leads to")
        except SnapshotError:
            unpack(before, self._machine_identity(), *records)
            raise
        self.start_time = clock[0]
        self.cycles = int(clock[1])

    def keep(self) -> tuple[Any, ...]:
        """Return everything that changes, new lists too, for ``take`` of a runtime made as this one was; it pickles."""
        return self.machine, self.tables, self.pool, set(self._told), self.save()

    def take(self, kept: tuple[Any, ...]) -> None:
        """Go on where another runtime stood."""
        self.machine, tables, pool, told, snapshot = kept
        self.tables, self.pool, self._told, self._identity = copy.deepcopy(tables), copy.copy(pool), set(told), None
        self.restore(snapshot)

    def _machine_identity(self) -> int:
        if self._identity is None:
            tables = self.tables
            axes, volumetric = tables.axis[: tables.axis_count], tables.volumetric[: tables.volumetrics]
            self._identity = identity_of(tables.cycle_time, axes, volumetric, self.pool)
        return self._identity

    def notices(self) -> Iterator[str]:
        """Yield, once each, what the machine's user should know about the motion so far."""
        if not self._tellable or self._tellable[0] is not self.machine:
            self._tellable = self.machine, list(_tellable(self.machine))
        for index, number, notice in self._tellable[1]:
            if notice not in self._told:
                axis = self.state.axis[index]
                if axis.error == ERROR_SWITCH if number is None else has_notice(number, axis.compensation):
                    self._told.add(notice)
                    yield notice

    def update(self, machine: Machine) -> dict[str, int]:
        """Take new lists while the machine runs.

        An axis whose ``max_points`` has changed keeps its old data, and its ``error`` says so.

        Returns
        -------
        dict of str to int
            Axis name → error (110638 … 110641) of the axes that keep their old data.

        Raises
        ------
        UpdateError
            If the axes are not the same, or a compensation is new: the variables of an FMU cannot change.
        CompileError
            If the machine cannot be run. Nothing has changed in either case.
        """
        if [(axis.number, axis.name, axis.type) for axis in machine.axes] != [
            (axis.number, axis.name, axis.type) for axis in self.machine.axes
        ]:
            raise UpdateError("the new lists have other axes than the ones in force")
        if not {volumetric.index for volumetric in machine.volumetric} <= self._volumetrics:
            raise UpdateError("the new lists have a volumetric compensation that was not there")
        before = self.tables
        after, pool = compile_tables(machine, before.cycle_time)
        errors = [update_error(*pair) for pair in zip(before.axis, after.axis, strict=True)][: len(machine.axes)]
        if ERROR_UPDATE in errors:
            name = machine.axes[errors.index(ERROR_UPDATE)].name
            raise UpdateError(f"the new lists give axis {name} a compensation it did not have")
        if any(errors):
            pairs = zip(self.machine.axes, machine.axes, errors, strict=True)
            machine = replace(machine, axes=tuple(old if error else new for old, new, error in pairs))
        for index, error in enumerate(errors):
            old, new = before.axis[index], after.axis[index]
            if error == 0:
                adopt_axis(old, self.pool, new, pool, self.state, self.inputs.axis[index], index)
            else:
                self._keep_axis(after, pool, index)
            self.state.axis[index].error = self.outputs.axis[index].error = error
        adopt_volumetrics(before, after, self.state, self.outputs)
        self.machine, self.tables, self.pool = machine, after, pool
        self._identity = None
        return {axis.name: error for axis, error in zip(machine.axes, errors, strict=True) if error}

    def _keep_axis(self, after: Tables, pool: Vec, index: int) -> None:
        """Let an axis of new tables keep the table that is in force."""
        table = after.axis[index] = copy.deepcopy(self.tables.axis[index])
        first = len(pool)
        pool.extend(self.pool[table.first : table.first + table.numbers])
        move_axis_table(table, first)

    def update_volumetric(self, volumetric: Volumetric) -> None:
        """Take new data of one volumetric compensation, which is switched off for that without motion.

        An automatic one then switches on again. CompileError if it cannot be run; nothing has changed then.
        """
        index = volumetric.index
        others = (one for one in self.machine.volumetric if one.index != index)
        machine = replace(self.machine, volumetric=tuple(sorted((*others, volumetric), key=lambda one: one.index)))
        after, pool = compile_tables(machine, self.tables.cycle_time)
        for old, new in zip(self.tables.axis, after.axis, strict=True):
            keep_declared(old, new)
        adopt_volumetric(self.tables.volumetric[index], after.volumetric[index], self.state.volumetric[index])
        self.outputs.volumetric[index].active = False
        self.machine, self.tables, self.pool = machine, after, pool
        self._identity = None


def _tellable(machine: Machine) -> Iterator[tuple[int, int | None, str]]:
    """Yield what there can be to tell: index of an axis, number of a kind, None: of its switches, and the notice."""
    for index, axis in enumerate(machine.axes):
        for kind in kinds_of(axis):
            if kind.notice:
                yield index, kind.number, f"axis {axis.name}: {kind.notice}"
        yield index, None, f"axis {axis.name}: {NO_COMMAND}"


__all__ = ["Runtime", "SnapshotError", "UpdateError", "initial_inputs"]
