"""The engine on its own: step by step or over whole trajectories, with the names of the FMU's variables."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import Naming, Slot, Value, Variable, by_name, identifier, slot_of, variables_of, with_causality
from ..lists import Finding, ListError, TypeName, read_machine
from ..model import CYCLE_TIME, Machine
from ..native import NOTHING, CompiledRuntime, Fields, Poke, compiled_kernel
from ..runtime import Runtime
from .completion import completed
from .nc_control import NcControl
from .nc_scanner import NcError
from .result import Result
from .values import Row, column_of, taken

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

TIME = "time"
COMMAND = "command"
"""Column of a trajectory that has NC commands."""

CHUNK = 4096
"""Cycles whose outputs are kept as Python objects before they go into arrays."""


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
    allow_outside : sequence of path
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
    ListError
        If there is no axis at a path; ``findings`` say why.
    CompileError
        If a Machine made by hand cannot be run.

    Examples
    --------
    >>> from axcomp import Engine, models
    >>> engine = Engine(models() / "rotary_table", cycle_time=0.002)
    >>> engine
    Engine(C: leadscrew, friction; cycle 0.002 s, at 0 s)
    >>> result = engine.run({"C.setpoint": [0.0, 90.0]})
    >>> result["C.correction"].shape, result.units["C.correction"]
    ((2,), 'deg')
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
            if not machine.axes:
                raise ListError(self.findings)
        self._arguments = machine, cycle_time, naming
        self.machine = machine
        kernel = compiled_kernel()
        self.runtime = Runtime(machine, cycle_time) if kernel is None else CompiledRuntime(machine, cycle_time, kernel)
        self.nc = NcControl(self.runtime, lists, allow_outside)
        self.variables = tuple(v for v in variables_of(machine, naming, cycle_time) if self._slot(v) is not None)
        self._by_name = by_name(self.variables)
        self._slots: dict[str, Slot] = {}
        self._bound: object = None
        self._said: set[str] = set()
        self._outputs = with_causality(self.variables, "output")
        self._units = {v.name: v.unit for v in self._outputs if v.unit}
        self._complete: set[frozenset[str]] = set()
        self._rows: dict[tuple[str, ...], Row] = {}
        self._fields: dict[tuple[str, ...], Fields] = {}

    def __repr__(self) -> str:
        named = [f"{one.name}: {', '.join(one.kinds) or 'no compensation'}" for one in self.machine.axes]
        named += [
            f"volumetric[{one.index}]: {', '.join(letter for letter, _ in one.axes)}" for one in self.machine.volumetric
        ]
        return f"Engine({'; '.join(named)}; cycle {self.runtime.tables.cycle_time:g} s, at {self.time:g} s)"

    def _repr_html_(self) -> str:
        """Return what it holds as a table, for notebooks."""
        inputs, outputs = (len(with_causality(self.variables, which)) for which in ("input", "output"))
        cycle_time = f"cycle {self.runtime.tables.cycle_time:g} s, at {self.time:g} s"
        return f"<p>Engine: {inputs} inputs, {outputs} outputs, {cycle_time}</p>{self.machine._repr_html_()}"

    def __getstate__(self) -> dict[str, Any]:
        """Return what an engine is made again from, by pickle and copy: it goes on where this one stands."""
        return {
            "arguments": self._arguments,
            "findings": self.findings,
            "said": set(self._said),
            "runtime": self.runtime.keep(),
            "nc": self.nc.keep(),
        }

    def __setstate__(self, kept: Mapping[str, Any]) -> None:
        self.__init__(*kept["arguments"])  # type: ignore[misc]  # it is made anew
        self.findings, self._said = kept["findings"], set(kept["said"])
        self.runtime.take(kept["runtime"])
        self.nc.take(kept["nc"])

    @property
    def time(self) -> float:
        """Instant of the next cycle, s."""
        return self.runtime.start_time + self.runtime.cycles * self.runtime.tables.cycle_time

    def set(self, values: Mapping[str, Value]) -> None:
        """Set inputs ``values`` by name, held until set again; KeyError, with the known names, for an unknown one."""
        for name, value in values.items():
            variable = self._input(name)
            self._slot_of(variable).set(taken(variable)(value))

    def get(self) -> dict[str, Value]:
        """Return all outputs of the last cycle by name."""
        return {variable.name: self._slot_of(variable).get() for variable in self._outputs}

    def step(self, values: Mapping[str, Value] | None = None, command: str = "") -> dict[str, Value]:
        """Set inputs ``values``, carry out an NC ``command``, run one cycle, and return its outputs by name.

        NcError for a command that cannot be carried out.
        """
        if isinstance(self.runtime, CompiledRuntime) and not command:
            return self._row_of(self.runtime, values or {}).step(self.runtime, values or {})
        self._cycle(values or {}, command)
        return self.get()

    def _fields_of(self, runtime: CompiledRuntime, variables: Sequence[Variable]) -> Fields:
        names = tuple(variable.name for variable in variables)
        if names not in self._fields:
            self._fields[names] = runtime.fields(variables)
        return self._fields[names]

    def _row_of(self, runtime: CompiledRuntime, values: Iterable[str]) -> Row:
        """Return a row with inputs of these names; hosts set the same ones again and again."""
        names = tuple(values)
        if names not in self._rows:
            self._rows[names] = Row(runtime, [self._input(name) for name in names], self._outputs)
        return self._rows[names]

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
        cycles = _length({name: column for name, column in trajectory.items() if name != TIME})
        trajectory, said = self._completed(trajectory)
        if cycles == 1 and COMMAND not in trajectory and isinstance(self.runtime, CompiledRuntime):
            return self._run_row(self.runtime, trajectory, said)
        given = [self._input(name) for name in trajectory if name not in (TIME, COMMAND)]
        columns = [column_of(trajectory[v.name], v) for v in given]
        blocks = _blocks(trajectory[COMMAND]) if COMMAND in trajectory else {}
        instants = np.arange(self.runtime.cycles, self.runtime.cycles + cycles, dtype=np.float64)
        time = self.runtime.start_time + self.runtime.tables.cycle_time * instants
        notices = self._unsaid(said)
        if isinstance(self.runtime, CompiledRuntime):
            values, told = self._run_compiled(self.runtime, given, columns, blocks, cycles)
        else:
            values, told = self._run_in_python(given, columns, blocks, cycles)
        named = {variable.name: column for variable, column in zip(self._outputs, values, strict=True)}
        return Result(time, named, (*notices, *told, *self.runtime.notices()), self._units)

    @property
    def modulo(self) -> dict[str, float]:
        """After how many ° the positions of an axis repeat, by its name among the variables; only axes that do."""
        return {identifier(axis.name): axis.modulo.length for axis in self.machine.axes if axis.modulo is not None}

    def _completed(self, trajectory: Mapping[str, ArrayLike]) -> tuple[dict[str, ArrayLike], list[str]]:
        """Add what follows from the setpoints and velocities of a trajectory (see ``completion``)."""
        names = frozenset(trajectory)
        if names in self._complete:
            return dict(trajectory), []
        state, count = self.runtime.state, len(self.machine.axes)
        motions = (state.motion.axis[i] if state.axis[i].started else None for i in range(count))
        before = [None if motion is None else (motion.setpoint, motion.velocity) for motion in motions]
        modulo = [table.modulo_range for table in self.runtime.tables.axis]
        found, said = completed(trajectory, self.variables, self.runtime.tables.cycle_time, before, modulo)
        if len(found) == len(names):
            self._complete.add(names)
        return found, said

    def _run_row(self, runtime: CompiledRuntime, trajectory: Mapping[str, ArrayLike], said: Sequence[str]) -> Result:
        """Run one cycle: a controller's loop calls for it again and again."""
        given = {name: np.asarray(column).item() for name, column in trajectory.items() if name != TIME}
        time = np.array([self.time])
        row = self._row_of(runtime, given)
        row.step(runtime, given)
        return Result(time, row.columns(), (*self._unsaid(said), *runtime.notices()), self._units)

    def _unsaid(self, said: Sequence[str]) -> list[str]:
        """Return what has not been said before."""
        new = [text for text in said if text not in self._said]
        self._said.update(new)
        return new

    def _run_compiled(
        self,
        runtime: CompiledRuntime,
        given: Sequence[Variable],
        columns: Sequence[NDArray[Any]],
        blocks: Mapping[int, str],
        cycles: int,
    ) -> tuple[list[NDArray[Any]], list[str]]:
        """Return the columns of the outputs and what commands had to say; most commands need no stop between rows."""
        programs: dict[str, tuple[list[Poke], list[str]] | None] = {}
        for row, block in blocks.items():
            if block not in programs:
                with _naming_row(row):
                    programs[block] = self.nc.pokes(block)
        given_fields = self._fields_of(runtime, given).of(columns)
        result_fields, results = self._fields_of(runtime, self._outputs).new(cycles)
        notices: list[str] = []
        events: list[tuple[int, list[Poke]]] = []
        first = 0

        def run_to(last: int) -> None:
            if last > first:
                runtime.run(given_fields.from_row(first), result_fields.from_row(first), last - first, events)
                events.clear()

        for row, block in blocks.items():
            program = programs[block]
            if program is not None:
                events.append((row - first, program[0]))
                notices += program[1]
                continue
            run_to(row)
            self.set({variable.name: column[row].item() for variable, column in zip(given, columns, strict=True)})
            with _naming_row(row):
                notices += self.nc.execute(block)
            runtime.run(NOTHING, result_fields.from_row(row), 1)
            self.nc.after_cycle()
            first = row + 1
        run_to(cycles)
        return results, notices

    def _run_in_python(
        self, given: Sequence[Variable], columns: Sequence[NDArray[Any]], blocks: Mapping[int, str], cycles: int
    ) -> tuple[list[NDArray[Any]], list[str]]:
        for row, block in blocks.items():
            with _naming_row(row):
                self.nc.check(block)
        setters = [self._slot_of(variable) for variable in given]
        getters = [self._slot_of(variable) for variable in self._outputs]
        results = [np.empty(cycles, type(variable.start)) for variable in self._outputs]
        notices: list[str] = []
        for first in range(0, cycles, CHUNK):
            last = min(first + CHUNK, cycles)
            kept: list[list[Value]] = []
            rows: Iterable[tuple[Value, ...]] = [()] * CHUNK
            if given:
                rows = zip(*(column[first:last].tolist() for column in columns), strict=True)
            for number, inputs in zip(range(first, last), rows, strict=False):
                for (_, write, record, key), value in zip(setters, inputs, strict=True):
                    write(record, key, value)
                if number in blocks:
                    with _naming_row(number):
                        notices += self.nc.execute(blocks[number])
                self.runtime.cycle()
                self.nc.after_cycle()
                kept.append([read(record, key) for read, _, record, key in getters])
            for result, column in zip(results, zip(*kept, strict=True), strict=True):
                result[first:last] = column
        return results, notices

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


def _length(columns: Mapping[str, ArrayLike]) -> int:
    shapes = [column.shape if isinstance(column, np.ndarray) else np.shape(column) for column in columns.values()]
    if not shapes:
        raise ValueError("the trajectory has no input")
    if len(shapes[0]) != 1 or shapes.count(shapes[0]) < len(shapes):
        listed = ", ".join(f"{name}: {shape}" for name, shape in zip(columns, shapes, strict=True))
        raise ValueError(f"the columns of a trajectory are one-dimensional and equally long, not {listed}")
    return int(shapes[0][0])


def _blocks(column: ArrayLike) -> dict[int, str]:
    """Return the rows with NC commands."""
    blocks = column if isinstance(column, list | tuple) else np.asarray(column).tolist()
    found = [(row, str(block)) for row, block in enumerate(blocks) if block]
    blank = {block for block in {block for _, block in found} if not block.strip()}
    return {row: block for row, block in found if block not in blank}


@contextmanager
def _naming_row(row: int) -> Iterator[None]:
    """Put the row into the error of a command."""
    try:
        yield
    except NcError as error:
        raise ValueError(f"command in row {row}: {error}") from error
