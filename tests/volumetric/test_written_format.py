"""A compensation is written in the format its parameters came in, where that can hold them."""

from __future__ import annotations

from pathlib import Path

import pytest
from rigid_bodies import machine_of, volumetric

from axcomp.lists import read_machine, write_machine
from axcomp.model import ErrorTable, Interpolation

NODES = ((-10.0,), (0.0,), (10.0,))
OWN = ErrorTable("EXX", (1e-3, 0.0, -2e-3), "X", NODES)
OTHER = ErrorTable("EYX", (1e-3, 0.0, -2e-3), "Z", NODES, Interpolation.GRID)


@pytest.mark.parametrize(
    ("files", "error", "written"),
    [
        ((), OWN, "vol_comp0.csv"),
        (("machine.csv", ""), OWN, "vol_comp0.csv"),
        (("MACHINE.EXC", ""), OWN, "vol_comp0.exc"),
        (("a.exc", "b.exc"), OWN, "vol_comp0.exc"),
        (("a.exc", "b.csv"), OWN, "vol_comp0.csv"),
        (("a.exc",), OTHER, "vol_comp0.csv"),
    ],
)
def test_what_was_an_etalon_file_becomes_one_again(
    files: tuple[str, ...], error: ErrorTable, written: str, tmp_path: Path
) -> None:
    machine = machine_of(volumetric("XYZ", errors=(error,), files=files, tool_orientation=(0.0, 0.0, -1.0)))
    names = {path.name for path in write_machine(machine, tmp_path)}
    assert {name for name in names if not name.endswith(".lis")} == {written}
    reading = read_machine(tmp_path)
    assert reading.findings == ()
    assert reading.machine == machine
