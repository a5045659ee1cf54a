"""``python -m axcomp.translate``: the committed C is what the kernel translates to."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from translating import write_package

from axcomp.kernel import EXPORTS
from axcomp.translate import main, translate

ROOT = Path(__file__).parents[2]
KERNEL = ROOT / "axcomp" / "kernel"
NATIVE = ROOT / "fmu_src" / "native"


def test_the_committed_c_is_what_the_kernel_translates_to() -> None:
    translation = translate(KERNEL, EXPORTS)
    assert (NATIVE / "kernel.h").read_text("utf-8") == translation.header, "run python -m axcomp.translate"
    assert (NATIVE / "kernel.c").read_text("utf-8") == translation.source, "run python -m axcomp.translate"


COMPILERS = {"C99": ["gcc", "-std=c99"], "C++": ["g++", "-std=c++11", "-x", "c++"], "clang": ["clang", "-std=c99"]}


@pytest.mark.parametrize("compiler", COMPILERS)
def test_the_committed_c_compiles_without_a_warning(compiler: str, tmp_path: Path) -> None:
    command = COMPILERS[compiler]
    if not shutil.which(command[0]):
        pytest.skip(f"there is no {command[0]} on this machine")
    warnings = ["-Wall", "-Wextra", "-pedantic", "-Wvla", "-Werror"]
    output = ["-O2", "-c", str(NATIVE / "kernel.c"), "-o", str(tmp_path / "kernel.o")]
    run = subprocess.run([*command, *warnings, *output], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


def test_the_command_writes_both_files_and_checks_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--output", str(tmp_path), "--check"]) == 1
    assert "kernel.h is not what the kernel translates to" in capsys.readouterr().err
    assert main(["--output", str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {"kernel.c", "kernel.h"}
    assert main(["--output", str(tmp_path), "--check"]) == 0
    (tmp_path / "kernel.c").write_text("int x;\n")
    assert main(["--output", str(tmp_path), "--check"]) == 1


def test_the_command_prints_every_refusal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "def cycle(x: float) -> float:\n    y = x ** 2.0\n    return [y]\n"
    folder = write_package(tmp_path / "kernel", {"cycle": text})
    (folder / "__init__.py").write_text('EXPORTS = ("cycle", "adopt")\n')
    assert main(["--kernel", str(folder), "--output", str(tmp_path)]) == 1
    complaints = capsys.readouterr().err
    assert "no module here defines the exported function adopt" in complaints
    assert not (tmp_path / "kernel.c").exists()


def test_a_missing_folder_is_a_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--output", str(tmp_path / "nowhere")]) == 1
    assert "is no folder" in capsys.readouterr().err
