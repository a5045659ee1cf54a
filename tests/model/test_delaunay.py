"""Triangles of a few points, against SciPy's and against what a Delaunay triangulation is."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, Delaunay

from axcomp.model import Triangulation, triangulate

Points = NDArray[np.float64]


def of(points: Points) -> Triangulation:
    return triangulate(points[:, 0].tolist(), points[:, 1].tolist())


def area(a: Points, b: Points, c: Points) -> float:
    """Signed: > 0 where a → b → c turns left."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2


def assert_delaunay(points: Points) -> None:
    """Counterclockwise, without gaps and overlaps, circumcircles empty, edges once round the hull."""
    found = of(points)
    areas = [area(*points[list(t)]) for t in found.triangles]
    assert min(areas) > 0.0
    assert sum(areas) == pytest.approx(ConvexHull(points).volume, rel=1e-9)  # with the next line: no overlap, no gap
    inner = np.random.default_rng(1).dirichlet(np.ones(len(points)), 100) @ points
    for p in inner:
        holding = [t for t in found.triangles if all(area(points[t[k]], points[t[k - 2]], p) >= 0 for k in range(3))]
        assert holding
    for a, b, c in (points[list(t)] for t in found.triangles):
        centre = np.linalg.solve(2 * np.array([b - a, c - a]), [b @ b - a @ a, c @ c - a @ a])
        radius = np.linalg.norm(a - centre)
        assert (np.linalg.norm(points - centre, axis=1) >= radius * (1 - 1e-9)).all()
    assert sorted(a for a, _ in found.edges) == sorted(b for _, b in found.edges)  # closed
    length = sum(np.linalg.norm(points[b] - points[a]) for a, b in found.edges)
    assert length == pytest.approx(ConvexHull(points).area, rel=1e-9)


@pytest.mark.parametrize("n", range(3, 16))
def test_random_points_have_scipys_triangles(n: int) -> None:
    rng = np.random.default_rng(n)
    for scale in (1e-2, 1.0, 1e4):
        points = scale * rng.uniform(-1, 1, (n, 2)) + scale * rng.uniform(-5, 5, 2)
        found = of(points)
        expected = {frozenset(simplex) for simplex in Delaunay(points).simplices.tolist()}
        assert {frozenset(t) for t in found.triangles} == expected
        assert len(found.triangles) == len(expected)
        hull = {frozenset(side) for side in ConvexHull(points).simplices.tolist()}
        assert {frozenset(side) for side in found.edges} == hull
        assert_delaunay(points)


@pytest.mark.parametrize(("columns", "rows"), [(2, 2), (3, 2), (5, 3), (3, 5), (7, 2), (2, 7)])
@pytest.mark.parametrize("step", [(1.0, 1.0), (0.1, 0.3), (33.3, 0.7)])
def test_grids(columns: int, rows: int, step: tuple[float, float]) -> None:
    points = np.array(list(product(range(columns), range(rows)))) * step
    assert_delaunay(points)
    assert len(of(points).triangles) == 2 * (columns - 1) * (rows - 1)


@pytest.mark.parametrize("n", range(3, 15))
@pytest.mark.parametrize("radius", [0.1, 30.0, 4e5])
def test_circles_with_and_without_their_centre(n: int, radius: float) -> None:
    turn = 2 * np.pi * np.arange(n) / n
    ring = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1) + 7.0
    assert_delaunay(ring)
    assert len(of(ring).triangles) == n - 2
    if n > 3:
        assert len(of(np.append(ring, [[7.0, 7.0]], axis=0)).triangles) == n


def test_points_exactly_on_one_circle() -> None:
    # whole numbers with x² + y² = 25: every triangle of them has an empty circumcircle
    points = np.array(
        [(5, 0), (4, 3), (3, 4), (0, 5), (-3, 4), (-4, 3), (-5, 0), (-4, -3), (-3, -4), (0, -5), (3, -4), (4, -3.0)]
    )
    assert_delaunay(points)
    assert len(of(points).triangles) == 10


@settings(max_examples=30)
@given(st.sets(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=3, max_size=12))
def test_points_of_a_small_grid_with_all_its_lines_and_circles(places: set[tuple[int, int]]) -> None:
    points = np.array(sorted(places), float) * 0.1
    if np.linalg.matrix_rank(points - points[0], tol=1e-9) < 2:
        assert of(points) == Triangulation([], [])
    else:
        assert_delaunay(points)


@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.1, 0.7), (1 / 3, -2 / 7), (1e5, 0.0001)])
def test_points_in_a_line_have_no_triangle(direction: tuple[float, float]) -> None:
    for n in range(1, 9):
        assert of(np.outer([1, 2, 3, 7, 9, -4, 5, 0.5][:n], direction)).triangles == []


def test_points_in_a_line_of_the_lists_grid_are_in_a_line() -> None:
    # 0.1, 0.2, 0.3 are not exactly so as binary fractions, nor are 0.7, 0.8, 0.9
    assert triangulate([0.1, 0.2, 0.3], [0.7, 0.8, 0.9]).triangles == []
    assert triangulate([i * 1e-4 for i in (1001, 2002, 3003)], [i * 1e-4 for i in (70, 140, 210)]).triangles == []
    found = triangulate([0.1, 0.2, 0.3, 0.0], [0.7, 0.8, 0.9, 5.0])
    assert sorted(map(sorted, found.triangles)) == [[0, 1, 3], [1, 2, 3]]


def test_the_order_of_the_points_only_renames_them() -> None:
    rng = np.random.default_rng(5)
    points = rng.uniform(-9, 9, (12, 2))
    order = rng.permutation(12)
    renamed = {frozenset(order[list(t)].tolist()) for t in of(points[order]).triangles}
    assert renamed == {frozenset(t) for t in of(points).triangles}


def test_no_points_have_no_triangles() -> None:
    assert triangulate([], []) == Triangulation([], [])


@settings(max_examples=50)
@given(seed=st.integers(0, 10_000), n=st.integers(4, 9))
def test_the_order_of_the_points_makes_no_difference(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    # a grid has circles through four points, which may be joined in two ways
    points = rng.choice(np.array(list(product(range(3), range(3))), float), n, replace=False)
    values = rng.integers(0, 4, n).astype(float)
    shuffled = rng.permutation(n)

    def joined(order: NDArray[np.int64]) -> set[frozenset[tuple[float, ...]]]:
        at = points[order]
        found = triangulate(at[:, 0].tolist(), at[:, 1].tolist(), [(v,) for v in values[order].tolist()])
        return {frozenset(tuple(at[i].tolist()) for i in t) for t in found.triangles}

    assert joined(np.arange(n)) == joined(shuffled)


@pytest.mark.parametrize(("values", "diagonal"), [((1, 5, 1, 9), {0, 2}), ((1, 5, 7, 5), {1, 3})])
def test_of_four_points_on_a_circle_those_are_joined_that_differ_least(
    values: tuple[float, ...], diagonal: set[int]
) -> None:
    found = triangulate([0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 1.0], [(v,) for v in values])
    assert {frozenset(t) for t in found.triangles} == {frozenset({*diagonal, k}) for k in {0, 1, 2, 3} - diagonal}
