"""The errors measured on the plant are those it is described with, and leave nothing else of it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from axcomp.model import models
from axcomp.plant import IsoErrors, Plant, curves, linear_axis_errors, load_plant, table_errors

MODEL = models() / "five_axis"
TARGETS = np.linspace(-200.0, 0.0, 9)
ANGLES = np.linspace(0.0, 360.0, 19)
CENTERS = {"B": (0.0, 0.0, -450.0), "C": (0.0, 0.0, -400.0)}
NANOMETRE, NANORADIAN = 1e-6, 1e-9


@pytest.fixture(scope="module")
def plant() -> Plant:
    return load_plant(MODEL)


@pytest.fixture(scope="module")
def described() -> dict[str, Any]:
    """Description of each joint in the file, by the name of its axis."""
    joints: dict[str, Any] = json.loads((MODEL / "plant.json").read_text(encoding="utf-8"))["rigid_bodies"]["axes"]
    return joints


def motion(joint: dict[str, Any], positions: np.ndarray) -> np.ndarray:
    """Shifts in mm and turns in rad, shape (positions, 6), from the coefficients."""
    made = [curves.Curve(joint["motion"][name]) for name in "xyzabc"]
    values = np.array([[curve(q) - curve(0.0) for curve in made] for q in positions])
    return values * ([1e-3] * 3 + [1e-6] * 3)


def total(letter: str, errors: IsoErrors, name: str) -> np.ndarray:
    """Component and position error together."""
    return np.array(errors.component[f"E{name}{letter}"]) + errors.position.get(f"{name}0{letter}", 0.0)


@pytest.mark.parametrize("letter", ["X", "Y", "Z"])
def test_a_slide_has_the_errors_of_its_joint(letter: str, plant: Plant, described: dict[str, Any]) -> None:
    joint = described[letter]
    errors = linear_axis_errors(plant, letter, TARGETS.tolist())
    given = motion(joint, TARGETS)
    along = np.array(joint["direction"])
    # What is straightness and what squareness is a matter of convention; together they are the way of the slide.
    tilt = [errors.position.get(f"{k}0{letter}", 0.0) for k in "ABC"]
    measured = np.column_stack([errors.component[f"E{k}{letter}"] for k in "XYZ"])
    measured += np.outer(TARGETS, Rotation.from_euler("xyz", tilt).apply(along) - along)
    expected = given[:, :3] + np.outer(
        TARGETS, Rotation.from_rotvec(np.multiply(1e-6, joint["tilt"])).apply(along) - along
    )
    assert np.allclose(measured, expected, rtol=0.0, atol=NANOMETRE)
    for place, k in enumerate("ABC", start=3):
        assert np.allclose(errors.component[f"E{k}{letter}"], given[:, place], rtol=0.0, atol=NANORADIAN)


@pytest.mark.parametrize("letter", ["X", "Y", "Z"])
def test_what_is_left_of_the_straightness_has_no_slope(letter: str, plant: Plant) -> None:
    errors = linear_axis_errors(plant, letter, TARGETS.tolist())
    assert len(errors.position) == 2
    for k in set("XYZ") - {letter}:
        assert np.polyfit(TARGETS, errors.component[f"E{k}{letter}"], 1)[0] == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("letter", ["B", "C"])
def test_a_table_wobbles_as_its_displaced_axis_makes_it(letter: str, plant: Plant, described: dict[str, Any]) -> None:
    joint = described[letter]
    errors = table_errors(plant, letter, CENTERS[letter], ANGLES.tolist(), {"X": 40.0, "Z": -250.0})
    given = motion(joint, ANGLES)
    offset, tilt = 1e-3 * np.array(joint["offset"]), 1e-6 * np.array(joint["tilt"])
    for q, row, place in zip(ANGLES, given, range(len(ANGLES)), strict=True):
        turn = Rotation.from_rotvec(np.radians(q) * np.array(joint["direction"]))
        # Turning about an axis that lies beside: what is carried is off by (1 − R)·displacement, 0 where it began.
        expected = np.concatenate([row[:3] + offset - turn.apply(offset), row[3:] + tilt - turn.apply(tilt)])
        measured = np.array([total(letter, errors, name)[place] for name in "XYZABC"])
        # The errors act about the machine's origin; this is what they do to the centre.
        measured[:3] += Rotation.from_euler("xyz", measured[3:]).apply(CENTERS[letter]) - CENTERS[letter]
        assert np.allclose(measured, expected, rtol=0.0, atol=[2 * NANOMETRE] * 3 + [5 * NANORADIAN] * 3)


def test_offset_and_tilt_are_the_means_over_the_turn(plant: Plant) -> None:
    errors = table_errors(plant, "C", CENTERS["C"], ANGLES.tolist(), {"Z": -250.0})
    assert set(errors.position) == {"X0C", "Y0C", "A0C", "B0C"}
    for name in errors.position:
        assert np.mean(errors.component[f"E{name[0]}C"][:-1]) == pytest.approx(0.0, abs=1e-12)


def test_where_the_other_axes_stand_does_not_matter_to_a_table(plant: Plant) -> None:
    near, far = (
        table_errors(plant, "B", CENTERS["B"], [-60.0, 0.0, 75.0], at)
        for at in ({}, {"X": 250.0, "Y": -200.0, "Z": -380.0})
    )
    for name, values in near.component.items():
        assert np.allclose(values, far.component[name], rtol=0.0, atol=1e-10)
