"""The compiled kernel for the Engine: found in a cache, or compiled once where the machine has a C compiler."""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import sys
import tempfile
from functools import cache
from pathlib import Path

from ..model import fmu_sources
from .compiler import FLAGS, PLATFORMS, CompilerError, compile_library, compiler_of, own_platform
from .places import layout

SOURCES = ("kernel.c", "run.c")
HEADERS = ("kernel.h", "layout.h", "run.h")
SWITCH = "AXCOMP_KERNEL"
"""Environment variable: ``python`` keeps the Engine from using a compiled kernel."""


@cache
def compiled_kernel() -> ctypes.CDLL | None:
    """Return the compiled kernel, None where there is none: no compiler, other records, or switched off."""
    if os.environ.get(SWITCH) == "python" or sys.byteorder != "little" or ctypes.sizeof(ctypes.c_void_p) != 8:
        return None
    try:
        kernel = ctypes.CDLL(str(_library()))
        kernel.axcomp_layout.restype = ctypes.c_uint32
        # The translation may be older than the records while somebody works on them.
        return kernel if kernel.axcomp_layout() == layout() else None
    except (OSError, CompilerError):
        return None


def _library() -> Path:
    """Return the path of the library; it is compiled under the name of its content."""
    folder = fmu_sources() / "native"
    digest = hashlib.sha256(" ".join((*FLAGS, platform.machine())).encode())
    for name in (*SOURCES, *HEADERS):
        digest.update((folder / name).read_bytes())
    path = _cache_folder() / f"kernel-{digest.hexdigest()[:16]}{PLATFORMS[own_platform()].suffix}"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent) as work:
            new = Path(work) / path.name
            target = own_platform()
            sources = [folder / name for name in SOURCES]
            compile_library(sources, new, compiler=compiler_of(target), platform=target, flags=[_visible(target)])
            new.replace(path)
    return path


def _visible(target: str) -> str:
    """Return the definition that lets ctypes see the functions."""
    mark = "__declspec(dllexport)" if target == "win64" else '__attribute__((visibility("default")))'
    return f"-DAXCOMP_API={mark}"


def _cache_folder() -> Path:
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", "")
    else:
        base = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(base) if base else Path.home() / ".cache") / "axcomp"
