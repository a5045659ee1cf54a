"""The drive against other formulations of the same equations: SciPy's integrator, and solutions by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from planting import axis, follow, plant_of
from scipy.integrate import solve_ivp
from scipy.interpolate import BSpline

from axcomp.engine import Limits, move

CYCLE = 0.001
WITHOUT_CONTROL = {"position_gain": 0.0, "velocity_gain": 0.0}


def reference_by_spline(setpoints: np.ndarray) -> BSpline:
    """The parabola through the middles of neighbouring setpoints is the quadratic B-spline of the setpoints."""
    control = np.concatenate([np.repeat(setpoints[:1], 2), setpoints])
    knots = CYCLE * (np.arange(len(control) + 3) - 2.0)
    return BSpline(knots, control, 2)


def integrated(setpoints: np.ndarray, current: float, end: float) -> float:
    """Position of ``planting.AXIS`` at ``end`` from its equations in N, kg, A and m, if its motion never stops."""
    reference = reference_by_spline(setpoints)
    velocity, acceleration = reference.derivative(1), reference.derivative(2)

    def slope(t: float, state: np.ndarray) -> list[float]:
        q, v, integral, i = state
        error = 400.0 * (velocity(t) * 1e-3 + 100.0 * (reference(t) * 1e-3 - q) - v)
        demand = 200.0 / 100.0 * (acceleration(t) * 1e-3 + error + integral) + current * 1e-3
        speed = abs(v) * 1e3
        friction = 250.0 + 50.0 * math.exp(-((speed / 5.0) ** 2)) + 0.5 * speed
        force = 100.0 * i - math.copysign(friction, v)
        return [v, force / 200.0, error / 0.008, (demand - i) / 0.0005]

    # It stands until the force exceeds static friction; from there on the equations are smooth.
    def held(t: float, state: np.ndarray) -> list[float]:
        return [0.0, 0.0, *slope(t, np.array([state[0], 1e-300, *state[2:]]))[2:]]

    def breaks_away(t: float, state: np.ndarray) -> float:  # noqa: ARG001
        return 100.0 * state[3] - 300.0

    breaks_away.terminal = True  # type: ignore[attr-defined]
    first = solve_ivp(held, (0.0, end), [setpoints[0] * 1e-3, 0.0, 0.0, 0.0], events=breaks_away, rtol=1e-9, atol=1e-13)
    start = first.y[:, -1]
    start[1] = 1e-12
    second = solve_ivp(slope, (first.t[-1], end), start, rtol=1e-9, atol=1e-13, max_step=CYCLE / 4.0)
    return float(second.y[0, -1]) * 1e3


@pytest.mark.parametrize("current", [0.0, 1500.0])
def test_converges_to_what_scipy_integrates(current: float) -> None:
    setpoints = move(0.0, 20.0, CYCLE, Limits(100.0, 800.0, 2e4))[:150]
    exact = integrated(setpoints, current, len(setpoints) * CYCLE)
    missed = []
    for sub_step in (0.0002, 0.00005):
        *_, drive = follow(plant_of(axis(), sub_step=sub_step), setpoints.tolist(), current)
        missed.append(abs(drive.position - exact))
    assert missed[1] < 2e-5
    assert missed[1] < 0.4 * missed[0] < 1e-3


def test_the_interpolated_setpoint_is_a_quadratic_spline() -> None:
    setpoints = np.random.default_rng(1).normal(size=40)
    references = [drive.reference for drive in follow(plant_of(axis()), setpoints.tolist())]
    expected = reference_by_spline(setpoints)(CYCLE * np.arange(1, len(setpoints) + 1))
    assert np.allclose(references, expected, rtol=0.0, atol=1e-12)


def test_a_current_accelerates_the_mass_as_newton_says() -> None:
    free = axis(drive=WITHOUT_CONTROL, friction={"static": 250.0, "viscous": 0.0})
    current, duration = 6000.0, 0.1
    *_, drive = follow(plant_of(free, sub_step=1e-5), [0.0] * 100, current)
    # i = I (1 − exp(−t/τ)) passes the friction's 2.5 A at t₀; from there on q'' = (K i − F) / m.
    tau, constant = 0.0005, 100.0 / 200.0
    t0 = -tau * math.log(1.0 - 2.5 / 6.0)
    velocity = (constant * 6.0 - 250.0 / 200.0) * (duration - t0)
    velocity -= constant * 6.0 * tau * (math.exp(-t0 / tau) - math.exp(-duration / tau))
    assert drive.velocity == pytest.approx(1e3 * velocity, rel=1e-4)


def test_viscous_friction_bounds_the_velocity() -> None:
    free = axis(drive=WITHOUT_CONTROL, friction={"viscous": 20.0})
    *_, drive = follow(plant_of(free), [0.0] * 1000, 6000.0)
    assert drive.velocity == pytest.approx((600.0 - 250.0) / 20.0, rel=1e-6)


def test_sticks_up_to_static_friction_and_breaks_away_beyond() -> None:
    free = axis(drive=WITHOUT_CONTROL)
    *_, held = follow(plant_of(free), [0.0] * 100, 2990.0)
    *_, moved = follow(plant_of(free), [0.0] * 100, 3010.0)
    assert held.position == held.velocity == 0.0
    assert moved.position > 0.02


def test_friction_stops_a_mass_and_never_turns_it_round() -> None:
    plant = plant_of(axis(drive=WITHOUT_CONTROL, friction={"static": 250.0, "viscous": 0.0}))
    plant.rest_at([0.0])
    plant.drives[0].velocity = 50.0
    velocities = []
    for _ in range(100):
        plant.step([0.0], [0.0], CYCLE)
        velocities.append(plant.drives[0].velocity)
    assert min(velocities) == 0.0 == velocities[-1]
    assert plant.drives[0].position == pytest.approx(50.0**2 / (2.0 * 1250.0), rel=0.01)


def test_follows_a_ramp_one_and_a_half_cycles_behind_without_error() -> None:
    *_, drive = follow(plant_of(axis()), (0.1 * np.arange(500)).tolist())
    assert drive.lag == pytest.approx(0.0, abs=1e-6)
    assert drive.position == pytest.approx(0.1 * 498.5, abs=1e-6)


def test_stands_at_its_setpoint_shortly_after_a_move_without_overshoot() -> None:
    setpoints = np.concatenate([move(0.0, 20.0, CYCLE, Limits(100.0, 1000.0, 2e4)), np.full(60, 20.0)])
    positions = [drive.position for drive in follow(plant_of(axis()), setpoints.tolist())]
    assert max(positions) < 20.0 + 1e-6
    assert positions[-1] == pytest.approx(20.0, abs=1e-5)


def test_the_current_limit_holds_and_does_not_wind_up() -> None:
    limited = axis(drive={"current_limit": 4.0})
    setpoints = np.concatenate([move(0.0, 20.0, CYCLE, Limits(200.0, 4000.0, 1e5)), np.full(300, 20.0)])
    drives = [(drive.current, drive.position) for drive in follow(plant_of(limited), setpoints.tolist())]
    assert max(abs(current) for current, _ in drives) <= 4000.0
    assert drives[-1][1] == pytest.approx(20.0, abs=1e-3)


def test_folded_setpoints_move_a_modulo_axis_as_unfolded_ones() -> None:
    rotary = axis(
        type="rotary",
        modulo=360.0,
        drive={"inertia": 3.0, "torque_constant": 20.0},
        friction={"static": 66.0, "coulomb": 60.0},
        errors={"pitch": {"lost_motion": 0.01, "positive": {"waves": [{"amplitude": 5.0, "period": 360.0}]}}},
    )
    way = np.concatenate([move(340.0, 380.0, CYCLE, Limits()), move(380.0, -10.0, CYCLE, Limits(300.0, 3000.0, 1e5))])
    straight = plant_of(rotary)
    unfolded = [drive.position for drive in follow(straight, way.tolist())]
    folding = plant_of(rotary)
    folded = [drive.position for drive in follow(folding, np.mod(way, 360.0).tolist())]
    turns = (np.array(unfolded) - folded) / 360.0
    assert np.allclose(turns, np.round(turns), atol=1e-9)
    assert {0.0, 1.0, -1.0} == {float(turn) for turn in np.round(turns)}
    assert folding.motion.approach == straight.motion.approach
    assert folding.true[0] == pytest.approx(straight.true[0] + 360.0, abs=1e-9)


def test_goes_on_from_a_saved_state_with_the_same_bits() -> None:
    plant = plant_of(axis(), axis(name="Y"))
    rows = np.random.default_rng(2).normal(scale=0.01, size=(100, 4)).cumsum(axis=0).tolist()
    for x, y, i, j in rows[:50]:
        plant.step([x, y], [i, j], CYCLE)
    saved = plant.state
    for x, y, i, j in rows[50:]:
        plant.step([x, y], [i, j], CYCLE)
    end = (plant.state, list(plant.true))
    plant.state = saved
    for x, y, i, j in rows[50:]:
        plant.step([x, y], [i, j], CYCLE)
    assert (plant.state, plant.true) == end
