"""The trials of the tool tip: where it is looked at, and how its error comes out of what is recorded."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from axcomp.demo import TCP, VOLUMETRIC, Trace, Trial, label, outcomes, table, trials_of, volumetric_trials
from axcomp.lists import read_machine
from axcomp.model import Machine, models

CYCLE = 0.001


@pytest.fixture(scope="module")
def machine() -> Machine:
    return read_machine(models() / "five_axis").machine


@pytest.fixture(scope="module")
def trials(machine: Machine) -> list[Trial]:
    return list(volumetric_trials(machine, CYCLE))


def test_there_are_a_diagonal_and_a_motion_of_each_rotary_axis(trials: list[Trial]) -> None:
    assert [trial.moving for trial in trials] == [("X", "Y", "Z"), ("B",), ("C",)]
    assert [label(trial) for trial in trials] == [
        "volumetric (diagonal)",
        "volumetric (swing of B)",
        "volumetric (turn of C)",
    ]


def test_a_machine_without_volumetric_compensation_has_none(machine: Machine) -> None:
    assert list(volumetric_trials(replace(machine, volumetric=()), CYCLE)) == []


def test_all_volumetric_compensations_are_off_without_and_in_the_trials_of_the_axes_always(trials: list[Trial]) -> None:
    assert {(trial.off, trial.never_on) for trial in trials} == {((VOLUMETRIC,), ())}
    others = trials_of(read_machine(models() / "rotary_table").machine, CYCLE)
    assert {trial.never_on for trial in others} == {(VOLUMETRIC,)}
    assert all(VOLUMETRIC not in trial.off for trial in others)


def test_the_tip_is_looked_at_where_all_axes_stand_and_the_tables_know_them(trials: list[Trial]) -> None:
    low = {"X": -300.0, "Y": -250.0, "Z": -400.0, "B": -100.0, "C": 0.0}
    high = {"X": 300.0, "Y": 250.0, "Z": 0.0, "B": 100.0, "C": 360.0}
    for trial in trials:
        cycles = trial.watched[TCP]
        for name, setpoints in trial.setpoints.items():
            assert all(np.ptp(setpoints.position[cycle - 190 : cycle + 1]) == 0.0 for cycle in cycles)
            places = setpoints.position[cycles]
            share = (places - low[name]) / (high[name] - low[name])
            assert np.all((share > 0.0) & (share < 1.02))
            assert np.ptp(share) == 0.0 or np.ptp(share) > 0.9
            assert (np.ptp(share) > 0.0) == (name in trial.moving)


def test_a_full_turn_ends_where_it_began(trials: list[Trial]) -> None:
    turn = trials[-1]
    places = turn.setpoints["C"].position[turn.watched[TCP]]
    assert places[-1] - places[0] == pytest.approx(360.0)


def test_the_error_of_the_tip_has_components_and_a_length(machine: Machine, trials: list[Trial]) -> None:
    turn = trials[-1]
    cycles = len(turn.setpoints["C"].position)
    still = {axis.name: np.full(cycles, 2e-4) for axis in machine.axes}
    tip = np.tile([0.003, -0.004, 0.0], (cycles, 1))
    found = list(outcomes(machine, [turn], [(Trace(still, still, still, tip), Trace(still, still, still, 0.1 * tip))]))
    assert [result.axis for result in found] == ["TCP x", "TCP y", "TCP z", "TCP"]
    assert [result.largest[0] for result in found] == [pytest.approx(value) for value in (3.0, 4.0, 0.0, 5.0)]
    assert found[3].ratio == pytest.approx(0.1)
    assert [result.following_error for result in found] == [pytest.approx(0.2)] * 4
    assert "TCP    volumetric (turn of C)     5.00  0.50  µm  10.0 %" in table(found)
