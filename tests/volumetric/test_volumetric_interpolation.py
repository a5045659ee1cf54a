from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from rigid_bodies import corrections_of, machine_of, volumetric
from scipy.interpolate import RegularGridInterpolator

from axcomp.kernel import errors_at, find_cell, zeros
from axcomp.model import ERRORS, LETTERS, ErrorTable, Interpolation, ModuloRange
from axcomp.runtime import Runtime, compile_tables

Array = NDArray[np.float64]
KNOTS = st.lists(st.floats(-500, 500).map(lambda x: round(x, 3)), min_size=1, max_size=7, unique=True).map(sorted)


def table(name: str, arguments: str, nodes: Array, values: Array, mode: Interpolation) -> ErrorTable:
    return ErrorTable(name, tuple(values.tolist()), arguments, tuple(map(tuple, nodes.tolist())), mode)


def evaluate(tables: list[ErrorTable], positions: Array, letters: str) -> Array:
    """Return the errors of the tables at positions, shape (positions, tables)."""
    machine = machine_of(volumetric("XYZABC", errors=tuple(tables)))
    runtime = Runtime(machine)
    rows = []
    for row in positions:
        position = zeros(len(LETTERS))
        for letter, q in zip(letters, row.tolist(), strict=True):
            position[LETTERS.index(letter)] = q
        errors = zeros(len(ERRORS))
        errors_at(runtime.pool, runtime.tables.volumetric[0], position, [0] * len(ERRORS), errors)
        rows.append([errors[ERRORS.index(table.name)] for table in tables])
    return np.array(rows)


def grid(axes: list[list[float]]) -> Array:
    return np.array(list(itertools.product(*axes)))


@settings(max_examples=60)
@given(st.lists(KNOTS, min_size=1, max_size=3), st.data())
def test_values_on_a_grid_are_multilinear_and_held_outside(axes: list[list[float]], data: st.DataObject) -> None:
    arguments = "".join(sorted(data.draw(st.permutations(LETTERS[:3]))[: len(axes)]))
    nodes = grid(axes)
    values = data.draw(arrays(float, (2, len(nodes)), elements=st.floats(-0.5, 0.5)))
    tables = [
        table(name, arguments, nodes, v, Interpolation.GRID) for name, v in zip(("EXX", "EBX"), values, strict=True)
    ]
    positions = data.draw(arrays(float, (8, len(axes)), elements=st.floats(-700, 700)))
    positions = np.vstack([positions, nodes[:5]])
    found = evaluate(tables, positions, arguments)
    # SciPy wants two points along every axis: a single one gets a twin.
    wide = [axis if len(axis) > 1 else [axis[0], axis[0] + 1.0] for axis in axes]
    inside = np.clip(positions, [axis[0] for axis in axes], [axis[-1] for axis in axes])
    for column, v in enumerate(values):
        shaped = v.reshape([len(axis) for axis in axes])
        for d, axis in enumerate(axes):
            shaped = np.repeat(shaped, 2, axis=d) if len(axis) == 1 else shaped
        assert found[:, column] == pytest.approx(RegularGridInterpolator(wide, shaped)(inside), abs=1e-12)


def test_six_arguments_are_as_good_as_one() -> None:
    rng = np.random.default_rng(5)
    axes = [[0.0, 10.0, 30.0], [0.0, 1.0], [-5.0, 5.0], [0.0, 90.0], [-20.0, 0.0, 20.0], [0.0, 180.0]]
    nodes = grid(axes)
    values = rng.uniform(-0.5, 0.5, len(nodes))
    positions = np.array([rng.uniform([a[0] for a in axes], [a[-1] for a in axes]) for _ in range(20)])
    found = evaluate([table("EYZ", LETTERS, nodes, values, Interpolation.GRID)], positions, LETTERS)
    expected = RegularGridInterpolator(axes, values.reshape([len(a) for a in axes]))(positions)
    assert found[:, 0] == pytest.approx(expected, abs=1e-12)


@given(
    st.lists(st.floats(-1e5, 1e5), min_size=2, max_size=40, unique=True).map(sorted),
    st.lists(st.floats(0, 1), min_size=1, max_size=20),
)
def test_the_cell_of_a_position_is_found_however_unequal_the_knots_are(knots: list[float], shares: list[float]) -> None:
    values = np.zeros(len(knots))
    values[0] = 0.1
    one = table("EXX", "X", np.array(knots)[:, None], values, Interpolation.GRID)
    runtime = Runtime(machine_of(volumetric("XYZ", errors=(one,))))
    inside = [min(knots[0] + share * (knots[-1] - knots[0]), knots[-1]) for share in shares]
    expected = np.clip(np.searchsorted(knots, [*inside, *knots], side="right") - 1, 0, len(knots) - 2)
    block = runtime.tables.volumetric[0].block[0]
    assert [find_cell(runtime.pool, block, 0, x) for x in [*inside, *knots]] == expected.tolist()


def test_a_constant_error_needs_no_argument() -> None:
    assert evaluate([ErrorTable("C0Y", (2e-3,))], np.zeros((1, 1)), "X").tolist() == [[2e-3]]


TURN = np.arange(0.0, 361.0, 30.0)


def rotary_table(nodes: Array, mode: Interpolation = Interpolation.GRID) -> ErrorTable:
    return table("EXC", "C", nodes[:, None], angle(nodes), mode)


@pytest.mark.parametrize("mode", [Interpolation.GRID, Interpolation.SCATTER])
def test_a_table_over_a_full_turn_repeats_and_is_continuous(mode: Interpolation) -> None:
    one = rotary_table(TURN, mode)
    q = np.array([5.0, 100.0, 355.0, 359.999999999, 0.0])
    found = [evaluate([one], (q + turns * 360.0)[:, None], "C")[:, 0] for turns in (-2, 0, 1)]
    assert found[0] == pytest.approx(found[1], abs=1e-12)
    assert found[2] == pytest.approx(found[1], abs=1e-12)
    assert found[1][3] == pytest.approx(found[1][4], abs=1e-9)


def angle(nodes: Array) -> Array:
    """Return some function of an angle."""
    return 0.01 * np.cos(np.radians(nodes)) + 0.002 * np.sin(np.radians(nodes))


def evaluate_modulo(one: ErrorTable, positions: Array, modulo: ModuloRange | None) -> Array:
    """Return an error over C at positions of C, which counts modulo or not."""
    machine = machine_of(volumetric("XYZC", errors=(one,)))
    axes = tuple(replace(axis, modulo=modulo) if axis.name == "C" else axis for axis in machine.axes)
    runtime = Runtime(replace(machine, axes=axes))
    found = []
    for q in positions.tolist():
        position, errors = zeros(len(LETTERS)), zeros(len(ERRORS))
        position[LETTERS.index("C")] = q
        errors_at(runtime.pool, runtime.tables.volumetric[0], position, [0] * len(ERRORS), errors)
        found.append(errors[ERRORS.index(one.name)])
    return np.array(found)


@pytest.mark.parametrize("modulo", [None, ModuloRange(), ModuloRange(-180.0, 180.0)])
@pytest.mark.parametrize("first", [-180.0, -360.0, 0.0, 10.0, 725.0])
def test_a_table_over_a_full_turn_is_periodic_wherever_it_starts(first: float, modulo: ModuloRange | None) -> None:
    nodes = first + TURN
    q = np.array([359.99, -90.0, 0.0, 90.0, 450.0, -270.0, 179.0, -181.0])
    # Linear between the records, which lie 30° apart from ``first`` on.
    expected = np.interp(first + np.mod(q - first, 360.0), nodes, angle(nodes))
    assert evaluate_modulo(rotary_table(nodes), q, modulo) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("modulo", [None, ModuloRange()])
def test_scattered_records_over_angles_are_as_near_as_they_are_round_the_circle(modulo: ModuloRange | None) -> None:
    nodes = np.array([0.0, 80.0, 170.0, 350.0])
    q = np.array([355.0, -4.0, 715.0, 260.0])
    distance = np.abs(np.mod(q[:, None] - nodes + 180.0, 360.0) - 180.0)
    expected = (angle(nodes) / distance**2).sum(axis=1) / (1.0 / distance**2).sum(axis=1)
    found = evaluate_modulo(rotary_table(nodes, Interpolation.SCATTER), q, modulo)
    assert found == pytest.approx(expected, abs=1e-12)


def test_a_table_over_less_than_a_full_turn_is_not_folded() -> None:
    one = rotary_table(np.array([-90.0, 0.0, 90.0]))
    found = evaluate([one], np.array([[270.0], [-90.0], [90.0], [-400.0]]), "C")[:, 0]
    assert found.tolist() == [one.values[2], one.values[0], one.values[2], one.values[0]]


@pytest.mark.parametrize(
    ("nodes", "start"),
    [((-90.0, 0.0, 90.0), -180.0), ((0.0, 90.0, 300.0), -30.0), ((350.0, 360.0, 370.0), 180.0), ((-30.0,), -210.0)],
)
def test_on_a_modulo_axis_it_is_folded_into_the_turn_centred_on_it(nodes: tuple[float, ...], start: float) -> None:
    one = rotary_table(np.array(nodes))
    machine = machine_of(volumetric("XYZABC", errors=(one,)))
    axes = tuple(replace(a, modulo=ModuloRange(0.0, 360.0)) if a.name == "C" else a for a in machine.axes)
    tables, pool = compile_tables(replace(machine, axes=axes))
    q = np.array([*nodes, 350.0, 450.0, -270.0, 89.0, 179.0, 181.0, 720.5, -359.5])
    found = []
    for c in q.tolist():
        errors = zeros(len(ERRORS))
        errors_at(pool, tables.volumetric[0], [0.0, 0.0, 0.0, 0.0, 0.0, c], [0] * len(ERRORS), errors)
        found.append(errors[ERRORS.index("EXC")])
    folded = (q - start) % 360.0 + start
    assert found == pytest.approx(np.interp(folded, nodes, one.values), abs=1e-13)
    if len(nodes) > 1:
        assert found[len(nodes) + 1] == found[len(nodes) + 2]  # 450° and −270°


@pytest.mark.parametrize("first", [-180.0, -90.0, 0.0, 30.0])
def test_a_table_over_a_full_turn_is_folded_from_its_first_point_whatever_the_axis_counts(first: float) -> None:
    nodes = first + np.arange(0.0, 361.0, 40.0)
    values = np.linspace(-0.01, 0.02, 10)
    one = table("EXC", "C", nodes[:, None], values, Interpolation.GRID)
    q = np.array([first, first + 359.0, first + 361.0, first - 1.0, 1234.5, -777.0])
    found = evaluate([one], q[:, None], "C")[:, 0]
    assert found == pytest.approx(np.interp((q - first) % 360.0 + first, nodes, values), abs=1e-12)


def test_linear_positions_are_never_folded() -> None:
    one = table("EXX", "X", np.array([[0.0], [360.0]]), np.array([0.0, 0.36]), Interpolation.GRID)
    assert evaluate([one], np.array([[400.0]]), "X").tolist() == [[0.36]]


@given(
    st.lists(st.tuples(*[st.floats(-100, 100).map(lambda x: round(x, 3))] * 2), min_size=1, max_size=12, unique=True),
    st.lists(st.tuples(*[st.floats(-150, 150)] * 2), min_size=1, max_size=6),
    st.data(),
)
def test_scattered_values_are_weighted_by_the_square_of_the_distance(
    nodes: list[tuple[float, float]], positions: list[tuple[float, float]], data: st.DataObject
) -> None:
    values = data.draw(arrays(float, len(nodes), elements=st.floats(-0.5, 0.5)))
    one = table("EZY", "XY", np.array(nodes), values, Interpolation.SCATTER)
    square = np.sum((np.array(positions)[:, None, :] - np.array(nodes)) ** 2, axis=2)
    near = square.min(axis=1) <= 1e-30
    weights = 1.0 / np.maximum(square, 1e-300)
    expected = weights @ values / weights.sum(axis=1)
    expected[near] = values[square.argmin(axis=1)][near]
    found = evaluate([one], np.array(positions), "XY")[:, 0]
    assert found == pytest.approx(expected, abs=1e-12)


def test_scattered_values_are_exact_at_the_nodes() -> None:
    nodes = np.random.default_rng(2).uniform(-100, 100, (30, 3))
    values = np.linspace(-0.4, 0.4, 30)
    one = table("EZY", "XYZ", nodes, values, Interpolation.SCATTER)
    assert evaluate([one], nodes, "XYZ")[:, 0].tolist() == values.tolist()


@given(
    st.lists(st.tuples(*[st.integers(-9, 9)] * 3), min_size=2, max_size=8).filter(
        lambda path: all(a != b for a, b in itertools.pairwise(path))
    ),
    st.lists(st.tuples(*[st.floats(-12, 12)] * 3), min_size=1, max_size=6),
    st.sampled_from(["XYZ", "XY", "YZ"]),
)
def test_on_a_path_the_nearest_point_of_the_polyline_counts(
    corners: list[tuple[int, int, int]], positions: list[tuple[float, float, float]], arguments: str
) -> None:
    path = np.array(corners, float)[:, : len(arguments)]
    path = path[[True, *np.any(np.diff(path, axis=0) != 0.0, axis=1)]]
    values = np.linspace(-0.3, 0.5, len(path)) ** 2
    mode = Interpolation.PATH_XY if arguments == "XY" else Interpolation.PATH
    one = table("EXX", arguments, path, values, mode)
    places = np.array(positions)[:, : len(arguments)]
    found = evaluate([one], places, arguments)[:, 0]
    for place, value in zip(places, found, strict=True):
        # Walk along the polyline in small steps: the value is that of a point no farther than any of these.
        s = np.linspace(0.0, 1.0, 401)[:, None]
        feet = np.vstack([a + s * (b - a) for a, b in itertools.pairwise(path)] or [path])
        along = np.concatenate([(1 - s[:, 0]) * a + s[:, 0] * b for a, b in itertools.pairwise(values)] or [values])
        distances = np.linalg.norm(feet - place, axis=1)
        near = distances <= distances.min() + 0.1
        assert along[near].min() - 1e-2 <= value <= along[near].max() + 1e-2


def test_a_path_is_linear_between_its_corners_and_held_at_its_ends() -> None:
    corners = np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 50.0]])
    one = table("EYX", "XY", corners, np.array([0.0, 0.1, 0.3]), Interpolation.PATH_XY)
    places = np.array([[-20.0, 5.0], [30.0, 7.0], [100.0, 0.0], [130.0, 10.0], [90.0, 70.0]])
    assert evaluate([one], places, "XY")[:, 0] == pytest.approx([0.0, 0.03, 0.1, 0.14, 0.3], abs=1e-12)


def test_errors_over_the_same_nodes_share_a_search_and_others_do_not() -> None:
    nodes = np.array([[0.0], [10.0]])
    shared = [table(name, "X", nodes, np.array([0.1, 0.2]), Interpolation.GRID) for name in ("EXX", "EYX", "EAX")]
    other = table("EZX", "X", np.array([[0.0], [11.0]]), np.array([0.1, 0.2]), Interpolation.GRID)
    zero = table("EBX", "X", nodes, np.zeros(2), Interpolation.GRID)
    compiled = Runtime(machine_of(volumetric("XYZ", errors=(*shared, other, zero)))).tables.volumetric[0]
    assert [(block.errors, block.nodes) for block in compiled.block[: compiled.blocks]] == [(3, 2), (1, 2)]


def test_a_correction_follows_its_table() -> None:
    one = table("EXX", "X", np.array([[0.0], [10.0], [40.0]]), np.array([0.0, 0.01, -0.02]), Interpolation.GRID)
    runtime = Runtime(machine_of(volumetric("XYZ", errors=(one,))))
    x = np.linspace(-5, 45, 101)
    found = [corrections_of(runtime, {"X": q})["X"] for q in x.tolist()]
    # The axis has its error where it stands, and so comes to x.
    actual = x + found + np.interp(x + found, [0, 10, 40], [0, 0.01, -0.02])
    assert actual == pytest.approx(x, abs=1e-6)


FIGURE_OF_EIGHT = np.array([[0.0, 0.0], [100.0, 100.0], [100.0, 0.0], [0.0, 100.0]])


@pytest.mark.parametrize("beside", [0.0, 0.02, -0.05])
def test_where_a_path_crosses_itself_the_section_that_is_followed_counts(beside: float) -> None:
    values = np.array([0.0, 0.1, 0.2, 0.3])
    one = table("EZX", "XY", FIGURE_OF_EIGHT, values, Interpolation.PATH_XY)
    runtime = Runtime(machine_of(volumetric("XYZ", errors=(one,))))
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(FIGURE_OF_EIGHT, axis=0), axis=1))])
    crossing = 0.5 * (lengths[2] + lengths[3])
    s = np.sort([*np.linspace(0.0, lengths[-1], 2001), *(crossing + 0.005 * np.arange(-20, 21))])
    x, y = (np.interp(s, lengths, FIGURE_OF_EIGHT[:, d]) for d in range(2))
    found = [corrections_of(runtime, {"X": a + beside, "Y": b})["Z"] for a, b in zip(x, y, strict=True)]
    # The values go evenly from 0 to 0.3 but for the corners, which are cut short by what the tool is beside the path.
    assert found == pytest.approx(-np.interp(s, lengths, values), abs=3e-3 * abs(beside) + 1e-12)


def test_a_jump_to_another_part_of_a_path_is_followed() -> None:
    one = table("EZX", "XY", FIGURE_OF_EIGHT, np.array([0.0, 0.1, 0.2, 0.3]), Interpolation.PATH_XY)
    runtime = Runtime(machine_of(volumetric("XYZ", errors=(one,))))
    assert corrections_of(runtime, {"X": 20.0, "Y": 20.0})["Z"] == pytest.approx(-0.02)
    assert corrections_of(runtime, {"X": 20.0, "Y": 80.0})["Z"] == pytest.approx(-0.28)


def squares_from(path: Array, place: Array) -> tuple[Array, Array]:
    """Return the squared distances of a place from all sections of a polyline, and where their feet lie, 0 … 1."""
    way = np.diff(path, axis=0)
    along = np.clip(((place - path[:-1]) * way).sum(axis=1) / (way * way).sum(axis=1), 0.0, 1.0)
    square: Array = ((place - (path[:-1] + along[:, None] * way)) ** 2).sum(axis=1)
    return square, along


@settings(max_examples=25, deadline=None)
@given(st.integers(2, 700), st.sampled_from(["XYZ", "XY", "Z"]), st.booleans(), st.integers(0, 2**32))
def test_of_a_long_path_the_section_is_found_as_if_all_were_looked_at(
    corners: int, arguments: str, whole: bool, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    steps = rng.integers(1, 4, (corners, len(arguments))) * rng.choice([-1, 1], (corners, len(arguments)))
    path = np.cumsum(steps if whole else steps * rng.uniform(0.1, 2.0, (corners, 1)), axis=0).astype(float)
    one = table("EXX", arguments, path, np.arange(corners) / 2000.0, Interpolation.PATH)
    tables, pool = compile_tables(machine_of(volumetric("XYZ", errors=(one,))))
    wander = np.cumsum(rng.normal(0.0, 1.0, (60, len(arguments))), axis=0) + path[rng.integers(corners)]
    if whole:
        wander = np.round(2.0 * wander) / 2.0  # many sections are as near
    followed, kept = [0] * len(ERRORS), 0
    for place in [*wander, *rng.uniform(path.min(), path.max(), (20, len(arguments)))]:
        square, along = squares_from(path, place)
        section = int(square.argmin())
        if kept:
            around = np.arange(max(kept - 2, 0), min(kept + 1, corners - 1))
            own = int(around[square[around].argmin()])
            at_end = (own == 0 and along[0] == 0.0) or (own == corners - 2 and along[-1] == 1.0)
            if not at_end and (square[own] < 1.0 or square[own] < 4.0 * square[section]):
                section = own
        kept = section + 1
        position, errors = zeros(len(LETTERS)), zeros(len(ERRORS))
        for letter, q in zip(arguments, place.tolist(), strict=True):
            position[LETTERS.index(letter)] = q
        errors_at(pool, tables.volumetric[0], position, followed, errors)
        nearest = square <= square.min() * (1.0 + 1e-9) + 1e-18  # rounding may prefer another of those as near
        assert followed[0] == kept or nearest[followed[0] - 1]
        kept = followed[0]
        assert errors[ERRORS.index("EXX")] == pytest.approx((followed[0] - 1 + along[followed[0] - 1]) / 2000.0)


@pytest.mark.parametrize("count", [1, 3, 4, 5, 257])
def test_any_number_of_scattered_records_over_any_arguments(count: int) -> None:
    rng = np.random.default_rng(count)
    nodes = rng.uniform(-100.0, 100.0, (count, 4))
    tables = [
        table(name, "XYZC", nodes, rng.uniform(-0.5, 0.5, count), Interpolation.SCATTER)
        for name in ("EXX", "EYX", "EZX", "EAX", "EBX", "ECX", "X0Y")
    ]
    places = rng.uniform(-100.0, 100.0, (20, 4))
    difference = places[:, None, :] - nodes
    difference[:, :, 3] -= 360.0 * np.round(difference[:, :, 3] / 360.0)
    weights = 1.0 / (difference**2).sum(axis=2)
    expected = weights @ np.array([one.values for one in tables]).T / weights.sum(axis=1, keepdims=True)
    assert evaluate(tables, places, "XYZC") == pytest.approx(expected, abs=1e-13)
