"""``axcomp build`` and ``build_fmu.py``."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import fmpy
import pytest

from axcomp.cli import main
from axcomp.kinds import Leadscrew
from axcomp.lists import write_machine
from axcomp.model import Axis, Machine, models
from axcomp.native import MAGIC, own_platform

ROOT = Path(__file__).parents[2]


@pytest.fixture
def lists(tmp_path: Path) -> Path:
    machine = Machine((Axis(1, "X", leadscrew=Leadscrew((0.0, 10.0), (0.01, 0.02))), Axis(2, "Y")))
    write_machine(machine, tmp_path / "lists")
    return tmp_path / "lists"


def test_without_options_both_fmus_of_the_example_are_built_here(tmp_path: Path) -> None:
    result = subprocess.run(
        [sys.executable, str(ROOT / "build_fmu.py")],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["axcomp.fmu", "plant.fmu"]
    assert result.stdout.splitlines()[0].startswith("axcomp.fmu: ")
    assert result.stdout.splitlines()[-1] == "plant.fmu"


def test_options_reach_the_fmu(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "new" / "mine.fmu"
    output.parent.mkdir()
    options = ["--machine", str(lists), "--output", str(output), "--cycle-time", "0.002", "--naming", "flat"]
    assert main(["build", *options, "--no-external-tool"]) == 0
    description = fmpy.read_model_description(output)
    assert description.defaultExperiment.stepSize == "0.002"
    assert description.coSimulation.needsExecutionTool is False
    names = {variable.name for variable in description.modelVariables}
    assert "X_leadscrew_correction" in names
    assert [variable.start for variable in description.modelVariables if variable.name == "cycle_time"] == ["0.002"]
    assert capsys.readouterr().out.splitlines()[1:] == ["  X: leadscrew", "  Y: no compensation"]
    assert [path.name for path in output.parent.iterdir()] == ["mine.fmu"]


def test_the_summary_names_volumetric_compensations(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "--machine", str(models() / "five_axis"), "--image", str(tmp_path / "five.bin")]) == 0
    _, x, *_, c = capsys.readouterr().out.splitlines()
    assert x == "  X: volumetric[0], volumetric[1]"
    assert c == "  C: volumetric[1]"


def test_findings_are_shown_and_stop_nothing(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with (lists / "achskw1.lis").open("r+", encoding="utf-8") as file:
        file.write("kw.ssfk.nonsense 5\n")
    assert main(["build", "--machine", str(lists), "--output", str(tmp_path)]) == 0
    assert "achskw1.lis:1: warning AXC-UNKNOWN: kw.ssfk.nonsense" in capsys.readouterr().err
    assert (tmp_path / "axcomp.fmu").is_file()


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--machine", "nowhere/hochlauf.lis"], "there is no axis in these lists"),
        (["--machine", "lists", "--cycle-time", "0"], "the cycle time must be above 0 s"),
        (
            ["--machine", "lists", "--output", "lists/hochlauf.lis/x.fmu"],
            "there is no folder lists/hochlauf.lis for x.fmu",
        ),
    ],
)
def test_what_cannot_be_built_is_a_sentence_and_status_1(
    lists: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], options: list[str], sentence: str
) -> None:
    monkeypatch.chdir(lists.parent)
    assert main(["build", *options]) == 1
    assert sentence in capsys.readouterr().err


def test_a_missing_pythonfmu_is_a_sentence(
    lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    assert main(["build", "--runtime", "python", "--machine", str(lists), "--output", str(tmp_path)]) == 1
    assert "pip install 'axcomp[python]'" in capsys.readouterr().err


def test_platforms_are_those_of_the_native_fmu(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    options = ["build", "--machine", str(lists), "--output", str(tmp_path / "x.fmu")]
    assert main([*options, "--platforms", own_platform()]) == 0
    with pytest.raises(SystemExit, match="2"):
        main([*options, "--platforms", "linux64,amiga"])
    assert "there is no platform 'amiga'; there are linux64, win64, darwin64" in capsys.readouterr().err
    assert main([*options, "--platforms", "win64", "--runtime", "python"]) == 1
    assert "--platforms is for the native FMU" in capsys.readouterr().err


def test_an_image_is_written_with_its_findings(lists: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with (lists / "achskw1.lis").open("a", encoding="utf-8") as file:
        file.write("kw.ssfk.nonsense 5\n")
    assert main(["build", "--machine", str(lists), "--image", str(tmp_path / "new.bin")]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("new.bin: ")
    assert "achskw1.lis" in err
    assert (tmp_path / "new.bin").read_bytes().startswith(MAGIC)


def test_the_exit_status_of_an_image_is_the_number_of_errors_in_the_lists(lists: Path, tmp_path: Path) -> None:
    table = lists / "achskw1.lis"
    words = ["kw.ssfk.table[0].pos", "kw.ssfk.table[1].pos"]
    rows = [
        f"{line.split()[0]} nothing" if line.startswith(tuple(words)) else line
        for line in table.read_text().splitlines()
    ]
    table.write_text("\n".join(rows))
    options = ["build", "--machine", str(lists)]
    assert main([*options, "--image", str(tmp_path / "new.bin")]) == 2
    assert (tmp_path / "new.bin").is_file()
    assert main([*options, "--output", str(tmp_path), "--runtime", "python"]) == 0


def test_without_libraries_and_compiler_the_other_runtime_is_named(
    lists: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "ziglang" else find_spec(name))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    options = ["build", "--machine", str(lists), "--output", str(tmp_path / "x.fmu")]
    assert main(options) == 0
    monkeypatch.setattr("axcomp.fmu.native_package.why_not_prebuilt", lambda: "the libraries are old")
    assert main(options) == 1
    assert "the libraries are old; there is no C compiler: install gcc or clang" in (said := capsys.readouterr().err)
    assert "--runtime python needs no compiler" in said
    assert main([*options, "--runtime", "python"]) == 0


def test_help_has_an_example(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["build", "--help"])
    assert ended.value.code == 0
    assert "axcomp build --machine lists/hochlauf.lis" in capsys.readouterr().out
