"""Cross compensation: linear over the master's raw setpoint, ends held, added to the slave."""

import numpy as np
import pytest
from driving import drive, to_and_fro

from axcomp.kinds import Cross, Leadscrew
from axcomp.model import Axis, Machine

X_POSITIONS = (-40.0, -10.0, 0.0, 0.5, 3.0, 80.0)
CORRECTIONS = (0.01, -0.02, 0.005, 0.03, 0.0, -0.01)


def machine(**options: object) -> Machine:
    return Machine((Axis(1, "X"), Axis(3, "Z", cross=Cross(1, X_POSITIONS, CORRECTIONS, **options))))


def test_the_correction_is_numpys_interpolation_over_a_trajectory(rng: np.random.Generator) -> None:
    x, z = to_and_fro(600, rng, -60.0, 100.0), to_and_fro(600, rng, -10.0, 10.0)
    run = drive(machine(), {"X.setpoint": x, "Z.setpoint": z})
    expected = np.interp(x, X_POSITIONS, CORRECTIONS)
    assert run["Z.cross_correction"] == pytest.approx(expected, abs=1e-15)
    assert run["Z.corrected_setpoint"] == pytest.approx(z + expected, abs=1e-12)
    assert run["Z.cross_active"].all()
    assert (run["X.corrected_setpoint"] == x).all()


@pytest.mark.parametrize(("x", "correction"), [*zip(X_POSITIONS, CORRECTIONS, strict=True), (-1e9, 0.01), (1e9, -0.01)])
def test_points_are_exact_and_ends_are_held(x: float, correction: float) -> None:
    assert drive(machine(), {"X.setpoint": [x]})["Z.cross_correction"] == [correction]


def test_the_example_of_the_manual() -> None:
    # 10735 → 3, 11523 → 5 … 10000000 → 1000, all in 0.1 µm; the slave is the axis whose list it is
    cross = Cross(1, (1.0735, 1.1523, 1000.0), (0.0003, 0.0005, 0.1), n_cycles=10)
    lists = Machine((Axis(1, "X"), Axis(3, "Z", cross=cross)))
    run = drive(lists, {"X.setpoint": [1.0735, 1.1129, 1.1523, 1000.0], "Z.setpoint": 200.0})
    assert run["Z.corrected_setpoint"] == pytest.approx([200.0003, 200.0004, 200.0005, 200.1], abs=1e-12)


@pytest.mark.parametrize("correction", [0.125, -1e-4, 1e3])
def test_one_point_corrects_by_a_constant(correction: float) -> None:
    lists = Machine((Axis(1, "X"), Axis(3, "Z", cross=Cross(1, (7.0,), (correction,)))))
    run = drive(lists, {"X.setpoint": [-1e14, 6.9, 7.0, 7.1, 1e14]})
    assert run["Z.cross_correction"].tolist() == [correction] * 5


def test_the_raw_setpoint_of_a_corrected_master_counts() -> None:
    lists = Machine(
        (
            Axis(1, "X", leadscrew=Leadscrew((0.0,), (-5.0,))),
            Axis(2, "Y", cross=Cross(1, (0.0, 10.0), (0.0, 10.0))),
            Axis(3, "Z", cross=Cross(2, (0.0, 10.0), (0.0, 10.0))),
        )
    )
    run = drive(lists, {"X.setpoint": [4.0], "Y.setpoint": [1.0], "Z.setpoint": [0.0]})
    assert [run[f"{name}.corrected_setpoint"][0] for name in "XYZ"] == [9.0, 5.0, 1.0]


def test_an_axis_may_be_its_own_master() -> None:
    lists = Machine((Axis(1, "X", cross=Cross(1, (0.0, 10.0), (0.0, 1.0))),))
    run = drive(lists, {"X.setpoint": [0.0, 5.0, 20.0]})
    assert run["X.corrected_setpoint"].tolist() == [0.0, 5.5, 21.0]


def test_only_the_master_must_be_referenced() -> None:
    master, slave = np.array([[1, 1], [1, 0], [0, 1], [0, 0]], bool).T
    run = drive(machine(), {"X.setpoint": 0.5, "X.referenced": master, "Z.referenced": slave})
    assert run["Z.cross_correction"] == pytest.approx([0.03, 0.03, 0.0, 0.0])


def test_the_order_of_the_axes_does_not_matter() -> None:
    axes = machine().axes
    x = np.linspace(-50.0, 90.0, 101)
    forwards, backwards = (drive(Machine(order), {"X.setpoint": x}) for order in (axes, axes[::-1]))
    assert (forwards["Z.cross_correction"] == backwards["Z.cross_correction"]).all()
