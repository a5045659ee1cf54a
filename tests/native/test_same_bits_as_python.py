"""The translated kernel computes, cycle by cycle, the bits of the kernel in Python."""

from __future__ import annotations

import copy
import ctypes
import random
import shutil
import struct
import subprocess
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st
from strategies import machines

from axcomp.kernel import AxisInputs, Inputs, Outputs, State, Tables, cycle, fields_of, zero
from axcomp.model import ERRORS, LETTERS, Axis, AxisType, ErrorTable, Interpolation, Machine, Volumetric
from axcomp.native import ctypes_of, from_c, to_c
from axcomp.runtime import compile_tables, initial_inputs

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


def commanded(wanted: int, source: random.Random) -> int:
    """Return a switch that now and then changes, seldom to what commands nothing."""
    return source.choice([-1, 0, 1, 1, 0, 7]) if source.random() < 0.05 else wanted


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
        if name in ("unreferenced", "fault"):
            setattr(given, name, source.random() < 0.003)
        elif hint is bool and source.random() < 0.05:
            setattr(given, name, not getattr(given, name))
    given.wanted[:] = [commanded(wanted, source) for wanted in given.wanted]
    if source.random() < 0.05:
        temperature, friction = given.compensation.temperature, given.compensation.friction
        temperature.offset = source.choice([source.uniform(-0.1, 0.1), float("nan"), float("inf")])
        temperature.coefficient = source.uniform(-1e-3, 1e-3)
        friction.ahead_known = source.random() < 0.5
        friction.velocity_ahead[:] = source.choices([given.velocity, -given.velocity, 0.0, float("nan")], k=4)
    if source.random() < 0.002:
        given.acceleration = source.choice([float("nan"), float("inf"), 1e300])


def check(native_cycle: Any, machine: Machine, seed: int, cycles: int) -> list[float]:
    """Run both kernels over the same inputs; compare the outputs of every cycle and the states at the end.

    Returns all the corrections.
    """
    tables, pool = compile_tables(machine)
    numbers = (ctypes.c_double * (len(pool) + 1))(*pool)
    state, outputs = zero(State), zero(Outputs)
    inputs = initial_inputs(tables)
    for record in (state, outputs):
        del record.axis[tables.axis_count :], record.volumetric[tables.volumetrics :]
    records: list[tuple[Any, Any]] = [(tables, Tables), (state, State), (inputs, Inputs), (outputs, Outputs)]
    structs = [ctypes_of(cls)() for _, cls in records]
    for (record, _), target in zip(records, structs, strict=True):
        to_c(record, target)
    found = copy.deepcopy(outputs)
    corrections = []
    source = random.Random(seed)
    for _ in range(cycles):
        inputs.reset, inputs.program_end = source.random() < 0.02, source.random() < 0.02
        inputs.derive_motion = inputs.derive_motion != (source.random() < 0.02)
        inputs.tool_length = source.choice([inputs.tool_length, 80.0])
        for axis in inputs.axis:
            move(axis, source)
        for command in inputs.volumetric:
            command.wanted = commanded(command.wanted, source)
            command.no_move = source.random() < 0.2
            command.reduction_x, command.reduction_y, command.reduction_z = source.choices([0.0, 0.3, 1.0], k=3)
        to_c(inputs, structs[2])
        cycle(tables, pool, state, inputs, outputs)
        native_cycle(ctypes.byref(structs[0]), numbers, *map(ctypes.byref, structs[1:]))
        from_c(structs[3], found)
        assert bits(found) == bits(outputs)
        corrections += [axis.correction for axis in outputs.axis]
    after = copy.deepcopy(state)
    from_c(structs[1], after)
    assert bits(after) == bits(state)
    return corrections


def random_volumetric(index: int, source: random.Random) -> Volumetric:
    """Return a compensation of six axes with errors in every interpolation."""

    def table(name: str) -> ErrorTable:
        mode = source.choice([None, *Interpolation])
        if mode is None:
            return ErrorTable(name, (source.uniform(-1e-3, 1e-3),))
        letters = "XY" if mode is Interpolation.PATH_XY else "XYZ" if mode is Interpolation.PATH else ""
        letters = letters or "".join(sorted(source.sample(LETTERS, source.randint(1, 3)), key=LETTERS.index))
        lines = [sorted(source.sample(range(-90, 400), source.randint(2, 4))) for _ in letters]
        nodes = tuple(tuple(map(float, node)) for node in product(*lines))
        return ErrorTable(name, tuple(source.uniform(-1e-3, 1e-3) for _ in nodes), letters, nodes, mode)

    return Volumetric(
        index,
        tuple((letter, number) for number, letter in enumerate(LETTERS, 1)),
        "".join(source.sample("AB", 2)) + "".join(source.sample("XYZ", 3)) + "C",
        source.randint(0, 6),
        tuple(table(name) for name in ERRORS if source.random() < 0.4),
        tool_position=(1.0, -2.0, 100.0),
        tool_orientation=(0.0, 0.6, 0.8),
        centers=((10.0, 20.0, -30.0), (-40.0, 5.0, 60.0), (70.0, -80.0, 9.0)),
        offsets=(1.0, 0.0, -3.0, 0.1, 0.0, -0.2),
        alternative_model=source.random() < 0.5,
        negate=source.choice(["", "X"]),
        filter_steps=source.choice([0, 7, 20]),
        manual_activation=source.random() < 0.5,
        max_records=100_000,
    )


@pytest.mark.parametrize("seed", range(4))
def test_volumetric_compensations_of_six_axes(native_cycle: Any, seed: int) -> None:
    source = random.Random(seed)
    types = {letter: AxisType.TRANSLATORY if letter in "XYZ" else AxisType.ROTARY for letter in LETTERS}
    axes = [Axis(n, letter, types[letter], volumetric_limit=5.0) for n, letter in enumerate(LETTERS, 1)]
    follower = Axis(7, "X2", volumetric_limit=4.0, gantry_master=1)
    machine = Machine((*axes, follower), tuple(random_volumetric(index, source) for index in range(2)))
    corrections = check(native_cycle, machine, seed, 200)
    assert len(set(corrections)) > 50


@settings(max_examples=10)
@given(machines(), st.integers(0, 2**32))
def test_any_machine_on_any_path(native_cycle: Any, machine: Machine, seed: int) -> None:
    check(native_cycle, machine, seed, 100)


@pytest.mark.slow
@settings(max_examples=100)
@given(machines(), st.integers(0, 2**32))
def test_many_machines_on_long_paths(native_cycle: Any, machine: Machine, seed: int) -> None:
    check(native_cycle, machine, seed, 500)
