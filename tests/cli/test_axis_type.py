"""A single compensation list of a rotary axis, tried alone with ``--axis-type``."""

import json
import zipfile
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest

from axcomp.cli import main
from axcomp.engine import Engine
from axcomp.fmu import Instance
from axcomp.lists import read_machine
from axcomp.model import AxisType, ModuloRange

Capture = pytest.CaptureFixture[str]

ERRORS = (0, 100, 300, -100)
"""In 0.0001°, at 0°, 90°, 180°, 270°."""
TABLE = "kw.ssfk.unit 1\nkw.ssfk.interval 900000\nkw.ssfk.kw_nr_max 4\nkw.ssfk.modulo 1\n" + "".join(
    f"kw.ssfk.table[{i}].pos {error}\n" for i, error in enumerate(ERRORS)
)
CROSS = "".join(
    f"kw.crosscomp.{entry}\n" for entry in ("unit 1", "master_ax_nr 9", "table[0].setpoint 0", "table[0].correction 5")
)
POSITION, FOLDED = 450.0 + 22.5, Fraction(45, 2)
CORRECTED = Fraction(POSITION) - (ERRORS[1] + (ERRORS[2] - ERRORS[1]) * FOLDED / 90) / 10_000


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "achskw4.lis"
    path.write_text(f"kopf.achs_nr 4\nkopf.log_achs_name C\n{TABLE}")
    return path


@pytest.mark.parametrize(
    ("axis_type", "kind", "modulo", "codes"),
    [
        (None, AxisType.TRANSLATORY, None, ["AXC-MODULO-AXIS"]),
        ("translatory", AxisType.TRANSLATORY, None, ["AXC-MODULO-AXIS"]),
        ("rotary", AxisType.ROTARY, None, ["AXC-MODULO-AXIS"]),
        ("modulo", AxisType.ROTARY, ModuloRange(0.0, 360.0), []),
    ],
)
def test_an_axis_without_axis_list_is_what_is_said_of_it(
    axis_type: str | None, kind: AxisType, modulo: ModuloRange | None, codes: list[str], table: Path
) -> None:
    table.write_text(f"{table.read_text()}{CROSS}")
    reading = read_machine(table, axis_type=axis_type)
    axis, master = reading.machine.axes
    assert (axis.type, axis.modulo) == (kind, modulo)
    assert (master.number, master.type) == (9, AxisType.TRANSLATORY)
    assert [finding.code for finding in reading.findings] == codes
    assert reading.again().machine == reading.machine


def test_axis_lists_win_and_that_is_told(table: Path) -> None:
    table.with_name("achsmd4.lis").write_text("kopf.achs_nr 4\nlr_param.ssfk 1\n")
    reading = read_machine(table.parent, axis_type="modulo")
    assert reading.machine.axes[0].type is AxisType.TRANSLATORY
    assert [finding.code for finding in reading.findings] == ["AXC-UNUSED", "AXC-MODULO-AXIS"]


def test_check_and_show_take_it(table: Path, capsys: Capture) -> None:
    assert main(["check", str(table), "--axis-type", "modulo", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["machines"][0]["axes"][0]["type"], [f["code"] for f in found["findings"]]) == ("rotary", [])
    assert main(["show", str(table), "--axis-type", "modulo"]) == 0
    assert "°" in capsys.readouterr().out
    assert main(["show", str(table)]) == 0
    assert "°" not in capsys.readouterr().out


def test_run_folds_the_position(table: Path, tmp_path: Path) -> None:
    program, result = tmp_path / "program.csv", tmp_path / "result.csv"
    program.write_text(f"C.setpoint\n{POSITION}\n")
    assert main(["run", str(program), "--machine", str(table), "--axis-type", "modulo", "--output", str(result)]) == 0
    names, values = (line.split(",") for line in result.read_text().splitlines())
    assert float(values[names.index("C.corrected_setpoint")]) == pytest.approx(float(CORRECTED), abs=1e-13)
    engine = Engine(table, axis_type="modulo")
    assert engine.step({"C.setpoint": POSITION})["C.corrected_setpoint"] == float(
        values[names.index("C.corrected_setpoint")]
    )


def test_an_image_is_that_of_a_machine_whose_axis_list_says_so(table: Path, tmp_path: Path) -> None:
    alone, machine, other = (tmp_path / f"{name}.bin" for name in ("alone", "machine", "other"))
    build = ["build", "--machine"]
    assert main([*build, str(table), "--axis-type", "modulo", "--image", str(alone)]) == 0
    assert main([*build, str(table), "--image", str(other)]) == 0
    axis = "kopf.achs_nr 4\nlr_param.ssfk 1\nkenngr.achs_typ 2\nkenngr.achs_mode 4\n"
    table.with_name("achsmd4.lis").write_text(axis)
    assert main([*build, str(tmp_path), "--image", str(machine)]) == 0
    assert alone.read_bytes() == machine.read_bytes() != other.read_bytes()


def test_an_fmu_remembers_it(table: Path, tmp_path: Path) -> None:
    fmu = tmp_path / "c.fmu"
    options = ["--axis-type", "modulo", "--runtime", "python", "--output", str(fmu)]
    assert main(["build", "--machine", str(table), *options]) == 0
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path / "fmu")
    description = ElementTree.parse(tmp_path / "fmu" / "modelDescription.xml")
    variables = {variable.get("name"): variable for variable in description.iter("ScalarVariable")}
    assert variables["C.setpoint"][0].get("unit") == "deg"
    log: list[str] = []
    instance = Instance(str(tmp_path / "fmu" / "resources"), lambda _, text: log.append(text))
    assert log == []
    assert instance.runtime.machine.axes[0].modulo == ModuloRange(0.0, 360.0)
