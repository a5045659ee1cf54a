"""Build the libraries of all platforms again: ``python -m axcomp.native.prebuild``, with the extra ``cross``.

The same sources and the same compiler give the same bytes, anywhere and at any time.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.metadata
import json
import os
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ..saving import write_all
from .compiler import PLATFORMS, CompilerError, compile_wasm, cross_compile, has_cross_compiler
from .prebuilt import FOLDER, MANIFEST, WASM, prebuilt_path
from .sources import LIBRARY_SOURCES, WASM_SOURCES, source_path, sources_checksum

COMPILER = "0.17.1"
"""Version of ziglang; another one gives other bytes. The extra ``cross`` asks for it."""

NAME = "axcomp"
"""What linkers note in a library is this, not the name of its file."""


def build_libraries(folder: Path, platforms: Sequence[str] = (*PLATFORMS, WASM)) -> dict[str, bytes]:
    """Build libraries in a folder below ``folder`` each; return platform → bytes. CompilerError if one fails."""

    def build(platform: str) -> bytes:
        output = folder / platform / f"{NAME}{prebuilt_path(platform).suffix}"
        output.parent.mkdir(parents=True)
        if platform == WASM:
            compile_wasm([source_path(name) for name in WASM_SOURCES], output)
        else:
            cross_compile([source_path(name) for name in LIBRARY_SOURCES], output, platform=platform)
        return output.read_bytes()

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(platforms, pool.map(build, platforms), strict=True))


def manifest_of(libraries: dict[str, bytes]) -> str:
    """Return the text of the manifest; ``libraries``: file name → bytes."""
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in libraries.items()}
    values = {"compiler": f"ziglang {COMPILER}", "sources": sources_checksum(), "libraries": digests}
    return json.dumps(values, indent=2) + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Build the libraries and their manifest; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m axcomp.native.prebuild", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, but fail if the bytes differ")
    options = parser.parse_args(arguments)
    if not has_cross_compiler() or importlib.metadata.version("ziglang") != COMPILER:
        print(f"ziglang {COMPILER} is needed: pip install 'axcomp[cross]'", file=sys.stderr)
        return 1
    try:
        with tempfile.TemporaryDirectory() as folder:
            built = build_libraries(Path(folder))
    except CompilerError as error:
        print(error, file=sys.stderr)
        return 1
    files = {prebuilt_path(platform): data for platform, data in built.items()}
    files[MANIFEST] = manifest_of({path.name: data for path, data in files.items()}).encode()
    if options.check:
        other = [path.name for path, data in files.items() if not path.is_file() or path.read_bytes() != data]
        print("".join(f"{name} is not what the sources give\n" for name in other), end="", file=sys.stderr)
        return 1 if other else 0
    FOLDER.mkdir(exist_ok=True)
    write_all(files)
    for path, data in files.items():
        print(f"{path.name}: {len(data)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
