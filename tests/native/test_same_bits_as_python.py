"""The translated kernel computes, cycle by cycle, the bits of the kernel in Python."""

from __future__ import annotations

import copy
import ctypes
import random
import shutil
import struct
import subprocess
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import machines

from axcomp.compile import compile_tables
from axcomp.kernel.cycle import cycle
from axcomp.kernel.record import fields_of, zero
from axcomp.kernel.records import AxisInputs, Inputs, Outputs, State, Tables
from axcomp.machine import Machine
from axcomp.native.layout import ctypes_of, from_c, to_c
from axcomp.runtime import initial_inputs

SOURCES = Path(__file__).parents[2] / "fmu_src" / "native"


@pytest.fixture(scope="module")
def native_cycle(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return axcomp_cycle of the committed C."""
    if not shutil.which("gcc"):
        pytest.skip("there is no gcc on this machine")
    library = tmp_path_factory.mktemp("kernel") / "kernel.so"
    warnings = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]
    command = ["gcc", *warnings, "-O2", "-shared", "-fPIC", "-o", str(library), str(SOURCES / "kernel.c"), "-lm"]
    subprocess.run(command, check=True)
    return ctypes.CDLL(str(library)).axcomp_cycle


def bits(value: Any) -> Any:
    """Return numbers as bytes, so that −0 is not 0."""
    if isinstance(value, float):
        return struct.pack("d", value)
    if isinstance(value, list):
        return [bits(element) for element in value]
    return value if isinstance(value, int) else [bits(getattr(value, name)) for name in fields_of(type(value))]


def move(given: AxisInputs, source: random.Random) -> None:
    """Go on by a step, now and then with a command, a fault of the input or a rest."""
    if source.random() < 0.8:
        given.velocity = source.choice([given.velocity, source.uniform(-50.0, 50.0)])
        given.setpoint += given.velocity * 0.05 if abs(given.setpoint) < 1e9 else -given.setpoint
        given.actual_position = given.setpoint + source.uniform(-0.01, 0.01)
        given.acceleration = source.uniform(-2000.0, 2000.0)
    else:
        given.velocity = given.acceleration = 0.0
    for name, hint in fields_of(AxisInputs).items():
        if hint is bool and source.random() < 0.05:
            setattr(given, name, not getattr(given, name))
    if source.random() < 0.01:
        given.acceleration = source.choice([float("nan"), float("inf"), 1e300])


def check(native_cycle: Any, machine: Machine, seed: int, cycles: int) -> None:
    """Run both kernels over the same inputs and compare the outputs of every cycle and the states at the end."""
    tables, state, outputs = compile_tables(machine), zero(State), zero(Outputs)
    inputs = initial_inputs(tables)
    records: list[tuple[Any, Any]] = [(tables, Tables), (state, State), (inputs, Inputs), (outputs, Outputs)]
    structs = [ctypes_of(cls)() for _, cls in records]
    for (record, _), target in zip(records, structs, strict=True):
        to_c(record, target)
    found = copy.deepcopy(outputs)
    source = random.Random(seed)
    for _ in range(cycles):
        inputs.reset, inputs.program_end = source.random() < 0.02, source.random() < 0.02
        for axis in inputs.axis:
            move(axis, source)
        to_c(inputs, structs[2])
        cycle(tables, state, inputs, outputs)
        native_cycle(*map(ctypes.byref, structs))
        from_c(structs[3], found)
        assert bits(found.axis[: tables.axis_count]) == bits(outputs.axis[: tables.axis_count])
    after = copy.deepcopy(state)
    from_c(structs[1], after)
    assert bits(after) == bits(state)


@settings(max_examples=10)
@given(machines(), st.integers(0, 2**32))
def test_any_machine_on_any_path(native_cycle: Any, machine: Machine, seed: int) -> None:
    check(native_cycle, machine, seed, 100)


@pytest.mark.slow
@settings(max_examples=100)
@given(machines(), st.integers(0, 2**32))
def test_many_machines_on_long_paths(native_cycle: Any, machine: Machine, seed: int) -> None:
    check(native_cycle, machine, seed, 500)
