"""``axcomp show`` as a user meets it."""

import csv
import json
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from shown_machines import MACHINE

from axcomp.cli import main
from axcomp.lists import write_machine
from axcomp.model import Machine


@pytest.fixture(scope="module")
def lists(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lists")
    write_machine(MACHINE, folder)
    return folder


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("others")
    x, y, *rest = MACHINE.axes
    assert x.leadscrew is not None
    changed = replace(x, leadscrew=replace(x.leadscrew, positive=(0.001, 0.004, -0.002)), plane=None)
    write_machine(Machine((changed, y, *rest)), folder)
    return folder


def test_tables_are_printed_with_an_overview(lists: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(lists)]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("compensation ")
    assert printed.count("Axis X: leadscrew compensation") == 2
    assert "positive motion [µm]" in printed


def test_one_table_alone_has_no_overview(lists: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(lists), "--axis", "X", "--kind", "leadscrew", "--rows", "2"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["0", "0", "1", "−1"] in lines
    assert ["40", "−2", "1", "−3"] in lines
    assert ["10", "4", "6", "−2"] not in lines


def test_several_pictures_get_the_names_of_their_tables(
    lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(lists), "--axis", "X", "--output", str(tmp_path / "x.png")]) == 0
    names = {"x-X-plane.png", "x-X-crosstalk.png", "x-X-leadscrew.png"}
    assert {path.name for path in tmp_path.iterdir()} == names
    assert {Path(line).name for line in capsys.readouterr().out.split()} == names
    assert main(["show", str(lists), "--kind", "cross", "--output", str(tmp_path / "z.png")]) == 0
    assert (tmp_path / "z.png").read_bytes().startswith(b"\x89PNG")


def test_all_numbers_go_into_one_csv_file(lists: Path, tmp_path: Path) -> None:
    file = tmp_path / "all.csv"
    assert main(["show", str(lists), "--output", str(file)]) == 0
    with file.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    screw = [row for row in rows if (row["axis"], row["kind"]) == ("X", "leadscrew")]
    assert [row["positive motion [µm]"] for row in screw] == ["0.0", "4.0", "-2.0"]
    assert {row["kind"] for row in rows} == {"leadscrew", "cross", "plane", "crosstalk", "friction"}


def test_a_page_is_written(lists: Path, tmp_path: Path) -> None:
    assert main(["show", str(lists), "--axis", "Y", "--output", str(tmp_path / "y.HTML")]) == 0
    assert (tmp_path / "y.HTML").read_text(encoding="utf-8").count("<img") == 2


def test_json_has_columns_and_rows(lists: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(lists), "--kind", "cross", "--format", "json"]) == 0
    [cross] = json.loads(capsys.readouterr().out)
    assert (cross["axis"], cross["rows"]) == ("Y", [[0.0, 0.0], [100.0, 20.0]])


def test_two_machines_are_compared_and_what_cannot_be_is_said(
    lists: Path, others: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(lists), "--against", str(others), "--axis", "X", "--format", "json"]) == 0
    printed = capsys.readouterr()
    found = {one["kind"]: one["rows"] for one in json.loads(printed.out)}
    assert found["leadscrew"] == [[0.0, 1.0, 0.0], [10.0, 0.0, 0.0], [40.0, 0.0, 0.0]]
    assert "plane" not in found
    assert "note: Axis X: plane compensation: the other machine has none" in printed.err


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--axis", "Q"), "there is no axis 'Q'; there are C, W, X, Y, Z"),
        (("--axis", "X", "--kind", "cross"), "no cross compensation of axis X is in force"),
        (("--kind", "volumetric"), "no volumetric compensation is in force"),
        (("--output", "x.pdf"), "x.pdf must end in .png, .html, .csv"),
    ],
)
def test_a_refusal_is_one_sentence(
    lists: Path, arguments: tuple[str, ...], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(lists), *arguments]) == 1
    assert sentence in capsys.readouterr().err


def test_a_folder_without_lists_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(tmp_path / "nowhere")]) == 1
    assert "AXC-MISSING" in capsys.readouterr().err


def test_without_rich_a_sentence_says_what_to_install_and_files_are_still_written(
    lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in [name for name in sys.modules if name == "rich" or name.startswith("rich.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(sys.modules, "axcomp.plot.terminal", raising=False)
    monkeypatch.setitem(sys.modules, "rich", None)
    assert main(["show", str(lists), "--kind", "cross"]) == 1
    assert "axcomp[plot]" in capsys.readouterr().err
    assert main(["show", str(lists), "--kind", "cross", "--output", str(tmp_path / "c.csv")]) == 0


def test_help_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["show", "--help"])
    assert caught.value.code == 0
    assert "axcomp show models/three_axis --axis X --kind leadscrew --output x.png" in capsys.readouterr().out


def test_another_machine_without_axes_is_one_sentence(
    lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(lists), "--against", str(tmp_path / "nosuch")]) == 1
    words = capsys.readouterr().err
    assert "there is no axis in" in words
    assert "the other machine has none" not in words
