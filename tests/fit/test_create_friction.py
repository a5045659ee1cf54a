"""Friction tables made from velocities and currents."""

from functools import partial

import numpy as np
import pytest
from creating import copied_lists, plant
from hypothesis import given, settings, strategies as st

from axcomp.fit import LEFT_OUT, MEASURED, PREDICTED, CannotCreateError, FrictionReadings, Options, TargetList, create
from axcomp.lists import read_machine
from axcomp.plant import friction_current

create_friction = partial(create, "friction")


def stribeck(v):
    return np.sign(v) * (900.0 + 300.0 * np.exp(-np.abs(v) / 3.0) + 2.0 * np.abs(v))


def readings(velocities, currents=None, runs=None):
    velocities = np.asarray(velocities, dtype=float)
    currents = stribeck(velocities) if currents is None else np.asarray(currents, dtype=float)
    return FrictionReadings(velocities, currents, np.ones(len(velocities), int) if runs is None else runs)


@pytest.fixture
def new_list(tmp_path):
    return TargetList(tmp_path / "new.lis", 1)


def read_friction(creation):
    creation.write()
    return read_machine(creation.path, strict=True).machine.axes[0].friction


LEVELS = np.geomspace(0.1, 400.0, 15)


def test_both_directions_count_alike_and_make_one_curve(new_list):
    velocities = np.concatenate([LEVELS, -LEVELS])
    creation = create_friction(readings(velocities, stribeck(velocities) + 30.0), new_list)
    table = read_friction(creation)
    assert table.velocities == pytest.approx(np.round(LEVELS, 3))
    assert table.currents == pytest.approx(stribeck(np.round(LEVELS, 3)), abs=0.6)
    assert any("constant current of 30" in note for note in creation.notes)


@pytest.mark.parametrize(("forwards", "backwards"), [(3, 1), (1, 4)])
def test_the_direction_with_more_readings_has_no_more_weight(new_list, forwards, backwards):
    """A constant current of 30 cancels between the directions however often each was measured."""
    velocities = np.concatenate([np.repeat(LEVELS, forwards), np.repeat(-LEVELS, backwards)])
    table = read_friction(create_friction(readings(velocities, stribeck(velocities) + 30.0), new_list))
    assert table.currents == pytest.approx(stribeck(np.round(LEVELS, 3)), abs=0.6)


@settings(deadline=None, max_examples=40)
@given(st.lists(st.floats(0.01, 500.0), min_size=1, max_size=60), st.floats(2.0, 300.0), st.integers(0, 99))
def test_thinning_never_exceeds_its_bound(tmp_path_factory, speeds, bound, seed):
    speeds = np.unique(np.round(speeds, 3))
    currents = stribeck(speeds) + np.random.default_rng(seed).normal(0.0, 30.0, len(speeds))
    target = TargetList(tmp_path_factory.mktemp("f") / "new.lis", 1)
    creation = create_friction(readings(speeds, currents), target, Options(bound=bound, max_points=60))
    table = read_friction(creation)
    levels = creation.to_dict()["levels"]
    off = np.abs(np.interp(levels["velocities"], table.velocities, table.currents) - levels["table"])
    assert off.max() <= bound + 1e-6
    assert off.max() == pytest.approx(creation.deviation, abs=1e-6)


def test_the_controller_s_twenty_points_are_kept(new_list):
    speeds = np.geomspace(0.1, 400.0, 60)
    assert create_friction(readings(speeds), new_list).points <= 20
    with pytest.raises(CannotCreateError, match="room for 20"):
        create_friction(readings(speeds, 1000.0 + 500.0 * np.log(speeds) ** 2), new_list, Options(bound=5.0))


def test_the_factor_of_the_list_stays_and_the_table_is_divided_by_it(tmp_path):
    file = tmp_path / "f.lis"
    file.write_text("kopf.achs_nr 1\nfrict_comp.scaling_factor 500 # half\n")
    table = read_friction(create_friction(readings(LEVELS), TargetList(file)))
    assert table.scaling == 0.5
    assert np.array(table.currents) * 0.5 == pytest.approx(stribeck(np.array(table.velocities)), abs=0.6)
    assert "frict_comp.scaling_factor 500 # half" in file.read_text()
    file.write_text("kopf.achs_nr 1\nfrict_comp.scaling_factor 0\n")
    with pytest.raises(CannotCreateError, match="scaling_factor of the list is 0"):
        create_friction(readings(LEVELS), TargetList(file))


@pytest.mark.parametrize("factor", [2000, -2000])
def test_a_negative_factor_keeps_the_bound_as_a_positive_one_does(tmp_path, factor):
    """With the factor ±2 whole numbers of the list are 2 apart: half of that is lost by rounding."""
    file = tmp_path / "f.lis"
    file.write_text(f"kopf.achs_nr 1\nfrict_comp.scaling_factor {factor}\n")
    with pytest.raises(CannotCreateError, match=r"rounded to 2 drive unit, so 0\.9 drive unit cannot be kept"):
        create_friction(readings(LEVELS), TargetList(file), Options(bound=0.9))
    # The middle current is 2.2 off the line between its neighbours, 0.8 off the next even number.
    speeds, currents = np.array([1.0, 2.0, 3.0]), np.array([600.0, 603.2, 602.0])
    creation = create_friction(readings(speeds, currents), TargetList(file), Options(bound=1.5))
    table = read_friction(creation)
    assert table.scaling == factor / 1000.0
    off = np.abs(np.interp(speeds, table.velocities, table.currents) * table.scaling - currents)
    assert off.max() == pytest.approx(0.8)
    assert creation.deviation == pytest.approx(0.8)


def test_small_currents_keep_three_figures(new_list):
    table = read_friction(create_friction(readings(LEVELS, stribeck(LEVELS) * 1e-3), new_list))
    assert table.currents == pytest.approx(stribeck(LEVELS) * 1e-3, abs=0.0051)


def test_a_recording_becomes_levels_of_equal_ratio(new_list):
    random = np.random.default_rng(0)
    speeds = random.uniform(0.05, 400.0, 5000)
    velocities = speeds * random.choice([-1.0, 1.0], 5000)
    creation = create_friction(readings(velocities, stribeck(velocities) + random.normal(0, 20.0, 5000)), new_list)
    assert creation.points <= 20
    assert creation.figures[PREDICTED]["rms"] < 25.0
    assert creation.figures[MEASURED]["rms"] > 1000.0


def test_the_plant_s_friction_is_found_and_holds_for_runs_left_out(tmp_path):
    lists = copied_lists(tmp_path / "m")
    levels = np.array([0.5, 2.0, 6.0, 20.0, 100.0, 300.0])
    currents = np.array([friction_current(plant(), "X", v) for v in levels])
    runs = np.repeat([1, 2, 3], 6)
    noisy = np.tile(currents, 3) + np.random.default_rng(4).normal(0.0, 15.0, 18)
    creation = create_friction(readings(np.tile(levels, 3), noisy, runs), TargetList(lists / "achskw1.lis"))
    before = read_machine(lists).machine.axis("X").friction
    creation.write()
    after = read_machine(lists, strict=True).machine.axis("X").friction
    assert np.interp(levels, after.velocities, after.currents) == pytest.approx(
        np.interp(levels, before.velocities, before.currents), abs=40.0
    )
    assert after.position_delay == before.position_delay
    assert creation.figures[LEFT_OUT]["rms"] < 40.0
    assert any("One direction was measured" in note for note in creation.notes)


def test_standstill_does_not_count(new_list):
    creation = create_friction(readings([0.0, 1.0, 2.0]), new_list)
    assert "1 readings at standstill are left out." in creation.notes
    with pytest.raises(CannotCreateError, match="no reading in motion"):
        create_friction(readings([0.0, 0.0]), new_list)


def test_units_of_velocity_are_read(tmp_path):
    file = tmp_path / "f.csv"
    file.write_text("Torque,velocity [m/min],run\n12.5,-6,3\n")
    found = FrictionReadings.read(file)
    assert (found.velocities.tolist(), found.currents.tolist(), found.runs.tolist()) == ([-100.0], [12.5], [3])
