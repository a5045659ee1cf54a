"""The sources in the FMU: they compile without a warning, hold the tables, and compute the same bits."""

from __future__ import annotations

import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import fmpy
import pytest
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.engine import Engine
from axcomp.native import PLATFORMS, own_platform

COMPILERS = {
    "C99": ["gcc", "-std=c99", "-pedantic"],
    "GNU C": ["gcc"],
    "AVX2": ["gcc", "-O3", "-mavx2", "-mfma"],
    "C++": ["g++", "-x", "c++"],
    "C++20": ["g++", "-std=c++20", "-x", "c++"],
    "clang": ["clang", "-std=c99", "-pedantic"],
    "clang, C++": ["clang++", "-x", "c++"],
    "tcc": ["tcc"],
    "zig": [sys.executable, "-m", "ziglang", "cc", "-std=c99", "-pedantic"],
}


def run_rows(fmu: Path, folder: Path, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    with Host(fmu, folder=folder) as host:
        return host.run(rows)


def with_reload(fmu: Path, folder: Path) -> tuple[list[int], list[Any]]:
    """Return the errors of the axes after an update, and the log."""
    with Host(fmu, folder=folder) as host:
        outputs = host.step({"update_path": "other.bin", "reload": True})
        return [value for name, value in outputs.items() if name.endswith(".error")], host.messages


def library_of(folder: Path) -> Path:
    own = own_platform()
    return folder / "binaries" / own / f"axcomp{PLATFORMS[own].suffix}"


@pytest.mark.parametrize("compiler", COMPILERS)
def test_they_compile_without_a_warning_and_need_no_file(native_fmu: Path, compiler: str, tmp_path: Path) -> None:
    command = COMPILERS[compiler]
    if not shutil.which(command[0]) or ("ziglang" in command and find_spec("ziglang") is None):
        pytest.skip(f"there is no {compiler} on this machine")
    if "-mavx2" in command and "avx2" not in Path("/proc/cpuinfo").read_text():
        pytest.skip("this machine has no AVX2")
    folder = Path(fmpy.extract(native_fmu, tmp_path))
    shutil.rmtree(folder / "resources")
    library = library_of(folder)
    library.unlink()
    (sources,) = fmpy.read_model_description(folder).buildConfigurations[0].sourceFileSets
    options = ["-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-o", str(library)]
    options.append("-DFMI2_OVERRIDE_FUNCTION_PREFIX")
    run = subprocess.run(
        [*command, *options, *sources.sourceFiles, "-lm"],
        cwd=folder / "sources",
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    engine, rows = Engine(three_axes()), trajectory(400)
    assert in_child(run_rows, native_fmu, folder, rows) == [engine.step(row) for row in rows]
    assert in_child(with_reload, native_fmu, folder) == ([902] * 3, [])


def test_musl_takes_them_too(native_fmu: Path, tmp_path: Path) -> None:
    if not shutil.which("musl-gcc"):
        pytest.skip("there is no musl-gcc on this machine")
    folder = Path(fmpy.extract(native_fmu, tmp_path)) / "sources"
    command = ["musl-gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", *(path.name for path in folder.glob("*.c"))]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


def test_fmi_3s_way_of_building_names_the_same_files(native_fmu: Path, tmp_path: Path) -> None:
    folder = Path(fmpy.extract(native_fmu, tmp_path))
    (configuration,) = fmpy.model_description.read_build_description(str(folder))
    (sources,) = configuration.sourceFileSets
    (listed,) = fmpy.read_model_description(folder).buildConfigurations[0].sourceFileSets
    assert sources.sourceFiles == listed.sourceFiles
    assert [one.name for one in sources.preprocessorDefinitions] == ["FMI2_OVERRIDE_FUNCTION_PREFIX"]


def test_twincat_is_told_how_the_tool_is_called_and_where_headers_are(native_fmu: Path, tmp_path: Path) -> None:
    folder = Path(fmpy.extract(native_fmu, tmp_path))
    (found,) = ElementTree.parse(folder / "documentation" / "CustomFMU.xml").getroot()
    assert found.findtext("ToolName") == fmpy.read_model_description(folder).generationTool
    assert found.findtext("AdditionalInclude") == "$(ProjectDir);$(ProjectDir)sources;"


@pytest.mark.slow
def test_fmpys_own_command_compiles_them(native_fmu: Path, tmp_path: Path) -> None:
    if not shutil.which("cmake"):
        pytest.skip("there is no CMake on this machine")
    fmu = Path(shutil.copy(native_fmu, tmp_path))
    command = ["-m", "fmpy", "compile", str(fmu), "--all-warnings", "--warning-as-error"]
    run = subprocess.run([sys.executable, *command], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    folder = Path(fmpy.extract(fmu, tmp_path / "fmu"))
    prebuilt = library_of(Path(fmpy.extract(native_fmu, tmp_path / "o")))
    assert library_of(folder).read_bytes() != prebuilt.read_bytes()
    shutil.rmtree(folder / "resources")
    engine, rows = Engine(three_axes()), trajectory(100)
    assert in_child(run_rows, fmu, folder, rows) == [engine.step(row) for row in rows]
    # The only functions it takes from elsewhere are those of the C library.
    if shutil.which("nm"):
        symbols = subprocess.run(
            ["nm", "-D", "--defined-only", "--format=just-symbols", str(library_of(folder))],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split()
        assert [name for name in symbols if not name.startswith(("fmi2", "axcomp_", "_"))] == []
