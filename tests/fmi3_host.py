"""A small FMI 3.0 host on FMPy: event mode at every step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fmpy.fmi3 import FMU3Slave
from fmu_host import CYCLE, Unpacked


class Host3(Unpacked):
    """An instance of FMI 3.0."""

    def __init__(self, fmu: Path, *, event_mode: bool = True, folder: Path | None = None) -> None:
        super().__init__(fmu, FMU3Slave, folder, 0.0)
        self.event_mode = event_mode
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
