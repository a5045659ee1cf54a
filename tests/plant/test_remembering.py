"""What the plant remembers, against SciPy: friction with bristles, a structure that swings, growth, play."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from planting import axis, follow, plant_of
from scipy.integrate import solve_ivp

from axcomp.model import models
from axcomp.plant import MEMORYLESS, Plant, PlantError, load_plant, memory

CYCLE = 0.001
WITHOUT_CONTROL = {"position_gain": 0.0, "velocity_gain": 0.0}
LUGRE = {"model": "lugre", "presliding": 0.01, "bristle_damping": 15.0, "asymmetry": 0.1}


def lugre_axis(presliding: float = 0.01, **more: Any) -> dict[str, Any]:
    return axis(friction={**LUGRE, "presliding": presliding}, **more)


def integrated(currents: np.ndarray, presliding: float) -> np.ndarray:
    """Positions (mm) at the ends of the cycles of a free mass of 200 kg, 100 N/A, in N, kg, m: LuGre typed again."""
    stiffness = 250.0 / (presliding * 1e-3)

    def slope(t: float, state: np.ndarray) -> list[float]:
        _, v, z, i = state
        demand = currents[min(int(t / CYCLE + 1e-9), len(currents) - 1)] * 1e-3
        share = 0.9 if v < 0.0 else 1.1
        speed = abs(v) * 1e3
        g = share * (250.0 + 50.0 * math.exp(-((speed / 5.0) ** 2)))
        rate = v - stiffness * abs(v) * z / g
        force = stiffness * z + 15e3 * rate + share * 0.5 * v * 1e3
        return [v, (100.0 * i - force) / 200.0, rate, (demand - i) / 0.0005]

    state, found = np.zeros(4), []
    for k in range(len(currents)):
        span = (k * CYCLE, (k + 1) * CYCLE)
        state = solve_ivp(slope, span, state, method="LSODA", rtol=1e-9, atol=1e-13).y[:, -1]
        found.append(state[0] * 1e3)
    return np.array(found)


@pytest.mark.parametrize("presliding", [0.05, 0.005])
def test_bristles_converge_to_what_scipy_integrates(presliding: float) -> None:
    currents = 4500.0 * np.sin(2.0 * np.pi * np.arange(120) / 80.0)
    exact = integrated(currents, presliding)
    missed = []
    for sub_step in (0.0002, 0.00002):
        plant = plant_of(lugre_axis(presliding, drive=WITHOUT_CONTROL), sub_step=sub_step)
        plant.rest_at([0.0])
        found = []
        for current in currents:
            plant.step([0.0], [current], CYCLE)
            found.append(plant.measured[0])
        missed.append(float(np.max(np.abs(found - exact))))
    assert np.ptp(exact) > 0.5
    assert missed[0] < 0.05 * np.ptp(exact)
    assert missed[1] < 0.2 * missed[0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("speed", [1.0, 20.0, 150.0])
def test_steady_friction_is_the_curve_of_its_direction(speed: float, sign: float) -> None:
    setpoints = sign * speed * CYCLE * np.arange(800)
    *_, drive = follow(plant_of(lugre_axis()), setpoints.tolist())
    curve = 250.0 + 50.0 * math.exp(-((speed / 5.0) ** 2)) + 0.5 * speed
    assert drive.current == pytest.approx(sign * (1.0 + sign * 0.1) * curve / 100.0 * 1e3, rel=2e-3)


def test_before_it_slides_it_is_a_spring() -> None:
    plant = plant_of(lugre_axis(drive=WITHOUT_CONTROL))
    for current in np.linspace(0.0, 500.0, 400):
        plant.step([0.0], [float(current)], CYCLE)
    stiffness = 250.0 / 0.01
    assert plant.measured[0] == pytest.approx(-1.1 * 300 / stiffness * math.log(1 - 50.0 / 330.0), rel=0.02)
    for current in np.linspace(500.0, 0.0, 400):
        plant.step([0.0], [float(current)], CYCLE)
    assert 0.0 < plant.measured[0] < 1e-3


@pytest.mark.parametrize("presliding", [1e-6, 1e-4, 1e-2, 1.0])
def test_any_stiffness_is_stable_at_the_cycle_time(presliding: float) -> None:
    """0.001 µm of a 200 kg axis is 5.6 kHz: far above what a step of a whole cycle could follow."""
    plant = plant_of(lugre_axis(presliding), sub_step=CYCLE / 2.0)
    setpoints = (5.0 * np.sin(2.0 * np.pi * np.arange(1500) / 500.0)).tolist()
    positions = [drive.position for drive in follow(plant, setpoints)]
    assert np.max(np.abs(positions[500:])) < 5.1


def test_a_structure_swings_as_scipy_integrates() -> None:
    static = lambda motion: motion.accelerations[0] * 1e-6  # noqa: E731
    mode = memory.Swinging(static, static, {"mass": 200.0, "stiffness": 30.0, "damping": 8000.0})
    plant = plant_of(axis())
    accelerations = np.repeat(np.random.default_rng(1).normal(scale=2000.0, size=10), 12)
    state, found, expected = np.zeros(2), [], []
    mode.rest(plant.motion)
    for acceleration in accelerations:
        plant.motion.accelerations[0] = float(acceleration)
        mode.advance(plant.motion, CYCLE)

        def slope(_: float, s: np.ndarray, goal: float = acceleration * 1e-6) -> list[float]:
            return [s[1], (-8000.0 * s[1] - 30e6 * (s[0] - goal)) / 200.0]

        state = solve_ivp(slope, (0.0, CYCLE), state, rtol=1e-10, atol=1e-14).y[:, -1]
        found.append(mode.error(plant.motion))
        expected.append(state[0])
    assert np.allclose(found, expected, rtol=0.0, atol=1e-9)
    assert np.max(np.abs(np.array(found) - accelerations * 1e-6)) > 1e-3
    assert mode.beyond(plant.motion) == pytest.approx(found[-1] - accelerations[-1] * 1e-6)


@pytest.mark.parametrize("damping", [0.0, 2.0 * math.sqrt(200.0 * 30e6), 4e5])
def test_a_structure_without_or_with_much_damping_comes_to_its_static_value(damping: float) -> None:
    mode = memory.Swinging(lambda _: 2.0, lambda _: 2.0, {"mass": 200.0, "stiffness": 30.0, "damping": damping})
    way, motion = [], plant_of(axis()).motion
    for _ in range(4000):
        mode.advance(motion, CYCLE)
        way.append(mode.state[0])
    assert np.mean(way[-1000:]) == pytest.approx(2.0, abs=0.02)
    assert max(way) <= (4.0 if damping == 0.0 else 2.0) + 1e-6


def test_an_axis_grows_with_what_its_friction_turns_into_heat() -> None:
    thermal = {"coefficient": 11.5, "origin": -100.0, "time_constant": 2.0, "heating": 0.05, "start": 0.5}
    warm, cold = plant_of(axis(errors={"thermal": thermal})), plant_of(axis())
    for drive, other in zip(*(follow(p, (0.1 * np.arange(4000)).tolist()) for p in (warm, cold)), strict=True):
        assert drive.position == other.position
    # 100 mm/s against 250 N and 0.5 N per mm/s: 30 W, after 4 s from 0.5 K towards 1.5 K.
    rise = 1.5 - math.exp(-4.0 / 2.0)
    assert warm.true[0] - cold.true[0] == pytest.approx(11.5e-6 * rise * (warm.measured[0] + 100.0), rel=0.01)
    assert warm.beyond[0] == pytest.approx(warm.true[0] - cold.true[0])


def test_play_keeps_the_slide_behind() -> None:
    plant = plant_of(axis(errors={"backlash": 8.0}))
    plant.rest_at([0.0], [1.0])
    assert plant.true[0] == pytest.approx(-0.004)
    slide, behind = -0.004, []
    for drive in follow(plant, np.concatenate([np.linspace(0, 1, 500), np.linspace(1, 0, 500)]).tolist()):
        slide = min(max(slide, drive.position - 0.004), drive.position + 0.004)
        behind.append(plant.true[0] - slide)
    # Within a cycle the drive may go to and fro by less than this.
    assert np.max(np.abs(behind)) < 1e-5


def test_without_memory_it_is_what_tables_hold() -> None:
    description = json.loads((models() / "three_axis" / "plant.json").read_text())
    plain = Plant({**description, "choice": MEMORYLESS})
    setpoints = [[5.0 * math.sin(0.02 * k), 3.0 * math.cos(0.02 * k), 0.0] for k in range(200)]
    whole = Plant(description)
    for plant in (plain, whole):
        plant.rest_at(setpoints[0])
        for row in setpoints:
            plant.step(row, [0.0] * 3, CYCLE)
    assert plain.beyond == [0.0] * 3
    assert min(map(abs, whole.beyond[:2])) > 1e-5
    assert whole.remembers
    assert not plain.remembers


def test_a_seed_draws_the_parameters_and_nothing_else() -> None:
    def drawn(seed: int) -> tuple[float, ...]:
        plant = load_plant(models() / "three_axis", seed=seed)
        return tuple(float(d.friction.stiffness) for d in plant.drives if hasattr(d.friction, "stiffness"))

    assert drawn(1) == drawn(1) != drawn(2)
    limits = np.array([[300.0, 420.0, 220.0]]) * 1e3 / np.array([[180.0, 260.0, 140.0]]) / np.array([[0.03], [0.005]])
    for seed in range(20):
        assert np.all((limits[0] < drawn(seed)) & (np.array(drawn(seed)) < limits[1]))
    plants = [load_plant(models() / "three_axis", seed=seed, choice=MEMORYLESS) for seed in (1, 2)]
    for plant in plants:
        plant.rest_at([10.0, -20.0, -30.0])
    assert plants[0].true == plants[1].true


def test_all_of_it_goes_on_from_a_saved_state_with_the_same_bits() -> None:
    plant = load_plant(models() / "three_axis")
    rows = np.random.default_rng(2).normal(scale=0.01, size=(100, 3)).cumsum(axis=0).tolist()
    plant.rest_at(rows[0])
    for row in rows[:50]:
        plant.step(row, [0.0] * 3, CYCLE)
    saved = plant.state
    ends = []
    for _ in range(2):
        plant.state = saved
        for row in rows[50:]:
            plant.step(row, [0.0] * 3, CYCLE)
        ends.append((plant.state, plant.true, plant.beyond))
    assert ends[0] == ends[1]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"friction": {"model": "dahl"}}, "dahl"),
        ({"friction": {**LUGRE, "presliding": 0.0}}, "presliding"),
        ({"friction": {"model": "lugre"}}, "presliding' is missing"),
        ({"friction": {**LUGRE, "asymmetry": 1.5}}, "asymmetry"),
        ({"errors": {"thermal": {"time_constant": 0.0}}}, "ZeroDivisionError"),
    ],
)
def test_what_is_wrong_is_named_with_its_axis(change: dict[str, Any], words: str) -> None:
    with pytest.raises(PlantError, match=f"axis X: .*{words}"):
        plant_of(axis(**change))
    with pytest.raises(PlantError, match="remembering or memoryless, not 'both'"):
        Plant({"sub_step": 1e-3, "axes": [], "choice": "both"})
