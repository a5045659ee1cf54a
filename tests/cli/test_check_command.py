"""``axcomp check`` and ``axcomp parameters``."""

import json
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.kinds import Cross
from axcomp.lists import CATALOGUE, PAGE, page, write_machine
from axcomp.model import Axis, Machine, models

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def lists(tmp_path: Path) -> Path:
    write_machine(Machine((Axis(1, "X", cross=Cross(2, (0.0, 1.0), (0.0, 0.1))), Axis(2, "Y"))), tmp_path)
    return tmp_path


def test_a_faultless_machine_is_summed_up(lists: Path, capsys: Capture) -> None:
    assert main(["check", str(lists)]) == 0
    assert capsys.readouterr().out == "0 errors, 0 warnings, 0 infos; 2 axes with 1 compensation.\n"


def test_volumetric_compensations_are_counted(capsys: Capture) -> None:
    main(["check", str(models() / "five_axis")])
    summary = capsys.readouterr().out.splitlines()[-1]
    assert summary.endswith("; 5 axes with 0 compensations and 2 volumetric compensations.")


def test_volumetric_compensations_are_told_as_json(capsys: Capture) -> None:
    main(["check", str(models() / "five_axis"), "--format", "json"])
    first, second = json.loads(capsys.readouterr().out)["machines"][0]["volumetric"]
    assert (first["index"], first["chain"], first["axes"]) == (0, "YXZ", {"X": 1, "Y": 2, "Z": 3})
    assert (second["index"], second["chain"], sorted(second["axes"])) == (1, "CBYXZ", list("BCXYZ"))
    assert min(first["errors"], second["errors"]) > 0


def test_findings_are_lines_with_file_and_line_and_the_status_is_1(lists: Path, capsys: Capture) -> None:
    path = lists / "achskw1.lis"
    path.write_text(path.read_text().replace("End", "kw.crosscomp.last_index 7"))
    assert main(["check", str(lists / "hochlauf.lis")]) == 1
    *findings, summary = capsys.readouterr().out.splitlines()
    assert any(line.startswith(f"{path}:") and " error 70245: " in line for line in findings)
    assert summary == "3 errors, 1 warning, 0 infos; 2 axes with 0 compensations."


def test_findings_as_json(lists: Path, capsys: Capture) -> None:
    (lists / "achskw1.lis").unlink()
    assert main(["check", str(lists), "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["counts"] == {"error": 1, "warning": 1, "info": 0}
    assert [(f["code"], f["severity"], f["line"] > 0) for f in found["findings"]] == [
        ("AXC-MISSING", "error", True),
        ("AXC-NO-TABLE", "warning", True),
    ]
    assert found["machines"][0]["axes"][1] == {"number": 2, "name": "Y", "type": "translatory", "compensations": []}


@pytest.mark.parametrize("path", ["nothing", "nothing/hochlauf.lis", "\0", "a" * 5000])
def test_a_path_that_is_not_there_is_an_error_in_a_sentence(path: str, tmp_path: Path, capsys: Capture) -> None:
    assert main(["check", str(tmp_path / path)]) == 1
    assert "error AXC-" in capsys.readouterr().out


def test_file_names_in_foreign_bytes_are_printed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(tmp_path / "\udcff.lis")]) == 1
    assert "AXC-MISSING" in capfd.readouterr().out


@pytest.mark.parametrize("command", ["check", "parameters"])
def test_help_has_an_example(command: str, capsys: Capture) -> None:
    with pytest.raises(SystemExit, match="0"):
        main([command, "--help"])
    assert f"axcomp {command}" in capsys.readouterr().out.partition("example:")[2]


def test_parameters_are_printed_as_a_table(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    assert main(["parameters"]) == 0
    lines = capsys.readouterr().out.splitlines()
    row = next(line.split() for line in lines if line.startswith("frict_comp.delay_cycles"))
    assert row[:6] == ["frict_comp.delay_cycles", "P-COMP-00058", "SGN16", "[0,", "249)", "cycles"]
    rows = [line for line in lines if not line.startswith(" ")]  # what goes on below is indented
    assert sum(map(len, CATALOGUE.values())) == len(rows) - 3 * len(CATALOGUE) + 1


def test_parameters_of_one_list_as_json(capsys: Capture) -> None:
    assert main(["parameters", "--list", "achskw", "--format", "json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["list"] for row in rows} == {"achskw*.lis"}
    [manual] = [row["ids"] for row in rows if row["name"] == "kw.crosstalk.manual_activation"]
    assert set(manual.values()) == {"P-COMP-00065", "P-COMP-00073"}


def test_the_reference_page_is_current() -> None:
    assert PAGE.read_text("utf-8") == page()
