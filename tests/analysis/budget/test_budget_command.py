"""``axcomp budget`` on the command line."""

import json
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from axcomp.analysis.budget import SHOWN, budget_of, plot_waterfall
from axcomp.cli import main
from axcomp.engine import read_input
from axcomp.model import models

FIVE = models() / "five_axis"
INPUT = str(FIVE / "input.csv")


@pytest.fixture
def uncertainties(tmp_path: Path) -> str:
    (tmp_path / "u.csv").write_text("parameter,standard_uncertainty,unit\nEXX,1,um\n")
    return str(tmp_path / "u.csv")


def test_json_has_all_figures_and_the_picture_is_drawn(
    tmp_path: Path, uncertainties: str, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "b.png"
    options = ["--points", "6", "--trials", "20", "--places", "3", "--format", "json", "--plot", str(picture)]
    assert main(["budget", str(FIVE), "--input", INPUT, "--uncertainty", uncertainties, *options]) == 0
    figures = json.loads(capsys.readouterr().out)
    x = figures["axes"]["X"]
    assert x["unit"] == "µm"
    sizes = [c["max"] for c in x["contributions"]]
    assert sizes == sorted(sizes, reverse=True)
    assert abs(x["sum minus joint volumetric correction"]) < 1e-3
    assert figures["uncertainty"]["sources"]["volumetric[0] EXX"]["X"] == pytest.approx(1.0, rel=1e-3)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_table_has_the_checks(uncertainties: str, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--points", "4", "--trials", "9", "--places", "2", "--rows", "2", "--uncertainty", uncertainties]
    assert main(["budget", str(FIVE), "--input", INPUT, *options]) == 0
    out = capsys.readouterr().out
    for said in ("Volumetric errors, sum of each alone", "all, by the engine", "by linear propagation", "others"):
        assert said in out


@pytest.mark.parametrize(
    ("path", "options", "said"),
    [
        ("nowhere", ["--input", INPUT], "there is no axis in these lists"),
        (str(FIVE), ["--input", "none.csv"], "none.csv: The file cannot be read"),
        (str(models() / "three_axis"), ["--input", INPUT], "is no input; the inputs are"),
        (str(FIVE), ["--input", INPUT, "--points", "1"], "--points and --trials are at least 2"),
        (str(FIVE), ["--input", INPUT, "--uncertainty", "none.csv"], "none.csv: The file cannot be read"),
    ],
)
def test_what_is_wrong_is_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], path, options, said
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["budget", path, *options]) == 1
    assert said in capsys.readouterr().err


def test_the_bars_of_a_waterfall_add_up_to_its_sum() -> None:
    budget = budget_of(FIVE, read_input(Path(INPUT)), points=5)
    ax = plot_waterfall(budget, "X", Figure().add_subplot())
    heights = [patch.get_height() for patch in ax.patches]
    assert len(heights) == SHOWN + 2
    assert sum(heights[:-1]) == pytest.approx(heights[-1])
    assert heights[-1] == pytest.approx(budget.totals["X"][budget.worst("X")], abs=1e-3)
    assert ax.get_ylabel() == "correction [µm]"


def test_help_has_examples(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["budget", "--help"])
    assert ended.value.code == 0
    assert "examples:\n  axcomp budget models/three_axis" in capsys.readouterr().out
