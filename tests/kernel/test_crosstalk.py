"""Crosstalk compensation: both variants, the three modes, the direction of the master, and scattered tests."""

from itertools import product

import numpy as np
import pytest
from driving import drive, forward, to_and_fro
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.interpolate import LinearNDInterpolator, RegularGridInterpolator
from scipy.spatial import ConvexHull

from axcomp.kinds import Crosstalk, CrosstalkCurve, CrosstalkTest
from axcomp.model import Axis, Machine
from axcomp.runtime import Runtime

ACCELERATION, DECELERATION = 2000.0, -1600.0


def machine(crosstalk: Crosstalk | CrosstalkCurve) -> Machine:
    """X accelerates and corrects Y; A and B are the adaptation axes."""
    return Machine((Axis(1, "X"), Axis(2, "Y", crosstalk=crosstalk), Axis(3, "A"), Axis(4, "B")))


def crosstalk(mode: int, tests: list[CrosstalkTest], **options: object) -> Crosstalk:
    return Crosstalk(1, ACCELERATION, DECELERATION, mode, tuple(tests), 3, 4, **options)


def measured_at(positions: NDArray[np.float64], rng: np.random.Generator) -> list[CrosstalkTest]:
    return [CrosstalkTest(p, q, *rng.uniform(-0.02, 0.02, 4).tolist()) for p, q in positions.tolist()]


def share(a: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.where(a >= 0, np.minimum(a / ACCELERATION, 1.0), np.minimum(a / DECELERATION, 1.0))


class TestOneTest:
    TEST = CrosstalkTest(0.0, 0.0, 0.010, 0.020, -0.030, -0.040)

    def test_the_share_of_the_acceleration_counts_and_never_more_than_all_of_it(self) -> None:
        a = np.array([0.0, -0.0, 500.0, 2000.0, 2001.0, 1e12, -400.0, -1600.0, -1601.0, -1e12])
        run = drive(machine(crosstalk(1, [self.TEST])), {"X.acceleration": a, "Y.setpoint": 3.0})
        expected = [0.0, 0.0, 0.0025, 0.010, 0.010, 0.010, -0.0075, -0.030, -0.030, -0.030]
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-17)
        assert run["Y.corrected_setpoint"] == pytest.approx([3.0 + c for c in expected])

    @pytest.mark.parametrize(("a", "positive", "negative"), [(1000.0, 0.005, 0.010), (-800.0, -0.015, -0.020)])
    def test_the_direction_is_the_masters_last_motion_and_at_first_positive(
        self, a: float, positive: float, negative: float
    ) -> None:
        # in mm/s: 1e-7 is 1e-10 mm a cycle, which is no motion; 2e-6 is one
        v = np.array([0.0, -1e-7, 5.0, 0.0, -5.0, 0.0, 0.0, 1e-7, 0.0, 2e-6, 0.0, -2e-6, 1e-7, -3.0])
        run = drive(machine(crosstalk(1, [self.TEST], velocity_dependent=True)), {"X.velocity": v, "X.acceleration": a})
        moves = np.where(np.abs(v) * 1e-3 >= 1e-9, np.sign(v), 0)
        expected = np.where(forward(moves, 1) > 0, positive, negative)
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-17)

    def test_a_master_without_velocity_goes_the_way_its_setpoint_goes(self) -> None:
        steps = np.array([0.0, -1e-10, 0.5, 0.0, -0.25, 0.0, 1e-10, 0.0, 3.0, 0.0, -1e-6])
        run = drive(
            machine(crosstalk(1, [self.TEST], velocity_dependent=True)),
            {"X.setpoint": 7.0 + np.cumsum(steps), "X.acceleration": 2000.0},
        )
        expected = np.where(forward(np.where(np.abs(steps) > 1e-9, np.sign(steps), 0), 1) > 0, 0.010, 0.020)
        assert run["Y.crosstalk_correction"].tolist() == expected.tolist()

    def test_the_velocity_decides_where_the_setpoint_goes_the_other_way(self) -> None:
        run = drive(
            machine(crosstalk(1, [self.TEST], velocity_dependent=True)),
            {"X.setpoint": [0.0, 1.0, 2.0, 3.0], "X.velocity": [0.0, -5.0, 5.0, 0.0], "X.acceleration": 2000.0},
        )
        assert run["Y.crosstalk_correction"].tolist() == [0.010, 0.020, 0.010, 0.010]

    def test_without_velocity_dependence_the_positive_values_serve_both_directions(self) -> None:
        run = drive(machine(crosstalk(1, [self.TEST])), {"X.velocity": [-5.0, -5.0], "X.acceleration": [2e3, -16e2]})
        assert run["Y.crosstalk_correction"].tolist() == [0.010, -0.030]

    def test_only_the_first_test_counts_in_mode_1(self) -> None:
        run = drive(machine(crosstalk(1, [self.TEST, CrosstalkTest(5.0, 5.0, 9.0)])), {"X.acceleration": [2000.0]})
        assert run["Y.crosstalk_correction"] == [0.010]

    def test_it_needs_no_reference_unless_it_adapts(self) -> None:
        unreferenced = {f"{name}.referenced": False for name in "XYAB"}
        for mode, expected in ((1, 0.010), (2, 0.0), (3, 0.0)):
            tests = [self.TEST, CrosstalkTest(9.0, 0.0), CrosstalkTest(0.0, 9.0)][: 2 if mode == 2 else 3]
            run = drive(machine(crosstalk(mode, tests)), {"X.acceleration": [2000.0], **unreferenced})
            assert run["Y.crosstalk_correction"] == [expected]

    @pytest.mark.parametrize(("mode", "count", "needed"), [(2, 2, "A"), (3, 3, "AB"), (3, 4, "AB")])
    def test_only_the_adaptation_axes_must_be_referenced(self, mode: int, count: int, needed: str) -> None:
        corners = [CrosstalkTest(9.0, 0.0), CrosstalkTest(0.0, 9.0), CrosstalkTest(9.0, 9.0)]
        tests = [self.TEST, *corners][:count]
        for name in "XYAB":
            run = drive(machine(crosstalk(mode, tests)), {"X.acceleration": [2000.0], f"{name}.referenced": False})
            assert run["Y.crosstalk_active"] == [name not in needed]


class TestOneAdaptationAxis:
    def test_it_is_numpys_interpolation_over_sorted_tests(self, rng: np.random.Generator) -> None:
        positions = rng.permutation(np.linspace(-50.0, 120.0, 7) + rng.uniform(-9, 9, 7))
        tests = measured_at(np.stack([positions, np.zeros(7)], axis=1), rng)
        position, a, v = rng.uniform(-90, 160, 500), rng.uniform(-3e3, 3e3, 500), rng.integers(-1, 2, 500) * 7.0
        position[:7] = positions
        run = drive(
            machine(crosstalk(2, tests, velocity_dependent=True)),
            {"A.setpoint": position, "X.acceleration": a, "X.velocity": v},
        )
        order = np.argsort(positions)

        def over(field: str) -> NDArray[np.float64]:
            return np.interp(position, positions[order], np.array([getattr(test, field) for test in tests])[order])

        negative = forward(np.sign(v), 1) < 0
        accelerate = np.where(negative, over("accelerate_negative"), over("accelerate_positive"))
        decelerate = np.where(negative, over("decelerate_negative"), over("decelerate_positive"))
        expected = share(a) * np.where(a >= 0, accelerate, decelerate)
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-15)

    def test_the_raw_setpoint_of_the_adaptation_axis_counts(self) -> None:
        tests = [CrosstalkTest(0.0, 0.0, 0.0), CrosstalkTest(10.0, 0.0, 1.0)]
        run = drive(machine(crosstalk(2, tests)), {"A.setpoint": [2.5], "B.setpoint": [9.0], "X.acceleration": [2e3]})
        assert run["Y.crosstalk_correction"] == [0.25]


class TestGrid:
    def test_a_full_grid_is_scipys_bilinear_interpolation(self, rng: np.random.Generator) -> None:
        x1, x2 = np.array([-10.0, 0.0, 7.0, 30.0]), np.array([5.0, 6.0, 50.0])
        places = rng.permutation(np.array(list(product(x1, x2))))
        tests = measured_at(places, rng)
        table = dict(zip(map(tuple, places.tolist()), tests, strict=True))
        values = np.array([[table[p, q].accelerate_positive for q in x2.tolist()] for p in x1.tolist()])
        at = rng.uniform((-30, -20), (50, 80), (300, 2))
        at[:12] = places
        run = drive(
            machine(crosstalk(3, tests)), {"A.setpoint": at[:, 0], "B.setpoint": at[:, 1], "X.acceleration": 2000.0}
        )
        clipped = np.stack([np.clip(at[:, 0], -10, 30), np.clip(at[:, 1], 5, 50)], axis=1)
        expected = RegularGridInterpolator((x1, x2), values)(clipped)
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-15)


def hull_values(
    points: NDArray[np.float64], values: NDArray[np.float64], at: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the value at the nearest point of the convex hull, linear along its sides."""
    sides = ConvexHull(points).simplices
    a, side = points[sides[:, 0]], points[sides[:, 1]] - points[sides[:, 0]]
    t = np.clip(np.einsum("nsk,sk->ns", at[:, None] - a, side) / np.einsum("sk,sk->s", side, side), 0, 1)
    nearest = np.argmin(np.linalg.norm(at[:, None] - a - t[..., None] * side, axis=-1), axis=1)
    along = t[np.arange(len(at)), nearest]
    return (1 - along) * values[sides[nearest, 0]] + along * values[sides[nearest, 1]]


class TestScattered:
    @settings(max_examples=15, deadline=None)
    @given(st.integers(3, 15), st.integers(0, 2**32 - 1))
    def test_inside_it_is_scipys_delaunay_and_outside_the_nearest_point_of_the_hull(self, n: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        points = rng.uniform(-100, 100, (n, 2))
        tests = measured_at(points, rng)
        values = np.array([test.accelerate_positive for test in tests])
        at = np.concatenate([points, rng.uniform(-150, 150, (80, 2)), rng.uniform(-1e6, 1e6, (5, 2))])
        run = drive(
            machine(crosstalk(3, tests)), {"A.setpoint": at[:, 0], "B.setpoint": at[:, 1], "X.acceleration": 2000.0}
        )
        inside = LinearNDInterpolator(points, values)(at)
        expected = np.where(np.isnan(inside), hull_values(points, values, at), inside)
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-9)

    @pytest.mark.parametrize("shape", ["circle", "grid with a gap", "L", "on the diagonal", "star"])
    def test_a_tilted_plane_is_reproduced_whatever_the_triangles(self, shape: str, rng: np.random.Generator) -> None:
        turn = np.arange(8) * np.pi / 4
        points = {
            "circle": 30 * np.stack([np.cos(turn), np.sin(turn)], axis=1),
            "grid with a gap": np.array([(p, q) for p in range(4) for q in range(4) if (p, q) != (1, 2)][:15]) * 0.3,
            "L": np.array([(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (2, 0), (3, 0)]) * 0.1,
            "on the diagonal": np.array([(0.1, 0.7), (0.2, 0.8), (0.3, 0.9), (0.4, 1.0), (0.7, 1.3), (0.0, 2.0)]),
            "star": np.concatenate(
                [[(0.0, 0.0)], *[[r * np.array([np.cos(a), np.sin(a)])] for a in turn[::2] for r in (1, 9)]]
            ),
        }[shape]
        plane = 0.01 + points @ np.array([0.002, -0.003])
        tests = [CrosstalkTest(p, q, value) for (p, q), value in zip(points.tolist(), plane.tolist(), strict=True)]
        weights = rng.dirichlet(np.full(len(points), 0.3), 200)  # places inside the hull
        at = np.concatenate([points, weights @ points])
        run = drive(
            machine(crosstalk(3, tests)), {"A.setpoint": at[:, 0], "B.setpoint": at[:, 1], "X.acceleration": 2000.0}
        )
        assert run["Y.crosstalk_correction"] == pytest.approx(0.01 + at @ np.array([0.002, -0.003]), abs=1e-11)

    def test_it_is_continuous_along_any_path(self, rng: np.random.Generator) -> None:
        points = np.array([(0.1, 0.1), (0.2, 0.2), (0.3, 0.3), (5.0, 0.0), (0.0, 7.0), (9.0, 9.0), (4.0, 4.1)])
        tests = measured_at(points, rng)
        values = np.array([test.accelerate_positive for test in tests])
        a, b = to_and_fro(500, rng, -3.0, 12.0, stand=0.0), to_and_fro(500, rng, -3.0, 12.0, stand=0.0)
        a, b = (np.interp(np.arange(0, 499, 0.1), np.arange(500), p) for p in (a, b))
        run = drive(machine(crosstalk(3, tests)), {"A.setpoint": a, "B.setpoint": b, "X.acceleration": 2000.0})
        steepest = np.ptp(values) / 0.05  # no height of a triangle of these points is smaller
        steps = steepest * np.hypot(np.diff(a), np.diff(b))
        assert (np.abs(np.diff(run["Y.crosstalk_correction"])) <= steps + 1e-9).all()

    def test_leaving_the_tests_is_told_once(self) -> None:
        tests = [CrosstalkTest(0.0, 0.0), CrosstalkTest(10.0, 0.0), CrosstalkTest(0.0, 10.0)]
        runtime = Runtime(machine(crosstalk(3, tests)))
        drive(runtime, {"A.setpoint": [1.0, 5.0, 0.0], "B.setpoint": [1.0, 5.0, 0.0]})
        assert list(runtime.notices()) == []
        drive(runtime, {"A.setpoint": [5.1, -1.0, 1.0], "B.setpoint": [5.1, 0.0, 1.0]})
        assert ["Y" in notice for notice in runtime.notices()] == [True]
        drive(runtime, {"A.setpoint": [50.0]})
        assert list(runtime.notices()) == []


class TestCurve:
    CURVE = CrosstalkCurve(1, (-3000.0, -500.0, 0.0, 100.0, 2500.0), (0.02, 0.003, 0.001, -0.004, -0.03))

    def test_the_old_variant_is_numpys_interpolation_over_the_signed_acceleration(self, rng) -> None:
        a = np.concatenate([self.CURVE.accelerations, rng.uniform(-5e3, 5e3, 300), [-1e14, 1e14]])
        run = drive(machine(self.CURVE), {"X.acceleration": a, "Y.setpoint": -7.0})
        expected = np.interp(a, self.CURVE.accelerations, self.CURVE.corrections)
        assert run["Y.crosstalk_correction"] == pytest.approx(expected, abs=1e-16)
        assert run["Y.corrected_setpoint"] == pytest.approx(-7.0 + expected)

    def test_it_needs_no_reference(self) -> None:
        run = drive(
            machine(self.CURVE), {"X.acceleration": [2500.0], **{f"{name}.referenced": False for name in "XYAB"}}
        )
        assert run["Y.crosstalk_correction"] == [-0.03]
