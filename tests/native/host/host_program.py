"""The host program of these tests: C that drives an FMU by a script, built in several ways and for several machines."""

from __future__ import annotations

import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest

from axcomp.native import FLAGS, LIBRARY_SOURCES, prebuilt_path, why_not_prebuilt

ROOT = Path(__file__).parents[3]
NATIVE = ROOT / "fmu_src" / "native"
LOADER = ROOT / "fmu_src" / "native_host"
HOST = Path(__file__).parent
OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer", "-g")
WINE = shutil.which("wine64") or "/usr/lib/wine/wine64"  # where Debian's package has it
SSE = ("-msse2", "-mfpmath=sse")
OPTIONS = ("-std=c99", "-ffp-contract=off", "-fvisibility=hidden")


@dataclass(frozen=True)
class Way:
    """How library and host are built, and what runs the host.

    ``linked``: in one program without a library to load; ``prebuilt``: platform whose library, as it comes with the
    package, is loaded.
    """

    compiler: tuple[str, ...]
    flags: tuple[str, ...] = ("-O2",)
    runner: tuple[str, ...] = ()
    suffix: str = ".so"
    linked: bool = False
    prebuilt: str = ""
    environment: dict[str, str] = field(default_factory=dict, hash=False)


def _zig(target: str) -> tuple[str, ...]:
    return (sys.executable, "-m", "ziglang", "cc", "-target", target)


WAYS = {
    "gcc": Way(("gcc",)),
    "gcc-avx2": Way(("gcc",), ("-O3", "-mavx2", "-mfma")),
    "sanitized": Way(("gcc",), ("-O1", *SANITIZERS), environment={"ASAN_OPTIONS": "detect_leaks=1"}),
    # A flag that is neither 0 nor 1 is a mistake for the sanitizer, but does no harm.
    "forged": Way(("gcc",), ("-O1", *SANITIZERS, "-fno-sanitize=bool")),
    "threads": Way(("gcc",), ("-O1", "-g", "-fsanitize=thread")),
    "valgrind": Way(("gcc",), runner=("valgrind", "-q", "--error-exitcode=99", "--leak-check=full")),
    "linux64": Way(_zig("x86_64-linux-gnu.2.17"), prebuilt="linux64"),
    "linux32": Way(_zig("x86-linux-gnu.2.17"), SSE, prebuilt="linux32"),
    "win64": Way(
        _zig("x86_64-windows-gnu"), runner=(WINE,), suffix=".dll", prebuilt="win64", environment={"WINEDEBUG": "-all"}
    ),
    "win32": Way(
        _zig("x86-windows-gnu"),
        SSE,
        runner=("wine",),
        suffix=".dll",
        prebuilt="win32",
        environment={"WINEDEBUG": "-all"},
    ),
    "aarch64": Way((*_zig("aarch64-linux-musl"), "-static"), runner=("qemu-aarch64",), linked=True),
    "arm32": Way((*_zig("arm-linux-musleabihf"), "-static"), runner=("qemu-arm",), linked=True),
    "i386": Way((*_zig("x86-linux-musl"), "-static"), ("-O2", *SSE), runner=("qemu-i386",), linked=True),
}


class Answer(NamedTuple):
    """What one command of a script has returned, and what the FMU has logged meanwhile."""

    status: int
    values: list[str]
    log: list[str]


@dataclass(frozen=True)
class Program:
    """A host with the library it loads."""

    way: Way
    host: Path
    library: Path

    def run(self, script: Sequence[str], folder: Path) -> list[Answer]:
        """Run a script to its end, which must be reached; return an answer for each line."""
        path = folder / "script.txt"
        path.write_bytes("".join(f"{line}\n" for line in script).encode())
        environment = {**os.environ, **self.way.environment}
        if self.way.suffix == ".dll":
            environment["WINEPREFIX"] = str(self.host.parent / "wine")
        runner = list(self.way.runner)
        if runner and not shutil.which(runner[0]):
            runner[0] += "-static"
        result = subprocess.run(
            [*runner, str(self.host), str(self.library), str(path)],
            capture_output=True,
            check=False,
            env=environment,
            cwd=folder,
            timeout=600,
        )
        output = result.stdout.decode("utf-8", "replace").splitlines()
        done = sum(line.startswith("= ") for line in output)
        where = script[done] if done < len(script) else "the end"
        complaint = result.stderr.decode("utf-8", "replace")[-4000:]
        assert result.returncode == 0, f"the host ended with {result.returncode} at {where}\n{complaint}"
        assert output[-1] == "end", f"no end after {where}"
        return _answers(output[:-1], script)


def _answers(output: list[str], script: Sequence[str]) -> list[Answer]:
    answers: list[Answer] = []
    log: list[str] = []
    for line in output:
        assert not line.startswith("! "), line
        if line.startswith("= "):
            status, *values = line[2:].split(" ")
            answers.append(Answer(int(status), values, log))
            log = []
        elif line:
            log.append(line)
    assert len(answers) == len(script)
    return answers


@cache
def program(name: str, work: Path) -> Program:
    """Build a host in a folder that tests in other processes may use too; skip the test if that cannot be done."""
    way = WAYS[name]
    for tool in (*way.compiler[:1], *way.runner[:1]):
        if not shutil.which(tool) and not shutil.which(f"{tool}-static"):
            pytest.skip(f"{tool} is not installed")
    if way.prebuilt == "linux32" and not Path("/lib/ld-linux.so.2").exists():
        pytest.skip("this machine does not run 32-bit programs")
    if way.prebuilt == "win32" and not any(Path("/usr/lib").glob("i386-linux-gnu/wine")):
        pytest.skip("wine32 is not installed")
    if "ziglang" in way.compiler and find_spec("ziglang") is None:
        pytest.skip("the package ziglang is not installed")
    folder = work / f"host-{name}"
    if not (folder / "done").exists():
        new = work / f"host-{name}-{os.getpid()}"
        new.mkdir()
        _build(way, new)
        (new / "done").touch()
        try:
            new.rename(folder)
        except OSError:  # another process was faster
            shutil.rmtree(new)
    return Program(way, folder / "host", folder / f"axcomp{way.suffix}")


def _build(way: Way, folder: Path) -> None:
    library = [str(NATIVE / name) for name in LIBRARY_SOURCES]
    host = [str(path) for path in (*sorted(HOST.glob("*.c")), LOADER / "fmu_library.c")]
    includes = ["-I", str(NATIVE), "-I", str(LOADER)]
    windows = way.suffix == ".dll"
    libraries = [] if windows else ["-lm", "-ldl", "-lpthread"]
    plain = [*way.compiler, *way.flags, *includes]
    linked = []
    if way.linked:
        host += library
        linked = ["-DFMU_LINKED", "-ffp-contract=off"]
    else:
        shared = ["-shared"] if windows else ["-shared", "-fPIC"]
        target = folder / f"axcomp{way.suffix}"
        if way.prebuilt:
            if why_not_prebuilt():
                pytest.skip(why_not_prebuilt())
            shutil.copy(prebuilt_path(way.prebuilt), target)
        else:
            _compile([*plain, *OPTIONS, *shared, *library, "-o", str(target), *libraries[:1]])
    _compile([*plain, "-std=c11", "-D_GNU_SOURCE", *linked, *host, "-o", str(folder / "host"), *libraries])
    if windows and not (folder / "host").exists():
        (folder / "host.exe").rename(folder / "host")


def _compile(command: list[str]) -> None:
    assert "-ffp-contract=off" in FLAGS
    result = subprocess.run([*command, "-Wall", "-Wextra"], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert "warning" not in result.stderr, result.stderr


def bits(value: float) -> str:
    """Return a real as the host reads and prints it."""
    return struct.pack(">d", value).hex()


def real(word: str) -> float:
    """Return what the host has printed as a real."""
    (value,) = struct.unpack(">d", bytes.fromhex(word))
    return float(value)


def text(value: object) -> str:
    """Return a text as one word of a script."""
    return str(value).replace(" ", "%20")
