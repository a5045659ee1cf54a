"""Plane compensation: bilinear over two masters, clamped to the grid, added to the slave."""

import numpy as np
import pytest
from driving import drive, to_and_fro
from hypothesis import given, settings, strategies as st
from scipy.interpolate import RegularGridInterpolator

from axcomp.kinds import Plane
from axcomp.model import Axis, Machine


def machine(corrections: np.ndarray, start: tuple[float, float], interval: tuple[float, float], **options) -> Machine:
    rows = tuple(map(tuple, corrections.tolist()))
    plane = Plane(1, 2, *start, *interval, rows, **options)
    return Machine((Axis(1, "X"), Axis(2, "Y"), Axis(3, "Z", plane=plane)))


def scipy_values(corrections, start, interval, x, y) -> np.ndarray:
    """``corrections[j][i]``: j along the second master; outside, either coordinate is clamped to the grid."""
    grid1 = start[0] + interval[0] * np.arange(corrections.shape[1])
    grid2 = start[1] + interval[1] * np.arange(corrections.shape[0])
    interpolate = RegularGridInterpolator((grid2, grid1), corrections)
    return interpolate(np.stack([np.clip(y, grid2[0], grid2[-1]), np.clip(x, grid1[0], grid1[-1])], axis=-1))


@settings(max_examples=15, deadline=None)
@given(st.integers(2, 7), st.integers(2, 7), st.integers(0, 2**32 - 1))
def test_the_correction_is_scipys_bilinear_interpolation(points1: int, points2: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    corrections = rng.uniform(-0.1, 0.1, (points2, points1))
    start, interval = rng.uniform(-100, 100, 2).tolist(), rng.uniform(0.5, 30, 2).tolist()
    lists = machine(corrections, start, interval)
    x = start[0] + interval[0] * rng.uniform(-2, points1 + 1, 60)
    y = start[1] + interval[1] * rng.uniform(-2, points2 + 1, 60)
    run = drive(lists, {"X.setpoint": x, "Y.setpoint": y, "Z.setpoint": 5.0})
    expected = scipy_values(corrections, start, interval, x, y)
    assert run["Z.plane_correction"] == pytest.approx(expected, abs=1e-12)
    assert run["Z.corrected_setpoint"] == pytest.approx(5.0 + expected, abs=1e-12)


def test_every_grid_point_has_the_value_of_the_table(rng: np.random.Generator) -> None:
    corrections = rng.uniform(-0.1, 0.1, (4, 6))  # intervals that are powers of 2: grid coordinates are exact
    lists = machine(corrections, (-3.0, 8.0), (0.5, 4.0))
    j, i = np.indices(corrections.shape)
    run = drive(lists, {"X.setpoint": -3.0 + 0.5 * i.ravel(), "Y.setpoint": 8.0 + 4.0 * j.ravel()})
    assert run["Z.plane_correction"] == pytest.approx(corrections.ravel(), abs=1e-16)


def test_the_first_index_belongs_to_the_second_master() -> None:
    lists = machine(np.array([[0.0, 1.0], [10.0, 11.0]]), (0.0, 0.0), (1.0, 1.0))
    run = drive(lists, {"X.setpoint": [0.0, 1.0, 0.0, 1.0, 0.5], "Y.setpoint": [0.0, 0.0, 1.0, 1.0, 0.5]})
    assert run["Z.plane_correction"].tolist() == [0.0, 1.0, 10.0, 11.0, 5.5]


def test_the_example_of_the_manual() -> None:
    # interval 10 mm for both, from −40 and −70 mm, 101 × 101 points; [0][0 … 7] and [100][90 … 100] are given
    corrections = np.zeros((101, 101))
    corrections[0, :8] = np.array([-3, -1, 4, 9, 13, 17, 42, 53]) * 1e-4
    corrections[100, 90:] = np.array([82, 77, 68, 63, 61, 59, 57, 52, 56, 58, 49]) * 1e-4
    lists = machine(corrections, (-40.0, -70.0), (10.0, 10.0), n_cycles=10)
    run = drive(
        lists, {"X.setpoint": [-40, -35, 30, -90, 860, 960, 5000], "Y.setpoint": [-70, -70, -70, -80, 930, 930, 930]}
    )
    expected = [-3e-4, -2e-4, 53e-4, -3e-4, 82e-4, 49e-4, 49e-4]
    assert run["Z.plane_correction"] == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (5, 1)])
def test_one_row_or_one_column_is_a_curve(shape: tuple[int, int], rng: np.random.Generator) -> None:
    corrections = rng.uniform(-0.1, 0.1, shape)
    x, y = rng.uniform(-4.0, 14.0, (2, 80))
    run = drive(machine(corrections, (0.0, 0.0), (2.0, 2.0)), {"X.setpoint": x, "Y.setpoint": y})
    along = y if shape[0] > 1 else x
    expected = np.interp(along, 2.0 * np.arange(corrections.size), corrections.ravel())
    assert run["Z.plane_correction"] == pytest.approx(expected, abs=1e-15)


def test_far_outside_the_corner_is_held() -> None:
    lists = machine(np.array([[1.0, 2.0], [3.0, 4.0]]), (0.0, 0.0), (1e-9, 1e-9))
    run = drive(lists, {"X.setpoint": [-9e14, 9e14, 9e14], "Y.setpoint": [-9e14, -9e14, 9e14]})
    assert run["Z.plane_correction"].tolist() == [1.0, 2.0, 4.0]


def test_both_masters_and_the_slave_must_be_referenced() -> None:
    flags = np.array([[a, b, c] for a in (1, 0) for b in (1, 0) for c in (1, 0)], bool).T
    run = drive(
        machine(np.full((2, 2), 0.5), (0.0, 0.0), (1.0, 1.0)),
        {"X.referenced": flags[0], "Y.referenced": flags[1], "Z.referenced": flags[2]},
    )
    assert run["Z.plane_correction"].tolist() == [0.5] + [0.0] * 7


def test_it_is_continuous_over_the_edges_of_the_cells(rng: np.random.Generator) -> None:
    corrections = rng.uniform(-1.0, 1.0, (5, 5))
    x, y = to_and_fro(400, rng, -2.0, 8.0), to_and_fro(400, rng, -2.0, 8.0)
    run = drive(machine(corrections, (0.0, 0.0), (1.5, 1.5)), {"X.setpoint": x, "Y.setpoint": y})
    slope = 2.0 / 1.5  # two values differ by at most 2 over one interval
    steps = slope * (np.abs(np.diff(x)) + np.abs(np.diff(y)))
    assert (np.abs(np.diff(run["Z.plane_correction"])) <= steps + 1e-12).all()
