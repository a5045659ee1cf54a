"""Lists in a folder of their own, and the command that checks them."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from linting import Write

from axcomp.cli import main


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Write:
    """Return a function that writes files, and goes to their folder."""
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)

    def written(files: Mapping[str, str | bytes]) -> Path:
        for name, content in files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content.encode() if isinstance(content, str) else content)
        return folder

    return written


@pytest.fixture
def codes(capsys: pytest.CaptureFixture[str]) -> Callable[..., list[str]]:
    """Return a function that checks with options, and returns the codes of what is told."""

    def checked(*options: str) -> list[str]:
        capsys.readouterr()
        main(["check", *options, "--format", "json"])
        return [finding["code"] for finding in json.loads(capsys.readouterr().out)["findings"]]

    return checked
