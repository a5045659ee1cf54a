"""Backlash compensation: after a motion in one direction the drive goes further; by sin² over the reversal, added."""

import numpy as np
import pytest
from driving import drive, forward, soft, to_and_fro, walk
from numpy.typing import NDArray

from axcomp.kinds import Backlash, Cross, Leadscrew
from axcomp.model import Axis, AxisType, Machine, ModuloRange
from axcomp.runtime import Runtime

LOSE = 0.03


def machine(mode: int, cycles: int = 0, amount: float = LOSE, **options: object) -> Machine:
    return Machine((Axis(1, "X", backlash_cycles=cycles, backlash=Backlash(amount, mode), **options),))


def expected(s: NDArray[np.float64], mode: int, cycles: int, amount: float = LOSE) -> NDArray[np.float64]:
    """Over a whole run of setpoints: nothing before any motion, then as the last motion says."""
    direction = forward(np.sign(np.diff(s, prepend=s[0])), 0)
    added, value = (direction < 0, -amount) if mode == 1 else (direction > 0, amount)
    n = max(cycles, 1)
    return value * soft(walk(added, n, 0), n)


@pytest.mark.parametrize("amount", [LOSE, -0.01])
@pytest.mark.parametrize(
    ("mode", "before", "positive", "negative"), [(1, 0.0, 0.0, -1.0), (2, 0.0, 1.0, 0.0)], ids=["mode 1", "mode 2"]
)
def test_what_is_added_after_a_motion(
    mode: int, before: float, positive: float, negative: float, amount: float
) -> None:
    s = [5.0, 5.0, 6.0, 6.0, 5.5, 5.5, 5.0, 7.0]
    factors = np.array([before, before, positive, positive, negative, negative, negative, positive])
    run = drive(machine(mode, amount=amount), {"X.setpoint": s})
    assert run["X.backlash_correction"] == pytest.approx(factors * amount, abs=1e-17)
    assert run["X.corrected_setpoint"] == pytest.approx(s + factors * amount, abs=1e-12)


@pytest.mark.parametrize("mode", [1, 2])
@pytest.mark.parametrize("cycles", [0, 1, 2, 5, 20])
def test_over_reversals_standstill_and_turning_again_midway(mode: int, cycles: int, rng: np.random.Generator) -> None:
    s = to_and_fro(1500, rng, -70.0, 110.0, stand=0.4)
    run = drive(machine(mode, cycles), {"X.setpoint": s})
    assert run["X.backlash_correction"] == pytest.approx(expected(s, mode, cycles), abs=1e-15)
    assert run["X.corrected_setpoint"] == pytest.approx(s + expected(s, mode, cycles), abs=1e-12)
    assert np.ptp(run["X.backlash_correction"]) == pytest.approx(LOSE)


def test_either_mode_moves_the_drive_by_the_backlash_from_one_direction_to_the_other(rng: np.random.Generator) -> None:
    s = to_and_fro(600, rng, -9.0, 9.0)
    one, other = (drive(machine(mode, 7), {"X.setpoint": s})["X.backlash_correction"] for mode in (1, 2))
    first = np.flatnonzero(np.diff(s))[0] + 10
    assert (other - one)[first:] == pytest.approx(LOSE, abs=1e-15)


def test_a_reversal_takes_exactly_n_backlash_cyc_cycles_and_goes_on_while_the_axis_stands() -> None:
    run = drive(machine(1, 4), {"X.setpoint": [5.0, 6.0, 5.0, 5.0, 5.0, 5.0, 5.0]})
    w = np.sin(np.pi / 8 * np.array([0, 0, 1, 2, 3, 4, 4])) ** 2
    assert run["X.backlash_correction"] == pytest.approx(-LOSE * w, abs=1e-17)


@pytest.mark.parametrize("mode", [1, 2])
def test_before_any_motion_nothing_is_added(mode: int) -> None:
    run = drive(machine(mode), {"X.setpoint": [30.0] * 4})
    assert run["X.backlash_correction"].tolist() == [0.0] * 4
    assert run["X.backlash_active"].all()  # switched on, although its value is 0


def test_the_velocity_tells_the_direction_too() -> None:
    v = [0.0, -5.0, 0.0, 1e-15, 3.0, -1e-7]
    run = drive(machine(1), {"X.velocity": v})
    assert run["X.backlash_correction"].tolist() == [0.0, -LOSE, -LOSE, -LOSE, 0.0, 0.0]


def test_rounding_is_no_reversal_but_slow_motion_is_one() -> None:
    jitter = 7.0 + 1e-15 * np.array([0, 1, 0, -1, 0, 1])
    assert not drive(machine(1), {"X.setpoint": jitter})["X.backlash_correction"].any()
    # 0.3e-9 a cycle has become a motion in the fourth
    slow = 7.0 - 0.3e-9 * np.arange(8)
    run = drive(machine(1), {"X.setpoint": slow})
    assert run["X.backlash_correction"].tolist() == [0.0] * 4 + [-LOSE] * 4


def test_what_other_compensations_do_is_no_motion() -> None:
    lists = Machine((Axis(1, "M"), Axis(2, "X", backlash=Backlash(LOSE), cross=Cross(1, (0.0, 10.0), (0.0, 1.0)))))
    run = drive(lists, {"M.setpoint": np.linspace(10.0, 0.0, 11)})
    assert np.ptp(run["X.cross_correction"]) == 1.0
    assert not run["X.backlash_correction"].any()


def test_it_comes_behind_the_leadscrew_which_does_not_see_it(rng: np.random.Generator) -> None:
    screw = Leadscrew((-80.0, 0.0, 120.0), (0.01, 0.0, -0.02), (0.03, 0.01, -0.01))
    s = to_and_fro(500, rng, -70.0, 110.0)
    alone = drive(Machine((Axis(1, "X", backlash_cycles=5, leadscrew=screw),)), {"X.setpoint": s})
    run = drive(machine(2, 5, amount=5.0, leadscrew=screw), {"X.setpoint": s})
    assert (run["X.leadscrew_correction"] == alone["X.leadscrew_correction"]).all()
    assert run["X.correction"] == pytest.approx(run["X.leadscrew_correction"] + expected(s, 2, 5, 5.0), abs=1e-14)


def test_counting_the_turns_anew_is_no_motion() -> None:
    axis = Axis(1, "C", AxisType.ROTARY, ModuloRange(), backlash=Backlash(LOSE))
    run = drive(Machine((axis,)), {"C.setpoint": [350.0, 355.0, 0.0, 5.0, 725.0, 365.0, 4.0, 359.0]})
    assert run["C.backlash_correction"].tolist() == [0.0] * 6 + [-LOSE] * 2


def test_it_acts_whether_referenced_or_not() -> None:
    run = drive(machine(1), {"X.setpoint": [0.0, -1.0, -2.0], "X.referenced": [True, False, False]})
    assert run["X.backlash_correction"].tolist() == [0.0, -LOSE, -LOSE]


def test_its_switch_acts_at_once_even_in_motion() -> None:
    k = np.arange(12)
    run = drive(machine(1, 5), {"X.setpoint": -1.0 * k, "X.backlash_on": (k < 7) | (k > 8)})
    w = soft(np.clip(np.arange(12), 0, 5), 5)
    w[7:9] = 0.0
    assert run["X.backlash_correction"] == pytest.approx(-LOSE * w, abs=1e-17)
    assert run["X.backlash_active"].tolist() == [True] * 7 + [False] * 2 + [True] * 3


def test_no_move_takes_it_into_the_shift_until_the_axis_moves() -> None:
    s = np.array([0.0, -1.0, -1.0, -1.0, -1.0, -1.0, -2.0, -2.0, -2.0, -2.0, -2.0])
    run = drive(machine(1, 3), {"X.setpoint": s, "X.backlash_on": np.arange(11) < 4, "X.no_move": np.arange(11) > 2})
    # full weight from cycle 3; off in cycle 4; released from cycle 6 on over 3 cycles
    assert run["X.corrected_setpoint"][3:6].tolist() == [-1.0 - LOSE] * 3
    shift = -LOSE * np.array([0, 0, 0, 0, 1, 1, *np.sin(np.pi / 6 * np.array([2, 1, 0, 0, 0])) ** 2])
    assert run["X.setpoint_shift"] == pytest.approx(shift, abs=1e-15)


class TestUpdate:
    def runtime(self, mode: int = 1, cycles: int = 4) -> Runtime:
        """After a motion in negative direction."""
        runtime = Runtime(machine(mode, cycles))
        drive(runtime, {"X.setpoint": [0.0, -1.0, *[-2.0] * 8]})
        return runtime

    def run(self, runtime: Runtime, cycles: int) -> NDArray[np.float64]:
        return drive(runtime, {"X.setpoint": np.full(cycles, -2.0)})["X.backlash_correction"]

    def test_another_amount_comes_in_over_the_backlash_cycles(self) -> None:
        runtime = self.runtime()
        runtime.update(machine(1, 4, 0.05))
        assert self.run(runtime, 6) == pytest.approx(-0.05 + 0.02 * soft([3, 2, 1, 0, 0, 0], 4), abs=1e-15)

    def test_another_mode_comes_in_as_softly(self) -> None:
        # mode 2 adds nothing after negative motion; its reversal runs back, from the full amount in the other direction
        runtime = self.runtime()
        runtime.update(machine(2, 4))
        reversal = LOSE * soft([3, 2, 1, 0, 0, 0], 4)
        blend = (-LOSE - LOSE) * soft([3, 2, 1, 0, 0, 0], 4)
        assert self.run(runtime, 6) == pytest.approx(reversal + blend, abs=1e-15)

    def test_a_reversal_that_is_under_way_stays_as_far_as_it_is(self) -> None:
        runtime = Runtime(machine(1, 4))
        drive(runtime, {"X.setpoint": [0.0, -1.0, -2.0]})  # 2 of 4 steps
        runtime.update(machine(1, 10))
        assert self.run(runtime, 7) == pytest.approx(-LOSE * soft([6, 7, 8, 9, 10, 10, 10], 10), abs=1e-15)

    def test_a_dropped_one_runs_out_over_the_backlash_cycles(self) -> None:
        runtime = self.runtime()
        runtime.update(Machine((Axis(1, "X", backlash_cycles=20),)))
        found = drive(runtime, {"X.setpoint": np.full(6, -2.0)})
        assert found["X.backlash_correction"] == pytest.approx(-LOSE * soft([3, 2, 1, 0, 0, 0], 4), abs=1e-15)
        assert not found["X.backlash_active"].any()

    def test_save_and_restore_amid_a_reversal(self) -> None:
        runtime = Runtime(machine(1, 9))
        drive(runtime, {"X.setpoint": [0.0, -1.0, -2.0]})
        data = runtime.save()
        first = self.run(runtime, 12)
        runtime.restore(data)
        assert (self.run(runtime, 12) == first).all()
        assert np.unique(first).size > 5
