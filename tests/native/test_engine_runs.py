"""Engine.run in the compiled kernel and in Python: the same bits over long trajectories of any machine."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from numpy.random import Generator, default_rng
from numpy.typing import NDArray
from strategies import machines

from axcomp import Engine, Machine
from axcomp.native import compiled_kernel

CYCLES = 5000


@pytest.fixture(scope="module", autouse=True)
def needs_a_compiler() -> None:
    if compiled_kernel() is None:
        pytest.skip("there is no C compiler on this machine")


def trajectory(engine: Engine, source: Generator, cycles: int) -> dict[str, NDArray[np.float64]]:
    """Motions that stop and turn, commands now and then, and a few inputs that are not finite."""
    columns = {}
    for variable in engine.variables:
        if variable.causality != "input":
            continue
        if isinstance(variable.start, bool):
            columns[variable.name] = (source.random(cycles) < 0.002).cumsum() % 2 == int(not variable.start)
        elif variable.field == "setpoint":
            speed = np.repeat(source.normal(0, 0.05, cycles // 50 + 1), 50)[:cycles]
            speed[np.repeat(source.random(cycles // 50 + 1) < 0.3, 50)[:cycles]] = 0.0
            columns[variable.name] = speed.cumsum() + source.normal(0, 50)
        else:
            columns[variable.name] = source.normal(0, 100, cycles) * (source.random(cycles) < 0.9)
    spoiled = source.choice([name for name, column in columns.items() if column.dtype == np.float64])
    columns[spoiled][source.integers(cycles)] = source.choice([np.nan, np.inf, -np.inf])
    return columns


def same_bits(machine: Machine, seed: int, cycles: int) -> None:
    compiled, plain = Engine(machine), Engine(machine)
    columns = trajectory(compiled, default_rng(seed), cycles)
    first = compiled.run(columns)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("axcomp.engine.engine.compiled_kernel", lambda: None)
        second = plain.run(columns)
    for name, values in first.items():
        assert values.tobytes() == second[name].tobytes(), name
    assert compiled.runtime.save() == plain.runtime.save()


@settings(max_examples=10, suppress_health_check=[HealthCheck.too_slow])
@given(machines(), st.integers(0, 2**32))
def test_any_machine_on_a_short_path(machine: Machine, seed: int) -> None:
    same_bits(machine, seed, 300)


@pytest.mark.slow
@settings(max_examples=220, suppress_health_check=[HealthCheck.too_slow])
@given(machines(), st.integers(0, 2**32))
def test_any_machine_over_a_million_cycles_in_all(machine: Machine, seed: int) -> None:
    same_bits(machine, seed, CYCLES)
