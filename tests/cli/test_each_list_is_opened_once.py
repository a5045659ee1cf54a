"""A command opens each list of a machine once, whatever it does with it."""

from __future__ import annotations

import shutil
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.fmu import native_package
from axcomp.model import models
from axcomp.sweep import job_of, read_spec

SUFFIXES = {".lis", ".exc", ".csv"}
_watching: list[Counter[str]] = []


def _hook(event: str, arguments: tuple[object, ...]) -> None:
    if event == "open" and _watching and isinstance(arguments[0], (str, Path)):
        path, mode = Path(arguments[0]), arguments[1]
        if path.suffix in SUFFIXES and (mode is None or "r" in str(mode)):
            _watching[-1][path.name] += 1


sys.addaudithook(_hook)


@contextmanager
def opened() -> Iterator[Counter[str]]:
    """Count the files that are opened to be read, by their names."""
    _watching.append(Counter())
    try:
        yield _watching[-1]
    finally:
        _watching.pop()


@pytest.fixture
def machine(tmp_path: Path) -> Callable[[str], Path]:
    def copied(name: str) -> Path:
        folder = tmp_path / name
        folder.mkdir()
        for file in (models() / name).iterdir():
            if file.suffix in SUFFIXES and file.name not in {"input.csv", "expected.csv"}:
                shutil.copy(file, folder)
        (tmp_path / "x.csv").write_text("target,run,direction,deviation\n0,1,1,0\n0,1,-1,1\n100,1,1,2\n100,1,-1,3\n")
        (tmp_path / "tcp.csv").write_text(
            "x,y,z,a,c,dx,dy,dz\n0,0,0,0,0,0,0,0\n100,0,0,0,0,10,0,0\n200,0,0,0,0,20,0,0\n"
        )
        (tmp_path / "spec.toml").write_text(
            f'machine = "{name}"\nduration = 0.1\n[input]\nstart = {{ X = 0 }}\nmoves = [{{ X = 1 }}]\n'
            '[vary]\n"hochlauf.lis: zahl_mds" = [2, 3]\n[results]\n"X" = "max X.correction"\n'
        )
        return folder

    return copied


COMMANDS = {
    "check": ["check", "{lists}", "--feed", "30000", "--max-acceleration", "5m/s2"],
    "check in JSON": ["check", "{lists}", "--format", "json"],
    "show": ["show", "{lists}", "--output", "{out}.csv"],
    "report": ["report", "{lists}", "--output", "{out}.html", "--repeats", "0"],
    "build for Python": ["build", "--machine", "{lists}", "--runtime", "python", "--output", "{out}.fmu"],
    "build": ["build", "--machine", "{lists}", "--runtime", "native", "--output", "{out}.fmu"],
    "build an image": ["build", "--machine", "{lists}", "--image", "{out}.bin"],
    "diagnose": ["diagnose", "{lists}", "--output", "{out}.xlsx"],
    "convert": ["convert", "{lists}", "--kind", "leadscrew", "--to", "lists", "--output", "{out}"],
}

NOTHING_TO_DO = {("diagnose", "three_axis"), ("diagnose", "warm_axis"), ("convert", "five_axis")}


@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("model", ["three_axis", "five_axis", "warm_axis"])
def test_a_command_opens_each_list_once(
    name: str, model: str, machine: Callable[[str], Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native_package, "_libraries", lambda _: {})
    monkeypatch.chdir(tmp_path)
    lists = machine(model)
    (tmp_path / "new").mkdir()
    expected = {path.name: 1 for path in lists.iterdir()}
    with opened() as counts:
        status = main([word.format(lists=lists, out=tmp_path / "new" / "out") for word in COMMANDS[name]])
    assert status == 0 or (name, model) in NOTHING_TO_DO
    assert {file: count for file, count in counts.items() if file in expected} == expected


@pytest.mark.parametrize(
    ("model", "kind", "measurement", "into", "apart"),
    [
        ("three_axis", ["leadscrew"], "x.csv", "achskw2.lis", set()),
        ("three_axis", ["backlash"], "x.csv", "achsmd2.lis", set()),
        # What concerns only other axes is not looked at, but for the names of files in it.
        ("five_axis", ["volumetric", "--errors", "EXX"], "tcp.csv", "vol_comp0.lis", {"*.exc"}),
    ],
)
def test_create_opens_each_list_once(
    model: str,
    kind: list[str],
    measurement: str,
    into: str,
    apart: set[str],
    machine: Callable[[str], Path],
    tmp_path: Path,
) -> None:
    lists = machine(model)
    expected = {path.name: 1 for path in lists.iterdir() if not any(path.match(one) for one in apart)}
    with opened() as counts:
        assert main(["create", *kind, "--from", str(tmp_path / measurement), "--into", str(lists / into)]) == 0
    counts.pop(measurement)
    assert counts == expected


def test_planning_a_sweep_opens_each_list_once(machine: Callable[[str], Path], tmp_path: Path) -> None:
    expected = {path.name: 1 for path in machine("three_axis").iterdir()}
    spec = read_spec(tmp_path / "spec.toml")
    with opened() as counts:
        job_of(spec)
    assert counts == expected
