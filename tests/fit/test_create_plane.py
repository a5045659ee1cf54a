"""Plane tables made from measurements over two masters."""

import dataclasses
from functools import partial

import numpy as np
import pytest
from creating import copied_lists, plant
from hypothesis import given, settings, strategies as st
from scipy.interpolate import RegularGridInterpolator

from axcomp.fit import LEFT_OUT, PREDICTED, CannotCreateError, Flatness, Options, TargetList, create
from axcomp.lists import read_machine
from axcomp.measurement import MeasurementError
from axcomp.plant import flatness

create_plane = partial(create, "plane")


def over_grid(targets1, targets2, deviations, runs=1, scatter=0.0):
    """Make a measurement of deviations (m2, m1) in µm."""
    random = np.random.default_rng(2)
    q1, q2 = (np.tile(q.ravel(), runs) for q in np.meshgrid(targets1, targets2))
    n = deviations.size
    noise = random.normal(0.0, scatter, runs * n)
    return Flatness(q1, q2, np.repeat(np.arange(1, runs + 1), n), np.tile(deviations.ravel(), runs) + noise)


def read_plane(creation):
    creation.write()
    return read_machine(creation.path, strict=True).machine.axes[0].plane


def by_scipy(plane, q1, q2):
    """Return a plane's corrections in µm at places."""
    rows, columns = np.shape(plane.corrections)
    points = (plane.start2 + plane.interval2 * np.arange(rows), plane.start1 + plane.interval1 * np.arange(columns))
    at = [np.clip(q, p[0], p[-1]) for q, p in zip((q2, q1), points, strict=True)]
    return RegularGridInterpolator(points, np.array(plane.corrections) * 1e3)(np.column_stack(at))


@pytest.fixture
def new_list(tmp_path):
    return TargetList(tmp_path / "new.lis", 3)


MASTERS = (1, 2)


def test_a_measured_grid_is_taken_as_it_stands(new_list):
    deviations = np.random.default_rng(1).uniform(-20.0, 20.0, (4, 6))
    measurement = over_grid(np.arange(0.0, 60.0, 10.0), np.arange(-30.0, 10.0, 10.0), deviations)
    plane = read_plane(create_plane(measurement, new_list, Options(masters=MASTERS)))
    assert (plane.master1, plane.master2) == MASTERS
    assert (plane.start1, plane.start2, plane.interval1, plane.interval2) == (0.0, -30.0, 10.0, 10.0)
    assert np.array(plane.corrections) * 1e3 == pytest.approx(-deviations, abs=0.0501)


@settings(deadline=None, max_examples=25)
@given(st.integers(3, 12), st.integers(3, 12), st.floats(0.1, 5.0), st.integers(0, 1000))
def test_thinning_never_exceeds_its_bound(tmp_path_factory, n1, n2, bound, seed):
    random = np.random.default_rng(seed)
    targets1, targets2 = np.linspace(0.0, 300.0, n1).round(4), np.linspace(-200.0, 0.0, n2).round(4)
    waves = [np.sin(t / random.uniform(20, 200) + random.uniform(0, 6)) for t in (targets1, targets2)]
    deviations = 15.0 * np.outer(waves[1], waves[0])
    measurement = over_grid(targets1, targets2, deviations)
    target = TargetList(tmp_path_factory.mktemp("p") / "new.lis", 3)
    creation = create_plane(measurement, target, Options(bound=bound, masters=MASTERS))
    left = measurement.deviations + by_scipy(read_plane(creation), measurement.positions1, measurement.positions2)
    assert np.abs(left).max() <= bound + 1e-9
    assert np.abs(left).max() == pytest.approx(creation.deviation, abs=1e-6)


def test_the_example_s_plane_is_found_again_with_fewer_points(tmp_path):
    lists = copied_lists(tmp_path / "m", plane=True)
    targets1, targets2 = np.linspace(-300.0, 300.0, 31), np.linspace(-400.0, 0.0, 21)
    deviations = np.array(flatness(plant(), "X", ("Y", "Z"), targets1.tolist(), targets2.tolist())) * 1e3
    target = TargetList(lists / "achskw1.lis")
    creation = create_plane(over_grid(targets1, targets2, deviations, runs=3, scatter=0.2), target, Options(bound=1.0))
    assert creation.points < 31 * 21 / 4
    assert creation.figures[PREDICTED]["rms"] < 0.5
    assert creation.figures[LEFT_OUT]["rms"] < 0.5
    q1, q2 = (q.ravel() for q in np.meshgrid(targets1, targets2))
    before = by_scipy(read_machine(lists).machine.axis("X").plane, q1, q2)
    creation.write()
    reading = read_machine(lists, strict=True)
    plane = reading.machine.axis("X").plane
    assert by_scipy(plane, q1, q2) == pytest.approx(before, abs=1.3)
    assert plane.n_cycles == 10
    assert dataclasses.replace(reading.machine.axis("X"), plane=None)


def test_the_controller_s_number_of_points_is_kept(new_list):
    targets = np.linspace(0.0, 100.0, 21)
    deviations = 10.0 * np.outer(np.sin(targets / 20.0), np.cos(targets / 9.0))
    measurement = over_grid(targets, targets, deviations)
    creation = create_plane(measurement, new_list, Options(max_points=50, masters=MASTERS))
    assert creation.points <= 50
    columns, rows = np.shape(creation.compensation.corrections)[::-1]
    assert columns > rows  # the faster wave gets more points
    with pytest.raises(CannotCreateError, match="room for 50"):
        create_plane(measurement, new_list, Options(bound=0.2, max_points=50, masters=MASTERS))


def test_what_a_compensation_left_is_put_on_top_of_it(tmp_path):
    lists = copied_lists(tmp_path / "m", plane=True)
    old = read_machine(lists).machine.axis("X").plane
    targets1, targets2 = np.linspace(-300.0, 300.0, 101), np.linspace(-400.0, 0.0, 101)
    residual = over_grid(targets1, targets2, np.full((101, 101), 2.0))
    new = create_plane(residual, TargetList(lists / "achskw1.lis"), Options(on_top=True)).compensation
    assert np.array(new.corrections) == pytest.approx(np.array(old.corrections) - 0.002, abs=1e-6)


def test_what_cannot_be_is_refused(tmp_path, new_list):
    targets = np.linspace(0.0, 30.0, 4)
    measurement = over_grid(targets, targets, np.zeros((4, 4)))
    with pytest.raises(CannotCreateError, match="which axes are the masters"):
        create_plane(measurement, new_list)
    holed = measurement.only(np.arange(16) != 6)
    with pytest.raises(CannotCreateError, match="1 of 16 are missing, the first at master1 = 20, master2 = 10"):
        create_plane(holed, new_list, Options(masters=MASTERS))
    with pytest.raises(CannotCreateError, match="two positions of each master"):
        create_plane(measurement.only(measurement.positions1 == 0.0), new_list, Options(masters=MASTERS))
    with pytest.raises(CannotCreateError, match="on top"):
        create_plane(measurement, new_list, Options(masters=MASTERS, on_top=True))
    file = tmp_path / "p.csv"
    file.write_text("master1,master2,deviation\n0,0,1\n0,1,a\n")
    with pytest.raises(MeasurementError, match=r"p.csv:3: “a” is no number"):
        Flatness.read(file)


def test_files_with_and_without_runs_are_read(tmp_path):
    file = tmp_path / "p.csv"
    file.write_text("run;master2 [°];master1;deviation [mm]\n2;10;-5,5;0,001\n")
    measurement = Flatness.read(file)
    assert (measurement.positions1, measurement.positions2, measurement.runs) == ([-5.5], [10.0], [2])
    assert measurement.deviations == pytest.approx([1.0])
    file.write_text("1 2 3\n")
    assert Flatness.read(file).runs.tolist() == [1]


def test_the_picture_is_a_map(new_list):
    targets = np.linspace(0.0, 100.0, 5)
    deviations = np.outer(targets, targets)
    ax = create_plane(over_grid(targets, targets, deviations), new_list, Options(bound=9.0, masters=MASTERS)).plot()
    assert "master 1" in ax.get_xlabel()
