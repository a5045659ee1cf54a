"""A host that sets all the inputs it does not know to 0 gets, bit for bit, what one that sets none of them gets."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from fmu_host import Host, in_child

from axcomp.demo.examples import INPUT, TRAJECTORIES, read_csv
from axcomp.fmu import package_axcomp, package_native
from axcomp.interface import Types
from axcomp.model import models

CYCLES = 150
MOVING = ("setpoint", "velocity", "acceleration", "actual_position")


def run(fmu: Path, columns: dict[str, list[float]], *, zeros: bool) -> list[dict[str, Any]]:
    with Host(fmu) as host:
        kinds = {"Real": float, "Integer": int, "Boolean": bool}
        others = [v for v in host.variables.values() if v.causality == "input" and v.name not in columns]
        host.set({v.name: kinds[v.type](0) for v in others} if zeros else {})
        assert all(float(v.start == "true" if v.type == "Boolean" else v.start) == 0.0 for v in others)
        return host.run(dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True))


@pytest.mark.parametrize(("runtime", "types"), [("native", "own"), ("native", "real"), ("python", "own")])
@pytest.mark.parametrize("name", sorted(TRAJECTORIES))
def test_zeros_are_as_good_as_nothing(native_fmu: Path, name: str, runtime: str, types: Types, tmp_path: Path) -> None:
    assert native_fmu
    package = package_native if runtime == "native" else package_axcomp
    fmu = package(models() / name, tmp_path, types=types).path
    given = {n: v for n, v in read_csv(models() / name / INPUT).items() if n.rpartition(".")[2] in MOVING}
    columns = {n: v[:CYCLES].tolist() for n, v in given.items()}
    unset = in_child(run, fmu, columns, zeros=False)
    assert repr(unset) == repr(in_child(run, fmu, columns, zeros=True))
    assert any(value for output, value in unset[-1].items() if output.endswith(".active"))
