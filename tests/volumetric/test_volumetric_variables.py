from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy.model_description import read_model_description
from rigid_bodies import machine_of, volumetric

from axcomp.engine import Engine
from axcomp.fmu import Description, model_description
from axcomp.interface import Naming, by_name, variables_of
from axcomp.model import ErrorTable, Interpolation, Machine

DESCRIPTION = Description("axcomp", "Corrects", 0.001, "1.0")


def machine() -> Machine:
    along_x = ErrorTable("EYX", (0.0, 0.05, -0.02), "X", ((0.0,), (50.0,), (100.0,)), Interpolation.GRID)
    errors = (along_x, ErrorTable("EBX", (1e-4,)), ErrorTable("Z0C", (0.02,)))
    first = volumetric("CXYZ", errors=errors, tool_orientation=(0.0, 0.0, -1.0))
    return machine_of(first, volumetric("XYZ", index=3, errors=(along_x,), manual_activation=True))


def test_the_variables_are_there_where_there_is_a_volumetric_compensation() -> None:
    found = by_name(variables_of(machine()))
    assert {"tool_length", "volumetric[0].switch", "volumetric[3].reduction_z", "volumetric[3].active"} <= set(found)
    assert {"X.volumetric.correction", "Z.stop_request"} <= set(found)
    assert not {"C.volumetric.correction", "A.stop_request", "volumetric[1].switch"} & set(found)
    assert (found["tool_length"].unit, found["X.volumetric.correction"].unit) == ("mm", "mm")
    assert found["volumetric[3].switch"].reference == 64 * 36
    plain = by_name(variables_of(machine_of()))
    assert not {name for name in plain if "volumetric" in name or "tool" in name or "stop" in name}


@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_fmpy_takes_the_names(naming: Naming, tmp_path: Path) -> None:
    text = model_description(DESCRIPTION, variables_of(machine(), naming), "{guid}")
    path = tmp_path / "modelDescription.xml"
    path.write_bytes(text)
    read = read_model_description(str(path), validate=True, validate_variable_names=True, validate_model_structure=True)
    names = {variable.name for variable in read.modelVariables}
    assert ("volumetric[3].no_move" if naming == "structured" else "volumetric_3_no_move") in names


def test_corrections_depend_on_the_setpoints_of_all_their_axes() -> None:
    found = by_name(variables_of(machine()))
    for name in ("Y.volumetric.correction", "Y.corrected_setpoint", "Y.error", "volumetric[0].active"):
        needed = set(found[name].depends_on or ())
        assert {"X.setpoint", "C.setpoint", "C.fault", "tool_length", "volumetric[0].reduction_y", "reset"} <= needed
        assert "A.setpoint" not in needed
    assert "C.setpoint" not in set(found["volumetric[3].active"].depends_on or ())


def test_a_run_is_as_many_steps() -> None:
    n = 120
    trajectory = {
        "X.setpoint": np.linspace(0.0, 100.0, n),
        "C.setpoint": np.linspace(350.0, 370.0, n),
        "volumetric[3].switch": np.where(np.arange(n) > 20, 1, 0),
        "volumetric[3].reduction_y": np.full(n, 0.5),
        "volumetric[0].switch": np.where(np.arange(n) < 70, 0, -1),
        "volumetric[0].no_move": np.arange(n) > 60,
        "tool_length": np.full(n, 80.0),
    }
    result = Engine(machine()).run(trajectory)
    engine = Engine(machine())
    rows = zip(*(column.tolist() for column in trajectory.values()), strict=True)
    steps = [engine.step(dict(zip(trajectory, row, strict=True))) for row in rows]
    for name in steps[0]:
        assert result[name].tolist() == [step[name] for step in steps]
    assert np.abs(result["X.volumetric.correction"]).max() > 1e-3
    assert result["volumetric[3].active"].tolist() == [i > 20 for i in range(n)]
