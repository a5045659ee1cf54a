"""Backlash and crosstalk from traces that are made here: play, lag and a swinging structure typed again."""

from __future__ import annotations

import json

import numpy as np
import pytest
from tracing import write_trace

from axcomp.cli import main

CYCLE = 0.002


def created(capsys, kind, *words):
    status = main(["create", kind, *map(str, words), "--format", "json"])
    captured = capsys.readouterr()
    assert status == 0, captured.err
    return json.loads(captured.out)


def passes(speeds, length=100.0):
    """Position of a motor that goes to and fro once at each speed."""
    pieces = [np.zeros(50)]
    for speed in speeds:
        way = np.arange(0.0, length, speed * CYCLE)
        pieces += [way, np.full(50, length), length - way, np.zeros(50)]
    return np.convolve(np.concatenate(pieces), np.ones(21) / 21.0, "valid")


def slide_of(motor, play):
    slide, behind = np.empty_like(motor), motor[0] - 0.5 * play
    for k, position in enumerate(motor):
        behind = min(max(behind, position - 0.5 * play), position + 0.5 * play)
        slide[k] = behind
    return slide


@pytest.mark.parametrize("play", [0.0065, 0.03])
def test_backlash_between_two_encoders(play, tmp_path, capsys):
    motor = passes([20.0, 20.0, 40.0])
    slide = (
        slide_of(motor, play) + 0.004 * np.sin(motor / 25.0) + np.random.default_rng(1).normal(0.0, 5e-4, len(motor))
    )
    file = write_trace(tmp_path / "t.csv", time=np.arange(len(motor)) * CYCLE, position=motor, actual=slide)
    made = created(capsys, "backlash", "--from", file, "--into", tmp_path / "a.lis", "--axis", 1)
    assert made["measured"] == pytest.approx(1e3 * play, abs=made["uncertainty"] + 0.05)
    assert made["uncertainty"] < 0.5


def test_a_following_error_is_told_from_backlash_by_its_speeds(tmp_path, capsys):
    setpoint = passes([5.0, 20.0, 60.0])
    motor = np.concatenate([np.zeros(5), setpoint[:-5]])
    slide = slide_of(motor, 0.012)
    file = write_trace(tmp_path / "t.csv", time=np.arange(len(motor)) * CYCLE, setpoint=setpoint, actual=slide)
    made = created(capsys, "backlash", "--from", file, "--into", tmp_path / "a.lis", "--axis", 1)
    assert made["measured"] == pytest.approx(12.0, abs=0.6)
    assert any("10.0" in note and "ms times the velocity" in note for note in made["notes"])
    one = setpoint[: len(passes([5.0]))]
    file = write_trace(tmp_path / "t.csv", time=np.arange(len(one)) * CYCLE, setpoint=one, actual=slide[: len(one)])
    made = created(capsys, "backlash", "--from", file, "--into", tmp_path / "a.lis", "--axis", 1)
    assert any("a following error would count as backlash" in note for note in made["notes"])


def test_a_trace_without_deviation_or_way_back_is_refused(tmp_path, capsys):
    motor = np.linspace(0.0, 50.0, 500)
    words = ["--into", str(tmp_path / "a.lis"), "--axis", "1"]
    file = write_trace(tmp_path / "t.csv", time=np.arange(500) * CYCLE, position=motor)
    assert main(["create", "backlash", "--from", str(file), *words]) == 1
    assert "There is no deviation" in capsys.readouterr().err
    file = write_trace(tmp_path / "t.csv", time=np.arange(500) * CYCLE, position=motor, actual=motor)
    assert main(["create", "backlash", "--from", str(file), *words]) == 1
    assert "in both directions" in capsys.readouterr().err


def swinging(acceleration, compliance, frequency=70.0, damping=0.08):
    """µm: a mass on a spring, in steps of a tenth of a cycle."""
    omega, x, v, found = 2.0 * np.pi * frequency, 0.0, 0.0, []
    for a in acceleration:
        for _ in range(20):
            v += (omega**2 * (compliance * a - x) - 2.0 * damping * omega * v) * CYCLE / 20.0
            x += v * CYCLE / 20.0
        found.append(x)
    return np.array(found)


def test_crosstalk_of_a_structure_that_swings(tmp_path, capsys):
    pieces = [np.zeros(100)]
    for a, sign in ((2000.0, 1), (1000.0, 1), (2000.0, -1), (1000.0, -1)) * 2:
        ramp, hold = np.linspace(0.0, sign * a, 15), np.full(80, sign * a)
        pieces += [ramp, hold, ramp[::-1], np.zeros(120), -ramp, -hold, -ramp[::-1], np.zeros(120)]
    acceleration = np.concatenate(pieces)
    velocity = np.cumsum(acceleration) * CYCLE
    deviation = swinging(acceleration, -0.004) + 2.5 + np.random.default_rng(3).normal(0.0, 0.1, len(velocity))
    file = write_trace(
        tmp_path / "t.csv", time=np.arange(len(velocity)) * CYCLE, master_velocity=velocity, **{"dev [um]": deviation}
    )
    words = ["--from", file, "--into", tmp_path / "a.lis", "--axis", 2, "--master", 1, "--map", "deviation=dev [um]"]
    made = created(capsys, "crosstalk", *words)
    assert made["figures"]["measured"]["largest"] == pytest.approx(8.0, abs=0.5)
    assert made["figures"]["predicted"]["largest"] < 0.4
    text = (tmp_path / "a.lis").read_text()
    assert "acceleration" in text
