"""The trials are fair: axes stand where they are read, and are compared with the drives' own reference."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from axcomp.demo import Outcome, Trial, table, trials_of
from axcomp.engine import Setpoints
from axcomp.kinds import KIND_NAMES
from axcomp.lists import read_machine
from axcomp.model import models
from axcomp.plant import load_plant

CYCLE = 0.001
TRIED = ("cross", "plane", "crosstalk", "leadscrew", "friction")


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return trials_of(read_machine(models() / "three_axis").machine, CYCLE)


def test_every_compensation_of_every_axis_is_tried(trials: list[Trial]) -> None:
    machine = read_machine(models() / "three_axis").machine
    tried = {(axis, trial.kind) for trial in trials for axis in trial.watched if trial.kind != "all"}
    assert tried == {(axis.name, kind) for axis in machine.axes for kind in (one.kind for one in axis.compensations)}


def test_only_the_kind_of_the_trial_is_off(trials: list[Trial]) -> None:
    assert {trial.kind: trial.off for trial in trials} == {**{kind: (kind,) for kind in TRIED}, "all": KIND_NAMES}


def test_positions_are_read_at_standstill(trials: list[Trial]) -> None:
    for trial in trials:
        if trial.kind in ("leadscrew", "all", "cross", "plane"):
            for axis, cycles in trial.watched.items():
                position = trial.setpoints[axis].position
                assert all(np.ptp(position[cycle - 50 : cycle + 1]) == 0.0 for cycle in cycles)


def test_the_slave_comes_from_the_same_side_each_time(trials: list[Trial]) -> None:
    for trial in trials:
        if trial.kind in ("cross", "plane"):
            for axis, cycles in trial.watched.items():
                velocity = trial.setpoints[axis].velocity
                assert all(velocity[: cycle + 1][velocity[: cycle + 1] != 0.0][-1] > 0.0 for cycle in cycles)


def test_accelerations_of_the_crosstalk_trial_stay_within_those_tested(trials: list[Trial]) -> None:
    for trial in trials:
        if trial.kind == "crosstalk":
            most = max(np.max(np.abs(commands.acceleration)) for commands in trial.setpoints.values())
            assert 1500.0 < most < 2500.0


def test_the_place_to_be_at_is_the_drives_reference_in_the_coupled_fmus() -> None:
    positions = np.random.default_rng(4).normal(size=30).cumsum()
    trial = Trial("leadscrew", {"X": Setpoints.through(positions, CYCLE)}, {"X": np.arange(30)})
    plant: Any = load_plant(models() / "three_axis", choice="memoryless")
    plant.rest_at([positions[0], 0.0, 0.0])
    references = []
    put_out = positions[0]
    for position in positions:
        plant.step([float(put_out), 0.0, 0.0], [0.0, 0.0, 0.0], CYCLE)
        put_out = position  # what the compensation makes of it reaches the plant in the next step
        references.append(plant.drives[0].reference)
    assert np.allclose(trial.target("X"), references, rtol=0.0, atol=1e-12)


def outcome(kind: str, without: np.ndarray, compensated: np.ndarray) -> Outcome:
    angle = np.linspace(0.0, 4.0 * np.pi, 4000)
    trial = Trial(kind, {"X": Setpoints.through(np.cos(angle), CYCLE)}, {})
    return Outcome(trial, "X", "µm", np.arange(1000, 3000), without, compensated, 0.25)


def test_the_largest_error_counts_whatever_its_sign() -> None:
    error = np.zeros(2000)
    error[17] = -8.0
    result = outcome("plane", error, 0.05 * error)
    assert result.largest == (8.0, 0.4)
    assert result.ratio == pytest.approx(0.05)


def test_a_reversal_peak_is_measured_above_what_surrounds_it() -> None:
    # X reverses at 2π, cycle 2000: a peak of 6 on a slope, and a constant error that is no peak.
    cycles = np.arange(1000, 3000)
    peak = 6.0 * np.exp(-(((cycles - 2030) / 8.0) ** 2))
    slope = 3.0 + 0.001 * (cycles - 2000)
    result = outcome("friction", slope + peak, slope + 0.1 * peak)
    assert result.largest == (pytest.approx(6.0, rel=0.01), pytest.approx(0.6, rel=0.01))


def test_the_table_says_what_is_left() -> None:
    text = table([outcome("crosstalk", np.full(2000, 4.0), np.full(2000, 0.1))])
    head, _, row = text.splitlines()
    assert head.split() == ["axis", "compensation", "without", "with", "left", "following", "error"]
    assert row.split() == ["X", "crosstalk", "4.00", "0.10", "µm", "2.5", "%", "0.25"]
