"""What an FMU costs in a host: set, step and get through FMPy with arrays made before."""

from __future__ import annotations

import ctypes
import math
import multiprocessing
import os
import shutil
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Slave

from ..fmu import package_axcomp, package_native
from .clock import Sample

STEPS = 2000


def bench_fmu(
    path: str | os.PathLike[str], name: str, repeats: int, *, goal: float | None = None, start_goal: float | None = None
) -> tuple[Sample, Sample]:
    """Measure an FMU in a child process: the steps in µs, and loading it up to the end of initialization in ms."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        steps, starts = pool.submit(_measure, os.fspath(path), repeats).result()
    return (
        Sample(f"set + step + get of {name} through FMPy", "µs", tuple(1e6 * s / STEPS for s in steps), goal),
        Sample(f"load, instantiate and initialize {name}", "ms", tuple(1e3 * s for s in starts), start_goal),
    )


def bench_fmus(lists: Path, folder: Path, repeats: int) -> Iterator[Sample]:
    """Build the FMUs of a machine in a folder and measure them side by side."""
    python = package_axcomp(lists, folder / "python.fmu").path
    python_step, python_start = bench_fmu(python, "the Python FMU", repeats, goal=70.0)
    yield from (python_step, python_start)
    begin = time.perf_counter()
    native = package_native(lists, folder / "native.fmu").path
    yield Sample("build the native FMU", "s", (time.perf_counter() - begin,), 1.5)
    native_step, native_start = bench_fmu(native, "the native FMU", repeats, start_goal=10.0)
    yield from (native_step, native_start)
    ratios = tuple(python_step.median / step for step in native_step.values)
    yield Sample("speed of the native FMU against the Python FMU, through FMPy", "×", ratios, 8.0)
    yield Sample("size of the native FMU", "MB", (native.stat().st_size / 1e6,), 1.5)


def _measure(path: str, repeats: int) -> tuple[list[float], list[float]]:
    folder = fmpy.extract(path)
    try:
        description = fmpy.read_model_description(path)
        steps, starts = [], []
        for _ in range(repeats):
            begin = time.process_time()
            slave = FMU2Slave(
                guid=description.guid,
                modelIdentifier=description.coSimulation.modelIdentifier,
                unzipDirectory=folder,
                instanceName="bench",
            )
            slave.instantiate()
            slave.setupExperiment(startTime=0.0)
            slave.enterInitializationMode()
            slave.exitInitializationMode()
            starts.append(time.process_time() - begin)
            steps.append(_steps(slave, description))
            slave.terminate()
            slave.freeInstance()
        return steps, starts
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _steps(slave: FMU2Slave, description: Any) -> float:
    """Run ``STEPS`` steps; every input is set and every output is read in each.

    FMPy's functions are called without its checks in Python around them, which cost more than a native step.
    """
    size = float(description.defaultExperiment.stepSize)
    component, dll = slave.component, slave.dll
    set_real, set_boolean, set_integer, do_step = (
        dll.fmi2SetReal,
        dll.fmi2SetBoolean,
        dll.fmi2SetInteger,
        dll.fmi2DoStep,
    )
    reals, real_input = _values(description, "input", "Real")
    _, boolean_input = _values(description, "input", "Boolean")
    _, integer_input = _values(description, "input", "Integer")
    outputs = [
        (getattr(slave.dll, f"fmi2Get{kind}"), *_values(description, "output", kind)[1])
        for kind in ("Real", "Boolean", "Integer")
    ]
    rows = [(size * k, [100 * math.sin(1e-3 * k + i) for i in range(len(reals))]) for k in range(STEPS)]
    begin = time.process_time()
    for instant, row in rows:
        reals[:] = row
        set_real(component, *real_input)
        set_boolean(component, *boolean_input)
        set_integer(component, *integer_input)
        do_step(component, instant, size, 0)
        for get, references, count, values in outputs:
            get(component, references, count, values)
    return time.process_time() - begin


def _values(description: Any, causality: str, kind: str) -> tuple[Any, tuple[Any, int, Any]]:
    """Return an array with the start values of some variables, and what a call needs: references, count, values."""
    chosen = [
        variable
        for variable in description.modelVariables
        if variable.causality == causality and variable.type == kind and variable.name != "reload"
    ]
    c_type = ctypes.c_double if kind == "Real" else ctypes.c_int
    references = (ctypes.c_uint * len(chosen))(*(variable.valueReference for variable in chosen))
    values: Any = (c_type * len(chosen))()
    if (causality, kind) == ("input", "Boolean"):
        values[:] = [variable.start == "true" for variable in chosen]
    pointers = ctypes.cast(references, ctypes.POINTER(ctypes.c_uint)), ctypes.cast(values, ctypes.POINTER(c_type))
    return values, (pointers[0], len(chosen), pointers[1])
