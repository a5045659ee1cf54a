"""Outliers: injected ones are found, clean tables are not flagged."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from judging import codes, cross_machine, judge, leadscrew_machine, plane_machine, table_of_c

from axcomp.analysis.judgement import spikes
from axcomp.demo.examples import TRAJECTORIES
from axcomp.lists import read_machine, write_machine
from axcomp.model import models

WAVE = st.tuples(st.floats(0.0, 0.05), st.floats(8.0, 200.0), st.floats(0.0, 6.3))
"""Amplitude in mm, wavelength in points, phase."""


@st.composite
def clean(draw):
    """Draw a table as a good measurement leaves it: waves over at least eight points, a slope, rounded to 0.1 µm."""
    n = draw(st.integers(11, 150))
    index = np.arange(n)
    values = draw(st.floats(-1e-3, 1e-3)) * index
    for amplitude, length, phase in draw(st.lists(WAVE, max_size=3)):
        values = values + amplitude * np.sin(2.0 * np.pi * index / length + phase)
    gaps = np.array(draw(st.lists(st.floats(8.0, 12.0), min_size=n - 1, max_size=n - 1)))
    return np.concatenate([[0.0], np.cumsum(gaps)]), np.round(values, 4)


@given(clean())
def test_clean_tables_are_not_flagged(table) -> None:
    assert codes(leadscrew_machine(*table)) == []


@given(st.integers(0, 2**32 - 1), st.integers(12, 300), st.floats(1e-4, 3e-3))
def test_scatter_is_not_flagged(seed: int, n: int, sigma: float) -> None:
    assert codes(leadscrew_machine(10.0 * np.arange(n), np.random.default_rng(seed).uniform(-sigma, sigma, n))) == []


@given(st.integers(-50, 50), st.integers(1, 40), st.integers(1, 20))
def test_kinks_and_steps_are_no_outliers(height: int, flat: int, ramp: int) -> None:
    values = np.concatenate([np.zeros(flat), 1e-3 * height * np.arange(ramp), np.full(12, 1e-3 * height * ramp)])
    assert codes(leadscrew_machine(10.0 * np.arange(len(values)), values)) == []


@settings(max_examples=60)
@given(clean(), st.data())
def test_an_injected_outlier_is_found_and_nothing_else(table, data) -> None:
    x, y = table
    at = data.draw(st.integers(2, len(x) - 3))
    # Beyond what the curve itself does within two points, and beyond six times its ordinary distances (1.48 · median)
    # from the lines through its neighbours, which are not in the middle where the points are not equidistant.
    lines = [np.interp(x[k], x[[k - 1, k + 1]], y[[k - 1, k + 1]]) for k in range(1, len(x) - 1)]
    own = max(np.abs(np.diff(y, 2)).max(), np.abs(y[1:-1] - lines).max())
    least = 10.0 * float(own) + 0.005
    size = data.draw(st.sampled_from([-1.0, 1.0])) * data.draw(st.floats(least, 3.0 * least))
    y = y.copy()
    y[at] += size
    found = spikes(x, y)
    assert np.flatnonzero(found.found).tolist() == [at]
    assert found.distance[at] == pytest.approx(size, abs=least / 5)


def test_the_shortest_table_that_is_judged_has_eleven_points() -> None:
    x, y = 10.0 * np.arange(11.0), np.zeros(11)
    y[3] = 0.008
    assert np.flatnonzero(spikes(x, y).found).tolist() == [3]
    assert not spikes(x[:-1], y[:-1]).found.any()


@settings(max_examples=40)
@given(st.integers(0, 35), st.floats(0.02, 0.1))
def test_a_modulo_table_has_neighbours_over_its_seam(at: int, size: float) -> None:
    x = 10.0 * np.arange(36.0)
    y = 0.01 * np.sin(np.radians(x))
    assert codes(table_of_c(x, y)) == []
    y[at] += size
    assert codes(table_of_c(x, y)).count("AXC-OUTLIER") == 1


@settings(max_examples=40)
@given(st.integers(0, 11), st.integers(0, 14), st.data())
def test_a_point_of_a_plane_is_compared_along_both_sides(row: int, column: int, data) -> None:
    up, across = np.meshgrid(np.arange(12.0), np.arange(15.0), indexing="ij")
    values = 0.02 * np.sin(across / 4) + 1e-3 * up**1.5
    assert codes(plane_machine(values)) == []
    assume(2 <= row <= 9 or 2 <= column <= 12)
    values[row, column] += data.draw(st.floats(0.05, 0.3)) * data.draw(st.sampled_from([-1, 1]))
    judgement = judge(plane_machine(values))
    [finding] = judgement.findings
    assert finding.parameter == f"kw.crosscomp2.table[{row}][{column}].correction"
    assert f"Y = {10 * column} mm, Z = {20 * row} mm" in finding.message


def test_the_finding_names_file_line_and_figures_by_hand(tmp_path: Path) -> None:
    y = np.full(12, 0.004)
    y[5] = -0.004
    write_machine(cross_machine(10.0 * np.arange(12), y), tmp_path)
    reading = read_machine(tmp_path)
    [finding] = judge(reading.machine, reading).findings
    assert finding.message == (
        "The value -4.0 µm at 50 mm is -8.0 µm off its neighbours, where ±0.1 µm is ordinary in the cross table of X "
        "over Y."
    )
    lines = Path(finding.file).read_text(encoding="utf-8").split("\n")
    assert lines[finding.line - 1].split() == ["kw.crosscomp.table[5].correction", "-40"]


def test_values_are_named_as_they_stand_in_a_leadscrew_list() -> None:
    y = np.full(12, 0.004)
    y[5] = 0.014
    [finding] = judge(leadscrew_machine(10.0 * np.arange(12), y)).findings
    assert "value 14.0 µm at 50 mm is +10.0 µm off" in finding.message
    assert finding.parameter == "kw.ssfk.table[5].pos"


@pytest.mark.parametrize("model", sorted(TRAJECTORIES))
def test_the_examples_have_nothing_to_be_judged(model: str) -> None:
    assert codes(read_machine(models() / model).machine, models() / model) == []
