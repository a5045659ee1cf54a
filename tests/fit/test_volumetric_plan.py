"""Plans of volumetric measurements: better than chance, and as good as they promise."""

import json
from dataclasses import replace

import numpy as np
import pytest
from simulated_machine import DISPLACEMENT, NAMES, drawn, less_rigid

from axcomp.cli import main
from axcomp.engine import TcpModel
from axcomp.fit import CannotCreateError, Identifier, plan_volumetric

VOLUME = {"X": (0.0, 600.0), "Y": (0.0, 500.0), "Z": (-400.0, 0.0)}
STATIONS = [[-200, -200, -700], [900, -300, -600], [300, 900, -650], [300, 250, -1000]]
FEW = {"X": np.linspace(0, 600, 4), "Y": np.linspace(0, 500, 4), "Z": np.linspace(-400, 0, 4)}


def planned(count, kind="displacement", **more):
    machine = drawn("YXZ", seed=1, nodes=FEW)
    options = {"stations": STATIONS, "tool_lengths": (0.0, 150.0), "errors": NAMES, "nodes": 4, **more}
    return machine, plan_volumetric(machine.described(), VOLUME, count, kind, **options)


def test_planned_lengths_tell_more_than_as_many_at_random():
    _, plan = planned(150)
    assert len(plan.readings.runs) == 150
    assert np.median(plan.uncertainty) < 0.95 * np.median(plan.random)
    assert plan.uncertainty.max() < 0.9 * plan.random.max()


def test_the_uncertainty_that_is_promised_is_that_of_the_measurement_that_is_planned():
    machine, plan = planned(200)
    readings = plan.readings
    random, left, stated = np.random.default_rng(0), [], []
    stations = np.array(STATIONS, dtype=float)[readings.stations - 1]
    exact = np.linalg.norm(machine.tips(readings.positions, readings.tool_lengths) - stations, axis=1)
    at = np.zeros((200, 6))
    for k, letter in enumerate("XYZ"):
        at[:, k] = random.uniform(*VOLUME[letter], 200)
    tools = np.full(200, 150.0)
    for _ in range(8):
        measured = np.column_stack([exact + random.normal(0.0, 1e-3, 200), np.zeros((200, 2))])
        data = replace(readings, measured=measured)
        assert (data.kinds == DISPLACEMENT).all()
        identifier = Identifier(data, machine.described(), NAMES, 4)
        found = identifier.fit()
        model = TcpModel(replace(machine.described(), errors=found.tables()))
        off = machine.tips(at, tools) - model.tips(at, tools, model.known_errors(at))
        left.append(np.linalg.norm(less_rigid(off * 1e3, at[:, :3]), axis=1))
        stated.append(identifier.tip_uncertainty(found, at, 150.0))
    assert np.median(stated) == pytest.approx(np.median(plan.uncertainty), rel=0.25)
    assert np.quantile(left, 0.95) == pytest.approx(np.median(plan.uncertainty), rel=0.4)


def test_what_was_measured_already_counts():
    _, first = planned(150)
    _, second = planned(50, measured=first.readings)
    assert np.median(second.before) == pytest.approx(np.median(first.uncertainty), rel=0.2)
    assert np.median(second.uncertainty) < np.median(second.before)


def test_no_exchange_of_single_readings_tells_more():
    """Exchanging one reading for another by hand: the determinant of J'J/s² + 1/prior² does not grow by over 1 %."""
    machine, plan = planned(40, "deviation", stations=(), errors=["EXX", "EYX", "C0Y"])
    identifier = Identifier(plan.readings, machine.described(), ["EXX", "EYX", "C0Y"], 4, 1.0)
    scaled = identifier.columns * identifier.limits * 1e3

    def log_det(blocks):
        flat = blocks.reshape(-1, blocks.shape[2])
        return np.linalg.slogdet(np.eye(flat.shape[1]) + flat.T @ flat)[1]

    best = log_det(scaled)
    for k in range(0, 40, 8):
        for other in range(0, 40, 5):
            changed = scaled.copy()
            changed[k] = scaled[other]
            assert log_det(changed) <= best + 0.05


@pytest.mark.parametrize(
    ("more", "sentence"),
    [({"stations": ()}, "need the places of their stations"), ({"count": 0}, "one reading at least")],
)
def test_what_cannot_be_planned_is_said(more, sentence):
    with pytest.raises(CannotCreateError, match=sentence):
        planned(**{"count": 10, **more})


WORDS = ["plan", "volumetric", "new.lis", "--chain", "YXZ", "--axes", "2", "1", "3", "--nodes", "4", "--count", "30"]
RANGES = ["--volume", "X=0..600", "Y=0..500", "Z=-400..0"]


def test_the_command_writes_places_that_create_takes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main([*WORDS, *RANGES, "--output", "plan.csv", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["readings"]) == 30
    assert found["tip_uncertainty"]["with these readings"]["median"] > 0.0
    header, *rows = (tmp_path / "plan.csv").read_text().splitlines()
    assert header == "x,y,z,tool_length"
    (tmp_path / "m.csv").write_text(f"{header},dx,dy,dz\n" + "\n".join(f"{row},1,2,3" for row in rows) + "\n")
    into = ["--into", "new.lis", *WORDS[3:-2]]
    assert main(["create", "volumetric", "--from", "m.csv", *into]) == 0
    capsys.readouterr()
    assert main([*WORDS, *RANGES, "--from", "m.csv"]) == 0
    assert "so far" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--volume", "X=0..600"], "where may Y, Z go"),
        (["--volume", "X=9..6"], "“X=9..6” is no range"),
        (["--volume", "X=1.2.3..6"], "is no range"),
        ([*RANGES, "--kind", "length"], "need the places of their stations"),
        ([*RANGES, "--from", "none.csv"], "none.csv: The file cannot be read"),
    ],
)
def test_faults_are_sentences(tmp_path, monkeypatch, capsys, words, sentence):
    monkeypatch.chdir(tmp_path)
    assert main([*WORDS, *words]) == 1
    assert sentence in capsys.readouterr().err
