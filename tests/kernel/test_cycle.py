"""One cycle of all axes: order, sums, display, and axes whose inputs cannot be used."""

import numpy as np
import pytest
from driving import OUTPUTS, drive, to_and_fro

from axcomp.kernel import ERROR_INPUT
from axcomp.kinds import Cross, CrosstalkCurve, Friction, Leadscrew, Plane
from axcomp.model import Axis, Machine
from axcomp.runtime import Runtime

LINE = tuple(float(x) for x in range(-100, 101, 50))
BAD = [float("nan"), float("inf"), float("-inf"), 1e15, -1e15, 1e308]


def machine() -> Machine:
    """X corrects Y and Z; all kinds act on Z."""
    z = Axis(
        3,
        "Z",
        backlash_cycles=4,
        cross=Cross(1, LINE, (0.3, -0.1, 0.2, 0.0, 0.1)),
        plane=Plane(1, 2, -100.0, -100.0, 100.0, 100.0, ((0.0, 0.1, 0.2), (0.4, -0.3, 0.1), (0.2, 0.3, -0.5))),
        crosstalk=CrosstalkCurve(1, (-1000.0, 1000.0), (-0.05, 0.05)),
        leadscrew=Leadscrew(LINE, (0.02, 0.0, -0.04, 0.01, 0.03), (0.0, 0.03, -0.02, 0.02, 0.01)),
        friction=Friction((1.0, 100.0), (1.0, 3.0), position_delay=0.01, reversal_lookahead=2, delay_cycles=5),
    )
    y = Axis(2, "Y", cross=Cross(1, (0.0, 100.0), (0.0, 1.0)))
    return Machine((Axis(1, "X"), y, z))


def trajectory(cycles: int, rng: np.random.Generator) -> dict[str, np.ndarray]:
    columns = {}
    for name in "XYZ":
        s = to_and_fro(cycles, rng, -120.0, 120.0)
        v = np.diff(s, prepend=s[0]) / 1e-3
        a = np.diff(v, prepend=v[0]) / 1e-3
        columns |= {f"{name}.setpoint": s, f"{name}.velocity": v, f"{name}.acceleration": a}
        columns[f"{name}.actual_position"] = s + rng.normal(0, 1e-3, cycles)
    return columns


def test_the_correction_is_the_sum_and_the_setpoint_gets_it(rng: np.random.Generator) -> None:
    columns = trajectory(500, rng)
    run = drive(machine(), columns)
    for name in "XYZ":
        parts = sum(run[f"{name}.{kind}_correction"] for kind in ("cross", "plane", "crosstalk", "leadscrew"))
        assert run[f"{name}.correction"] == pytest.approx(parts, abs=1e-15)
        assert run[f"{name}.corrected_setpoint"] == pytest.approx(columns[f"{name}.setpoint"] + parts, abs=1e-12)
    assert np.ptp(run["Z.correction"]) > 0.5


def test_no_correction_shows_in_the_display(rng: np.random.Generator) -> None:
    # an axis that follows exactly stands where it was corrected to: the display shows where it was programmed
    columns = trajectory(300, rng)
    corrected = {f"{name}.actual_position": drive(machine(), columns)[f"{name}.corrected_setpoint"] for name in "XYZ"}
    run = drive(machine(), {**columns, **corrected})
    for name in "XYZ":
        assert run[f"{name}.display_position"] == pytest.approx(columns[f"{name}.setpoint"], abs=1e-12)


def test_a_shift_does_not_show_in_the_display_either() -> None:
    run = drive(machine(), {"Z.no_move": True, "Z.cross_on": [True, True, False, False]})
    assert run["Z.setpoint_shift"][2:].tolist() == [0.2, 0.2]
    assert run["Z.display_position"] == pytest.approx([-run["Z.corrected_setpoint"][0]] * 4)


def test_masters_count_in_the_same_cycle_whatever_the_order_of_the_axes(rng: np.random.Generator) -> None:
    columns = trajectory(300, rng)
    one, other = drive(machine(), columns), drive(Machine(machine().axes[::-1]), columns)
    assert all((one[name] == other[name]).all() for name in one)


class TestBadInput:
    @pytest.mark.parametrize("bad", BAD)
    @pytest.mark.parametrize("field", ["setpoint", "velocity", "acceleration", "actual_position"])
    @pytest.mark.parametrize("axis", ["X", "Z"])
    def test_the_axis_holds_its_outputs_and_names_the_error(self, axis, field, bad, rng: np.random.Generator) -> None:
        columns = trajectory(40, rng)
        columns[f"{axis}.{field}"][[20, 21, 30]] = bad
        run = drive(machine(), columns)
        for name in OUTPUTS:
            values = run[f"{axis}.{name}"]
            assert np.isfinite(values).all()
            if name != "error":
                assert (values[20:22] == values[19]).all()
                assert values[30] == values[29]
        error = np.isin(np.arange(40), [20, 21, 30]) * ERROR_INPUT
        assert (run[f"{axis}.error"] == error).all()

    @pytest.mark.parametrize("field", ["setpoint", "velocity", "acceleration", "actual_position"])
    def test_an_axis_that_is_nobodys_master_disturbs_nobody(self, field: str, rng: np.random.Generator) -> None:
        columns = trajectory(60, rng)
        good = drive(machine(), columns)
        columns[f"Z.{field}"][10:50:3] = np.nan
        run = drive(machine(), columns)
        for name in OUTPUTS:
            assert (run[f"X.{name}"] == good[f"X.{name}"]).all()
            assert (run[f"Y.{name}"] == good[f"Y.{name}"]).all()

    def test_a_master_counts_with_its_last_good_values(self, rng: np.random.Generator) -> None:
        columns = trajectory(60, rng)
        broken, held = dict(columns), dict(columns)
        bad = np.isin(np.arange(60), [20, 21, 22, 40])
        last = np.maximum.accumulate(np.where(bad, 0, np.arange(60)))
        broken["X.velocity"] = np.where(bad, np.nan, columns["X.velocity"])
        for field in ("setpoint", "velocity", "acceleration"):
            held[f"X.{field}"] = columns[f"X.{field}"][last]
        one, other = drive(machine(), broken), drive(machine(), held)
        for name in OUTPUTS:
            assert (one[f"Y.{name}"] == other[f"Y.{name}"]).all()
            assert (one[f"Z.{name}"] == other[f"Z.{name}"]).all()

    def test_afterwards_it_goes_on_as_if_the_cycles_had_not_been(self, rng: np.random.Generator) -> None:
        columns = trajectory(80, rng)
        bad = np.isin(np.arange(80), [3, 20, 21, 22, 50])
        dropped = {name: column[~bad] for name, column in columns.items()}
        broken = {**columns, "Z.setpoint": np.where(bad, np.inf, columns["Z.setpoint"])}
        one, other = drive(machine(), broken), drive(machine(), dropped)
        for name in OUTPUTS:
            assert (one[f"Z.{name}"][~bad] == other[f"Z.{name}"]).all()

    def test_bad_from_the_start_it_begins_when_it_is_good(self) -> None:
        z = np.array([np.nan, np.nan, 50.0, 49.0])
        run = drive(machine(), {"Z.setpoint": z, "Z.velocity": [0.0, 0.0, 5.0, -5.0]})
        fresh = drive(machine(), {"Z.setpoint": z[2:], "Z.velocity": [5.0, -5.0]})
        for name in OUTPUTS:
            assert (run[f"Z.{name}"][2:] == fresh[f"Z.{name}"]).all()
        assert run["Z.corrected_setpoint"][:2].tolist() == [0.0, 0.0]
        assert run["Z.error"].tolist() == [ERROR_INPUT, ERROR_INPUT, 0, 0]

    def test_every_axis_bad_is_no_crash(self) -> None:
        run = drive(machine(), {f"{name}.setpoint": [1.0, np.nan, np.inf] for name in "XYZ"})
        for name in "XYZ":
            assert run[f"{name}.error"].tolist() == [0, ERROR_INPUT, ERROR_INPUT]
            assert (run[f"{name}.corrected_setpoint"] == run[f"{name}.corrected_setpoint"][0]).all()

    def test_the_largest_good_inputs_give_finite_outputs(self) -> None:
        huge = np.array([9.9e14, -9.9e14, 1e-300, -1e-300, 0.0, -0.0, 9.9e14])
        columns = {f"{n}.{f}": huge for n in "XYZ" for f in ("setpoint", "velocity", "acceleration", "actual_position")}
        run = drive(machine(), columns)
        assert all(np.isfinite(values).all() for values in run.values())
        assert not run["Z.error"].any()


def test_minus_zero_is_zero(rng: np.random.Generator) -> None:
    columns = trajectory(200, rng)
    columns = {name: np.where(np.abs(column) < 60.0, 0.0, column) for name, column in columns.items()}
    negated = {name: np.where(column == 0.0, -0.0, column) for name, column in columns.items()}
    one, other = drive(machine(), columns), drive(machine(), negated)
    assert all((one[name] == other[name]).all() for name in one)


def test_an_error_stays_until_reset() -> None:
    runtime = Runtime(machine())
    runtime.state.axis[2].error = 110639
    run = drive(runtime, {"reset": [False, False, True, False]})
    assert run["Z.error"].tolist() == [110639, 110639, 0, 0]
