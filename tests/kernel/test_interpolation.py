"""Curves, folding and the short way round, against NumPy."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

from axcomp.kernel import Curve, Lookup, curve_value, fold, nearest, zero

numbers = st.floats(-1e6, 1e6)


def curve_of(x: list[float], y: list[float]) -> tuple[list[float], Curve]:
    return [7.0, *x, *y, 7.0], Curve(len(x), 1, 1 + len(x))


# NumPy's own slopes overflow where points are closer than this
places = st.integers(-(10**9), 10**9).map(lambda i: i / 1000)


@given(st.lists(places, min_size=1, max_size=30, unique=True).map(sorted), st.data())
def test_a_curve_is_what_numpy_interpolates(x: list[float], data: st.DataObject) -> None:
    y = data.draw(st.lists(numbers, min_size=len(x), max_size=len(x)))
    pool, curve = curve_of(x, y)
    lookup = zero(Lookup)
    for at in data.draw(st.lists(st.sampled_from(x) | numbers, min_size=1, max_size=20)):
        assert curve_value(pool, curve, at, lookup) == pytest.approx(np.interp(at, x, y), rel=1e-9, abs=1e-6)


@given(st.lists(numbers, min_size=1, max_size=30, unique=True).map(sorted), st.data())
def test_however_close_the_points_a_value_lies_between_its_neighbours(x: list[float], data: st.DataObject) -> None:
    y = data.draw(st.lists(numbers, min_size=len(x), max_size=len(x)))
    pool, curve = curve_of(x, y)
    for at in data.draw(st.lists(st.sampled_from(x) | numbers, min_size=1, max_size=20)):
        last = len(x) - 1
        i = min(max(int(np.searchsorted(x, at, side="right")) - 1, 0), last)
        near = (y[i], y[min(i + 1, last)])
        assert min(near) - 1e-9 <= curve_value(pool, curve, at, zero(Lookup)) <= max(near) + 1e-9


@given(st.lists(numbers, min_size=1, max_size=30, unique=True).map(sorted), st.data())
def test_a_curve_has_exactly_the_values_of_the_table_at_its_points(x: list[float], data: st.DataObject) -> None:
    y = data.draw(st.lists(numbers, min_size=len(x), max_size=len(x)))
    pool, curve = curve_of(x, y)
    lookup = zero(Lookup)
    for i in data.draw(st.permutations(range(len(x)))):
        assert curve_value(pool, curve, x[i], lookup) == y[i]


@given(st.data())
def test_where_the_last_search_ended_changes_no_value(data: st.DataObject) -> None:
    x = sorted(data.draw(st.lists(numbers, min_size=2, max_size=30, unique=True)))
    pool, curve = curve_of(x, [math.sin(i) for i in range(len(x))])
    wandering = zero(Lookup)
    for at in data.draw(st.lists(numbers | st.sampled_from(x), max_size=40)):
        assert curve_value(pool, curve, at, wandering) == curve_value(pool, curve, at, zero(Lookup))


class Counted(list[float]):
    """A pool that counts what is read."""

    reads = 0

    def __getitem__(self, place: Any) -> Any:
        self.reads += 1
        return super().__getitem__(place)


def most_reads(x: list[float], course: Iterable[float]) -> int:
    """Return how many numbers a value on a course costs at most."""
    pool, curve = curve_of(x, x)
    counted, lookup, most = Counted(pool), zero(Lookup), 0
    for at in course:
        counted.reads = 0
        assert curve_value(counted, curve, at, lookup) == pytest.approx(at)
        most = max(most, counted.reads)
    return most


@pytest.mark.parametrize("points", [10, 1000, 100_000])
@pytest.mark.parametrize("travel", [0.25, 10.0, 333.3])
def test_a_long_table_costs_what_a_short_one_does_however_far_a_cycle_goes(points: int, travel: float) -> None:
    uneven = [1000.0 * (k + 0.4 * math.sin(k)) / points for k in range(points)]
    course = [450.0 + 440.0 * math.sin(travel / 440.0 * cycle) for cycle in range(300)]
    assert most_reads(uneven, course) <= 25


def test_no_search_takes_more_than_its_bound_however_uneven_the_table() -> None:
    x = [1.01**k for k in range(2000)]
    places = np.random.default_rng(1).uniform(1.0, x[-1], 300).tolist()
    assert most_reads(x, [*places, *x[::-97]]) <= 2 * math.log2(len(x)) + 20


def test_one_point_is_a_constant() -> None:
    pool, curve = curve_of([3.0], [0.25])
    assert [curve_value(pool, curve, x, zero(Lookup)) for x in (-1e15, 2.9, 3.0, 3.1, 1e15)] == [0.25] * 5


@given(st.floats(-1e9, 1e9), st.floats(-1e4, 1e4), st.floats(1e-3, 1e4))
def test_fold_is_the_remainder_in_one_range(x: float, start: float, length: float) -> None:
    folded = fold(x, start, length)
    rounding = 1e-15 * (abs(x) + abs(start) + length) * 4
    assert start - rounding <= folded < start + length
    turns = (x - folded) / length
    assert abs(turns - round(turns)) * length <= rounding


@given(st.floats(-1e4, 1e4), st.floats(1e-3, 1e4))
def test_fold_leaves_what_is_in_the_range(start: float, length: float) -> None:
    for x in np.linspace(start, start + length, 7, endpoint=False):
        if (x - start) / length < 1.0 and start <= x < start + length:
            assert fold(float(x), start, length) == x


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e4))
def test_nearest_is_the_ieee_remainder(change: float, length: float) -> None:
    short = nearest(change, length)
    expected = math.remainder(change, length)
    rounding = 4e-15 * (abs(change) + length)
    assert abs(short) <= length / 2 + rounding
    assert min(abs(short - expected), abs(abs(short - expected) - length)) <= rounding


def test_a_length_of_0_is_no_modulo_axis() -> None:
    assert nearest(-720.5, 0.0) == -720.5
