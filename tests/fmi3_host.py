"""A small FMI 3.0 host on FMPy: event mode at every step."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Self

import fmpy
from fmpy.fmi3 import FMU3Slave

CYCLE = 0.001


class Host3:
    """One instance of an FMU, its variables by name."""

    def __init__(self, fmu: Path, *, event_mode: bool = True, folder: Path | None = None) -> None:
        self.own_folder = folder is None
        self.folder = Path(fmpy.extract(fmu, tempfile.mkdtemp())) if folder is None else folder
        self.description = fmpy.read_model_description(self.folder)
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.messages: list[tuple[int, str, str]] = []
        self.event_mode = event_mode
        self.time = 0.0
        self.slave = FMU3Slave(
            guid=self.description.guid,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            unzipDirectory=str(self.folder),
            instanceName="test",
        )
        self.slave.instantiate(loggingOn=True, eventModeUsed=event_mode, logMessage=self.log)
        self.slave.enterInitializationMode(startTime=0.0)

    def begin(self, values: Mapping[str, Any] | None = None) -> None:
        self.set(values or {})
        self.slave.exitInitializationMode()

    def log(self, _environment: Any, status: int, category: bytes, message: bytes) -> None:
        self.messages.append((status, category.decode(), message.decode()))

    def set(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            variable = self.variables[name]
            many = value if isinstance(value, Sequence) and not isinstance(value, str) else [value]
            getattr(self.slave, f"set{variable.type}")([variable.valueReference], many)

    def get(self, name: str) -> Any:
        variable = self.variables[name]
        size = 1
        for dimension in variable.dimensions:
            size *= int(dimension.start)
        values = getattr(self.slave, f"get{variable.type}")([variable.valueReference], size)
        return list(values) if variable.dimensions else values[0]

    def outputs(self) -> dict[str, Any]:
        return {name: self.get(name) for name, variable in self.variables.items() if variable.causality == "output"}

    def event(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set inputs in event mode, in which the instance is after initialization, and return the outputs then."""
        self.set(values)
        self.slave.updateDiscreteStates()
        outputs = self.outputs()
        self.slave.enterStepMode()
        return outputs

    def step(self, duration: float = CYCLE) -> dict[str, Any]:
        """Make a step, and return the outputs at its end; the instance is in event mode then, if it is used."""
        self.slave.doStep(self.time, duration)
        self.time += duration
        outputs = self.outputs()
        if self.event_mode:
            self.slave.enterEventMode()
        return outputs

    def close(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()
        if self.own_folder:
            shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
