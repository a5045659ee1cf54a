"""What the engine costs: a cycle, a trajectory, memory."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine import Engine
from ..model import Machine
from ..native import SWITCH, compiled_kernel
from ..runtime import Runtime
from .clock import Sample, ratio, sample
from .machines import machine_of

CYCLES = 2000
_MOVED = frozenset({"setpoint", "velocity", "acceleration"})
AXES = (3, 8, 16, 32)
POINTS = (10, 100, 1000, 10_000)


def bench_engine(
    machine: Machine, name: str, repeats: int, goal: float, compiled_goal: float | None = None
) -> Iterator[Sample]:
    """Measure one machine: a cycle in Python with its inputs set, and a cycle of a whole trajectory."""
    yield sample(f"cycle of {name}, inputs set", "µs", _Motion(machine), repeats=repeats, each=CYCLES, goal=goal)
    if compiled_kernel() is not None:
        yield _trajectory(machine, f"cycle of {name} in Engine.run, compiled", 200_000, repeats, compiled_goal)
    with _python_kernel():
        yield _trajectory(machine, f"cycle of {name} in Engine.run, Python", 5_000, repeats)


def bench_calls(machine: Machine, name: str, repeats: int) -> Iterator[Sample]:
    """Measure what the calls of ``Engine`` cost besides the cycles: one step, one row, many rows with commands."""
    if compiled_kernel() is None:
        return
    engine = Engine(machine)
    rows = 100_000
    columns = _columns(engine, rows)
    one_row = {key: column[:1] for key, column in columns.items()}
    values = {key: float(column[0]) for key, column in columns.items()}
    yield sample(f"Engine.step of {name}", "µs", lambda: _often(engine.step, values), each=1000, goal=8.0)
    yield sample(f"Engine.run of one row of {name}", "µs", lambda: _often(engine.run, one_row), each=1000, goal=20.0)
    axis = machine.axes[0]
    blocks = [f"{axis.name}[COMP {'OFF_ALL' if k % 20 else 'ON'}]" if k % 10 == 0 else "" for k in range(rows)]
    without = sample("", "µs", lambda: engine.run(columns), repeats=repeats, each=rows)
    commanded = sample("", "µs", lambda: engine.run({**columns, "command": blocks}), repeats=repeats, each=rows)
    yield ratio(f"Engine.run of {name}, a command every tenth row / none", commanded, (without,), 2.0)


def _often(call: Callable[[Any], object], given: object) -> None:
    for _ in range(1000):
        call(given)


def _columns(engine: Engine, rows: int) -> dict[str, NDArray[np.float64]]:
    """Return a trajectory in which every axis moves."""
    names = [v.name for v in engine.variables if v.causality == "input" and v.field in _MOVED]
    return {name: 200.0 * np.sin(1e-3 * np.arange(rows) + k) for k, name in enumerate(names)}


def bench_growth(repeats: int) -> Iterator[Sample]:
    """Measure how a cycle grows with the axes and with the points; every axis has all five kinds."""
    for axes in AXES:
        yield from _grown(machine_of(axes, 100), f"{axes} axes, 100 points", repeats)
    for points in POINTS:
        yield from _grown(machine_of(3, points), f"3 axes, {points} points", repeats)


def _grown(machine: Machine, name: str, repeats: int) -> Iterator[Sample]:
    yield sample(f"cycle, {name}", "µs", _Motion(machine), repeats=repeats, each=CYCLES)
    if compiled_kernel() is not None:
        yield _trajectory(machine, f"cycle, {name}, compiled", 20_000, repeats)


def _trajectory(machine: Machine, name: str, rows: int, repeats: int, goal: float | None = None) -> Sample:
    """Measure ``Engine.run`` over a trajectory in which every axis moves."""
    engine = Engine(machine)
    trajectory = _columns(engine, rows)
    return sample(name, "µs", lambda: engine.run(trajectory), repeats=repeats, each=rows, goal=goal)


@contextmanager
def _python_kernel() -> Iterator[None]:
    """Let no engine use a compiled kernel."""
    before = os.environ.get(SWITCH)
    os.environ[SWITCH] = "python"
    compiled_kernel.cache_clear()
    try:
        yield
    finally:
        os.environ.pop(SWITCH)
        if before is not None:
            os.environ[SWITCH] = before
        compiled_kernel.cache_clear()


def bench_memory(machine: Machine, cycles: int) -> Iterator[Sample]:
    """Measure by how much the process has grown at most after many cycles."""
    try:
        import resource  # not on Windows, where this one figure is left out
    except ImportError:
        return
    work = _Motion(machine)
    work()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(cycles // CYCLES):
        work()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    yield Sample(f"growth of memory over {cycles} cycles", "MB", (grown / 1024,), 1.0)


class _Motion:
    """Runs ``CYCLES`` cycles in which every axis moves; the inputs were computed before."""

    def __init__(self, machine: Machine) -> None:
        self.runtime = Runtime(machine)
        count = len(machine.axes)
        self.rows = [
            [
                (200 * math.sin(1e-3 * k + i), 200 * math.cos(1e-3 * k + i), -200 * math.sin(1e-3 * k + i))
                for i in range(count)
            ]
            for k in range(CYCLES)
        ]

    def __call__(self) -> None:
        axes, run = self.runtime.inputs.axis, self.runtime.cycle
        for row in self.rows:
            for axis, given in zip(axes, row, strict=True):
                axis.setpoint, axis.velocity, axis.acceleration = given
            run()
