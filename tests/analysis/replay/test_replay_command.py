"""``axcomp replay``: reading, figures, exit status."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from traces import example, recorded, write_german

from axcomp.cli import main
from axcomp.kinds import Leadscrew
from axcomp.lists import write_machine
from axcomp.model import Axis, Machine, models

X = np.concatenate([np.linspace(0.0, 50.0, 51), np.linspace(50.0, 20.0, 31)[1:]])
TABLE = ((0.0, 20.0, 60.0), (0.0, 0.010, -0.004))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_machine(Machine((Axis(1, "X", leadscrew=Leadscrew(*TABLE)),)), tmp_path / "lists")
    return tmp_path


def replay(folder: Path, text: str, *options: str) -> int:
    (folder / "trace.csv").write_text(text, encoding="utf-8")
    return main(["replay", str(folder / "trace.csv"), "--machine", str(folder / "lists"), *options])


def rows(corrections: np.ndarray, head: str = "X.setpoint;X.correction") -> str:
    lines = (f"{x:.4f};{c:.4f}".replace(".", ",") for x, c in zip(X, corrections, strict=True))
    return "".join(f"{line}\n" for line in (head, *lines))


def test_a_trace_that_agrees(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine, columns = example()
    outputs = [f"{axis}.{what}" for axis in "XYZ" for what in ("correction", "corrected_setpoint", "current")]
    write_german(tmp_path / "t.csv", recorded(machine, columns, *outputs), "latin-1")
    options = ["--map", "time=Zeit", "--within", "0.1"]
    for axis in "XYZ":
        options += ["--within", f"{axis}.current=10"]
    assert main(["replay", str(tmp_path / "t.csv"), "--machine", str(models() / "three_axis"), *options]) == 0
    out = capsys.readouterr().out
    assert out.count("agrees") == 9
    assert "differs by at most 0.05" in out
    assert all(len(line) <= 80 for line in out.splitlines())


def test_the_figures_are_those_of_numpy(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = rows(np.interp(X, *TABLE), "SollX [mm];KorrX [mm]")
    words = ["--map", "X.setpoint=SollX,X.correction=KorrX", "--cycle-time", "0.004"]
    assert replay(folder, text, *words, "--format", "json") == 1
    (found,) = json.loads(capsys.readouterr().out)["outputs"]
    table = list(csv.reader((line.replace(",", ".") for line in text.splitlines()[1:]), delimiter=";"))
    x, trace = np.array(table, dtype=float).T
    difference = 1e3 * (trace + np.interp(x, *TABLE))
    worst = int(np.argmax(np.abs(difference)))
    assert found["largest"] == pytest.approx(np.abs(difference).max(), abs=1e-9)
    assert found["rms"] == pytest.approx(np.sqrt(np.mean(difference**2)), abs=1e-9)
    assert (found["line"], found["places"]) == (worst + 2, f"X = {x[worst]:g} mm")
    assert found["time"] == pytest.approx(0.004 * worst)
    assert (found["unit"], found["within"], found["agrees"]) == ("µm", 0.5, False)
    assert found["explanations"][0]["text"] == "the sign of the leadscrew compensation inverted"
    assert found["explanations"][0]["left"] == pytest.approx(0.0, abs=0.05 + 1e-9)


@pytest.mark.parametrize(
    ("title", "factor", "word"),
    [
        ("Korr", 1e-3, "Korr[um]"),
        ("Korr [µm]", 1e-3, "Korr"),
        ("Korr (0.1um)", 1e-4, "Korr"),
        ("Korr [mm]", 1e-4, "Korr[0,1 µm]".replace(",", ".")),
        ("Korr [mm]", 1.0, "Korr [mm]"),
    ],
)
def test_units_of_titles_and_of_the_map(folder: Path, title: str, factor: float, word: str) -> None:
    text = rows((np.round(-np.interp(X, *TABLE), 4) + 0.0) / factor, f"X.setpoint;{title}")
    assert replay(folder, text, "--map", f"X.correction={word}") == 0
    assert replay(folder, text.replace(";0,0000", ";5,0000", 1), "--map", f"X.correction={word}") == int(factor != 1e-4)


def test_masters_without_setpoints_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine, columns = example()
    trace = recorded(machine, columns, "X.correction", "Y.current")
    del trace["Z.setpoint"]
    write_german(tmp_path / "t.csv", trace)
    assert main(["replay", str(tmp_path / "t.csv"), "--machine", str(models() / "three_axis")]) == 1
    assert "taken as 0, though outputs depend on it: Z.setpoint." in capsys.readouterr().err


def test_velocities_have_units_by_time(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "X.setpoint;X.correction;V [mm/min];A [m/s²]\n0;0;60;1\n0,001;0;60;1\n"
    words = ["--map", "X.velocity=V,X.acceleration=A"]
    assert replay(folder, text, *words) == 0
    assert replay(folder, text, "--map", "X.velocity=A") == 2
    assert "'m/s²' is no unit of X.velocity" in capsys.readouterr().err


def test_rows_that_are_no_cycles_are_compared_where_they_are(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every third cycle was recorded; a linear motion and a linear table between."""
    x = np.linspace(0.0, 18.0, 7)
    lines = [f"{3 * k};{q};{-1e4 * np.interp(q, *TABLE):.0f}" for k, q in enumerate(x)]
    text = "\n".join(["T [ms];X.setpoint;X.correction [0.1um];Status", *(f"{line};ok" for line in lines)]).replace(
        ".", ","
    )
    text = text.replace("X,", "X.").replace("0,1um", "0.1um")
    assert replay(folder, text, "--map", "time=T", "--cycle-time", "0.001", "--within", "0.01") == 0
    said = capsys.readouterr().err
    assert "The rows are 0.003 s apart, a cycle takes 0.001 s" in said
    assert "Columns that are not used: Status." in said
    assert "X.velocity, X.acceleration not given" in said


def test_a_lost_row_leaves_the_clock_as_it_is(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lines = [f"{2 * k};{k};{-1e3 * np.interp(k, *TABLE):.1f}" for k in range(30) if k != 20]
    text = "\n".join(["T [ms],X.setpoint,X.correction [um]".replace(",", ";"), *lines])
    assert replay(folder, text, "--map", "time=T", "--within", "0.11") == 0
    assert "not equally far apart, a cycle takes 0.002 s" in capsys.readouterr().err


def test_a_picture_of_both(folder: Path) -> None:
    path = folder / "p.png"
    assert replay(folder, rows(np.interp(X, *TABLE)), "--plot", str(path)) == 1
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("X.setpoint\n1\n", [], "A setpoint and an output are needed at least"),
        ("A;B\n1;2\n", ["--map", "X.setpoint=A"], "The columns are A, B."),
        ("A;B\n1;2\n", ["--map", "X.setpoint=A,X.correction=C"], "There is no column 'C'. The columns are A, B."),
        ("A;B\n1;2\n", ["--map", "X.setpoint=A,Q.correction=B"], "“Q.correction=B” is no NAME=COLUMN; the names are"),
        ("A;B\n1;2\n", ["--map", "X.setpoint"], "“X.setpoint” is no NAME=COLUMN"),
        (
            "A;B\n1;2\n",
            ["--map", "X.setpoint=A,X.correction=B[kg]"],
            "'kg' is no unit of X.correction, which counts in mm",
        ),
        ("X.setpoint;X.correction\n1;2\n1;x\n", [], "trace.csv:3: 'x' is no number, as X.correction"),
        ("X.setpoint;X.correction\n1\n", [], "trace.csv:2: There are 1 cells for 2 columns"),
        ("time;X.setpoint;X.correction\n0;1;2\n0;1;2\n", [], "trace.csv:3: time must ascend"),
        (
            "X.setpoint;X.correction\n1;2\n",
            ["--within", "Y=1"],
            "“Y=1” is no [OUTPUT=]VALUE; the outputs are X.correction",
        ),
        ("X.setpoint;X.correction\n1;2\n", ["--cycle-time", "0"], "0 s is no cycle time"),
        ("X.setpoint;X.correction\n1;2\n", ["--skip", "1"], "X.correction: there is no row to compare"),
        ("X.setpoint;X.correction\n1;nan\n", [], "X.correction: there is no row to compare"),
    ],
)
def test_what_cannot_be_run_is_said(
    folder: Path, capsys: pytest.CaptureFixture[str], text: str, options: list[str], said: str
) -> None:
    assert replay(folder, text, *options) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert not captured.out


def test_files_that_are_not_there(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["replay", str(folder / "none.csv"), "--machine", str(folder / "lists")]) == 2
    assert "none.csv: The file cannot be read" in capsys.readouterr().err
    (folder / "trace.csv").write_text("X.setpoint;X.correction\n1;2\n")
    assert main(["replay", str(folder / "trace.csv"), "--machine", str(folder / "nowhere")]) == 2
    assert "There is no axis in these lists" in capsys.readouterr().err
    with pytest.raises(SystemExit) as stopped:
        main(["replay", str(folder / "trace.csv")])
    assert stopped.value.code == 2


def test_a_column_can_be_left_out(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "time;X.setpoint;X.correction\n0;1;0\n0;1;0\n"
    assert replay(folder, text, "--map", "time=") == 0
    assert "Columns that are not used: time." in capsys.readouterr().err
