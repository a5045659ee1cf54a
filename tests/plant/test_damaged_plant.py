"""A plant.json damaged in the unpacked FMU: told in the log and on standard error, never raised to the host."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import fmpy
import pytest

from axcomp.model import models
from axcomp.plant import package_plant

DRIVE = """
import sys
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

folder = sys.argv[1]
description = read_model_description(folder)
references = {v.name: v.valueReference for v in description.modelVariables}
callbacks = fmi2CallbackFunctions()
callbacks.logger = fmi2CallbackLoggerTYPE(lambda _, name, status, category, text: print("log", status, text.decode()))
callbacks.allocateMemory = defaultCallbacks.allocateMemory
callbacks.freeMemory = defaultCallbacks.freeMemory
fmu = FMU2Slave(guid=description.guid, modelIdentifier="plant", unzipDirectory=folder, instanceName="test")
fmu.instantiate(callbacks=callbacks, loggingOn=True)
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.setReal([references["C.setpoint"]], [30.0])
fmu.exitInitializationMode()
for cycle in range(5):
    fmu.setReal([references["C.setpoint"], references["C.current"]], [30.0 + cycle, 1.0])
    fmu.doStep(cycle * 1e-3, 1e-3)
state = fmu.getFMUstate()
fmu.setFMUstate(state)
print("outputs", fmu.getReal([v.valueReference for v in description.modelVariables if v.causality == "output"]))
fmu.terminate()
print("done", flush=True)
"""

DAMAGES = {
    "cut off": lambda text: text[: len(text) // 2],
    "empty": lambda text: "",  # noqa: ARG005
    "no text": lambda text: "\udcff\udcfe" + text,
    "a list": lambda text: f"[{text}]",
    "an axis that is none": lambda text: text.replace('"axes": [', '"axes": [7, '),
    "no number": lambda text: text.replace('"inertia": 3.0', '"inertia": NaN'),
    "a word": lambda text: text.replace('"inertia": 3.0', '"inertia": "100 %s"'),
    "nothing divided by": lambda text: text.replace('"sub_step": 0.0002', '"sub_step": 0'),
}


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGES)
def test_outputs_hold_0_and_the_host_lives(damage: str, tmp_path: Path) -> None:
    folder = Path(fmpy.extract(package_plant(models() / "rotary_table", tmp_path), tmp_path / "unpacked"))
    description = folder / "resources" / "plant.json"
    text = description.read_text(encoding="utf-8")
    damaged = DAMAGES[damage](text)
    assert damaged != text
    description.write_bytes(damaged.encode("utf-8", "surrogateescape"))
    result = subprocess.run([sys.executable, "-c", DRIVE, str(folder)], capture_output=True, text=True, check=False)
    # The process may abort while it exits: what it has said before counts.
    lines = result.stdout.splitlines()
    assert "outputs [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]" in lines, result.stderr
    assert lines[-1] == "done"
    told = [line for line in lines if line.startswith("log")]
    assert len(told) == 1
    assert told[0].startswith("log 3 PlantError: ")
    assert "plant.json" in told[0]
    assert result.stderr.count("plant.json") == 1
