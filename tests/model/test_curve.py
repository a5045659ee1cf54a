"""Curves against NumPy and SciPy."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from scipy.interpolate import make_interp_spline

from axcomp.model import Curve, Quantity, shown

POSITION, CORRECTION = Quantity("position", "mm", "X"), Quantity("correction", "mm", "Y")
WHOLE = st.integers(-4000, 4000)


def curve(x, y, **more) -> Curve:
    return Curve(tuple(map(float, x)), tuple(map(float, y)), POSITION, CORRECTION, **more)


@st.composite
def curves(draw: st.DrawFn, period: float | None = None) -> Curve:
    least = 1 if period is None else 2
    places = WHOLE if period is None else st.integers(0, round(10 * period) - 1)
    x = sorted(draw(st.sets(places, min_size=least, max_size=12)))
    start = 0.0 if period is None else draw(st.sampled_from([-180.0, 0.0, 12.5]))
    y = draw(st.lists(WHOLE, min_size=len(x), max_size=len(x)))
    return curve([start + place / 10 for place in x], [value / 1e4 for value in y], period=period)


@given(curves(), st.lists(st.floats(-1e4, 1e4), max_size=20))
def test_a_curve_is_straight_between_its_points_and_held_outside(one, places) -> None:
    assert np.allclose(one.at([*places, *one.x]), np.interp([*places, *one.x], one.x, one.y), atol=1e-15)
    assert [one.at(place) for place in places] == one.at(np.array(places))


@given(curves(360.0), st.lists(st.floats(-2000.0, 2000.0), max_size=20))
def test_a_curve_that_repeats_is_that_of_numpy(one, places) -> None:
    assert np.allclose(one.at(places), np.interp(places, one.x, one.y, period=360.0), atol=1e-9)


def test_a_turn_that_ends_with_another_value_begins_with_its_first_one() -> None:
    jumping = curve([0, 90, 360], [1, 2, 5], period=360.0)
    assert jumping.jumps
    assert jumping.at([0.0, 360.0, 359.0, -1.0, 720.0]) == pytest.approx([1, 1, 2 + 269 / 90, 2 + 269 / 90, 1])


def test_a_single_point_that_repeats_is_a_constant() -> None:
    assert curve([30], [2], period=360.0).at([0.0, 30.0, 200.0, 900.0]) == [2.0] * 4


def test_slopes_are_those_of_scipy() -> None:
    one = curve([0, 1, 4, 10], [0.0, 2.0, -1.0, 3.0])
    slopes = make_interp_spline(one.x, one.y, k=1).derivative()([0.5, 2.0, 7.0])
    assert one.slopes() == pytest.approx(slopes)


@given(curves(), curves(), st.lists(st.floats(-500.0, 500.0), max_size=20))
def test_a_difference_is_that_of_the_values_everywhere(one, other, places) -> None:
    expected = np.interp(places, one.x, one.y) - np.interp(places, other.x, other.y)
    assert np.allclose(one.minus(other).at(places), expected, atol=1e-12)


@given(curves(), curves())
@settings(deadline=None)
def test_no_place_differs_by_more_than_the_largest_gap(one, other) -> None:
    size, at = one.largest_gap(other)
    dense = np.union1d(np.linspace(-500.0, 500.0, 5001), [*one.x, *other.x])
    gaps = np.abs(np.interp(dense, one.x, one.y) - np.interp(dense, other.x, other.y))
    assert size == pytest.approx(gaps.max(), abs=1e-15)
    assert abs(one.at(at) - other.at(at)) == size


@given(curves(360.0), curves(360.0))
@settings(deadline=None)
def test_the_largest_gap_of_curves_that_repeat_is_found_in_one_turn(one, other) -> None:
    x = np.union1d(np.mod([*one.x, *other.x], 360.0), np.linspace(0.0, 360.0, 721))
    sides = [np.interp(x, curve.x, curve.y, period=360.0) for curve in (one, other)]
    assert one.largest_gap(other).size == pytest.approx(np.abs(sides[0] - sides[1]).max(), abs=1e-12)


def test_the_gap_beside_a_jump_is_found_on_the_side_where_it_is() -> None:
    one = curve([0, 180, 360], [0, 0, 5], period=360.0)
    other = curve([0, 180, 360], [0, 0, 1], period=360.0)
    gap = one.largest_gap(other)
    assert gap.size == pytest.approx(4.0, abs=1e-6)
    assert 359.9999 < gap.at % 360.0 < 360.0


@given(curves(360.0), st.sampled_from([0.0, 45.0, -360.0, 500.0]), st.lists(st.floats(-900.0, 900.0), max_size=10))
def test_where_a_repeating_curve_begins_changes_nothing(one, start, places) -> None:
    moved = one.beginning_at(start)
    assert (moved.x[0], moved.closed().x[-1]) == (start, pytest.approx(start + 360.0))
    assert np.allclose(moved.at(places), one.at(places), atol=1e-9)


def test_a_jump_cannot_be_moved() -> None:
    with pytest.raises(ValueError, match="cannot begin at 10"):
        curve([0, 90, 360], [1, 2, 5], period=360.0).beginning_at(10.0)


@given(curves(), st.sampled_from([1.0, -1.0]))
def test_what_is_added_has_the_sign_of_the_curve(one, sign) -> None:
    added = replace(one, sign=sign).added()
    assert np.array_equal(added.y, sign * np.array(one.y))
    assert added.added() == added


@pytest.mark.parametrize(("unit", "unit_shown", "expected"), [("mm", "µm", 2.0), ("°", "″", 7.2), ("rad", "µrad", 2e3)])
def test_small_values_are_shown_in_the_unit_of_the_field(unit: str, unit_shown: str, expected: float) -> None:
    one = Curve((0.0,), (0.002,), POSITION, Quantity("correction", unit, "Y"))
    assert one.shown().y == pytest.approx((expected,))
    assert str(one.shown().of) == f"correction of Y [{unit_shown}]"
    assert shown(unit) == (pytest.approx(expected / 0.002), unit_shown)


def test_a_unit_without_a_smaller_one_stays() -> None:
    assert Quantity("current", "A").scaled() == Quantity("current", "A")
    assert Quantity("current", "A").factor == 1.0


@given(curves())
def test_other_points_are_read_off_the_curve(one) -> None:
    assume(len(one.x) > 1)
    x = np.linspace(one.x[0], one.x[-1], 7)
    assert np.allclose(one.on(x).y, np.interp(x, one.x, one.y), atol=1e-15)


@pytest.mark.parametrize(
    ("x", "y", "period", "because"),
    [
        ((), (), None, "the table has no points"),
        ((0, 1), (0,), None, "the table has not one value for each of its 2 points"),
        ((0, 1), (0, np.nan), None, "the table holds a number that is not finite"),
        ((0, np.inf), (0, 0), None, "the table holds a number that is not finite"),
        ((0, 0), (0, 1), None, "the points of the table do not ascend"),
        ((0, 400), (0, 1), 360.0, "the table is longer than the 360 mm after which it repeats"),
    ],
)
def test_what_is_no_curve_is_refused_in_a_sentence(x, y, period, because) -> None:
    with pytest.raises(ValueError, match=because):
        curve(x, y, period=period, label="the table")
