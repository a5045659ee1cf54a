"""``axcomp diagnose``, and the diagnosis files that ``axcomp build`` writes."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from diagnosed_lists import settings, sheets, write_lists

from axcomp.cli import main
from axcomp.model import models

Capture = pytest.CaptureFixture[str]

CSV = "X EXX\n0 0.5\n9 0.25\n"


@pytest.fixture
def hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hide openpyxl, and forget what has imported it."""
    for name in [*sys.modules]:
        if name.startswith(("openpyxl", "axcomp.analysis.diagnosis", "axcomp.cli.diagnose")):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "openpyxl", None)


def lists_naming(folder: Path, name: str) -> Path:
    return write_lists(folder, "file[0] e.csv", f'diagnosis_file "{name}"', e_csv=CSV)


def test_each_compensation_of_a_machine_has_its_file(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "new").mkdir()
    assert main(["diagnose", str(models() / "five_axis"), "--output", str(tmp_path / "new" / "d.xlsx")]) == 0
    assert capsys.readouterr().out.splitlines() == [
        f"{tmp_path / 'new' / 'd-0.xlsx'}: 411 records of vol_comp0.csv",
        f"{tmp_path / 'new' / 'd-1.xlsx'}: 701 records of vol_comp1.exc",
    ]
    assert settings(tmp_path / "new" / "d-1.xlsx")["chain"] == "CBYXZ"


def test_one_compensation_can_be_asked_for(tmp_path: Path, capsys: Capture) -> None:
    output = tmp_path / "d.xlsx"
    assert main(["diagnose", str(models() / "five_axis"), "--id", "1", "--output", str(output)]) == 0
    assert list(sheets(output)) == ["settings", "0 vol_comp1.exc"]
    assert main(["diagnose", str(models() / "five_axis"), "--id", "3", "--output", str(output)]) == 1
    assert "there is no volumetric list with ID 3" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "place", "note"),
    [
        ("d.xlsx", "d.xlsx", ""),
        ("out\\d.xlsx", "out/d.xlsx", ""),
        ("out/d.xlsx", "out/d.xlsx", ""),
        ("C:\\volcomp\\d 1.xlsx", "d 1.xlsx", "there is no C:\\volcomp on this machine"),
        ("\\\\host\\share\\d.xlsx", "d.xlsx", "on this machine"),
        ("/nowhere/at all/d.xlsx", "d.xlsx", "on this machine"),
        ("C:\\volcomp\\diagnosis_00.xml", "diagnosis_00.xml", "may ask for the suffix .xlsx"),
    ],
)
def test_the_file_goes_where_the_list_says_or_beside_it(
    tmp_path: Path, capsys: Capture, name: str, place: str, note: str
) -> None:
    assert main(["diagnose", str(lists_naming(tmp_path, name))]) == 0
    out, err = capsys.readouterr()
    assert out == f"{tmp_path / place}: 2 records of e.csv\n"
    assert note in err
    assert bool(err) == bool(note)
    assert settings(tmp_path / place)["records used"] == 2


def test_a_place_that_is_there_is_taken(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "out").mkdir()
    lists = str(lists_naming(tmp_path / "lists", str(tmp_path / "out" / "d.xlsx")))
    assert main(["diagnose", lists]) == 0
    assert (tmp_path / "lists" / "d.xlsx").is_file()
    assert "out is not allowed" in capsys.readouterr().err
    assert main(["diagnose", lists, "--allow-outside", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "d.xlsx").is_file()
    assert capsys.readouterr().err == ""


def test_two_lists_that_name_one_file_do_not_share_it(tmp_path: Path, capsys: Capture) -> None:
    start_up = "vol_comp[0].max_records 9\nvol_comp[3].file_name v.lis\nvol_comp[3].max_records 9"
    entries = ["file[0] e.csv", "diagnosis_file C:\\a\\d.xlsx"]
    other = "x 1\ny 2\nz 3\nfile[0] f.csv\ndiagnosis_file D:\\b\\d.xlsx\n"
    write_lists(tmp_path, *entries, start_up=start_up, e_csv=CSV, v_lis=other, f_csv="X0X\n1\n")
    assert main(["diagnose", str(tmp_path)]) == 0
    assert "another list names the same diagnosis file" in capsys.readouterr().err
    assert list(sheets(tmp_path / "d.xlsx"))[1:] == ["0 e.csv"]
    assert list(sheets(tmp_path / "d-3.xlsx"))[1:] == ["0 f.csv"]


def test_an_earlier_diagnosis_is_replaced_but_nothing_else(tmp_path: Path, capsys: Capture) -> None:
    folder = lists_naming(tmp_path, "d.xlsx")
    assert main(["diagnose", str(folder)]) == 0
    first = (folder / "d.xlsx").read_bytes()
    assert main(["diagnose", str(folder)]) == 0
    assert (folder / "d.xlsx").read_bytes() == first
    for name, sentence in (
        ("hochlauf.lis", "was not written by axcomp; it stays as it is"),
        ("..", "leads out of the folder"),
    ):
        capsys.readouterr()
        before = (folder / "hochlauf.lis").read_bytes()
        assert main(["diagnose", str(lists_naming(tmp_path, name))]) == 1
        assert sentence in capsys.readouterr().err
        assert (folder / "hochlauf.lis").read_bytes() == before


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["nowhere"], "there is no volumetric list to be read in nowhere"),
        (["no_volumetric"], "there is no volumetric list to be read in no_volumetric"),
        (["lists"], "vol_comp0.lis: no diagnosis_file is named; --output FILE says where to write"),
        (["lists", "--output", "lists/hochlauf.lis/d.xlsx"], "there is no folder"),
        (["lists", "--output", "lists"], "it is a folder"),
    ],
)
def test_what_cannot_be_done_is_a_sentence_and_status_1(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, arguments: list[str], sentence: str
) -> None:
    monkeypatch.chdir(tmp_path)
    write_lists(tmp_path / "lists", "file[0] e.csv", e_csv=CSV)
    (tmp_path / "no_volumetric").mkdir()
    (tmp_path / "no_volumetric" / "hochlauf.lis").write_text("zahl_kw 0\n", encoding="utf-8")
    assert main(["diagnose", *arguments]) == 1
    assert sentence in capsys.readouterr().err


def test_a_missing_list_or_file_fails_and_the_rest_is_written(tmp_path: Path, capsys: Capture) -> None:
    start_up = "vol_comp[0].max_records 9\nvol_comp[1].file_name gone.lis\nvol_comp[1].max_records 9"
    folder = write_lists(tmp_path, "file[0] e.csv", "diagnosis_file d.xlsx", start_up=start_up, e_csv=CSV)
    assert main(["diagnose", str(folder)]) == 1
    assert "the volumetric list 'gone.lis', which hochlauf.lis names, cannot be read" in capsys.readouterr().err
    assert settings(folder / "d.xlsx")["state"] == "in force"
    folder = write_lists(tmp_path, "file[0] e.csv", "file[1] none.csv", "diagnosis_file d.xlsx", e_csv=CSV)
    assert main(["diagnose", str(folder)]) == 1
    assert "error AXC-MISSING: The file 'none.csv' does not exist." in capsys.readouterr().err
    assert settings(folder / "d.xlsx")["state"] == "off"
    assert len(sheets(folder / "d.xlsx")["0 e.csv"].rows) == 2


@pytest.mark.usefixtures("hidden")
def test_without_openpyxl_a_sentence_says_what_to_install(tmp_path: Path, capsys: Capture) -> None:
    with pytest.raises(SystemExit, match=r"diagnose needs openpyxl: pip install 'axcomp\[tables\]'"):
        main(["diagnose", str(lists_naming(tmp_path, "d.xlsx"))])
    assert not (tmp_path / "d.xlsx").exists()
    assert capsys.readouterr().out == ""


def test_a_build_writes_the_files_that_lists_name(tmp_path: Path, capsys: Capture) -> None:
    folder = lists_naming(tmp_path / "lists", "C:\\volcomp\\d.xlsx")
    assert main(["build", "--machine", str(folder), "--image", str(tmp_path / "t.bin"), "--diagnosis"]) == 0
    out, err = capsys.readouterr()
    assert out.splitlines()[-1] == str(folder / "d.xlsx")
    assert "note: vol_comp0.lis: there is no C:\\volcomp on this machine" in err
    assert settings(folder / "d.xlsx")["records used"] == 2


def test_a_build_that_is_not_asked_writes_none(tmp_path: Path) -> None:
    folder = lists_naming(tmp_path / "lists", "d.xlsx")
    before = sorted(folder.iterdir())
    assert main(["build", "--machine", str(folder), "--image", str(tmp_path / "t.bin")]) == 0
    assert sorted(folder.iterdir()) == before


@pytest.mark.usefixtures("hidden")
def test_a_build_without_openpyxl_says_so_and_succeeds(tmp_path: Path, capsys: Capture) -> None:
    folder = lists_naming(tmp_path / "lists", "d.xlsx")
    assert main(["build", "--machine", str(folder), "--image", str(tmp_path / "t.bin"), "--diagnosis"]) == 0
    assert "note: d.xlsx is not written: it needs openpyxl: pip install 'axcomp[tables]'" in capsys.readouterr().err
    assert not (folder / "d.xlsx").exists()


def test_a_build_that_cannot_write_one_says_so_and_succeeds(tmp_path: Path, capsys: Capture) -> None:
    folder = lists_naming(tmp_path / "lists", "hochlauf.lis")
    assert main(["build", "--machine", str(folder), "--image", str(tmp_path / "t.bin"), "--diagnosis"]) == 0
    assert "stays as it is" in capsys.readouterr().err
    assert (tmp_path / "t.bin").is_file()


def test_neither_kernel_nor_reader_nor_build_need_openpyxl() -> None:
    modules = "axcomp.runtime.runtime, axcomp.runtime.compile, axcomp.lists, axcomp.cli.build"
    program = f"import sys, {modules}; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "axcomp.kernel" in done.stdout.split()
    assert "openpyxl" not in done.stdout.split()


def test_help_has_an_example(capsys: Capture) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["diagnose", "--help"])
    assert ended.value.code == 0
    assert "axcomp diagnose models/five_axis --output records.xlsx" in capsys.readouterr().out
