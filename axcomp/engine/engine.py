"""The engine on its own: step by step or over whole trajectories, with the names of the FMU's variables."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import Naming, Slot, Value, Variable, by_name, identifier, slot_of, variables_of, whole, with_causality
from ..lists import Finding, TypeName, read_machine
from ..model import CYCLE_TIME, Machine
from ..native import CompiledTables, compiled_kernel, run_compiled
from ..runtime import Runtime
from ..saving import write_whole
from .completion import completed
from .nc_control import NcControl
from .nc_scanner import NcError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..kernel import Inputs

COMMAND = "command"
"""Column of a trajectory that has NC commands."""

CHUNK = 4096
"""Cycles whose outputs are kept as Python objects before they go into arrays."""


@dataclass(frozen=True)
class Result:
    """Outputs over a trajectory: float, int or bool by name, shape (n,), and the instants of the cycles, s.

    ``notices``: what the run has to say, a sentence each.
    """

    time: NDArray[np.float64]
    values: Mapping[str, NDArray[Any]]
    notices: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the values of one variable, shape (n,)."""
        return self.values[name]

    def __len__(self) -> int:
        """Return the number of cycles."""
        return len(self.time)

    def __repr__(self) -> str:
        return f"Result({len(self)} cycles of {len(self.values)} variables)"

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write time and all variables as CSV that reads back to the same bits."""
        write_whole(path, "".join(f"{line}\n" for line in self.csv_lines()))

    def csv_lines(self) -> Iterator[str]:
        """Yield the lines that ``to_csv`` writes."""
        columns = [self.time.tolist(), *(column.tolist() for column in self.values.values())]
        yield ",".join(["time", *self.values])
        for row in zip(*columns, strict=True):
            yield ",".join(repr(float(value)) for value in row)


class Engine:
    """The compensations of a machine, cycle by cycle.

    Parameters
    ----------
    machine : Machine or path
        A path is read as ``axcomp.lists.read_machine`` does.
    cycle_time : float
        Of the position controller, s.
    naming : str
        ``structured`` or ``flat``, as the FMU's variables.
    axis_type : str or None
        As in ``read_machine``.

    Attributes
    ----------
    machine : Machine
    findings : tuple of Finding
        What the reader had to say; empty for a Machine.
    variables : tuple of Variable
        Those of the FMU that are inputs or outputs of a cycle.
    nc : NcControl
        Carries out NC commands, and reads and writes the variables ``V.G.VOLCOMP[i]…``.

    Raises
    ------
    CompileError
        If a Machine made by hand cannot be run.
    """

    def __init__(
        self,
        machine: Machine | str | os.PathLike[str],
        cycle_time: float = CYCLE_TIME,
        naming: Naming = "structured",
        axis_type: TypeName | None = None,
        allow_outside: Sequence[str | os.PathLike[str]] = (),
    ) -> None:
        self.findings: tuple[Finding, ...] = ()
        lists = None
        if not isinstance(machine, Machine):
            lists = machine
            reading = read_machine(machine, axis_type=axis_type, allow_outside=allow_outside)
            machine, self.findings = reading.machine, tuple(reading.findings)
        self.machine = machine
        self.runtime = Runtime(machine, cycle_time)
        self._compiled: CompiledTables | None = None
        self.nc = NcControl(self.runtime, lists, allow_outside)
        self.variables = tuple(v for v in variables_of(machine, naming, cycle_time) if self._slot(v) is not None)
        self._by_name = by_name(self.variables)
        self._slots: dict[str, Slot] = {}
        self._bound: Inputs | None = None
        self._said: set[str] = set()
        self._outputs = with_causality(self.variables, "output")

    @property
    def time(self) -> float:
        """Instant of the next cycle, s."""
        return self.runtime.start_time + self.runtime.cycles * self.runtime.tables.cycle_time

    def set(self, values: Mapping[str, Value]) -> None:
        """Set inputs by name; they are held until set again. KeyError with the known names for an unknown one."""
        for name, value in values.items():
            variable = self._input(name)
            self._slot_of(variable).set(
                whole(float(value)) if variable.type == "Integer" else type(variable.start)(value)
            )

    def get(self) -> dict[str, Value]:
        """Return all outputs of the last cycle by name."""
        return {variable.name: self._slot_of(variable).get() for variable in self._outputs}

    def step(self, values: Mapping[str, Value] | None = None, command: str = "") -> dict[str, Value]:
        """Set inputs, carry out an NC command, run one cycle, and return its outputs by name.

        NcError for a command that cannot be carried out.
        """
        self._cycle(values or {}, command)
        return self.get()

    def _cycle(self, values: Mapping[str, Value], command: str) -> tuple[str, ...]:
        """Do what ``step`` does; return what the command has to say."""
        self.set(values)
        notices = self.nc.execute(command)
        self.runtime.cycle()
        self.nc.after_cycle()
        return notices

    def run(self, trajectory: Mapping[str, ArrayLike]) -> Result:
        """Run one cycle for each row of a trajectory: the same bits as as many calls of ``step``.

        The compiled kernel does it where there is one (see ``native.library``), else Python.

        Parameters
        ----------
        trajectory : mapping of str to array_like, shape (n,)
            Inputs by name; a ``time`` column is ignored, inputs that are not named are held. A column ``command`` has
            NC commands, "" in most rows: they act in the cycle of their row. What an axis with a column of setpoints
            has no columns for follows from them: velocity, acceleration, and the velocities to come.

        Raises
        ------
        KeyError
            For a name that is no input.
        ValueError
            If the columns differ in length, or a command is none; an UPDATE can be refused midway.
        """
        cycles = _length({name: column for name, column in trajectory.items() if name != "time"})
        trajectory, said = self._completed(trajectory)
        given = [self._input(name) for name in trajectory if name not in ("time", COMMAND)]
        columns = [_column(trajectory[v.name], v) for v in given]
        if not given:
            given = [next(variable for variable in self.variables if variable.causality == "input")]
            columns = [np.full(cycles, self._slot_of(given[0]).get())]
        blocks = [str(block) for block in np.asarray(trajectory.get(COMMAND, [])).tolist()]
        for row, block in enumerate(blocks):
            with _naming_row(row):
                self.nc.check(block)
        instants = np.arange(self.runtime.cycles, self.runtime.cycles + cycles, dtype=np.float64)
        time = self.runtime.start_time + self.runtime.tables.cycle_time * instants
        notices: list[str] = [text for text in said if text not in self._said]
        self._said.update(said)
        pieces = []
        for first, last in _pieces(blocks, cycles):
            rows = [column[first:last] for column in columns]
            if first < len(blocks) and blocks[first].strip():
                inputs = {variable.name: column.item() for variable, column in zip(given, rows, strict=True)}
                with _naming_row(first):
                    notices += self._cycle(inputs, blocks[first])
                pieces.append({name: np.array([value]) for name, value in self.get().items()})
            elif (kernel := compiled_kernel()) is None:
                pieces.append(self._run_in_python(given, rows))
            else:
                pieces.append(self._run_compiled(kernel, given, rows))
        values = pieces[0]
        if len(pieces) > 1:
            values = {name: np.concatenate([piece[name] for piece in pieces]) for name in values}
        return Result(time, values, (*notices, *self.runtime.notices()))

    @property
    def modulo(self) -> dict[str, float]:
        """After how many ° the positions of an axis repeat, by its name among the variables; only axes that do."""
        return {identifier(axis.name): axis.modulo.length for axis in self.machine.axes if axis.modulo is not None}

    def _completed(self, trajectory: Mapping[str, ArrayLike]) -> tuple[dict[str, ArrayLike], list[str]]:
        """Add what follows from the setpoints and velocities of a trajectory (see ``completion``)."""
        state = self.runtime.state
        before = [
            (motion.setpoint, motion.velocity) if axis.started else None
            for axis, motion in zip(state.axis, state.motion.axis, strict=True)
        ]
        modulo = [table.modulo_range for table in self.runtime.tables.axis]
        return completed(trajectory, self.variables, self.runtime.tables.cycle_time, before, modulo)

    def _run_compiled(
        self, kernel: ctypes.CDLL, given: Sequence[Variable], columns: Sequence[NDArray[Any]]
    ) -> dict[str, NDArray[Any]]:
        if self._compiled is None or self._compiled.tables is not self.runtime.tables:
            self._compiled = CompiledTables(self.runtime.tables, self.runtime.pool)
        rows = np.column_stack([column.astype(np.float64) for column in columns])
        results = run_compiled(kernel, self._compiled, self.runtime, given, np.ascontiguousarray(rows), self._outputs)
        return {v.name: results[:, k].astype(type(v.start)) for k, v in enumerate(self._outputs)}

    def _run_in_python(self, given: Sequence[Variable], columns: Sequence[NDArray[Any]]) -> dict[str, NDArray[Any]]:
        cycles = len(columns[0])
        setters = [self._slot_of(variable) for variable in given]
        getters = [self._slot_of(variable) for variable in self._outputs]
        values = {variable.name: np.empty(cycles, type(variable.start)) for variable in self._outputs}
        run_cycle = self.runtime.cycle
        for first in range(0, cycles, CHUNK):
            last = min(first + CHUNK, cycles)
            kept: list[list[Value]] = []
            for row in zip(*(column[first:last].tolist() for column in columns), strict=True):
                for (_, write, record, key), value in zip(setters, row, strict=True):
                    write(record, key, value)
                run_cycle()
                kept.append([read(record, key) for read, _, record, key in getters])
            for variable, column in zip(self._outputs, zip(*kept, strict=True), strict=True):
                values[variable.name][first:last] = column
        return values

    def _slot(self, variable: Variable) -> Slot | None:
        records = (self.runtime.inputs, self.runtime.outputs)
        return slot_of(variable, variable.axis, *records, volumetric=variable.volumetric)

    def _slot_of(self, variable: Variable) -> Slot:
        """Return where an input or an output is; the runtime's records stay the same as long as it lives."""
        if self._bound is not self.runtime.inputs:
            found = ((v.name, self._slot(v)) for v in self.variables)
            self._slots = {name: slot for name, slot in found if slot is not None}
            self._bound = self.runtime.inputs
        return self._slots[variable.name]

    def _input(self, name: str) -> Variable:
        variable = self._by_name.get(name)
        if variable is None or variable.causality != "input":
            known = ", ".join(v.name for v in with_causality(self.variables, "input"))
            raise KeyError(f"{name} is no input; the inputs are {known}")
        return variable


def _column(values: ArrayLike, variable: Variable) -> NDArray[Any]:
    if variable.type == "Integer":
        return np.array([whole(value) for value in np.asarray(values, dtype=float).tolist()])
    return np.asarray(values).astype(type(variable.start))


def _length(columns: Mapping[str, ArrayLike]) -> int:
    lengths = {name: np.shape(column) for name, column in columns.items()}
    if not lengths:
        raise ValueError("the trajectory has no input")
    if len(set(lengths.values())) > 1 or any(len(shape) != 1 for shape in lengths.values()):
        shapes = ", ".join(f"{name}: {shape}" for name, shape in lengths.items())
        raise ValueError(f"the columns of a trajectory are one-dimensional and equally long, not {shapes}")
    return int(next(iter(lengths.values()))[0])


def _pieces(blocks: Sequence[str], cycles: int) -> list[tuple[int, int]]:
    """Return first and last row + 1 of the pieces of a trajectory; one that begins with a command is that row alone."""
    borders = {0, cycles}
    for row, block in enumerate(blocks):
        if block.strip():
            borders |= {row, row + 1}
    return list(pairwise(sorted(borders))) or [(0, 0)]


@contextmanager
def _naming_row(row: int) -> Iterator[None]:
    """Put the row into the error of a command."""
    try:
        yield
    except NcError as error:
        raise ValueError(f"command in row {row}: {error}") from error
