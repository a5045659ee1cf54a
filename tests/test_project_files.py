"""The files around the code are what the tools and sites that read them expect."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import axcomp

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ("schema", "file"),
    [("vendor.github-workflows", ".github/workflows/tests.yml"), ("vendor.citation-file-format", "CITATION.cff")],
)
def test_a_file_is_valid_by_its_schema(schema: str, file: str) -> None:
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, ROOT / file]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_workflow_runs_the_tests_on_three_systems_and_every_python_that_is_promised() -> None:
    text = (ROOT / ".github/workflows/tests.yml").read_text(encoding="utf-8")
    for system in ("ubuntu-latest", "windows-latest", "macos-latest"):
        assert system in text
    least = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["requires-python"]
    assert least == ">=3.11"
    assert '["3.11", "3.12", "3.13", "3.14"]' in text


def test_version_is_said_once() -> None:
    result = subprocess.run(
        [sys.executable, "-m", "axcomp", "--version"], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert result.stdout == f"axcomp {axcomp.__version__}\n"
    assert f"## {axcomp.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"version: {axcomp.__version__}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_licence_is_named_where_a_tool_looks() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert (project["license"], project["license-files"]) == ("MIT", ["LICENSE"])
    assert (
        (ROOT / "LICENSE")
        .read_text(encoding="utf-8")
        .startswith("MIT License\n\nCopyright (c) 2026 the axcomp authors")
    )
    assert "license: MIT\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert (Path(axcomp.__file__).parent / "py.typed").exists()
