"""What ``import axcomp`` offers: all of it there, typed, documented, and its examples right."""

from __future__ import annotations

import dataclasses
import doctest
import importlib
import inspect
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import axcomp

ROOT = Path(__file__).parents[1]
CONSUMER = Path(__file__).parent / "consumer"


def callables() -> Iterator[tuple[str, Callable[..., object]]]:
    """Yield everything a user calls: functions, classes, and the public methods that axcomp's classes define."""
    for name in axcomp.__all__:
        thing = getattr(axcomp, name)
        if not callable(thing):
            continue
        yield name, thing
        if inspect.isclass(thing):
            for method, defined in vars(thing).items():
                found = getattr(defined, "__func__", defined)
                if inspect.isfunction(found) and not method.startswith("_"):
                    yield f"{name}.{method}", found


CALLABLES = dict(callables())


def parameters_of(thing: Callable[..., object]) -> list[str]:
    """Return the parameters that a user can give; those of a NamedTuple and an exception too."""
    if inspect.isclass(thing) and issubclass(thing, tuple):
        return [name for name in thing._fields if not name.startswith("_")]  # type: ignore[attr-defined]
    if inspect.isclass(thing) and (issubclass(thing, BaseException) or hasattr(thing, "__members__")):
        return []
    names = [name for name in inspect.signature(thing).parameters if name != "self" and not name.startswith("_")]
    if dataclasses.is_dataclass(thing):
        names += [field.name for field in dataclasses.fields(thing) if not field.name.startswith("_")]
    return list(dict.fromkeys(names))


def test_everything_offered_is_there_and_loaded_only_when_used() -> None:
    assert sorted(dir(axcomp)) == sorted(axcomp.__all__)
    assert all(getattr(axcomp, name, None) is not None for name in axcomp.__all__)
    code = "import sys, axcomp; print([m for m in sys.modules if m.startswith('axcomp.') or m == 'numpy'])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"
    with pytest.raises(AttributeError, match="no attribute 'Motor'"):
        axcomp.Motor  # type: ignore[attr-defined]  # noqa: B018


def test_loading_a_room_hides_no_function_of_its_name() -> None:
    for name, thing in CALLABLES.items():
        if "." not in name:
            importlib.import_module("axcomp.conversion")
            assert getattr(axcomp, name) is thing


@pytest.mark.parametrize("name", CALLABLES)
def test_a_docstring_names_every_parameter(name: str) -> None:
    thing = CALLABLES[name]
    text = inspect.getdoc(thing) or ""
    assert re.match(r"[^\n]+[.:]\n|[^\n]+[.:]\Z|[^\n]+\n", text), f"{name} has no first line"
    named = set(re.findall(r"^(\*{0,2}\w+(?:, \*{0,2}\w+)*)(?: :.*)?$", text, re.MULTILINE))
    words = {word.strip("* ") for group in named for word in group.split(",")} | set(re.findall(r"``(\w+)\b", text))
    # A class may say with its attributes what its constructor takes.
    missing = [parameter for parameter in parameters_of(thing) if parameter not in words]
    assert missing == [], f"{name}: {missing} not in its docstring"


@pytest.mark.parametrize("name", [name for name, thing in CALLABLES.items() if len(parameters_of(thing)) > 2])
def test_a_docstring_of_more_than_two_parameters_has_an_example(name: str) -> None:
    assert ">>>" in (inspect.getdoc(CALLABLES[name]) or ""), name


@pytest.mark.parametrize("name", [name for name, thing in CALLABLES.items() if ">>>" in (inspect.getdoc(thing) or "")])
def test_the_examples_of_a_docstring_are_right(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    thing = CALLABLES[name]
    (found,) = doctest.DocTestFinder(recurse=False).find(thing, name, globs={})
    said: list[str] = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    runner.run(found, out=said.append)
    assert runner.failures == 0, "".join(said)


@pytest.mark.slow
def test_a_consumers_project_is_typed_by_mypy(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", f"--cache-dir={tmp_path}", CONSUMER]
    result = subprocess.run(command, cwd=tmp_path, env=environment(), capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout


@pytest.mark.slow
def test_a_consumers_project_is_typed_by_pyright(tmp_path: Path) -> None:
    if shutil.which("pyright") is None or shutil.which("node") is None:
        pytest.skip("pyright or node is not installed")
    shutil.copytree(CONSUMER, tmp_path / "consumer")
    settings = {"typeCheckingMode": "strict", "extraPaths": [str(ROOT)], "useLibraryCodeForTypes": True}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings))
    command = ["pyright", "--outputjson", "--pythonpath", sys.executable, "consumer"]
    result = subprocess.run(command, cwd=tmp_path, env=environment(), capture_output=True, text=True, check=False)
    if not result.stdout.startswith("{"):
        pytest.skip(f"pyright cannot run here: {result.stderr[-300:]}")
    found = json.loads(result.stdout)["generalDiagnostics"]
    assert [f"{one['range']['start']['line'] + 1}: {one['message']}" for one in found] == []


def environment() -> dict[str, str]:
    return {**os.environ, "MYPYPATH": str(ROOT), "PYTHONPATH": str(ROOT)}
