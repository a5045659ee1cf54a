"""Switching: sin², commands and their standstill rule, references, manual activation, reset, program end, release."""

from dataclasses import replace

import numpy as np
import pytest
from driving import drive, soft, walk
from hypothesis import given, settings, strategies as st
from numpy.typing import ArrayLike, NDArray

from axcomp.kinds import Backlash, Cross, CrosstalkCurve, Friction, Leadscrew, Plane, Temperature
from axcomp.model import Axis, Machine

N = 6


def compensated(kind: str, *, manual: bool = False, cycles: int = N) -> Machine:
    """Axis S corrected by 1 at full weight, by one kind; M is its master."""
    corrections = {
        "cross": Cross(1, (0.0,), (1.0,), cycles, manual),
        "plane": Plane(1, 1, 0.0, 0.0, 1.0, 1.0, ((1.0,),), cycles, manual),
        "crosstalk": CrosstalkCurve(1, (0.0,), (1.0,), cycles, manual),
        "temperature": Temperature(offset=1.0, n_cycles=max(cycles, 1)),
        "leadscrew": Leadscrew((0.0,), (-1.0,), manual_activation=manual),
        "backlash": Backlash(1.0, 2),
        "friction": Friction((0.0,), (1.0,)),
    }
    return Machine((Axis(1, "M"), replace(Axis(2, "S"), **{kind: corrections[kind]})))


SOFT = ("cross", "plane", "crosstalk")
"""The kinds that wait for standstill."""

RAMPED = (*SOFT, "temperature")
"""The kinds with n_cycles."""


def weights(kind: str, columns: dict[str, ArrayLike], **options: object) -> NDArray[np.float64]:
    run = drive(compensated(kind, **options), columns)
    assert (run[f"S.{kind}_active"] == (run[f"S.{kind}_correction"] > 0)).all()
    assert run["S.corrected_setpoint"] == pytest.approx(
        np.broadcast_to(columns.get("S.setpoint", 0.0), len(run["S.correction"])) + run[f"S.{kind}_correction"]
    )
    return run[f"S.{kind}_correction"]


def flags(text: str) -> NDArray[np.bool_]:
    """``"11.1"``: True, True, False, True."""
    return np.array([letter != "." for letter in text])


class TestRamp:
    @pytest.mark.parametrize("kind", RAMPED)
    @settings(max_examples=5, deadline=None)
    @given(cycles=st.integers(0, 20), enable=st.lists(st.booleans(), min_size=1, max_size=80))
    def test_any_sequence_of_commands_against_the_whole_walk(self, kind: str, cycles: int, enable: list[bool]) -> None:
        w = weights(kind, {f"S.{kind}_on": enable}, cycles=cycles)
        n = max(cycles, 1)
        assert w == pytest.approx(soft(walk(enable, n, n if enable[0] else 0), n), abs=1e-15)

    @pytest.mark.parametrize("kind", RAMPED)
    def test_on_takes_n_cycles_and_the_first_one_counts(self, kind: str) -> None:
        w = weights(kind, {f"S.{kind}_on": flags(".111111111")})
        assert w == pytest.approx([0, *np.sin(np.pi / 12 * np.arange(1, 7)) ** 2, 1, 1, 1], abs=1e-15)

    @pytest.mark.parametrize("cycles", [0, 1])
    def test_0_and_1_cycles_are_at_once(self, cycles: int) -> None:
        assert weights("cross", {"S.cross_on": flags("1.1..1")}, cycles=cycles).tolist() == [1, 0, 1, 0, 0, 1]

    def test_toggled_midway_it_turns_round_where_it_is(self) -> None:
        w = weights("cross", {"S.cross_on": flags("...111...11")})
        assert w == pytest.approx(np.sin(np.pi / 12 * np.array([0, 0, 0, 1, 2, 3, 2, 1, 0, 1, 2])) ** 2, abs=1e-15)

    @pytest.mark.parametrize("kind", [*RAMPED, "leadscrew", "backlash", "friction"])
    def test_what_is_on_at_the_start_begins_at_full_weight(self, kind: str) -> None:
        run = drive(compensated(kind), {"S.velocity": [5.0 if kind in ("backlash", "friction") else 0.0]})
        assert run["S.current" if kind == "friction" else f"S.{kind}_correction"] == [1.0]

    def test_only_the_switching_is_filtered_never_the_moving_value(self) -> None:
        slave = Axis(2, "S", cross=Cross(1, (0.0, 100.0), (0.0, 100.0), N))
        master = np.array([0.0, 100.0, -50.0, 60.0, 60.0, 10.0, 0.0, 90.0, 3.0, 80.0])
        run = drive(Machine((Axis(1, "M"), slave)), {"M.setpoint": master, "S.cross_on": flags("111....111")})
        w = soft(walk(flags("111....111"), N, N), N)
        assert run["S.cross_correction"] == pytest.approx(w * np.clip(master, 0, 100), abs=1e-13)

    def test_the_leadscrew_switches_at_once(self) -> None:
        assert weights("leadscrew", {"S.leadscrew_on": flags("1..1")}).tolist() == [1, 0, 0, 1]


class TestStandstill:
    @pytest.mark.parametrize("kind", SOFT)
    @pytest.mark.parametrize("motion", ["setpoint", "velocity"])
    def test_a_request_in_motion_waits_until_the_slave_stands(self, kind: str, motion: str) -> None:
        moves = flags("..111111.......")
        columns = {"S.setpoint": np.cumsum(moves)} if motion == "setpoint" else {"S.velocity": 2.0 * moves}
        w = weights(kind, {f"S.{kind}_on": flags("1111..........."), **columns})
        assert w == pytest.approx(soft(walk(flags("11111111......."), N, N), N), abs=1e-15)

    @pytest.mark.parametrize("kind", SOFT)
    def test_a_request_that_is_taken_back_in_motion_does_nothing(self, kind: str) -> None:
        w = weights(kind, {f"S.{kind}_on": flags("1..1.11111"), "S.velocity": 1.0 * flags("1111111...")})
        assert (w == 1.0).all()

    @pytest.mark.parametrize("kind", SOFT)
    def test_a_ramp_that_has_begun_goes_on_in_motion(self, kind: str) -> None:
        w = weights(kind, {f"S.{kind}_on": flags("1........"), "S.velocity": 1.0 * flags("..1111111")})
        assert w == pytest.approx(soft(walk(flags("1........"), N, N), N), abs=1e-15)

    @pytest.mark.parametrize("kind", SOFT)
    def test_the_motion_of_the_master_does_not_matter(self, kind: str) -> None:
        w = weights(kind, {f"S.{kind}_on": flags("1......."), "M.velocity": 9.0, "M.setpoint": np.arange(8.0)})
        assert w == pytest.approx(soft(walk(flags("1......."), N, N), N), abs=1e-15)

    @pytest.mark.parametrize(("step", "granted"), [(1.1e-9, 7), (-2e-9, 7), (0.3e-9, 5), (-0.3e-9, 5), (0.1e-9, 4)])
    def test_slow_motion_is_motion_once_it_has_summed_up(self, step: float, granted: int) -> None:
        # commanded in cycle 4: 0.3e-9 a cycle has become a motion just then, 0.1e-9 has not
        columns = {"S.cross_on": flags("1111........"), "S.setpoint": step * np.minimum(np.arange(12), 6)}
        on = "".join("1" if k < granted else "." for k in range(12))
        assert weights("cross", columns) == pytest.approx(ramped("cross", on), abs=1e-8)

    @pytest.mark.parametrize("kind", SOFT)
    def test_residue_of_rounding_is_standstill(self, kind: str) -> None:
        # v += a·T leaves 1e-15; setpoints jitter in their last place
        columns = {f"S.{kind}_on": flags("1......"), "S.velocity": 1e-15, "S.setpoint": 7.0 + 1e-15 * flags(".1.1.1.")}
        w = drive(compensated(kind), columns)[f"S.{kind}_correction"]
        assert w == pytest.approx(ramped(kind, "1......"), abs=1e-15)

    def test_leadscrew_temperature_and_friction_do_not_wait(self) -> None:
        moving = {"S.velocity": 3.0, "S.setpoint": 0.003 * np.arange(4)}
        w = weights("temperature", {"S.temperature_on": flags("1..1"), **moving})
        assert w == pytest.approx(ramped("temperature", "1..1"), abs=1e-15)
        assert weights("leadscrew", {"S.leadscrew_on": flags("1..1"), **moving}).tolist() == [1, 0, 0, 1]
        run = drive(compensated("friction"), {"S.friction_on": flags("1..1"), **moving})
        assert run["S.current"].tolist() == [1, 0, 0, 1]


REFERENCES = {"cross": ["M"], "plane": ["M", "S"], "temperature": ["S"], "leadscrew": ["S"]}


def cycles_of(kind: str) -> int:
    return N if kind in RAMPED else 1


def ramped(kind: str, on: str) -> NDArray[np.float64]:
    """Weights of a compensation that is on at the start and then goes where ``on`` says, a step a cycle."""
    n = cycles_of(kind)
    return soft(walk(flags(on), n, n if flags(on)[0] else 0), n)


class TestReference:
    @pytest.mark.parametrize(("kind", "axis"), [(kind, axis) for kind, axes in REFERENCES.items() for axis in axes])
    @pytest.mark.parametrize("velocity", [0.0, 3.0])
    @pytest.mark.parametrize("referenced", ["11..1111111", "111........", "1.........1", "..111.11111"])
    def test_losing_and_gaining_it_run_along_the_ramp_even_in_motion(
        self, kind: str, axis: str, velocity: float, referenced: str
    ) -> None:
        columns = {f"{axis}.referenced": flags(referenced), "S.velocity": velocity, "M.velocity": velocity}
        assert weights(kind, columns) == pytest.approx(ramped(kind, referenced), abs=1e-15)

    @pytest.mark.parametrize("axis", ["M", "S"])
    def test_crosstalk_without_adaptation_axes_friction_and_backlash_need_none(self, axis: str) -> None:
        columns = {f"{axis}.referenced": False, "S.velocity": [0.0] * 3}
        assert weights("crosstalk", columns).tolist() == [1, 1, 1]
        moving = {**columns, "S.velocity": [5.0] * 3}
        assert drive(compensated("friction"), moving)["S.current"].tolist() == [1, 1, 1]
        assert weights("backlash", {**columns, "S.velocity": [5.0] * 3}).tolist() == [1, 1, 1]

    def test_any_losses_against_the_whole_walk(self) -> None:
        referenced = "1.111.11......111.1.1.1111111111"
        assert weights("cross", {"M.referenced": flags(referenced)}) == pytest.approx(
            ramped("cross", referenced), abs=1e-15
        )

    def test_a_command_does_not_wait_for_standstill_while_it_is_lost(self) -> None:
        # the command of cycle 1 comes in motion and waits; from cycle 2 the weight runs down, and stays down
        columns = {"S.velocity": 1.0, "M.referenced": flags("11...1111111"), "S.cross_on": flags("1...........")}
        assert weights("cross", columns) == pytest.approx(ramped("cross", "11.........."), abs=1e-15)

    def test_switched_on_in_motion_while_it_is_lost_it_comes_with_the_reference(self) -> None:
        columns = {"S.velocity": 1.0, "M.referenced": flags("...11111111"), "S.cross_on": flags(".1111111111")}
        assert weights("cross", columns) == pytest.approx(ramped("cross", "...11111111"), abs=1e-15)


EVENTS = ["reset", "program_end", "S.released"]


class TestManual:
    @pytest.mark.parametrize("kind", [*SOFT, "leadscrew"])
    def test_it_is_off_until_the_command_comes(self, kind: str) -> None:
        w = weights(kind, {f"S.{kind}_on": flags("..1111111")}, manual=True)
        assert w == pytest.approx(ramped(kind, "..1111111"), abs=1e-15)

    @pytest.mark.parametrize("kind", [*SOFT, "leadscrew"])
    @pytest.mark.parametrize("event", EVENTS)
    def test_reset_program_end_and_release_switch_it_off_until_the_next_edge(self, kind: str, event: str) -> None:
        enable = flags("1111111111111.1")
        w = weights(kind, {f"S.{kind}_on": enable, event: flags("..1............")}, manual=True)
        assert w == pytest.approx(ramped(kind, "11............1"), abs=1e-15)

    @pytest.mark.parametrize("kind", [*RAMPED, "leadscrew"])
    @pytest.mark.parametrize("event", EVENTS)
    def test_an_automatic_one_does_not_care(self, kind: str, event: str) -> None:
        assert (weights(kind, {f"S.{kind}_on": True, event: flags(".1.1")}) == 1.0).all()

    @pytest.mark.parametrize("kind", SOFT)
    @pytest.mark.parametrize("event", EVENTS)
    def test_they_wait_for_standstill(self, kind: str, event: str) -> None:
        columns = {f"S.{kind}_on": True, event: flags(".1........"), "S.velocity": 1.0 * flags("1111......")}
        w = weights(kind, columns, manual=True)
        assert w == pytest.approx(ramped(kind, "1111......"), abs=1e-15)

    @pytest.mark.parametrize("kind", [*SOFT, "leadscrew"])
    def test_only_the_edge_of_a_release_counts(self, kind: str) -> None:
        # given back in cycle 1 and for long; the command of cycle 4 takes the axis again, and nothing refuses it
        columns = {f"S.{kind}_on": flags("111.11111111"), "S.released": flags(".11111111...")}
        w = weights(kind, columns, manual=True)
        assert w == pytest.approx(ramped(kind, "1...11111111"), abs=1e-15)

    @pytest.mark.parametrize("kind", [*SOFT, "leadscrew"])
    def test_the_release_of_another_axis_does_not_matter(self, kind: str) -> None:
        columns = {f"S.{kind}_on": True, "M.released": flags(".11.1")}
        assert (weights(kind, columns, manual=True) == 1.0).all()

    @pytest.mark.parametrize("kind", ["cross", "crosstalk"])
    def test_the_reference_of_its_own_axis_does_not_matter(self, kind: str) -> None:
        columns = {f"S.{kind}_on": flags("..11111111"), "S.referenced": flags("1...1.....")}
        assert weights(kind, columns, manual=True) == pytest.approx(ramped(kind, "..11111111"), abs=1e-15)

    @pytest.mark.parametrize(("kind", "axis"), [("cross", "M"), ("plane", "M"), ("plane", "S"), ("leadscrew", "S")])
    def test_after_the_loss_of_a_reference_that_it_needs_it_comes_back(self, kind: str, axis: str) -> None:
        referenced = "11..1111111"
        columns = {f"S.{kind}_on": True, f"{axis}.referenced": flags(referenced), "S.velocity": 1.0}
        assert weights(kind, columns, manual=True) == pytest.approx(ramped(kind, referenced), abs=1e-15)

    @pytest.mark.parametrize("kind", [*SOFT, "leadscrew"])
    @pytest.mark.parametrize("obstacle", ["reset", "program_end"])
    def test_a_command_that_comes_too_early_is_refused(self, kind: str, obstacle: str) -> None:
        columns = {f"S.{kind}_on": flags("..1111.11"), obstacle: flags("11111....")}
        w = weights(kind, columns, manual=True)
        assert w == pytest.approx(ramped(kind, ".......11"), abs=1e-15)

    @pytest.mark.parametrize(("kind", "axis"), [("cross", "M"), ("plane", "M"), ("plane", "S"), ("leadscrew", "S")])
    @pytest.mark.parametrize("enable", ["1111111.11", "..11111.11", "....111.11"])
    def test_a_command_before_the_reference_is_refused_too(self, kind: str, axis: str, enable: str) -> None:
        columns = {f"S.{kind}_on": flags(enable), f"{axis}.referenced": flags(".....11111")}
        assert weights(kind, columns, manual=True) == pytest.approx(ramped(kind, "........11"), abs=1e-15)

    def test_enabled_from_the_start_it_is_on_from_the_start(self) -> None:
        assert weights("cross", {"S.cross_on": flags("111")}, manual=True).tolist() == [1, 1, 1]

    @pytest.mark.parametrize("event", EVENTS)
    def test_unless_it_is_taken_off_at_once(self, event: str) -> None:
        assert weights("cross", {"S.cross_on": flags("11"), event: flags("1.")}, manual=True).tolist() == [0, 0]

    @pytest.mark.parametrize("event", EVENTS)
    def test_what_happens_while_the_axis_is_held_is_not_missed(self, event: str) -> None:
        columns = {"S.cross_on": True, event: flags("..1......")}
        setpoint = np.where(flags(".111....."), np.nan, 0.0)
        run = drive(compensated("cross", manual=True), {**columns, "S.setpoint": setpoint})
        assert run["S.cross_correction"] == pytest.approx([1, 1, 1, 1, *soft([5, 4, 3, 2, 1], N)])
