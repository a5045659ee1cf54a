from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rigid_bodies import machine_of, volumetric, with_constant_errors
from switched import VALUES, Bench, N, shifted, smooth

from axcomp.model import Axis, AxisType, ErrorTable, Machine, Volumetric

T = 1e-3  # s, the cycle


def limited(machine: Machine, **limits: float) -> Machine:
    """Return a machine whose axes X … have these s_limits."""
    axes = (replace(a, volumetric_limit=limits.get(a.name.lower(), a.volumetric_limit)) for a in machine.axes)
    return replace(machine, axes=tuple(axes))


def slowed(*compensations: Volumetric, velocity: float) -> Bench:
    """Return a machine with this v_limit for X, Y and Z, mm/s."""
    machine = machine_of(*compensations)
    axes = (replace(axis, volumetric_velocity=velocity if axis.number <= 3 else None) for axis in machine.axes)
    return Bench(machine=replace(machine, axes=tuple(axes)))


def test_the_limit_of_an_axis_counts_for_the_sum_of_all_compensations() -> None:
    def growing(index: int, error: str) -> Volumetric:
        table = ErrorTable(error, (0.0, -1.0), "X", ((0.0,), (100.0,)))
        return volumetric("CXYZ", errors=(table, ErrorTable("Z0Z", (0.1,))), index=index)

    bench = Bench(machine=limited(machine_of(growing(0, "EYX"), growing(2, "EYX")), y=0.5))
    offsets = []
    for x in [*range(30), *[30] * 30]:
        bench.inputs.axis[0].setpoint = float(x)
        offsets.append(bench.run()[0])
    # 2 · x/100 stays below 0.5 up to x = 25; then both are off, and Z runs down.
    assert [row[1] for row in offsets] == pytest.approx([min(x, 25) / 50 for x in range(60)])
    assert offsets[-1][2] == pytest.approx(0.0)
    assert bench.errors == [0, 912, 0, 0, 0, 0]
    assert bench.stops == [True, True, True, False, False, True]
    assert not bench.active(0)
    assert not bench.active(2)


def test_compensations_that_undo_each_other_are_within_the_limit() -> None:
    against = with_constant_errors(volumetric("CXYZ", index=1), {"Z0Z": 0.9})
    bench = Bench(machine=limited(machine_of(with_constant_errors(volumetric("CXYZ"), {"Z0Z": -0.8}), against), z=0.5))
    assert bench.run(3)[-1] == pytest.approx([0.0, 0.0, -0.1])
    assert bench.errors == [0] * 6


@pytest.mark.parametrize("faulty", [0, 5, 6, 7])
def test_an_axis_in_error_stops_all_others_that_take_part(faulty: int) -> None:
    machine = machine_of(shifted())
    slaves = (Axis(12, "X2", volumetric_limit=1.0, gantry_master=1), Axis(16, "C2", AxisType.ROTARY, gantry_master=6))
    bench = Bench(machine=replace(machine, axes=(*machine.axes, *slaves)))
    bench.run()
    bench.inputs.axis[faulty].fault = True
    bench.run()
    taking_part = [0, 1, 2, 5, 6, 7]
    assert bench.stops == [place in taking_part and place != faulty for place in range(8)]
    bench.inputs.axis[faulty].fault = False
    bench.inputs.reset = True
    bench.run()
    assert not any(bench.stops)


def test_a_lost_reference_stops_nobody() -> None:
    bench = Bench(shifted())
    bench.run()
    bench.inputs.axis[1].unreferenced = True
    bench.run(3)
    assert not any(bench.stops)


def test_a_switch_is_no_faster_than_v_limit() -> None:
    # Z goes 0.04 mm; with 20 cycles it would be as fast as 1.875 · 0.04 mm/20 ms = 3.75 mm/s.
    free, slow = Bench(shifted(manual_activation=True)), slowed(shifted(manual_activation=True), velocity=0.5)
    for bench, fastest, cycles in ((free, 3.75, N), (slow, 0.5, 150)):
        bench.run()
        bench.given[0].wanted = 1
        path = np.vstack([np.zeros(3), bench.run(200)])
        speeds = np.abs(np.diff(path, axis=0)) / T
        assert 0.98 * fastest <= speeds.max() <= fastest * (1 + 1e-9)
        assert path[cycles] == pytest.approx(VALUES)
        assert np.abs(path[cycles - 2] - VALUES).max() > 1e-9
        bench.given[0].wanted = -1
        path = np.vstack([VALUES, bench.run(200)])
        assert np.abs(np.diff(path, axis=0)).max() / T <= fastest * (1 + 1e-9)
        assert path[-1] == pytest.approx(np.zeros(3), abs=1e-15)


def test_v_limit_holds_while_a_shift_is_taken_back_along_the_switch() -> None:
    bench = slowed(shifted(), velocity=0.5)
    bench.run()
    bench.inputs.reset = True
    bench.run()
    bench.inputs.reset = False
    bench.given[0].wanted = -1
    bench.run()
    bench.set_factors(0.0, 0.0, 0.0)
    bench.given[0].wanted = 1
    path = np.vstack([VALUES, bench.run(400)])
    assert path[-1] == pytest.approx(np.zeros(3), abs=1e-15)
    assert np.abs(np.diff(path, axis=0)).max() / T <= 0.5 * (1 + 1e-9)


def test_without_motion_nothing_is_slow() -> None:
    bench = slowed(shifted(manual_activation=True), velocity=0.5)
    bench.run()
    bench.given[0].wanted, bench.given[0].no_move = 1, True
    assert not bench.run(3).any()
    assert bench.corrections == pytest.approx(VALUES)


def test_the_slower_of_gantry_master_and_slave_counts() -> None:
    machine = machine_of(shifted(manual_activation=True))
    slave = Axis(12, "Z2", volumetric_limit=1.0, volumetric_velocity=0.5, gantry_master=3)
    bench = Bench(machine=replace(machine, axes=(*machine.axes, slave)))
    bench.run()
    bench.given[0].wanted = 1
    assert np.abs(np.diff(bench.run(160), axis=0)).max() / T <= 0.5 * (1 + 1e-9)


def test_an_absorbed_value_outlasts_the_motion_in_which_an_error_came() -> None:
    bench = Bench(shifted())
    for axis in bench.inputs.axis[:3]:
        axis.velocity = 5.0
    bench.run()
    bench.inputs.reset = True
    bench.run()
    bench.inputs.reset = False
    assert bench.run(40) == pytest.approx(np.tile(VALUES, (40, 1)))
    for axis in bench.inputs.axis[:3]:
        axis.velocity = 0.0
    assert bench.run(5) == pytest.approx(np.tile(VALUES, (5, 1)))
    bench.inputs.axis[0].velocity = 5.0
    moved = bench.run(N)
    assert moved[:, 0] == pytest.approx(smooth(N - np.arange(1, N + 1)) * VALUES[0], abs=1e-15)
    assert moved[:, 1:] == pytest.approx(np.tile(VALUES[1:], (N, 1)))


def tilted(velocity: float = 0.0, **parameters: int) -> Bench:
    """Return a machine on which each mm of the tool is worth 1 µm in X."""
    machine = with_constant_errors(volumetric("XYZ", tool_orientation=(0.0, 0.0, -1.0), **parameters), {"EBZ": 1e-3})
    return slowed(machine, velocity=velocity) if velocity else Bench(machine)


def test_another_tool_length_runs_through_the_filter() -> None:
    bench = tilted()
    bench.inputs.tool_length = 100.0
    first = bench.run()[0, 0]
    assert first == pytest.approx(0.1, rel=1e-5)
    bench.inputs.tool_length = 300.0
    path = bench.run(N + 3)[:, 0]
    assert path == pytest.approx(first * (1.0 + 2.0 * smooth(np.arange(1, N + 4))), abs=1e-9)


def test_another_tool_length_midway_goes_on_from_where_it_is() -> None:
    bench = tilted()
    bench.run()
    bench.inputs.tool_length = 300.0
    before = bench.run(7)[:, 0]
    bench.inputs.tool_length = -50.0
    path = np.concatenate([before, bench.run(N + 1)[:, 0]])
    assert np.abs(np.diff(path)).max() <= 1.875 * 0.35 / N
    assert path[-1] == pytest.approx(-0.05, rel=1e-5)


def test_a_tool_length_is_taken_at_once_while_the_compensation_is_off() -> None:
    bench = tilted(filter_steps=0)
    bench.given[0].wanted = -1
    bench.run()
    bench.inputs.tool_length = 200.0
    bench.run()
    bench.given[0].wanted = 1
    assert bench.run()[0, 0] == pytest.approx(0.2, rel=1e-5)


def test_v_limit_holds_for_the_tool_length_too() -> None:
    bench = tilted(velocity=0.5)
    bench.run()
    bench.inputs.tool_length = 40.0
    path = np.concatenate([[0.0], bench.run(160)[:, 0]])
    assert 0.49 <= np.abs(np.diff(path)).max() / T <= 0.5 * (1 + 1e-6)
    assert path[-1] == pytest.approx(0.04, rel=1e-5)


@pytest.mark.parametrize("length", [float("nan"), float("inf"), -1.1e6, 1.1e6])
def test_a_tool_length_no_tool_has_is_an_error_and_the_last_one_holds(length: float) -> None:
    bench = tilted()
    bench.inputs.tool_length = 100.0
    expected = bench.run()
    bench.inputs.tool_length = length
    assert bench.run(3) == pytest.approx(np.tile(expected, (3, 1)))
    assert bench.errors == [901, 901, 901, 0, 0, 0]
    bench.inputs.tool_length = 100.0
    bench.run()
    assert bench.errors == [0] * 6
