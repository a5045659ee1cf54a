"""Inputs of runs: files on any time grid, repeated moves and sines."""

from pathlib import Path

import numpy as np
import pytest

from axcomp.engine import InputError, Limits, Motion, Sine, completed, read_input
from axcomp.model import models

DT = 0.001


def test_a_file_with_a_row_a_cycle_is_taken_to_the_bit() -> None:
    path = models() / "three_axis" / "input.csv"
    names = path.read_text().split("\n", 1)[0].replace('"', "").split(",")
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    columns = read_input(path).sampled(DT)
    for place, name in enumerate(names[1:], 1):
        assert np.array_equal(columns[name], table[:, place]), name


def test_other_time_grids_are_interpolated_and_switches_held(tmp_path: Path) -> None:
    file = tmp_path / "i.csv"
    file.write_text("time,X.setpoint,X.leadscrew.switch\n0,0,1\n0.0025,5,-1\n0.005,0,0\n")
    columns = read_input(file).sampled(DT, 0.008)
    assert columns["X.setpoint"] == pytest.approx(np.interp(np.arange(8) * DT, [0, 0.0025, 0.005], [0, 5, 0]))
    assert columns["X.leadscrew.switch"].tolist() == [1, 1, 1, -1, -1, 0, 0, 0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no row of inputs"),
        ("time,X.setpoint\n", "no row of inputs"),
        ("time\n0\n", "no input besides time"),
        ("time,X.setpoint\n0,1\n0,2\n", "time must ascend"),
        ("time,X.setpoint\n0,1\n0.1\n", r"i.csv:3: There are 1 cells for 2 columns"),
        ("time,X.setpoint\n0,much\n", r"i.csv:2: 'much' is no number, as X.setpoint"),
        ("time,X.setpoint\ninf,1\n", r"i.csv:2: 'inf' is no time"),
        ("a,a\n1,2\n", r"i.csv:1: Every column needs a name"),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "i.csv").write_text(text)
    with pytest.raises(InputError, match=said):
        read_input(tmp_path / "i.csv")


@pytest.mark.parametrize("separator", [";", "\t"])
def test_commas_are_decimal_points_where_they_separate_nothing(tmp_path: Path, separator: str) -> None:
    (tmp_path / "i.csv").write_text("time;X.setpoint\n0;-1,5\n0,001;2.25\n".replace(";", separator))
    found = read_input(tmp_path / "i.csv")
    assert found.columns["X.setpoint"].tolist() == [-1.5, 2.25]
    assert found.time is not None
    assert found.time.tolist() == [0.0, 0.001]


def test_moves_are_repeated_until_the_end() -> None:
    motion = Motion({"X": 0.0}, [{"X": 10.0}, {"dwell": 0.01}, {"X": 0.0}], limits=Limits(200.0, 3000.0, 1e5))
    once = motion.sampled(DT)["X.setpoint"]
    assert once[-1] == 0.0
    assert once.max() == 10.0
    many = motion.sampled(DT, 3 * (len(once) - 1) * DT)["X.setpoint"]
    assert len(many) == 3 * (len(once) - 1)
    assert np.array_equal(many[: len(once)], once)
    assert np.array_equal(many[len(once) : 2 * len(once) - 1], once[1:])


def test_moves_that_lead_nowhere_stand_still() -> None:
    assert np.array_equal(Motion({"X": 3.0}, [{"X": 3.0}]).sampled(DT, 0.01)["X.setpoint"], np.full(10, 3.0))


def test_a_sine_has_the_derivatives_of_its_position() -> None:
    columns = Motion(sines={"X": Sine(5.0, 20.0, 2.0, 30.0)}).sampled(DT, 1.0)
    position, velocity = columns["X.setpoint"], columns["X.velocity"]
    assert len(position) == 1000
    assert position[0] == pytest.approx(15.0)
    assert np.gradient(position, DT)[1:-1] == pytest.approx(velocity[1:-1], abs=0.02)
    assert np.gradient(velocity, DT)[1:-1] == pytest.approx(columns["X.acceleration"][1:-1], abs=0.2)


def test_what_follows_from_setpoints_is_added_where_the_machine_knows_it() -> None:
    position = 0.5 * 100.0 * (np.arange(100) * DT) ** 2
    known = {"X.setpoint", "X.velocity", "X.acceleration", "X.actual_position"}
    found = completed({"X.setpoint": position}, known, DT)
    # Over the cycle that ends there (semantics §4): the mean velocity of uniform acceleration is that of its middle.
    assert found["X.velocity"] == pytest.approx([0.0, *(100.0 * (np.arange(1, 100) - 0.5) * DT)])
    assert found["X.acceleration"][2:] == pytest.approx(np.full(98, 100.0))
    assert np.array_equal(found["X.actual_position"], position)
    given = {"X.setpoint": position, "X.velocity": np.zeros(100)}
    assert completed(given, {"X.velocity"}, DT).keys() == given.keys()
    assert not completed(given, known, DT)["X.velocity"].any()


def test_what_follows_from_setpoints_goes_the_short_way_over_the_seam_of_an_axis() -> None:
    folded = {"C.setpoint": np.array([359.9, 0.1, 0.3])}
    found = completed(folded, {"C.velocity", "C.acceleration"}, DT, {"C": 360.0})
    assert found["C.velocity"] == pytest.approx([0.0, 0.2 / DT, 0.2 / DT])
    assert found["C.acceleration"] == pytest.approx([0.0, 0.2 / DT**2, 0.0], abs=1e-5)
