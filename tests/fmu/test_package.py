"""What goes into an FMU."""

from __future__ import annotations

import importlib.util
import json
import shutil
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmu_machines import three_axes

from axcomp.fmu import BuildError, package_axcomp
from axcomp.kinds import Leadscrew
from axcomp.lists import read_machine, write_machine
from axcomp.model import Axis, Machine
from axcomp.plant import package_plant


def contents(fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_building_twice_gives_the_same_bytes(lists: Path, tmp_path: Path) -> None:
    shutil.copytree(lists, tmp_path / "elsewhere" / "lists", copy_function=shutil.copy)
    one = package_axcomp(lists, tmp_path / "one.fmu").path
    two = package_axcomp(tmp_path / "elsewhere" / "lists" / "hochlauf.lis", tmp_path / "two.fmu").path
    first, second = contents(one), contents(two)
    assert json.loads(first.pop("resources/axcomp.json"))["lists"] == "machine"
    assert json.loads(second.pop("resources/axcomp.json"))["lists"] == "machine/hochlauf.lis"
    for name in ("modelDescription.xml", "documentation/bom.cdx.json"):
        assert first.pop(name) != second.pop(name)
    assert first == second
    again = package_axcomp(lists, tmp_path / "again.fmu").path
    assert one.read_bytes() == again.read_bytes()


def test_the_guid_follows_the_contents(fmu: Path, lists: Path, tmp_path: Path) -> None:
    shutil.copytree(lists, tmp_path, dirs_exist_ok=True)
    with (tmp_path / "achskw1.lis").open("a", encoding="utf-8") as file:
        file.write("# one more comment\n")
    other = package_axcomp(tmp_path, tmp_path / "other.fmu").path
    assert fmpy.read_model_description(other).guid != fmpy.read_model_description(fmu).guid


def test_the_guid_follows_the_model_description(fmu: Path, lists: Path, tmp_path: Path) -> None:
    """All else in the three FMUs is the same: names of variables, and what a host is told, belong to the model."""
    others = [
        package_axcomp(lists, tmp_path / "flat.fmu", naming="flat").path,
        package_axcomp(lists, tmp_path / "alone.fmu", external_tool=False).path,
    ]
    named = dict.fromkeys(
        (
            "modelDescription.xml",
            "documentation/bom.cdx.json",
            "documentation/index.html",
            "terminalsAndIcons/terminalsAndIcons.xml",
        ),
        b"",
    )
    first, *rest = (contents(path) | named for path in (fmu, *others))
    assert rest == [first, first]
    assert len({fmpy.read_model_description(path).guid for path in (fmu, *others)}) == 3


def test_lists_lie_to_each_other_as_they_do_on_disk(tmp_path: Path) -> None:
    project = tmp_path / "private" / "project"
    write_machine(three_axes(), project / "lists")
    (project / "start").mkdir()
    text = (project / "lists" / "hochlauf.lis").read_text(encoding="utf-8")
    text = text.replace("achs", "..\\lists\\achs").replace("..\\lists\\achs_", "achs_")
    (project / "start" / "hochlauf.lis").write_text(text, encoding="utf-8")
    (project / "lists" / "hochlauf.lis").unlink()
    (project / "start" / "readme.txt").write_text("not part of it", encoding="utf-8")
    assert read_machine(project / "start", allow_outside=[project]).machine == three_axes()

    files = contents(package_axcomp(project / "start", tmp_path / "x.fmu", allow_outside=[project]).path)
    names = {name for name in files if name.startswith("resources/machine/")}
    assert names == {
        "resources/machine/start/hochlauf.lis",
        *(f"resources/machine/lists/achskw{i}.lis" for i in (1, 2, 3)),
        *(f"resources/machine/lists/achsmd{i}.lis" for i in (1, 2, 3)),
    }
    for name in names:
        path = tmp_path / "unpacked" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(files[name])
    place = json.loads(files["resources/axcomp.json"])["lists"]
    resources = tmp_path / "unpacked" / "resources"
    assert read_machine(resources / place, allow_outside=[resources / "machine"]).machine == three_axes()
    assert not [name for name, data in files.items() if str(tmp_path).encode() in data or b"private" in data]


@pytest.mark.parametrize("name", ["{}/elsewhere/kw.lis", "../cnc/sub/kw.lis", "../elsewhere/kw.lis"])
def test_what_is_named_anyhow_and_allowed_is_found_again_in_an_fmu(name: str, tmp_path: Path) -> None:
    for place in ("elsewhere", "cnc/sub"):
        (tmp_path / place).mkdir(parents=True)
        (tmp_path / place / "kw.lis").write_text("kopf.achs_nr 1\nfrict_comp.mode 3\nfrict_comp.table_entries 1\n")
    start = tmp_path / "cnc" / "hochlauf.lis"
    start.write_text(f"zahl_kw 1\nachs_kw[0] {name.format(tmp_path)}\n", encoding="utf-8")
    with pytest.raises(BuildError, match="AXC-FOLDER"):
        package_axcomp(start, tmp_path / "x.fmu")
    allowed = [tmp_path / "cnc", tmp_path / "elsewhere"]
    files = contents(package_axcomp(start, tmp_path / "x.fmu", allow_outside=allowed).path)
    for path in (path for path in files if path.startswith("resources/machine/")):
        (tmp_path / "u" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "u" / path).write_bytes(files[path])
    resources = tmp_path / "u" / "resources"
    shutil.rmtree(tmp_path / "elsewhere")
    again = read_machine(
        resources / json.loads(files["resources/axcomp.json"])["lists"], allow_outside=[resources / "machine"]
    )
    assert again.machine == read_machine(tmp_path / "cnc" / "sub" / "kw.lis").machine


def test_a_single_list_is_a_machine(lists: Path, tmp_path: Path) -> None:
    built = package_axcomp(lists / "achskw3.lis", tmp_path / "one.fmu")
    names = [name for name in contents(built.path) if name.startswith("resources/machine/")]
    assert names == ["resources/machine/achskw3.lis"]
    assert [axis.number for axis in built.machine.axes] == [3]


def test_the_libraries_have_the_name_of_the_model_and_the_license_comes_along(fmu: Path) -> None:
    names = set(contents(fmu))
    assert {"binaries/linux64/axcomp.so", "binaries/win64/axcomp.dll"} <= names
    assert "documentation/licenses/pythonfmu.txt" in names
    assert not [name for name in names if name.endswith((".pyc", "plant.json", ".csv", ".md"))]


def test_the_largest_machine_is_described(tmp_path: Path) -> None:
    screw = Leadscrew((0.0, 1.0), (0.0, 0.0))
    write_machine(Machine(tuple(Axis(n, f"A{n}", leadscrew=screw) for n in range(1, 33))), tmp_path / "lists")
    built = package_axcomp(tmp_path / "lists", tmp_path)
    assert len(built.machine.axes) == 32
    assert fmpy.read_model_description(built.path).modelVariables[-1].valueReference < 33 * 64


@pytest.mark.parametrize("path", ["missing", "missing/hochlauf.lis", "empty"])
def test_without_an_axis_there_is_no_fmu(tmp_path: Path, path: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(BuildError, match="there is no axis in these lists"):
        package_axcomp(tmp_path / path, tmp_path / "x.fmu")
    assert not (tmp_path / "x.fmu").exists()


def test_a_cycle_time_must_be_one(lists: Path, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="the cycle time must be above 0 s"):
        package_axcomp(lists, tmp_path / "x.fmu", cycle_time=-1.0)


def test_a_missing_pythonfmu_is_named(lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    with pytest.raises(BuildError, match=r"needs pythonfmu: pip install 'axcomp\[python\]'"):
        package_axcomp(lists, tmp_path / "x.fmu")


def test_a_plant_needs_its_description(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"plant\.json"):
        package_plant(tmp_path, tmp_path / "plant.fmu")
    (tmp_path / "plant.json").write_text('{"sub_step": 1e-4, "axes": [{"name": "X"}]}', encoding="utf-8")
    with pytest.raises(BuildError, match=r"plant\.json"):
        package_plant(tmp_path, tmp_path / "plant.fmu")
