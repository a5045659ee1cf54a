"""What is in the spreadsheet, read back by openpyxl and compared with the text of the files."""

from __future__ import annotations

import re
import shutil
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import openpyxl
import pytest
from diagnosed_lists import settings, sheets, write_lists

from axcomp.analysis.diagnosis import diagnose, volumetric_lists, workbook
from axcomp.lists import read_machine
from axcomp.model import models

FIVE_AXIS = models() / "five_axis"


def written(folder: Path, output: Path, index: int = 0) -> Path:
    reading = read_machine(folder)
    source = next(source for source in volumetric_lists(reading)[0] if source.index == index)
    workbook.write_workbook(diagnose(source, reading), output)
    return output


Plain = tuple[str, frozenset[tuple[str, float]], float, int]


def of_csv(text: str) -> Iterator[Plain]:
    header: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("#"):
            header = []
        elif not header:
            header = line.split("\t")
        else:
            row = dict(zip(header, map(float, line.split("\t")), strict=True))
            place = frozenset((name, x) for name, x in row.items() if len(name) == 1)
            yield from ((name, place, x, number) for name, x in row.items() if len(name) == 3)


def of_exc(text: str) -> Iterator[Plain]:
    name = ""
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r"\[(\w+)\]", line):
            name = match[1]
        elif match := re.match(r"VALUE = (\S+)", line):
            yield name, frozenset(), float(match[1]), number
        elif match := re.match(r"\s+(\S+) (\S+)$", line):
            yield name, frozenset([(name[2], float(match[1]))]), float(match[2]), number


def of_sheet(path: Path, title: str) -> Iterator[Plain]:
    for row in sheets(path)[title].rows:
        place = frozenset((name[0], x) for name, x in row.items() if re.match(r"[A-Z] \[", name) and x is not None)
        (value,) = (row[name] for name in workbook.VALUE_COLUMNS if row.get(name) is not None)
        assert row["note"] is None
        yield row["parameter"], place, value, row["line"]  # type: ignore[misc]


@pytest.mark.parametrize(("index", "file", "count"), [(0, "vol_comp0.csv", 411), (1, "vol_comp1.exc", 701)])
def test_the_records_of_the_example_are_those_of_its_files(tmp_path: Path, index: int, file: str, count: int) -> None:
    path = written(FIVE_AXIS, tmp_path / "d.xlsx", index)
    assert list(sheets(path)) == ["settings", f"0 {file}"]
    text = (FIVE_AXIS / file).read_text(encoding="utf-8")
    found = list(of_sheet(path, f"0 {file}"))
    assert len(found) == count
    assert Counter(found) == Counter(of_csv(text) if file.endswith("csv") else of_exc(text))
    kept = settings(path)
    assert (kept["records used"], kept[f"vol_comp[{index}].max_records"], kept["state"]) == (count, 1000, "in force")


@pytest.mark.parametrize("index", [0, 1])
def test_the_settings_of_the_example_are_those_of_its_list(tmp_path: Path, index: int) -> None:
    kept = settings(written(FIVE_AXIS, tmp_path / "d.xlsx", index))
    text = (FIVE_AXIS / f"vol_comp{index}.lis").read_text(encoding="utf-8")
    entries = re.findall(r"^(\w\S*) +(\S+)$", text, re.M)
    assert len(entries) >= 10
    for name, value in entries:
        assert str(kept[name]) == value


def test_headers_have_units_and_stay_in_sight_and_numbers_are_numbers(tmp_path: Path) -> None:
    csv = "X B EXX EAX\n0 1 .25 1e-5\n#\nN0Z PXC IDC LNX\n-1 2 .5 1\n"
    path = written(write_lists(tmp_path, "file[0] e.csv", e_csv=csv), tmp_path / "d.xlsx")
    book = openpyxl.load_workbook(path)
    assert [(sheet.freeze_panes, sheet.auto_filter.ref) for sheet in book][1] == ("A2", "A1:H7")
    assert [sheet.freeze_panes for sheet in book] == ["A2", "A2"]
    rows = list(book["0 e.csv"].iter_rows(values_only=True))
    assert rows == [
        ("parameter", "X [mm]", "B [°]", "length [mm]", "angle [rad]", "number [1]", "line", "note"),
        ("EXX", 0, 1, 0.25, None, None, 2, None),
        ("EAX", 0, 1, None, 1e-5, None, 2, None),
        ("N0Z", None, None, None, None, -1, 5, None),
        ("PXC", None, None, 2, None, None, 5, None),
        ("IDC", None, None, None, 0.5, None, 5, None),
        ("LNX", None, None, None, None, 1, 5, None),
    ]
    kinds = {cell.data_type for row in book["0 e.csv"].iter_rows(min_row=2) for cell in row[1:] if cell.value}
    assert kinds == {"n"}


def test_no_digit_is_lost(tmp_path: Path) -> None:
    values = [0.1 + 0.2, 1 / 3e5, -2 / 3, 5e-324, 0.1]
    csv = "X EXX\n" + "".join(f"{i} {value!r}\n" for i, value in enumerate(values))
    path = written(write_lists(tmp_path, "file[0] e.csv", e_csv=csv), tmp_path / "d.xlsx")
    assert [row["length [mm]"] for row in sheets(path)["0 e.csv"].rows] == values


def test_a_compensation_that_is_off_is_shown_with_the_reason(tmp_path: Path) -> None:
    folder = write_lists(tmp_path / "lists", "file[0] e.csv", e_csv="X EXX EXQ\n0 .5 1\n#\nX EXX\n0 .6\n")
    path = written(folder, tmp_path / "d.xlsx")
    rows = sheets(path)["settings"].rows
    assert settings(path)["state"] == "off"
    assert ("error 70468", "e.csv:1") in [(row["entry"], row["where"]) for row in rows]
    assert not any(str(tmp_path) in str(value) for row in rows for value in row.values())
    assert [row["note"] for row in sheets(path)["0 e.csv"].rows] == ["replaced by e.csv:5", None]


def test_text_of_a_list_is_never_a_formula_and_never_breaks_the_file(tmp_path: Path) -> None:
    entries = ['chain "=1+1"', 'negate "#N/A"', 'set_to_zero "\x01\ufffe"', "file[0] [e]'.csv", "file[1] gone?*.csv"]
    folder = write_lists(tmp_path, *entries)
    (folder / "[e]'.csv").write_text("X0X\n1\n", encoding="utf-8")
    path = written(folder, tmp_path / "d.xlsx")
    assert (settings(path)["chain"], settings(path)["negate"]) == ("=1+1", "#N/A")
    assert settings(path)["set_to_zero"] == "\ufffd\ufffd"
    cells = [cell for sheet in openpyxl.load_workbook(path) for row in sheet.iter_rows() for cell in row]
    assert not {cell.data_type for cell in cells} & {"f", "e"}
    assert list(sheets(path)) == ["settings", "0 _e_'.csv", "1 gone__.csv"]


def test_long_names_of_files_make_different_sheets(tmp_path: Path) -> None:
    files = {f"{'long' * 9}{j}_csv": "X0X\n1\n" for j in range(10)}
    entries = [f"file[{j}] {name.replace('_', '.')}" for j, name in enumerate(files)]
    path = written(write_lists(tmp_path, *entries, **files), tmp_path / "d.xlsx")
    assert len(sheets(path)) == 11
    assert all(len(title) <= 31 for title in sheets(path))


def test_what_no_sheet_can_hold_goes_on_the_next(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workbook, "ROWS_MAX", 4)
    csv = "X EXX\n" + "".join(f"{i} {i}\n" for i in range(7))
    path = written(write_lists(tmp_path, "file[0] e.csv", e_csv=csv), tmp_path / "d.xlsx")
    _, *parts = sheets(path).items()
    assert [title for title, _ in parts] == ["0 e.csv", "0.2 e.csv", "0.3 e.csv"]
    assert [len(part.rows) for _, part in parts] == [3, 3, 1]
    assert [row["X [mm]"] for _, part in parts for row in part.rows] == list(range(7))


def test_the_same_lists_give_the_same_bytes_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "946684800")
    for name in ("here", "there"):
        shutil.copytree(FIVE_AXIS, tmp_path / name)
        with (tmp_path / name / "vol_comp0.lis").open("r+", encoding="utf-8") as file:
            file.write("nonsense 1\nfile[1] no.csv\n")
        written(tmp_path / name, tmp_path / f"{name}.xlsx")
    assert (tmp_path / "here.xlsx").read_bytes() == (tmp_path / "there.xlsx").read_bytes()
    properties = openpyxl.load_workbook(tmp_path / "here.xlsx").properties
    assert properties.created == properties.modified
    assert (properties.modified.year, properties.creator) == (2000, "axcomp")
    with zipfile.ZipFile(tmp_path / "here.xlsx") as archive:
        assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert archive.namelist()[0] == "[Content_Types].xml"
