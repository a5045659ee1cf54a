"""C compilers: the machine's own for itself, the one of the package ziglang for every platform."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import platform as system
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ..saving import write_whole
from .universal import universal

FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-g0", "-fvisibility=hidden", "-Wall", "-Wextra", "-pedantic")
"""No fast-math and no fused multiplications: every compiler then gives the same bits."""

SSE = ("-msse2", "-mfpmath=sse")
"""Of a 32-bit x86 processor: the i387 would compute with more digits."""


class Platform(NamedTuple):
    """A platform of FMI 2.0 (section 2.3): how its libraries are called, and what zig calls the machines in one.

    ``third``: the folders of its library in FMI 3.0 (section 2.5.1.4).
    """

    suffix: str
    zig_targets: tuple[str, ...]
    third: tuple[str, ...]
    flags: tuple[str, ...] = ()


PLATFORMS = {
    "linux64": Platform(".so", ("x86_64-linux-gnu.2.17",), ("x86_64-linux",)),
    "win64": Platform(".dll", ("x86_64-windows-gnu",), ("x86_64-windows",)),
    "darwin64": Platform(".dylib", ("x86_64-macos.11.0", "aarch64-macos.11.0"), ("x86_64-darwin", "aarch64-darwin")),
    "aarch64-linux": Platform(".so", ("aarch64-linux-gnu.2.17",), ("aarch64-linux",)),
    "linux32": Platform(".so", ("x86-linux-gnu.2.17",), ("x86-linux",), SSE),
    "win32": Platform(".dll", ("x86-windows-gnu",), ("x86-windows",), SSE),
}
"""Those that FMUs are built for; the Linux libraries need glibc 2.17 or newer."""


class CompilerError(RuntimeError):
    """There is no compiler for a platform, or it has failed; the message says what to do."""


def own_platform() -> str:
    """Return the FMI name of the platform this Python runs on."""
    if sys.platform == "darwin":
        return "darwin64"
    bits = 8 * ctypes.sizeof(ctypes.c_void_p)
    if sys.platform == "win32":
        return f"win{bits}"
    return "aarch64-linux" if system.machine() in ("aarch64", "arm64") else f"linux{bits}"


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
        return zig(PLATFORMS[platform].zig_targets[0])
    if platform == own_platform():
        if os.environ.get("CC"):
            return shlex.split(os.environ["CC"])
        for name in ("cc", "gcc", "clang"):
            if shutil.which(name):
                return [name]
        raise CompilerError("there is no C compiler: install gcc or clang, or pip install axcomp[cross]")
    raise CompilerError(f"for {platform} on {own_platform()} a cross compiler is needed: pip install axcomp[cross]")


def zig(target: str) -> list[str]:
    """Return the command of zig's C compiler for what it calls a target."""
    return [sys.executable, "-m", "ziglang", "cc", "-target", target]


def cross_compile(sources: Sequence[Path], output: Path, *, platform: str, flags: Sequence[str] = ()) -> None:
    """Compile C sources with zig into the shared library of a platform, for all its processors; raises as the below."""
    targets = PLATFORMS[platform].zig_targets
    with tempfile.TemporaryDirectory() as work:
        slices = []
        for number, target in enumerate(targets):
            # In folders of their own: linkers note the name of the output.
            one = Path(work, str(number), output.name)
            one.parent.mkdir()
            compile_library(sources, one, compiler=zig(target), platform=platform, flags=flags)
            slices.append(one.read_bytes())
    write_whole(output, slices[0] if len(slices) == 1 else universal(slices))


def compile_library(
    sources: Sequence[Path], output: Path, *, compiler: Sequence[str], platform: str, flags: Sequence[str] = ()
) -> None:
    """Compile C sources into a shared library; the same bytes wherever sources and output lie.

    Raises
    ------
    CompilerError
        With the compiler's own words, if it fails.
    """
    windows = PLATFORMS[platform].suffix == ".dll"
    linking = ["-shared", *(["-s"] if windows else ["-fPIC", "-lm"])]
    if PLATFORMS[platform].suffix == ".so":
        linking += ["-Wl,-s", "-Wl,--build-id=none", "-ldl"]
    if platform == "darwin64":
        linking.append("-Wl,-s")
    _compile([*compiler, *FLAGS, *PLATFORMS[platform].flags, *flags], sources, output, linking)


def compile_wasm(sources: Sequence[Path], output: Path) -> None:
    """Compile C sources with zig into a WebAssembly module that needs nothing of its host; raises as the above."""
    linking = ["-mexec-model=reactor", "-Wl,-s", "-Wl,--export-dynamic"]
    _compile([*zig("wasm32-wasi"), *FLAGS], sources, output, linking)


def compile_program(
    sources: Sequence[Path], output: Path, *, compiler: Sequence[str], flags: Sequence[str] = ()
) -> None:
    """Compile C sources into a program for this machine, which may use what POSIX adds to C; raises as the above."""
    linking = [] if sys.platform == "win32" else ["-lm", "-ldl"]
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
