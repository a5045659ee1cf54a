"""The simulated measurements say what the plant's own formulas say, and what real motions show."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

from axcomp.engine import Course, Limits, Setpoints, move
from axcomp.model import models
from axcomp.plant import (
    CYCLE_TIME,
    Plant,
    acceleration_test,
    deviation,
    friction_current,
    load_plant,
    positioning,
    straightness,
)

MODEL = models() / "three_axis"


@pytest.fixture(scope="module")
def plant() -> Plant:
    return load_plant(MODEL, choice="memoryless")


@pytest.fixture(scope="module")
def described() -> dict[str, Any]:
    """Description of each axis in the file, by name."""
    return {axis["name"]: axis for axis in json.loads((MODEL / "plant.json").read_text(encoding="utf-8"))["axes"]}


@pytest.mark.parametrize("direction", [1, -1])
def test_a_position_reached_by_moving_there_deviates_as_measured_at_rest(plant: Plant, direction: int) -> None:
    target = 123.4
    course = Course({"X": target - direction * 1.0}, CYCLE_TIME)
    course.move({"X": target}, Limits(20.0, 400.0, 1e4))
    course.dwell(0.08)
    positions = course.setpoints()["X"].position
    plant.rest_at([positions[0], 0.0, 0.0], [-direction, 1.0, 1.0])
    for position in positions:
        plant.step([float(position), 0.0, 0.0], [0.0, 0.0, 0.0], CYCLE_TIME)
    assert plant.true[0] - target == pytest.approx(positioning(plant, "X", [target], direction)[0], abs=2e-5)


def test_the_directions_differ_where_the_curves_do(plant: Plant) -> None:
    forwards, backwards = (positioning(plant, "X", [-250.0, 250.0], direction) for direction in (1, -1))
    assert np.min(np.abs(np.subtract(forwards, backwards))) > 1e-3
    assert positioning(plant, "Y", [100.0], 1) == positioning(plant, "Y", [100.0], -1)


def test_straightness_is_measured_against_the_master_at_zero(plant: Plant) -> None:
    assert straightness(plant, "Z", "X", [0.0]) == [0.0]
    expected = deviation(plant, "Z", {"X": 400.0}) - deviation(plant, "Z", {})
    assert straightness(plant, "Z", "X", [400.0]) == [pytest.approx(expected)]


@pytest.mark.parametrize("velocity", [0.5, 5.0, 200.0])
def test_the_current_at_constant_velocity_is_the_friction(
    plant: Plant, described: dict[str, Any], velocity: float
) -> None:
    drive, friction = described["Y"]["drive"], described["Y"]["friction"]
    force = friction["coulomb"] + friction["viscous"] * velocity
    force += (friction["static"] - friction["coulomb"]) * math.exp(-((velocity / friction["stribeck_velocity"]) ** 2))
    assert friction_current(plant, "Y", velocity) == pytest.approx(1e3 * force / drive["force_constant"], rel=2e-3)


@pytest.mark.parametrize(("acceleration", "direction"), [(2500.0, 1), (2500.0, -1), (-2500.0, 1), (-2500.0, -1)])
def test_the_slave_gives_way_by_compliance_times_acceleration(
    plant: Plant, described: dict[str, Any], acceleration: float, direction: int
) -> None:
    (crosstalk,) = described["Y"]["errors"]["crosstalk"]
    (term,) = crosstalk["compliance"]
    along, across = term["first"]["polynomial"], term["second"]["polynomial"]
    x, z = 400.0, -100.0
    compliance = (along[0] + along[1] * x / 500.0) * (across[0] + across[1] * (z + 200.0) / 200.0)
    expected = 1e-3 * compliance * 1e-3 * acceleration * (1.0 + direction * crosstalk["direction"])
    measured = acceleration_test(plant, "Y", "X", {"X": x, "Z": z}, acceleration, direction)
    assert measured == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("length", [200.0, -200.0, 3.0, -0.01])
def test_a_move_keeps_its_limits_and_hits_its_target(length: float) -> None:
    limits = Limits(120.0, 900.0, 3e4)
    positions = np.concatenate([np.zeros(3), move(0.0, length, CYCLE_TIME, limits), np.full(3, length)])
    velocity, acceleration, jerk = (np.diff(positions, order) / CYCLE_TIME**order for order in (1, 2, 3))
    assert np.all(np.diff(positions) * np.sign(length) >= 0.0)
    assert np.max(np.abs(velocity)) <= 120.0 * (1 + 1e-9)
    assert np.max(np.abs(acceleration)) <= 900.0 * (1 + 1e-9)
    assert np.max(np.abs(jerk)) <= 3e4 * (1 + 1e-6)


def test_a_course_keeps_axes_waiting_for_the_longest() -> None:
    course = Course({"X": 0.0, "Y": 5.0, "Z": 1.0}, CYCLE_TIME)
    assert course.move({"X": 50.0, "Y": 6.0}) == course.cycles
    assert course.dwell(0.01) == course.cycles
    made = course.setpoints()
    assert {len(setpoints.position) for setpoints in made.values()} == {course.cycles}
    assert [made[name].position[-1] for name in "XYZ"] == [50.0, 6.0, 1.0]
    assert course.move({"X": 50.0}) == course.cycles


def test_setpoints_carry_their_derivatives() -> None:
    time = np.arange(2000) * CYCLE_TIME
    made = Setpoints.through(np.sin(2.0 * time), CYCLE_TIME)
    assert np.allclose(made.velocity[1:-1], 2.0 * np.cos(2.0 * time[1:-1]), atol=1e-5)
    assert np.allclose(made.acceleration[1:-1], -4.0 * np.sin(2.0 * time[1:-1]), atol=1e-4)
