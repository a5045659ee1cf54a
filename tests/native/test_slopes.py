"""Inputs that go on along their derivatives inside a step: long steps give what short ones give."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmu_host import Host, in_child
from numpy.typing import NDArray

from axcomp.demo.examples import INPUT, read_csv
from axcomp.fmu import package_axcomp, package_native
from axcomp.model import models

Array = NDArray[np.float64]

T, LONG = 0.001, 10
"""Cycle time, s, and the cycles of a long step."""

MODELS = ("three_axis", "five_axis", "rotary_table", "warm_axis")
SWITCHES = ("switch",)


def linear_inside(values: Array) -> tuple[Array, Array]:
    """Return values that are linear inside each long step as those at its begin, and their derivatives."""
    begin = values[: len(values) // LONG * LONG : LONG]
    return begin[:-1], np.diff(begin) / (LONG * T)


def run_both(fmu: Path, given: dict[str, Array]) -> tuple[dict[str, Array], dict[str, Array], dict[str, Array]]:
    """Return the outputs at the ends of the long steps: with short steps, with slopes, and with held inputs."""
    lines = {name: linear_inside(values) for name, values in given.items()}
    steps = len(next(iter(lines.values()))[0])
    results = []
    for cycles, sloped in ((1, False), (LONG, True), (LONG, False)):
        with Host(fmu) as host:
            references = [host.variables[name].valueReference for name in lines]
            rows: list[dict[str, Any]] = []
            for step in range(steps):
                for inner in range(0, LONG, cycles):
                    values = [float(begin[step] + slope[step] * inner * T) for begin, slope in lines.values()]
                    host.slave.setReal(references, values)
                    if sloped:
                        slopes = [float(slope[step]) for _, slope in lines.values()]
                        host.slave.setRealInputDerivatives(references, [1] * len(references), slopes)
                    host.slave.doStep((step * LONG + inner) * T, cycles * T)
                rows.append(host.outputs())
            results.append({name: np.array([float(row[name]) for row in rows]) for name in rows[0]})
    return results[0], results[1], results[2]


@pytest.mark.parametrize("name", MODELS)
def test_a_host_with_steps_of_ten_cycles_gets_what_one_with_single_cycles_gets(
    native_fmu: Path, name: str, tmp_path: Path
) -> None:
    assert native_fmu
    fmu = package_native(models() / name, tmp_path).path
    assert fmpy.read_model_description(fmu).coSimulation.canInterpolateInputs
    given = {n: v for n, v in read_csv(models() / name / INPUT).items() if n != "time" and not n.endswith(SWITCHES)}
    short, sloped, held = in_child(run_both, fmu, given)
    for output, values in short.items():
        assert np.abs(values - sloped[output]).max() <= 1e-9, output
    assert max(np.abs(values - held[output]).max() for output, values in short.items()) > 1e-3


def use_of_derivatives(fmu: Path) -> list[Any]:
    found: list[Any] = []
    with Host(fmu) as host:
        x = host.variables["X.setpoint"].valueReference
        host.set({"X.setpoint": 1.0})
        host.slave.setRealInputDerivatives([x], [1], [2.0])
        found += [host.get("X.setpoint"), host.step(duration=0.01)["X.display_position"]]
        found.append(host.get("X.setpoint"))
        host.step(duration=0.01)
        found.append(host.get("X.setpoint"))
        host.slave.setRealInputDerivatives([x], [1], [3.0])
        state = host.slave.getFMUState()
        host.step(duration=0.01)
        found.append(host.get("X.setpoint"))
        host.slave.setFMUState(state)
        host.time -= 0.01
        host.step(duration=0.01)
        found.append(host.get("X.setpoint"))
        for reference, order in ((x, 0), (host.variables["X.correction"].valueReference, 1), (4, 1)):
            try:
                host.slave.setRealInputDerivatives([reference], [order], [1.0])
                found.append("taken")
            except FMICallException as error:
                found.append(error.status)
        host.slave.setRealInputDerivatives([x, x], [2, 1], [9.0, 1.0])
        host.step(duration=0.01)
        found += [host.get("X.setpoint"), [text for status, _, text in host.messages if status == 1]]
    return found


def test_a_derivative_is_for_one_step_and_the_input_stays_where_it_has_come_to(native_fmu: Path) -> None:
    found = in_child(use_of_derivatives, native_fmu)
    assert found[0] == 1.0
    assert found[2:6] == pytest.approx([1.02, 1.02, 1.05, 1.05], abs=1e-15)
    assert found[6:9] == [3, 3, 3]
    assert found[9] == pytest.approx(1.06, abs=1e-15)
    assert found[10] == ["derivatives of order 2 are not used, only the first"]


def steps_at(fmu: Path, stop: float | None) -> list[Any]:
    """Make good and bad steps; return for each whether it was made."""
    host = Host.__new__(Host)
    found: list[Any] = []

    def initialize(_: Any) -> None:
        host.slave.setupExperiment(startTime=0.0, stopTime=stop)
        host.slave.enterInitializationMode()
        host.slave.exitInitializationMode()

    host.initialize = initialize  # type: ignore[method-assign]
    host.__init__(fmu)  # type: ignore[misc]
    with host:
        for time, size in ((0.0, 0.004), (0.003, 0.001), (0.004 - 1e-12, 0.006), (0.010, 0.001), (0.010, 0.0)):
            try:
                host.slave.doStep(time, size)
                found.append(True)
            except FMICallException as error:
                found.append(error.status)
        found.append([text for *_, text in host.messages])
    return found


@pytest.mark.parametrize(("runtime", "status"), [("native", 3), ("python", 2)])
def test_steps_back_in_time_and_beyond_the_stop_time_are_refused(
    request: pytest.FixtureRequest, lists: Path, tmp_path: Path, runtime: str, status: int
) -> None:
    native = runtime == "native"
    fmu = request.getfixturevalue("native_fmu") if native else package_axcomp(lists, tmp_path).path
    *made, texts = in_child(steps_at, fmu, 0.010)
    assert made == [True, status, True, status, True]
    assert any("would go back, the last one ended at 0.004 s" in text for text in texts)
    assert any("a step to 0.011 s goes beyond the stop time, 0.01 s" in text for text in texts)
    *made, _ = in_child(steps_at, fmu, None)
    assert made == [True, status, True, True, status]
