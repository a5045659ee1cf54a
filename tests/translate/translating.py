"""A small package of restricted Python, as a module and as a compiled library."""

from __future__ import annotations

import ctypes
import importlib
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import pytest

import axcomp.kernel.record
from axcomp.translate import Translation, translate

WARNINGS = ["-Wall", "-Wextra", "-Wno-tautological-compare", "-Werror"]
PREAMBLE = """\
from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import Annotated, Final

from .record import Vec, whole, zeros

"""


@dataclass(frozen=True)
class Built:
    """The same functions twice: ``python.f`` and ``native.axcomp_f``."""

    python: ModuleType
    native: ctypes.CDLL
    translation: Translation


def write_package(folder: Path, modules: dict[str, str]) -> Path:
    """Write modules into a package, with the run-time module of the kernel."""
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    shutil.copy(axcomp.kernel.record.__file__, folder / "record.py")
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder


def compile_c(source: Path, output: Path, *options: str) -> None:
    """Compile generated C without a warning."""
    command = ["gcc", *WARNINGS, *options, "-o", str(output), str(source), "-lm"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


class Builder:
    """Translates, compiles and imports modules given as text; the folder of the packages is on Python's path."""

    def __init__(self, folder: Path) -> None:
        if not shutil.which("gcc"):
            pytest.skip("there is no gcc on this machine")
        self._folder = folder
        self._names: list[str] = []

    def __call__(self, text: str, exports: list[str], *options: str) -> Built:
        """Build one module; ``options`` replace the compiler's usual ones."""
        name = f"translated_{len(self._names)}"
        self._names.append(name)
        folder = write_package(self._folder / name, {"functions": text})
        translation = translate(folder, exports)
        (folder / "kernel.h").write_text(translation.header, encoding="utf-8")
        (folder / "kernel.c").write_text(translation.source, encoding="utf-8")
        compile_c(folder / "kernel.c", folder / "kernel.so", "-shared", "-fPIC", *(options or ("-std=c99", "-O2")))
        importlib.invalidate_caches()
        return Built(importlib.import_module(f"{name}.functions"), ctypes.CDLL(str(folder / "kernel.so")), translation)

    def forget(self) -> None:
        """Remove the modules from Python."""
        for name in [name for name in sys.modules if name.split(".")[0] in self._names]:
            del sys.modules[name]
