"""Temperature compensation: Δs = offset + coefficient · (s − position), from the raw setpoint, added."""

import numpy as np
import pytest
from driving import drive, soft, to_and_fro, walk
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from axcomp.kinds import Cross, Leadscrew, Temperature
from axcomp.model import Axis, AxisType, Machine, ModuloRange
from axcomp.runtime import Runtime

POSITION, OFFSET, COEFFICIENT = 120.0, 0.015, 11.5e-6
LIST = Temperature(POSITION, OFFSET, COEFFICIENT)


def machine(temperature: Temperature = LIST, **options: object) -> Machine:
    return Machine((Axis(1, "X", temperature=temperature, **options),))


def growth(
    s: NDArray[np.float64], offset: float = OFFSET, coefficient: float = COEFFICIENT, position: float = POSITION
) -> NDArray[np.float64]:
    return offset + coefficient * (s - position)


class TestFormula:
    def test_it_is_linear_over_the_raw_setpoint_and_has_no_ends(self, rng: np.random.Generator) -> None:
        s = np.concatenate([to_and_fro(400, rng, -500.0, 900.0), [120.0, 0.0, -1e6, 1e6]])
        run = drive(machine(), {"X.setpoint": s})
        assert run["X.temperature_correction"] == pytest.approx(growth(s), abs=1e-14)
        assert run["X.corrected_setpoint"] == pytest.approx(s + growth(s), rel=1e-15)
        assert run["X.temperature_active"].all()

    def test_an_axis_that_has_grown_by_6_um_over_half_a_metre(self) -> None:
        # offset_0 250 · 0.1 µm, coefficient 12 µm/m, position_0 1000000 · 0.1 µm: at 600 mm 0.025 mm + 12e-6 · 500 mm
        run = drive(machine(Temperature(100.0, 0.025, 12e-6)), {"X.setpoint": [100.0, 600.0]})
        assert run["X.temperature_correction"] == pytest.approx([0.025, 0.031], abs=1e-16)

    def test_the_display_does_not_show_it(self) -> None:
        s = np.linspace(-100.0, 100.0, 21)
        run = drive(machine(), {"X.setpoint": s, "X.actual_position": s + growth(s)})
        assert run["X.display_position"] == pytest.approx(s, abs=1e-12)

    def test_an_axis_that_counts_modulo_grows_with_its_raw_setpoint(self) -> None:
        axis = Axis(1, "C", AxisType.ROTARY, ModuloRange(), temperature=Temperature(0.0, 0.0, 1e-3))
        run = drive(Machine((axis,)), {"C.setpoint": [10.0, 370.0]})
        assert run["C.temperature_correction"] == pytest.approx([0.01, 0.37])

    def test_the_leadscrew_takes_its_position_with_it(self) -> None:
        screw = Leadscrew((0.0, 1000.0), (0.0, 1.0))
        lists = machine(Temperature(0.0, 2.0, 0.0), leadscrew=screw)
        run = drive(lists, {"X.setpoint": [100.0, 500.0]})
        assert run["X.leadscrew_correction"] == pytest.approx([-0.102, -0.502])

    def test_the_raw_setpoint_counts_whatever_else_corrects(self) -> None:
        lists = machine(cross=Cross(1, (0.0,), (50.0,)))
        run = drive(lists, {"X.setpoint": [300.0]})
        assert run["X.temperature_correction"] == pytest.approx(growth(np.array([300.0])))


class TestInputs:
    """Offset and coefficient may be measured while the machine runs; changes come in over n_cycles."""

    @pytest.mark.parametrize("cycles", [1, 4, 20])
    @pytest.mark.parametrize("name", ["offset", "coefficient"])
    def test_a_change_comes_in_by_sine_squared(self, name: str, cycles: int) -> None:
        lists = machine(Temperature(POSITION, OFFSET, COEFFICIENT, cycles))
        more = {"offset": -0.035, "coefficient": 18.5e-6}[name]
        new = {"offset": -0.02, "coefficient": 30e-6}[name]
        k = np.arange(30)
        run = drive(lists, {"X.setpoint": 620.0, f"X.temperature_{name}": np.where(k < 5, 0.0, more)})
        old_value = growth(np.array(620.0))
        new_value = growth(np.array(620.0), **{name: new})
        w = soft(np.clip(k - 4, 0, cycles), cycles)
        assert run["X.temperature_correction"] == pytest.approx(old_value + w * (new_value - old_value), abs=1e-15)

    def test_a_change_in_motion_blends_the_difference_where_the_axis_is(self) -> None:
        # at the change the axis is at 5 · 10 mm; the difference there runs out, and the slope is the new one at once
        lists = machine(Temperature(0.0, 0.0, 1e-3, 8))
        k = np.arange(20)
        s = 10.0 * k
        run = drive(lists, {"X.setpoint": s, "X.temperature_coefficient": np.where(k < 5, 0.0, 2e-3)})
        rest = soft(np.clip(12 - k, 0, 8), 8) * (1e-3 - 3e-3) * s[5]
        expected = np.where(k < 5, 1e-3 * s, 3e-3 * s + rest)
        assert run["X.temperature_correction"] == pytest.approx(expected, abs=1e-14)

    def test_a_second_change_begins_where_the_first_one_is(self) -> None:
        k = np.arange(30)
        offsets = np.select([k < 5, k < 8], [0.0, 1.0], 0.25)
        run = drive(machine(Temperature(0.0, 0.0, 0.0, 6)), {"X.temperature_offset": offsets})
        first = soft(np.clip(k - 4, 0, 6), 6)
        second = 0.25 + (first[7] - 0.25) * soft(np.clip(13 - k, 0, 6), 6)
        assert run["X.temperature_correction"] == pytest.approx(np.where(k < 8, first, second), abs=1e-15)

    @settings(max_examples=30)
    @given(st.lists(st.floats(-0.1, 0.1), min_size=2, max_size=40), st.integers(1, 20))
    def test_no_step_is_larger_than_a_change_at_once_would_make(self, offsets: list[float], cycles: int) -> None:
        run = drive(machine(Temperature(0.0, 0.0, 0.0, cycles)), {"X.temperature_offset": [0.0, *offsets]})
        steps = np.abs(np.diff(run["X.temperature_correction"]))
        assert steps.max() <= np.ptp([0.0, *offsets]) * np.max(np.diff(soft(np.arange(cycles + 1), cycles))) + 1e-12

    @pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
    @pytest.mark.parametrize("name", ["offset", "coefficient"])
    def test_what_is_not_finite_is_not_taken(self, name: str, bad: float) -> None:
        run = drive(machine(), {"X.setpoint": 200.0, f"X.temperature_{name}": [0.0, bad, bad, 0.0]})
        assert run["X.temperature_correction"] == pytest.approx([float(growth(np.array(200.0)))] * 4, abs=1e-17)
        assert not run["X.error"].any()

    def test_what_is_set_before_the_first_cycle_is_there_at_once(self) -> None:
        run = drive(machine(Temperature(0.0, 0.0, 0.0, 20)), {"X.temperature_offset": [0.5, 0.5]})
        assert run["X.temperature_correction"].tolist() == [0.5, 0.5]

    def test_a_change_while_it_is_off_is_there_when_it_comes_back(self) -> None:
        k = np.arange(12)
        run = drive(
            machine(Temperature(0.0, 1.0, 0.0, 2)),
            {"X.temperature_on": (k < 2) | (k > 7), "X.temperature_offset": np.where(k < 5, 0.0, 2.0)},
        )
        w = soft(walk((k < 2) | (k > 7), 2, 2), 2)
        assert run["X.temperature_correction"] == pytest.approx(w * np.where(k < 5, 1.0, 3.0), abs=1e-15)


class TestSwitching:
    def test_it_needs_its_axis_referenced(self) -> None:
        referenced = np.array([1, 1, 0, 0, 0, 1, 1, 1, 1], bool)
        run = drive(machine(Temperature(0.0, 1.0, 0.0, 3)), {"X.referenced": referenced})
        assert run["X.temperature_correction"] == pytest.approx(soft(walk(referenced, 3, 3), 3), abs=1e-15)

    def test_it_switches_in_motion(self) -> None:
        enable = np.arange(10) < 3
        run = drive(machine(Temperature(0.0, 1.0, 0.0, 5)), {"X.temperature_on": enable, "X.setpoint": np.arange(10.0)})
        assert run["X.temperature_correction"] == pytest.approx(soft(walk(enable, 5, 5), 5), abs=1e-15)

    def test_no_move_takes_it_into_the_shift_until_the_axis_moves(self) -> None:
        # on at −1 mm of growth; off without motion; released with the next motion over its n_cycles
        k = np.arange(14)
        s = np.where(k < 6, 40.0, 41.0)
        columns = {"X.setpoint": s, "X.temperature_on": k < 3, "X.no_move": True}
        run = drive(machine(Temperature(40.0, -1.0, 0.0, 4)), columns)
        shift = -soft(np.select([k < 3, k < 6], [0, 4], np.clip(9 - k, 0, 4)), 4)
        assert run["X.temperature_correction"].tolist() == [-1.0] * 3 + [0.0] * 11
        assert run["X.setpoint_shift"] == pytest.approx(shift, abs=1e-15)
        assert run["X.corrected_setpoint"][:6].tolist() == [39.0] * 6

    def test_no_move_does_not_reverse_the_leadscrew(self) -> None:
        lists = machine(Temperature(0.0, 0.05, 0.0, 4), leadscrew=Leadscrew((0.0,), (0.0,), (-1.0,)))
        run = drive(lists, {"X.temperature_on": np.arange(8) < 2, "X.no_move": True})
        assert run["X.leadscrew_correction"].tolist() == [0.0] * 8


class TestUpdate:
    def run(self, runtime: Runtime, cycles: int) -> list[float]:
        return drive(runtime, {"X.setpoint": np.full(cycles, 320.0)})["X.temperature_correction"].tolist()

    def test_inputs_that_nobody_has_set_follow_the_new_lists(self) -> None:
        runtime = Runtime(machine(Temperature(POSITION, OFFSET, COEFFICIENT, 4)))
        old = self.run(runtime, 2)[-1]
        runtime.update(machine(Temperature(20.0, 0.1, 5e-6, 4)))
        new = 0.1 + 5e-6 * 300.0
        expected = new + (old - new) * soft([3, 2, 1, 0, 0], 4)
        assert self.run(runtime, 5) == pytest.approx(expected, abs=1e-15)

    def test_what_is_given_is_added_to_the_new_lists(self) -> None:
        runtime = Runtime(machine(Temperature(POSITION, OFFSET, COEFFICIENT, 1)))
        runtime.inputs.axis[0].compensation.temperature.offset = 0.5
        self.run(runtime, 2)
        runtime.update(machine(Temperature(POSITION, 0.1, 5e-6, 1)))
        assert self.run(runtime, 2) == pytest.approx([0.6 + 5e-6 * 200.0] * 2, abs=1e-15)

    def test_a_dropped_one_runs_out_over_its_cycles(self) -> None:
        runtime = Runtime(machine(Temperature(0.0, 1.0, 0.0, 5)))
        self.run(runtime, 2)
        runtime.update(Machine((Axis(1, "X"),)))
        assert self.run(runtime, 7) == pytest.approx(soft([4, 3, 2, 1, 0, 0, 0], 5), abs=1e-15)

    def test_it_comes_and_goes_with_save_and_restore(self) -> None:
        lists = machine(Temperature(0.0, 1.0, 0.0, 9))
        runtime = Runtime(lists)
        self.run(runtime, 2)
        runtime.inputs.axis[0].compensation.temperature.offset = 2.0
        self.run(runtime, 3)
        data = runtime.save()
        first = self.run(runtime, 9)
        runtime.restore(data)
        assert self.run(runtime, 9) == first
        other = Runtime(lists)
        other.restore(data)
        assert self.run(other, 9) == first
        assert np.unique(first).size > 3
