"""Tables of uncertainties: units, correlation, and what is said about those that cannot be used."""

from pathlib import Path

import pytest

from axcomp import read_machine
from axcomp.analysis.budget import Uncertainty, UncertaintyError, read_uncertainties
from axcomp.model import models

FIVE = read_machine(models() / "five_axis").machine
THREE = read_machine(models() / "three_axis").machine


def read(folder: Path, text: str, machine=FIVE):
    (folder / "u.csv").write_text(text, encoding="utf-8")
    return read_uncertainties(folder / "u.csv", machine)


def test_units_and_columns_in_any_order(tmp_path: Path) -> None:
    found = read(
        tmp_path,
        "unit;parameter;standard_uncertainty;correlation\n# of the tracker\nµm;EXX;0.8;nodes\n"
        "\n;EAX;2e-6\narcsec;ECC;1;common\n",
    )
    assert found[:2] == (Uncertainty("EXX", 0.8e-3, True, 0), Uncertainty("EAX", 2e-6, False, 0))
    assert found[2].value == pytest.approx(4.84814e-6, rel=1e-5)
    assert found[2].compensation == 1


def test_an_error_without_a_table_belongs_to_every_compensation_unless_one_is_named(tmp_path: Path) -> None:
    head = "parameter,standard_uncertainty,compensation\n"
    assert [u.compensation for u in read(tmp_path, f"{head}X0X,0.001,\n")] == [0, 1]
    assert [u.compensation for u in read(tmp_path, f"{head}X0X,0.001,1\n")] == [1]


def test_tables_of_axes(tmp_path: Path) -> None:
    text = "parameter,standard_uncertainty,unit\nX.leadscrew,0.5,um\n"
    assert read(tmp_path, text, THREE) == (Uncertainty("X.leadscrew", 0.5e-3),)


HEAD = "parameter,standard_uncertainty,unit,correlation,compensation\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "u.csv: There is no uncertainty in it"),
        ("parameter\n", "u.csv:1: expected the columns parameter, standard_uncertainty"),
        ("parameter,sigma\n", "u.csv:1: expected the columns"),
        (f"{HEAD}EXX,much\n", "u.csv:2: 'much' is no number"),
        (f"{HEAD}EXX,-1\n", "u.csv:2: standard_uncertainty is at least 0, not -1"),
        (f"{HEAD}EXX,nan\n", "u.csv:2: standard_uncertainty is at least 0, not nan"),
        (f"{HEAD}EXX,1,rad\n", "u.csv:2: rad is no unit of EXX; expected one of mm"),
        (f"{HEAD}EAX,1,mm\n", "u.csv:2: mm is no unit of EAX; expected one of rad"),
        (f"{HEAD}EXX,1,um,some\n", "u.csv:2: 'some' is no correlation; expected common or nodes"),
        (f"{HEAD}C0Y,1,urad,nodes\n", "u.csv:2: C0Y has no interpolation points along a single axis"),
        (f"{HEAD}EXX,1,um,common,4\n", "u.csv:2: there is no volumetric compensation 4; expected one of 0, 1"),
        (f"{HEAD}EAA,1\n", "u.csv:2: no volumetric compensation has an axis A"),
        (f"{HEAD}Q.leadscrew,1\n", "u.csv:2: Q.leadscrew is no error of the machine"),
        (f"{HEAD}EXX,1\nEXX,2\n", "u.csv:3: EXX stands here for the second time"),
        (f"{HEAD}EXX,1,um,common,0,7\n", "u.csv:2: There are 6 cells for 5 columns"),
    ],
)
def test_what_is_wrong_is_said_with_file_and_line(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(UncertaintyError) as caught:
        read(tmp_path, text)
    assert said in str(caught.value)


def test_a_machine_without_volumetric_compensation_has_none_of_the_72(tmp_path: Path) -> None:
    with pytest.raises(UncertaintyError, match="no volumetric compensation that EXX could belong to"):
        read(tmp_path, f"{HEAD}EXX,1\n", THREE)
