"""``axcomp build --no-lists --types real --naming flat``, alone and together, in FMPy."""

from __future__ import annotations

import shutil
import zipfile
from itertools import product
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.validation import validate_fmu
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.cli import main
from axcomp.engine import Engine
from axcomp.fmu import write_image
from axcomp.lists import write_machine

Rows = list[dict[str, Any]]


def flat(name: str) -> str:
    return name.replace(".", "_").replace("[", "_").replace("]", "")


def run_rows(fmu: Path, rows: Rows) -> Rows:
    with Host(fmu) as host:
        return host.run(rows)


def built(folder: Path, lists: Path, *options: str) -> Path:
    assert main(["build", "--machine", str(lists), "--output", str(folder / "machine.fmu"), *options]) == 0
    return folder / "machine.fmu"


CHOICES = [
    (runtime, naming, types, lists)
    for runtime, naming, types, lists in product(
        ("native", "python"), ("structured", "flat"), ("own", "real"), ("", "--no-lists")
    )
    if not (runtime == "python" and lists)
]


@pytest.mark.parametrize(("runtime", "naming", "types", "no_lists"), CHOICES)
def test_it_is_valid_and_gives_the_bits_of_the_engine(
    native_fmu: Path, lists: Path, tmp_path: Path, runtime: str, naming: str, types: str, no_lists: str
) -> None:
    assert native_fmu
    options = ["--runtime", runtime, "--naming", naming, "--types", types, *filter(None, [no_lists])]
    fmu = built(tmp_path, lists, *options)
    assert validate_fmu(str(fmu)) == []
    kinds = {v.type for v in fmpy.read_model_description(fmu).modelVariables}
    assert kinds == ({"Real"} if types == "real" else {"Real", "Boolean", "Integer", "String"})
    rows = trajectory(250)
    engine = Engine(three_axes())
    expected = [engine.step(row) for row in rows]
    rename = flat if naming == "flat" else str
    convert = float if types == "real" else (lambda value: value)
    given = [{rename(name): convert(value) for name, value in row.items()} for row in rows]
    found = in_child(run_rows, fmu, given)
    assert found == [{rename(name): convert(value) for name, value in row.items()} for row in expected]


def test_without_lists_nothing_of_them_is_in_the_fmu(native_fmu: Path, lists: Path, tmp_path: Path) -> None:
    assert native_fmu
    with zipfile.ZipFile(built(tmp_path, lists, "--no-lists")) as archive:
        names = archive.namelist()
        texts = b"".join(archive.read(name) for name in names if not name.startswith(("binaries", "sources/kernel")))
    assert [name for name in names if name.startswith("resources/")] == ["resources/tables.bin"]
    for path in lists.glob("*.lis"):
        assert path.name.encode() not in texts
    assert b"kw." not in texts


def test_without_lists_it_cannot_run_in_python(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["build", "--machine", str(lists), "--output", str(tmp_path / "a.fmu"), "--no-lists"]
    assert main([*command, "--runtime", "python"]) == 1
    assert "--no-lists is for the native FMU" in capsys.readouterr().err
    assert not (tmp_path / "a.fmu").exists()


def switch_as_real(fmu: Path, new: str, own: str) -> list[Any]:
    """There is no update_path: ``reload`` reads what lies in the FMU's own resources."""
    found: list[Any] = []
    with Host(fmu) as host:
        for value in (0.0, -1.0, 1.0, -0.6, 0.4, float("nan"), 7.0):
            row = host.step({"X.leadscrew.switch": value, "X.fault": value})
            found.append((host.get("X.leadscrew.switch"), host.get("X.fault"), row["X.error"]))
        host.step({"reset": 1.0, "X.leadscrew.switch": 0.0})
        before = host.step({"reset": 0.0, "X.setpoint": 40.0})["X.corrected_setpoint"]
        target = host.folder / "resources" / own
        if target.is_dir():
            shutil.copytree(new, target, dirs_exist_ok=True)
        else:
            shutil.copy(new, target)
        host.step({"reload": 1.0})
        for _ in range(30):
            row = host.step()
        found += [row["X.error"], row["X.corrected_setpoint"] - before]
    return found


@pytest.mark.parametrize("runtime", ["native", "python"])
def test_a_real_switches_and_reloads(native_fmu: Path, lists: Path, tmp_path: Path, runtime: str) -> None:
    assert native_fmu
    write_machine(three_axes(2.0), tmp_path / "other")
    image = tmp_path / "other.bin"
    write_image(tmp_path / "other", image)
    update = image if runtime == "native" else tmp_path / "other"
    fmu = built(tmp_path, lists, "--types", "real", "--runtime", runtime)
    *switched, error, change = in_child(
        switch_as_real, fmu, str(update), "tables.bin" if runtime == "native" else "machine"
    )
    largest = float(2**31 - 1)
    assert switched == [
        (0.0, 0.0, 0.0),
        (-1.0, 1.0, 0.0),
        (1.0, 1.0, 0.0),
        (-1.0, 1.0, 0.0),
        (0.0, 0.0, 0.0),
        (largest, 0.0, 904.0),
        (7.0, 1.0, 904.0),
    ]
    assert error == 0.0
    assert abs(change) > 1e-4
