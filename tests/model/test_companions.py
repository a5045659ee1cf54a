"""Commands find the example machines wherever they are run."""

from __future__ import annotations

from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.model import machine_path, models


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("text", ["five_axis", "models/five_axis"])
def test_an_example_is_known_by_its_name_in_any_folder(text: str) -> None:
    assert machine_path(text) == models() / "five_axis"


def test_what_is_there_goes_before_an_example(elsewhere: Path) -> None:
    (elsewhere / "five_axis").mkdir()
    assert machine_path("five_axis") == Path("five_axis")


@pytest.mark.parametrize("text", ["nowhere", "", ".", "..", "lists/five_axis", "README.md"])
def test_any_other_path_stays_as_it_is(text: str) -> None:
    assert machine_path(text) == Path(text)


@pytest.mark.parametrize("command", ["check", "show"])
def test_the_example_of_a_commands_help_works(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command, "models/five_axis"]) == 0
    assert capsys.readouterr().out
