from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from rigid_bodies import machine_of, volumetric, with_constant_errors
from switched import SHIFTS, VALUES, Bench, N, doubled, shifted, smooth

from axcomp.model import Axis, AxisType, ErrorTable, Interpolation, Volumetric
from axcomp.runtime import SnapshotError, UpdateError


def test_an_automatic_compensation_begins_at_full_weight() -> None:
    bench = Bench(shifted())
    assert bench.run() == pytest.approx(VALUES[None])
    assert bench.active()


def test_a_manual_compensation_waits_for_its_command() -> None:
    bench = Bench(shifted(manual_activation=True))
    assert not bench.run(3).any()
    assert not bench.active()
    bench.given[0].wanted = 1
    assert bench.run(N + 5) == pytest.approx(smooth(np.arange(1, N + 6))[:, None] * VALUES, abs=1e-15)
    bench.given[0].wanted = -1
    assert bench.run(N + 5) == pytest.approx(smooth(N - np.arange(1, N + 6))[:, None] * VALUES, abs=1e-15)
    assert not bench.active()


def test_a_change_of_mind_midway_turns_round_where_it_is() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.given[0].wanted = -1
    bench.run(7)
    bench.given[0].wanted = 1
    assert bench.run(9) == pytest.approx(smooth(N - 7 + np.arange(1, 10))[:, None] * VALUES, abs=1e-15)


@pytest.mark.parametrize("filter_steps", [0, 1])
def test_without_filter_a_switch_is_immediate(filter_steps: int) -> None:
    bench = Bench(shifted(manual_activation=True, filter_steps=filter_steps))
    bench.run()
    bench.given[0].wanted = 1
    assert bench.run() == pytest.approx(VALUES[None])
    bench.given[0].wanted = -1
    assert not bench.run().any()


def test_the_filter_does_not_touch_the_moving_value() -> None:
    table = ErrorTable("EXX", (0.0, 0.1), "X", ((0.0,), (100.0,)), Interpolation.GRID)
    bench = Bench(volumetric("XYZ", errors=(table,)))
    for x in (0.0, 50.0, 100.0):
        bench.inputs.axis[0].setpoint = x
        # The error is the one where the axis comes to: d = −(x + d)/1000.
        assert bench.run()[0, 0] == pytest.approx(-x / 1001, abs=1e-6)


def test_automatic_activation_waits_until_all_axes_are_referenced_and_free_of_error() -> None:
    bench = Bench(shifted())
    bench.inputs.axis[5].unreferenced = True
    bench.inputs.axis[2].fault = True
    assert not bench.run(3).any()
    bench.inputs.axis[5].unreferenced = False
    assert not bench.run(3).any()
    bench.inputs.axis[2].fault = False
    assert bench.run(N)[-1] == pytest.approx(VALUES)


def test_an_axis_that_does_not_take_part_does_not_matter() -> None:
    bench = Bench(shifted())
    bench.inputs.axis[3].unreferenced = True
    bench.inputs.axis[4].fault = True
    assert bench.run() == pytest.approx(VALUES[None])


def test_with_no_move_the_setpoint_stands_still_and_keeps_its_shift() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = 1, True
    assert not bench.run(5).any()
    assert bench.corrections == pytest.approx(VALUES)
    assert bench.shifts == pytest.approx(-VALUES)
    # With its next motion X reaches its place; Y and Z stand.
    bench.inputs.axis[0].velocity = 5.0
    moved = bench.run(N)
    assert moved[:, 0] == pytest.approx(smooth(np.arange(1, N + 1)) * VALUES[0], abs=1e-15)
    assert moved[:, 1:] == pytest.approx(np.zeros((N, 2)), abs=1e-15)
    bench.inputs.axis[0].velocity = 0.0
    bench.given[0].wanted = -1
    assert bench.run(3) == pytest.approx(np.tile([VALUES[0], 0.0, 0.0], (3, 1)), abs=1e-15)
    assert bench.corrections == [0.0] * 3
    # A switch with motion takes the shifts back too.
    bench.given[0].wanted, bench.given[0].no_move = 1, False
    assert bench.run(N + 2)[-1] == pytest.approx(VALUES)
    assert bench.shifts == [0.0] * 3


def test_a_shift_is_taken_back_along_the_next_switch() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = 1, True
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = -1, False
    found = bench.run(N + 2)
    assert found == pytest.approx(np.zeros((N + 2, 3)), abs=1e-15)
    assert bench.shifts == [0.0] * 3


def test_after_switching_off_with_no_move_the_offset_stays_until_the_next_switch() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = -1, True
    assert bench.run(40) == pytest.approx(np.tile(VALUES, (40, 1)))
    assert not bench.active()
    bench.given[0].wanted, bench.given[0].no_move = 1, False
    assert bench.run(N + 1) == pytest.approx(np.tile(VALUES, (N + 1, 1)))
    assert bench.shifts == [0.0] * 3


def test_reset_switches_off_without_motion_until_the_next_command() -> None:
    bench = Bench(shifted(), replace(shifted(), index=3))
    bench.run()
    bench.inputs.reset = True
    assert bench.run() == pytest.approx(2 * VALUES[None])
    bench.inputs.reset = False
    assert bench.run(40) == pytest.approx(np.tile(2 * VALUES, (40, 1)))
    assert not bench.active(0)
    assert not bench.active(3)
    bench.given[0].wanted = -1
    bench.run()
    bench.given[0].wanted = 1
    assert bench.run(40)[-1] == pytest.approx(2 * VALUES)
    assert bench.corrections == pytest.approx(VALUES)


def test_reset_in_mid_ramp_holds_the_output() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted = 1
    last = bench.run(9)[-1]
    bench.inputs.reset = True
    assert bench.run(5) == pytest.approx(np.tile(last, (5, 1)))


@pytest.mark.parametrize(("faulty", "absorbed"), [(0, [0]), (2, [2]), (5, [])])
def test_an_axis_in_error_keeps_its_value_and_the_others_run_down(faulty: int, absorbed: list[int]) -> None:
    bench = Bench(shifted())
    bench.run()
    bench.inputs.axis[faulty].fault = True
    expected = smooth(N - np.arange(1, N + 4))[:, None] * VALUES
    expected[:, absorbed] = VALUES[absorbed]
    assert bench.run(N + 3) == pytest.approx(expected, abs=1e-15)
    assert not bench.active()
    # It stays off when the error has gone, until the next command.
    bench.inputs.axis[faulty].fault = False
    assert bench.run(5) == pytest.approx(np.tile(expected[-1], (5, 1)), abs=1e-15)
    bench.given[0].wanted = -1
    bench.run()
    bench.given[0].wanted = 1
    assert bench.run(N)[-1] == pytest.approx(VALUES)
    assert bench.shifts == [0.0] * 3


def test_a_lost_reference_keeps_the_value_and_automatic_activation_comes_back_after_it() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.inputs.axis[1].unreferenced = True
    offsets = bench.run(5)
    assert offsets[:, 1] == pytest.approx([VALUES[1]] * 5)
    bench.inputs.axis[1].unreferenced = False
    # Y can only come back when X and Z have run down; nothing jumps on the way.
    offsets = np.vstack([offsets, bench.run(60)])
    assert offsets[-1] == pytest.approx(VALUES)
    assert np.abs(np.diff(offsets, axis=0)).max() < 0.1 * np.abs(VALUES).max()
    assert bench.shifts == [0.0] * 3


def test_a_manual_compensation_ends_with_a_reference() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted = 1
    bench.run(N)
    bench.inputs.axis[5].unreferenced = True
    assert bench.run(N)[-1] == pytest.approx([0.0] * 3)
    bench.inputs.axis[5].unreferenced = False
    assert not bench.run(N).any()
    assert bench.errors == [0] * 6


@pytest.mark.parametrize("manual", [False, True])
def test_program_end_does_not_concern_a_compensation_of_no_channel(manual: bool) -> None:
    bench = Bench(shifted(manual_activation=manual))
    bench.run()
    bench.given[0].wanted = 1
    bench.run(N)
    bench.inputs.program_end = True
    assert bench.run(30) == pytest.approx(np.tile(VALUES, (30, 1)))
    assert bench.errors == [0] * 6


@pytest.mark.parametrize("manual", [False, True])
def test_program_end_is_an_error_for_a_compensation_of_the_channel(manual: bool) -> None:
    bench = Bench(shifted(associate_to_channel=True, manual_activation=manual))
    bench.run()
    bench.given[0].wanted = 1
    bench.run(N)
    bench.inputs.program_end = True
    assert bench.run(30) == pytest.approx(np.tile(VALUES, (30, 1)))
    assert bench.errors == [914, 914, 914, 0, 0, 0]
    assert not bench.active()
    bench.inputs.program_end = False
    bench.inputs.reset = True
    bench.run()
    assert bench.errors == [0] * 6


def test_program_end_is_no_error_while_the_compensation_is_off() -> None:
    bench = Bench(shifted(associate_to_channel=True, manual_activation=True))
    bench.inputs.program_end = True
    bench.run(3)
    assert bench.errors == [0] * 6


def test_a_compensation_without_limits_cannot_be_switched_on() -> None:
    machine = machine_of(shifted())
    axes = (machine.axes[0], replace(machine.axes[1], volumetric_limit=None), *machine.axes[2:])
    bench = Bench(machine=replace(machine, axes=axes))
    assert not bench.run(3).any()
    assert bench.errors == [0, 911, 0, 0, 0, 0]
    assert not any(bench.stops)
    bench.inputs.reset = True
    bench.run()
    bench.inputs.reset = False
    assert bench.errors == [0] * 6
    bench.given[0].wanted = -1
    bench.run()
    bench.given[0].wanted = 1
    bench.run()
    assert bench.errors == [0, 911, 0, 0, 0, 0]


def growing(**parameters: Any) -> Volumetric:
    table = ErrorTable("EYX", (0.0, -1.0), "X", ((0.0,), (100.0,)), Interpolation.GRID)
    return volumetric("XYZ", errors=(table, ErrorTable("Z0Z", (0.3,))), **parameters)


def test_a_correction_above_its_limit_is_held_and_stops_the_axis() -> None:
    machine = machine_of(growing())
    axes = (machine.axes[0], replace(machine.axes[1], volumetric_limit=0.5), *machine.axes[2:])
    bench = Bench(machine=replace(machine, axes=axes))
    offsets = []
    for x in [*range(80), *[80] * 40]:
        bench.inputs.axis[0].setpoint = float(x)
        offsets.append(bench.run()[0])
    expected_y = [min(x, 50) / 100 for x in range(120)]
    assert [row[1] for row in offsets] == pytest.approx(expected_y)
    # Z runs down from the cycle after.
    expected_z = -0.3 * smooth(N - np.clip(np.arange(120) - 51, 0, N))
    assert [row[2] for row in offsets] == pytest.approx(expected_z)
    assert bench.errors == [0, 912, 0, 0, 0, 0]
    assert bench.stops == [True, True, True, False, False, False]
    assert not bench.active()
    assert bench.shifts == pytest.approx([0.0, 0.5, 0.0])
    bench.inputs.reset = True
    bench.run()
    assert bench.errors == [0] * 6
    assert not any(bench.stops)


def gantry(limit: float | None) -> Bench:
    machine = machine_of(growing())
    slave = Axis(12, "Y2", AxisType.TRANSLATORY, volumetric_limit=limit, gantry_master=2)
    return Bench(machine=replace(machine, axes=(*machine.axes, slave)))


def test_a_gantry_slave_gets_the_corrections_of_its_master() -> None:
    bench = gantry(1000.0)
    bench.inputs.axis[0].setpoint = 30.0
    bench.run()
    slave = bench.runtime.outputs.axis[6]
    assert (slave.volumetric_correction, slave.corrected_setpoint) == (bench.corrections[1], bench.corrections[1])
    assert bench.corrections[1] == pytest.approx(0.3)


def test_a_gantry_slave_needs_a_limit_and_the_limit_counts() -> None:
    bench = gantry(None)
    bench.run()
    assert bench.errors == [0, 0, 0, 0, 0, 0, 911]
    bench = gantry(0.25)
    bench.inputs.axis[0].setpoint = 20.0
    bench.run()
    bench.inputs.axis[0].setpoint = 30.0
    bench.run()
    assert bench.errors == [0, 0, 0, 0, 0, 0, 912]
    assert bench.stops == [True] * 3 + [False] * 3 + [True]
    assert bench.run()[0, 1] == pytest.approx(0.2)


def test_a_gantry_slave_in_error_takes_its_master_with_it() -> None:
    bench = gantry(1000.0)
    bench.inputs.axis[0].setpoint = 30.0
    bench.run()
    bench.inputs.axis[6].fault = True
    offsets = bench.run(N)
    assert offsets[:, 1] == pytest.approx([0.3] * N)
    assert offsets[-1, 2] == pytest.approx(0.0)


def test_factors_signs_and_zeros_apply_to_the_correction() -> None:
    bench = Bench(shifted(negate="X", set_to_zero="Y"))
    assert bench.run()[0] == pytest.approx([0.01, 0.0, 0.04])
    bench = Bench(shifted())
    bench.set_factors(0.5, 0.0, 7.0)
    assert bench.run()[0] == pytest.approx([-0.005, 0.0, 0.04])


def test_a_factor_counts_from_the_next_switch_on_and_never_jumps() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.set_factors(0.5, 0.5, 0.5)
    assert bench.run(3) == pytest.approx(np.tile(VALUES, (3, 1)))
    bench.given[0].wanted = -1
    offsets = bench.run(5)
    bench.given[0].wanted = 1
    offsets = np.vstack([offsets, bench.run(2 * N)])
    assert offsets[-1] == pytest.approx(0.5 * VALUES)
    assert np.abs(np.diff(offsets, axis=0)).max() < 0.1 * np.abs(VALUES).max()


def test_a_command_keeps_its_no_move_and_its_factors_until_it_can_be_obeyed() -> None:
    bench = Bench(shifted())
    bench.given[0].wanted = -1
    bench.inputs.axis[5].unreferenced = True
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = 1, True
    bench.set_factors(0.5, 0.5, 0.5)
    bench.run()
    bench.given[0].no_move = False
    bench.set_factors(1.0, 1.0, 1.0)
    bench.run(3)
    bench.inputs.axis[5].unreferenced = False
    assert bench.run(5) == pytest.approx(np.zeros((5, 3)), abs=1e-15)
    assert bench.corrections == pytest.approx(0.5 * VALUES)


def test_what_is_no_number_is_no_factor() -> None:
    bench = Bench(shifted())
    bench.set_factors(float("nan"), -1.0, 1.0)
    assert bench.run()[0] == pytest.approx([0.0, 0.0, 0.04])


def test_several_compensations_add_up_each_from_the_raw_setpoints() -> None:
    table = ErrorTable("EYX", (0.0, 1.0), "X", ((0.0,), (10.0,)), Interpolation.GRID)
    compensations = [volumetric("XYZ", errors=(table,), index=index) for index in range(5)]
    bench = Bench(*compensations)
    bench.inputs.axis[0].setpoint = 5.0
    assert bench.run()[0, 1] == pytest.approx(5 * -0.5)


@pytest.mark.parametrize("angle", [90.0, -90.0])
def test_where_two_linear_axes_become_parallel_the_compensation_switches_off(angle: float) -> None:
    errors = {"X0X": 0.01, "Y0Y": 0.02, "EAX": 1e-3}
    bench = Bench(with_constant_errors(volumetric("XCYZ"), errors))
    before = bench.run()
    assert before.any()
    bench.inputs.axis[5].setpoint = angle
    assert bench.run(3) == pytest.approx(np.tile(before, (3, 1)))
    assert bench.errors == [913, 913, 913, 0, 0, 0]
    assert not bench.active()


def test_directions_in_one_plane_are_singular_everywhere() -> None:
    machine = volumetric("XYZ", directions=((1.0, 0.0, 0.0),) * 2 + ((0.0, 0.0, 1.0),) * 4)
    bench = Bench(with_constant_errors(machine, SHIFTS))
    assert not bench.run(2).any()
    assert bench.errors[:3] == [913] * 3


def test_a_bad_setpoint_holds_its_axis_and_lets_the_others_go_on() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.inputs.axis[0].setpoint = float("nan")
    bench.inputs.axis[1].setpoint = 50.0
    bench.run()
    outputs = bench.runtime.outputs.axis
    assert outputs[0].corrected_setpoint == pytest.approx(VALUES[0])
    assert outputs[0].error == 901
    assert outputs[1].corrected_setpoint == pytest.approx(50.0 + VALUES[1])


@pytest.mark.parametrize("length", [float("nan"), float("inf"), -float("inf")])
def test_a_tool_length_that_is_no_number_is_not_taken(length: float) -> None:
    errors = {"EBZ": 1e-3}
    machine = with_constant_errors(volumetric("XYZ", tool_orientation=(0.0, 0.0, -1.0)), errors)
    bench = Bench(machine)
    bench.inputs.tool_length = 100.0
    expected = bench.run()[0, 0]
    assert expected == pytest.approx(0.1, rel=1e-3)
    bench.inputs.tool_length = length
    assert bench.run()[0, 0] == pytest.approx(expected)


def test_the_display_does_not_show_corrections_and_shifts() -> None:
    bench = Bench(shifted())
    bench.inputs.axis[0].actual_position = 7.0
    bench.run()
    assert bench.runtime.outputs.axis[0].display_position == pytest.approx(7.0 - VALUES[0])
    bench.given[0].wanted, bench.given[0].no_move = -1, True
    bench.run(3)
    assert bench.runtime.outputs.axis[0].display_position == pytest.approx(7.0 - VALUES[0])


def test_an_update_switches_off_without_motion_and_automatic_activation_comes_back() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.runtime.update(machine_of(doubled()))
    offsets = bench.run(N + 5)
    assert offsets[-1] == pytest.approx(2 * VALUES)
    assert offsets[:N] == pytest.approx(VALUES + smooth(np.arange(1, N + 1))[:, None] * VALUES)
    assert bench.shifts == [0.0] * 3


def test_an_update_of_a_manual_compensation_needs_a_new_command() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted = 1
    bench.run(N)
    bench.runtime.update(machine_of(shifted(manual_activation=True)))
    assert bench.run(N + 5) == pytest.approx(np.tile(VALUES, (N + 5, 1)))
    assert not bench.active()


def test_what_an_update_has_switched_off_is_not_active_before_the_next_cycle_either() -> None:
    bench = Bench(shifted(), shifted(index=1))
    bench.run()
    outputs = bench.runtime.outputs.volumetric
    assert [one.active for one in outputs] == [True, True]
    bench.runtime.update_volumetric(doubled(index=1))
    assert [one.active for one in outputs] == [True, False]
    bench.runtime.update(machine_of(doubled(), doubled(index=1)))
    assert [one.active for one in outputs] == [False, False]


def test_a_snapshot_from_before_an_update_of_one_compensation_is_refused() -> None:
    bench = Bench(shifted())
    bench.run()
    before = bench.runtime.save()
    bench.runtime.update_volumetric(doubled())
    bench.run(3)
    kept = repr((bench.runtime.state, bench.runtime.inputs, bench.runtime.outputs))
    with pytest.raises(SnapshotError, match="another machine"):
        bench.runtime.restore(before)
    assert repr((bench.runtime.state, bench.runtime.inputs, bench.runtime.outputs)) == kept


def test_a_snapshot_from_after_an_update_of_one_compensation_fits_a_machine_with_the_new_lists() -> None:
    bench, other = Bench(shifted()), Bench(doubled())
    bench.run()
    assert bench.runtime.save()
    bench.runtime.update_volumetric(doubled())
    bench.run(3)
    other.runtime.restore(bench.runtime.save())
    assert other.run(N).tolist() == bench.run(N).tolist()


def test_an_update_cannot_add_a_compensation() -> None:
    bench = Bench(shifted())
    with pytest.raises(UpdateError, match="volumetric"):
        bench.runtime.update(machine_of(shifted(), shifted(index=1)))


def test_a_saved_state_goes_on_with_the_same_bits() -> None:
    bench = Bench(shifted(manual_activation=True))
    bench.run()
    bench.given[0].wanted = 1
    bench.run(5)
    saved = bench.runtime.save()
    first = bench.run(N)
    bench.runtime.restore(saved)
    assert bench.run(N).tolist() == first.tolist()


def test_a_switch_that_commands_nothing_is_an_error_of_x_y_and_z() -> None:
    bench = Bench(shifted(filter_steps=0))
    bench.run()
    bench.given[0].wanted = 4
    bench.run()
    assert (bench.active(), bench.errors[:4]) == (True, [904, 904, 904, 0])
    bench.given[0].wanted = -1
    bench.run()
    assert not bench.active()


def test_a_switch_of_0_is_as_the_lists_say() -> None:
    for manual, switch in ((False, 0), (True, 0), (False, -3), (True, -3)):
        bench = Bench(shifted(filter_steps=0, manual_activation=manual))
        bench.given[0].wanted = switch
        bench.run()
        assert bench.active() != manual
