"""Random whole machines in random motion against a reference that was written from the manuals' words alone."""

from __future__ import annotations

import numpy as np
import pytest
import random_machines
from axis_reference import Reference, Result, Row

from axcomp.kinds import KIND_NAMES
from axcomp.runtime import Runtime

TOLERANCE = 1e-12
"""mm, °, and the drive's unit of current."""


def give(runtime: Runtime, rows: list[Row]) -> None:
    """Set the inputs of a cycle."""
    for axis, row in zip(runtime.inputs.axis, rows, strict=True):
        for name in ("setpoint", "velocity", "acceleration", "actual_position"):
            setattr(axis, name, getattr(row, name))
        for name in ("unreferenced", "fault", "no_move", "released"):
            setattr(axis, name, getattr(row, name))
        for number, kind in enumerate(KIND_NAMES):
            axis.wanted[number] = row.switch[kind]
        axis.compensation.temperature.offset = row.offset
        axis.compensation.temperature.coefficient = row.coefficient
        axis.compensation.friction.ahead_known = row.ahead_known
        axis.compensation.friction.velocity_ahead[:] = row.velocity_ahead


def differences(runtime: Runtime, results: list[Result]) -> list[str]:
    """Return what the product puts out otherwise."""
    found = []
    for axis, out, result in zip(runtime.machine.axes, runtime.outputs.axis, results, strict=True):
        for name in ("corrected_setpoint", "display_position", "correction", "setpoint_shift"):
            if not abs(getattr(out, name) - getattr(result, name)) <= TOLERANCE:
                found.append(f"{axis.name}.{name}: {getattr(out, name)!r}, not {getattr(result, name)!r}")
        for number, kind in enumerate(KIND_NAMES):
            wanted = result.contributions.get(kind, 0.0)
            if not abs(out.contribution[number] - wanted) <= TOLERANCE:
                found.append(f"{axis.name}.{kind}: {out.contribution[number]!r}, not {wanted!r}")
            if out.active[number] != result.active.get(kind, False):
                found.append(f"{axis.name}.{kind}.active: {out.active[number]}")
        if out.error != result.error:
            found.append(f"{axis.name}.error: {out.error}, not {result.error}")
    return found


def compare(seed: int, cycles: int, *, updates: float = 0.0) -> None:
    """Run a machine both ways; the first cycle that differs fails the test. ``updates``: how many a cycle."""
    rng = np.random.default_rng(seed)
    machine = random_machines.machine(rng)
    derive = bool(rng.random() < 0.2)
    runtime = Runtime(machine, random_machines.CYCLE_TIME)
    runtime.inputs.derive_motion = derive
    reference = Reference(machine, random_machines.CYCLE_TIME, derive)
    courses = [random_machines.rows(rng, cycles, axis) for axis in machine.axes]
    reset, program_end = (random_machines.held(rng, cycles, 0.05, long=10.0).tolist() for _ in range(2))
    for k in range(cycles):
        if k > 0 and rng.random() < updates:
            new = random_machines.updated(rng, machine) if rng.random() < 0.8 else machine
            runtime.update(new)
            reference.update(new)
        rows = [course[k] for course in courses]
        runtime.inputs.reset, runtime.inputs.program_end = reset[k], program_end[k]
        give(runtime, rows)
        runtime.cycle()
        found = differences(runtime, reference.cycle(rows, reset[k], program_end[k]))
        assert not found, f"seed {seed}, cycle {k}, {machine}: {found}"


@pytest.mark.parametrize("seed", range(20))
def test_a_random_machine_is_as_the_manuals_say(seed: int) -> None:
    compare(seed, 250)


@pytest.mark.parametrize("seed", range(100, 120))
def test_a_random_machine_takes_other_lists_as_the_manuals_say(seed: int) -> None:
    compare(seed, 250, updates=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1000, 1100))
def test_random_machines_over_1e5_cycles_are_as_the_manuals_say(seed: int) -> None:
    compare(seed, 1000)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2000, 2050))
def test_random_machines_take_other_lists_over_5e4_cycles_as_the_manuals_say(seed: int) -> None:
    compare(seed, 1000, updates=0.01)
