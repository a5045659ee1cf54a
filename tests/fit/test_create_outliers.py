"""Gross errors in a measurement: named, refused, left out, and what is left of them in a table."""

import numpy as np
import pytest
from creating import measured

from axcomp.cli import main
from axcomp.fit import CannotCreateError, Options, TargetList, create, fit_of

TARGETS = np.linspace(0.0, 400.0, 9)
CURVES = {1: 10.0 * np.sin(TARGETS / 90.0), -1: 10.0 * np.sin(TARGETS / 90.0) - 4.0}


def with_one_off(series, place, size):
    deviations = series.deviations.copy()
    deviations[place] += size
    return series.with_deviations(deviations)


def tables(series, target, outliers):
    """Return the table in µm; outliers are left out by hand, which saves the checks by runs."""
    if outliers == "drop":
        series = series.without(series.outliers())
    fit = fit_of("leadscrew")(series, target, Options())
    return np.array([side.y for side in fit.table(fit.means(series))])


@pytest.mark.parametrize("runs", [2, 3, 5])
@pytest.mark.parametrize("size", [128.0, -15.0])
def test_one_gross_outlier_anywhere_moves_the_table_by_less_than_twice_its_uncertainty(tmp_path, runs, size):
    """U = 2 s/√n of a target's mean, with s = 1 µm; 0.1 µm more for the list's rounding."""
    series = measured(TARGETS, CURVES, runs=runs, scatter=1.0, seed=3)
    target = TargetList(tmp_path / "x.lis", 1)
    clean = tables(series, target, "keep")
    assert not series.outliers()
    for place in range(len(series.runs)):
        found = with_one_off(series, place, size).outliers()
        assert [one.place for one in found] == [place]
        assert found[0].run == series.runs[place]
        moved = np.abs(tables(with_one_off(series, place, size), target, "drop") - clean).max()
        assert moved <= 2.0 * 2.0 / np.sqrt(runs) + 0.1


@pytest.mark.parametrize("size", [3.0, 4.0, 5.0, 6.0, 7.0, 9.0])
def test_what_is_not_found_moves_the_table_by_less_than_twice_its_uncertainty(tmp_path, size):
    series = measured(TARGETS, CURVES, runs=5, scatter=1.0, seed=4)
    target = TargetList(tmp_path / "x.lis", 1)
    clean = tables(series, target, "keep")
    for place in range(len(series.runs)):
        moved = np.abs(tables(with_one_off(series, place, size), target, "drop") - clean).max()
        assert moved <= 2.0 * 2.0 / np.sqrt(5) + 0.1


def test_with_one_run_the_neighbours_tell():
    targets = np.linspace(0.0, 400.0, 21)
    series = measured(targets, {d: 10.0 * np.sin(targets / 90.0) for d in (1, -1)}, runs=1, scatter=0.5)
    assert not series.outliers()
    for place in range(len(series.runs)):
        assert [one.place for one in with_one_off(series, place, 60.0).outliers()] == [place]


def test_clean_series_are_not_stopped():
    """Of 200 series of 90 normal readings, drifting or not, none has an outlier."""
    for seed in range(100):
        series = measured(TARGETS, CURVES, runs=5, scatter=1.0, seed=seed)
        assert not series.outliers()
        assert not series.with_deviations(series.deviations + 0.005 * series.targets * series.runs).outliers()


def test_a_run_that_is_off_as_a_whole_is_no_outlier():
    series = measured(TARGETS, CURVES, runs=5, scatter=1.0)
    assert not series.with_deviations(series.deviations + 12.0 * (series.runs == 1)).outliers()


def test_readings_without_scatter_have_none_unless_one_is_off():
    series = measured(TARGETS, CURVES, runs=3)
    assert not series.outliers()
    assert [one.size for one in with_one_off(series, 5, 2.0).outliers()] == pytest.approx([2.0])
    rounded = (
        series.with_deviations(np.round(measured(TARGETS, CURVES, runs=5, scatter=0.03).deviations, 1))
        if 0
        else (measured(TARGETS, CURVES, runs=5, scatter=0.03))
    )
    assert not rounded.with_deviations(np.round(rounded.deviations, 1)).outliers()


@pytest.fixture
def command(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    series = with_one_off(measured(TARGETS, CURVES, runs=5, scatter=1.0), 20, 128.0)
    rows = zip(series.targets, series.runs, series.directions, series.deviations, strict=True)
    (tmp_path / "x.csv").write_text("\n".join(f"{t:g},{r},{d},{v:.3f}" for t, r, d, v in rows))
    return ["create", "leadscrew", "--from", "x.csv", "--into", "x.lis", "--axis", "1"]


def test_by_default_it_stops_with_the_figures_with_and_without(command, tmp_path, capsys):
    assert main(command) == 1
    out, err = capsys.readouterr()
    assert not out
    assert err.count("\n") == 1
    assert "run 3, target 100 mm ↑: +12" in err
    assert "1 reading of 90" in err
    assert "--outliers drop" in err
    assert "Figures with / without them: A " in err
    assert not (tmp_path / "x.lis").exists()


@pytest.mark.parametrize(("choice", "words"), [("drop", "are left out"), ("keep", "and count")])
def test_they_are_left_out_or_kept_by_choice(command, capsys, choice, words):
    assert main([*command, "--outliers", choice]) == 0
    out, err = capsys.readouterr()
    assert not err
    assert words in out
    assert "run 3, target 100 mm ↑" in out


def test_other_kinds_name_them_too(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    grid = [(p, q, run) for run in (1, 2, 3) for p in (0, 100, 200) for q in (0, 100, 200)]
    random = np.random.default_rng(0)
    rows = [
        f"{p},{q},{0.01 * p + random.normal(0, 0.2) + 40 * (k == 13):.4f},{run}" for k, (p, q, run) in enumerate(grid)
    ]
    (tmp_path / "p.csv").write_text("master1,master2,deviation,run\n" + "\n".join(rows))
    from axcomp.fit import Flatness

    with pytest.raises(CannotCreateError, match=r"run 2, masters at 100, 100: \+"):
        create("plane", Flatness.read("p.csv"), TargetList("p.lis", 1), Options(masters=(2, 3)))
