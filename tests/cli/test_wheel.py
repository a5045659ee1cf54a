"""The installed wheel: it builds in any folder what the checkout builds."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest

from axcomp.browser import PARTS
from axcomp.demo.examples import EXPECTED, INPUT, read_csv
from axcomp.model import models
from axcomp.native import WASM, prebuilt_path

ROOT = Path(__file__).parents[2]


def run(*command: str | Path, cwd: Path, path: str = os.environ.get("PATH", "")) -> str:
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | {"PATH": path}
    result = subprocess.run(
        [str(part) for part in command], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what the wheel is made of."""
    folder = tmp_path_factory.mktemp("checkout")
    for name in ("axcomp", "fmu_src", "models"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE", "build_fmu.py"):
        shutil.copy(ROOT / name, folder)
    (folder / "docs").mkdir()
    shutil.copy(ROOT / "docs" / "findings.md", folder / "docs")
    return folder


@pytest.fixture(scope="module")
def installed(checkout: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Scripts folder of a fresh virtual environment with the wheel; its dependencies are those of this one."""
    folder = tmp_path_factory.mktemp("wheel")
    isolation = ["--no-build-isolation"] if importlib.util.find_spec("hatchling") else []
    run(sys.executable, "-m", "pip", "wheel", "--no-deps", *isolation, "-w", folder, checkout, cwd=folder)
    (wheel,) = folder.glob("*.whl")
    run(sys.executable, "-m", "venv", "--without-pip", folder / "venv", cwd=folder)
    variables = {"base": str(folder / "venv"), "platbase": str(folder / "venv")}
    packages = Path(sysconfig.get_path("purelib", "venv", variables))
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib"), encoding="utf-8")
    scripts = Path(sysconfig.get_path("scripts", "venv", variables))
    run(sys.executable, "-m", "pip", "--python", scripts / "python", "install", "--no-deps", wheel, cwd=folder)
    return scripts


@pytest.mark.slow
def test_an_installed_wheel_builds_in_any_folder_what_the_checkout_builds(
    checkout: Path, installed: Path, tmp_path: Path
) -> None:
    place = run(installed / "python", "-c", "import axcomp; print(axcomp.__file__)", cwd=tmp_path).strip()
    assert Path(place).is_relative_to(installed.parent)
    assert run(installed / "axcomp", "build", cwd=tmp_path).startswith("axcomp.fmu: ")
    run(sys.executable, "build_fmu.py", cwd=checkout)
    for name in ("axcomp.fmu", "plant.fmu"):
        assert (tmp_path / name).read_bytes() == (checkout / name).read_bytes()


@pytest.mark.slow
def test_without_any_compiler_an_installed_wheel_builds_an_fmu_that_gives_the_expected_output(
    installed: Path, tmp_path: Path
) -> None:
    model = models() / "three_axis"

    def call(*command: str | Path) -> str:
        return run(*command, cwd=tmp_path, path=str(tmp_path / "nothing"))

    assert call(installed / "axcomp", "build").startswith("axcomp.fmu: ")
    fmpy = (installed / "python", "-m", "fmpy")
    assert "No problems found" in call(*fmpy, "validate", "axcomp.fmu")
    call(*fmpy, "simulate", "axcomp.fmu", "--input-file", model / INPUT, "--output-file", "output.csv")
    output = tmp_path / "output.csv"
    output.write_text(output.read_text().replace("True", "1").replace("False", "0"))
    simulated, expected = read_csv(output), read_csv(model / EXPECTED)
    assert set(simulated) == set(expected)
    for column, values in expected.items():
        assert np.allclose(simulated[column], values, rtol=0.0, atol=1e-8), column


@pytest.mark.slow
def test_an_installed_wheel_explains_findings(installed: Path, tmp_path: Path) -> None:
    assert "## AXC-GAP" in run(installed / "axcomp", "check", "--explain", "AXC-GAP", cwd=tmp_path)
    page = run(installed / "python", "-c", "from axcomp.lint import PAGE; print(PAGE)", cwd=tmp_path).strip()
    assert "## AXC-GAP" in Path(page).read_text(encoding="utf-8")


@pytest.mark.slow
def test_an_installed_wheel_builds_the_page(installed: Path, tmp_path: Path) -> None:
    """Of Pyodide there are only names here: it is fetched, and not in the wheel."""
    (tmp_path / "pyodide").mkdir()
    for name in PARTS:
        (tmp_path / "pyodide" / name).write_bytes(b"")
    run(installed / "axcomp", "page", "--pyodide", "pyodide", "--output", "site", "--cycles", "10", cwd=tmp_path)
    built = {path.name for path in (tmp_path / "site").iterdir()}
    static = {path.name for path in (ROOT / "axcomp" / "browser" / "static").iterdir()}
    assert built == static | {"pyodide", "axcomp.zip", "kernel.wasm", "examples.json", "proof.json", "site.json"}
    assert (tmp_path / "site" / "kernel.wasm").read_bytes() == prebuilt_path(WASM).read_bytes()
