"""Dynamics and seams against figures computed by hand."""

import numpy as np
import pytest
from judging import codes, cross_machine, judge, leadscrew_machine, plane_machine, said, table_of_c

from axcomp.analysis.judgement import Demand, dynamics_of, ramp_rates, seam_of
from axcomp.engine import Engine
from axcomp.kinds import Cross, tables_of
from axcomp.model import Axis, AxisType, Machine, ModuloRange

FEED = Demand({"": 500.0})


def test_slopes_kinks_and_curvatures_of_a_leadscrew_table_by_hand() -> None:
    # Added: 0, −4, +2 µm at 0, 10, 40 mm. Slopes −0.4 and +0.2 µm/mm; kinks 0.4, 0.6, 0.2; curvature 0.6 over 20 mm.
    [result] = dynamics_of(leadscrew_machine((0.0, 10.0, 40.0), (0.0, 0.004, -0.002)), FEED)
    assert result.slopes == pytest.approx([-4e-4, 2e-4])
    assert result.kinks == pytest.approx([4e-4, 6e-4, 2e-4])
    assert result.kinks_at.tolist() == [0.0, 10.0, 40.0]
    assert result.added_velocity == pytest.approx(0.2)
    assert result.added_acceleration == pytest.approx(300.0)
    assert result.smooth_acceleration == pytest.approx(7.5)


def test_the_engine_shows_the_velocity_and_the_acceleration_that_were_computed() -> None:
    machine = leadscrew_machine((0.0, 10.0, 40.0), (0.0, 0.004, -0.002))
    [result] = dynamics_of(machine, FEED)
    position = np.arange(-20.0, 60.0, 0.5)
    added = Engine(machine).run({"X.setpoint": position})["X.leadscrew.correction"]
    velocity = np.diff(added) / 1e-3
    assert np.abs(velocity).max() == pytest.approx(result.added_velocity)
    assert np.abs(np.diff(velocity)).max() / 1e-3 == pytest.approx(result.added_acceleration)


def test_both_directions_count_and_a_reversal_is_their_difference() -> None:
    machine = leadscrew_machine((0.0, 10.0), (0.0, 0.001), negative=(0.0, 0.003))
    [result] = dynamics_of(machine, FEED)
    assert np.abs(result.slopes).tolist() == pytest.approx([3e-4])
    assert result.reversal.size == pytest.approx(0.002)
    assert result.reversal.velocity == pytest.approx(2.0)
    assert result.reversal.acceleration == pytest.approx(2000.0)


def test_a_table_that_repeats_has_a_kink_at_its_seam() -> None:
    # Added 0, −1, −2, −1 m° every 90°: −1/90, −1/90, 1/90, 1/90 and so on.
    [result] = dynamics_of(table_of_c((0, 90, 180, 270), (0.0, 0.001, 0.002, 0.001)), Demand({"C": 90.0}))
    assert result.kinks == pytest.approx(np.array([0.0, 2.0, 0.0, 2.0]) * 1e-3 / 90.0)
    assert result.kinks_at.tolist() == [90.0, 180.0, 270.0, 360.0]
    assert result.added_velocity == pytest.approx(0.001)


def test_a_plane_is_judged_along_either_master() -> None:
    # 10 µm over 10 mm along Y, 4 µm over 20 mm along Z.
    along_y, along_z = dynamics_of(plane_machine([[0.0, 0.01], [0.004, 0.0]]), Demand({"Y": 100.0, "Z": 50.0}))
    assert along_y.added_velocity == pytest.approx(0.1)
    assert along_z.added_velocity == pytest.approx(0.01 / 20.0 * 50.0)


@pytest.mark.parametrize(("cycles", "expected"), [(0, (1.0, 1.0)), (1, (1.0, 1.0)), (2, (0.5, 0.5))])
def test_switching_rates_by_hand(cycles: int, expected: tuple[float, float]) -> None:
    assert ramp_rates(cycles) == pytest.approx(expected)


def test_switching_rates_approach_those_of_the_sine() -> None:
    velocity, acceleration = ramp_rates(2000)
    assert velocity * 2000 == pytest.approx(np.pi / 2, rel=1e-5)
    assert acceleration * 2000**2 == pytest.approx(np.pi**2 / 2, rel=1e-5)


def test_switching_moves_the_axis_as_fast_as_the_engine_does() -> None:
    machine = cross_machine((0.0, 100.0), (0.02, 0.02), n_cycles=10, manual_activation=True)
    [result] = dynamics_of(machine, FEED)
    switch = np.where(np.arange(40) > 5, 1, -1)
    added = Engine(machine).run({"X.cross.switch": switch, "Y.setpoint": np.zeros(40)})["X.cross.correction"]
    assert added[-1] == pytest.approx(0.02)
    assert np.abs(np.diff(added)).max() / 1e-3 == pytest.approx(result.jump.velocity)
    assert np.abs(np.diff(added, 2)).max() / 1e-6 == pytest.approx(result.jump.acceleration)


def test_what_is_beyond_the_limits_is_a_warning_with_the_figures() -> None:
    machine = leadscrew_machine((0.0, 10.0, 40.0), (0.0, 0.004, -0.002))
    judgement = judge(machine, demand=Demand({"": 500.0}, {"X": 500.1}, {"": 299.0}))
    assert "adds 0.2 mm/s to the 500 mm/s of X: that is above its 500.1 mm/s" in said(
        judgement, "AXC-DYNAMICS-VELOCITY"
    )
    assert "kink at 10 mm" in said(judgement, "AXC-DYNAMICS-KINK")
    assert "300 mm/s² within a cycle, above its 299 mm/s²" in said(judgement, "AXC-DYNAMICS-KINK")
    assert "up to 4.0 µm at once: 4000 mm/s², above its 299 mm/s²" in said(judgement, "AXC-DYNAMICS-JUMP")
    assert codes(machine, demand=Demand({"": 500.0}, {"": 500.3}, {"": 4001.0})) == ["AXC-DYNAMICS"]
    assert codes(machine) == []


def test_the_picture_has_a_scale_for_the_added_velocity() -> None:
    [result] = dynamics_of(leadscrew_machine((0.0, 10.0, 40.0), (0.0, 0.004, -0.002)), FEED)
    ax = result.plot()
    assert ax.get_ylabel() == "slope [µm/mm]"
    assert [child.get_ylabel() for child in ax.child_axes] == ["added velocity at 500 mm/s [mm/s]"]


def test_the_gap_of_a_modulo_table_by_hand() -> None:
    # From −2 m° at 330° to 0 at 360°: 2 m° over 30°; elsewhere at most 2 m° over 330°.
    machine = table_of_c((0.0, 330.0), (0.0, 0.002))
    [tables] = tables_of(machine)
    [curve] = tables.curves
    seam = seam_of(curve, machine.axis("C").modulo)
    assert seam is not None
    assert (seam.at, seam.gap) == (330.0, 30.0)
    assert seam.change == pytest.approx(0.002)
    assert seam.ratio == pytest.approx(11.0)
    message = said(judge(machine), "AXC-SEAM")
    assert "changes by +7.2 ″ over 30 ° to the first one, 11.0 times as steep" in message


def test_a_seam_like_the_rest_of_the_table_is_not_flagged() -> None:
    x = np.arange(0.0, 360.0, 30.0)
    assert codes(table_of_c(x, 0.01 * np.sin(np.radians(x)))) == []


@pytest.mark.parametrize(("end", "expected"), [(0.0, []), (0.004, ["AXC-SEAM"])])
def test_a_full_turn_must_end_where_it_began(end: float, expected: list[str]) -> None:
    machine = table_of_c((0.0, 180.0, 360.0), (0.0, 0.002, end))
    assert codes(machine) == expected
    if expected:
        assert "steps by +14.4 ″ where C begins again at 360 °" in said(judge(machine), "AXC-SEAM")


def test_a_table_without_modulo_steps_where_its_axis_begins_again() -> None:
    machine = table_of_c((10.0, 350.0), (0.001, 0.003), modulo=False)
    assert "steps by +7.2 ″" in said(judge(machine), "AXC-SEAM")
    cross = Machine(
        (Axis(1, "X", cross=Cross(2, (0.0, 180.0), (0.0, 0.01))), Axis(2, "C", AxisType.ROTARY, ModuloRange()))
    )
    assert "steps by -10.0 µm where C begins again" in said(judge(cross), "AXC-SEAM")
