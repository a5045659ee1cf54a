"""ISO 230-2 against a worked example, against pandas, and by what must hold for any readings."""

import json
import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings, strategies as st

from axcomp.measurement import PARAMETERS, Conditions, Positioning, evaluate

TOLERANCE = 1e-6  # µm


def measurement(rows, unit="mm"):
    """Make a measurement of rows (target, run, direction, deviation)."""
    targets, runs, directions, deviations = (np.array(column) for column in zip(*rows, strict=True))
    return Positioning(
        targets.astype(float), runs.astype(int), directions.astype(int), deviations.astype(float), unit, "X"
    )


WORKED = [
    (0.0, 1, 1, 1.0), (0.0, 2, 1, 3.0), (0.0, 1, -1, 4.0), (0.0, 2, -1, 8.0),
    (100.0, 1, 1, 0.0), (100.0, 2, 1, 0.0), (100.0, 1, -1, -2.0), (100.0, 2, -1, -4.0),
]  # fmt: skip
ROOT = math.sqrt(2.0)


def test_the_worked_example_gives_the_figures_calculated_by_hand():
    result = evaluate(measurement(WORKED))
    expected = {
        "A": 9 + 6 * ROOT, "A_up": 4 * ROOT, "A_down": 9 + 6 * ROOT,
        "R": 4 + 6 * ROOT, "R_up": 4 * ROOT, "R_down": 8 * ROOT,
        "E": 9.0, "E_up": 2.0, "E_down": 9.0, "M": 5.5, "B": 4.0, "B_mean": -0.5,
    }  # fmt: skip
    assert result.parameters() == pytest.approx(expected, abs=TOLERANCE)
    assert result.mean_up == pytest.approx([2.0, 0.0])
    assert result.mean_down == pytest.approx([6.0, -3.0])
    assert result.s_up == pytest.approx([ROOT, 0.0])
    assert result.s_down == pytest.approx([2 * ROOT, ROOT])
    assert result.reversal == pytest.approx([-4.0, 3.0])
    assert result.repeatability == pytest.approx([4 + 6 * ROOT, 3 + 2 * ROOT])


def by_pandas(rows):
    """The same figures, formulated on a long table grouped by target and direction."""
    frame = pd.DataFrame(rows, columns=["target", "run", "direction", "deviation"])
    cell = frame.groupby(["target", "direction"])["deviation"].agg(["mean", "std"])
    mean, s = cell["mean"].unstack(), cell["std"].unstack()
    for table in (mean, s):
        for direction in (1, -1):
            if direction not in table:
                table[direction] = np.nan
    upper, lower = mean + 2 * s, mean - 2 * s
    reversal = mean[1] - mean[-1]
    middle = mean.mean(axis=1, skipna=False)
    both = {*frame.direction} == {1, -1}
    sum_of_both = 2 * s[1] + 2 * s[-1] + reversal.abs()
    figures = {
        "A": upper.max().max() - lower.min().min() if both else np.nan,
        "A_up": upper[1].max() - lower[1].min(),
        "A_down": upper[-1].max() - lower[-1].min(),
        "R": pd.concat([sum_of_both, 4 * s[1], 4 * s[-1]], axis=1).max(axis=1, skipna=False).max(),
        "R_up": 4 * s[1].max(),
        "R_down": 4 * s[-1].max(),
        "E": mean.max().max() - mean.min().min() if both else np.nan,
        "E_up": np.ptp(mean[1]) if not mean[1].isna().any() else mean[1].max() - mean[1].min(),
        "E_down": mean[-1].max() - mean[-1].min(),
        "M": middle.max() - middle.min(),
        "B": reversal.abs().max(),
        "B_mean": reversal.mean(),
    }
    return {name: float(value) for name, value in figures.items()}


readings = st.floats(-1e4, 1e4, allow_nan=False, width=32)


@st.composite
def iso_tests(draw, complete=False):
    """Draw a test with any number of targets and runs in which some readings may be missing."""
    targets = draw(st.lists(st.integers(-5000, 5000), min_size=1, max_size=6, unique=True))
    runs = draw(st.integers(2 if complete else 1, 5))
    rows = [
        (0.1 * target, run, direction, draw(readings))
        for target in targets
        for run in range(1, runs + 1)
        for direction in (1, -1)
        if complete or draw(st.integers(0, 9))
    ]
    return rows or [(0.0, 1, 1, 0.0)]


@settings(deadline=None, max_examples=150)
@given(iso_tests())
def test_any_test_gives_the_same_figures_as_a_pandas_sheet(rows):
    assert evaluate(measurement(rows)).parameters() == pytest.approx(by_pandas(rows), abs=TOLERANCE, nan_ok=True)


@settings(deadline=None, max_examples=60)
@given(iso_tests(), st.floats(-100, 100))
def test_a_shift_of_zero_and_the_order_of_readings_change_no_figure(rows, shift):
    before = evaluate(measurement(rows)).parameters()
    shifted = [(t, run, d, x + shift) for t, run, d, x in reversed(rows)]
    assert evaluate(measurement(shifted)).parameters() == pytest.approx(before, abs=1e-6, nan_ok=True)


@settings(deadline=None, max_examples=60)
@given(iso_tests())
def test_turning_the_axis_round_swaps_the_directions(rows):
    before, after = (
        evaluate(measurement(r)).parameters() for r in (rows, [(-t, run, -d, -x) for t, run, d, x in rows])
    )
    swapped = {name: name.replace("up", "UP").replace("down", "up").replace("UP", "down") for name in PARAMETERS}
    assert {swapped[name]: value for name, value in after.items()} == pytest.approx(before, abs=1e-6, nan_ok=True)


@settings(deadline=None, max_examples=60)
@given(iso_tests(complete=True))
def test_accuracy_is_never_better_than_its_parts(rows):
    r = evaluate(measurement(rows))
    for larger, smaller in ((r.A, r.R_up), (r.R, r.R_up), (r.R, r.B), (r.E, r.M), (r.E, r.E_up), (r.A, r.A_down)):
        assert larger >= smaller - 1e-6


def test_one_run_has_no_repeatability_and_no_accuracy():
    result = evaluate(measurement([row for row in WORKED if row[1] == 1]))
    known = {name for name, value in result.parameters().items() if not math.isnan(value)}
    assert known == {"E", "E_up", "E_down", "M", "B", "B_mean"}
    assert any("one run in positive direction" in note for note in result.notes)


def test_one_direction_has_no_reversal():
    result = evaluate(measurement([row for row in WORKED if row[2] == 1]))
    known = {name for name, value in result.parameters().items() if not math.isnan(value)}
    assert known == {"A_up", "R_up", "E_up"}
    assert "Only the positive direction was measured: B, M, E, R and A do not exist." in result.notes


def test_a_missing_point_is_said_and_leaves_the_rest_alone():
    result = evaluate(measurement([row for row in WORKED if row[:3] != (100.0, 2, -1)]))
    assert result.mean_down == pytest.approx([6.0, -2.0])
    assert np.isnan(result.s_down).tolist() == [False, True]
    assert "1 targets have a single reading in negative direction: no s, R and A there." in result.notes


def test_five_runs_in_both_directions_need_no_note():
    rows = [(t, run, d, run * d) for t in (0.0, 10.0) for run in range(1, 6) for d in (1, -1)]
    assert evaluate(measurement(rows)).notes == ()


def test_json_has_no_nan_and_the_table_one_row_a_target():
    result = evaluate(measurement([row for row in WORKED if row[1] == 1]))
    again = json.loads(json.dumps(result.to_dict(), allow_nan=False))
    assert again["parameters"]["R"] is None
    assert again["parameters"]["B"] == result.B
    assert [target["position"] for target in again["targets"]] == [0.0, 100.0]
    assert result.table()["x̄↓"].tolist() == [4.0, -2.0]


def test_the_picture_shows_means_bands_and_readings():
    ax = evaluate(measurement(WORKED)).plot()
    assert ax.get_xlabel() == "target position [mm]"
    assert "µm" in ax.get_ylabel()
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["x̄↑ ± 2s↑", "x̄↑", "x̄↓ ± 2s↓", "x̄↓", "x̄"]
    assert evaluate(measurement(WORKED, "deg")).plot().get_ylabel().endswith("[″]")


def test_uncertainties_are_those_calculated_by_hand():
    conditions = Conditions(
        device=0.5, misalignment=1.0, temperature_range=1.0, temperature_offset=-3.0, drift=1.7, expansion=12.0
    )
    contributions = conditions.contributions(1000.0)
    assert contributions == pytest.approx(
        {"U_DEVICE": 0.5, "U_MISALIGNMENT": 0.288675, "U_M": 6.928203, "U_E": 3.464102, "U_EVE": 0.981495}, abs=1e-6
    )
    shorter = conditions.contributions(250.0)
    assert [shorter[name] for name in ("U_DEVICE", "U_M", "U_E")] == pytest.approx(
        [0.125, 1.732051, 0.866025], abs=1e-6
    )
    assert shorter["U_MISALIGNMENT"] == pytest.approx(1.154701, abs=1e-6)
    found = conditions.of_parameters(1000.0, 5)
    common = math.sqrt(0.5**2 + 0.288675**2 + 6.928203**2 + 3.464102**2)
    assert found["B"] == pytest.approx(0.981495 * math.sqrt(0.4), abs=1e-6)
    assert found["M"] == pytest.approx(math.sqrt(common**2 + 0.981495**2 / 5), abs=1e-5)
    assert found["E"] == pytest.approx(math.sqrt(common**2 + 0.4 * 0.981495**2), abs=1e-5)
    assert found["R_up"] == pytest.approx(2 * 0.981495, abs=1e-5)


@pytest.mark.parametrize(
    ("fewer", "runs"),
    [
        ({(100.0, -1): 3}, 3),
        ({(0.0, 1): 2, (0.0, -1): 4}, 2),
        ({(100.0, -1): 0}, 5),
        ({(t, -1): 0 for t in (0.0, 50.0, 100.0)}, 5),
    ],
    ids=["fewer down", "fewer up", "no reading at one target", "one direction"],
)
def test_the_target_measured_least_often_decides_the_uncertainty(fewer, runs):
    """Drift of 1.7 µm is U_EVE = 1.7/√3; a target without any reading in a direction does not count."""
    cells = [(t, d) for t in (0.0, 50.0, 100.0) for d in (1, -1)]
    rows = [(t, run, d, run * d) for t, d in cells for run in range(1, fewer.get((t, d), 5) + 1)]
    result = evaluate(measurement(rows), Conditions(drift=1.7))
    eve = 1.7 / math.sqrt(3.0)
    expected = {
        "B": eve * math.sqrt(2.0 / runs),
        "M": eve / math.sqrt(runs),
        "E_up": eve * math.sqrt(2.0 / runs),
        "A_up": eve * math.sqrt(2.0 / runs + 4.0),
    }
    given = {name: value for name, value in expected.items() if not math.isnan(getattr(result, name))}
    assert {name: result.uncertainty.get(name) for name in given} == pytest.approx(given)
    assert {"E_up", "A_up"} <= given.keys()


def test_uncertainty_by_simulated_drift_covers_the_figures_it_is_for():
    """B, M and E of an axis without error, read with drift alone, stay within U in about 95 % of tests."""
    random = np.random.default_rng(3)
    conditions = Conditions(drift=2.0)
    rows = [(t, run, d, 0.0) for t in (0.0, 1.0) for run in range(1, 6) for d in (1, -1)]
    limits = conditions.of_parameters(1.0, 5)
    inside = {"B_mean": 0, "E_up": 0}
    for _ in range(400):
        result = evaluate(measurement([(*row[:3], random.uniform(-1.0, 1.0)) for row in rows]))
        for name in inside:
            inside[name] += abs(getattr(result, name)) <= limits[name]
    assert inside["E_up"] / 400 > 0.92
    assert inside["B_mean"] / 400 > 0.95  # a mean over two targets is better than one reversal value


@pytest.mark.parametrize("conditions", [{"drift": -1.0}, {"device": math.nan}, {"expansion": math.inf}])
def test_conditions_that_cannot_be_are_refused(conditions):
    with pytest.raises(ValueError, match="cannot be"):
        Conditions(**conditions)


def test_conditions_are_for_linear_axes():
    with pytest.raises(ValueError, match="linear axes"):
        evaluate(measurement(WORKED, "deg"), Conditions(drift=1.0))
    assert evaluate(measurement(WORKED), Conditions(drift=1.0)).uncertainty.keys() == set(PARAMETERS)


def test_the_uncertainty_of_a_mean_is_two_standard_deviations_of_it():
    table = evaluate(measurement(WORKED)).table()
    assert table["U(x̄↓)"].tolist() == pytest.approx([4.0, 2.0])
