"""A list that stands alone is recognized by what is in it, however it is called."""

from pathlib import Path

import pytest

from axcomp.kinds import ListKind
from axcomp.lists import kind_of, parameter_format, read_machine
from axcomp.model import models

KINDS = {
    "achskw": ListKind.COMPENSATION,
    "achsmd": ListKind.AXIS,
    "vol_co": ListKind.VOLUMETRIC,
    "hochla": ListKind.START_UP,
}
LISTS = sorted(path for path in models().rglob("*.lis") if path.stem[-1] != "4")
"""Of axis 4 of the manuals' examples there are headers only."""


@pytest.mark.parametrize("path", LISTS, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_every_list_of_the_examples_is_recognized_under_another_name(path: Path) -> None:
    assert kind_of("list.txt", path.read_text()) is KINDS[path.name[:6]]


@pytest.mark.parametrize("path", LISTS, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_no_list_of_the_examples_is_taken_for_another_kind(path: Path) -> None:
    codes = {finding.code for finding in read_machine(path).findings}
    assert not codes & {"AXC-KIND", "AXC-EMPTY", "AXC-NO-TABLE", "AXC-NO-AXIS-LIST", "70183"}


def test_a_header_alone_goes_by_the_name_of_the_file() -> None:
    assert kind_of("achsmd7.lis", "kopf.achs_nr 7\n") is ListKind.AXIS
    assert kind_of("ACHSKW7.LIS", "kopf.achs_nr 7\n") is ListKind.COMPENSATION
    assert kind_of("any.txt", "kopf.achs_nr 7\n") is None


def test_an_axis_list_full_of_other_parameters_is_one() -> None:
    text = "kopf.achs_nr 1\n" + "".join(f"antr.parameter_{i} 1\nlr_hw[0].some_{i} 2\n" for i in range(100))
    assert kind_of("x", text) is ListKind.AXIS


def test_a_volumetric_list_alone_becomes_its_compensation(tmp_path: Path) -> None:
    (tmp_path / "any.txt").write_text("x 1\ny 2\nz 3\nfile[0] e.csv\nchain XYZ\n")
    (tmp_path / "e.csv").write_text("X EXX\n0 0\n100 0.01\n")
    reading = read_machine(tmp_path / "any.txt")
    assert reading.findings == ()
    [volumetric] = reading.machine.volumetric
    assert dict(volumetric.axes) == {"X": 1, "Y": 2, "Z": 3}


def test_a_fault_in_a_volumetric_list_alone_is_found(tmp_path: Path) -> None:
    (tmp_path / "vol_comp0.lis").write_text("x 1\ny 2\nz 3\nfile[0] none.csv\nchain XYY\n")
    assert {finding.code for finding in read_machine(tmp_path / "vol_comp0.lis").findings} >= {
        "AXC-CHAIN",
        "AXC-MISSING",
    }


@pytest.mark.parametrize(
    ("text", "format_name", "code"),
    [
        ("X EXX EYX\n0 0 0\n1 0 nothing\n", "ISG_CSV", "AXC-RECORD"),
        ('// first\n#\n"X";"EXX"\n0;0\n1;20\n', "ISG_CSV", "AXC-LARGE"),
        ("[EXX]\nGridpoints = {\n0 0\n1 x\n}\n", "ETALON_EXCHANGE", "AXC-RECORD"),
    ],
)
def test_a_file_of_volumetric_parameters_alone_is_judged(
    text: str, format_name: str, code: str, tmp_path: Path
) -> None:
    assert parameter_format(text) == format_name
    (tmp_path / "errors.txt").write_text(text)
    assert [finding.code for finding in read_machine(tmp_path / "errors.txt").findings] == [code]


@pytest.mark.parametrize("text", ["", "time,X.setpoint\n0,1\n", "a b c\n", "target,run,direction,deviation\n"])
def test_other_texts_are_no_parameter_files(text: str) -> None:
    assert parameter_format(text) is None
