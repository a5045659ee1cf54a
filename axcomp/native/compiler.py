"""C compilers: the machine's own for itself, the one of the package ziglang for every platform."""

from __future__ import annotations

import importlib.util
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-g0", "-fvisibility=hidden", "-Wall", "-Wextra", "-pedantic")
"""No fast-math and no fused multiplications: every compiler then gives the same bits."""


class Platform(NamedTuple):
    """A platform of FMI 2.0 (section 2.3): how its libraries are called, and what zig calls the machine."""

    suffix: str
    zig_target: str


PLATFORMS = {
    "linux64": Platform(".so", "x86_64-linux-gnu.2.17"),
    "win64": Platform(".dll", "x86_64-windows-gnu"),
    "darwin64": Platform(".dylib", "x86_64-macos.11.0"),
}
"""Those that FMUs are built for; the Linux libraries need glibc 2.17 or newer."""


class CompilerError(RuntimeError):
    """There is no compiler for a platform, or it has failed; the message says what to do."""


def own_platform() -> str:
    """Return the FMI name of the platform this Python runs on."""
    return {"win32": "win64", "darwin": "darwin64"}.get(sys.platform, "linux64")


def has_cross_compiler() -> bool:
    """Tell whether there is a compiler for every platform."""
    return importlib.util.find_spec("ziglang") is not None


def compiler_of(platform: str) -> list[str]:
    """Return the command of a C compiler for a platform.

    Raises
    ------
    CompilerError
        If there is none: the machine's own compiler (``CC``, cc, gcc or clang) serves only the machine itself.
    """
    if has_cross_compiler():
        return [sys.executable, "-m", "ziglang", "cc", "-target", PLATFORMS[platform].zig_target]
    if platform == own_platform():
        if os.environ.get("CC"):
            return shlex.split(os.environ["CC"])
        for name in ("cc", "gcc", "clang"):
            if shutil.which(name):
                return [name]
        raise CompilerError("there is no C compiler: install gcc or clang, or pip install axcomp[cross]")
    raise CompilerError(f"for {platform} on {own_platform()} a cross compiler is needed: pip install axcomp[cross]")


def compile_library(
    sources: Sequence[Path], output: Path, *, compiler: Sequence[str], platform: str, flags: Sequence[str] = ()
) -> None:
    """Compile C sources into a shared library; the same bytes wherever sources and output lie.

    Raises
    ------
    CompilerError
        With the compiler's own words, if it fails.
    """
    linking = ["-shared", *(["-s"] if platform == "win64" else ["-fPIC", "-lm"])]
    if platform == "linux64":
        linking += ["-Wl,-s", "-Wl,--build-id=none", "-ldl"]
    _compile([*compiler, *FLAGS, *flags], sources, output, linking)


def compile_program(
    sources: Sequence[Path], output: Path, *, compiler: Sequence[str], flags: Sequence[str] = ()
) -> None:
    """Compile C sources into a program for this machine, which may use what POSIX adds to C; raises as the above."""
    linking = [] if own_platform() == "win64" else ["-lm", "-ldl"]
    _compile([*compiler, *FLAGS, "-D_GNU_SOURCE", *flags], sources, output, linking)


def _compile(begin: Sequence[str], sources: Sequence[Path], output: Path, linking: Sequence[str]) -> None:
    absolute = [str(source.absolute()) for source in sources]
    command = [*begin, *absolute, "-o", output.name, *linking]
    try:
        # In the folder of the output: some linkers note its path in it, or put more files beside it.
        result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=output.parent)
    except OSError as error:
        raise CompilerError(f"the C compiler {begin[0]} cannot be run: {error}") from None
    if result.returncode != 0:
        raise CompilerError(f"the C compiler {begin[0]} has failed:\n{result.stderr.strip()}")
