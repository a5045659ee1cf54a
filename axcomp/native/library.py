"""The compiled kernel for the Engine: it comes with the package, or is compiled once where there is a C compiler."""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import os
import platform
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

from .compiler import (
    FLAGS,
    PLATFORMS,
    CompilerError,
    compile_library,
    compile_wasm,
    compiler_of,
    has_cross_compiler,
    own_platform,
)
from .places import layout
from .prebuilt import WASM, prebuilt_path, why_not_prebuilt
from .sources import LIBRARY_SOURCES, WASM_SOURCES, source_path, sources_checksum

SWITCH = "AXCOMP_KERNEL"
"""Environment variable: ``python`` keeps the Engine from using a compiled kernel."""


@cache
def compiled_kernel() -> ctypes.CDLL | None:
    """Return the compiled kernel, None where there is none: no compiler, other records, or switched off.

    It comes with the package; where its sources have changed since, this machine's own compiler makes another.
    """
    if os.environ.get(SWITCH) == "python" or sys.byteorder != "little":
        return None
    for library in (_prebuilt, _compiled):
        # A system may refuse the one that comes with the package: musl instead of glibc, another processor.
        with contextlib.suppress(OSError, CompilerError):
            kernel = ctypes.CDLL(str(library()))
            kernel.axcomp_layout.restype = ctypes.c_uint32
            # The translation may be older than the records while somebody works on them.
            return kernel if kernel.axcomp_layout() == layout() else None
    return None


def _prebuilt() -> Path:
    if why_not_prebuilt():
        raise CompilerError(why_not_prebuilt())
    return prebuilt_path(own_platform())


def wasm_kernel() -> bytes:
    """Return the kernel in WebAssembly: what comes with the package, or is compiled where its sources have changed.

    Raises
    ------
    CompilerError
        If it has to be compiled and that is not possible.
    """
    if not why_not_prebuilt():
        return prebuilt_path(WASM).read_bytes()
    if not has_cross_compiler():
        raise CompilerError(f"{why_not_prebuilt()}; here that needs a cross compiler: pip install axcomp[cross]")
    sources = [source_path(name) for name in WASM_SOURCES]
    return _cached("wasm32", ".wasm", lambda new: compile_wasm(sources, new)).read_bytes()


def _compiled() -> Path:
    target = own_platform()
    sources = [source_path(name) for name in LIBRARY_SOURCES]
    return _cached(
        platform.machine(),
        PLATFORMS[target].suffix,
        lambda new: compile_library(sources, new, compiler=compiler_of(target), platform=target),
    )


def _cached(processor: str, suffix: str, make: Callable[[Path], None]) -> Path:
    """Return the path of a library in the cache; ``make`` compiles it, under the name of its content."""
    digest = hashlib.sha256(" ".join((*FLAGS, processor, sources_checksum())).encode())
    path = _cache_folder() / f"kernel-{digest.hexdigest()[:16]}{suffix}"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=path.parent) as work:
            new = Path(work) / path.name
            make(new)
            new.replace(path)
    return path


def _cache_folder() -> Path:
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", "")
    else:
        base = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(base) if base else Path.home() / ".cache") / "axcomp"
