"""``models/warm_axis`` against the formulas of temperature and backlash compensation (semantics §12, §13)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

from axcomp.demo.examples import EXPECTED, INPUT, read_csv
from axcomp.lists import read_machine
from axcomp.model import models

Array = npt.NDArray[np.float64]

MODEL = models() / "warm_axis"
CYCLE = 0.001
ATOL = 2e-9
"""Both files are rounded to 1e-9 mm."""


@pytest.fixture(scope="module")
def given() -> dict[str, Array]:
    """Inputs of each cycle; that of the last row is not run."""
    return {name: column[:-1] for name, column in read_csv(MODEL / INPUT).items()}


@pytest.fixture(scope="module")
def expected() -> dict[str, Array]:
    """Outputs that belong to the inputs of the same row."""
    return {name: column[1:] for name, column in read_csv(MODEL / EXPECTED).items()}


def sin2(step: Array, cycles: int) -> Array:
    return np.asarray(np.sin(0.5 * np.pi * step / cycles) ** 2)


def last_direction(position: Array, velocity: Array) -> Array:
    """Sign of the last motion, 0 before any; what is below 1e-9 mm a cycle is no motion."""
    way = velocity * CYCLE
    change = np.diff(position, prepend=position[0])
    sign = np.where(np.abs(way) >= 1e-9, np.sign(way), np.where(np.abs(change) >= 1e-9, np.sign(change), 0.0))
    last = np.maximum.accumulate(np.where(sign != 0.0, np.arange(len(sign)), -1))
    return np.where(last < 0, 0.0, sign[last])


def way_back(towards: npt.NDArray[np.bool_], cycles: int) -> Array:
    """Steps of a reversal: one up a cycle while ``towards``, else one down, between 0 and ``cycles``."""
    steps, step = [], 0
    for up in towards.tolist():
        step = min(step + 1, cycles) if up else max(step - 1, 0)
        steps.append(float(step))
    return np.array(steps)


def temperature(given: dict[str, Array]) -> Array:
    """offset + coefficient · (s − 20 mm); after a change the difference runs out by sin² over 15 cycles."""
    offset, coefficient = 0.0015 + given["X.temperature.offset"], 12e-6 + given["X.temperature.coefficient"]
    value = offset + coefficient * (given["X.setpoint"] - 20.0)
    for change in np.flatnonzero((np.diff(offset) != 0.0) | (np.diff(coefficient) != 0.0)) + 1:
        left = np.arange(14.0, -1.0, -1.0)
        value[change : change + 15] += (value[change - 1] - value[change]) * sin2(left, 15)
    return value


def test_there_is_nothing_to_say_about_its_lists_and_all_of_them_act() -> None:
    reading = read_machine(MODEL)
    assert reading.findings == ()
    acting = {axis.name: [one.kind for one in axis.compensations] for axis in reading.machine.axes}
    assert acting == {"X": ["temperature", "leadscrew", "backlash"], "Y": ["backlash"]}


def test_offset_and_coefficient_start_as_listed_and_change_once_each(given: dict[str, Array]) -> None:
    assert (given["X.temperature.offset"][0], given["X.temperature.coefficient"][0]) == (0.0, 0.0)
    (warmer,) = np.flatnonzero(np.diff(given["X.temperature.offset"])) + 1
    (grown,) = np.flatnonzero(np.diff(given["X.temperature.coefficient"])) + 1
    position = given["X.setpoint"]
    assert np.ptp(position[warmer - 1 : warmer + 15]) == 0.0
    assert position[grown - 1] == position[grown] != position[grown + 14]


def test_expected_temperature_correction_is_the_line_and_its_changes_run_out_over_15_cycles(
    given: dict[str, Array], expected: dict[str, Array]
) -> None:
    correction = expected["X.temperature.correction"]
    np.testing.assert_allclose(correction, temperature(given), rtol=0.0, atol=ATOL)
    assert np.max(np.abs(np.diff(correction))) < 0.5e-3
    assert np.ptp(correction) > 4e-3


def test_expected_backlash_of_mode_1_is_added_after_negative_motion(
    given: dict[str, Array], expected: dict[str, Array]
) -> None:
    direction = last_direction(given["X.setpoint"], given["X.velocity"])
    correction = -0.008 * sin2(way_back(direction < 0.0, 10), 10)
    np.testing.assert_allclose(expected["X.backlash.correction"], correction, rtol=0.0, atol=ATOL)
    assert set(direction) == {-1.0, 0.0, 1.0}
    assert np.min(correction) == -0.008


def test_expected_backlash_of_mode_2_is_added_after_positive_motion_and_turns_round_midway(
    given: dict[str, Array], expected: dict[str, Array]
) -> None:
    direction = last_direction(given["Y.setpoint"], given["Y.velocity"])
    steps = way_back(direction > 0.0, 20)
    np.testing.assert_allclose(expected["Y.backlash.correction"], 0.012 * sin2(steps, 20), rtol=0.0, atol=ATOL)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(steps)))) + 1
    assert np.any((steps[turns] > 0.0) & (steps[turns] < 20.0))


def test_the_leadscrew_looks_up_with_the_temperature_and_without_the_backlash(
    given: dict[str, Array], expected: dict[str, Array]
) -> None:
    position = given["X.setpoint"] + temperature(given)
    pitch = -np.interp(position, [90.0, 115.0, 140.0, 165.0, 190.0], [0.0, 0.0024, 0.0061, 0.0055, -0.0018])
    np.testing.assert_allclose(expected["X.leadscrew.correction"], pitch, rtol=0.0, atol=ATOL)
    parts = sum(expected[f"X.{kind}.correction"] for kind in ("temperature", "leadscrew", "backlash"))
    np.testing.assert_allclose(expected["X.correction"], parts, rtol=0.0, atol=ATOL)
    corrected = given["X.setpoint"] + expected["X.correction"]
    np.testing.assert_allclose(expected["X.corrected_setpoint"], corrected, rtol=0.0, atol=ATOL)
