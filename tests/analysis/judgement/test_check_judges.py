"""``axcomp check`` with judgement, as a user meets it."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from judging import THREE_AXIS, leadscrew_machine, measured

from axcomp.analysis.judgement import Positions
from axcomp.cli import main
from axcomp.lists import read_machine, write_machine

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def lists(tmp_path: Path) -> Path:
    y = np.full(12, 0.004)
    y[5] = 0.014
    write_machine(leadscrew_machine(10.0 * np.arange(12), y), tmp_path)
    return tmp_path


@pytest.fixture
def measurement(tmp_path: Path) -> Path:
    path = tmp_path / "y.csv"
    one = measured("Y")
    rows = zip(one.targets, one.runs, one.directions, one.deviations, strict=True)
    path.write_text("target,run,direction,deviation\n" + "".join(f"{t},{r},{d},{e}\n" for t, r, d, e in rows))
    return path


def test_judgement_needs_no_options_and_leaves_the_status(lists: Path, capsys: Capture) -> None:
    assert main(["check", str(lists)]) == 0
    finding, summary = capsys.readouterr().out.splitlines()
    assert " warning AXC-OUTLIER: The value 14.0 µm at 50 mm" in finding
    assert summary.startswith("0 errors, 1 warning")


def test_the_sign_is_judged_by_a_measurement(measurement: Path, capsys: Capture) -> None:
    assert main(["check", str(THREE_AXIS), "--measurement", str(measurement), "--axis", "Y"]) == 0
    assert "info AXC-SIGN: With the leadscrew table of Y the measured error E shrinks from" in capsys.readouterr().out


def test_everything_as_json(measurement: Path, capsys: Capture) -> None:
    options = ["--measurement", str(measurement), "--axis", "Y", "--feed", "30000", "--feed", "Z=10m/min"]
    options += ["--input", str(THREE_AXIS / "input.csv"), "--format", "json"]
    assert main(["check", str(THREE_AXIS), *options]) == 0
    found = json.loads(capsys.readouterr().out)
    judgement = found["machines"][0]["judgement"]
    [sign] = judgement["signs"]
    assert sign["verdict"] == "as written"
    assert sign["errors"]["as written"] < sign["errors"]["without"] < sign["errors"]["opposite sign"]
    feeds = {one["over"]: one["feed"] for one in judgement["dynamics"]}
    assert feeds == pytest.approx({"X": 500.0, "Y": 500.0, "Z": 10_000 / 60})
    assert all(one["outside"] == 0.0 for one in judgement["coverage"])
    assert {one["code"] for one in found["findings"]} == {"AXC-SIGN", "AXC-DYNAMICS"}


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--feed", "fast"], "--feed: “fast” is no [AXIS=]VALUE in mm/min"),
        (["--feed", "Q=3"], "there is no axis 'Q'; the machine has X"),
        (["--max-acceleration", "3 mm/min"], "--max-acceleration: “3 mm/min” is no"),
        (["--feed", "1", "--cycle-time", "0"], "0 s is no cycle time"),
        (["--input", "none.csv"], "none.csv: The file cannot be read"),
        (["--measurement", "none.csv"], "none.csv: The file cannot be read"),
        (["--measurement", "MEASUREMENT", "--axis", "Q"], "there is no axis 'Q'"),
    ],
)
def test_what_cannot_be_followed_is_a_sentence_and_status_2(
    options: list[str], sentence: str, lists: Path, measurement: Path, capsys: Capture
) -> None:
    words = [str(measurement) if word == "MEASUREMENT" else word for word in options]
    assert main(["check", str(lists), *words]) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert "AXC-OUTLIER" in printed.out


def test_of_several_leadscrew_tables_the_axis_must_be_named(measurement: Path, capsys: Capture) -> None:
    assert main(["check", str(THREE_AXIS), "--measurement", str(measurement)]) == 2
    assert "does not say which axis it is of; --axis NAME does" in capsys.readouterr().err


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(word=st.text(max_size=200))
def test_any_word_for_a_feed_is_followed_or_refused(word: str, lists: Path) -> None:
    assert main(["check", str(lists), f"--feed={word}"]) in {0, 2}


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.binary(max_size=200))
def test_any_bytes_are_judged_or_refused(data: bytes, lists: Path) -> None:
    (lists / "any").write_bytes(data)
    assert main(["check", str(lists), "--input", str(lists / "any"), "--measurement", str(lists / "any")]) == 2
    assert main(["check", str(lists / "any")]) in {0, 1}


def test_the_command_needs_neither_pandas_nor_matplotlib(lists: Path) -> None:
    code = (
        "import sys; from axcomp.cli import main; main(sys.argv[1:]); "
        "sys.exit(sorted({'pandas', 'matplotlib', 'rich', 'dask', 'scipy'} & set(sys.modules)))"
    )
    run = [sys.executable, "-c", code, "check", str(lists), "--feed", "30000"]
    result = subprocess.run(run, capture_output=True, text=True, check=False)
    assert result.stderr.strip() == "[]"


def test_positions_are_found_without_a_start_up_list_too(lists: Path) -> None:
    (lists / "hochlauf.lis").unlink()
    position = Positions(read_machine(lists)).of_table(1, "kw.ssfk.table[i].pos", 5)
    assert position.file == str(lists / "achskw1.lis")
    assert Path(position.file).read_text().split("\n")[position.line - 1].split()[0] == position.parameter
    one = Positions(read_machine(lists / "achskw1.lis")).of_table(1, "kw.ssfk.table[i].pos", 5)
    assert one == position
    assert read_machine(lists).machine.axes[0].leadscrew is not None


def test_without_lists_there_is_no_position() -> None:
    assert Positions(None).of_table(1, "kw.ssfk.table[i].pos", 5) == ("", 0, "kw.ssfk.table[5].pos")
