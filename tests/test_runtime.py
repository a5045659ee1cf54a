"""A machine in operation: the clock, snapshots, updates, and what two of them have in common: nothing."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import machines

from axcomp.compile import CompileError
from axcomp.machine import (
    Axis,
    Cross,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
    Friction,
    Leadscrew,
    Machine,
    Plane,
)
from axcomp.runtime import Runtime, SnapshotError, UpdateError

LINE = tuple(float(x) for x in range(-50, 51, 10))
X = Axis(
    1,
    "X",
    backlash_cycles=6,
    leadscrew=Leadscrew(LINE, tuple(0.01 * np.sin(LINE)), tuple(0.01 * np.cos(LINE))),
    friction=Friction((1.0, 100.0), (1.0, 3.0), 1.0, 0.01, 2, 4),
)
Z = Axis(
    3,
    "Z",
    cross=Cross(1, LINE, tuple(0.1 * np.cos(LINE)), 10),
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
        axis.cross_enable = (k // 40) % 2 == 0
        axis.no_move = (k // 60) % 2 == 0
        axis.leadscrew_enable = (k // 25) % 3 < 2


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
    def test_the_new_values_count_from_the_next_cycle_on(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 20)
        held = runtime.outputs.axis[1].cross_correction
        twice = replace(Z, cross=replace(Z.cross, corrections=tuple(2 * c for c in Z.cross.corrections)))
        assert runtime.update(Machine((X, twice))) == {}
        assert runtime.outputs.axis[1].cross_correction == held
        runtime.cycle()
        assert runtime.outputs.axis[1].cross_correction == pytest.approx(2 * held)

    def test_an_update_with_the_same_lists_changes_nothing(self) -> None:
        one, other = Runtime(MACHINE), Runtime(MACHINE)
        for k in range(0, 200, 8):  # in mid-ramp, in reversals, with a shift waiting
            assert run(one, k, k + 8) == run(other, k, k + 8)
            # a reversal that is under way is finished at once, so only update when none is
            if other.state.axis[0].leadscrew.reversal_step in (0, X.backlash_cycles):
                other.update(Machine((X, Z)))

    def test_shorter_tables_are_searched_from_the_front(self) -> None:
        long = Cross(1, tuple(float(i) for i in range(1000)), tuple(0.0 for _ in range(1000)))
        runtime = Runtime(Machine((Axis(1, "X"), Axis(3, "Z", cross=long))))
        runtime.inputs.axis[0].setpoint = 998.5
        runtime.cycle()
        runtime.update(Machine((Axis(1, "X"), Axis(3, "Z", cross=replace(long, positions=LINE, corrections=LINE)))))
        runtime.inputs.axis[0].setpoint = 5.0
        runtime.cycle()
        assert runtime.outputs.axis[1].cross_correction == 5.0

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
                    currents.append(runtime.outputs.axis[0].current)
                assert all(-1.0 <= current <= 1.0 for current in currents)

    def test_a_ramp_goes_on_with_its_new_length(self) -> None:
        runtime = Runtime(MACHINE)
        runtime.cycle()
        runtime.inputs.axis[1].cross_enable = False
        for _ in range(4):
            runtime.cycle()
        runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=3)))))
        weights = []
        for _ in range(4):
            runtime.cycle()
            weights.append(runtime.outputs.axis[1].cross_correction / (0.1 * np.cos(0.0)))
        assert weights == pytest.approx([0.75, 0.25, 0.0, 0.0])

    def test_what_is_on_stays_at_full_weight_and_switches_off_over_its_new_length(self) -> None:
        for cycles in (3, 20):
            runtime = Runtime(MACHINE)
            runtime.cycle()
            runtime.update(Machine((X, replace(Z, cross=replace(Z.cross, n_cycles=cycles)))))
            weights = []
            for k in range(cycles + 3):
                runtime.inputs.axis[1].cross_enable = k < 2
                runtime.cycle()
                weights.append(runtime.outputs.axis[1].cross_correction / (0.1 * np.cos(0.0)))
            k = np.clip(np.append([cycles, cycles], np.arange(cycles - 1, -2, -1)), 0, cycles)
            assert weights == pytest.approx(np.sin(np.pi / 2 * k / cycles) ** 2)

    def test_what_no_longer_exists_is_off_at_once_and_the_rest_is_as_it_was(self) -> None:
        runtime = Runtime(MACHINE)
        run(runtime, 0, 30)
        before = copy.deepcopy(runtime.outputs.axis[1])
        runtime.update(Machine((X, replace(Z, cross=None))))
        after = runtime.outputs.axis[1]
        assert (after.cross_correction, after.cross_active) == (0.0, False)
        assert (after.plane_correction, after.plane_active) == (before.plane_correction, True)
        runtime.cycle()
        assert after.correction == pytest.approx(after.plane_correction + after.crosstalk_correction)

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


def test_inputs_begin_referenced_and_enabled_where_activation_is_automatic() -> None:
    manual = replace(Z, plane=replace(Z.plane, manual_activation=True))
    inputs = Runtime(Machine((X, manual))).inputs
    flags = [
        (a.referenced, a.cross_enable, a.plane_enable, a.crosstalk_enable, a.leadscrew_enable, a.friction_enable)
        for a in inputs.axis
    ]
    assert flags == [(True, False, False, False, True, True), (True, True, False, True, False, False)]
    assert not any(a.fault or a.no_move for a in inputs.axis)
