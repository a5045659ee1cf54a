"""A machine in operation: the clock, snapshots, updates, and what two of them have in common: nothing."""

import copy
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from strategies import machines

from axcomp.kernel import BACKLASH, CROSS, CROSSTALK, FRICTION, LEADSCREW, PLANE, TEMPERATURE
from axcomp.kinds import (
    Backlash,
    Cross,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
    Friction,
    Leadscrew,
    Plane,
    Temperature,
)
from axcomp.model import Axis, Machine
from axcomp.runtime import CompileError, Runtime, SnapshotError, UpdateError

LINE = tuple(float(x) for x in range(-50, 51, 10))
X = Axis(
    1,
    "X",
    backlash_cycles=6,
    leadscrew=Leadscrew(LINE, tuple((0.01 * np.sin(LINE)).tolist()), tuple((0.01 * np.cos(LINE)).tolist())),
    friction=Friction((1.0, 100.0), (1.0, 3.0), 1.0, 0.01, 2, 4),
)
Z = Axis(
    3,
    "Z",
    cross=Cross(1, LINE, tuple((0.1 * np.cos(LINE)).tolist()), 10),
    plane=Plane(1, 1, -50.0, 0.0, 25.0, 1.0, ((0.1, 0.2, -0.1, 0.0, 0.3),), 5),
    crosstalk=CrosstalkCurve(1, (-1e3, 1e3), (-0.01, 0.01), 5),
)
MACHINE = Machine((X, Z))


def move(runtime: Runtime, k: int) -> None:
    """Set the inputs of cycle k: a motion to and fro with stops, and switches."""
    for i, axis in enumerate(runtime.inputs.axis):
        phase = 0.05 * k + i
        axis.setpoint = 40.0 * np.clip(np.sin(phase), -0.9, 0.9).item()
        axis.velocity = 2e3 * np.cos(phase).item() if abs(np.sin(phase)) < 0.9 else 0.0
        axis.acceleration = -1e5 * np.sin(phase).item()
        axis.wanted[CROSS] = 1 if (k // 40) % 2 == 0 else -1
        axis.no_move = (k // 60) % 2 == 0
        axis.wanted[LEADSCREW] = 1 if (k // 25) % 3 < 2 else -1


def run(runtime: Runtime, first: int, last: int) -> list[str]:
    """Run the cycles first … last − 1 and return what they put out."""
    outputs = []
    for k in range(first, last):
        move(runtime, k)
        runtime.cycle()
        outputs.append(repr(runtime.outputs))
    return outputs


class TestClock:
    def runtime(self, start: float = 0.0, cycle_time: float = 1e-3) -> Runtime:
        runtime = Runtime(Machine((Axis(1, "X"),)), cycle_time)
        runtime.begin(start)
        return runtime

    def test_the_outputs_at_the_end_of_initialization_are_those_of_the_first_cycle(self) -> None:
        for k in (0, 7):
            runtime = Runtime(MACHINE)
            move(runtime, k)
            runtime.begin(5.0)
            begun, before = repr(runtime.outputs), repr(runtime.state)
            assert repr(Runtime(MACHINE).state) == before  # nothing has happened yet
            runtime.cycle()
            assert repr(runtime.outputs) == begun

    @pytest.mark.parametrize("cycle_time", [1e-3, 2e-3, 1 / 3000, 0.004, 0.1])
    def test_a_cycle_runs_for_each_instant_before_the_communication_point(self, cycle_time: float) -> None:
        runtime = self.runtime(cycle_time=cycle_time)
        for k in range(1, 500):
            runtime.advance(k * cycle_time)
            assert runtime.cycles == k

    @settings(max_examples=50)
    @given(st.floats(0.0, 1e5), st.lists(st.floats(1e-7, 0.05), min_size=1, max_size=30))
    def test_any_communication_steps_run_the_cycles_that_lie_in_them(self, start: float, steps: list[float]) -> None:
        runtime, time = self.runtime(start), start
        for step in steps:
            time += step
            runtime.advance(time)
            assert abs(runtime.cycles - (time - start) / 1e-3) < 1.0 + 0.011

    def test_steps_shorter_than_a_cycle_hold_the_outputs(self) -> None:
        runtime = self.runtime()
        axis = runtime.inputs.axis[0]
        seen = []
        for n in range(1, 41):
            axis.setpoint = float(n)
            runtime.advance(n * 0.00025)
            seen.append(runtime.outputs.axis[0].corrected_setpoint)
        assert seen == [1.0 + 4 * ((n - 1) // 4) for n in range(1, 41)]

    @pytest.mark.parametrize("splits", [1, 2, 3, 7, 10])
    def test_splitting_communication_steps_changes_nothing_at_the_instants(self, splits: int) -> None:
        whole, split = Runtime(MACHINE), Runtime(MACHINE)
        for runtime in (whole, split):
            runtime.begin(1.5)
        for k in range(200):
            for runtime in (whole, split):
                move(runtime, k)
            whole.advance(1.5 + (k + 1) * 1e-3)
            for part in range(1, splits + 1):
                split.advance(1.5 + k * 1e-3 + part * 1e-3 / splits)
            assert repr(split.outputs) == repr(whole.outputs)
        assert repr(split.state) == repr(whole.state)

    def test_one_long_step_is_as_many_cycles_with_the_inputs_held(self) -> None:
        one, other = Runtime(MACHINE), Runtime(MACHINE)
        for runtime in (one, other):
            runtime.begin()
            move(runtime, 3)
        one.advance(0.1)
        for _ in range(100):
            other.cycle()
        assert repr((one.state, one.outputs, one.cycles)) == repr((other.state, other.outputs, other.cycles))

    def test_a_host_that_adds_up_its_steps_loses_no_cycle(self) -> None:
        runtime, time = self.runtime(1e5), 1e5
        for k in range(1, 30_001):
            time += 1e-3
            runtime.advance(time)
            assert runtime.cycles == k
        assert abs(time - (1e5 + 30.0)) > 1e-9  # the sum has gone astray by more than its last place

    def test_going_back_in_time_runs_nothing(self) -> None:
        runtime = self.runtime()
        runtime.advance(0.01)
        runtime.advance(0.0)
        assert runtime.cycles == 10


class TestSnapshot:
    def test_a_snapshot_brings_back_state_inputs_outputs_and_clock(self) -> None:
        runtime = Runtime(MACHINE)
        runtime.begin(3.0)
        run(runtime, 0, 83)
        kept = copy.deepcopy((runtime.state, runtime.inputs, runtime.outputs, runtime.cycles, runtime.start_time))
        data = runtime.save()
        first = run(runtime, 83, 160)
        runtime.begin(9.0)
        runtime.restore(data)
        assert (runtime.state, runtime.inputs, runtime.outputs, runtime.cycles, runtime.start_time) == kept
        assert runtime.save() == data
        assert run(runtime, 83, 160) == first

    def test_another_runtime_of_an_equal_machine_takes_it(self) -> None:
        runtime, other = Runtime(MACHINE), Runtime(Machine((X, Z)))
        run(runtime, 0, 83)
        other.restore(runtime.save())
        assert run(other, 83, 120) == run(runtime, 83, 120)

    @pytest.mark.parametrize(
        "other",
        [
            Machine((X,)),
            Machine((X, replace(Z, number=4))),
            Machine((replace(X, leadscrew=Leadscrew((0.0,), (0.0,))), Z)),
            Machine((replace(X, friction=None), Z)),
        ],
    )
    def test_another_machine_refuses_it_and_stays_as_it_was(self, other: Machine) -> None:
        runtime, foreign = Runtime(MACHINE), Runtime(other)
        run(runtime, 0, 50)
        before = repr((foreign.state, foreign.inputs, foreign.outputs))
        if foreign.tables == runtime.tables:  # the number of an axis is nothing the kernel knows
            foreign.restore(runtime.save())
        else:
            with pytest.raises(SnapshotError, match="another machine"):
                foreign.restore(runtime.save())
            assert repr((foreign.state, foreign.inputs, foreign.outputs)) == before

    def test_another_cycle_time_is_another_machine(self) -> None:
        with pytest.raises(SnapshotError, match="another machine"):
            Runtime(MACHINE, 2e-3).restore(Runtime(MACHINE).save())

    def test_a_snapshot_from_before_an_update_is_refused(self) -> None:
        runtime = Runtime(MACHINE)
        data = runtime.save()
        runtime.update(Machine((replace(X, backlash_cycles=7), Z)))
        with pytest.raises(SnapshotError):
            runtime.restore(data)

    def test_the_size_of_a_snapshot_does_not_grow(self) -> None:
        runtime = Runtime(MACHINE)
        sizes = set()
        for k in range(0, 300, 30):
            run(runtime, k, k + 30)
            sizes.add(len(runtime.save()))
        assert len(sizes) == 1


@settings(max_examples=10)
@given(machines(), st.integers(0, 2**32 - 1))
def test_two_runtimes_of_one_machine_share_nothing(machine: Machine, seed: int) -> None:
    rng = np.random.default_rng(seed)
    one, other = Runtime(machine), Runtime(machine)
    untouched = repr((other.tables, other.state, other.inputs, other.outputs))
    for _ in range(20):
        for axis in one.inputs.axis:
            axis.setpoint, axis.velocity, axis.acceleration = rng.uniform(-100, 100, 3).tolist()
        one.cycle()
    one.update(machine)
    assert repr((other.tables, other.state, other.inputs, other.outputs)) == untouched


class TestUpdate:
    def test_the_new_values_count_from_the_next_cycle_on_and_come_in_over_n_cycles(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 20)
        held = runtime.outputs.axis[1].contribution[CROSS]
        twice = replace(Z, cross=replace(Z.cross, corrections=tuple(2 * c for c in Z.cross.corrections)))
        assert runtime.update(Machine((X, twice))) == {}
        assert runtime.outputs.axis[1].contribution[CROSS] == held
        values = []
        for _ in range(12):
            runtime.cycle()
            values.append(runtime.outputs.axis[1].contribution[CROSS])
        old = np.sin(np.pi / 2 * np.clip(np.arange(9, -3, -1), 0, 10) / 10) ** 2
        assert values == pytest.approx(2 * held - old * held, abs=1e-15)

    def test_an_update_with_the_same_lists_changes_nothing(self) -> None:
        one, other = Runtime(MACHINE), Runtime(MACHINE)
        for k in range(0, 200, 8):  # in mid-ramp, in reversals, with a shift waiting
            assert run(one, k, k + 8) == run(other, k, k + 8)
            other.update(Machine((X, Z)))

    def test_shorter_tables_are_searched_from_the_front(self) -> None:
        long = Cross(1, tuple(float(i) for i in range(1000)), tuple(0.0 for _ in range(1000)))
        runtime = Runtime(Machine((Axis(1, "X"), Axis(3, "Z", cross=long))))
        runtime.inputs.axis[0].setpoint = 998.5
        runtime.cycle()
        runtime.update(Machine((Axis(1, "X"), Axis(3, "Z", cross=replace(long, positions=LINE, corrections=LINE)))))
        runtime.inputs.axis[0].setpoint = 5.0
        runtime.cycle()
        assert runtime.outputs.axis[1].contribution[CROSS] == 5.0

    def test_another_look_ahead_finds_a_state_that_fits(self) -> None:
        for before in range(5):
            for after in range(5):
                runtime = Runtime(Machine((Axis(1, "X", friction=Friction((0.0,), (1.0,), 1.0, 0.0, before, 4)),)))
                axis = runtime.inputs.axis[0]
                axis.velocity = 1.0
                for _ in range(10):
                    runtime.cycle()
                new = Friction((0.0,), (1.0,), 1.0, 0.0, after, 4)
                runtime.update(Machine((Axis(1, "X", friction=new),)))
                axis.velocity = -1.0
                currents = []
                for _ in range(9):
                    runtime.cycle()
                    currents.append(runtime.outputs.axis[0].contribution[FRICTION])
                assert all(-1.0 <= current <= 1.0 for current in currents)

    def test_a_ramp_goes_on_with_its_new_length(self) -> None:
        # 6 of 10 steps are 2 of 3: the ramp goes on where it is, not from its end
        runtime = Runtime(MACHINE)
        runtime.cycle()
        runtime.inputs.axis[1].wanted[CROSS] = -1
        for _ in range(4):
            runtime.cycle()
        runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=3)))))
        weights = []
        for _ in range(4):
            runtime.cycle()
            weights.append(runtime.outputs.axis[1].contribution[CROSS] / (0.1 * np.cos(0.0)))
        assert weights == pytest.approx([0.25, 0.0, 0.0, 0.0], abs=1e-15)

    @pytest.mark.parametrize("up", [False, True])
    @pytest.mark.parametrize("after", [1, 2, 3, 7, 9, 10, 11, 20])
    @pytest.mark.parametrize("steps", range(11))
    def test_a_ramp_that_is_under_way_keeps_its_weight(self, steps: int, after: int, up: bool) -> None:
        runtime = Runtime(MACHINE)
        runtime.inputs.axis[1].wanted[CROSS] = -1 if up else 1
        runtime.cycle()
        runtime.inputs.axis[1].wanted[CROSS] = 1 if up else -1
        for _ in range(steps):
            runtime.cycle()
        at = steps if up else 10 - steps
        runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=after)))))
        nearest = np.floor(at * after / 10 + 0.5)
        expected = np.clip(nearest + (1 if up else -1) * np.arange(1, 23), 0, after)
        weights = []
        for _ in range(22):
            runtime.cycle()
            weights.append(runtime.outputs.axis[1].contribution[CROSS] / 0.1)
        assert weights == pytest.approx(np.sin(np.pi / 2 * expected / after) ** 2, abs=1e-12)

    def test_what_is_on_stays_at_full_weight_and_switches_off_over_its_new_length(self) -> None:
        for cycles in (3, 20):
            runtime = Runtime(MACHINE)
            runtime.cycle()
            runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=cycles)))))
            weights = []
            for k in range(cycles + 3):
                runtime.inputs.axis[1].wanted[CROSS] = 1 if k < 2 else -1
                runtime.cycle()
                weights.append(runtime.outputs.axis[1].contribution[CROSS] / (0.1 * np.cos(0.0)))
            k = np.clip(np.append([cycles, cycles], np.arange(cycles - 1, -2, -1)), 0, cycles)
            assert weights == pytest.approx(np.sin(np.pi / 2 * k / cycles) ** 2)

    def test_a_table_that_is_dropped_runs_out_and_the_rest_is_as_it_was(self) -> None:
        runtime, other = Runtime(MACHINE), Runtime(MACHINE)
        run(runtime, 0, 30)
        run(other, 0, 30)
        before = copy.deepcopy(runtime.outputs.axis[1])
        runtime.update(Machine((X, replace(Z, cross=None))))
        after, kept = runtime.outputs.axis[1], other.outputs.axis[1]
        assert after == before
        for k in range(15):
            for one in (runtime, other):
                move(one, 30 + k)
                one.cycle()
            rest = np.sin(np.pi / 2 * max(9 - k, 0) / 10) ** 2 * before.contribution[CROSS]
            assert after.contribution[CROSS] == pytest.approx(rest, abs=1e-15)
            assert not after.active[CROSS]
            assert after.contribution[PLANE] == kept.contribution[PLANE]
            assert after.correction == pytest.approx(rest + kept.contribution[PLANE] + kept.contribution[CROSSTALK])
        assert after.contribution[CROSS] == 0.0

    def test_a_table_that_is_dropped_where_it_corrects_nothing_is_off(self) -> None:
        zero = replace(Z, cross=Cross(1, (0.0, 10.0), (0.0, 1.0), 10))
        runtime = Runtime(Machine((X, zero)))
        runtime.cycle()
        assert runtime.outputs.axis[1].active[CROSS]
        runtime.update(Machine((X, replace(Z, cross=None))))
        runtime.cycle()
        assert not runtime.outputs.axis[1].active[CROSS]

    def test_a_current_is_gone_at_once(self) -> None:
        runtime = Runtime(MACHINE)
        runtime.inputs.axis[0].velocity = 5.0
        for _ in range(10):
            runtime.cycle()
        runtime.inputs.axis[0].setpoint = 1.0
        for _ in range(10):
            runtime.cycle()
        assert runtime.outputs.axis[0].contribution[FRICTION] != 0.0
        runtime.update(Machine((replace(X, friction=None), Z)))
        runtime.cycle()
        assert (runtime.outputs.axis[0].contribution[FRICTION], runtime.outputs.axis[0].active[FRICTION]) == (
            0.0,
            False,
        )

    @pytest.mark.parametrize(
        ("kind", "error"), [("leadscrew", 110638), ("cross", 110639), ("plane", 110640), ("friction", 110641)]
    )
    def test_another_max_points_keeps_the_old_lists_of_that_axis(self, kind: str, error: int) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 10)
        old, other = (X, Z) if getattr(X, kind) else (Z, X)
        new = replace(old, **{kind: replace(getattr(old, kind), max_points=77)}, backlash_cycles=1)
        fresh = replace(other, backlash_cycles=2)
        axes = tuple(new if axis is old else fresh for axis in MACHINE.axes)
        assert runtime.update(Machine(axes)) == {old.name: error}
        assert runtime.machine == Machine(tuple(old if axis is old else fresh for axis in MACHINE.axes))
        index = MACHINE.index_of(old.number)
        for expected in (error, error):
            runtime.cycle()
            assert runtime.outputs.axis[index].error == expected
            assert runtime.outputs.axis[1 - index].error == 0
        runtime.inputs.reset = True
        runtime.cycle()
        assert runtime.outputs.axis[index].error == 0

    @pytest.mark.parametrize(
        ("new", "sentence"),
        [
            (Machine((X,)), "other axes"),
            (Machine((Z, X)), "other axes"),
            (Machine((replace(X, name="U"), Z)), "other axes"),
            (Machine((replace(X, cross=Z.cross), Z)), "axis X a compensation"),
        ],
    )
    def test_what_the_variables_do_not_allow_is_refused_as_a_whole(self, new: Machine, sentence: str) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 30)
        before = runtime.save()
        with pytest.raises(UpdateError, match=sentence):
            runtime.update(new)
        assert runtime.save() == before
        assert runtime.machine is MACHINE

    def test_an_update_can_be_undone_and_tables_can_come_and_go(self) -> None:
        # judged against what was declared at the start, never against the lists in force
        runtime = Runtime(MACHINE)
        without = Machine((replace(X, leadscrew=None), replace(Z, plane=None, cross=None)))
        for new in (without, MACHINE, Machine((X, replace(Z, cross=None))), without, MACHINE):
            assert runtime.update(new) == {}
            run(runtime, 0, 30)
        assert all(runtime.outputs.axis[1].active[kind] for kind in (PLANE, CROSSTALK))

    def test_max_points_is_judged_against_the_start_after_a_table_was_dropped_too(self) -> None:
        runtime = Runtime(MACHINE)
        assert runtime.update(Machine((X, replace(Z, cross=None)))) == {}
        larger = replace(Z, cross=replace(Z.cross, max_points=77))
        assert runtime.update(Machine((X, larger))) == {"Z": 110639}
        assert runtime.machine.axes[1].cross is None
        assert runtime.update(MACHINE) == {}
        assert runtime.machine == MACHINE

    def test_a_table_may_come_for_a_kind_that_was_activated_without_one(self) -> None:
        runtime = Runtime(Machine((X, replace(Z, cross=None, reserved={"cross": 1001}))))
        runtime.cycle()
        assert (runtime.outputs.axis[1].contribution[CROSS], runtime.outputs.axis[1].active[CROSS]) == (0.0, False)
        assert runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, max_points=1000))))) == {"Z": 110639}
        assert runtime.update(MACHINE) == {}
        weights = []
        for _ in range(12):
            runtime.cycle()
            weights.append(runtime.outputs.axis[1].contribution[CROSS] / 0.1)
        k = np.clip(np.arange(1, 13), 0, 10)
        assert weights == pytest.approx(np.sin(np.pi / 2 * k / 10) ** 2)

    @pytest.mark.parametrize("velocity", [0.0, 5.0])
    def test_an_automatic_table_that_comes_needs_no_command_and_no_standstill(self, velocity: float) -> None:
        runtime = Runtime(Machine((X, replace(Z, cross=None, reserved={"cross": 1001}))))
        runtime.inputs.axis[1].velocity = velocity
        for _ in range(3):
            runtime.cycle()
        runtime.update(MACHINE)
        weights = []
        for _ in range(12):
            runtime.cycle()
            weights.append(runtime.outputs.axis[1].contribution[CROSS] / 0.1)
        assert weights == pytest.approx(np.sin(np.pi / 2 * np.clip(np.arange(1, 13), 0, 10) / 10) ** 2)

    def test_a_manual_table_that_comes_waits_for_its_command(self) -> None:
        runtime = Runtime(Machine((X, replace(Z, cross=None, reserved={"cross": 1001}))))
        runtime.cycle()
        runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, manual_activation=True)))))
        active = []
        for k in range(9):
            runtime.inputs.axis[1].wanted[CROSS] = 1 if k > 5 else 0
            runtime.cycle()
            active.append(runtime.outputs.axis[1].active[CROSS])
        assert active == [False] * 6 + [True] * 3

    def test_a_table_that_was_commanded_off_comes_back_off(self) -> None:
        runtime = Runtime(MACHINE)
        runtime.cycle()
        runtime.inputs.axis[1].wanted[CROSS] = -1
        for _ in range(20):
            runtime.cycle()
        for new in (Machine((X, replace(Z, cross=None))), MACHINE):
            runtime.update(new)
            for _ in range(20):
                runtime.cycle()
            assert not runtime.outputs.axis[1].active[CROSS]
            assert runtime.outputs.axis[1].contribution[CROSS] == 0.0

    @pytest.mark.parametrize(("last", "column"), [(0.0, 0.25), (1.0, 0.25), (-1.0, -0.5)])
    @pytest.mark.parametrize("dropped", [False, True])
    def test_a_leadscrew_table_that_comes_acts_softly_for_the_direction_of_the_last_motion(
        self, last: float, column: float, dropped: bool
    ) -> None:
        screw = Leadscrew((0.0,), (-0.25,), (0.5,))
        with_table = Machine((Axis(1, "X", backlash_cycles=6, leadscrew=screw),))
        without = Machine((Axis(1, "X", backlash_cycles=6, reserved={"leadscrew": screw.max_points}),))
        runtime = Runtime(with_table if dropped else without)
        runtime.cycle()
        runtime.update(without)
        for setpoint in (7.0 * last, *[8.0 * last] * 8):
            runtime.inputs.axis[0].setpoint = setpoint
            runtime.cycle()
        runtime.update(with_table)
        for k in range(1, 11):
            runtime.cycle()
            come = math.sin(math.pi / 2 * min(k / 6, 1.0)) ** 2
            assert runtime.outputs.axis[0].active[LEADSCREW]
            assert runtime.outputs.axis[0].contribution[LEADSCREW] == pytest.approx(come * column, abs=1e-15)

    def test_a_leadscrew_that_gets_another_input_moves_nothing_at_once(self) -> None:
        """P-COMP-00057 changes: Δ is taken at the setpoint alone, 10 instead of 10.5; 0.1 a mm for 6 cycles."""
        screw = Leadscrew((0.0, 100.0), (0.0, 10.0), (1.0, 11.0), without_other_compensations=False)
        cross = Cross(2, (0.0,), (0.5,))

        def machine(screw: Leadscrew) -> Machine:
            return Machine((Axis(1, "X", backlash_cycles=6, leadscrew=screw, cross=cross), Axis(2, "Y")))

        runtime = Runtime(machine(screw))
        runtime.inputs.axis[0].setpoint = 10.0
        for _ in range(3):
            runtime.cycle()
        assert runtime.outputs.axis[0].contribution[LEADSCREW] == -1.05
        runtime.update(machine(replace(screw, without_other_compensations=True)))
        for k in range(1, 11):
            runtime.cycle()
            rest = math.cos(math.pi / 2 * min(k / 6, 1.0)) ** 2
            assert runtime.outputs.axis[0].contribution[LEADSCREW] == pytest.approx(-1.0 - 0.05 * rest, abs=1e-14)

    def test_a_current_that_comes_back_has_nothing_waiting_from_before(self) -> None:
        with_table = Machine((Axis(1, "X", friction=Friction((0.0,), (1.0,), delay_cycles=3)),))
        runtime = Runtime(with_table)
        runtime.inputs.axis[0].velocity = 5.0
        currents = []
        for k in range(20):
            if k in (6, 10):
                runtime.update(with_table if k == 10 else Machine((Axis(1, "X"),)))
            runtime.cycle()
            currents.append(runtime.outputs.axis[0].contribution[FRICTION])
        assert currents == [0.0] * 3 + [1.0] * 3 + [0.0] * 7 + [1.0] * 7

    def test_what_runs_out_goes_on_when_a_later_update_is_refused(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 1)
        held = runtime.outputs.axis[1].contribution[CROSS]
        runtime.update(Machine((X, replace(Z, cross=None))))
        values = []
        for k in range(12):
            if k == 4:
                refused = replace(Z, cross=None, plane=replace(Z.plane, max_points=77))
                assert runtime.update(Machine((X, refused))) == {"Z": 110640}
            runtime.cycle()
            values.append(runtime.outputs.axis[1].contribution[CROSS])
        rest = np.sin(np.pi / 2 * np.clip(np.arange(9, -3, -1), 0, 10) / 10) ** 2
        assert values == pytest.approx(held * rest, abs=1e-15)

    def test_a_kind_that_was_not_activated_is_refused_even_after_other_updates(self) -> None:
        runtime = Runtime(Machine((X, replace(Z, cross=None))))
        runtime.update(Machine((replace(X, backlash_cycles=2), replace(Z, cross=None))))
        with pytest.raises(UpdateError, match="axis Z a compensation"):
            runtime.update(MACHINE)

    def test_new_values_of_leadscrew_and_backlash_come_in_over_the_backlash_cycles(self) -> None:
        old = Axis(1, "X", backlash_cycles=6, leadscrew=Leadscrew((0.0,), (-0.5,)), backlash=Backlash(0.25, 2))
        new = replace(old, leadscrew=Leadscrew((0.0,), (-0.75,)), backlash=Backlash(-0.125, 2))
        w = np.sin(np.pi / 2 * np.array([5, 4, 3, 2, 1, 0, 0]) / 6) ** 2
        for cycles, rest in ((6, w), (1, 0.0 * w), (0, 0.0 * w)):
            runtime = Runtime(Machine((replace(old, backlash_cycles=cycles),)))
            for k in range(10):
                runtime.inputs.axis[0].setpoint = float(k)
                runtime.cycle()
            assert runtime.outputs.axis[0].contribution[LEADSCREW : BACKLASH + 1] == [0.5, 0.25]
            runtime.update(Machine((replace(new, backlash_cycles=cycles),)))
            values = []
            for _ in range(7):
                runtime.cycle()
                values.append(runtime.outputs.axis[0].contribution[LEADSCREW : BACKLASH + 1])
            assert np.array(values)[:, 0] == pytest.approx(0.75 - 0.25 * rest, abs=1e-15)
            assert np.array(values)[:, 1] == pytest.approx(-0.125 + 0.375 * rest, abs=1e-15)

    def test_what_blends_in_while_more_comes_is_continuous(self) -> None:
        # values 0.1, then 0.3, then 0.2 while the second blend is under way
        def lists(value: float) -> Machine:
            return Machine((X, replace(Z, cross=Cross(1, (0.0,), (value,), 10))))

        runtime = Runtime(lists(0.1))
        runtime.cycle()
        values = []
        for k in range(20):
            if k in (0, 4):
                runtime.update(lists(0.3 if k == 0 else 0.2))
            runtime.cycle()
            values.append(runtime.outputs.axis[1].contribution[CROSS])

        def w(step: int) -> float:
            return float(np.sin(np.pi / 2 * max(step, 0) / 10) ** 2)

        first = [0.3 - 0.2 * w(9 - k) for k in range(4)]
        second = [0.2 + (first[-1] - 0.2) * w(9 - k) for k in range(16)]
        assert values == pytest.approx(first + second, abs=1e-15)

    def test_an_update_in_motion_blends_the_difference_where_the_axis_is(self) -> None:
        # the master moves on while the old slope of 1 becomes one of 2
        def lists(slope: float) -> Machine:
            return Machine((X, replace(Z, cross=Cross(1, (0.0, 50.0), (0.0, 50.0 * slope), 10))))

        runtime = Runtime(lists(1.0))
        values = []
        for k in range(25):
            runtime.inputs.axis[0].setpoint = float(k)
            if k == 8:
                runtime.update(lists(2.0))
            runtime.cycle()
            values.append(runtime.outputs.axis[1].contribution[CROSS])
        k = np.arange(8, 25)
        rest = np.sin(np.pi / 2 * np.clip(17 - k, 0, 10) / 10) ** 2
        assert values == pytest.approx([*range(8), *(2.0 * k - 7.0 * rest)], abs=1e-12)

    def test_a_release_of_a_shift_that_is_under_way_stays_where_it_is(self) -> None:
        lists = Machine((X, replace(Z, backlash_cycles=20)))
        runtime = Runtime(lists)
        axis = runtime.inputs.axis[1]
        axis.no_move = True
        runtime.cycle()
        axis.wanted[CROSS] = -1
        runtime.cycle()
        for k in range(6):
            axis.setpoint = 1.0 + k
            runtime.cycle()
        w = np.sin(np.pi / 2 * np.arange(21) / 20) ** 2
        assert runtime.outputs.axis[1].setpoint_shift == pytest.approx(0.1 * w[14])
        runtime.update(Machine((X, Z)))  # whose longest transition takes 10 cycles: 14 of 20 steps are 7 of 10
        shifts = []
        for _ in range(9):
            runtime.cycle()
            shifts.append(runtime.outputs.axis[1].setpoint_shift)
        new = np.sin(np.pi / 2 * np.clip(np.arange(6, -3, -1), 0, 10) / 10) ** 2
        assert shifts == pytest.approx(0.1 * new, abs=1e-15)

    @pytest.mark.parametrize("cycles", [3, 7, 20])
    def test_a_release_that_finds_no_step_of_its_weight_does_not_jump(self, cycles: int) -> None:
        runtime = Runtime(MACHINE)
        axis = runtime.inputs.axis[1]
        axis.no_move = True
        runtime.cycle()
        axis.wanted[CROSS] = -1
        runtime.cycle()
        axis.setpoint = 1.0
        for _ in range(4):
            runtime.cycle()
        slower = replace(Z, cross=None, plane=None, crosstalk=None, backlash_cycles=cycles)
        at = runtime.outputs.axis[1].setpoint_shift
        runtime.update(Machine((X, slower)))
        shifts = [at]
        for _ in range(cycles + 1):
            runtime.cycle()
            shifts.append(runtime.outputs.axis[1].setpoint_shift)
        step = max(np.diff(np.sin(np.pi / 2 * np.arange(cycles + 1) / cycles) ** 2))
        assert (np.diff(shifts) <= 0.0).all()
        assert np.abs(np.diff(shifts)).max() <= 1.3 * 0.1 * step
        assert shifts[-1] == 0.0

    def test_a_temperature_table_that_is_moved_blends_in(self) -> None:
        old = Axis(1, "X", temperature=Temperature(0.0, 0.1, 1e-3, 4))
        runtime = Runtime(Machine((old,)))
        runtime.inputs.axis[0].setpoint = 50.0
        runtime.cycle()
        runtime.update(Machine((replace(old, temperature=Temperature(100.0, 0.1, 1e-3, 4)),)))
        values = []
        for _ in range(5):
            runtime.cycle()
            values.append(runtime.outputs.axis[0].contribution[TEMPERATURE])
        w = np.sin(np.pi / 2 * np.array([3, 2, 1, 0, 0]) / 4) ** 2
        assert values == pytest.approx(0.05 + 0.1 * w, abs=1e-15)

    def test_a_machine_that_cannot_run_is_refused_as_a_whole(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 30)
        before = runtime.save()
        with pytest.raises(CompileError, match="ascend"):
            runtime.update(Machine((X, replace(Z, cross=Cross(1, (1.0, 1.0), (0.0, 0.0))))))
        assert runtime.save() == before

    @pytest.mark.parametrize(("points", "refused"), [(10201, {}), (10200, {"Z": 110640}), (10202, {"Z": 110640})])
    def test_a_plane_without_max_points_has_room_for_101_by_101(self, points: int, refused: dict[str, int]) -> None:
        """The default of kw.crosscomp2.max_points: naming it changes nothing, another number is another table."""
        runtime = Runtime(MACHINE)
        assert runtime.update(Machine((X, replace(Z, plane=replace(Z.plane, max_points=points))))) == refused

    def test_a_held_axis_holds_its_outputs_over_an_update(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 30)
        before = copy.deepcopy(runtime.outputs.axis[1])
        runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=3)))))
        runtime.inputs.axis[1].setpoint = float("nan")
        runtime.cycle()
        assert replace(runtime.outputs.axis[1], error=0) == before


class TestNotices:
    GRID = tuple(CrosstalkTest(p1, p2, 0.01, 0.01, 0.01, 0.01) for p2 in (0.0, 10.0) for p1 in (0.0, 10.0))

    def runtime(self) -> Runtime:
        """Return X, and two axes whose crosstalk is adapted to X and Y within 0 … 10 mm."""
        crosstalk = Crosstalk(1, 1e3, -1e3, 3, self.GRID, 1, 2)
        return Runtime(Machine((X, Axis(2, "Y", crosstalk=crosstalk), Axis(3, "Z", crosstalk=crosstalk))))

    def test_who_has_left_the_tests_is_told_once(self) -> None:
        runtime = self.runtime()
        runtime.cycle()
        assert list(runtime.notices()) == []
        runtime.inputs.axis[0].setpoint = 10.5
        runtime.cycle()
        first = list(runtime.notices())
        assert [notice.split(":")[0] for notice in first] == ["axis Y", "axis Z"]
        assert all("have left the tests' positions" in notice for notice in first)
        for setpoint in (10.5, 5.0, 11.0):
            runtime.inputs.axis[0].setpoint = setpoint
            runtime.cycle()
            assert list(runtime.notices()) == []


def test_an_empty_machine_runs() -> None:
    runtime = Runtime(Machine())
    runtime.begin()
    runtime.advance(1.0)
    assert (runtime.cycles, runtime.outputs.axis) == (1000, [])
    runtime.restore(runtime.save())
