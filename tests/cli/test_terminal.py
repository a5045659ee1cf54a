"""The terminal: help and tables fit, nothing is cut, a missing folder is refused first, interruptions are quiet."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from rich.console import Console

from axcomp.cli import COMMANDS, main
from axcomp.cli.parser import Parser
from axcomp.model import models
from axcomp.plot import table

ROOT = Path(__file__).parents[2]
THREE = str(models() / "three_axis")


def parser_of(command: str) -> argparse.ArgumentParser:
    parser = Parser(prog="axcomp")
    made = parser.add_subparsers()
    import_module(f"axcomp.cli.{command}").add_subparser(made)
    found: argparse.ArgumentParser = made.choices[command]
    return found


def parsers() -> Iterator[argparse.ArgumentParser]:
    """Yield the parser of every command, and of every kind that one has."""
    for command in COMMANDS:
        parser = parser_of(command)
        yield parser
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                yield from action.choices.values()


PARSERS = {parser.prog.removeprefix("axcomp "): parser for parser in parsers()}


@pytest.mark.parametrize("width", [80, 120])
@pytest.mark.parametrize("command", PARSERS)
def test_help_fits_the_terminal(command: str, width: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    for line in PARSERS[command].format_help().splitlines():
        # A word that is longer than the line, as an address or a quoted argument, is not broken.
        assert len(line) <= width or len(max(line.split(), key=len)) > width - 24, line


@pytest.mark.parametrize("command", PARSERS)
def test_the_examples_in_the_help_can_be_copied(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    text = re.sub(r" \\\n\s+", " ", PARSERS[command].format_help())
    assert "example" in text or "KIND" in text
    for line in re.findall(r"^  axcomp (.+)$", text, re.MULTILINE):
        words = shlex.split(line.split(" > ")[0])
        parser = Parser(prog="axcomp", exit_on_error=False)
        made = parser.add_subparsers(required=True)
        import_module(f"axcomp.cli.{words[0]}").add_subparser(made)
        parser.parse_args(words)


HEADER = ["target [mm]", *(f"x{k}" for k in range(12))]
ROWS = [[f"{-500.25 * k:.2f}", *(f"{10.0**k * (-1) ** j:.3f}" for j in range(12))] for k in range(7)]


@pytest.mark.parametrize("width", [20, 40, 80, 120, 160])
def test_a_table_cuts_no_number_and_is_no_wider_than_the_terminal(width: int) -> None:
    console = Console(width=width, markup=False, highlight=False)
    with console.capture() as captured:
        console.print(table("A title that is longer than some terminals are wide", HEADER, ROWS))
    text = captured.get()
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text
    words = text.split()
    for row in ROWS:
        for cell in row:
            assert words.count(cell) >= 1, cell


@pytest.mark.parametrize(
    "arguments",
    [
        ["show", THREE],
        ["show", str(models() / "five_axis")],
        ["budget", THREE, "--input", f"{THREE}/input.csv"],
        ["measure", str(models() / "measurements" / "x.csv")],
        ["parameters"],
    ],
)
def test_what_a_command_prints_fits_eighty_columns(
    arguments: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert main(arguments) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert not [line for line in lines if re.search(r"\d…", line)]


@pytest.mark.parametrize(
    "arguments",
    [
        ["show", "no_lists", "--output", "gone/x.png"],
        ["build", "--machine", "no_lists", "--output", "gone/x.fmu"],
        ["build", "--image", "gone/x.bin"],
        ["run", "no_program", "--machine", THREE, "--output", "gone/x.csv"],
        ["budget", "no_lists", "--input", "none", "--plot", "gone/x.png"],
        ["measure", "none", "--plot", "gone/x.png"],
        ["report", "no_lists", "--output", "gone/x.html"],
        ["demo", "--output", "gone/further"],
    ],
)
def test_output_into_a_missing_folder_is_refused_before_the_work(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 1
    said = capsys.readouterr()
    name = Path(arguments[-1]).name
    assert (said.out, said.err) == ("", f"axcomp {arguments[0]}: there is no folder gone for {name}\n")
    assert list(tmp_path.iterdir()) == []


def start(*arguments: str, cwd: Path, **options: int) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "axcomp", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.Popen(command, cwd=cwd, env=environment, text=True, stderr=subprocess.PIPE, **options)


@pytest.mark.skipif(os.name == "nt", reason="a console's interruption is another thing there")
def test_an_interruption_leaves_no_traceback_and_no_file(tmp_path: Path) -> None:
    program = tmp_path / "p.csv"
    program.write_text("X.setpoint,command\n" + "".join(f"{k % 7},X[COMP ON LEAD]\n" for k in range(400_000)))
    running = start("run", str(program), "--machine", THREE, "--output", "r.csv", cwd=tmp_path)
    time.sleep(1.5)
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert said == "axcomp: interrupted\n"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["p.csv"]


@pytest.mark.skipif(os.name == "nt", reason="pipes break otherwise there")
@pytest.mark.parametrize("arguments", [["parameters", "--format", "json"], ["show", THREE, "--rows", "0"]])
def test_a_pipe_that_is_closed_early_is_no_error(arguments: list[str], tmp_path: Path) -> None:
    running = start(*arguments, cwd=tmp_path, stdout=subprocess.PIPE)
    assert running.stdout is not None
    with running:
        running.stdout.readline()
        running.stdout.close()
        assert running.stderr is not None
        assert running.stderr.read() == ""


@pytest.mark.skipif(os.name == "nt", reason="argcomplete writes to descriptor 8")
@pytest.mark.parametrize(
    ("line", "found"),
    [("axcomp me", {"measure"}), ("axcomp show --ki", {"--kind"}), ("axcomp show --kind cros", {"cross", "crosstalk"})],
)
def test_the_shell_completes_commands_options_and_values(line: str, found: set[str], tmp_path: Path) -> None:
    pytest.importorskip("argcomplete")
    answer = tmp_path / "answer"
    completing = {"_ARGCOMPLETE": "1", "COMP_LINE": line, "COMP_POINT": str(len(line)), "COMP_TYPE": "9"}
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **completing, "_ARGCOMPLETE_STDOUT_FILENAME": str(answer)}
    subprocess.run([sys.executable, "-m", "axcomp"], env=environment, check=True, capture_output=True)
    assert {word.strip() for word in answer.read_text().split("\v")} >= found
