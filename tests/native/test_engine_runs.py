"""Engine.run in the compiled kernel and in Python: the same bits over long trajectories of any machine."""

import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from numpy.random import Generator, default_rng
from numpy.typing import NDArray
from strategies import machines

from axcomp import Engine, Machine
from axcomp.lists import read_machine
from axcomp.model import models
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
        elif isinstance(variable.start, int):
            drawn = source.choice([-1, 0, 1, 2], cycles // 50 + 1, p=[0.4, 0.2, 0.39, 0.01])
            columns[variable.name] = np.repeat(drawn, 50)[:cycles]
        elif variable.field == "setpoint":
            speed = np.repeat(source.normal(0, 0.05, cycles // 50 + 1), 50)[:cycles]
            speed[np.repeat(source.random(cycles // 50 + 1) < 0.3, 50)[:cycles]] = 0.0
            columns[variable.name] = speed.cumsum() + source.normal(0, 50)
        else:
            columns[variable.name] = source.normal(0, 100, cycles) * (source.random(cycles) < 0.9)
    spoiled = source.choice([name for name, column in columns.items() if column.dtype == np.float64])
    columns[spoiled][source.integers(cycles)] = source.choice([np.nan, np.inf, -np.inf])
    return columns


def plain_engine(machine: Machine) -> Engine:
    """Return an engine that runs in Python."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("axcomp.engine.engine.compiled_kernel", lambda: None)
        return Engine(machine)


def same_bits(machine: Machine, seed: int, cycles: int) -> None:
    compiled, plain = Engine(machine), plain_engine(machine)
    columns = trajectory(compiled, default_rng(seed), cycles)
    first, second = compiled.run(columns), plain.run(columns)
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


@settings(max_examples=15, suppress_health_check=[HealthCheck.too_slow])
@given(machines(), st.integers(0, 2**32))
def test_commands_steps_snapshots_and_updates_are_the_same_in_both(machine: Machine, seed: int) -> None:
    engines = Engine(machine), plain_engine(machine)
    source = default_rng(seed)
    columns = trajectory(engines[0], source, 200)
    # What commands switch is held until the next one.
    columns = {name: column for name, column in columns.items() if not name.endswith((".switch", ".no_move"))}
    named = [axis.name for axis in machine.axes if re.fullmatch("[A-Za-z]+", axis.name)]
    switches = [f"{name}[COMP {way}]" for name in named for way in ("OFF_ALL", "ON", "OFF_ALL NO_MOVE")]
    ids = [volumetric.index for volumetric in machine.volumetric]
    blocks = [*switches, " ".join(switches[::3]), "#VOLCOMP OFF ALL", *(f"#VOLCOMP ON [ID={i} NO_MOVE]" for i in ids)]
    commands = np.where(source.random(200) < 0.3, source.choice(blocks if ids else [*switches, " "], 200), "")
    results = [engine.run({**columns, "command": commands}) for engine in engines]
    assert results[0].notices == results[1].notices
    for name, values in results[0].items():
        assert values.tobytes() == results[1][name].tobytes(), name
        assert values.dtype == results[1][name].dtype
    saved = [engine.runtime.save() for engine in engines]
    assert saved[0] == saved[1]
    names = list(columns)
    for row in range(20):
        given = {name: columns[name][row].item() for name in names[row % 3 :]}
        command = str(commands[row])
        steps = [engine.step(given, command) for engine in engines]
        assert repr(steps[0]) == repr(steps[1])
        assert repr(engines[0].get()) == repr(steps[0])
    engines[0].runtime.restore(saved[1])
    engines[1].runtime.restore(saved[0])
    assert repr(engines[0].step()) == repr(engines[1].step())
    assert [engine.runtime.update(machine) for engine in engines] == [{}, {}]
    assert repr(engines[0].step(given)) == repr(engines[1].step(given))
    assert engines[0].runtime.save() == engines[1].runtime.save()


def test_columns_of_any_kind_are_taken_as_they_are_given() -> None:
    engines = Engine(models() / "three_axis"), plain_engine(read_machine(models() / "three_axis").machine)
    wide = np.random.default_rng(3).normal(0.0, 50.0, (40, 7))
    columns = {
        "X.setpoint": wide[:, 3],  # every seventh number
        "Y.setpoint": wide[::-1, 1],
        "Z.setpoint": list(range(40)),
        "X.unreferenced": (np.arange(40) < 3).astype(int),
        "Y.unreferenced": [0.0, 1.0] * 20,
        "X.plane.switch": np.tile([0.0, 0.6, 1.0, -0.6, -1.0], 8),
        "X.leadscrew.switch": [1, -1] * 20,
        "Z.cross.switch": [*[-1.0] * 30, np.nan, np.inf, -np.inf, 7.0, 2.0**31, -(2.0**40), 1e300, 1.0, 0.0, -1.0],
        "Y.leadscrew.switch": [*[1] * 36, 2**32 + 1, 2**31, -(2**31), -1],
        "reset": np.arange(40) == 7,
    }
    first, second = (engine.run(columns) for engine in engines)
    for name, values in first.items():
        assert values.tobytes() == second[name].tobytes(), name
    for row in range(40):
        values = {name: column[row] for name, column in columns.items()}
        assert repr(engines[0].step(values)) == repr(engines[1].step(values))
    assert engines[0].runtime.save() == engines[1].runtime.save()
    assert engines[0].run({"X.setpoint": []}).cycles == 0
