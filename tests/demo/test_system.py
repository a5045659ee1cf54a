"""The example machine as a system of SSP: valid, and the same in its importers as in the demonstration's own loop."""

from __future__ import annotations

import multiprocessing
import zipfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy import ssp
from fmu_host import in_child
from lxml import etree

from axcomp.cli import main
from axcomp.demo import Batch, Simulation, couple, write_ssp
from axcomp.demo.examples import INPUT, read_csv
from axcomp.engine import Engine
from axcomp.fmu import BuildError, NoCompilerError
from axcomp.model import models
from axcomp.plant import Plant

SCHEMAS = Path(ssp.__file__).parent / "schema"
SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
CYCLE = 0.001
STEPS = 400
AXES = ("X", "Y", "Z")
FRICTION = ("X", "Y", "Z")


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    try:
        return write_ssp(models() / "three_axis", tmp_path_factory.mktemp("ssp")).path
    except NoCompilerError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("name", ["three_axis", "five_axis"])
def test_the_schemas_find_nothing_and_every_connector_is_connected(name: str, tmp_path: Path) -> None:
    try:
        path = write_ssp(models() / name, tmp_path / "m.ssp").path
    except NoCompilerError as error:
        pytest.skip(str(error))
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    for file, schema in (
        ("SystemStructure.ssd", "SystemStructureDescription.xsd"),
        ("resources/parameters.ssv", "SystemStructureParameterValues.xsd"),
    ):
        found = etree.XMLSchema(etree.parse(str(SCHEMAS / schema)))
        assert found.validate(etree.fromstring(files[file])), found.error_log
    root = ElementTree.fromstring(files["SystemStructure.ssd"])
    (system,) = root.iter(f"{SSD}System")
    assert system.find(f"{SSD}Connectors") is None
    connected = set()
    for one in root.iter(f"{SSD}Connection"):
        connected.add((one.attrib["startElement"], one.attrib["startConnector"], "output"))
        connected.add((one.attrib["endElement"], one.attrib["endConnector"], "input"))
    listed = {
        (component.attrib["name"], connector.attrib["name"], connector.attrib["kind"])
        for component in root.iter(f"{SSD}Component")
        for connector in component.iter(f"{SSD}Connector")
    }
    assert listed == connected
    units = set()
    for component in root.iter(f"{SSD}Component"):
        fmu = tmp_path / Path(component.attrib["source"]).name
        fmu.write_bytes(files[component.attrib["source"]])
        variables = {v.name: v for v in fmpy.read_model_description(fmu).modelVariables}
        for connector in component.iter(f"{SSD}Connector"):
            variable = variables[connector.attrib["name"]]
            assert variable.causality == connector.attrib["kind"]
            assert connector[0].tag.endswith(variable.type)
            assert connector[0].get("unit") == variable.unit
            units.add(variable.unit)
    defined = {unit.get("name") for unit in root.iter() if unit.tag.endswith("}Unit")}
    assert defined == units - {None}


def recorded_by_fmpy(path: Path) -> dict[str, list[float]]:
    from fmpy.ssp.simulation import simulate_ssp
    from fmpy.ssp.ssd import read_ssv

    parameters = read_ssv(path, "resources/parameters.ssv")
    found = simulate_ssp(path, stop_time=STEPS * CYCLE - CYCLE / 2, step_size=CYCLE, parameter_set=parameters)
    return {name: found[name].tolist() for name in found.dtype.names}


def coupled(path: Path, folder: Path) -> list[list[float]]:
    """True positions of the axes at the end of each step in the demonstration's own loop."""
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    for name in ("axcomp", "plant"):
        fmpy.extract(folder / "resources" / f"{name}.fmu", folder / name)
    given = read_csv(models() / "three_axis" / INPUT)
    names = [f"{axis}.{name}" for name in ("setpoint", "velocity", "acceleration") for axis in AXES]
    commands = np.column_stack([given[name] for name in names])[:STEPS]
    batch = Batch(AXES, FRICTION, CYCLE, None, ())
    shown: list[list[float]] = couple(folder, batch, Simulation(commands, ()))[:, : len(AXES)].tolist()
    return shown


@pytest.fixture(scope="module")
def expected(machine: Path, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray[Any, Any]:
    return np.array(in_child(coupled, machine, tmp_path_factory.mktemp("coupled")))


def test_fmpy_runs_it(machine: Path, expected: np.ndarray[Any, Any]) -> None:
    found = in_child(recorded_by_fmpy, machine)
    # A step takes what was given at the end of the one before it.
    engine = Engine(models() / "three_axis")
    given = [name.removeprefix("axcomp.") for name in found if name.startswith("axcomp.")]
    inputs = [v.name for v in engine.variables if v.causality == "input" and v.name in given]
    outputs = [v.name for v in engine.variables if v.causality == "output" and v.name in given]
    assert (len(inputs), len(outputs)) == (12, 6)
    rows = [dict.fromkeys(inputs, 0.0)]
    rows += [{name: found[f"axcomp.{name}"][k] for name in inputs} for k in range(STEPS - 1)]
    for k, row in enumerate(rows):
        computed = engine.step(row)
        assert {name: computed[name] for name in outputs} == {name: found[f"axcomp.{name}"][k] for name in outputs}
    plant = Plant.from_file(models() / "three_axis" / "plant.json")
    plant.rest_at([float(read_csv(models() / "three_axis" / INPUT)[f"{axis}.setpoint"][0]) for axis in AXES])
    for k in range(STEPS):
        setpoints, currents = (
            [found[f"plant.{axis}.{name}"][k - 1] if k else 0.0 for axis in AXES] for name in ("setpoint", "current")
        )
        plant.step(setpoints, currents, CYCLE)
        measured = [drive.position for drive in plant.drives]
        assert measured == [found[f"plant.{axis}.measured_position"][k] for axis in AXES]
    # FMPy lets the first step begin with zeros: the drives have settled after 0.3 s.
    for axis, column in zip(AXES, expected.T, strict=True):
        assert np.allclose(found[f"plant.{axis}.measured_position"][300:], column[300:], atol=0.1)


LIBCOSIM = "libcosimpy.CosimExecution"


def recorded_by_libcosim(path: Path, references: list[int]) -> list[list[float]]:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    execution = CosimExecution.from_ssp_file(str(path), step_size=int(CYCLE * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    plant = execution.slave_index_from_instance_name("plant")
    rows = []
    for _ in range(STEPS):
        execution.step()
        rows.append(list(observer.last_real_values(plant, references)))
    return rows


def recorded_by_ecos(path: Path, names: list[str]) -> list[list[float]]:
    from ecospy import EcosSimulation

    with EcosSimulation(ssp_path=str(path), step_size=CYCLE) as simulation:
        simulation.init()
        rows = []
        for _ in range(STEPS):
            simulation.step(1)
            rows.append([simulation.get_real(f"plant::{name}") for name in names])
        return rows


def alone(function: Any, *arguments: Any) -> Any:
    """Call a function in a process that has loaded no other FMU: an importer may not like what one has left there."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(function, *arguments).result(timeout=120)


def needs(module: str) -> None:
    """Skip a test whose importer is not installed, or lacks a library of the system."""
    try:
        __import__(module)
    except (ImportError, OSError) as error:
        pytest.skip(f"{module} cannot be loaded: {error}")


def test_libcosim_runs_it_as_the_demonstration_does(machine: Path, expected: np.ndarray[Any, Any]) -> None:
    needs(LIBCOSIM)
    with zipfile.ZipFile(machine) as archive, archive.open("resources/plant.fmu") as fmu:
        variables = {v.name: v for v in fmpy.read_model_description(fmu).modelVariables}
    references = [variables[f"{axis}.true_position"].valueReference for axis in AXES]
    found = alone(recorded_by_libcosim, machine, references)
    assert np.allclose(found, expected, rtol=0.0, atol=1e-9)


def test_ecos_runs_it_as_the_demonstration_does(machine: Path, expected: np.ndarray[Any, Any]) -> None:
    needs("ecospy")
    found = alone(recorded_by_ecos, machine, [f"{axis}.true_position" for axis in AXES])
    assert np.allclose(found, expected, rtol=0.0, atol=1e-9)


def test_the_command_writes_it_and_says_what_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["build", "--ssp"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["machine.ssp"]
    assert "machine.ssp: 37 inputs" in capsys.readouterr().out
    lists = tmp_path / "achskw1.lis"
    lists.write_text("kopf.achs_nr 1\nEnd\n")
    assert main(["build", "--machine", str(lists), "--ssp", "other.ssp"]) == 1
    assert "plant.json" in capsys.readouterr().err
    (tmp_path / "plant.json").write_bytes((models() / "three_axis" / "plant.json").read_bytes())
    with pytest.raises(BuildError, match="The plant has no axis axis1"):
        write_ssp(lists, tmp_path)
    (tmp_path / INPUT).write_text('"time","W.setpoint"\n0,1\n')
    with pytest.raises(BuildError, match="the machine has no input W"):
        write_ssp(lists, tmp_path)
