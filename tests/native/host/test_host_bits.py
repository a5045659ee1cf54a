"""The native FMU computes the bits of the Python engine, whatever compiler, processor and system it was built for."""

from __future__ import annotations

import csv
import random
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from host_program import OK, Program, bits, text
from host_trajectory import Columns, expected_results, motion, write_trajectory
from hypothesis import HealthCheck, given, settings, strategies as st
from strategies import machines

from axcomp import Machine
from axcomp.bench import machine_of
from axcomp.interface import BLOCK, variables_of
from axcomp.lists import read_machine
from axcomp.native import image_of
from axcomp.runtime import compile_tables

GUID = "{bits}"
MODELS = Path(__file__).parents[3] / "models"
NAMES = sorted(folder.name for folder in MODELS.iterdir() if (folder / "input.csv").exists())
ELSEWHERE = ["gcc-avx2", "linux64", "linux32", "win64", "win32", "aarch64", "arm32", "i386"]


def model_input(machine: Machine, name: str) -> Columns:
    """Return the columns of a model's input file."""
    with (MODELS / name / "input.csv").open(newline="") as file:
        header, *rows = list(csv.reader(file))
    types = {variable.name: type(variable.start) for variable in variables_of(machine)}
    values = np.array(rows, dtype=np.float64)
    chosen = [place for place, column in enumerate(header) if column in types]
    return {header[place]: values[:, place].astype(types[header[place]]) for place in chosen}


def check(program: Program, machine: Machine, columns: Columns, folder: Path) -> None:
    (folder / "tables.bin").write_bytes(image_of(compile_tables(machine), GUID))
    write_trajectory(folder / "input.bin", machine, columns)
    script = [f"instantiate 0 name 1 {GUID} {text(folder)} 1 1", "replay 0 input.bin output.bin"]
    answers = program.run(script, folder)
    assert [answer.status for answer in answers] == [1, OK]
    assert (folder / "output.bin").read_bytes() == expected_results(machine, columns)


@pytest.mark.parametrize("name", NAMES)
def test_a_models_input(host: Callable[[str], Program], name: str, tmp_path: Path) -> None:
    machine = read_machine(MODELS / name).machine
    check(host("gcc"), machine, model_input(machine, name), tmp_path)


@pytest.mark.parametrize("name", NAMES)
def test_a_model_on_a_random_path(host: Callable[[str], Program], name: str, tmp_path: Path) -> None:
    machine = read_machine(MODELS / name).machine
    check(host("gcc"), machine, motion(machine, np.random.default_rng(5), 2000), tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("way", ELSEWHERE)
def test_the_models_elsewhere(host: Callable[[str], Program], way: str, name: str, tmp_path: Path) -> None:
    program, machine = host(way), read_machine(MODELS / name).machine
    check(program, machine, model_input(machine, name), tmp_path)
    check(program, machine, motion(machine, np.random.default_rng(6), 20_000), tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("way", ["gcc", *ELSEWHERE])
@settings(max_examples=12, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(machine=machines(), seed=st.integers(0, 2**32))
def test_any_machine_elsewhere(
    host: Callable[[str], Program], way: str, machine: Machine, seed: int, tmp_path: Path
) -> None:
    check(host(way), machine, motion(machine, np.random.default_rng(seed), 3000), tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("way", ["linux64", "win64", "aarch64"])
def test_a_state_saved_here_goes_on_there(host: Callable[[str], Program], way: str, tmp_path: Path) -> None:
    machine = machine_of(3, 50)
    (tmp_path / "tables.bin").write_bytes(image_of(compile_tables(machine), GUID))
    source = random.Random(3)
    outputs = " ".join(str(BLOCK * (1 + axis) + k) for axis in range(3) for k in (8, 9, 10, 11, 13))

    def steps(first: int) -> list[str]:
        lines = []
        for k in range(first, first + 30):
            given = " ".join(f"{BLOCK * (1 + axis)} {bits(source.uniform(-9, 9))}" for axis in range(3))
            lines += [f"set 0 r {given}", f"step 0 {bits(0.001 * k)} {bits(0.001)}"]
        return [*lines, f"get 0 r {outputs}"]

    begin, there = steps(0), steps(30)
    made = [f"instantiate 0 name 1 {GUID} . 1 0", "enter 0", "exit 0"]
    kept = ["save 0 5", "serialize 0 5 0", "keep 5 state.bin", "release 0 5"]
    here = host("gcc").run([*made, *begin, *kept, *there], tmp_path)
    found = host(way).run(
        [*made, "fetch 5 state.bin", "deserialize 0 5 0 -1", "restore 0 5", "release 0 5", *there], tmp_path
    )
    assert [answer.status for answer in found[3:6]] == [OK] * 3
    assert found[-1].values == here[-1].values
