"""The kernel's own sine and cosine against a series in 60 decimal digits."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import given, strategies as st

from axcomp.kernel import cosine, ramp, sine

TWO_PI = Decimal("6.28318530717958647692528676655900576839433879875021164194988918")


def series(x: float, *, first: int) -> Decimal:
    """Σ ± rⁿ/n! over n = first, first + 2, …: the sine for first = 1, the cosine for first = 0."""
    with localcontext(prec=70):
        r = Decimal(x) % TWO_PI
        term = r if first else Decimal(1)
        total, n = term, first
        while abs(term) > Decimal("1e-45"):
            term = -term * r * r / ((n + 1) * (n + 2))
            total, n = total + term, n + 2
        return total


def ulps(value: float, exact: Decimal) -> float:
    return float(abs(Decimal(value) - exact)) / float(np.spacing(max(abs(value), 1e-300)))


@given(st.floats(-0.785, 0.785))
def test_sine_and_cosine_of_an_eighth_turn_err_by_less_than_one_unit_in_the_last_place(x: float) -> None:
    assert_close(x, units=1.0)


@given(st.floats(-4.0, 4.0) | st.floats(-1e5, 1e5, exclude_min=True, exclude_max=True))
def test_reduction_by_many_turns_costs_at_most_two_units_more(x: float) -> None:
    # Two subtractions of the reduction round by half a unit of the angle, and a unit of an angle just above 1/2 is two
    # units of its sine just below 1/2.
    assert_close(x, units=3.0)


def assert_close(x: float, *, units: float) -> None:
    # near a zero of the function the argument reduction counts: there the bound is absolute
    for value, exact in ((sine(x), series(x, first=1)), (cosine(x), series(x, first=0))):
        assert ulps(value, exact) < units or abs(Decimal(value) - exact) < Decimal("5e-18")


@pytest.mark.parametrize("turns", [-8, -3, -1, 0, 1, 2, 3, 4, 1000, 40_001])
def test_quarters_are_counted_through(turns: int) -> None:
    x = turns * np.pi / 2 + np.linspace(-0.78, 0.78, 41)
    assert [sine(v) for v in x.tolist()] == pytest.approx(np.sin(x).tolist(), abs=2e-16)
    assert [cosine(v) for v in x.tolist()] == pytest.approx(np.cos(x).tolist(), abs=2e-16)


def test_special_angles_are_exact() -> None:
    assert (sine(0.0), cosine(0.0)) == (0.0, 1.0)
    assert sine(1.5707963267948966) == 1.0
    assert sine(-0.5) == -sine(0.5)


@pytest.mark.parametrize("cycles", range(1, 21))
def test_the_ramp_is_sine_squared_and_exact_at_its_ends(cycles: int) -> None:
    k = np.arange(cycles + 1)
    w = [ramp(int(step), cycles) for step in k]
    assert w == pytest.approx((np.sin(np.pi / 2 * k / cycles) ** 2).tolist(), abs=3e-16)
    assert (w[0], w[-1]) == (0.0, 1.0)
    assert w == sorted(w)
    assert np.add(w, w[::-1]).tolist() == pytest.approx([1.0] * (cycles + 1))


def test_the_ramp_holds_its_ends_outside() -> None:
    assert (ramp(-1, 5), ramp(6, 5), ramp(0, 1), ramp(1, 1)) == (0.0, 1.0, 0.0, 1.0)
