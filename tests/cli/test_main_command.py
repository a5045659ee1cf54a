"""``axcomp`` itself: help, missing packages, files that cannot be read."""

from importlib import import_module
from types import ModuleType

import pytest

from axcomp.cli import COMMANDS, main
from axcomp.model import EXTRAS


def test_the_help_lists_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["--help"])
    listed = capsys.readouterr().out.split()
    assert all(command in listed for command in COMMANDS)


def test_the_help_names_the_commands_that_a_missing_package_hides(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def importing(name: str, package: str) -> ModuleType:
        if name == ".diagnose":
            raise ModuleNotFoundError("No module named 'openpyxl'", name="openpyxl")
        return import_module(name, package)

    monkeypatch.setattr("axcomp.cli.import_module", importing)
    monkeypatch.setattr("axcomp.cli.missing", lambda packages: [*packages] if packages == EXTRAS["tables"] else [])
    with pytest.raises(SystemExit, match="0"):
        main(["--help"])
    assert "pip install 'axcomp[workbench]' there are also: diagnose." in " ".join(capsys.readouterr().out.split())
    with pytest.raises(SystemExit, match="diagnose needs openpyxl"):
        main(["diagnose", "--help"])


def test_a_file_that_is_missing_is_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "no such program.csv", "--machine", "nowhere"]) != 0
    words = capsys.readouterr().err
    assert "no such program.csv" in words
    assert "Errno" not in words
