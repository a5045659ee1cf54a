"""FMI 2.0 to the letter: what lies in an FMU beside what runs, checked with the schemas that FMPy ships."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import fmpy
import pytest
from frozen import every_variable
from lxml import etree

from axcomp.fmu import BuildError, Description, generation_date, model_description, package_axcomp, package_native
from axcomp.interface import Naming, Types, variables_of
from axcomp.lists import write_machine
from axcomp.model import models
from axcomp.plant import package_plant

SCHEMAS = Path(fmpy.__file__).parent / "schema"
DESCRIPTION = Description("axcomp", "", 0.001, "1.2.3")


def schema(path: str) -> Any:
    return etree.XMLSchema(etree.parse(str(SCHEMAS / path)))


def of_plant(_: Path, output: Path) -> Path:
    return package_plant(models() / "five_axis", output)


def of_native(lists: Path, output: Path) -> Path:
    return package_native(lists, output).path


def of_python(lists: Path, output: Path) -> Path:
    return package_axcomp(lists, output).path


@pytest.mark.parametrize("build", [of_native, of_python, of_plant])
def test_the_schemas_and_fmpy_find_nothing(build: Callable[[Path, Path], Path], tmp_path: Path) -> None:
    write_machine(every_variable(), tmp_path / "lists")
    fmu = build(tmp_path / "lists", tmp_path)
    with zipfile.ZipFile(fmu) as archive:
        description = etree.fromstring(archive.read("modelDescription.xml"))
        shown = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        page = archive.read("documentation/index.html").decode()
        assert archive.read("model.png")[:4] == archive.read("terminalsAndIcons/icon.png")[:4] == b"\x89PNG"
        assert b"MIT License" in archive.read("documentation/licenses/license.txt")
    for document, path in ((description, "fmi2/fmi2ModelDescription.xsd"), (shown, "fmi3/fmi3TerminalsAndIcons.xsd")):
        found = schema(path)
        assert found.validate(document), found.error_log
    assert description.get("author")
    assert description.get("license") == "MIT"
    known = {variable.get("name") for variable in description.iter("ScalarVariable")}
    assert {member.get("variableName") for member in shown.iter("TerminalMemberVariable")} <= known
    for name in known:
        assert f"<td>{name}</td>" in page
    run = subprocess.run(
        [sys.executable, "-m", "fmpy", "validate", str(fmu)], capture_output=True, text=True, check=False
    )
    assert (run.returncode, run.stdout.strip()) == (0, "No problems found.")


def test_every_axis_has_a_terminal_with_all_its_ports(tmp_path: Path) -> None:
    with zipfile.ZipFile(package_native(models() / "three_axis", tmp_path).path) as archive:
        shown = ElementTree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    ports = {terminal.get("name"): len(terminal) for terminal in shown.iter("Terminal")}
    assert list(ports) == ["X", "Y", "Z"]
    assert sum(ports.values()) == 69
    assert {"setpoint", "cross.switch"} <= {member.get("memberName") for member in shown.iter("TerminalMemberVariable")}


def test_the_documentation_shows_tables_and_findings_of_this_machine(tmp_path: Path) -> None:
    lists = tmp_path / "lists"
    lists.mkdir()
    text = "kopf.achs_nr 1\nkw.ssfk.kw_nr_max 2\nkw.ssfk.interval 100000\nkw.ssfk.table[0].pos 12\nnothing.known 3\n"
    (lists / "achskw1.lis").write_text(f"{text}kw.ssfk.table[1].pos -345\nEnd\n")
    with zipfile.ZipFile(package_native(lists / "achskw1.lis", tmp_path).path) as archive:
        page = archive.read("documentation/index.html").decode()
    assert "<td>10.0</td><td>-0.0345</td>" in page
    assert "achskw1.lis:5: warning" in page
    assert str(tmp_path) not in page
    with zipfile.ZipFile(package_native(lists / "achskw1.lis", tmp_path, with_lists=False).path) as archive:
        page = archive.read("documentation/index.html").decode()
    assert "0.0345" not in page
    assert "nothing.known" not in page
    assert "axis1.leadscrew.switch" in page


EXPECTED = {
    "X.setpoint": {
        "unit": "mm",
        "quantity": "Length",
        "min": "-1000000000000000.0",
        "max": "1000000000000000.0",
        "nominal": "100.0",
    },
    "X.velocity": {
        "unit": "mm/s",
        "quantity": "Velocity",
        "min": "-1000000000000000.0",
        "max": "1000000000000000.0",
        "nominal": "100.0",
    },
    "C.velocity": {
        "unit": "deg/s",
        "quantity": "AngularVelocity",
        "min": "-1000000000000000.0",
        "max": "1000000000000000.0",
        "nominal": "100.0",
    },
    "X.cross.correction": {"unit": "mm", "quantity": "Length", "nominal": "0.01"},
    "X.cross.switch": {"min": "-1", "max": "1"},
    "X.current": {"quantity": "ElectricCurrent"},
    "volumetric[0].switch": {"min": "-1", "max": "1"},
    "volumetric[0].reduction_x": {"min": "0.0", "max": "1.0"},
    "tool_length": {"unit": "mm", "quantity": "Length", "min": "-1000000.0", "max": "1000000.0", "nominal": "100.0"},
    "cycle_time": {"unit": "s", "quantity": "Time", "min": "1e-09", "max": "1000.0", "nominal": "0.001"},
    "reset": {},
}


def attributes(naming: Naming = "structured", types: Types = "own") -> dict[str, dict[str, str]]:
    variables = variables_of(every_variable(), naming, types=types)
    root = ElementTree.fromstring(model_description(DESCRIPTION, variables, "{guid}"))
    found = {variable.attrib["name"]: dict(next(iter(variable)).attrib) for variable in root.iter("ScalarVariable")}
    return {name: {k: v for k, v in given.items() if k != "start"} for name, given in found.items()}


def test_variables_say_their_limits_quantities_and_sizes() -> None:
    found = attributes()
    assert {name: found[name] for name in EXPECTED} == EXPECTED


def test_a_real_that_was_a_boolean_or_an_integer_has_its_limits() -> None:
    found = attributes(types="real")
    assert (found["reset"], found["X.cross.switch"]) == ({"min": "0.0", "max": "1.0"}, {"min": "-1.0", "max": "1.0"})


def test_the_date_is_the_commits_and_a_guid_does_not_depend_on_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    root = Path(__file__).parents[2]
    command = ["git", "-C", str(root), "log", "-1", "--format=%cd", "--date=format-local:%Y-%m-%dT%H:%M:%SZ"]
    run = subprocess.run(
        command, capture_output=True, text=True, check=False, env={"TZ": "UTC", "PATH": "/usr/bin:/bin"}
    )
    if run.returncode == 0:
        assert generation_date() == run.stdout.strip()
    guids = set()
    for seconds in ("1000000000", "1700000000"):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
        for build in (of_native, of_python):
            found = fmpy.read_model_description(build(models() / "rotary_table", tmp_path))
            guids.add((build, found.guid))
            assert found.generationDateAndTime.startswith("2001" if seconds[0:2] == "10" else "2023")
    assert len(guids) == 2
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "soon")
    with pytest.raises(BuildError, match="soon"):
        generation_date()
