"""The libraries that come with the package, one a platform: the same for every machine, made by ``prebuild``."""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path
from typing import Any

from .compiler import PLATFORMS
from .sources import sources_checksum

FOLDER = Path(__file__).with_name("prebuilt")
MANIFEST = FOLDER / "manifest.json"
"""``compiler``, ``sources``: their checksum, ``libraries``: file name → checksum."""

WASM = "wasm32"
"""The kernel in WebAssembly, which no FMU holds."""

STALE = "the C sources have changed since the libraries were built (python -m axcomp.native.prebuild builds them again)"


def prebuilt_path(platform: str) -> Path:
    """Return where the library of a platform, or of ``WASM``, lies."""
    return FOLDER / f"{platform}{'.wasm' if platform == WASM else PLATFORMS[platform].suffix}"


@cache
def why_not_prebuilt() -> str:
    """Return why the libraries cannot be used, as a sentence; empty: they can."""
    try:
        manifest: dict[str, Any] = json.loads(MANIFEST.read_text(encoding="utf-8"))
        if manifest["sources"] != sources_checksum():
            return STALE
        for platform in (*PLATFORMS, WASM):
            path = prebuilt_path(platform)
            if hashlib.sha256(path.read_bytes()).hexdigest() != manifest["libraries"][path.name]:
                return f"{path.name} is not the library that was built"
    except (OSError, ValueError, KeyError, TypeError) as error:
        return f"the libraries that belong to this package cannot be read: {error}"
    return ""
