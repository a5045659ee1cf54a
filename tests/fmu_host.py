"""A small FMI 2.0 host on FMPy. FMUs run in child processes: pythonfmu may abort while a process exits."""

from __future__ import annotations

import functools
import multiprocessing
import shutil
import tempfile
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, ParamSpec, Self, TypeVar

import fmpy
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")

CYCLE = 0.001


@functools.cache
def _child() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn"))


def in_child(function: Callable[Parameters, Result], *args: Parameters.args, **kwargs: Parameters.kwargs) -> Result:
    """Call a function of a test module in another process; a new one if the last call has ended it."""
    try:
        return _child().submit(function, *args, **kwargs).result(timeout=120)
    except BrokenProcessPool:
        _child.cache_clear()
        raise


class Unpacked:
    """One instance of an FMU, its variables by name. ``folder``: where it is unpacked already."""

    def __init__(self, fmu: Path, slave: type[Any], folder: str | Path | None, start: float) -> None:
        self.own_folder = folder is None
        self.folder = Path(fmpy.extract(fmu, tempfile.mkdtemp()) if folder is None else folder)
        self.description = fmpy.read_model_description(self.folder)
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.messages: list[tuple[int, str, str]] = []
        self.time = start
        self.slave = slave(
            guid=self.description.guid,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            unzipDirectory=str(self.folder),
            instanceName="test",
        )

    def get(self, name: str) -> Any:
        raise NotImplementedError

    def outputs(self) -> dict[str, Any]:
        return {name: self.get(name) for name, variable in self.variables.items() if variable.causality == "output"}

    def close(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()
        if self.own_folder:
            shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Host(Unpacked):
    """An instance of FMI 2.0."""

    def __init__(
        self,
        fmu: Path,
        *,
        folder: str | Path | None = None,
        start: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(fmu, FMU2Slave, folder, start)
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self.log)
        self.callbacks.allocateMemory = defaultCallbacks.allocateMemory
        self.callbacks.freeMemory = defaultCallbacks.freeMemory
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=True)
        self.initialize(parameters or {})

    def initialize(self, values: Mapping[str, Any]) -> None:
        self.slave.setupExperiment(startTime=self.time)
        self.slave.enterInitializationMode()
        self.set(values)
        self.slave.exitInitializationMode()

    def log(self, _environment: Any, _name: Any, status: int, category: bytes, message: bytes) -> None:
        self.messages.append((status, category.decode(), message.decode()))

    def set(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            variable = self.variables[name]
            getattr(self.slave, f"set{variable.type}")([variable.valueReference], [value])

    def get(self, name: str) -> Any:
        variable = self.variables[name]
        (value,) = getattr(self.slave, f"get{variable.type}")([variable.valueReference])
        return bool(value) if variable.type == "Boolean" else value

    def step(self, values: Mapping[str, Any] | None = None, duration: float = CYCLE) -> dict[str, Any]:
        self.set(values or {})
        self.slave.doStep(self.time, duration)
        self.time += duration
        return self.outputs()

    def run(self, rows: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
        return [self.step(row) for row in rows]
