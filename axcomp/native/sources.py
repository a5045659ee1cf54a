"""The C sources of the library, which is the same for every machine, and what tells whether they have changed."""

from __future__ import annotations

import hashlib
from pathlib import Path

from ..model import fmu_sources

_COMMON = ("fmu", "instance", "kernel", "memory", "model_exchange", "places", "states", "values")
_HOSTED = ("heap", "image", "lists", "messages", "records", "reload", "resource", "run")
SOURCES = tuple(f"{part}.c" for part in (*_COMMON, "embedded"))
HEADERS = ("fmi2.h", "image.h", "instance.h", "kernel.h", "layout.h", "memory.h", "places.h", "spot.h")
"""Of an FMU, in ``fmu_src/native``; its tables are among its sources, and ``config.h`` is another one there."""

_THIRD = ("fmi3", "refused3", "tuning", "values3")
THIRD_SOURCES = tuple(f"{part}.c" for part in _THIRD)
THIRD_HEADERS = ("fmi3.h", "tuning.h")
"""What FMI 3.0 needs besides; it goes on to the functions of FMI 2.0."""

LIBRARY_SOURCES = tuple(f"{part}.c" for part in (*_COMMON, *_THIRD, *_HOSTED))
LIBRARY_HEADERS = (*HEADERS, *THIRD_HEADERS, "config.h", "lists.h", "records.h", "resource.h", "run.h")
"""Of the libraries, which speak FMI 2.0 and 3.0 and read images; the Engine runs its trajectories in them too."""

WASM_SOURCES = tuple(f"{part}.c" for part in ("image", "kernel", "memory", "places", "records", "wasm"))
"""Of the kernel in WebAssembly, with the same headers."""


def source_path(name: str) -> Path:
    """Return the path of a source or a header."""
    return fmu_sources() / "native" / name


def source_bytes(name: str) -> bytes:
    """Return a source with the same line ends on every system."""
    return source_path(name).read_bytes().replace(b"\r\n", b"\n")


def sources_checksum() -> str:
    """Return a SHA-256 of all that the libraries are made of."""
    digest = hashlib.sha256()
    for name in sorted({*LIBRARY_SOURCES, *LIBRARY_HEADERS, *WASM_SOURCES}):
        data = source_bytes(name)
        digest.update(f"{name}\0{len(data)}\0".encode() + data)
    return digest.hexdigest()
