"""Drive a machine cycle by cycle and look at the whole run: what the kernel's tests share.

``walk`` and ``forward`` are second formulations: they know the whole trajectory, the kernel only the last cycle.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from axcomp.interface import slot_in
from axcomp.kinds import KIND_NAMES
from axcomp.model import Machine
from axcomp.runtime import Runtime

OUTPUTS = {
    **{
        name: name
        for name in (
            "corrected_setpoint",
            "display_position",
            "correction",
            "setpoint_shift",
            "stop_request",
            "error",
            "volumetric_correction",
        )
    },
    **{f"{kind}_correction": f"contribution[{i}]" for i, kind in enumerate(KIND_NAMES)},
    **{f"{kind}_active": f"active[{i}]" for i, kind in enumerate(KIND_NAMES)},
    "current": f"contribution[{KIND_NAMES.index('friction')}]",
}
"""Names of outputs in tests → their place in the record of an axis."""

INPUTS = {f"{kind}_on": f"wanted[{i}]" for i, kind in enumerate(KIND_NAMES)} | {"referenced": "unreferenced"}
INPUTS |= {f"temperature_{name}": f"compensation.temperature.{name}" for name in ("offset", "coefficient")}


def drive(machine: Machine | Runtime, columns: Mapping[str, ArrayLike]) -> dict[str, NDArray[Any]]:
    """Run one cycle for each row; ``"X.setpoint"``: an input of axis X, ``"reset"``: one of the engine.

    Returns the outputs by name, shape (n,); scalars among the columns are held.
    """
    runtime = machine if isinstance(machine, Runtime) else Runtime(machine)
    names = [axis.name for axis in runtime.machine.axes]
    rows = {name: column.tolist() for name, column in zip(columns, np.broadcast_arrays(*columns.values()), strict=True)}
    setters = []
    for column in columns:
        name, _, field = column.rpartition(".")
        record = runtime.inputs.axis[names.index(name)] if name else runtime.inputs
        slot = slot_in(record, INPUTS.get(field, field))
        assert slot is not None, column
        setters.append(slot)
    outputs: dict[str, list[Any]] = {f"{name}.{field}": [] for name in names for field in OUTPUTS}
    for row in zip(*rows.values(), strict=True):
        for column, slot, value in zip(columns, setters, row, strict=True):
            if column.endswith("_on"):
                slot.set(1 if value else -1)
            else:
                slot.set(not value if column.endswith(".referenced") else value)
        runtime.cycle()
        for name, axis in zip(names, runtime.outputs.axis, strict=True):
            for field, path in OUTPUTS.items():
                slot = slot_in(axis, path)
                assert slot is not None
                outputs[f"{name}.{field}"].append(slot.get())
    return {name: np.array(values) for name, values in outputs.items()}


def walk(up: ArrayLike, length: int, start: int) -> NDArray[Any]:
    """Return a walk 0 … length that goes one up where ``up`` holds and one down where not, and stops at its ends.

    Computed stretch by stretch of equal direction: within one, the walk is a straight line that is cut off.
    """
    up = np.asarray(up, bool)
    steps = np.empty(len(up), int)
    at = start
    borders = [0, *(np.flatnonzero(np.diff(up)) + 1), len(up)]
    for first, last in pairwise(borders):
        if last > first:
            steps[first:last] = np.clip(at + (1 if up[first] else -1) * np.arange(1, last - first + 1), 0, length)
            at = steps[last - 1]
    return steps


def soft(steps: ArrayLike, cycles: int) -> NDArray[Any]:
    """Return sin²(π/2 · k/n)."""
    return np.sin(np.pi / 2 * np.asarray(steps) / cycles) ** 2


def forward(signs: ArrayLike, first: int) -> NDArray[Any]:
    """Return the last sign that was not 0, ``first`` before there was one."""
    signs = np.asarray(signs, int)
    last = np.maximum.accumulate(np.where(signs != 0, np.arange(len(signs)), -1))
    return np.where(last >= 0, signs[last], first)


def to_and_fro(cycles: int, rng: np.random.Generator, low: float, high: float, stand: float = 0.2) -> NDArray[Any]:
    """Return positions of an axis that goes to random places, each way over some cycles, and stands in between."""
    parts = [np.array([rng.uniform(low, high)])]
    while sum(len(part) for part in parts) < cycles:
        at = parts[-1][-1]
        n = int(rng.integers(1, 30))
        parts.append(np.full(n, at) if rng.random() < stand else np.linspace(at, rng.uniform(low, high), n + 1)[1:])
    return np.concatenate(parts)[:cycles]
