"""Friction parameters tuned on a circular test: plants that were not seen have the peaks that were predicted."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest

from axcomp.cli import main
from axcomp.engine import Engine
from axcomp.fit import plant_description, tune_on_circle
from axcomp.lists import read_machine
from axcomp.measurement import CircularPath, CircularTest, evaluate_circular
from axcomp.model import Axis, Machine, models
from axcomp.plant import circle_setpoints, circular_test, load_plant

MODEL = models() / "three_axis"
AXES, RADIUS, FEED = ("X", "Y"), 25.0, 50.0


def measured(plant, frictions=None, seed=0, noise=0.05):
    """A grid encoder on a circle in both directions, µm of noise, with or without friction compensation."""
    random, paths = np.random.default_rng(seed), []
    for direction in (1, -1):
        setpoints, currents = circle_setpoints(AXES, RADIUS, FEED, direction), None
        if frictions:
            engine = Engine(Machine(tuple(Axis(n, name, friction=frictions[name]) for n, name in enumerate(AXES, 1))))
            names = {"setpoint": "position", "velocity": "velocity", "acceleration": "acceleration"}
            found = engine.run({f"{a}.{n}": getattr(setpoints[a], of) for a in AXES for n, of in names.items()})
            currents = {axis: np.asarray(found[f"{axis}.current"]) for axis in AXES}
        points = circular_test(plant, AXES, RADIUS, FEED, direction, currents)
        paths.append(CircularPath(direction, points + random.normal(0.0, noise * 1e-3, points.shape), "simulated"))
    return evaluate_circular(CircularTest(tuple(paths), RADIUS, FEED, AXES))


def frictions():
    return {axis.name: axis.friction for axis in read_machine(MODEL).machine.axes}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [31, 32, 33, 34])
def test_predicted_and_simulated_peaks_of_held_out_plants_agree_within_15_percent(seed):
    """The plant that is tuned on has the parameters of seed 0: what it learns of this one is its circle."""
    plant = load_plant(MODEL, seed=seed)
    before = measured(plant)
    tuned = tune_on_circle(before, plant_description(MODEL / "plant.json"), frictions())
    after = measured(plant, {one.axis: one.tuned.friction for one in tuned}, seed=1)
    listed = measured(plant, frictions(), seed=2)
    for one in tuned:
        for result, peaks in ((before, one.tuned.without), (listed, one.tuned.before), (after, one.tuned.left)):
            simulated = max(abs(result.peak(f"{sign}{one.axis}")) for sign in "+-")
            assert peaks.largest == pytest.approx(simulated, rel=0.15), one.axis
        assert one.tuned.left.largest < 0.7 * min(one.tuned.without.largest, one.tuned.before.largest)


def test_the_friction_of_an_unseen_plant_is_found_on_its_circle():
    plant = load_plant(MODEL, seed=40)
    (one,) = tune_on_circle(measured(plant), plant_description(MODEL / "plant.json"), {"Y": frictions()["Y"]})
    friction = plant.drives[1].friction
    assert one.presliding == pytest.approx(friction.coulomb / friction.stiffness, rel=0.15)
    assert one.asymmetry == pytest.approx(friction.forward - 1.0, abs=0.03)
    assert one.level == pytest.approx(1.0, abs=0.05)
    assert one.left < 0.15
    assert one.play < 0.5


def test_the_command_predicts_and_writes(tmp_path, capsys):
    lists = tmp_path / "m"
    shutil.copytree(MODEL, lists)
    file = tmp_path / "circle.csv"
    rows = [
        f"{x:.7f},{y:.7f},{'+' if path.direction > 0 else '-'}"
        for path in measured(load_plant(MODEL, seed=41)).test.paths
        for x, y in path.points
    ]
    file.write_text("# radius: 25\n# feed: 3000\nx,y,direction\n" + "\n".join(rows) + "\n")
    before = (lists / "achskw2.lis").read_text()
    words = ["fit", str(file), "--machine", str(lists)]
    assert main([*words, "--format", "json"]) == 0
    found = {one["axis"]: one for one in json.loads(capsys.readouterr().out)}
    assert set(found) == {"X", "Y"}
    assert (lists / "achskw2.lis").read_text() == before
    assert main([*words, "--write"]) == 0
    assert "predicted as tuned" in capsys.readouterr().out
    after = read_machine(lists, strict=True).machine
    for name, one in found.items():
        friction = after.axis(name).friction
        assert one["parameters"] == {key: getattr(friction, key) for key in one["parameters"]}
        assert friction.currents == frictions()[name].currents
    changed = [line for line in (lists / "achskw2.lis").read_text().splitlines() if line not in before.splitlines()]
    assert all(line.startswith("frict_comp.") for line in changed)


@pytest.mark.parametrize(
    ("header", "words", "said"),
    [
        ("# radius: 25\n", [], "feed of the test is not known"),
        ("# radius: 25\n# feed: 3000\n# plane: AB\n", [], "neither A nor B has a friction compensation"),
        ("# radius: 25\n# feed: 3000\n", ["--plant", "nowhere.json"], "nowhere.json"),
    ],
)
def test_what_cannot_be_tuned_is_refused_with_a_sentence(header, words, said, tmp_path, capsys):
    angles = np.radians(np.arange(0.0, 450.0, 0.5))
    rows = "\n".join(f"{25 * np.cos(a):.6f},{25 * np.sin(a):.6f}" for a in angles)
    (tmp_path / "c.csv").write_text(f"{header}x,y\n{rows}\n")
    assert main(["fit", str(tmp_path / "c.csv"), "--machine", str(MODEL), *words]) == 1
    error = capsys.readouterr().err
    assert said in error
    assert "Traceback" not in error
