"""The plant's FMU in a host: the same bits as the plant itself, its state, and inputs that are no numbers."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmu_host import CYCLE, Host, in_child

from axcomp.model import models
from axcomp.plant import load_plant, package_plant

MODEL = models() / "three_axis"
AXES = ("X", "Y", "Z")


def rows() -> list[dict[str, float]]:
    """Some motion with currents, from rest."""
    ways = np.random.default_rng(3).normal(scale=[1e-4] * 3 + [30.0] * 3, size=(80, 6)).cumsum(axis=0).cumsum(axis=0)
    names = [f"{axis}.setpoint" for axis in AXES] + [f"{axis}.current" for axis in AXES]
    return [dict(zip(names, row, strict=True)) for row in (ways - ways[0]).tolist()]


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return package_plant(MODEL, tmp_path_factory.mktemp("plant"))


def run(fmu: Path) -> list[dict[str, Any]]:
    with Host(fmu) as host:
        return host.run(rows())


def test_it_is_the_plant_in_every_bit(fmu: Path) -> None:
    plant: Any = load_plant(MODEL)
    plant.rest_at([0.0, 0.0, 0.0])
    expected = []
    for row in rows():
        plant.step([row[f"{a}.setpoint"] for a in AXES], [row[f"{a}.current"] for a in AXES], CYCLE)
        shown: dict[str, float] = {}
        for axis, drive, true, beyond in zip(AXES, plant.drives, plant.true, plant.beyond, strict=True):
            shown[f"{axis}.true_position"] = true
            shown[f"{axis}.measured_position"] = drive.position
            shown[f"{axis}.velocity"] = drive.velocity
            shown[f"{axis}.motor_current"] = drive.current
            shown[f"{axis}.following_error"] = drive.lag
            shown[f"{axis}.beyond_tables"] = beyond
        expected.append(shown)
    assert in_child(run, fmu) == expected


def save_and_restore(fmu: Path) -> tuple[list[Any], list[Any], list[Any]]:
    with Host(fmu) as host, Host(fmu, folder=host.folder) as other:
        host.run(rows()[:40])
        state = host.slave.getFMUstate()
        serialized = host.slave.serializeFMUstate(state)
        first = host.run(rows()[40:])
        host.slave.setFMUstate(state)
        again = host.run(rows()[40:])
        other.slave.setFMUstate(other.slave.deSerializeFMUstate(serialized))
        return first, again, other.run(rows()[40:])


def test_a_state_brings_everything_back_in_another_instance_too(fmu: Path) -> None:
    first, again, elsewhere = in_child(save_and_restore, fmu)
    assert first == again == elsewhere


def feed_nonsense(fmu: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    with Host(fmu) as host:
        host.run([{"X.setpoint": 1.0}] * 200)
        for nonsense in (math.nan, math.inf, -math.inf, 1e300) * 3:
            shown = host.step({"X.setpoint": nonsense, "Y.current": nonsense})
        return shown, host.step({"X.setpoint": 1.0, "Y.current": 0.0})


def test_inputs_that_are_not_finite_keep_the_last_good_value(fmu: Path) -> None:
    during, after = in_child(feed_nonsense, fmu)
    assert during["X.measured_position"] == pytest.approx(1.0, abs=1e-6)
    assert during["Y.measured_position"] == 0.0
    assert after["X.measured_position"] == pytest.approx(1.0, abs=1e-6)


def do_what_cannot_be_done(fmu: Path) -> tuple[list[tuple[int, str, str]], float]:
    with Host(fmu) as host:
        for _ in range(3):
            host.slave.doStep(host.time, 0.0)
            host.slave.setReal([9999], [1.0])
            host.slave.getReal([9999])
        return host.messages, host.run([{"X.setpoint": 2.0}] * 200)[-1]["X.measured_position"]


def test_impossible_calls_are_survived_again_and_again_and_told(fmu: Path) -> None:
    messages, position = in_child(do_what_cannot_be_done, fmu)
    assert position == pytest.approx(2.0, abs=1e-6)
    assert any("9999" in text for *_, text in messages)


FIVE_AXIS = models() / "five_axis"
FIVE = ("X", "Y", "Z", "B", "C")


def follow_five_axes(fmu: Path) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any], dict[str, Any]]:
    way = [
        {f"{name}.{k}": 0.01 * i * (n + 1) for n, name in enumerate(FIVE) for k in ("setpoint", "commanded_position")}
        for i in range(150)
    ]
    with Host(fmu, parameters={"tool_length": 120.0}) as host:
        start = host.outputs()
        moved = host.run(way)[-1]
        state = host.slave.getFMUstate()
        nonsense = host.step({"tool_length": math.nan, "B.commanded_position": math.inf})
        host.step({"tool_length": 80.0})
        host.slave.setFMUstate(state)
        return start, moved, nonsense, host.outputs()


def test_the_tool_tip_is_where_the_rigid_bodies_put_it(tmp_path: Path) -> None:
    start, moved, nonsense, restored = in_child(follow_five_axes, package_plant(FIVE_AXIS, tmp_path))
    bodies: Any = load_plant(FIVE_AXIS).bodies  # type: ignore[attr-defined]
    tip = bodies.tip(120.0)
    assert [start[f"tcp.{k}"] for k in "xyz"] == [0.0, 0.0, -120.0]
    true = [moved[f"{name}.true_position"] for name in FIVE]
    assert tuple(moved[f"tcp.{k}"] for k in "xyz") == bodies.place(tip, true)
    commanded = [0.01 * 149 * (n + 1) for n in range(5)]
    assert tuple(moved[f"tcp.nominal_{k}"] for k in "xyz") == bodies.nominal_place(tip, commanded)
    assert all(nonsense[f"tcp.nominal_{k}"] == moved[f"tcp.nominal_{k}"] for k in "xyz")
    assert restored == moved


def test_a_plant_without_rigid_bodies_has_no_tool_tip(fmu: Path) -> None:
    names = {variable.name for variable in fmpy.read_model_description(fmu).modelVariables}
    assert len(names) == 8 * len(AXES)
