"""One reader for trajectories, programs, traces and uncertainties: the same dialects, the same sentences."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from pathlib import Path

import numpy as np
import openpyxl
import pandas as pd
import pytest

from axcomp import Engine
from axcomp.analysis.budget import UncertaintyError, read_uncertainties
from axcomp.analysis.replay import read_trace
from axcomp.cli import main
from axcomp.engine import InputError, read_input
from axcomp.lists import read_machine
from axcomp.model import models

THREE = models() / "three_axis"
NAMES = ["time", "X.setpoint", "X.correction"]
ROWS = [[0.0, -1.5, 0.125], [0.001, 2.25, -0.5], [0.002, 1234.5, 0.0]]


def german(rows: list[list[object]]) -> str:
    return "\n".join(";".join(str(cell).replace(".", ",") if row else str(cell) for cell in line)
                     for row, line in enumerate(rows))  # fmt: skip


def book(path: Path, rows: list[list[object]]) -> None:
    made = openpyxl.Workbook()
    for row in rows:
        made.active.append(row)
    made.save(path)


def frame(rows: list[list[object]]) -> pd.DataFrame:
    return pd.DataFrame(rows[1:], columns=[str(name) for name in rows[0]])


def plain(rows: list[list[object]]) -> str:
    return "\n".join(",".join(map(str, row)) for row in rows) + "\n"


WRITERS: dict[str, Callable[[Path, list[list[object]]], object]] = {
    "plain.csv": lambda path, rows: path.write_text(plain(rows)),
    "german.csv": lambda path, rows: path.write_text(german(rows), "cp1252"),
    "crlf.csv": lambda path, rows: path.write_bytes(german(rows).replace("\n", "\r\n").encode()),
    "sep.csv": lambda path, rows: path.write_text("sep=;\n" + german(rows), "utf-8-sig"),
    "quoted.csv": lambda path, rows: path.write_text(
        "\n".join(
            ",".join(f'"{str(cell).replace(".", ",") if n else cell}"' for cell in row) for n, row in enumerate(rows)
        )
    ),
    "utf16.txt": lambda path, rows: path.write_text(german(rows).replace(";", "\t"), "utf-16"),
    "blanks.dat": lambda path, rows: path.write_text("\n".join("  ".join(map(str, row)) for row in rows)),
    "noted.csv": lambda path, rows: path.write_text("# made by hand\n" + plain(rows) + "\n// the end\n"),
    "book.xlsx": book,
    "frame.parquet": lambda path, rows: frame(rows).to_parquet(path),
    "indexed.parquet": lambda path, rows: frame(rows).set_index(str(rows[0][0])).to_parquet(path),
    "frame.feather": lambda path, rows: frame(rows).to_feather(path),
    "plain.csv.gz": lambda path, rows: path.write_bytes(gzip.compress(plain(rows).encode())),
    "utf16.csv.gz": lambda path, rows: path.write_bytes(gzip.compress(german(rows).encode("utf-16"))),
    "frame.parquet.gz": lambda path, rows: path.write_bytes(gzip.compress(frame(rows).to_parquet())),
}
TABLE: list[list[object]] = [list(NAMES), *[list(row) for row in ROWS]]


@pytest.mark.parametrize("name", WRITERS)
def test_a_trajectory_is_read_in_every_dialect(name: str, tmp_path: Path) -> None:
    WRITERS[name](tmp_path / name, TABLE)
    found = read_input(tmp_path / name)
    assert found.time is not None
    assert found.time.tolist() == [row[0] for row in ROWS]
    assert found.columns["X.setpoint"].tolist() == [row[1] for row in ROWS]


@pytest.mark.parametrize("name", WRITERS)
def test_a_trace_is_read_in_every_dialect(name: str, tmp_path: Path) -> None:
    WRITERS[name](tmp_path / name, TABLE)
    trace = read_trace(tmp_path / name, read_machine(THREE).machine)
    assert trace.outputs["X.correction"].tolist() == [row[2] for row in ROWS]
    assert trace.cycle_time == 0.001


@pytest.mark.parametrize("name", [name for name in WRITERS if name not in ("noted.csv", "blanks.dat")])
def test_a_program_is_read_in_every_dialect(name: str, tmp_path: Path) -> None:
    rows: list[list[object]] = [["time", "X.setpoint", "command"]]
    commands = ["X[COMP OFF LEAD]", "X[COMP ON LEAD]", "#VOLCOMP OFF ALL"]
    rows += [[*row[:2], command] for row, command in zip(ROWS, commands, strict=True)]
    WRITERS[name](tmp_path / name, rows)
    assert main(["run", str(tmp_path / name), "--machine", str(THREE), "--output", str(tmp_path / "r.csv")]) == 0
    expected = Engine(THREE).run({"X.setpoint": [row[1] for row in ROWS], "command": commands})
    found = np.genfromtxt(tmp_path / "r.csv", delimiter=",", names=True, deletechars="")
    assert found["X.correction"].tolist() == expected["X.correction"].tolist()


@pytest.mark.parametrize("name", [name for name in WRITERS if name != "blanks.dat"])
def test_uncertainties_are_read_in_every_dialect(name: str, tmp_path: Path) -> None:
    rows: list[list[object]] = [["parameter", "standard_uncertainty", "unit"], ["EXX", 0.8, "um"], ["EYY", 2.5, "nm"]]
    WRITERS[name](tmp_path / name, rows)
    found = read_uncertainties(tmp_path / name, read_machine(models() / "five_axis").machine)
    assert {one.parameter: one.value for one in found} == {"EXX": pytest.approx(0.8e-3), "EYY": pytest.approx(2.5e-6)}


DAMAGED = {
    "old.xls": (b"\xd0\xcf\x11\xe0", "Workbooks are read as .xlsx, not as .xls: save it so."),
    "cut.csv.gz": (gzip.compress(b"a,b\n" * 999)[:30], "The file cannot be read: "),
    "none.gz": (b"no archive", "The file cannot be read: "),
    "none.xlsx": (b"no archive", "The workbook cannot be read: "),
    "none.parquet": (b"PAR1", "The file cannot be read: "),
    "none.feather": (b"", "The file cannot be read: "),
    "zero.csv": (b"\0\1\2\0\0", "The file is no text."),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_what_cannot_be_read_is_the_same_sentence_everywhere(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / name
    file.write_bytes(DAMAGED[name][0])
    machine = read_machine(models() / "five_axis").machine
    said = []
    for read, error in (
        (lambda: read_input(file), InputError),
        (lambda: read_trace(file, machine), InputError),
        (lambda: read_uncertainties(file, machine), UncertaintyError),
    ):
        with pytest.raises(error) as caught:
            read()
        said.append(str(caught.value))
    assert main(["run", str(file), "--machine", str(THREE)]) == 1
    said.append(capsys.readouterr().err.removeprefix("axcomp: ").strip())
    assert len(set(said)) == 1
    assert said[0].startswith(f"{file}: {DAMAGED[name][1]}")


def test_a_workbook_of_several_tables_is_no_trajectory(tmp_path: Path) -> None:
    made = openpyxl.Workbook()
    for page in (made.active, made.create_sheet("second")):
        page.append(["X.setpoint"])
        page.append([1.0])
    made.save(tmp_path / "two.xlsx")
    with pytest.raises(InputError, match="There are 2 tables in it; one is needed"):
        read_input(tmp_path / "two.xlsx")


def test_a_quoted_cell_may_go_on_over_lines_and_an_open_one_is_not_the_rest_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "p.csv").write_text('time,"X.set\npoint"\n0,1\n')
    assert list(read_input(tmp_path / "p.csv").columns) == ["X.set\npoint"]
    (tmp_path / "q.csv").write_text('time,X.setpoint\n0,"1\n0.001,2\n')
    assert read_input(tmp_path / "q.csv").columns["X.setpoint"].tolist() == [1.0, 2.0]
