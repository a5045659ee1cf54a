"""What axcomp needs: NumPy at most for check and build; everything else says which extra brings it."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from axcomp.cli import COMMANDS, EXTRA
from axcomp.model import EXTRAS, MissingExtraError, models, needed, sentence

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OPTIONAL: dict[str, list[str]] = PROJECT["optional-dependencies"]

WITHOUT = """
import sys
from importlib.machinery import PathFinder
allowed = {"axcomp", *filter(None, sys.argv[1].split(",")), *sys.stdlib_module_names}
class Only:
    @staticmethod
    def find_spec(name, path=None, target=None):
        top = name.partition(".")[0]
        return PathFinder.find_spec(name, path, target) if top in allowed or top.startswith("_") else None
own = ("BuiltinImporter", "FrozenImporter")
sys.meta_path[:] = [one for one in sys.meta_path if getattr(one, "__name__", "") in own]
sys.meta_path.append(Only)
from axcomp.cli import main
sys.exit(main(sys.argv[2:]))
"""


def run(allowed: str, *arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", WITHOUT, allowed, *map(str, arguments)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80"}
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, check=False)


def packages(extra: str) -> dict[str, str]:
    """Return the packages of an extra with their lowest versions, those of extras in it too."""
    found: dict[str, str] = {}
    for requirement in OPTIONAL[extra]:
        match = re.match(r"([\w-]+)(?:\[([\w, ]*)\])?(?: >= ([\w.]+))?", requirement)
        assert match is not None
        if match[1] == "axcomp":
            for other in match[2].split(","):
                found |= packages(other.strip())
        else:
            found[match[1]] = match[3] or ""
    return found


@pytest.mark.parametrize("machine", ["three_axis", "five_axis", "warm_axis"])
@pytest.mark.parametrize("allowed", ["", "numpy"])
def test_check_and_build_need_numpy_at_most(allowed: str, machine: str, tmp_path: Path) -> None:
    assert [re.match(r"[\w-]+", one)[0] for one in PROJECT["dependencies"]] == ["numpy"]  # type: ignore[index]
    if allowed or machine == "warm_axis":
        checked = run(allowed, "check", models() / machine, cwd=tmp_path)
        assert (checked.returncode, checked.stderr) == (0, "")
    built = run(allowed, "build", "--machine", models() / machine, cwd=tmp_path)
    assert built.returncode == 0, built.stderr
    assert "pip install" not in built.stderr
    assert (tmp_path / "axcomp.fmu").stat().st_size > 10_000


def test_every_other_command_says_its_extra_where_that_is_missing(tmp_path: Path) -> None:
    for command in COMMANDS:
        done = run("numpy", command, "--help", cwd=tmp_path)
        if done.returncode == 0:
            continue
        said = done.stderr.strip()
        assert re.fullmatch(rf"axcomp: {command} needs \w+: pip install 'axcomp\[{EXTRA[command]}\]'", said), said
    listed = " ".join(run("numpy", "--help", cwd=tmp_path).stdout.split())
    assert f"there are also: {', '.join(name for name in COMMANDS if name in EXTRA)}." in listed


def test_an_fmu_for_python_and_a_plant_say_theirs(tmp_path: Path) -> None:
    for arguments in (["build"], ["build", "--runtime", "python"]):
        done = run("numpy", *arguments, cwd=tmp_path)
        assert done.returncode == 1
        assert "pip install 'axcomp[python]'" in done.stderr
        assert "Traceback" not in done.stderr


def test_a_missing_package_is_one_sentence() -> None:
    assert sentence("scipy.optimize", what="create") == "create needs scipy: pip install 'axcomp[demo]'"
    with pytest.raises(MissingExtraError, match=r"This needs no_such: pip install 'axcomp\[plot\]'"):
        needed("no_such.module", "plot")


def test_the_extras_are_those_of_the_project() -> None:
    modules = {"dask[distributed]": "dask"}
    for extra, imported in EXTRAS.items():
        installed = {modules.get(name, name) for name in packages(extra)}
        assert {*imported} - {"distributed"} == installed, extra
    everything = set().union(*(packages(extra) for extra in EXTRAS))
    assert set(packages("workbench")) == everything
    assert set(EXTRA.values()) <= set(EXTRAS)


def test_the_constraints_are_the_lowest_versions_that_are_promised() -> None:
    lines = (ROOT / "constraints-lowest.txt").read_text(encoding="utf-8").splitlines()
    pinned = dict(line.split("==") for line in lines if not line.startswith("#"))
    promised = {**packages("workbench"), **packages("docs"), "numpy": PROJECT["dependencies"][0].split(">= ")[1]}
    promised["distributed"] = promised["dask"]

    def numbers(version: str) -> list[int]:
        return [int(part) for part in version.split(".")]

    assert set(pinned) == set(promised)
    for name, lowest in promised.items():
        assert numbers(pinned[name])[: len(numbers(lowest))] == numbers(lowest), name


@pytest.mark.slow
@pytest.mark.skipif(sys.version_info[:2] != (3, 11), reason="the lowest versions are those for Python 3.11")
def test_the_lowest_versions_do(tmp_path: Path) -> None:
    venv = tmp_path / "venv"
    subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    python = next(path for path in (venv / "bin" / "python", venv / "Scripts" / "python.exe") if path.exists())
    install = [python, "-m", "pip", "install", "-q", "-c", ROOT / "constraints-lowest.txt", f"{ROOT}[workbench]"]
    done = subprocess.run(install, capture_output=True, text=True, check=False)
    assert "ResolutionImpossible" not in done.stderr, done.stderr
    if done.returncode:
        pytest.skip(f"pip cannot install here: {done.stderr[-300:]}")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    machine = models() / "three_axis"
    for arguments in (
        ["check", machine, "--input", machine / "input.csv"],
        ["build"],
        ["show", machine, "--output", "page.html"],
        ["budget", machine, "--input", machine / "input.csv"],
        ["report", machine, "--repeats", "0"],
        ["diagnose", models() / "five_axis", "--output", "d.xlsx"],
        ["demo"],
    ):
        command = [python, "-m", "axcomp", *map(str, arguments)]
        done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, (arguments, done.stderr)
