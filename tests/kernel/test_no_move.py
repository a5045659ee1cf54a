"""NO_MOVE: a switched offset stays in the setpoint as a shift until the axis moves, then goes by sin²."""

import numpy as np
import pytest
from driving import drive, soft
from hypothesis import given, settings, strategies as st

from axcomp.kinds import Cross, CrosstalkCurve, Leadscrew, Plane
from axcomp.model import Axis, Machine

N = 8


def machine(**options: object) -> Machine:
    slave = Axis(
        2,
        "S",
        cross=Cross(1, (0.0,), (0.5,), N),
        plane=Plane(1, 1, 0.0, 0.0, 1.0, 1.0, ((0.25,),), 3),
        crosstalk=CrosstalkCurve(1, (0.0,), (-2.0,), 0),
        leadscrew=Leadscrew((0.0,), (-4.0,), (-1.0,)),
        **options,
    )
    return Machine((Axis(1, "M"), slave))


ALL = {"cross": 0.5, "plane": 0.25, "crosstalk": -2.0, "leadscrew": 4.0}


def flags(text: str) -> np.ndarray:
    return np.array([letter != "." for letter in text])


@pytest.mark.parametrize(("kind", "value"), ALL.items())
def test_the_output_stays_and_the_shift_takes_the_value(kind: str, value: float) -> None:
    run = drive(machine(), {"S.setpoint": 7.0, "S.no_move": True, f"S.{kind}_on": flags("11..1.")})
    assert run["S.corrected_setpoint"] == pytest.approx([9.75] * 6, abs=1e-12)
    assert run["S.setpoint_shift"] == pytest.approx(value * np.array([0, 0, 1, 1, 0, 1]), abs=1e-12)
    assert run[f"S.{kind}_correction"].tolist() == [value, value, 0.0, 0.0, value, 0.0]
    assert run[f"S.{kind}_active"].tolist() == [True, True, False, False, True, False]


@pytest.mark.parametrize(("kind", "value"), ALL.items())
def test_the_next_motion_releases_it_by_sine_squared(kind: str, value: float) -> None:
    raw = np.array([7.0] * 5 + [7.5 + 0.1 * k for k in range(12)])
    enable = flags("11" + "." * 15)
    run = drive(machine(), {"S.setpoint": raw, "S.no_move": True, f"S.{kind}_on": enable})
    w = np.concatenate([[0, 0, 1, 1, 1], soft(np.clip(np.arange(N - 1, -5, -1), 0, N), N)])
    assert run["S.setpoint_shift"] == pytest.approx(value * w, abs=1e-12)
    assert run["S.corrected_setpoint"] == pytest.approx(raw + run["S.correction"] + value * w, abs=1e-12)
    assert (run["S.setpoint_shift"][-4:] == 0.0).all()


def test_a_release_goes_on_when_the_axis_stops_again() -> None:
    raw = np.array([7.0] * 4 + [8.0] * 12)
    run = drive(machine(), {"S.setpoint": raw, "S.no_move": True, "S.cross_on": flags("11" + "." * 14)})
    w = np.concatenate([[0, 0, 1, 1], soft(np.clip(np.arange(N - 1, -5, -1), 0, N), N)])
    assert run["S.setpoint_shift"] == pytest.approx(0.5 * w, abs=1e-12)


def test_a_velocity_is_a_motion_too() -> None:
    run = drive(machine(), {"S.no_move": True, "S.cross_on": flags("1..."), "S.velocity": [0, 0, 1e-3, 0]})
    assert run["S.setpoint_shift"] == pytest.approx(0.5 * np.array([0, 1, *soft([N - 1, N - 2], N)]))


def test_the_motion_of_the_master_releases_nothing() -> None:
    run = drive(machine(), {"S.no_move": True, "S.cross_on": flags("1..."), "M.setpoint": np.arange(4.0)})
    assert run["S.setpoint_shift"].tolist() == [0.0, 0.5, 0.5, 0.5]


def test_the_release_takes_the_longest_of_the_axis_times() -> None:
    run = drive(
        machine(backlash_cycles=20),
        {"S.no_move": True, "S.cross_on": flags("1." + "." * 24), "S.setpoint": np.arange(26.0)},
    )
    # S moves from the start: the command waits, and nothing happens
    assert (run["S.setpoint_shift"] == 0.0).all()
    run = drive(
        machine(backlash_cycles=20),
        {"S.no_move": True, "S.cross_on": flags("1." + "." * 24), "S.setpoint": np.maximum(np.arange(26.0), 2.0)},
    )
    assert run["S.setpoint_shift"][3:] == pytest.approx(
        0.5 * soft(np.clip(np.arange(19, -4, -1), 0, 20), 20), abs=1e-15
    )


def test_what_is_absorbed_during_a_release_waits_for_the_next_motion() -> None:
    raw = np.array([0.0, 0.0, 1.0] + [1.0] * 12 + [2.0] * 12)
    off = {"S.cross_on": flags("1" + "." * 26), "S.plane_on": flags("111111" + "." * 21)}
    run = drive(machine(), {"S.setpoint": raw, "S.no_move": True, **off})
    first = 0.5 * np.concatenate([[0, 1], soft(np.clip(np.arange(N - 1, -18, -1), 0, N), N)])
    second = 0.25 * np.concatenate([np.zeros(6), np.ones(9), soft(np.clip(np.arange(N - 1, -5, -1), 0, N), N)])
    assert run["S.setpoint_shift"] == pytest.approx(first + second, abs=1e-12)
    others = run["S.corrected_setpoint"] - raw - run["S.leadscrew_correction"]  # whose direction follows the release
    assert (np.abs(np.diff(others)) < 0.1).all()


def test_motion_amid_a_release_does_not_cut_it_short_for_what_waits() -> None:
    raw = np.array([0.0, 0.0, 1.0, 1.0, 1.0, *np.arange(2.0, 24.0)])
    off = {"S.cross_on": flags("1" + "." * 26), "S.plane_on": flags("111" + "." * 24)}
    run = drive(machine(), {"S.setpoint": raw, "S.no_move": True, **off})
    first = 0.5 * np.concatenate([[0, 1], soft(np.clip(np.arange(N - 1, -18, -1), 0, N), N)])
    second = 0.25 * np.concatenate([np.zeros(3), np.ones(7), soft(np.clip(np.arange(N - 1, -10, -1), 0, N), N)])
    assert run["S.setpoint_shift"] == pytest.approx(first + second, abs=1e-12)


def test_in_motion_the_leadscrew_switches_as_softly_as_a_shift_is_released() -> None:
    raw = np.arange(20.0)
    run = drive(machine(), {"S.setpoint": raw, "S.no_move": True, "S.leadscrew_on": flags("111" + "." * 17)})
    w = np.concatenate([[1, 1, 1, 1], soft(np.clip(np.arange(N - 1, -9, -1), 0, N), N)])
    assert run["S.corrected_setpoint"] - raw == pytest.approx(-1.25 + 4.0 * w, abs=1e-12)


def test_amid_a_ramp_only_the_rest_is_absorbed() -> None:
    no_move = flags("....11111")
    run = drive(machine(), {"S.no_move": no_move, "S.cross_on": flags("1111.1111"[:3] + "." + "1....."[:5])})
    before = 0.5 * soft([8, 8, 8, 7], N)
    assert run["S.cross_correction"] == pytest.approx([*before, 0.5, 0, 0, 0, 0])
    assert run["S.corrected_setpoint"][4:] == pytest.approx([run["S.corrected_setpoint"][3]] * 5)


def test_no_move_belongs_to_the_command_even_when_that_waits_for_standstill() -> None:
    columns = {
        "S.cross_on": flags("1........."),
        "S.no_move": flags(".1........"),
        "S.velocity": 1.0 * flags("11111....."),
    }
    run = drive(machine(), columns)
    assert run["S.corrected_setpoint"] == pytest.approx([2.75] * 10)
    assert run["S.setpoint_shift"].tolist() == [0.0] * 5 + [0.5] * 5


def test_and_not_to_what_is_commanded_later() -> None:
    columns = {
        "S.cross_on": flags("1........."),
        "S.no_move": flags("..1......."),
        "S.velocity": 1.0 * flags("11111....."),
    }
    assert (drive(machine(), columns)["S.setpoint_shift"] == 0.0).all()


@pytest.mark.parametrize("event", ["reset", "program_end", "S.released"])
def test_reset_program_end_and_release_keep_the_position_too(event: str) -> None:
    lists = Machine((Axis(1, "M"), Axis(2, "S", cross=Cross(1, (0.0,), (0.5,), N, manual_activation=True))))
    run = drive(lists, {"S.cross_on": True, "S.no_move": True, event: flags("..1..")})
    assert run["S.corrected_setpoint"].tolist() == [0.5] * 5
    assert run["S.setpoint_shift"].tolist() == [0.0, 0.0, 0.5, 0.5, 0.5]


def test_it_is_over_with_the_command() -> None:
    # the command came with NO_MOVE and has acted; the reference is lost and gained later, softly, and moves the axis
    columns = {
        "S.cross_on": flags(".1........."),
        "S.no_move": flags(".1........."),
        "M.referenced": flags("111...11111"),
    }
    columns["S.cross_on"][1:] = True
    run = drive(Machine((Axis(1, "M"), Axis(2, "S", cross=Cross(1, (0.0,), (0.5,), N)))), columns)
    assert run["S.cross_correction"] == pytest.approx([0.0, *(0.5 * soft([8, 8, 7, 6, 5, 6, 7, 8, 8, 8], N))])
    assert run["S.setpoint_shift"].tolist() == [0.0] + [-0.5] * 10


def test_the_loss_of_a_reference_is_no_command() -> None:
    run = drive(machine(), {"M.referenced": flags("1.."), "S.no_move": True})
    assert run["S.setpoint_shift"].tolist() == [0.0, 0.0, 0.0]
    assert run["S.cross_correction"] == pytest.approx(0.5 * soft([8, 7, 6], N), abs=1e-15)


def test_a_command_while_the_reference_is_lost_finds_nothing_to_absorb() -> None:
    # off with NO_MOVE while the weight runs down: there is no switch that could move the axis less
    columns = {"M.referenced": flags("1........."), "S.cross_on": flags("11........"), "S.no_move": True}
    run = drive(Machine((Axis(1, "M"), Axis(2, "S", cross=Cross(1, (0.0,), (0.5,), N)))), columns)
    assert run["S.cross_correction"] == pytest.approx(0.5 * soft([8, 7, 6, 5, 4, 3, 2, 1, 0, 0], N), abs=1e-15)
    assert run["S.setpoint_shift"].tolist() == [0.0] * 10


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[st.floats(-0.05, 0.05)] * 3), st.permutations(["cross", "plane", "crosstalk"]), st.floats(-300, 300))
def test_it_never_reverses_the_leadscrew(values: tuple[float, float, float], order: list[str], at: float) -> None:
    slave = Axis(
        2,
        "S",
        cross=Cross(1, (0.0,), (values[0],), 5),
        plane=Plane(1, 1, 0.0, 0.0, 1.0, 1.0, ((values[1],),), 5),
        crosstalk=CrosstalkCurve(1, (0.0,), (values[2],), 5),
        leadscrew=Leadscrew((0.0,), (0.0,), (-1.0,)),
    )
    enable = {f"S.{kind}_on": np.arange(8) < 2 + order.index(kind) for kind in order}
    run = drive(Machine((Axis(1, "M"), slave)), {"S.setpoint": at, "S.no_move": True, **enable})
    assert run["S.leadscrew_correction"].tolist() == [0.0] * 8
    assert run["S.corrected_setpoint"] == pytest.approx([at + sum(values)] * 8, abs=1e-12)
