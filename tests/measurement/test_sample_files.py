"""The sample files that ship: the same measurement in every form, and forms made here."""

import builtins
import sys

import numpy as np
import openpyxl
import pytest

from axcomp.measurement import MeasurementError, evaluate, read_positioning, read_positionings
from axcomp.model import models

SAMPLES = models() / "measurements"
PLAIN = [line.split(",") for line in (SAMPLES / "x.csv").read_text().split("\n") if line[:1].isdigit()]
WANTED = sorted((float(t), int(run), 1 if d == "+" else -1, float(v)) for t, run, d, v in PLAIN)


def readings(found):
    return sorted(zip(found.targets, found.runs, found.directions, found.deviations, strict=True))


@pytest.mark.parametrize(
    "name",
    [
        "x.csv",
        "x_german.csv",
        "x_utf16.txt",
        "x_column_a_run.csv",
        "x_actual.csv",
        "x_inch.csv",
        "x.rtl",
        "axes.csv",
        "axes.xlsx",
    ],
)
def test_every_form_says_the_same(name):
    found = read_positioning(SAMPLES / name, "X")
    assert np.array(readings(found)) == pytest.approx(np.array(WANTED), abs=1e-5)
    assert found.axis == "X"
    assert len(found.outliers()) == 0


def test_several_axes_are_several_measurements():
    for name in ("axes.csv", "axes.xlsx"):
        found = read_positionings(SAMPLES / name)
        assert [one.axis for one in found] == ["X", "Y"]
        assert pytest.approx(1.5, abs=1.0) == evaluate(found[1]).B
        with pytest.raises(MeasurementError, match="holds 2 measurements, of the axes X, Y: say which"):
            read_positioning(SAMPLES / name)


@pytest.mark.parametrize(("name", "what"), [("x_angular.rta", "angular"), ("x_straightness.rts", "straightness")])
def test_what_is_no_positioning_is_said_to_be_so(name, what):
    with pytest.raises(MeasurementError, match=rf"{name}:2: The header says .* {what} measurement"):
        read_positioning(SAMPLES / name)


@pytest.mark.parametrize("said", ["Angular", "Straightness", "Flatness", "Rotary", "Squareness", "Something"])
def test_the_header_counts_whatever_the_name(tmp_path, said):
    text = (SAMPLES / "x.rtl").read_text()
    (tmp_path / "x.rtl").write_text(text.replace("Linear", said))
    with pytest.raises(MeasurementError, match=rf"x.rtl:3: The header says .*{said}"):
        read_positioning(tmp_path / "x.rtl")


@pytest.fixture
def file(tmp_path):
    def write(text, name="m.csv", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return path

    return write


ONE = [(-100.0, 1, 1, 1.5), (-100.0, 1, -1, -2.25)]


@pytest.mark.parametrize(
    "text",
    [
        "sep=;\nTarget;Run;Direction;Deviation\n-100,0;1;+;1,5\n-100,0;1;-;-2,25\n",
        '"sep=,"\n"target","run","direction","deviation"\n"-100,0","1","+","1,5"\n"-100.0","1","-","-2.25"\n',
        "sep=\\t\ntarget\trun\tdirection\tdeviation\n-100\t1\t+\t1,5\n-100\t1\t-\t-2,25\n",
        "target;1 +;1 -\n-100;1,5;-2,25\n",
        "target,+1,-1\n-100,1.5,-2.25\n",
        "target;direction;run 1\n-100;+;1.5\n-100;-;-2.25\n",
        "target; 1↑ [mm]; 1↓ [mm]\n-100;0.0015;-0.00225\n",
        "target,actual 1 up [mm],actual 1 down [mm]\n-100,-99.9985,-100.00225\n",
        "Soll [mm];Lauf;Richtung;Ist [mm]\n-100;1;+;-99,9985\n-100;1;-;-100,00225\n",
        "target [m];run;direction;deviation [nm]\n-0,1;1;+;1.500,0\n-0,1;1;-;-2.250,0\n",
        "Machine: Mill 7\nAxis: X\n\ntarget;run;direction;deviation\n-100;1;+;1.5\n-100;1;-;-2.25\n",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-8-sig"])
def test_spreadsheets_are_read_as_they_come(file, text, encoding):
    found = read_positioning(file(text, encoding=encoding))
    assert np.array(readings(found)[::-1]) == pytest.approx(np.array(sorted(ONE)[::-1]))
    assert found.axis == ("X" if "Axis" in text else "")


def test_cells_of_a_column_a_run_may_be_empty(file):
    found = read_positioning(file("target;1 +;2 +\n0;1;\n10;;2\n20;3;4\n"))
    assert readings(found) == [(0, 1, 1, 1), (10, 2, 1, 2), (20, 1, 1, 3), (20, 2, 1, 4)]


def test_sections_begin_with_their_axis(file):
    text = "# axis: X\ntarget,run,direction,deviation\n0,1,+,1\n# axis: Y\n5,1,+,2\n# axis: Z\ntarget,1 +\n7,3\n"
    found = read_positionings(file(text))
    assert [(one.axis, readings(one)) for one in found] == [
        ("X", [(0, 1, 1, 1)]),
        ("Y", [(5, 1, 1, 2)]),
        ("Z", [(7, 1, 1, 3)]),
    ]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("target;1;2\n0;1;2\n", "m.csv:1: The columns of runs need a direction each"),
        ("target;1 +;1 +\n0;1;2\n", "m.csv:1: There are two columns for run 1 in one direction"),
        ("target;run;1 +\n0;1;2\n", "m.csv:1: Columns of runs do not go with others"),
        (
            "target,run,direction,deviation,actual\n0,1,+,1,2\n",
            "m.csv:1: There are columns for both actual and deviation",
        ),
        ("target,run,direction,deviation\n0,1,+,0.001\n100,1,+,100.01\n200,1,+,200\n", "is called actual"),
        ("target,1 +\n0,1,2\n", "m.csv:2: There are 3 cells for 2 columns"),
    ],
)
def test_what_cannot_be_read_is_said(file, text, sentence):
    with pytest.raises(MeasurementError) as error:
        read_positioning(file(text))
    assert sentence in str(error.value)


def test_old_and_damaged_workbooks_are_said(file, tmp_path):
    with pytest.raises(MeasurementError, match=r"read as .xlsx, not as .xls"):
        read_positioning(file("x", "m.xls"))
    with pytest.raises(MeasurementError, match="workbook cannot be read"):
        read_positioning(file("x", "m.xlsx"))
    with pytest.raises(MeasurementError, match="no measured value"):
        openpyxl.Workbook().save(tmp_path / "e.xlsx")
        read_positioning(tmp_path / "e.xlsx")
    with pytest.raises(MeasurementError, match="cannot be read"):
        read_positioning(tmp_path / "none.xlsx")


def test_without_openpyxl_the_extra_is_named(monkeypatch):
    real = builtins.__import__

    def without(name, *args, **more):
        if name.startswith("openpyxl"):
            raise ModuleNotFoundError(name=name)
        return real(name, *args, **more)

    monkeypatch.delitem(sys.modules, "openpyxl", raising=False)
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(MeasurementError, match=r"axcomp\[tables\]"):
        read_positioning(SAMPLES / "axes.xlsx")
