"""Importers that are not the project's own run the example machine with the bits of the engine.

They come with the extra ``importers``; what is not installed is skipped. ecospy needs oneTBB of the system (libtbb12).
"""

from __future__ import annotations

import multiprocessing
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import fmpy
import numpy as np
import pytest

from axcomp.demo.examples import INPUT, read_csv
from axcomp.engine import Engine
from axcomp.fmu import NoCompilerError, package_native
from axcomp.model import models

MODEL = models() / "three_axis"
CYCLE = 0.001
CYCLES = 200
SHOWN = ("X.corrected_setpoint", "Y.corrected_setpoint", "Z.corrected_setpoint", "Z.current")

Rows = list[dict[str, float]]
Found = list[list[float]]


def references(fmu: Path) -> dict[str, int]:
    return {v.name: v.valueReference for v in fmpy.read_model_description(fmu).modelVariables}


def ecos(fmu: Path, rows: Rows) -> Found:
    from ecospy import EcosSimulation, EcosSimulationStructure

    structure = EcosSimulationStructure()
    structure.add_model("m", str(fmu))
    found = []
    with EcosSimulation(structure=structure, step_size=CYCLE) as simulation:
        simulation.init()
        for row in rows:
            for name, value in row.items():
                simulation.set_real(f"m::{name}", value)
            simulation.step(1)
            found.append([simulation.get_real(f"m::{name}") for name in SHOWN])
    return found


def libcosim(fmu: Path, rows: Rows) -> Found:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    known = references(fmu)
    execution = CosimExecution.from_step_size(CYCLE * 1e9)
    slave = execution.add_local_slave(CosimLocalSlave(str(fmu), "m"))
    given, shown = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(given)
    execution.add_observer(shown)
    found = []
    for row in rows:
        if row:
            given.slave_real_values(slave, [known[name] for name in row], list(row.values()))
        execution.step()
        found.append(list(shown.last_real_values(slave, [known[name] for name in SHOWN])))
    return found


def fmuloader(fmu: Path, rows: Rows) -> Found:
    from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

    known = references(fmu)
    slave = Fmi2Slave(fmu, model_identifier="axcomp")
    slave.instantiate("m", Fmi2Type(1), guid=fmpy.read_model_description(fmu).guid)
    slave.setup_experiment(start_time=0.0)
    slave.enter_initialization_mode()
    slave.exit_initialization_mode()
    found = []
    for k, row in enumerate(rows):
        slave.set_real([known[name] for name in row], list(row.values()))
        slave.do_step(k * CYCLE, CYCLE)
        found.append(slave.get_real([known[name] for name in SHOWN]))
    slave.terminate()
    slave.free_instance()
    return found


def fmuloader_events(fmu: Path, rows: Rows) -> Found:
    from fmuloader.fmi3 import Fmi3Slave

    known = references(fmu)
    slave = Fmi3Slave(fmu, model_identifier="axcomp")
    token = fmpy.read_model_description(fmu).guid
    slave.instantiate_co_simulation("m", instantiation_token=token, event_mode_used=True)
    slave.enter_initialization_mode(start_time=0.0)
    slave.exit_initialization_mode()
    found = []
    for k, row in enumerate(rows):
        slave.set_float64([known[name] for name in row], list(row.values()))
        slave.update_discrete_states()
        found.append(slave.get_float64([known[name] for name in SHOWN]))
        slave.enter_step_mode()
        slave.do_step(k * CYCLE, CYCLE)
        slave.enter_event_mode()
    slave.terminate()
    slave.free_instance()
    return found


def pathsim(fmu: Path, rows: Rows) -> Found:
    from pathsim_fmi import CoSimulationFMU

    outputs = [v.name for v in fmpy.read_model_description(fmu).modelVariables if v.causality == "output"]
    wrapper = CoSimulationFMU(str(fmu)).fmu_wrapper
    found = []
    for k, row in enumerate(rows):
        for name, value in row.items():
            wrapper.set_variable(name, value)
        wrapper.do_step(k * CYCLE, CYCLE)
        values = wrapper.get_outputs_as_array()
        found.append([float(values[outputs.index(name)]) for name in SHOWN])
    return found


def syssimx(fmu: Path, rows: Rows) -> Found:
    from syssimx import FMUComponent

    component = FMUComponent("m", str(fmu))
    component.initialize(0.0)
    found = []
    for k, row in enumerate(rows):
        component.set_inputs(row)
        component.do_step(k * CYCLE, CYCLE)
        values = component.get_outputs()
        found.append([float(getattr(values[name], "magnitude", values[name])) for name in SHOWN])
    return found


def estim8(fmu: Path, rows: Rows) -> Found:
    """It gives start values and no inputs over time: those of the first row stay."""
    warnings.simplefilter("ignore")
    from estim8.models import FmuModel

    simulation = FmuModel(str(fmu), fmi_type="CoSimulation").simulate(
        0.0, len(rows) * CYCLE, CYCLE, parameters=rows[0], observe=list(SHOWN)
    )
    return np.array([simulation[name].values for name in SHOWN]).T[1:].tolist()


class Importer(NamedTuple):
    module: str
    run: Callable[[Path, Rows], Found]
    options: dict[str, str]


REAL, THIRD = {"types": "real"}, {"fmi": "3.0"}
IMPORTERS = {
    "ecos": Importer("ecospy", ecos, {}),
    "libcosim": Importer("libcosimpy.CosimExecution", libcosim, {}),
    "fmuloader": Importer("fmuloader.fmi2", fmuloader, {}),
    "fmuloader, FMI 3.0": Importer("fmuloader.fmi3", fmuloader_events, THIRD),
    "pathsim-fmi": Importer("pathsim_fmi", pathsim, REAL),
    "pathsim-fmi, FMI 3.0": Importer("pathsim_fmi", pathsim, REAL | THIRD),
    "syssimx": Importer("syssimx", syssimx, {}),
    "estim8": Importer("estim8", estim8, REAL),
}


@pytest.mark.parametrize("unset", [False, True], ids=["inputs", "no input set"])
@pytest.mark.parametrize("name", IMPORTERS)
def test_an_importer_gives_the_bits_of_the_engine(name: str, unset: bool, tmp_path: Path) -> None:
    module, run, options = IMPORTERS[name]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import_module(module)
    except (ImportError, OSError) as error:
        pytest.skip(f"{module} cannot be loaded: {error}")
    try:
        fmu = package_native(MODEL, tmp_path / "m.fmu", **options).path  # type: ignore[arg-type]
    except NoCompilerError as error:
        pytest.skip(str(error))
    columns = read_csv(MODEL / INPUT)
    del columns["time"]
    rows: Rows = [{k: float(column[i]) for k, column in columns.items()} for i in range(CYCLES)]
    if unset:
        rows = [{} for _ in rows]
    elif name == "estim8":
        rows = rows[:1] * CYCLES
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        found = pool.submit(run, fmu, rows).result(timeout=120)
    engine = Engine(MODEL)
    assert found == [[outputs[name] for name in SHOWN] for outputs in map(engine.step, rows)]
