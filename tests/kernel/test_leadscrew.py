"""Leadscrew compensation: subtracted, by direction, softly over a reversal, over the seam of a modulo axis."""

import numpy as np
import pytest
from driving import drive, forward, soft, to_and_fro, walk
from numpy.typing import NDArray

from axcomp.kinds import Cross, CrosstalkCurve, Leadscrew, Plane
from axcomp.model import Axis, AxisType, Machine, ModuloRange

POSITIONS = (-50.0, -20.0, -19.5, 0.0, 30.0, 31.0, 90.0)
POSITIVE = (0.010, -0.004, 0.006, 0.000, -0.020, 0.013, 0.005)
NEGATIVE = (0.004, 0.009, -0.001, 0.015, -0.011, 0.020, -0.008)
BILATERAL = Leadscrew(POSITIONS, POSITIVE, NEGATIVE)


def machine(leadscrew: Leadscrew, **options: object) -> Machine:
    return Machine((Axis(1, "X", leadscrew=leadscrew, **options),))


def directions(inputs: NDArray[np.float64]) -> NDArray[np.int64]:
    """Sign of the last change of the input; positive before any motion."""
    return forward(np.sign(np.diff(inputs, prepend=inputs[0])), 1)


def expected_delta(
    inputs: NDArray[np.float64], leadscrew: Leadscrew, cycles: int, **interp: float
) -> NDArray[np.float64]:
    """Δ(in) over a whole run of inputs, with what NumPy interpolates; ``period``: of a modulo axis."""
    positive = np.interp(inputs, leadscrew.positions, leadscrew.positive, **interp)
    if leadscrew.negative is None:
        return positive
    negative = np.interp(inputs, leadscrew.positions, leadscrew.negative, **interp)
    way = soft(walk(directions(inputs) > 0, max(cycles, 1), max(cycles, 1)), max(cycles, 1))
    return negative + way * (positive - negative)


class TestTheManualsExample:
    """Programmed 19866.7 µm, measured 19856.5 and 19874.7 µm: −102 and 80 in 0.1 µm at table[2]."""

    POINTS = (-20.0, -19.9306, -19.8667, -19.8001, 33.4488, 33.5591)
    LIST = Leadscrew(POINTS, (0.0, 0.0024, -0.0102, 0.0, 0.0, -0.0055), (0.0, 0.0067, 0.0080, 0.0, 0.0, 0.0114))

    def test_upwards_the_setpoint_is_raised_by_what_the_axis_fell_short(self) -> None:
        run = drive(machine(self.LIST), {"X.setpoint": [-20.0, -19.9306, -19.8667]})
        assert run["X.corrected_setpoint"][-2:] == pytest.approx([-19.9306 - 0.0024, -19.8667 + 0.0102], abs=1e-12)
        assert run["X.leadscrew_correction"][-1] == 0.0102

    def test_downwards_the_setpoint_is_lowered_by_what_the_axis_went_too_far(self) -> None:
        run = drive(machine(self.LIST), {"X.setpoint": [-19.0, -19.8667]})
        assert run["X.leadscrew_correction"][-1] == -0.0080
        assert run["X.corrected_setpoint"][-1] == pytest.approx(-19.8667 - 0.0080, abs=1e-12)

    def test_halfway_between_two_points(self) -> None:
        at = (-19.9306 - 19.8667) / 2
        run = drive(machine(self.LIST), {"X.setpoint": [at - 1, at, at + 1, at]})
        assert run["X.leadscrew_correction"][[1, 3]] == pytest.approx([(0.0102 - 0.0024) / 2, -(0.0067 + 0.0080) / 2])

    def test_the_ends_are_held(self) -> None:
        run = drive(machine(self.LIST), {"X.setpoint": [34.0, 400.0, 35.0]})
        assert run["X.leadscrew_correction"].tolist() == [0.0055, 0.0055, -0.0114]


def test_the_corrected_axis_arrives_where_it_was_programmed() -> None:
    # an axis that really ends up Δ beyond its setpoint: subtracting Δ leaves the error of second order only
    table = Leadscrew(POSITIONS, POSITIVE)
    x = np.linspace(-49.0, 89.0, 400)
    corrected = drive(machine(table), {"X.setpoint": x})["X.corrected_setpoint"]
    arrived = corrected + np.interp(corrected, POSITIONS, POSITIVE)
    assert np.abs(arrived - x).max() < 0.03 * np.abs(np.interp(x, POSITIONS, POSITIVE)).max()


def test_unilateral_is_numpys_interpolation_in_both_directions(rng: np.random.Generator) -> None:
    x = np.concatenate([to_and_fro(500, rng, -70.0, 110.0), POSITIONS, POSITIONS[::-1]])
    run = drive(machine(Leadscrew(POSITIONS, POSITIVE), backlash_cycles=9), {"X.setpoint": x})
    assert run["X.leadscrew_correction"] == pytest.approx(-np.interp(x, POSITIONS, POSITIVE), abs=1e-15)


@pytest.mark.parametrize("cycles", [0, 1, 2, 5, 20])
def test_bilateral_over_reversals_standstill_and_turning_again_midway(cycles: int, rng: np.random.Generator) -> None:
    x = to_and_fro(1500, rng, -70.0, 110.0, stand=0.4)
    run = drive(machine(BILATERAL, backlash_cycles=cycles), {"X.setpoint": x})
    expected = expected_delta(x, BILATERAL, cycles)
    assert run["X.leadscrew_correction"] == pytest.approx(-expected, abs=1e-15)
    assert run["X.corrected_setpoint"] == pytest.approx(x - expected, abs=1e-12)


def test_a_reversal_takes_exactly_n_backlash_cyc_cycles() -> None:
    constant = Leadscrew((0.0,), (0.001,), (-0.003,))
    run = drive(machine(constant, backlash_cycles=4), {"X.setpoint": [5, 6, 5, 4, 3, 2, 1, 0, 0]})
    w = np.sin(np.pi / 8 * np.array([4, 4, 3, 2, 1, 0, 0, 0, 0])) ** 2
    assert run["X.leadscrew_correction"] == pytest.approx(-(-0.003 + w * 0.004), abs=1e-17)


def test_a_reversal_goes_on_while_the_axis_stands() -> None:
    constant = Leadscrew((0.0,), (1.0,), (0.0,))
    run = drive(machine(constant, backlash_cycles=3), {"X.setpoint": [5.0, 4.0, 4.0, 4.0, 4.0]})
    assert run["X.leadscrew_correction"] == pytest.approx([-1.0, -0.75, -0.25, 0.0, 0.0])


def test_before_any_motion_the_direction_is_positive() -> None:
    run = drive(machine(BILATERAL, backlash_cycles=5), {"X.setpoint": [30.0] * 4, "X.velocity": -1.0})
    assert run["X.leadscrew_correction"].tolist() == [0.020] * 4


@pytest.mark.parametrize("cross", [-0.5, 0.5])
def test_a_correction_that_is_there_at_the_start_is_no_motion(cross: float) -> None:
    constant = Leadscrew((0.0,), (0.001,), (-0.003,))
    axes = (Axis(1, "X", leadscrew=constant, cross=Cross(1, (0.0,), (cross,)), backlash_cycles=3),)
    run = drive(Machine(axes), {"X.setpoint": [10.0] * 5})
    assert run["X.leadscrew_correction"].tolist() == [-0.001] * 5


class TestOtherCompensations:
    TABLE = Leadscrew((0.0, 10.0), (0.0, 1.0), (5.0, 6.0))

    def lists(self, *, without: bool) -> Machine:
        leadscrew = Leadscrew(*(getattr(self.TABLE, f) for f in ("positions", "positive", "negative")), False, without)
        z = Axis(3, "Z", cross=Cross(1, (0.0, 10.0), (0.0, 2.0)), leadscrew=leadscrew)
        return Machine((Axis(1, "X"), z))

    def test_they_shift_its_position_and_decide_its_direction(self) -> None:
        # Z stands at 4; the cross compensation lowers it while X goes down
        run = drive(self.lists(without=False), {"X.setpoint": [10.0, 10.0, 5.0, 5.0], "Z.setpoint": 4.0})
        assert run["Z.leadscrew_correction"] == pytest.approx([-0.6, -0.6, -5.5, -5.5])
        assert run["Z.corrected_setpoint"] == pytest.approx([5.4, 5.4, -0.5, -0.5])

    def test_set_pos_without_comp_leaves_position_and_direction_to_the_raw_setpoint(self) -> None:
        run = drive(self.lists(without=True), {"X.setpoint": [10.0, 10.0, 5.0, 5.0], "Z.setpoint": 4.0})
        assert run["Z.leadscrew_correction"] == pytest.approx([-0.4] * 4)
        assert run["Z.corrected_setpoint"] == pytest.approx([5.6, 5.6, 4.6, 4.6])

    def test_the_whole_chain_against_numpy(self, rng: np.random.Generator) -> None:
        positions = np.linspace(-100, 100, 9)
        cross, grid = rng.uniform(-3, 3, 9), rng.uniform(-2, 2, 9)
        z = Axis(
            3,
            "Z",
            cross=Cross(1, tuple(positions.tolist()), tuple(cross.tolist())),
            plane=Plane(2, 2, -100.0, 0.0, 25.0, 1.0, (tuple(grid.tolist()),)),
            crosstalk=CrosstalkCurve(1, (-1e3, 1e3), (-0.4, 0.6)),
            leadscrew=BILATERAL,
            backlash_cycles=6,
        )
        x, y, raw = (to_and_fro(800, rng, -120, 120) for _ in range(3))
        a = rng.uniform(-2e3, 2e3, 800)
        run = drive(
            Machine((Axis(1, "X"), Axis(2, "Y"), z)),
            {"X.setpoint": x, "Y.setpoint": y, "Z.setpoint": raw, "X.acceleration": a},
        )
        others = np.interp(x, positions, cross) + np.interp(y, positions, grid) + np.interp(a, (-1e3, 1e3), (-0.4, 0.6))
        delta = expected_delta(raw + others, BILATERAL, 6)
        assert run["Z.leadscrew_correction"] == pytest.approx(-delta, abs=1e-12)
        assert run["Z.correction"] == pytest.approx(others - delta, abs=1e-12)
        assert run["Z.corrected_setpoint"] == pytest.approx(raw + others - delta, abs=1e-12)


class TestModulo:
    POSITIONS = (10.0, 100.0, 200.0, 340.0)
    TABLE = Leadscrew(POSITIONS, (0.010, -0.020, 0.005, 0.013), (0.002, 0.001, -0.030, -0.007), modulo=True)

    def lists(self, **options: object) -> Machine:
        modulo = options.pop("range", ModuloRange(0.0, 360.0))
        return Machine((Axis(4, "C", AxisType.ROTARY, modulo, leadscrew=self.TABLE, **options),))

    @pytest.mark.parametrize("cycles", [0, 6])
    @pytest.mark.parametrize("written", ["continuous", "folded", "folded around 0"])
    def test_turning_both_ways_over_the_seam(self, written: str, cycles: int, rng: np.random.Generator) -> None:
        c = np.cumsum(np.where(np.sin(np.arange(4000) / 300) > 0, 1, -1) * rng.uniform(0.0, 3.0, 4000)) + 350.0
        c[1000:1100] = c[1000]
        given_as = {"continuous": c, "folded": c % 360.0, "folded around 0": (c + 180.0) % 360.0 - 180.0}[written]
        run = drive(self.lists(backlash_cycles=cycles), {"C.setpoint": given_as})
        assert (c.max() - c.min()) > 720.0
        expected = expected_delta(c, self.TABLE, cycles, period=360.0)
        assert run["C.leadscrew_correction"] == pytest.approx(-expected, abs=1e-12)

    @pytest.mark.parametrize("step", [1.0, -1.0])
    def test_the_gap_from_the_last_point_back_to_the_first_is_interpolated(self, step: float) -> None:
        c = np.arange(335.0, 376.0)[:: int(step)]
        values = self.TABLE.positive if step > 0 else self.TABLE.negative
        assert values is not None
        run = drive(self.lists(), {"C.setpoint": c % 360.0})
        expected = np.interp(c, [200, 340, 370, 460], [values[2], values[3], values[0], values[1]])
        assert run["C.leadscrew_correction"][1:] == pytest.approx(-expected[1:], abs=1e-15)

    def test_the_range_of_the_axis_counts(self) -> None:
        c = np.linspace(-500.0, 500.0, 1001)
        table = Leadscrew((-80.0, -20.0, 70.0), (0.0, 1.0, 2.0), modulo=True)
        axis = Axis(4, "C", AxisType.ROTARY, ModuloRange(-90.0, 90.0), leadscrew=table)
        run = drive(Machine((axis,)), {"C.setpoint": c})
        expected = np.interp(c, table.positions, table.positive, period=180.0)
        assert run["C.leadscrew_correction"] == pytest.approx(-expected, abs=1e-12)

    def test_a_table_over_exactly_one_range_keeps_its_last_value(self) -> None:
        table = Leadscrew((0.0, 180.0, 360.0), (0.0, 1.0, 0.5), modulo=True)
        axis = Axis(4, "C", AxisType.ROTARY, ModuloRange(), leadscrew=table)
        run = drive(Machine((axis,)), {"C.setpoint": [359.0, 359.999, 360.0, 0.0, 540.0]})
        assert run["C.leadscrew_correction"] == pytest.approx(
            [-np.interp(c, table.positions, table.positive) for c in (359.0, 359.999, 0.0, 0.0, 180.0)], abs=1e-12
        )

    def test_counting_the_turns_anew_at_standstill_is_no_reversal(self) -> None:
        # the same place written as 360.1 + n · 360 differs by rounding; one unit in the last place is no motion
        c = [350.1, 360.1, 360.1 - 360.0, 360.1 + 3600.0, 360.1 - 720.0, 0.1]
        run = drive(self.lists(), {"C.setpoint": c})
        assert run["C.leadscrew_correction"][1:] == pytest.approx([run["C.leadscrew_correction"][1]] * 5, abs=1e-9)

    def test_without_modulo_a_table_holds_its_ends_within_the_turn_that_is_centred_on_it(self) -> None:
        # its middle is 175: the turn is −5 … 355, and the ends are held there
        table = Leadscrew(self.POSITIONS, self.TABLE.positive)
        axis = Axis(4, "C", AxisType.ROTARY, ModuloRange(), leadscrew=table)
        c = np.array([340.0, 354.9, 355.1, 365.0, 1000.0, 280.0, -80.0, 720.0 + 340.0])
        run = drive(Machine((axis,)), {"C.setpoint": c})
        expected = np.interp((c + 5.0) % 360.0 - 5.0, self.POSITIONS, self.TABLE.positive)
        assert run["C.leadscrew_correction"] == pytest.approx(-expected, abs=1e-14)
        assert run["C.leadscrew_correction"][:4].tolist() == [-0.013, -0.013, -0.010, -0.010]

    def test_without_modulo_on_an_axis_that_does_not_count_modulo_nothing_is_folded(self) -> None:
        table = Leadscrew(self.POSITIONS, self.TABLE.positive)
        run = drive(
            Machine((Axis(4, "C", AxisType.ROTARY, leadscrew=table),)), {"C.setpoint": [340.0, 365.0, 1000.0, -80.0]}
        )
        assert run["C.leadscrew_correction"].tolist() == [-0.013, -0.013, -0.013, -0.010]

    def test_whole_turns_change_nothing(self, rng: np.random.Generator) -> None:
        c = 350.0 + np.cumsum(rng.uniform(-4.0, 4.0, 500))
        turns = rng.integers(-1000, 1000, 500)
        one, other = (drive(self.lists(), {"C.setpoint": at}) for at in (c, c + 360.0 * turns))
        assert one["C.leadscrew_correction"] == pytest.approx(other["C.leadscrew_correction"], abs=1e-11)


def test_slow_motion_counts_however_small_its_steps() -> None:
    x = 1.0 - 1e-10 * np.arange(40)
    run = drive(machine(Leadscrew((0.0,), (1.0,), (0.0,))), {"X.setpoint": x})
    assert run["X.leadscrew_correction"][0] == -1.0
    assert run["X.leadscrew_correction"][11:].tolist() == [0.0] * 29


def test_only_the_own_reference_counts() -> None:
    run = drive(machine(Leadscrew((0.0,), (1.0,))), {"X.referenced": [True, False]})
    assert run["X.leadscrew_correction"].tolist() == [-1.0, 0.0]
