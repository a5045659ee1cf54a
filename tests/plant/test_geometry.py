"""Geometric errors: the formulas against NumPy and by hand, and their frame: true = measured + error."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from planting import axis, plant_of

from axcomp.plant import Plant, PlantError, curves

QUADRATIC = {"origin": 10.0, "scale": 50.0, "polynomial": [1.0, -2.0, 3.0]}
WAVE = {"waves": [{"amplitude": 4.0, "period": 80.0, "phase": 30.0}]}


def test_a_curve_is_a_polynomial_and_sines() -> None:
    curve = curves.Curve({**QUADRATIC, **WAVE})
    q = np.linspace(-100.0, 100.0, 41)
    expected = np.polynomial.Polynomial([1.0, -2.0, 3.0])((q - 10.0) / 50.0)
    expected += 4.0 * np.sin(2.0 * np.pi * q / 80.0 + np.radians(30.0))
    assert np.allclose([curve(x) for x in q], expected, rtol=1e-13)


def test_a_surface_is_a_sum_of_products() -> None:
    surface = curves.Surface([{"first": QUADRATIC, "second": WAVE}, {"first": WAVE, "second": QUADRATIC}])
    a, b = curves.Curve(QUADRATIC), curves.Curve(WAVE)
    assert surface(7.0, -3.0) == pytest.approx(a(7.0) * b(-3.0) + b(7.0) * a(-3.0))


def test_the_pitch_error_in_um_is_added_to_the_measured_position() -> None:
    plant = plant_of(axis(errors={"pitch": {"positive": QUADRATIC}}))
    plant.rest_at([60.0])
    assert plant.measured == [60.0]
    assert plant.true == [pytest.approx(60.0 + 1e-3 * (1.0 - 2.0 + 3.0))]


def test_each_direction_has_its_own_curve_and_the_play_fades_between_them() -> None:
    pitch = {"lost_motion": 0.02, "positive": {"polynomial": [2.0]}, "negative": {"polynomial": [10.0]}}
    plant = plant_of(axis(errors={"pitch": pitch}))
    plant.rest_at([0.0], [-1.0])
    assert plant.true[0] == pytest.approx(0.010)
    errors = plant.errors[0]
    assert [errors.take_up(-1.0, way) for way in (0.005, 0.01, 0.02, 1.0)] == pytest.approx([-0.5, 0.0, 1.0, 1.0])
    assert errors.take_up(1.0, -0.01) == pytest.approx(0.0)
    plant.rest_at([0.0], [errors.take_up(-1.0, 0.005)])
    assert plant.true[0] == pytest.approx(0.008)


def test_sag_plane_and_crosstalk_depend_on_the_other_axes() -> None:
    errors = {
        "sag": [{"master": "Y", "curve": QUADRATIC}],
        "plane": [{"masters": ["Y", "Z"], "terms": [{"first": QUADRATIC, "second": WAVE}]}],
        "crosstalk": [
            {
                "master": "Z",
                "over": ["X", "Y"],
                "stiffening": -0.05,
                "direction": 0.1,
                "compliance": [{"first": {"polynomial": [3.0]}, "second": QUADRATIC}],
            }
        ],
    }
    plant = plant_of(axis(errors=errors), axis(name="Y"), axis(name="Z"))
    plant.rest_at([5.0, 60.0, 20.0])
    a, b = curves.Curve(QUADRATIC), curves.Curve(WAVE)
    still = a(60.0) + a(60.0) * b(20.0)
    assert plant.true[0] - 5.0 == pytest.approx(1e-3 * still, abs=1e-12)

    motion = plant.motion
    motion.velocities[2], motion.accelerations[2] = -500.0, 2000.0
    moved = 3.0 * a(60.0) * 2.0 * (1.0 - 0.05 * 4.0) * (1.0 + 0.1 * math.tanh(-500.0))
    assert plant.errors[0].error(motion) == pytest.approx(1e-3 * (still + moved))


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"friction": {"stribeck_velocity": 0.0}}, "ZeroDivisionError"),
        ({"drive": {"mass": "heavy"}}, "TypeError"),
        ({"errors": {"sag": [{"master": "Q", "curve": {}}]}}, "ValueError"),
        ({"type": "rotary"}, "inertia"),
    ],
)
def test_a_wrong_description_is_refused_and_names_the_axis(changes: dict[str, object], what: str) -> None:
    with pytest.raises(PlantError, match=rf"axis X: .*{what}"):
        plant_of(axis(**changes))


def test_an_unusable_file_is_refused_by_name(tmp_path: Path) -> None:
    for name, text in (("broken.json", "{"), ("empty.json", "{}"), ("list.json", "[]")):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        with pytest.raises(PlantError, match=name):
            Plant.from_file(path)
    with pytest.raises(PlantError, match=r"missing\.json"):
        Plant.from_file(tmp_path / "missing.json")


def test_the_description_is_read_as_it_is_written(tmp_path: Path) -> None:
    path = tmp_path / "plant.json"
    path.write_text(json.dumps({"sub_step": 1e-4, "axes": [axis(), axis(name="C", type="translatory")]}))
    assert Plant.from_file(path).names == ("X", "C")
