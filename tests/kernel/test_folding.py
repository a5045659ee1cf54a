"""Positions of an axis that counts modulo are folded before every table, into the turn that is centred on it (§5)."""

from collections.abc import Callable

import numpy as np
import pytest
from driving import drive
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from axcomp.kinds import Cross, Crosstalk, CrosstalkTest, Leadscrew, Plane
from axcomp.model import Axis, AxisType, Machine, ModuloRange

TURNS = np.array([-720.0, -360.0, 0.0, 360.0, 3600.0])
POINTS = np.array([-90.0, -30.0, 0.0, 45.0, 90.0])
VALUES = np.array([0.010, -0.020, 0.005, 0.013, -0.008])
RANGES = [ModuloRange(0.0, 360.0), ModuloRange(-180.0, 180.0), ModuloRange(-1000.0, -640.0)]


def centred(c: NDArray[np.float64], points: NDArray[np.float64], period: float = 360.0) -> NDArray[np.float64]:
    """Fold positions into the turn that is centred on a table."""
    start = (points[0] + points[-1] - period) / 2
    return (c - start) % period + start


def rotary(modulo: ModuloRange | None, **options: object) -> Axis:
    return Axis(1, "C", AxisType.ROTARY, modulo, **options)


def cross(modulo: ModuloRange | None) -> Machine:
    return Machine((rotary(modulo), Axis(2, "S", cross=Cross(1, tuple(POINTS.tolist()), tuple(VALUES.tolist())))))


def plane(modulo: ModuloRange | None, *, second: bool) -> Machine:
    """Even distances: 45° from −90° to 90°; the other master is P, which stands at 0."""
    rows = (tuple(VALUES.tolist()), (0.0,) * 5)
    grid = Plane(1, 3, -90.0, 0.0, 45.0, 1.0, rows)
    if second:
        grid = Plane(3, 1, 0.0, -90.0, 1.0, 45.0, tuple(zip(*rows, strict=True)))
    return Machine((rotary(modulo), Axis(2, "S", plane=grid), Axis(3, "P")))


def adaptation(modulo: ModuloRange | None) -> Machine:
    tests = tuple(CrosstalkTest(x, 0.0, y, 0.0, y, 0.0) for x, y in zip(POINTS.tolist(), VALUES.tolist(), strict=True))
    return Machine((rotary(modulo), Axis(2, "S", crosstalk=Crosstalk(3, 1.0, -1.0, 2, tests, 1)), Axis(3, "P")))


def second_adaptation(modulo: ModuloRange | None) -> Machine:
    """A grid over P, which stands at 0, and C."""
    tests = tuple(
        CrosstalkTest(p, x, y * (1 - p), 0.0, 0.0, 0.0)
        for p in (0.0, 1.0)
        for x, y in zip(POINTS.tolist(), VALUES.tolist(), strict=True)
    )
    return Machine((rotary(modulo), Axis(2, "S", crosstalk=Crosstalk(3, 1.0, -1.0, 3, tests, 3, 1)), Axis(3, "P")))


def leadscrew(modulo: ModuloRange | None) -> Machine:
    screw = Leadscrew(tuple(POINTS.tolist()), tuple((-VALUES).tolist()))
    return Machine((rotary(modulo, leadscrew=screw), Axis(3, "P")))


EVEN = np.linspace(-90.0, 90.0, 5)
TABLES: dict[str, tuple[Callable[[ModuloRange | None], Machine], str, NDArray[np.float64]]] = {
    "master of cross": (cross, "S.cross_correction", POINTS),
    "first master of plane": (lambda modulo: plane(modulo, second=False), "S.plane_correction", EVEN),
    "second master of plane": (lambda modulo: plane(modulo, second=True), "S.plane_correction", EVEN),
    "adaptation axis": (adaptation, "S.crosstalk_correction", POINTS),
    "second adaptation axis": (second_adaptation, "S.crosstalk_correction", POINTS),
    "leadscrew without modulo": (leadscrew, "C.leadscrew_correction", POINTS),
}
EVERY_TABLE = pytest.mark.parametrize("table", TABLES)


def corrections(table: str, modulo: ModuloRange | None, c: NDArray[np.float64]) -> NDArray[np.float64]:
    make, output, _ = TABLES[table]
    columns = {"C.setpoint": c}
    if "adaptation" in table:
        columns["P.acceleration"] = np.ones_like(c)
    return drive(make(modulo), columns)[output]


@EVERY_TABLE
@pytest.mark.parametrize("modulo", RANGES, ids=str)
def test_450_and_minus_270_are_90(table: str, modulo: ModuloRange) -> None:
    found = corrections(table, modulo, np.array([90.0, 450.0, -270.0, 90.0 + 3600.0]))
    assert found.tolist() == [found[0]] * 4
    assert found[0] == pytest.approx(VALUES[-1], abs=1e-17)


@EVERY_TABLE
@pytest.mark.parametrize("modulo", RANGES, ids=str)
def test_a_table_around_0_meets_350_at_minus_10(table: str, modulo: ModuloRange, rng: np.random.Generator) -> None:
    points = TABLES[table][2]
    c = np.concatenate([[350.0, 330.0, 270.5, 181.0, 179.0, 91.0], rng.uniform(-1000.0, 1000.0, 300)])
    expected = np.interp(centred(c, points), points, VALUES)
    assert corrections(table, modulo, c) == pytest.approx(expected, abs=1e-13)
    assert corrections(table, modulo, c[:1]) == pytest.approx(np.interp([-10.0], points, VALUES), abs=1e-15)


@EVERY_TABLE
def test_whole_turns_change_nothing(table: str) -> None:
    c = np.linspace(-179.5, 179.5, 80)
    one, *others = (corrections(table, ModuloRange(0.0, 360.0), c + turn) for turn in TURNS)
    for other in others:
        assert other == pytest.approx(one, abs=1e-13)


@EVERY_TABLE
def test_the_seam_lies_opposite_to_the_table(table: str) -> None:
    # the ends are held up to ±180°, where they meet
    found = corrections(table, ModuloRange(0.0, 360.0), np.array([179.9, 180.1, -179.9, -180.1]))
    assert found == pytest.approx([VALUES[-1], VALUES[0], VALUES[0], VALUES[-1]], abs=1e-15)


@EVERY_TABLE
def test_an_axis_that_does_not_count_modulo_holds_the_ends(table: str) -> None:
    found = corrections(table, None, np.array([350.0, 450.0, -270.0]))
    assert found == pytest.approx([VALUES[-1], VALUES[-1], VALUES[0]], abs=1e-17)


@pytest.mark.parametrize(("start", "end"), [(0.0, 90.0), (-20.0, 100.0), (0.0, 720.0)])
def test_the_turn_is_as_long_as_the_range_of_the_axis(start: float, end: float, rng: np.random.Generator) -> None:
    c = rng.uniform(-900.0, 900.0, 200)
    period = end - start
    points = np.array([10.0, 30.0, 50.0])
    slave = Axis(2, "S", cross=Cross(1, (10.0, 30.0, 50.0), (0.1, 0.3, -0.2)))
    run = drive(Machine((rotary(ModuloRange(start, end)), slave)), {"C.setpoint": c})
    expected = np.interp(centred(c, points, period), points, [0.1, 0.3, -0.2])
    assert run["S.cross_correction"] == pytest.approx(expected, abs=1e-12)


def test_both_masters_of_a_plane_are_folded_into_turns_of_their_own(rng: np.random.Generator) -> None:
    a_points, c_points = np.array([0.0, 100.0, 200.0]), np.array([300.0, 330.0, 360.0, 390.0])
    values = rng.uniform(-0.1, 0.1, (4, 3))
    grid = Plane(1, 2, 0.0, 300.0, 100.0, 30.0, tuple(map(tuple, values.tolist())))
    axes = (
        Axis(1, "A", AxisType.ROTARY, ModuloRange(0.0, 360.0)),
        Axis(2, "C", AxisType.ROTARY, ModuloRange(-180.0, 180.0)),
        Axis(3, "S", plane=grid),
    )
    a, c = rng.uniform(-800.0, 800.0, (2, 300))
    run = drive(Machine(axes), {"A.setpoint": a, "C.setpoint": c})
    at = np.stack([np.clip(centred(c, c_points), 300.0, 390.0), np.clip(centred(a, a_points), 0.0, 200.0)], axis=1)
    expected = RegularGridInterpolator((c_points, a_points), values)(at)
    assert run["S.plane_correction"] == pytest.approx(expected, abs=1e-12)
