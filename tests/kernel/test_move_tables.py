"""An axis that keeps its old tables in an update takes them along into the new pool: the same bits as before."""

import copy

import numpy as np
import pytest
from driving import to_and_fro
from hypothesis import given, settings, strategies as st
from strategies import machines

from axcomp.kernel import Outputs, State, Tables, cycle, move_axis_table, tables_fit, zero
from axcomp.lists import read_machine
from axcomp.model import Machine, models
from axcomp.runtime import compile_tables, initial_inputs

FILLER = 7.7e14  # what no axis needs


def moved(tables: Tables, pool: list[float], before: int) -> tuple[Tables, list[float]]:
    """Return the tables with the numbers of every axis elsewhere: the axes backwards, with numbers between them."""
    other, numbers = copy.deepcopy(tables), [FILLER] * before
    for axis in reversed(other.axis[: other.axis_count]):
        at = len(numbers)
        numbers += pool[axis.first : axis.first + axis.numbers] + [FILLER] * 3
        move_axis_table(axis, at)
        assert axis.first == at
    return other, numbers


def outputs_of(tables: Tables, pool: list[float], cycles: int, seed: int) -> list[str]:
    """What comes out of a motion to and fro of all axes, as text that tells every bit."""
    rng = np.random.default_rng(seed)
    inputs, state, outputs = initial_inputs(tables), zero(State), zero(Outputs)
    del outputs.axis[tables.axis_count :]
    positions = np.array([to_and_fro(cycles, rng, -400.0, 400.0) for _ in inputs.axis])
    accelerations = rng.uniform(-3000.0, 3000.0, positions.shape)
    texts = []
    for k in range(cycles):
        for axis, s, v, a in zip(
            inputs.axis,
            positions[:, k].tolist(),
            np.gradient(positions, axis=1)[:, k].tolist(),
            accelerations[:, k].tolist(),
            strict=True,
        ):
            axis.setpoint, axis.velocity, axis.acceleration = s, 1e3 * v, a
        cycle(tables, pool, state, inputs, outputs)
        texts.append(repr(outputs.axis))
    return texts


@pytest.mark.parametrize("before", [0, 1, 1000])
@pytest.mark.parametrize("model", ["three_axis", "rotary_table"])
def test_the_models_give_the_same_bits(model: str, before: int) -> None:
    tables, pool = compile_tables(read_machine(models() / model).machine)
    other, numbers = moved(tables, pool, before)
    assert tables_fit(other, numbers, len(numbers))
    found = outputs_of(other, numbers, 150, 1)
    assert found == outputs_of(tables, pool, 150, 1)
    assert len(set(found)) > 100
    assert "e+14" not in "".join(found)


@settings(max_examples=30)
@given(machines(), st.integers(0, 50), st.integers(0, 2**32 - 1))
def test_any_machine_gives_the_same_bits(machine: Machine, before: int, seed: int) -> None:
    tables, pool = compile_tables(machine)
    other, numbers = moved(tables, pool, before)
    assert tables_fit(other, numbers, len(numbers))
    assert outputs_of(other, numbers, 40, seed) == outputs_of(tables, pool, 40, seed)


@settings(max_examples=20)
@given(machines(), st.integers(0, 10**6))
def test_there_and_back_is_where_it_was(machine: Machine, first: int) -> None:
    tables, _ = compile_tables(machine)
    other = copy.deepcopy(tables)
    for axis, old in zip(other.axis, tables.axis, strict=True):
        move_axis_table(axis, first)
        move_axis_table(axis, old.first)
    assert other == tables
