"""Thinning against brute force over all choices of points, and its bound on any curves."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from axcomp.fit import closest, deviation, fewest


@st.composite
def curves(draw, most=9):
    """Draw ascending positions and one or two curves over them."""
    count = draw(st.integers(2, most))
    steps = draw(st.lists(st.floats(0.01, 50.0), min_size=count, max_size=count))
    values = st.lists(st.floats(-50.0, 50.0), min_size=count, max_size=count)
    return np.cumsum(steps), np.array([draw(values) for _ in range(draw(st.integers(1, 2)))])


def all_choices(count):
    """Yield all choices of points that have both ends."""
    for size in range(count - 1):
        for inner in combinations(range(1, count - 1), size):
            yield np.array([0, *inner, count - 1])


@settings(deadline=None, max_examples=80)
@given(curves(), st.floats(0.0, 30.0))
def test_no_choice_of_fewer_points_keeps_the_bound(measured, bound):
    positions, values = measured
    places = fewest(positions, values, bound)
    assert deviation(positions, values, places) <= bound + 1e-6
    fit = [c for c in all_choices(len(positions)) if deviation(positions, values, c) <= bound]
    assert len(places) <= min(map(len, fit))


@settings(deadline=None, max_examples=80)
@given(curves(), st.integers(2, 9))
def test_no_choice_of_as_many_points_deviates_less(measured, count):
    positions, values = measured
    places = closest(positions, values, count)
    assert len(places) <= count
    best = min(deviation(positions, values, c) for c in all_choices(len(positions)) if len(c) <= count)
    assert deviation(positions, values, places) <= best + 2e-4


def test_a_straight_line_needs_its_ends_only():
    positions = np.linspace(-500.0, 500.0, 1001)
    assert fewest(positions, (0.3 * positions + 4.0)[None, :], 0.0).tolist() == [0, 1000]


def test_a_bent_line_keeps_its_corners():
    positions = np.arange(0.0, 101.0)
    curve = np.interp(positions, [0.0, 30.0, 70.0, 100.0], [0.0, 5.0, -5.0, 2.0])
    assert fewest(positions, curve[None, :], 0.01).tolist() == [0, 30, 70, 100]


def test_a_parabola_loses_what_theory_says():
    """The chord of x² over h is h²/4 off in the middle: 11 points on [0, 1] lose 1/400."""
    positions = np.linspace(0.0, 1.0, 501)
    curve = (positions**2)[None, :]
    places = closest(positions, curve, 11)
    assert deviation(positions, curve, places) == pytest.approx(0.1**2 / 4, rel=1e-3)


def test_the_largest_table_is_thinned():
    positions = np.linspace(0.0, 1000.0, 1500)
    values = np.array([np.sin(positions / 30.0), np.cos(positions / 50.0)]) * 20.0
    places = closest(positions, values, 200)
    assert len(places) <= 200
    assert deviation(positions, values, places) < 0.2
