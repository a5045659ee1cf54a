"""The native FMU in a host, FMPy: the bits of the Python engine."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.demo.examples import EXPECTED, INPUT, TRAJECTORIES, read_csv
from axcomp.engine import Engine
from axcomp.fmu import package_native
from axcomp.model import Machine, models

Rows = list[dict[str, Any]]

WARNING = 1


def engine_steps(machine: Machine, rows: Rows) -> Rows:
    engine = Engine(machine)
    return [engine.step(row) for row in rows]


def run_rows(fmu: Path, rows: Rows) -> tuple[Rows, list[tuple[int, str, str]]]:
    with Host(fmu) as host:
        return host.run(rows), host.messages


def test_it_computes_what_the_engine_computes_in_every_bit(native_fmu: Path) -> None:
    rows = trajectory(1000)
    outputs, messages = in_child(run_rows, native_fmu, rows)
    assert outputs == engine_steps(three_axes(), rows)
    assert [text for *_, text in messages] == [
        "axis 2: the adaptation axes of its crosstalk compensation have left the tests"
    ] or not messages


@pytest.mark.parametrize("name", sorted(TRAJECTORIES))
def test_fmpys_own_command_reproduces_the_expected_output(native_fmu: Path, name: str, tmp_path: Path) -> None:
    assert native_fmu
    model, output = models() / name, tmp_path / "output.csv"
    fmu = package_native(model, tmp_path).path
    command = ["simulate", str(fmu), "--input-file", str(model / INPUT), "--output-file", str(output), "--validate"]
    run = subprocess.run(
        [sys.executable, "-m", "fmpy", *command], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    output.write_text(output.read_text().replace("True", "1").replace("False", "0"))
    simulated, expected = read_csv(output), read_csv(model / EXPECTED)
    assert set(simulated) == set(expected)
    for column, values in expected.items():
        assert np.allclose(simulated[column], values, rtol=0.0, atol=1e-8), column


@pytest.mark.parametrize("name", sorted(TRAJECTORIES))
def test_over_a_models_input_it_has_the_bits_of_the_python_engine(native_fmu: Path, name: str, tmp_path: Path) -> None:
    assert native_fmu
    fmu = package_native(models() / name, tmp_path).path
    engine = Engine(models() / name)
    columns = read_csv(models() / name / INPUT)
    del columns["time"]
    types = {variable.name: type(variable.start) for variable in engine.variables}
    rows = [
        {column: types[column](value) for column, value in zip(columns, row, strict=True)}
        for row in zip(*(values.tolist() for values in columns.values()), strict=True)
    ]
    expected = [engine.step(row) for row in rows]
    outputs, messages = in_child(run_rows, fmu, rows)
    assert len(rows) > 1000
    assert outputs == expected
    assert not [message for message in messages if message[0] > WARNING]


def through_states(fmu: Path, rows: Rows, at: list[int]) -> bool:
    """Run past each cycle and go back, with the bytes of a state, here and in another instance."""
    same = True
    with Host(fmu) as host, Host(fmu, folder=host.folder) as other:
        for k, row in enumerate(rows):
            host.step(row)
            if k not in at:
                continue
            time, state = host.time, host.slave.getFMUstate()
            data = host.slave.serializeFMUstate(state)
            first = host.run(rows[k + 1 : k + 21])
            host.slave.setFMUstate(state)
            host.time = time
            same = same and host.run(rows[k + 1 : k + 21]) == first
            copy = other.slave.deSerializeFMUstate(data)
            other.slave.setFMUstate(copy)
            other.time = time
            same = same and other.run(rows[k + 1 : k + 21]) == first
            host.slave.setFMUstate(state)
            host.time = time
            other.slave.freeFMUstate(copy)
            host.slave.freeFMUstate(state)
        return same


def test_a_state_brings_everything_back_at_any_cycle(native_fmu: Path) -> None:
    assert in_child(through_states, native_fmu, trajectory(150), [0, 39, 41, 59, 83, 101])


def in_parts(fmu: Path, rows: Rows, parts: list[list[float]]) -> Rows:
    with Host(fmu, start=5.0) as host:
        outputs = []
        for k, row in enumerate(rows):
            host.set(row)
            for end in (*parts[k % len(parts)], 1.0):
                host.step(duration=5.0 + (k + end) * 0.001 - host.time)
            outputs.append(host.outputs())
        return outputs


def test_smaller_steps_change_nothing_at_the_instants(native_fmu: Path) -> None:
    rows = trajectory(80)
    parts = [[0.5], [], [0.1, 0.2, 0.9], [1e-9, 0.999999]]
    assert in_child(in_parts, native_fmu, rows, parts) == engine_steps(three_axes(), rows)


def with_cycle_time(fmu: Path, rows: Rows, cycle_time: float) -> Rows:
    with Host(fmu, parameters={"cycle_time": cycle_time}) as host:
        return [host.step(row, cycle_time) for row in rows]


def test_the_cycle_time_can_be_set(native_fmu: Path) -> None:
    rows, engine = trajectory(60), Engine(three_axes(), 0.004)
    assert in_child(with_cycle_time, native_fmu, rows, 0.004) == [engine.step(row) for row in rows]


def refusals(fmu: Path) -> list[str]:
    """Set what must not be set; the instance goes on."""
    with Host(fmu) as host:
        for name, value in (("X.corrected_setpoint", 1.0), ("cycle_time", 0.002)):
            with pytest.raises(FMICallException):
                host.set({name: value})
        with pytest.raises(FMICallException):
            host.slave.getReal([63])
        assert host.step({"X.setpoint": 30.0})["X.leadscrew.correction"] == -0.03
        return [text for *_, text in host.messages]


def test_a_call_that_cannot_be_carried_out_is_an_error_with_a_message(native_fmu: Path) -> None:
    texts = in_child(refusals, native_fmu)
    assert [text.startswith("the variable with the value reference") for text in texts] == [True, True, False]
    assert texts[2] == "there is no variable of this type with the value reference 63"
