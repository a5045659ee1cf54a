"""The calls of FMI on an Instance, without a host around it."""

from __future__ import annotations

import math
import os
import pickle
import shutil
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Any

import pytest
from fmu_machines import three_axes, trajectory

from axcomp.engine import Engine
from axcomp.fmu import MAGIC, Instance, instance as instance_module
from axcomp.interface import Value, by_name, variables_of
from axcomp.kinds import Severity
from axcomp.lists import write_machine
from axcomp.model import Machine

VARIABLES = by_name(variables_of(three_axes()))
OUTPUTS = [variable for variable in VARIABLES.values() if variable.causality == "output"]
CYCLE = 0.001


class Driver:
    """Calls an Instance by the names of the variables."""

    def __init__(self, resources: Path) -> None:
        self.log: list[tuple[Severity, str]] = []
        self.instance = Instance(str(resources), lambda severity, text: self.log.append((severity, text)))
        self.time = 0.0

    def set(self, values: Mapping[str, Value]) -> None:
        for name, value in values.items():
            variable = VARIABLES[name]
            self.instance.set(variable.type, [variable.reference], [value])

    def get(self, name: str) -> Any:
        variable = VARIABLES[name]
        return self.instance.get(variable.type, [variable.reference])[0]

    def begin(self, **values: Value) -> None:
        self.instance.set_up(0.0)
        self.instance.enter_initialization()
        self.set(values)
        self.instance.exit_initialization()

    def step(self, values: Mapping[str, Value] | None = None, duration: float = CYCLE) -> dict[str, Value]:
        self.set(values or {})
        self.instance.do_step(self.time, duration)
        self.time += duration
        return self.outputs()

    def outputs(self) -> dict[str, Value]:
        return {variable.name: self.get(variable.name) for variable in OUTPUTS}

    def errors(self) -> list[str]:
        return [text for severity, text in self.log if severity is Severity.ERROR]


@pytest.fixture
def resources(fmu: Path, tmp_path: Path) -> Path:
    """The FMU's resources, unpacked."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path)
    return tmp_path / "resources"


@pytest.fixture
def driver(resources: Path) -> Driver:
    driver = Driver(resources)
    driver.begin()
    return driver


def with_leadscrew(machine: Machine, **changes: Any) -> Machine:
    """Return the machine with another leadscrew table on X."""
    x, *others = machine.axes
    assert x.leadscrew is not None
    return Machine((replace(x, leadscrew=replace(x.leadscrew, **changes)), *others))


def test_it_computes_what_the_engine_computes(driver: Driver) -> None:
    engine = Engine(three_axes())
    for row in trajectory(50):
        assert driver.step(row) == engine.step(row)
    assert driver.log == []


def test_outputs_belong_to_the_start_values_during_and_after_initialization(resources: Path) -> None:
    driver, engine = Driver(resources), Engine(three_axes())
    row = trajectory(1, 77)[0]
    expected = engine.step(row)
    driver.instance.enter_initialization()
    driver.set(row)
    assert driver.outputs() == expected
    driver.instance.exit_initialization()
    assert driver.outputs() == expected
    assert driver.step() == expected


def test_the_cycle_time_is_a_parameter(resources: Path) -> None:
    driver, engine = Driver(resources), Engine(three_axes(), 0.004)
    driver.begin(**{"X.actual_position": 5.0, "cycle_time": 0.004})
    assert driver.get("X.actual_position") == 5.0
    expected = [engine.step(row) for row in trajectory(20)]
    assert [driver.step(row, 0.004) for row in trajectory(20)] == expected


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), float("inf")])
def test_an_impossible_cycle_time_is_not_taken(resources: Path, wrong: float) -> None:
    driver = Driver(resources)
    driver.begin(cycle_time=wrong)
    assert driver.get("cycle_time") == CYCLE
    assert driver.get("X.error") == 903
    assert "cycle time" in driver.errors()[0]


def test_a_step_without_an_instant_holds_the_outputs(driver: Driver) -> None:
    driver.step({"X.setpoint": 10.0}, 0.0004)
    held = driver.outputs()
    assert driver.step({"X.setpoint": 20.0}, 0.0004) == held
    assert driver.step(duration=0.0004) != held


def test_references_that_do_not_exist_are_survived_and_told_once(driver: Driver) -> None:
    for _ in range(3):
        assert driver.instance.get("Real", [64, 6, -1, 64 * 40, 10**9]) == [0.0] * 5
        assert driver.instance.get("Integer", [64]) == [0]
        assert driver.instance.get("String", [64]) == [""]
        assert driver.instance.get("Boolean", [64]) == [False]
        driver.instance.set("Boolean", [64, -1], [True, True])
    assert len(driver.errors()) == 4 + 3 + 2
    assert driver.get("X.error") == driver.get("C.error") == 903
    assert driver.step()["X.error"] == 903
    assert driver.step({"reset": True})["X.error"] == 0


def test_outputs_cannot_be_set(driver: Driver) -> None:
    before = driver.outputs()
    driver.set({"X.corrected_setpoint": 5.0})
    assert driver.get("X.corrected_setpoint") == before["X.corrected_setpoint"]
    assert "to set" in driver.errors()[0]


def test_impossible_steps_are_survived_again_and_again(driver: Driver, capsys: pytest.CaptureFixture[str]) -> None:
    for _ in range(3):
        for duration in (float("nan"), float("inf")):
            driver.instance.do_step(0.0, duration)
    assert driver.get("X.error") == 903
    assert len(driver.errors()) == 2
    assert capsys.readouterr().err.count("axcomp: do_step") == 2
    assert driver.step({"reset": True})["X.error"] == 0


def test_inputs_that_are_not_finite_hold_the_axis(driver: Driver) -> None:
    good = driver.step({"X.setpoint": 10.0})
    held = driver.step({"X.setpoint": float("nan")})
    assert held["X.corrected_setpoint"] == good["X.corrected_setpoint"]
    assert (held["X.error"], held["C.error"]) == (901, 0)
    assert driver.step({"X.setpoint": 11.0})["X.corrected_setpoint"] != good["X.corrected_setpoint"]


def test_everything_comes_back_at_any_cycle(driver: Driver) -> None:
    rows = trajectory(120)
    for row in rows[:35]:
        driver.step(row)
    for at in (35, 41, 82, 88):
        driver.step(rows[at - 1])
        saved, time = driver.instance.save(), driver.time
        first = [driver.step(row) for row in rows[at : at + 25]]
        driver.instance.restore(saved)
        driver.time = time
        assert driver.instance.save() == saved
        assert [driver.step(row) for row in rows[at : at + 25]] == first
    assert driver.log == []


def test_a_state_fits_another_instance_of_the_same_fmu(driver: Driver, resources: Path) -> None:
    for row in trajectory(45):
        driver.step(row)
    other = Driver(resources)
    other.begin()
    other.instance.restore(driver.instance.save())
    other.time = driver.time
    assert [other.step(row) for row in trajectory(30, 45)] == [driver.step(row) for row in trajectory(30, 45)]


class _Foreign:
    def __reduce__(self) -> tuple[Any, ...]:
        return (print, ("loaded",))


def test_what_is_no_state_changes_nothing(driver: Driver, capsys: pytest.CaptureFixture[str]) -> None:
    driver.step({**trajectory(1)[0], "update_path": "somewhere"})
    saved = driver.instance.save()
    foreign = pickle.dumps(_Foreign())
    flipped = saved.replace(b"somewhere", b"elsewhere")
    assert flipped != saved
    bad = [b"", saved[:-1], saved[:10], flipped, MAGIC + zlib.crc32(foreign).to_bytes(4, "little") + foreign]
    for data in bad:
        driver.instance.restore(data)
        assert driver.get("X.error") == 903
        driver.step({"reset": True})
        driver.instance.restore(saved)
        assert driver.instance.save() == saved
    assert capsys.readouterr().out == ""


def test_reload_takes_new_lists_at_its_rising_edge_only(driver: Driver, tmp_path: Path) -> None:
    machine = with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5))
    write_machine(machine, tmp_path / "new")
    before = driver.step({"X.setpoint": 10.0})["X.leadscrew.correction"]
    driver.set({"update_path": str(tmp_path / "new")})
    assert driver.step()["X.leadscrew.correction"] == before
    # the new values come in over the 4 backlash cycles of X
    blend = [-0.5 + (before + 0.5) * rest for rest in (0.5 + 0.25 * math.sqrt(2), 0.5, 0.5 - 0.25 * math.sqrt(2), 0.0)]
    found = [driver.step({"reload": True}), *(driver.step() for _ in range(3))]
    assert [outputs["X.leadscrew.correction"] for outputs in found] == pytest.approx(blend, abs=1e-15)
    assert {outputs["X.error"] for outputs in found} == {0}
    write_machine(three_axes(), tmp_path / "new")
    assert driver.step()["X.leadscrew.correction"] == -0.5
    driver.step({"reload": False})
    back = [driver.step({"reload": True}), *(driver.step() for _ in range(3))][-1]
    assert back["X.leadscrew.correction"] == before


def test_reload_without_a_path_reads_the_fmus_own_lists(driver: Driver, resources: Path) -> None:
    driver.step({"X.setpoint": 10.0})
    write_machine(with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5)), resources / "machine")
    assert [driver.step({"reload": True}), *(driver.step() for _ in range(3))][-1]["X.leadscrew.correction"] == -0.5


@pytest.mark.parametrize("wrong", ["missing", "error", "axis", "kind"])
def test_lists_that_do_not_fit_are_refused_as_a_whole(driver: Driver, tmp_path: Path, wrong: str) -> None:
    folder = tmp_path / "new"
    x, y, c = with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5)).axes
    if wrong == "axis":
        write_machine(Machine((x, replace(y, plane=None))), folder)
    elif wrong == "kind":
        write_machine(Machine((x, y, replace(c, friction=x.friction))), folder)
    elif wrong == "error":
        write_machine(Machine((x, y, c)), folder)
        with (folder / "hochlauf.lis").open("r+", encoding="utf-8") as file:
            text = file.read().replace("achskw3.lis", "lost.lis")
            assert "lost.lis" in text
            file.seek(0)
            file.write(text)
    before = driver.step({"X.setpoint": 10.0})
    after = driver.step({"update_path": str(folder), "reload": True})
    assert after["X.leadscrew.correction"] == before["X.leadscrew.correction"]
    assert {after[f"{name}.error"] for name in ("X", "Y_ACHSE", "C")} == {902}
    assert len([text for text in driver.errors() if "refused" in text]) == 1
    assert driver.step({"reset": True, "reload": False})["X.error"] == 0
    assert driver.step({"reset": False, "reload": True})["X.error"] == 902
    assert len([text for text in driver.errors() if "refused" in text]) == 2


def test_an_axis_whose_max_points_changes_keeps_its_lists_and_says_so(driver: Driver, tmp_path: Path) -> None:
    x, y, c = with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5), max_points=77).axes
    assert y.leadscrew is not None
    y = replace(y, leadscrew=replace(y.leadscrew, positive=(0.25, 0.25, 0.25)))
    write_machine(Machine((x, y, c)), tmp_path / "new")
    before = driver.step({"X.setpoint": 10.0})
    after = driver.step({"update_path": str(tmp_path / "new"), "reload": True})
    assert after["X.leadscrew.correction"] == before["X.leadscrew.correction"]
    assert after["Y_ACHSE.leadscrew.correction"] == -0.25
    assert (after["X.error"], after["Y_ACHSE.error"]) == (110638, 0)


def test_a_state_brings_the_lists_of_its_time_back(driver: Driver, tmp_path: Path, resources: Path) -> None:
    write_machine(with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5)), tmp_path / "new")
    before = driver.step({"X.setpoint": 10.0})
    old = driver.instance.save()
    driver.step({"update_path": str(tmp_path / "new"), "reload": True})
    new = driver.instance.save()
    driver.instance.restore(old)
    assert driver.get("reload") is False
    assert driver.get("update_path") == ""
    assert driver.step()["X.leadscrew.correction"] == before["X.leadscrew.correction"]
    shutil.rmtree(tmp_path / "new")
    other = Driver(resources)
    other.begin()
    other.instance.restore(new)
    assert other.log == []
    other.time = 0.002
    assert other.get("reload") is True
    assert [other.step() for _ in range(3)][-1]["X.leadscrew.correction"] == -0.5
    assert other.log == []


def test_a_state_with_lists_fits_wherever_choices_are_pickled_by_name(
    driver: Driver, tmp_path: Path, resources: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As Python 3.11.0 to 3.11.3 do: by a call of ``getattr``, which no state may ask for."""
    monkeypatch.setattr(Enum, "__reduce_ex__", lambda self, _: (getattr, (type(self), self.name)))
    write_machine(with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5)), tmp_path / "new")
    driver.step({"X.setpoint": 10.0})
    driver.step({"update_path": str(tmp_path / "new"), "reload": True})
    other = Driver(resources)
    other.begin()
    other.instance.restore(driver.instance.save())
    assert other.log == []
    assert other.get("reload") is True


def test_findings_go_to_the_log_errors_to_standard_error_too(
    resources: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lists = resources / "100% machine"
    shutil.move(resources / "machine", lists)
    interface = resources / "axcomp.json"
    interface.write_text(interface.read_text(encoding="utf-8").replace("machine", lists.name), encoding="utf-8")
    (lists / "achskw1.lis").write_bytes(b"\0\1\2")
    with (lists / "achskw2.lis").open("r+", encoding="utf-8") as file:
        file.write("kw.ssfk.nonsense 5 % % %\n")
    driver = Driver(resources)
    severities = {severity for severity, _ in driver.log}
    assert severities == {Severity.ERROR, Severity.WARNING}
    assert not [text for _, text in driver.log if "%" in text or "\n" in text]
    err = capsys.readouterr().err
    assert "achskw1.lis" in err
    assert "nonsense" not in err
    driver.begin()
    assert driver.step({"X.setpoint": 5.0})["X.corrected_setpoint"] == 5.0


def test_a_changed_list_takes_effect_and_what_is_new_acts_unseen(resources: Path) -> None:
    x, y, c = with_leadscrew(three_axes(), positive=(0.5, 0.5, 0.5, 0.5)).axes
    write_machine(Machine((replace(x, cross=y.cross), replace(y, crosstalk=None), c)), resources / "machine")
    driver = Driver(resources)
    driver.begin()
    outputs = driver.step({"X.setpoint": 10.0})
    assert driver.errors() == []
    assert outputs["X.leadscrew.correction"] == -0.5
    assert outputs["X.correction"] == pytest.approx(-0.5 + 0.004)
    assert outputs["Y_ACHSE.crosstalk.correction"] == 0.0
    assert outputs["Y_ACHSE.crosstalk.active"] is False


def test_without_lists_the_setpoints_go_through(resources: Path) -> None:
    shutil.rmtree(resources / "machine")
    driver = Driver(resources)
    driver.begin()
    outputs = driver.step({"X.setpoint": 10.0, "C.setpoint": 20.0})
    assert (outputs["X.corrected_setpoint"], outputs["C.corrected_setpoint"]) == (10.0, 20.0)
    assert driver.errors()


def test_a_reader_that_fails_leaves_the_setpoints_as_they_are(resources: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(_: object, **__: object) -> None:
        raise RuntimeError("100% wrong")

    monkeypatch.setattr(instance_module, "read_machine", fail)
    driver = Driver(resources)
    driver.begin()
    outputs = driver.step({"X.setpoint": 10.0})
    assert (outputs["X.corrected_setpoint"], outputs["X.error"]) == (10.0, 903)
    assert "RuntimeError: 100 percent wrong" in driver.errors()[0]


def test_nothing_at_all_in_resources_is_survived(tmp_path: Path) -> None:
    driver = Driver(tmp_path / "nowhere")
    driver.begin()
    assert driver.step({"X.setpoint": 10.0})["X.error"] == 0
    driver.instance.restore(driver.instance.save())
    assert driver.errors()


def test_a_step_of_more_cycles_than_allowed_is_refused(driver: Driver, capsys: pytest.CaptureFixture[str]) -> None:
    instance = driver.instance
    before = instance.save()
    assert instance.do_step(0.0, 10_001.0) is False
    assert "a step of 10001000 cycles is refused; largest_step is 10000000" in capsys.readouterr().err
    assert instance.save() == before
    assert instance.do_step(0.0, 0.02) is True


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_as_update_path_is_not_waited_for(driver: Driver, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    instance = driver.instance
    instance.controls.update_path, instance.controls.reload = str(tmp_path / "pipe"), True
    instance.do_step(0.0, 0.001)
    assert {axis.error for axis in instance.runtime.outputs.axis} == {902}
