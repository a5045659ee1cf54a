"""FMI 3.0: the same bits, no delay in event mode, and tables that a host calibrates while the machine runs."""

from __future__ import annotations

import ctypes
import itertools
import math
import re
import shutil
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmi3_host import Host3
from fmpy.fmi1 import FMICallException
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory
from frozen import every_variable
from lxml import etree

from axcomp.cli import main
from axcomp.demo.examples import EXPECTED, INPUT, TRAJECTORIES, read_csv
from axcomp.engine import Engine
from axcomp.fmu import NoCompilerError, package_native, write_image
from axcomp.kinds import Cross
from axcomp.lists import write_machine
from axcomp.model import Machine, models

SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"
HEADERS = Path(fmpy.__file__).parent / "c-code"
DISCARD = 2


@pytest.fixture(scope="session")
def third(lists: Path, native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of the same lists for FMI 3.0."""
    assert native_fmu
    return package_native(lists, tmp_path_factory.mktemp("third"), fmi="3.0").path


def test_the_schemas_and_fmpy_find_nothing(tmp_path: Path) -> None:
    write_machine(every_variable(), tmp_path / "lists")
    fmu = package_native(tmp_path / "lists", tmp_path, fmi="3.0").path
    files = {
        "modelDescription.xml": "fmi3ModelDescription.xsd",
        "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
        "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    }
    with zipfile.ZipFile(fmu) as archive:
        for name, schema in files.items():
            found = etree.XMLSchema(etree.parse(str(SCHEMAS / schema)))
            assert found.validate(etree.fromstring(archive.read(name))), found.error_log
    run = subprocess.run(
        [sys.executable, "-m", "fmpy", "validate", str(fmu)], capture_output=True, text=True, check=False
    )
    assert (run.returncode, run.stdout.strip()) == (0, "No problems found.")
    description = fmpy.read_model_description(fmu)
    assert description.coSimulation.hasEventMode
    references = [variable.valueReference for variable in description.modelVariables]
    assert len(set(references)) == len(references)


def test_it_has_every_function_of_the_standard(third: Path, tmp_path: Path) -> None:
    text = (HEADERS / "fmi3Functions.h").read_text()
    names = set(re.findall(r"FMI3_Export fmi3\w+TYPE\s+(fmi3\w+);", text))
    assert len(names) > 70
    folder = Path(fmpy.extract(third, tmp_path))
    (library,) = folder.glob("binaries/*/axcomp.*")
    loaded = ctypes.CDLL(str(library))
    assert [name for name in sorted(names) if not hasattr(loaded, name)] == []
    assert hasattr(loaded, "fmi2DoStep")


@pytest.mark.parametrize("event_mode", [False, True])
@pytest.mark.parametrize("name", sorted(TRAJECTORIES))
def test_fmpy_gives_the_expected_output(third: Path, name: str, event_mode: bool, tmp_path: Path) -> None:
    assert third
    fmu = package_native(models() / name, tmp_path, fmi="3.0").path
    result = in_child(simulated, fmu, models() / name / INPUT, event_mode)
    expected = read_csv(models() / name / EXPECTED)
    rows = len(expected["time"])
    for column, values in expected.items():
        found = np.asarray(result[column], dtype=float)
        if not event_mode:
            assert np.allclose(found[:rows], values, rtol=0.0, atol=1e-8), column
            continue
        # Behind an event the outputs belong to the inputs of that very time: a cycle earlier than without events.
        if column == "time":
            continue
        last = {round(time, 9): value for time, value in zip(result["time"], found, strict=True)}
        earlier = [last[round(time, 9)] for time in expected["time"][:-1]]
        assert np.allclose(earlier, values[1:], rtol=0.0, atol=1e-8), column


def simulated(fmu: Path, inputs: Path, event_mode: bool) -> dict[str, list[float]]:
    given = np.genfromtxt(inputs, delimiter=",", names=True, deletechars="")
    step = fmpy.read_model_description(fmu).defaultExperiment.stepSize
    result = fmpy.simulate_fmu(
        str(fmu),
        input=given,
        stop_time=given["time"][-1],
        output_interval=float(step),
        use_event_mode=event_mode,
        validate=True,
    )
    return {name: result[name].tolist() for name in result.dtype.names}


def no_delay(fmu: Path, rows: list[dict[str, Any]]) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    at_events, behind_steps = [], []
    with Host3(fmu) as host:
        host.begin()
        for row in rows:
            at_events.append(host.event(row))
            behind_steps.append(host.step())
    return at_events, behind_steps


def test_outputs_of_an_event_belong_to_its_inputs_in_every_bit(third: Path) -> None:
    rows = trajectory(300)
    engine = Engine(three_axes())
    expected = [engine.step(row) for row in rows]
    at_events, behind_steps = in_child(no_delay, third, rows)
    assert at_events == expected
    assert behind_steps == expected


def without_events(fmu: Path, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    with Host3(fmu, event_mode=False) as host:
        host.begin()
        outputs = []
        for row in rows:
            host.set(row)
            outputs.append(host.step())
        return outputs


def test_without_event_mode_it_is_what_fmi_2_is(third: Path) -> None:
    rows = trajectory(100)
    engine = Engine(three_axes())
    assert in_child(without_events, third, rows) == [engine.step(row) for row in rows]


def between_cycles(fmu: Path) -> tuple[list[float], list[bool]]:
    found = []
    with Host3(fmu) as host:
        host.begin({"X.setpoint": 1.0})
        found.append(host.event({})["X.corrected_setpoint"])
        host.step(0.0004)
        found.append(host.event({"X.setpoint": 2.0})["X.corrected_setpoint"])
        events = [host.slave.doStep(0.0004, 0.0003)[0], host.slave.doStep(0.0007, 0.0003)[0]]
        host.slave.enterEventMode()
        host.time = 0.001
        found.append(host.event({})["X.corrected_setpoint"])
        return found, events


def test_an_event_between_two_cycles_is_heard_by_the_next(third: Path) -> None:
    engine = Engine(three_axes())
    one, two = (engine.step({"X.setpoint": x})["X.corrected_setpoint"] for x in (1.0, 2.0))
    assert in_child(between_cycles, third) == ([one, one, two], [False, True])


TABLES = {
    "X.leadscrew.positions": [-100.0, -20.0, 30.0, 100.0],
    "X.leadscrew.positive": [0.01, -0.02, 0.03, 0.005],
    "X.leadscrew.negative": [0.02, 0.01, 0.0, -0.01],
    "X.friction.velocities": [0.5, 5.0, 50.0],
    "X.friction.currents": [100.0, 60.0, 80.0],
    "Y_ACHSE.cross.positions": [-100.0, 0.0, 100.0],
    "Y_ACHSE.cross.corrections": [0.02, 0.0, 0.04],
    "Y_ACHSE.plane.corrections": [0.01, 0.02, 0.01, 0.0, 0.03, -0.01],
    "Y_ACHSE.leadscrew.positions": [0.0, 50.0, 100.0],
    "Y_ACHSE.leadscrew.positive": [0.0, 0.01, -0.01],
    "Y_ACHSE.friction.velocities": [0.5, 10.0],
    "Y_ACHSE.friction.currents": [40.0, 20.0],
    "C.leadscrew.positions": [0.0, 120.0, 240.0, 360.0],
    "C.leadscrew.positive": [0.001, 0.002, -0.003, 0.001],
}


def read_tables(fmu: Path) -> tuple[dict[str, list[float]], dict[str, tuple[Any, ...]]]:
    with Host3(fmu) as host:
        host.begin()
        names = [name for name, variable in host.variables.items() if variable.dimensions]
        declared = {
            name: (v.causality, v.variability, v.unit, [int(d.start) for d in v.dimensions], v.start)
            for name in names
            for v in (host.variables[name],)
        }
        return {name: host.get(name) for name in names}, declared


def test_the_tables_can_be_read(third: Path) -> None:
    values, declared = in_child(read_tables, third)
    assert values == TABLES
    for name, (causality, variability, unit, shape, start) in declared.items():
        assert (causality, variability) == ("parameter", "tunable")
        assert [float(number) for number in start.split()] == TABLES[name]
        assert shape == ([2, 3] if name.endswith("plane.corrections") else [len(TABLES[name])])
        rotary = name.startswith("C.")
        velocity, current = name.endswith("velocities"), name.endswith("currents")
        assert unit == (None if current else ("deg" if rotary else "mm") + ("/s" if velocity else ""))


CHANGED = {
    "X.leadscrew.positive": [0.02, -0.04, 0.06, 0.01],
    "X.leadscrew.positions": [-90.0, -10.0, 40.0, 110.0],
    "X.friction.currents": [10.0, 20.0, 30.0],
    "Y_ACHSE.cross.corrections": [0.0, 0.1, 0.0],
    "Y_ACHSE.plane.corrections": [0.0, 0.0, 0.1, 0.1, 0.0, 0.0],
    "C.leadscrew.positions": [30.0, 150.0, 270.0, 390.0],
    "C.leadscrew.positive": [0.01, 0.02, -0.03, 0.01],
}


def changed_machine() -> Machine:
    x, y, c = three_axes().axes
    new = CHANGED
    screw = replace(x.leadscrew, positive=new["X.leadscrew.positive"], positions=new["X.leadscrew.positions"])
    x = replace(x, leadscrew=screw, friction=replace(x.friction, currents=(10.0, 20.0, 30.0)))
    plane = replace(y.plane, corrections=((0.0, 0.0, 0.1), (0.1, 0.0, 0.0)))
    y = replace(y, cross=replace(y.cross, corrections=(0.0, 0.1, 0.0)), plane=plane)
    c = replace(c, leadscrew=replace(c.leadscrew, positions=(30.0, 150.0, 270.0), positive=(0.01, 0.02, -0.03)))
    return replace(three_axes(), axes=(x, y, c))


def calibrated(fmu: Path, rows: list[dict[str, Any]], at: int, *, in_steps: bool) -> list[dict[str, Any]]:
    with Host3(fmu) as host:
        host.begin()
        outputs = []
        for k, row in enumerate(rows):
            if k == at and in_steps:
                for name, values in CHANGED.items():
                    host.set({name: [1.5 * value for value in values] if "positi" not in name[2:] else values})
            if k == at:
                references = [host.variables[name].valueReference for name in CHANGED]
                host.slave.setFloat64(references, list(itertools.chain(*CHANGED.values())))
                for name, values in CHANGED.items():
                    assert host.get(name) == values
            outputs.append(host.event(row))
            host.step()
        return outputs


def updated(fmu: Path, rows: list[dict[str, Any]], at: int, path: str) -> list[dict[str, Any]]:
    with Host(fmu) as host:
        host.set({"update_path": path})
        return [host.step({**row, "reload": k >= at}) for k, row in enumerate(rows)]


@pytest.mark.parametrize("at", [0, 57, 120])
def test_a_calibration_blends_in_as_an_update_does_in_every_bit(
    third: Path, native_fmu: Path, at: int, tmp_path: Path
) -> None:
    write_machine(changed_machine(), tmp_path / "lists")
    path = write_image(tmp_path / "lists", tmp_path / "new.bin").path
    rows = trajectory(200)
    expected = in_child(updated, native_fmu, rows, at, str(path))
    assert in_child(calibrated, third, rows, at, in_steps=False) == expected
    assert expected != in_child(updated, native_fmu, rows, 200, str(path))


def over_turns(shift: float) -> Machine:
    """The cross compensation of Y has the axis C for a master, which counts modulo; its table spans half a turn."""
    x, y, c = three_axes().axes
    cross = Cross(3, (-90.0 + shift, 10.0, 90.0 + shift), (0.02, 0.0, 0.04), n_cycles=5)
    return replace(three_axes(), axes=(x, replace(y, cross=cross), c))


def shifted(fmu: Path, rows: list[dict[str, Any]], at: int) -> list[dict[str, Any]]:
    with Host3(fmu) as host:
        host.begin()
        outputs = []
        for k, row in enumerate(rows):
            if k == at:
                host.set({"Y_ACHSE.cross.positions": [-20.0, 10.0, 160.0]})
            outputs.append(host.event(row))
            host.step()
        return outputs


def test_positions_of_an_axis_that_counts_modulo_move_its_turn(native_fmu: Path, tmp_path: Path) -> None:
    assert native_fmu
    for name, shift in (("before", 0.0), ("after", 70.0)):
        write_machine(over_turns(shift), tmp_path / name)
    path = write_image(tmp_path / "after", tmp_path / "new.bin").path
    second, third = (
        package_native(tmp_path / "before", tmp_path / f"{fmi}.fmu", fmi=fmi).path for fmi in ("2.0", "3.0")
    )
    rows = trajectory(400)
    expected = in_child(updated, second, rows, 20, str(path))
    assert in_child(shifted, third, rows, 20) == expected


def behind_an_event(fmu: Path) -> float:
    with Host3(fmu) as host:
        host.begin()
        host.set({"X.setpoint": 50.0})
        host.slave.updateDiscreteStates()
        host.slave.enterStepMode()
        corrected: float = host.get("X.corrected_setpoint")
        return corrected


def test_the_outputs_of_an_event_stay_when_it_is_over(third: Path) -> None:
    assert in_child(behind_an_event, third) == Engine(three_axes()).step({"X.setpoint": 50.0})["X.corrected_setpoint"]


def test_several_changes_in_one_event_are_as_good_as_one(third: Path) -> None:
    rows = trajectory(150)
    once = in_child(calibrated, third, rows, 57, in_steps=False)
    often = in_child(calibrated, third, rows, 57, in_steps=True)
    for one, other in zip(once, often, strict=True):
        assert one == pytest.approx(other, abs=1e-12)


BAD = {
    "X.leadscrew.positions": ([-100.0, 30.0, -20.0, 100.0], "value 2, -20, is not above the one before it"),
    "X.leadscrew.positive": ([0.0, math.nan, 0.0, 0.0], "value 1, nan, is not finite"),
    "X.leadscrew.negative": ([0.0, 0.0, 0.0, math.inf], "value 3, inf, is not finite"),
    "X.friction.velocities": ([-0.5, 5.0, 50.0], "value 0, -0.5, is negative"),
    "X.friction.currents": ([1e300, 0.0, 0.0], "value 0, 1e+300, is too large"),
    "Y_ACHSE.cross.positions": ([0.0, 0.0, 1.0], "value 1, 0, is not above the one before it"),
    "C.leadscrew.positions": ([0.0, 120.0, 240.0, 350.0], "value 3, 350, must lie one turn behind the first"),
}


def refused(fmu: Path) -> tuple[dict[str, list[float]], list[str], list[int], bool]:
    said, statuses = [], []
    with Host3(fmu) as host:
        host.begin({"X.setpoint": 25.0})
        before = host.event({})
        host.step()
        for name, (values, _) in BAD.items():
            with pytest.raises(FMICallException) as refusal:
                host.set({name: values})
            statuses.append(refusal.value.status)
            said.append(host.messages[-1][2])
        # One that is good is not taken beside one that is bad.
        references = [host.variables[name].valueReference for name in ("X.leadscrew.positive", "X.leadscrew.negative")]
        with pytest.raises(FMICallException):
            host.slave.setFloat64(references, [0.5] * 7 + [math.nan])
        with pytest.raises(FMICallException):
            host.slave.setFloat64(references[:1], [0.5] * 3)
        tables = {name: host.get(name) for name in TABLES}
        after = host.event({})
        return tables, said, statuses, before == after


def test_what_makes_no_table_is_refused_with_a_reason_and_changes_nothing(third: Path) -> None:
    tables, said, statuses, same = in_child(refused, third)
    assert tables == TABLES
    assert statuses == [DISCARD] * len(BAD)
    assert same
    for text, (name, (_, why)) in zip(said, BAD.items(), strict=True):
        assert name.partition(".")[2] in text
        assert why in text


def calibrated_states(fmu: Path) -> tuple[list[Any], list[Any], list[float], list[float]]:
    rows = trajectory(90)
    with Host3(fmu) as host:
        host.begin()
        for row in rows[:30]:
            host.event(row)
            host.step()
        host.set({"X.leadscrew.positive": [0.1, 0.2, 0.3, 0.4]})
        state = host.slave.getFMUState()
        time = host.time
        runs = []
        for _ in range(2):
            outputs = []
            for row in rows[30:60]:
                outputs.append(host.event(row))
                host.step()
            runs.append(outputs)
            changed = host.get("X.leadscrew.positive")
            for number in range(50):
                host.set({"X.leadscrew.positive": [float(number), 0.0, 0.0, 0.0]})
            host.slave.setFMUState(state)
            host.time = time
        restored = host.get("X.leadscrew.positive")
        host.slave.freeFMUState(state)
        return runs[0], runs[1], changed, restored


def test_a_state_brings_the_tables_back_that_were_calibrated(third: Path) -> None:
    first, second, changed, restored = in_child(calibrated_states, third)
    assert first == second
    assert changed == restored == [0.1, 0.2, 0.3, 0.4]


def others(fmu: Path) -> list[Any]:
    found: list[Any] = []
    with Host3(fmu, event_mode=False) as host:
        host.set({"X.leadscrew.positive": [0.5] * 4, "X.setpoint": 50.0})
        host.begin()
        host.step()
        found.append(host.get("X.leadscrew.correction"))
        found.append(host.get("time"))
        for call in (host.slave.enterConfigurationMode, host.slave.enterEventMode):
            with pytest.raises(FMICallException):
                call()
        with pytest.raises(FMICallException):
            host.slave.getFloat32([1])
        with pytest.raises(FMICallException):
            host.set({"time": 1.0})
        found.append([text for *_, text in host.messages])
        host.slave.reset()
        host.slave.enterInitializationMode()
        host.begin()
        found.append(host.get("X.leadscrew.positive"))
    return found


def test_what_it_does_not_have_is_an_error_and_a_reset_forgets_calibrations(third: Path) -> None:
    correction, time, said, positive = in_child(others, third)
    assert (correction, time) == (-0.5, 0.001)
    assert len(said) == 4
    assert all(text.startswith("fmi3") for text in said)
    assert positive == TABLES["X.leadscrew.positive"]


COMPILERS = {
    "C99": ["gcc", "-std=c99", "-pedantic"],
    "C++": ["g++", "-x", "c++"],
    "clang": ["clang", "-std=c99", "-pedantic"],
    "the standard's headers": ["gcc", f"-I{HEADERS}"],
}


@pytest.mark.parametrize("compiler", COMPILERS)
def test_its_sources_compile_without_a_warning_and_calibrate_without_a_heap(
    third: Path, compiler: str, tmp_path: Path
) -> None:
    command = COMPILERS[compiler]
    if not shutil.which(command[0]):
        pytest.skip(f"there is no {command[0]} on this machine")
    folder = Path(fmpy.extract(third, tmp_path))
    shutil.rmtree(folder / "resources")
    (library,) = folder.glob("binaries/*/axcomp.*")
    library.unlink()
    (sources,) = fmpy.read_model_description(folder).buildConfigurations[0].sourceFileSets
    options = ["-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-o", str(library)]
    options += [f"-D{one.name}" for one in sources.preprocessorDefinitions]
    run = subprocess.run(
        [command[0], *options, *command[1:], *sources.sourceFiles, "-lm"],
        cwd=folder / "sources",
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    rows = trajectory(80)
    assert in_child(calibrated_in, folder, rows) == in_child(calibrated, third, rows, 57, in_steps=False)


def calibrated_in(folder: Path, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    outputs = []
    with Host3(folder, folder=folder) as host:
        host.begin()
        for k, row in enumerate(rows):
            if k == 57:
                host.set(CHANGED)
            outputs.append(host.event(row))
            host.step()
    return outputs


def test_both_versions_can_be_asked_for_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lists = str(models() / "rotary_table")
    try:
        assert main(["build", "--machine", lists, "--output", str(tmp_path / "m.fmu"), "--fmi", "3.0", "2.0"]) == 0
    except NoCompilerError as error:
        pytest.skip(str(error))
    versions = {path.name: fmpy.read_model_description(path).fmiVersion for path in tmp_path.glob("*.fmu")}
    assert versions == {"m.fmu": "2.0", "m_fmi3.fmu": "3.0"}
    assert main(["build", "--machine", lists, "--output", str(tmp_path / "n.fmu"), "--fmi", "3.0"]) == 0
    assert fmpy.read_model_description(tmp_path / "n.fmu").fmiVersion == "3.0"
    arguments = [
        "build",
        "--machine",
        lists,
        "--output",
        str(tmp_path / "p.fmu"),
        "--fmi",
        "3.0",
        "--runtime",
        "python",
    ]
    assert main(arguments) == 1
    assert "pythonfmu knows FMI 2.0 only" in capsys.readouterr().err
