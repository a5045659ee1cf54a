from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.engine import Engine
from axcomp.kinds import Leadscrew
from axcomp.lists import write_machine
from axcomp.model import Axis, Machine


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    screw = Leadscrew((0.0, 10.0), (0.0, -1.0))
    write_machine(Machine((Axis(1, "X", leadscrew=screw), Axis(2, "Y"))), tmp_path / "lists")
    return tmp_path


def run(folder: Path, program: str, *options: str) -> int:
    path = folder / "program.csv"
    path.write_text(program, encoding="utf-8")
    output = ["--output", str(folder / "result.csv")]
    return main(["run", str(path), "--machine", str(folder / "lists"), *output, *options])


def results(folder: Path) -> dict[str, list[float]]:
    with (folder / "result.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def test_rows_run_as_cycles_with_their_commands(folder: Path) -> None:
    program = "time,X.setpoint,X.unreferenced,command\n5,10,false,\n5.002,,,X[COMP OFF LEAD]\n5.004,5,,\n"
    assert run(folder, program) == 0
    found = results(folder)
    assert found["X.corrected_setpoint"] == [11.0, 10.0, 5.0]
    assert found["time"] == [5.0, 5.002, 5.004]


def test_a_program_may_consist_of_commands_alone(folder: Path) -> None:
    assert run(folder, 'command\n"X[COMP OFF_ALL] ; no more, please"\n""\n \n"X[COMP \\\n ON LEAD]"\n') == 0
    assert results(folder)["X.leadscrew.active"] == [0.0, 1.0]


def test_the_results_are_those_of_the_engine(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    x = np.linspace(0.0, 10.0, 30)
    program = "X.setpoint\n" + "".join(f"{q!r}\n" for q in x.tolist())
    (folder / "program.csv").write_text(program)
    assert main(["run", str(folder / "program.csv"), "--machine", str(folder / "lists")]) == 0
    lines = capsys.readouterr().out.splitlines()
    expected = Engine(folder / "lists").run({"X.setpoint": x})
    assert lines == list(expected.csv_lines())


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("", "program.csv: There is no row of inputs in it."),
        ("X.setpoint,X.setpoint\n1,2\n", "program.csv:1: Every column needs a name of its own."),
        ("X.setpoint\n", "There is no row"),
        ("X.setpoint\n1\n2,3\n", "program.csv:3: There are 2 cells for 1 columns."),
        ("X.setpoint\n1\none\n", "program.csv:3: 'one' is no number, as X.setpoint has to be."),
        ("Q.setpoint\n1\n", "program.csv:1: Q.setpoint is no input"),
        ("time,X.setpoint\n0,1\n0.001,1\n0.003,1\n", "program.csv:3: the rows are not equally far apart"),
        ("time,X.setpoint\n0,1\n0,1\n", "not equally far apart"),
        ("X.setpoint,command\n1,\n2,X[COMP ONE]\n3,Q[COMP ON]\n",
         "program.csv:3: character 8: ON or OFF or OFF_ALL is expected, not “ONE”"),
        ("X.setpoint,command\n1,\n2,X[COMP ONE]\n3,Q[COMP ON]\n", "program.csv:4: character 1: an axis (X, Y)"),
    ],
)  # fmt: skip
def test_a_faulty_program_is_told_by_file_and_line(
    folder: Path, capsys: pytest.CaptureFixture[str], program: str, message: str
) -> None:
    assert run(folder, program) == 1
    assert message in capsys.readouterr().err
    assert not (folder / "result.csv").exists()


def test_the_cycle_time_must_be_that_of_the_rows(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(folder, "time,X.setpoint\n0,1\n0.002,2\n", "--cycle-time", "0.001") == 1
    assert "0.002 s apart, the cycles 0.001 s" in capsys.readouterr().err


def test_notices_and_findings_go_to_standard_error(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "lists" / "achsmd2.lis").write_text("kopf.achs_nr 2\nkopf.log_achs_name Y\nspam 1\n")
    assert run(folder, "command\nX[COMP ON]\n") == 0
    told = capsys.readouterr().err
    assert "spam" in told
    assert "note: X[COMP ON] names no kind" in told


def test_the_diagnosis_file_is_written_at_the_start_and_with_every_update(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    (tmp_path / "hochlauf.lis").write_text("vol_comp[0].file_name v.lis\nvol_comp[0].max_records 9\n")
    (tmp_path / "v.lis").write_text("x 1\ny 2\nz 3\nfile[0] e.csv\ndiagnosis_file d.xlsx\n")
    (tmp_path / "e.csv").write_text("X0X\n0.01\n")
    program = tmp_path / "program.csv"
    for command, values in (("", [0.01]), ("#VOLCOMP [ID 0 UPDATE]", [0.01])):
        program.write_text(f"axis1.setpoint,command\n0,{command}\n")
        (tmp_path / "d.xlsx").unlink(missing_ok=True)
        assert main(["run", str(program), "--machine", str(tmp_path), "--output", str(tmp_path / "out.csv")]) == 0
        cells = [cell for row in openpyxl.load_workbook(tmp_path / "d.xlsx").worksheets[1].values for cell in row]
        assert [cell for cell in cells if cell in values] == values
        assert capsys.readouterr().err.count("d.xlsx is written.") == 1 + bool(command)
