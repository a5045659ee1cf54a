"""The built FMU in a host, FMPy."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.engine import Engine
from axcomp.fmu import package, package_axcomp
from axcomp.lists import write_machine
from axcomp.model import Machine, models
from axcomp.plant import package_plant

Outputs = list[dict[str, Any]]

ERROR = 3


def engine_run(machine: Machine, rows: list[dict[str, Any]]) -> Outputs:
    engine = Engine(machine)
    return [engine.step(row) for row in rows]


@pytest.fixture(scope="module")
def other_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same axes with twice the pitch errors."""
    folder = tmp_path_factory.mktemp("other")
    write_machine(three_axes(2.0), folder / "lists")
    return package_axcomp(folder / "lists", folder).path


@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_it_is_valid(lists: Path, tmp_path: Path, naming: str) -> None:
    built = package_axcomp(lists, tmp_path / "any name.fmu", naming=naming, external_tool=False)  # type: ignore[arg-type]
    assert validate_fmu(str(built.path)) == []
    description = fmpy.read_model_description(built.path)
    assert description.variableNamingConvention == naming
    assert description.coSimulation.needsExecutionTool is False


def run_rows(fmu: Path, rows: list[dict[str, Any]]) -> tuple[Outputs, list[tuple[int, str, str]]]:
    with Host(fmu) as host:
        return host.run(rows), host.messages


def test_it_computes_what_the_engine_computes_in_every_bit(fmu: Path) -> None:
    rows = trajectory(300)
    expected = engine_run(three_axes(), rows)
    assert any(row["Y_ACHSE.crosstalk.correction"] and row["X.current"] for row in expected)
    assert in_child(run_rows, fmu, rows) == (expected, [])


def simulate(fmu: Path, rows: list[dict[str, Any]]) -> Any:
    table = np.array(
        [(k * 0.001, *row.values()) for k, row in enumerate(rows)],
        dtype=[("time", "f8"), *((name, "?" if isinstance(v, bool) else "f8") for name, v in rows[0].items())],
    )
    return fmpy.simulate_fmu(str(fmu), input=table, stop_time=0.2, validate=True)


def test_fmpy_simulates_it_untold_as_the_engine_does(fmu: Path) -> None:
    rows = trajectory(201)
    expected = engine_run(three_axes(), rows[:200])
    result = in_child(simulate, fmu, rows)
    assert len(result) == 201
    for name in ("X.corrected_setpoint", "Y_ACHSE.correction", "C.display_position", "X.current"):
        assert result[name][1:].tolist() == [row[name] for row in expected], name


def run_in_parts(fmu: Path, rows: list[dict[str, Any]], parts: list[list[float]]) -> Outputs:
    with Host(fmu, start=5.0) as host:
        outputs = []
        for k, row in enumerate(rows):
            host.set(row)
            for end in (*parts[k % len(parts)], 1.0):
                host.step(duration=5.0 + (k + end) * 0.001 - host.time)
            outputs.append(host.outputs())
        return outputs


def test_smaller_steps_change_nothing_at_the_instants(fmu: Path) -> None:
    rows = trajectory(80)
    parts = [[0.5], [], [0.1, 0.2, 0.9], [1e-9, 0.999999]]
    assert in_child(run_in_parts, fmu, rows, parts) == engine_run(three_axes(), rows)


def one_long_step(fmu: Path, cycles: int) -> dict[str, Any]:
    with Host(fmu) as host:
        return host.step(trajectory(1, 30)[0], cycles * 0.001)


def test_a_long_step_runs_all_cycles_in_it_with_the_inputs_held(fmu: Path) -> None:
    assert in_child(one_long_step, fmu, 7) == engine_run(three_axes(), trajectory(1, 30) * 7)[-1]


def through_states(fmu: Path, rows: list[dict[str, Any]], at: list[int]) -> bool:
    """Run past each cycle, go back and run again; with the state itself and with its bytes, here and in another."""
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
        return same and not host.messages and not other.messages


def test_a_state_brings_everything_back_at_any_cycle(fmu: Path) -> None:
    assert in_child(through_states, fmu, trajectory(150), [0, 39, 41, 59, 83, 101])


def alternate(fmus: list[Path], rows: list[list[dict[str, Any]]]) -> list[Outputs]:
    hosts = [Host(fmu) for fmu in fmus]
    outputs: list[Outputs] = [[] for _ in hosts]
    for k in range(len(rows[0])):
        for host, own, kept in zip(hosts, rows, outputs, strict=True):
            kept.append(host.step(own[k]))
    for host in hosts:
        host.close()
    return outputs


def test_instances_do_not_influence_each_other(fmu: Path, other_fmu: Path) -> None:
    rows = [trajectory(80), trajectory(80, 200), trajectory(80, 50)]
    machines = [three_axes(), three_axes(), three_axes(2.0)]
    expected = [engine_run(machine, own) for machine, own in zip(machines, rows, strict=True)]
    assert in_child(alternate, [fmu, fmu, other_fmu], rows) == expected


def test_two_versions_of_the_code_run_in_one_process(
    fmu: Path, lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copied = tmp_path / "axcomp"
    shutil.copytree(package.PACKAGE, copied, ignore=shutil.ignore_patterns("__pycache__", "_*src", "_models"))
    cycle = copied / "kernel" / "cycle.py"
    text = cycle.read_text(encoding="utf-8")
    changed = text.replace("out.display_position = ", "out.display_position = 1000.0 + ")
    assert changed != text
    cycle.write_text(changed, encoding="utf-8")
    monkeypatch.setattr(package, "PACKAGE", copied)
    newer = package_axcomp(lists, tmp_path / "newer.fmu").path
    rows = trajectory(20)
    old, new = in_child(alternate, [fmu, newer], [rows, rows])
    expected = engine_run(three_axes(), rows)
    assert old == expected
    assert [row["X.display_position"] - 1000.0 for row in new] == pytest.approx(
        [row["X.display_position"] for row in expected], abs=1e-9
    )
    assert [row["X.corrected_setpoint"] for row in new] == [row["X.corrected_setpoint"] for row in expected]


def edited_lists(fmu: Path, lists: Path) -> list[Any]:
    folder = Path(fmpy.extract(fmu, tempfile.mkdtemp(suffix=" with blanks")))
    values = []
    for source in (None, lists):
        if source is not None:
            shutil.copytree(source, folder / "resources" / "machine", dirs_exist_ok=True)
        with Host(fmu, folder=folder) as host:
            values.append(host.step({"X.setpoint": 30.0})["X.leadscrew.correction"])
    shutil.rmtree(folder)
    return values


def test_a_changed_list_in_an_unpacked_fmu_takes_effect(fmu: Path, tmp_path: Path) -> None:
    write_machine(three_axes(3.0), tmp_path)
    assert in_child(edited_lists, fmu, tmp_path) == [-0.03, -0.09]


def reload_lists(fmu: Path, good: Path, bad: Path) -> tuple[list[Any], list[str]]:
    with Host(fmu) as host:
        values = []
        for path in (good, bad):
            host.step({"X.setpoint": 30.0, "reload": False, "update_path": str(path)})
            host.step({"reload": True})
            for _ in range(3):  # the new values come in over the 4 backlash cycles of X
                outputs = host.step({})
            values.append((outputs["X.leadscrew.correction"], outputs["X.error"]))
        return values, [message for status, _, message in host.messages if status == ERROR]


def test_reload_takes_good_lists_and_refuses_bad_ones(fmu: Path, tmp_path: Path) -> None:
    write_machine(three_axes(3.0), tmp_path / "good")
    write_machine(Machine(three_axes(4.0).axes[:2]), tmp_path / "bad")
    values, errors = in_child(reload_lists, fmu, tmp_path / "good", tmp_path / "bad")
    assert values == [(-0.09, 0), (-0.09, 902)]
    assert any("refused" in error for error in errors)


def misuse(fmu: Path, lists: Path) -> tuple[dict[str, Any], list[tuple[int, str, str]]]:
    folder = Path(fmpy.extract(fmu))
    shutil.copytree(lists, folder / "resources" / "machine", dirs_exist_ok=True)
    with Host(fmu, folder=folder) as host:
        for _ in range(5):
            host.slave.getReal([9999, 4294967295])
            host.slave.setReal([9999], [1.0])
            host.slave.setBoolean([64], [True])
            host.slave.doStep(host.time, float("nan"))
            host.step(
                {"X.setpoint": float("nan"), "X.velocity": float("inf"), "update_path": "\ud7ff/%s%n", "reload": True}
            )
            host.step({"reload": False})
        return host.step({"X.setpoint": 12.0, "X.velocity": 0.0, "reset": True}), host.messages


def test_bad_lists_and_repeated_errors_are_survived(fmu: Path, tmp_path: Path) -> None:
    lists = tmp_path / "machine"
    write_machine(three_axes(), lists)
    (lists / "achskw1.lis").write_bytes(b"\0\1\2")
    (lists / "achskw2.lis").write_text("", encoding="utf-8")
    outputs, messages = in_child(misuse, fmu, lists)
    assert outputs["X.corrected_setpoint"] == 12.0
    assert outputs["X.error"] == 0
    assert {category for _, category, _ in messages} <= {"logStatusError", "logStatusWarning"}
    text = "\n".join(message for _, _, message in messages)
    assert "AXC-BINARY" in text
    assert "AXC-EMPTY" in text
    assert "%" not in text
    assert len(messages) < 50


def start_again(fmu: Path, rows: list[dict[str, Any]]) -> list[Outputs]:
    with Host(fmu) as host:
        first = host.run(rows)
        host.slave.terminate()
        host.slave.reset()
        host.time = 0.0
        host.initialize({})
        return [first, host.run(rows)]


def test_after_a_reset_everything_is_as_at_the_start(fmu: Path) -> None:
    first, second = in_child(start_again, fmu, trajectory(60))
    assert first == second


def host_plant(fmu: Path, compensation: Path) -> tuple[dict[str, Any], float]:
    """Run the plant beside the compensation in one process."""
    with Host(fmu) as plant, Host(compensation) as own:
        for k in range(200):
            setpoint = own.step({"X.setpoint": 0.01 * k})["X.corrected_setpoint"]
            outputs = plant.step({"X.setpoint": setpoint})
        return outputs, setpoint


def test_the_plant_is_valid_and_follows_its_setpoint(fmu: Path, tmp_path: Path) -> None:
    plant = package_plant(models() / "three_axis", tmp_path)
    assert validate_fmu(str(plant)) == []
    outputs, setpoint = in_child(host_plant, plant, fmu)
    assert outputs["X.measured_position"] == pytest.approx(setpoint, abs=0.2)


def test_fmpys_own_command_simulates_it(fmu: Path, tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-c",
        "from fmpy.cli import main; main()",
        "simulate",
        str(fmu),
        "--output-file",
        "o.csv",
    ]
    subprocess.run([*command, "--stop-time", "0.01"], cwd=tmp_path, check=False, timeout=120)
    assert len((tmp_path / "o.csv").read_text(encoding="utf-8").splitlines()) == 12


def test_a_manual_compensation_starts_off(tmp_path: Path) -> None:
    x, y, c = three_axes().axes
    assert y.cross is not None
    machine = Machine((x, replace(y, cross=replace(y.cross, manual_activation=True)), c))
    write_machine(machine, tmp_path / "lists")
    built = package_axcomp(tmp_path / "lists", tmp_path)
    ((row,), _) = in_child(run_rows, built.path, [{}])
    assert (row["Y_ACHSE.cross.active"], row["Y_ACHSE.plane.active"]) == (False, True)
