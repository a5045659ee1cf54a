"""What an FMU costs in a host: set, step and get through FMPy with arrays made before."""

from __future__ import annotations

import ctypes
import math
import multiprocessing
import os
import shutil
import time
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Slave

from .clock import Sample

STEPS = 2000


def bench_fmu(path: str | os.PathLike[str], name: str, repeats: int, goal: float | None = None) -> list[Sample]:
    """Measure an FMU in a child process: the steps, and loading it up to the end of initialization."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        steps, starts = pool.submit(_measure, os.fspath(path), repeats).result()
    return [
        Sample(f"set + step + get of {name}", "µs", tuple(1e6 * s / STEPS for s in steps), goal),
        Sample(f"load, instantiate and initialize {name}", "ms", tuple(1e3 * s for s in starts)),
    ]


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
    """Run ``STEPS`` steps; every real and Boolean input is set and every output is read in each."""
    groups = {}
    for causality in ("input", "output"):
        for kind, c_type in (("Real", ctypes.c_double), ("Boolean", ctypes.c_int), ("Integer", ctypes.c_int)):
            chosen = [
                variable
                for variable in description.modelVariables
                if variable.causality == causality and variable.type == kind and variable.name != "reload"
            ]
            references = (ctypes.c_uint * len(chosen))(*(variable.valueReference for variable in chosen))
            values = (c_type * len(chosen))()
            for place, variable in enumerate(chosen):
                values[place] = variable.start == "true" if kind == "Boolean" else float(variable.start or 0)
            groups[causality, kind] = references, values
    set_reals, reals = groups["input", "Real"]
    set_booleans, booleans = groups["input", "Boolean"]
    outputs = [(getattr(slave, f"fmi2Get{kind}"), *groups["output", kind]) for kind in ("Real", "Boolean", "Integer")]
    component, count, size = slave.component, len(reals), description.defaultExperiment.stepSize
    rows = [[100 * math.sin(1e-3 * k + i) for i in range(count)] for k in range(STEPS)]
    begin = time.process_time()
    for k, row in enumerate(rows):
        reals[:] = row
        slave.fmi2SetReal(component, set_reals, count, reals)
        slave.fmi2SetBoolean(component, set_booleans, len(booleans), booleans)
        slave.fmi2DoStep(component, float(k) * float(size), float(size), 0)
        for get, references, values in outputs:
            get(component, references, len(values), values)
    return time.process_time() - begin
