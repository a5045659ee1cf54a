"""One instance of the FMU while it runs: what the calls of FMI 2.0 do. No call ever raises.

What goes wrong is told in the log, on standard error, and by the output ``error`` of the axes. Standard library only.
"""

from __future__ import annotations

import contextlib
import functools
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Concatenate, ParamSpec, TypeVar

from ..interface import ERROR_CALL, TYPE_NAMES, Controls, Slot, Value, every_slot, whole
from ..kernel import ERROR_UPDATE
from ..kinds import Severity
from ..lists import read_machine
from ..model import Machine
from ..runtime import ON_INSTANT, Runtime
from .packed_interface import FILE_NAME, FOLDER, Interface
from .saved import Saved

FINDINGS_MAX = 100
"""Findings of one reading that go to the log."""

REMEMBERED_MAX = 1000
"""Messages that are told once only; beyond these nothing new is told."""

_Parameters = ParamSpec("_Parameters")
_Result = TypeVar("_Result")


def guarded(
    method: Callable[Concatenate[Instance, _Parameters], _Result],
) -> Callable[Concatenate[Instance, _Parameters], _Result | None]:
    """Make a method report what it would raise, and return None then."""

    @functools.wraps(method)
    def call(self: Instance, /, *args: _Parameters.args, **kwargs: _Parameters.kwargs) -> _Result | None:
        try:
            return method(self, *args, **kwargs)
        except Exception as error:
            self.fail(f"{method.__name__}: {type(error).__name__}: {error}", ERROR_CALL)
            return None

    return call


class Instance:
    """An instance of the FMU: the machine in operation, and the variables that are not the kernel's (``controls``).

    ``resources`` is the path of the FMU's folder of this name; ``log`` takes a severity and one line of text without
    ``%``.
    """

    def __init__(self, resources: str, log: Callable[[Severity, str], None]) -> None:
        self._log = log
        self._told: set[str] = set()
        self._resources = Path(resources)
        self._interface = Interface()
        self._start_time = self._time = 0.0
        self._stop_time = math.inf
        self._initializing = False
        self._reload_seen = False
        self.controls = Controls()
        self.runtime = Runtime(Machine())
        self._start()
        self._own_machine = self.runtime.machine
        self._readable: dict[str, dict[int, Slot]] = {name: {} for name in TYPE_NAMES.values()}
        self._settable: dict[str, dict[int, Slot]] = {name: {} for name in TYPE_NAMES.values()}
        self._run(self.runtime)

    @guarded
    def _start(self) -> None:
        """Read the lists; where that fails, the axes are there but not corrected."""
        self._interface = Interface.from_json((self._resources / FILE_NAME).read_text(encoding="utf-8"))
        self.controls.cycle_time = self._interface.cycle_time
        self.runtime = Runtime(self._interface.bare(), self._interface.cycle_time)
        machine, complaints, _ = self._read(self._own_lists)
        for complaint in complaints:
            self.tell(Severity.ERROR, complaint)
        self.runtime = Runtime(machine, self._interface.cycle_time)

    @property
    def _own_lists(self) -> Path:
        return self._resources / self._interface.lists

    def _read(self, path: Path) -> tuple[Machine, list[str], int]:
        """Return the machine of a list, what does not fit the variables, and the number of errors found."""
        reading = read_machine(path, axis_type=self._interface.axis_type, allow_outside=[self._resources / FOLDER])
        findings = reading.findings
        for finding in findings[:FINDINGS_MAX]:
            self.tell(finding.severity, str(finding))
        if len(findings) > FINDINGS_MAX:
            self.tell(Severity.WARNING, f"{path.name}: {len(findings) - FINDINGS_MAX} more findings")
        machine, complaints = self._interface.fit(reading.machine)
        return machine, complaints, sum(finding.severity is Severity.ERROR for finding in findings)

    def _run(self, runtime: Runtime) -> None:
        """Go on with a runtime: note where the value of each reference is."""
        self.runtime = runtime
        records = (runtime.inputs, runtime.outputs, self.controls)
        count = len(runtime.inputs.volumetric)
        for reference, declaration, slot in every_slot(len(runtime.machine.axes), *records, volumetrics=count):
            name, place = TYPE_NAMES[type(declaration.start)], slot
            if self._interface.types == "real" and name in AS_REAL:
                name, place = "Real", slot.as_real(AS_REAL[name])
            self._readable[name][reference] = place
            if declaration.causality != "output":
                self._settable[name][reference] = place

    # Reports

    def tell(self, severity: Severity, text: str) -> None:
        """Put a line into the log, an error on standard error too; the same line once, until the next ``reload``."""
        line = " ".join(text.replace("%", " percent").replace("\0", " ").split())
        line = line.encode("utf-8", "replace").decode()
        if line in self._told or len(self._told) > REMEMBERED_MAX:
            return
        self._told.add(line)
        self._log(severity, line)
        if severity is Severity.ERROR:
            with contextlib.suppress(OSError, ValueError, AttributeError):
                sys.stderr.write(f"axcomp: {line}\n")

    def fail(self, text: str, number: int) -> None:
        """Tell an error, and set the output ``error`` of every axis until reset."""
        self.tell(Severity.ERROR, text)
        for state, outputs in zip(self.runtime.state.axis, self.runtime.outputs.axis, strict=True):
            state.error = outputs.error = number

    # Variables

    def get(self, type_name: str, references: Sequence[int]) -> list[Any]:
        """Return the values of variables of one type; 0, false or "" for a reference that is none."""
        if self._initializing:
            self._begin()
        slots = self._readable[type_name]
        try:
            return [read(record, key) for read, _, record, key in map(slots.__getitem__, references)]
        except KeyError:
            return [self._value(type_name, reference) for reference in references]

    def _value(self, type_name: str, reference: int) -> Value:
        slot = self._readable[type_name].get(reference)
        if slot is None:
            self.fail(f"there is no {type_name} variable with value reference {reference}", ERROR_CALL)
            return ZEROS[type_name]
        value: Value = slot.get()
        return value

    def set(self, type_name: str, references: Sequence[int], values: Sequence[Value]) -> None:
        """Set variables of one type; a reference that is none, or of an output, is passed over."""
        slots = self._settable[type_name]
        try:
            for reference, value in zip(references, values, strict=False):
                _, write, record, key = slots[reference]
                write(record, key, value)
        except KeyError:
            self._set_those_that_are(type_name, references, values)

    def _set_those_that_are(self, type_name: str, references: Sequence[int], values: Sequence[Value]) -> None:
        for reference, value in zip(references, values, strict=False):
            slot = self._settable[type_name].get(reference)
            if slot is None:
                self.fail(f"there is no {type_name} variable to set with value reference {reference}", ERROR_CALL)
            else:
                slot.set(value)

    # Time

    def set_up(self, start_time: float, stop_time: float | None = None) -> None:
        """Take start and stop time (fmi2SetupExperiment); None: none is known."""
        self._start_time = start_time
        self._stop_time = math.inf if stop_time is None else stop_time

    def enter_initialization(self) -> None:
        """From now on outputs are computed whenever they are read (fmi2EnterInitializationMode)."""
        self._initializing = True

    def exit_initialization(self) -> None:
        """Compute the outputs that belong to the start time (fmi2ExitInitializationMode)."""
        self._begin()
        self._initializing = False
        self._time = self._start_time

    @guarded
    def _begin(self) -> None:
        wanted, self.controls.cycle_time = self.controls.cycle_time, self.runtime.tables.cycle_time
        if wanted != self.controls.cycle_time:
            runtime = Runtime(self.runtime.machine, wanted)
            runtime.inputs = self.runtime.inputs
            self._run(runtime)
            self.controls.cycle_time = wanted
        self.runtime.begin(self._start_time)

    @guarded
    def do_step(self, time: float, duration: float) -> bool:
        """Run the cycles whose instants lie in [time, time + duration) with the inputs held.

        False: nothing was done, for it would go back in time, beyond the stop time, or be too long.
        """
        tolerance, end = ON_INSTANT * self.runtime.tables.cycle_time, time + duration  # hosts add up their steps
        due = self.runtime.due(end)
        refused = ""
        if time < self._time - tolerance:
            refused = f"a step from {time:g} s would go back, the last one ended at {self._time:g} s"
        elif end > self._stop_time + tolerance:
            refused = f"a step to {end:g} s goes beyond the stop time, {self._stop_time:g} s"
        elif due > self.controls.largest_step:
            refused = f"a step of {due} cycles is refused; largest_step is {self.controls.largest_step}"
        if refused:
            self.tell(Severity.ERROR, f"do_step: {refused}")
            return False
        if self.controls.reload and not self._reload_seen:
            self._reload_seen = True
            self._reload()
        self._reload_seen = self.controls.reload
        self.runtime.advance(end)
        self._time = end
        for notice in self.runtime.notices():
            self.tell(Severity.WARNING, notice)
        return True

    def _reload(self) -> None:
        """Read the lists in ``update_path``; they are refused as a whole when anything about them is wrong."""
        self._told.clear()
        path = Path(self.controls.update_path) if self.controls.update_path else self._own_lists
        try:
            machine, complaints, errors = self._read(path)
            if errors or complaints:
                raise ValueError(f"errors in the lists: {errors}" if errors else "; ".join(complaints))
            for name, number in self.runtime.update(machine).items():
                self.tell(Severity.ERROR, f"axis {name} keeps its old lists: error {number}")
        except Exception as error:
            self.fail(f"reload of {path} refused: {error}", ERROR_UPDATE)

    # State

    def save(self) -> bytes:
        """Return everything that changes: state, inputs, outputs, clock, controls, and lists taken by ``reload``."""
        return self._save() or b""

    @guarded
    def _save(self) -> bytes:
        machine = self.runtime.machine
        saved = Saved(
            self.controls.cycle_time,
            self.controls.largest_step,
            self.controls.reload,
            self.controls.update_path,
            self._reload_seen,
            self._initializing,
            self._start_time,
            self._stop_time,
            self._time,
            None if machine is self._own_machine else machine,
            self.runtime.save(),
        )
        return saved.to_bytes()

    @guarded
    def restore(self, data: bytes) -> None:
        """Go back to what ``save`` returned, here or in another instance of the same FMU; else nothing changes."""
        saved = Saved.from_bytes(data)
        machine = saved.machine or self._own_machine
        runtime = self.runtime
        if machine is not runtime.machine or saved.cycle_time != runtime.tables.cycle_time:
            runtime = Runtime(machine, saved.cycle_time)
        runtime.restore(saved.snapshot)
        self._run(runtime)
        self.controls.cycle_time = saved.cycle_time
        self.controls.largest_step = saved.largest_step
        self.controls.reload = saved.reload
        self.controls.update_path = saved.update_path
        self._reload_seen = saved.reload_seen
        self._initializing = saved.initializing
        self._start_time = saved.start_time
        self._stop_time = saved.stop_time
        self._time = saved.time


AS_REAL: dict[str, Callable[[float], Value]] = {
    "Integer": whole,
    "Boolean": lambda value: not math.isnan(value) and whole(value) != 0,
}
"""Type of a variable that is Real in the model description → what a number means there."""

ZEROS: dict[str, Value] = {name: kind() for kind, name in TYPE_NAMES.items()}
