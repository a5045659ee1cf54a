"""Grids and scattered places against SciPy, and against what the kernel adds."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.interpolate import LinearNDInterpolator, RegularGridInterpolator

from axcomp.engine import Engine
from axcomp.kinds import Crosstalk, CrosstalkTest, tables_of
from axcomp.model import Axis, Grid, Machine, Quantity, Scatter

OVER = (Quantity("position", "mm", "Y"), Quantity("position", "mm", "Z"))
OF = Quantity("correction", "mm", "X")
FIVE = ((-200.0, 0.0), (100.0, 50.0), (0.0, 200.0), (250.0, -100.0), (60.0, -150.0))


@st.composite
def grids(draw: st.DrawFn) -> Grid:
    sides = [sorted(draw(st.sets(st.integers(-50, 50), min_size=1, max_size=6))) for _ in range(2)]
    row = st.lists(st.integers(-100, 100), min_size=len(sides[0]), max_size=len(sides[0]))
    rows = draw(st.lists(row, min_size=len(sides[1]), max_size=len(sides[1])))
    x, y = (tuple(map(float, side)) for side in sides)
    return Grid(x, y, tuple(tuple(value / 100 for value in row) for row in rows), OVER, OF)


def _scipy(grid: Grid, x: float, y: float) -> float:
    """Interpolate as SciPy does; a side of one point is constant along it."""
    axes, values = [np.array(grid.y), np.array(grid.x)], np.array(grid.values)
    for k, axis in enumerate(axes):
        if len(axis) == 1:
            axes[k] = np.array([axis[0], axis[0] + 1.0])
            values = np.repeat(values, 2, axis=k)
    place = [np.clip(v, axis[0], axis[-1]) for v, axis in zip((y, x), axes, strict=True)]
    return float(RegularGridInterpolator(axes, values)(place)[0])


PLACES = st.lists(st.tuples(st.floats(-70, 70), st.floats(-70, 70)), min_size=1, max_size=8)


@given(grids(), PLACES)
@settings(deadline=None)
def test_a_grid_is_bilinear_with_its_edges_held(grid, places) -> None:
    assert [grid.at(x, y) for x, y in places] == pytest.approx([_scipy(grid, x, y) for x, y in places], abs=1e-9)


def test_interpolation_on_equal_distances_is_that_of_scipy() -> None:
    random = np.random.default_rng(5)
    points, values = (5.0 + 0.5 * np.arange(4), -3.0 + 2.0 * np.arange(7)), random.normal(size=(4, 7))
    grid = Grid(tuple(points[1].tolist()), tuple(points[0].tolist()), tuple(map(tuple, values.tolist())), OVER, OF)
    x, y = random.uniform(-3.0, 9.0, 50), random.uniform(5.0, 6.5, 50)
    found = [grid.at(u, v) for u, v in zip(x, y, strict=True)]
    assert found == pytest.approx(RegularGridInterpolator(points, values)(np.column_stack([y, x])))
    assert grid.at(-99.0, 99.0) == values[-1, 0]


@given(grids(), grids(), PLACES)
@settings(deadline=None)
def test_a_difference_is_that_of_the_values_everywhere(one, other, places) -> None:
    difference = one.minus(other)
    expected = [_scipy(one, x, y) - _scipy(other, x, y) for x, y in places]
    assert [difference.at(x, y) for x, y in places] == pytest.approx(expected, abs=1e-9)
    assert str(difference.of) == "Δ correction of X [mm]"


def test_scattered_places_are_linear_in_their_triangles() -> None:
    values = tuple(x / 50 + y * y / 4000 for x, y in FIVE)
    scatter = Scatter(FIVE, values, OVER, OF)
    x, y = np.meshgrid(np.linspace(-200.0, 250.0, 19), np.linspace(-150.0, 200.0, 17))
    expected = LinearNDInterpolator(np.array(FIVE), values)(x, y)
    inside = ~np.isnan(expected)
    assert inside.sum() > 50
    found = np.array([scatter.at(u, v) for u, v in zip(x[inside], y[inside], strict=True)])
    assert np.allclose(found, expected[inside], atol=1e-9)


def test_places_that_fill_a_grid_are_bilinear() -> None:
    places = tuple((x, y) for x in (0.0, 10.0, 40.0) for y in (-5.0, 5.0))
    values = tuple(0.1 * x * y + y for x, y in places)
    scatter = Scatter(places, values, OVER, OF)
    assert scatter.at(25.0, 0.0) == pytest.approx(0.0)
    assert scatter.at(4.0, 2.5) == pytest.approx(0.1 * 4.0 * 2.5 + 2.5)
    assert scatter.at(90.0, 9.0) == pytest.approx(25.0)


def test_places_in_a_line_have_no_surface() -> None:
    with pytest.raises(ValueError, match="not in a line"):
        Scatter(((0.0, 0.0), (1.0, 1.0), (2.0, 2.0)), (0.0, 1.0, 2.0), OVER, OF).at(0.5, 0.5)


@pytest.mark.parametrize("places", [FIVE, tuple((x, y) for x in (-50.0, 0.0, 120.0) for y in (0.0, 80.0))])
def test_crosstalk_over_two_axes_is_what_the_kernel_adds_inside_and_outside(places) -> None:
    tests = tuple(CrosstalkTest(x, y, 1e-3 * x, 0.0, 1e-5 * x * y, 0.0) for x, y in places)
    crosstalk = Crosstalk(1, 3000.0, -2500.0, 3, tests, adaptation1=2, adaptation2=3)
    machine = Machine((Axis(1, "X"), Axis(2, "Y"), Axis(3, "Z"), Axis(4, "W", crosstalk=crosstalk)))
    [found] = tables_of(machine)
    random = np.random.default_rng(3)
    x, y = random.uniform(-300.0, 300.0, (2, 200))
    for acceleration, scatter in zip((3000.0, -2500.0), found.tables, strict=True):
        inputs = {"Y.setpoint": x, "Z.setpoint": y, "X.acceleration": np.full(200, acceleration)}
        added = Engine(machine).run(inputs)["W.crosstalk.correction"]
        assert np.allclose([scatter.at(u, v) for u, v in zip(x, y, strict=True)], added, atol=1e-12)
        assert np.ptp(added) > 0.01
