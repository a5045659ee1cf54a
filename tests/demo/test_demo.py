"""The demonstration itself: both FMUs coupled."""

from __future__ import annotations

import importlib.util
import shutil
from pathlib import Path

import matplotlib.image
import pytest

from axcomp.cli.demo import PICTURE
from axcomp.demo import BuildError, Demo, DemoError, demonstrate, draw
from axcomp.model import CYCLE_TIME, models


def check(demo: Demo) -> None:
    """Geometric errors shrink to 5 % at most, reversal peaks to 20 %, and they were worth it."""
    for result in demo.results:
        without, _ = result.largest
        assert without > 3.0, result.axis
        assert result.ratio <= (0.20 if result.trial.kind == "friction" else 0.05), (result.axis, result.trial.kind)


def check_honesty(demo: Demo) -> None:
    """What is left with memory is what no table removes, and of peaks not less than that."""
    for result, plain in zip(demo.remembering, demo.results, strict=True):
        without, left = result.largest
        if result.trial.kind == "friction":
            assert left > result.beyond > plain.largest[1], result.axis
        else:
            assert left < result.beyond + 0.05 * without + 0.3, (result.axis, result.trial.kind)
    assert all(result.beyond == 0.0 for result in demo.results)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "rows", "seed"),
    [("three_axis", 13, 0), ("three_axis", 13, 11), ("rotary_table", 3, 3), ("five_axis", 12, 0)],
)
def test_errors_shrink_as_promised(name: str, rows: int, seed: int, tmp_path: Path) -> None:
    demo = demonstrate(models() / name / "hochlauf.lis", tmp_path / "new", seed)
    assert len(demo.results) == rows
    check(demo)
    remembers = name != "five_axis"
    assert len(demo.remembering) == remembers * rows
    check_honesty(demo._replace(results=demo.results[: len(demo.remembering)]))
    picture = tmp_path / PICTURE
    draw(picture, demo.machine, demo.results, CYCLE_TIME)
    height, width, _ = matplotlib.image.imread(picture).shape
    assert width == 1200
    assert 400 <= height <= 1000
    assert {path.name for path in (tmp_path / "new").iterdir()} == {
        "axcomp.fmu",
        "plant.fmu",
        *(("plant_memoryless.fmu",) * remembers),
    }


@pytest.mark.slow
def test_without_a_compiler_it_is_shown_with_the_python_fmu(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "ziglang" else find_spec(name))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    monkeypatch.setattr("axcomp.fmu.native_package.why_not_prebuilt", lambda: "the libraries are old")
    demo = demonstrate(models() / "rotary_table", tmp_path / "out")
    assert "install gcc or clang" in demo.note
    assert "runs in Python" in demo.note
    check(demo)


@pytest.mark.slow
def test_inverted_tables_make_errors_larger(tmp_path: Path) -> None:
    model = tmp_path / "inverted"
    shutil.copytree(models() / "rotary_table", model)
    lists = model / "achskw6.lis"
    lines = []
    for line in lists.read_text(encoding="utf-8").splitlines():
        name, _, value = line.partition(" ")
        inverted = name.endswith((".pos", ".neg"))
        lines.append(f"{name} {-int(value)}" if inverted else line)
    lists.write_text("\n".join(lines), encoding="utf-8")
    demo = demonstrate(model, tmp_path / "out")
    assert all(result.ratio > 1.8 for result in demo.results if result.trial.kind == "leadscrew")


@pytest.mark.slow
def test_a_negated_volumetric_correction_doubles_the_error_of_the_tool_tip(tmp_path: Path) -> None:
    model = tmp_path / "negated"
    shutil.copytree(models() / "five_axis", model)
    for path in model.glob("vol_comp*.lis"):
        path.write_text("negate XYZ\n" + path.read_text(encoding="utf-8"), encoding="utf-8")
    demo = demonstrate(model, tmp_path / "out")
    assert all(result.ratio == pytest.approx(2.0, abs=0.1) for result in demo.results)


def test_a_machine_without_a_plant_is_refused_with_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"plant\.json"):
        demonstrate(models() / "manual_examples", tmp_path)


def test_a_path_that_is_not_there_is_refused_with_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(DemoError, match="does not exist"):
        demonstrate(tmp_path / "nowhere", tmp_path)


def test_a_plant_of_other_axes_is_refused_with_a_sentence(tmp_path: Path) -> None:
    model = tmp_path / "mixed"
    shutil.copytree(models() / "three_axis", model)
    shutil.copy(models() / "rotary_table" / "plant.json", model)
    with pytest.raises(DemoError, match="no axis X, Y, Z"):
        demonstrate(model, tmp_path / "out")


def test_a_machine_that_compensates_nothing_is_refused_with_a_sentence(tmp_path: Path) -> None:
    model = tmp_path / "bare"
    shutil.copytree(models() / "rotary_table", model)
    lists = model / "achsmd6.lis"
    kept = [line for line in lists.read_text(encoding="utf-8").splitlines() if not line.startswith("lr_param.")]
    lists.write_text("\n".join(kept), encoding="utf-8")
    with pytest.raises(DemoError, match="nothing to show"):
        demonstrate(model, tmp_path / "out")
