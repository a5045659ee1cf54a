"""Positioning measurements read from tables and Renishaw files, whole and damaged."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from axcomp.measurement import MeasurementError, joined, read_positioning

RTL = """\
HEADER::
File type  : rtl
Owner      : Linear
Version no : 1.0

TARGET DATA::
Filetype  : ISO
Target-count: 4
Targets :
  0.000000    100.000000
  200.000000
  300.500000
Flags: 16 0 2 0

USER-TEXT::
Machine: Mill 7
Date:12:30 Mar 02 2024
Axis:X

RUNS::
Run-count:3

DEVIATIONS::
Run Target Data:
  1     1        0.100
  1     2        1.500
  1     3        2.000
  1     4       -1.250
  2     4       -0.500
  2     3        3.000
  2     2        2.500
  2     1        1.000
  3     1        0.200
  3     2        1.700

ENVIRONMENT::
     Air temp   Air press   Air humid
     20.01      1001.2      40.0
EQUIPMENT::
EOF::
"""


@pytest.fixture
def file(tmp_path):
    def write(text, name="m.csv", encoding="utf-8"):
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return path

    return write


def readings(measurement):
    columns = (measurement.targets, measurement.runs, measurement.directions, measurement.deviations)
    return list(zip(*(column.tolist() for column in columns), strict=True))


@pytest.mark.parametrize(
    "text",
    [
        "target,run,direction,deviation\n-100,1,+,1.5\n-100,1,-,-2.25\n",
        "-100,1,1,1.5\n-100,1,-1,-2.25\n",
        "Direction;Deviation [mm];Target (m);Run\npos;0,0015;-0,1;1\nneg;-0,00225;-0,1;1\n",
        "# axis: Y\n\n// made by hand\ndeviation_nm target_um run direction # all four\n"
        "1500 -100000 1 up\n-2250 -1e5 1 DOWN\n",
        "position\tcycle\tdirection\terror\n-100\t1\tforward\t1.5\n-100\t1\treverse\t−2.25\n",
    ],
    ids=["commas", "no names", "semicolons and decimal commas", "blanks, units and comments", "tabs and aliases"],
)
def test_tables_are_read_in_every_form(file, text):
    measurement = read_positioning(file(text))
    assert np.array(readings(measurement)) == pytest.approx(np.array([(-100.0, 1, 1, 1.5), (-100.0, 1, -1, -2.25)]))
    assert measurement.unit == "mm"
    assert measurement.axis == ("Y" if "axis" in text else "")


def test_angles_make_a_rotary_axis(file):
    measurement = read_positioning(file("target [°],run,direction,deviation [arcsec]\n30,1,+,3.6\n"))
    assert measurement.unit == "deg"
    assert measurement.deviation_unit == "″"
    assert np.array(readings(measurement)) == pytest.approx(np.array([(30.0, 1, 1, 3.6)]))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "m.csv: There is no measured value in it."),
        ("target,run,direction,deviation\n", "m.csv: There is no measured value in it."),
        ("0,1,+\n", "m.csv:1: There are 3 cells for 4 columns."),
        ("0,1,+,1\n1,1,+,x\n", "m.csv:2: “x” is no number, as deviation has to be."),
        ("0,1,+,1\n1,1,+,nan\n", "m.csv:2: “nan” is no number, as deviation has to be."),
        ("0,1,+,1\n1,1,+,1e10\n", "m.csv:2: 1e10 is too large for a measured deviation."),
        ("0,1,2,1\n", "m.csv:1: “2” is no direction (+ or −), as direction has to be."),
        ("0,1.5,+,1\n", "m.csv:1: 1.5 is no number of a run; 1, 2, … are."),
        ("0,1,+,1\n\n0,1,+,2\n", "m.csv:3: Target 0 of run 1 is there already, in line 1."),
        ("target,run,deviation\n", "m.csv:1: There is no column for direction."),
        ("target,target,run\n", "m.csv:1: There are two columns for target."),
        ("place,run\n", "m.csv:1: “place” is none of the columns target, run, direction, deviation, actual."),
        ("target [ft],run\n", "m.csv:1: “ft” is no unit of target; one of "),
        ("target [deg],run,direction,deviation [um]\n1,1,+,1\n", "m.csv: Lengths do not go with angles"),
        ("\0\1\2", "m.csv: The file is no text."),
    ],
)
def test_damaged_tables_give_a_sentence_with_the_line(file, text, sentence):
    with pytest.raises(MeasurementError) as error:
        read_positioning(file(text))
    assert sentence in str(error.value)


def test_a_missing_file_gives_a_sentence(tmp_path):
    with pytest.raises(MeasurementError, match="cannot be read"):
        read_positioning(tmp_path / "none.csv")


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_a_renishaw_file_is_read_with_the_directions_of_its_runs(file, newline):
    measurement = read_positioning(file(RTL.replace("\n", newline), "x.RTL", "latin-1"))
    assert measurement.axis == "X"
    assert measurement.details["machine"] == "Mill 7"
    assert readings(measurement)[3:9] == [
        (300.5, 1, 1, -1.25),
        (300.5, 1, -1, -0.5),
        (200.0, 1, -1, 3.0),
        (100.0, 1, -1, 2.5),
        (0.0, 1, -1, 1.0),
        (0.0, 2, 1, 0.2),
    ]


def test_a_renishaw_file_with_one_target_goes_there_and_back_by_turns(file):
    text = RTL[: RTL.index("TARGET")] + (
        "TARGET DATA::\nTargets : 5.0\nRUNS::\nDEVIATIONS::\nRun Target Data:\n1 1 1.0\n2 1 2.0\n3 1 3.0\nEOF::\n"
    )
    assert readings(read_positioning(file(text, "x.rtl"))) == [(5.0, 1, 1, 1.0), (5.0, 1, -1, 2.0), (5.0, 2, 1, 3.0)]


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("Target-count: 4", "Target-count: 5", "x.rtl:8: The file has 4 targets, not 5."),
        ("Target-count: 4", "Target-count: four", "x.rtl:8: “four” is no count."),
        ("Run-count:3", "Run-count:2", "x.rtl:21: The file has 3 runs, not 2."),
        ("200.000000", "2oo", "x.rtl:11: “2oo” is no number."),
        ("  1     4  ", "  1     9  ", "x.rtl:28: There is no target 9; the file has 4."),
        ("  1     3        2.000", "  1     3", "x.rtl:27: A reading has three numbers"),
        ("  1     3  ", "  1     1  ", "x.rtl:27: The targets of run 1 neither only ascend nor only descend here."),
        ("Run Target Data:", "Data:", "x.rtl: There are no readings in it"),
        ("Targets :", "Goals :", "x.rtl:25: There is no target 1; the file has 0."),
    ],
)
def test_damaged_renishaw_files_give_a_sentence_with_the_line(file, old, new, sentence):
    assert old in RTL
    with pytest.raises(MeasurementError) as error:
        read_positioning(file(RTL.replace(old, new, 1), "x.rtl"))
    assert sentence in str(error.value)


@settings(deadline=None, max_examples=120)
@given(st.data())
def test_any_text_is_read_or_refused(tmp_path_factory, data):
    lines = RTL.split("\n")
    name = data.draw(st.sampled_from(["f.rtl", "f.csv"]))
    pieces = data.draw(st.lists(st.one_of(st.sampled_from(lines), st.text(max_size=20)), max_size=40))
    path = tmp_path_factory.mktemp("any") / name
    path.write_bytes("\n".join(pieces).encode("utf-8", "surrogatepass"))
    try:
        measurement = read_positioning(path)
    except MeasurementError as error:
        assert str(error).startswith(str(path))
    else:
        assert np.isfinite(measurement.deviations).all()
        assert set(measurement.directions) <= {1, -1}


def test_runs_of_joined_files_are_counted_on(file):
    first = read_positioning(file("0,1,+,1\n0,2,+,2\n", "a.csv"))
    second = read_positioning(file("0,1,+,3\n", "b.csv"))
    assert joined([first, second]).runs.tolist() == [1, 2, 3]
    with pytest.raises(MeasurementError, match=r"c.csv: It is in deg, .*a.csv in mm."):
        joined([first, read_positioning(file("target [deg],run,direction,deviation [mdeg]\n0,1,+,3\n", "c.csv"))])
