"""Friction compensation against a model that knows the whole trajectory, reversals to come included."""

import numpy as np
import pytest
from driving import drive, forward
from hypothesis import example, given, settings, strategies as st
from numpy.typing import NDArray

from axcomp.kinds import Friction
from axcomp.model import Axis, AxisType, Machine, ModuloRange
from axcomp.runtime import Runtime

T = 1e-3
VELOCITIES, CURRENTS = (0.5, 2.0, 10.0, 50.0), (1.0, 0.4, 0.7, 2.0)


def friction(**options: object) -> Friction:
    return Friction(VELOCITIES, CURRENTS, **options)


def machine(compensation: Friction, **options: object) -> Machine:
    return Machine((Axis(1, "X", friction=compensation, **options),))


def expected(
    s: NDArray[np.float64], v: NDArray[np.float64], table: Friction, *, decay: bool = True
) -> NDArray[np.float64]:
    """I over a whole run; ``decay``: with w_before, from the reversals that are going to come."""
    k = np.arange(len(v))
    sign = np.sign(v)
    reversals = np.flatnonzero((sign != 0) & (sign != np.roll(forward(sign, 0), 1)) | ((sign != 0) & (k == 0)))
    current = table.scaling * sign * np.interp(np.abs(v), table.velocities, table.currents)
    begun = np.searchsorted(reversals, k, side="right") - 1
    if table.position_delay > 0:
        since = np.where(begun >= 0, np.abs(s - s[reversals[begun]]), 0) if len(reversals) else 0.0 * s
        current = current * np.minimum(since / table.position_delay, 1)
    if decay and table.reversal_lookahead > 0 and len(reversals):
        following = np.append(reversals, 10**9)[begun + 1]
        current = current * np.clip((following - 1 - k) / table.reversal_lookahead, 0, 1)
    return np.concatenate([np.zeros(table.delay_cycles), current])[: len(v)]


def motion(cycles: int, rng: np.random.Generator) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return setpoints and velocities: stretches of one sign, some only a cycle long, with stops in between."""
    parts: list[NDArray[np.float64]] = []
    while sum(map(len, parts)) < cycles:
        n = int(rng.choice([1, 2, 3, 5, 20]))
        sign = rng.choice([-1.0, 0.0, 1.0])
        parts.append(sign * np.exp(rng.uniform(-3, 5, n)))
    v = np.concatenate(parts)[:cycles]
    return np.cumsum(v) * T, v


class TestCurve:
    @pytest.mark.parametrize("v", [1e-300, 1e-15, 9e-7])
    def test_what_rounding_leaves_of_a_velocity_is_standstill(self, v: float) -> None:
        # 1e-6 mm/s are 1e-9 mm a cycle
        run = drive(machine(friction(scaling=1.3)), {"X.velocity": [v, -v, 5.0, -v, v]})
        expected = 1.3 * np.interp(5.0, VELOCITIES, CURRENTS)
        assert run["X.current"] == pytest.approx([0.0, 0.0, expected, 0.0, 0.0], abs=1e-15)

    def test_residue_of_a_velocity_is_no_reversal(self) -> None:
        v = np.array([5.0, 5.0, -1e-15, 1e-15, 5.0, 5.0])
        run = drive(machine(friction(position_delay=0.005)), {"X.velocity": v, "X.setpoint": np.cumsum(v) * T})
        full = np.interp(5.0, VELOCITIES, CURRENTS)
        # the start counts as a reversal, at the first setpoint
        assert run["X.current"] == pytest.approx([0.0, full, 0.0, 0.0, full, full], abs=1e-14)

    def test_it_is_numpys_interpolation_with_the_sign_of_the_velocity(self, rng: np.random.Generator) -> None:
        v = np.concatenate([VELOCITIES, np.negative(VELOCITIES), rng.uniform(-80, 80, 300), [2e-6, -2e-6, 9e14]])
        run = drive(machine(friction(scaling=1.3)), {"X.velocity": v})
        assert run["X.current"] == pytest.approx(
            1.3 * np.sign(v) * np.interp(np.abs(v), VELOCITIES, CURRENTS), abs=1e-15
        )

    def test_no_velocity_no_current(self) -> None:
        assert drive(machine(friction()), {"X.velocity": [3.0, 0.0, -0.0, -3.0]})["X.current"][1:3].tolist() == [
            0.0,
            0.0,
        ]

    @pytest.mark.parametrize("scaling", [0.0, 0.25, -2.0])
    def test_the_scaling_multiplies_everything(self, scaling: float) -> None:
        run = drive(machine(friction(scaling=scaling)), {"X.velocity": [10.0, -50.0]})
        assert run["X.current"].tolist() == [0.7 * scaling, -2.0 * scaling]

    def test_it_acts_whether_referenced_or_not_and_never_moves_the_axis(self) -> None:
        run = drive(machine(friction()), {"X.referenced": False, "X.setpoint": [4.0], "X.velocity": [10.0]})
        assert (run["X.current"], run["X.corrected_setpoint"], run["X.friction_active"]) == ([0.7], [4.0], [True])

    def test_the_enable_input_switches_at_once_even_in_motion(self) -> None:
        run = drive(machine(friction()), {"X.velocity": 10.0, "X.friction_on": [True, False, False, True]})
        assert run["X.current"].tolist() == [0.7, 0.0, 0.0, 0.7]


class TestBuildUp:
    def test_it_grows_linearly_over_position_delay_after_start_and_reversals(self) -> None:
        v = np.array([10.0, 10.0, 10.0, 10.0, 10.0, -10.0, -10.0, -10.0, 10.0, 10.0])
        s = np.cumsum(v) * T
        run = drive(machine(friction(position_delay=0.03)), {"X.setpoint": s, "X.velocity": v})
        w = np.array([0, 1, 2, 3, 3, 0, 1, 2, 0, 1]) / 3
        assert run["X.current"] == pytest.approx(0.7 * w * np.sign(v), abs=1e-12)

    def test_a_stop_without_reversal_starts_nothing_anew(self) -> None:
        v = np.array([10.0] * 6 + [0.0] * 3 + [10.0] * 2)
        run = drive(machine(friction(position_delay=0.03)), {"X.setpoint": np.cumsum(v) * T, "X.velocity": v})
        assert run["X.current"][-2:].tolist() == [0.7, 0.7]

    def test_a_stop_amid_the_build_up_goes_on_from_there(self) -> None:
        v = np.array([10.0, 10.0, 0.0, 0.0, 10.0, 10.0])
        run = drive(machine(friction(position_delay=0.05)), {"X.setpoint": np.cumsum(v) * T, "X.velocity": v})
        assert run["X.current"] == pytest.approx(0.7 * np.array([0.0, 0.2, 0.0, 0.0, 0.4, 0.6]))

    @pytest.mark.parametrize("direction", [1.0, -1.0])
    def test_on_a_modulo_axis_it_grows_over_the_seam(self, direction: float) -> None:
        c = 0.5 - direction * 0.52 + direction * 0.01 * np.arange(8) + (direction < 0) * 359.0
        axis = {"type": AxisType.ROTARY, "modulo": ModuloRange()}
        runs = [
            drive(machine(friction(position_delay=0.05), **axis), {"X.setpoint": at, "X.velocity": 10.0 * direction})
            for at in (c, c % 360.0)
        ]
        for run in runs:
            assert run["X.current"] == pytest.approx(0.7 * direction * np.minimum(np.arange(8) / 5, 1), abs=1e-9)

    def test_after_half_a_turn_it_stays_built_up(self) -> None:
        c = np.arange(0.0, 1000.0, 5.0)
        run = drive(
            machine(friction(position_delay=20.0), type=AxisType.ROTARY, modulo=ModuloRange()),
            {"X.setpoint": c % 360.0, "X.velocity": 50.0},
        )
        assert run["X.current"].tolist() == pytest.approx((2.0 * np.minimum(c / 20.0, 1)).tolist())


class TestLookaheadInTheDelayLine:
    @pytest.mark.parametrize("lookahead", range(1, 5))
    def test_the_last_cycles_before_a_reversal_count_down_to_0(self, lookahead: int) -> None:
        v = np.array([10.0] * 8 + [-10.0] * 8)
        run = drive(machine(friction(reversal_lookahead=lookahead, delay_cycles=lookahead)), {"X.velocity": v})
        down = 0.7 * np.arange(lookahead - 1, -1, -1) / lookahead
        expected = [0.0] * lookahead + [0.7] * (8 - lookahead) + down.tolist() + [-0.7] * (8 - lookahead)
        assert run["X.current"] == pytest.approx(expected)

    def test_slowing_down_and_going_on_the_same_way_weights_nothing(self) -> None:
        v = np.array([10.0, 8.0, 2.0, 0.0, 0.0, 2.0, 10.0])
        run = drive(machine(friction(reversal_lookahead=3, delay_cycles=3)), {"X.velocity": v, "X.acceleration": -1e4})
        assert run["X.current"][3:] == pytest.approx(np.interp(v, VELOCITIES, CURRENTS)[:4] * (v[:4] > 0))

    def test_cycles_of_standstill_before_the_reversal_count(self) -> None:
        v = np.array([10.0, 10.0, 10.0, 0.0, 0.0, -10.0] + [-10.0] * 4)
        run = drive(machine(friction(reversal_lookahead=4, delay_cycles=4)), {"X.velocity": v})
        assert run["X.current"][4:8] == pytest.approx([0.7, 0.7 * 3 / 4, 0.7 * 2 / 4, 0.0])

    def test_a_reversal_shortly_after_another_weights_only_what_lies_between(self) -> None:
        v = np.array([10.0] * 6 + [-10.0] * 2 + [10.0] * 6)
        run = drive(machine(friction(reversal_lookahead=4, delay_cycles=4)), {"X.velocity": v})
        weighted = [0.7, 0.7, 0.7 * 3 / 4, 0.7 * 2 / 4, 0.7 / 4, 0.0, -0.7 / 4, 0.0, 0.7, 0.7]
        assert run["X.current"][4:] == pytest.approx(weighted)

    @settings(max_examples=40, deadline=None)
    @given(
        st.integers(0, 4), st.integers(0, 6) | st.sampled_from([100, 247, 248]), st.sampled_from([0.0, 0.02]),
        st.integers(0, 2**32 - 1),
    )  # fmt: skip
    @example(4, 4, 0.02, 1)
    @example(4, 248, 0.0, 2)
    @example(0, 0, 0.02, 3)
    def test_any_motion_against_the_whole_trajectory(self, lookahead: int, more: int, delay: float, seed: int) -> None:
        s, v = motion(600, np.random.default_rng(seed))
        table = friction(
            scaling=0.8, position_delay=delay, reversal_lookahead=lookahead, delay_cycles=min(lookahead + more, 248)
        )
        # setpoints that follow the velocity: |s − s_reversal| only grows until the next reversal
        run = drive(machine(table), {"X.setpoint": s, "X.velocity": v})
        assert run["X.current"] == pytest.approx(expected(s, v, table), abs=1e-12)


class TestPredictedLookahead:
    def approach(self, crossing: float, cycles: int = 12) -> NDArray[np.float64]:
        """Velocities of a constant deceleration that passes 0 after ``crossing`` cycles."""
        return 4.0 * (crossing - np.arange(cycles))

    @pytest.mark.parametrize("crossing", [5.5, 6.25, 6.999, 5.0, 6.0, 7.0])
    @pytest.mark.parametrize(("lookahead", "delay"), [(1, 0), (2, 0), (3, 2), (4, 0), (4, 1), (4, 3)])
    def test_constant_deceleration_through_0_gives_what_the_delay_line_gives(
        self, lookahead: int, delay: int, crossing: float
    ) -> None:
        for direction in (1.0, -1.0):
            v = direction * self.approach(crossing)
            a = np.full_like(v, -4.0 * direction / T)
            table = friction(reversal_lookahead=lookahead, delay_cycles=delay)
            run = drive(machine(table), {"X.velocity": v, "X.acceleration": a})
            s = np.zeros_like(v)
            assert run["X.current"] == pytest.approx(expected(s, v, table), abs=1e-12)

    def test_away_from_0_nothing_is_weighted(self) -> None:
        v = np.array([1.0, 2.0, 3.0, -1.0, -2.0])
        a = np.array([1.0, 1e6, 0.0, -1.0, -1e6])
        table = friction(reversal_lookahead=4)
        run = drive(machine(table), {"X.velocity": v, "X.acceleration": a})
        assert run["X.current"] == pytest.approx(expected(0 * v, v, table, decay=False))

    def test_a_stop_without_reversal_is_weighted_too(self) -> None:
        v = np.concatenate([self.approach(5.5, 6), np.zeros(3), [2.0, 10.0]])
        a = np.concatenate([np.full(6, -4.0 / T), np.zeros(5)])
        table = friction(reversal_lookahead=4)
        run = drive(machine(table), {"X.velocity": v, "X.acceleration": a})
        w = np.clip(np.append(np.arange(5, -1, -1) / 4, [1.0] * 5), 0, 1)
        assert run["X.current"] == pytest.approx(w * expected(0 * v, v, table, decay=False))

    def test_the_cycle_time_counts(self) -> None:
        runtime = Runtime(machine(friction(reversal_lookahead=4)), cycle_time=0.004)
        run = drive(runtime, {"X.velocity": [10.0], "X.acceleration": [-10.0 / 0.010]})
        assert run["X.current"] == pytest.approx([0.7 * 2 / 4])


class TestDelay:
    @pytest.mark.parametrize("delay", [0, 1, 7, 248])
    def test_the_current_comes_so_many_cycles_late(self, delay: int, rng: np.random.Generator) -> None:
        v = rng.uniform(-60, 60, 600)
        late, now = (drive(machine(friction(delay_cycles=n)), {"X.velocity": v})["X.current"] for n in (delay, 0))
        assert (late[delay:] == now[: 600 - delay]).all()
        assert (late[:delay] == 0).all()

    @pytest.mark.parametrize(("before", "after"), [(0, 3), (2, 5), (5, 2), (3, 248), (248, 3), (4, 4)])
    def test_with_another_delay_what_waits_goes_on_waiting_and_what_is_not_there_is_held(
        self, before: int, after: int, rng: np.random.Generator
    ) -> None:
        v, at = rng.uniform(-60, 60, 700), 300
        now = drive(machine(friction()), {"X.velocity": v})["X.current"]
        runtime = Runtime(machine(friction(delay_cycles=before)))
        first = drive(runtime, {"X.velocity": v[:at]})["X.current"]
        runtime.update(machine(friction(delay_cycles=after)))
        second = drive(runtime, {"X.velocity": v[at:]})["X.current"]
        assert (first[before:] == now[: at - before]).all()
        # The oldest current that is still known is the one of the last cycle before the update.
        origin = np.maximum(np.arange(at, 700) - after, at - 1 - before)
        assert (second == now[origin]).all()
