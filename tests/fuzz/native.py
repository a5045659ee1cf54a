"""The fuzzer of the C layer: compiled with sanitizers, fed with images of example and random machines."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

from axcomp.lists import read_machine
from axcomp.model import fmu_sources, models
from axcomp.native import LIBRARY_SOURCES, image_of
from axcomp.runtime import compile_tables
from axcomp.saving import write_whole

sys.path.append(str(Path(__file__).parents[1] / "reference"))
import random_machines

HERE = Path(__file__).parent
_FLAGS = """
-std=gnu99 -O1 -g -ffp-contract=off -fsanitize=address,undefined,float-cast-overflow,bounds
-fno-sanitize=float-divide-by-zero -fno-sanitize-recover=all -fno-omit-frame-pointer
"""
FLAGS = _FLAGS.split()
GUID = "{fuzz}"


def compiler() -> str | None:
    """Return a compiler that has the sanitizers, None if there is none."""
    return shutil.which("gcc") or shutil.which("clang")


def build(folder: Path, compile_with: str | None = None) -> Path:
    """Compile the fuzzer."""
    native = fmu_sources() / "native"
    program = folder / "native_fuzz"
    sources = [str(HERE / "native_fuzz.c"), *(str(native / name) for name in LIBRARY_SOURCES)]
    command = [compile_with or compiler() or "cc", *FLAGS, f"-I{native}", *sources, "-o", str(program), "-lm", "-ldl"]
    subprocess.run(command, check=True)
    return program


def seed_images(folder: Path, machines: int = 24) -> list[Path]:
    """Write images of example and random machines."""
    found = [read_machine(path).machine for path in sorted(models().iterdir()) if (path / "hochlauf.lis").is_file()]
    found += [random_machines.machine(np.random.default_rng(seed)) for seed in range(machines)]
    paths = []
    for number, machine in enumerate(found):
        path = folder / f"seed{number}.bin"
        write_whole(path, image_of(compile_tables(machine), GUID))
        paths.append(path)
    return paths


def run(program: Path, what: str, count: int, seconds: float, seed: int, images: list[Path]) -> str:
    """Run it; the line it says, AssertionError with what a sanitizer says else."""
    folder = program.parent
    command = [str(program), what, str(count), str(seconds), str(seed), str(folder), *map(str, images)]
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-4000:]
    return done.stdout.strip()
