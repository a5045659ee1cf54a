"""The documentation names what is there, and nothing that must not be named."""

import argparse
import os
import re
import shlex
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from axcomp.cli import COMMANDS, main

ROOT = Path(__file__).parents[1]
GENERATED = {"api.md", "commands.md", "compensations.md", "gallery.md"}
"""Pages that the site makes while it is built."""
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "models").glob("*/README.md")])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text(encoding="utf-8")):
        if "://" not in target and target not in GENERATED:
            assert (page.parent / target).exists(), target


def test_every_convention_has_a_reason_a_trace_and_a_test_that_exists() -> None:
    page = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")
    rows = [row for row in page.splitlines() if row.startswith("| ") and not row.startswith("| Convention")]
    assert len(rows) > 40
    assert sum("| — |" not in row for row in rows) > 50
    for row in rows:
        assert all(cell.strip() for cell in row.strip("|").split(" | "))
        assert row.count(" | ") == 3, row
        (reference,) = re.findall(r"`([\w/]+\.py)::(\w+)`", row)
        file, name = reference
        assert f"def {name}(" in (ROOT / "tests" / file).read_text(encoding="utf-8"), row


def test_the_glossary_says_each_word_once_in_order_and_its_classes_exist() -> None:
    page = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    sections = [re.findall(r"^\| (?!Word )([^|-][^|]*) \|", part, re.MULTILINE) for part in page.split("\n## ")[1:]]
    words = [word for section in sections for word in section]
    assert len(words) > 60
    assert sorted(set(words)) == sorted(words)
    for section in sections:
        assert section == sorted(section, key=str.lower)
    classes = re.findall(r"\| `(\w+)\.(\w+)` \|", page)
    assert len(classes) > 35
    for room, name in classes:
        files = (ROOT / "axcomp" / room).rglob("*.py")
        assert any(
            re.search(rf"^(class {name}\b|{name} = )", path.read_text("utf-8"), re.MULTILINE) for path in files
        ), name


def test_no_file_names_a_registry_or_a_place_on_this_machine() -> None:
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    here = re.escape(str(ROOT))
    forbidden = re.compile(rf"pypi\.org|pythonhosted|registry\.npmjs|deb\.debian|/root/\w|{here}")
    for name in filter(None, files):
        path = ROOT / name
        if path.suffix in {".png", ".fmu"} or path == Path(__file__) or not path.is_file():
            continue
        found = forbidden.search(path.read_text(encoding="utf-8", errors="replace"))
        assert found is None, f"{name}: {found.group() if found else ''}"


def test_the_commands_on_the_pages_are_understood() -> None:
    lines = [line for page in PAGES for line in re.findall(r"^ {4}axcomp (.+)", page.read_text("utf-8"), re.MULTILINE)]
    shown = {line.split()[0] for line in lines}
    assert shown >= {"show", "check", "measure", "create", "convert", "budget", "report", "sweep", "run", "replay"}
    for line in lines:
        parser = argparse.ArgumentParser(exit_on_error=False)
        subparsers = parser.add_subparsers(required=True)
        words = shlex.split(line)
        assert words[0] in COMMANDS
        import_module(f"axcomp.cli.{words[0]}").add_subparser(subparsers)
        parser.parse_args(words)


@pytest.mark.slow
def test_the_sweep_and_the_program_on_the_page_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "models").symlink_to(ROOT / "models")
    page = (ROOT / "docs" / "workbench.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    Path("sweep.toml").write_text(block, encoding="utf-8")
    assert main(["sweep", "sweep.toml", "--output", "results.csv", "--workers", "1"]) == 0
    assert len(Path("results.csv").read_text(encoding="utf-8").splitlines()) == 1 + 6
    (program,) = re.findall(r"((?: {4}(?:time,X|0).+\n)+)", page)
    Path("program.csv").write_text(program.replace(" " * 4, ""), encoding="utf-8")
    assert main(["run", "program.csv", "--machine", "models/three_axis", "--output", "result.csv"]) == 0
    assert "3 cycles" in capsys.readouterr().out


def test_the_trace_on_the_page_differs_as_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs" / "workbench.md").read_text(encoding="utf-8")
    (trace, said) = re.findall(r"```csv\n(.*?)```\n\n```text\n(.*?)```", page, re.DOTALL)[0]
    command = re.findall(r"^ {4}axcomp (replay .+)", page, re.MULTILINE)[0]
    Path("trace.csv").write_text(trace, encoding="utf-8")
    assert main(shlex.split(command)) == 1
    assert capsys.readouterr().out.endswith(said)


@pytest.mark.slow
def test_the_examples_for_python_run(tmp_path: Path) -> None:
    (tmp_path / "models").symlink_to(ROOT / "models")
    pages = [(ROOT / "docs" / name).read_text(encoding="utf-8") for name in ("hosts.md", "python.md")]
    blocks = [block for page in pages for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL)]
    assert len(blocks) == 5
    build = [sys.executable, str(ROOT / "build_fmu.py")]
    third = [*build, "--machine", "models/three_axis", "--fmi", "2.0", "3.0"]
    for command in (build, third, *([sys.executable, "-c", block] for block in blocks)):
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        result = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert result.returncode == 0, result.stderr
        assert result.stdout.strip()
