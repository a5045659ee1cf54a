"""Which tests belong to a source, and what they say of a changed copy of the checkout."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

TESTS = {
    "kernel": ("kernel", "volumetric", "runtime"),
    "kinds": ("kinds", "lists", "runtime", "kernel", "plot"),
    "lists": ("lists", "volumetric"),
    "model": ("model", "runtime", "volumetric"),
    "runtime": ("runtime", "volumetric", "engine"),
    "interface": ("interface", "fmu"),
    "fit": ("fit", "volumetric"),
    "demo": ("demo", "models"),
}
"""Folders of tests by room, where they are not the room's own folder alone."""
GENERATED = {"kernel.c", "places.c"}
"""Written from Python: changed there."""
NO_TESTS = 5
"""Exit status of pytest where all tests of an area are slow."""
LEFT_OUT = shutil.ignore_patterns(
    ".git", ".venv", "*_cache", "__pycache__", ".hypothesis", "*.egg-info", "build", "dist"
)


def sources(root: Path) -> list[str]:
    """Return all sources that can be changed, relative to the checkout."""
    python = [path for folder in ("axcomp", "fmu_src") for path in (root / folder).rglob("*.py")]
    c = [path for path in (root / "fmu_src" / "native").glob("*.c") if path.name not in GENERATED]
    return sorted(path.relative_to(root).as_posix() for path in (*python, *c))


def area_of(source: str) -> str:
    """Return the area of a source: its room, with a sub-folder where the tests have one, or native C."""
    parts = source.split("/")
    if parts[0] == "fmu_src":
        return "native C" if source.endswith(".c") else "fmu"
    if len(parts) == 2:
        return "cli"
    return "/".join(parts[1:3]) if parts[1] == "analysis" and len(parts) > 3 else parts[1]


def tests_of(root: Path, source: str) -> list[str]:
    """Return the files of tests of a source's area; first those that have a word of its name in theirs."""
    area = area_of(source)
    folders = ("native",) if area == "native C" else TESTS.get(area, (area,))
    files = [path for folder in folders for path in sorted((root / "tests" / folder).rglob("test_*.py"))]
    words = Path(source).stem.rstrip("s").split("_")
    files.sort(key=lambda path: not any(word in path.stem for word in words))
    return [path.relative_to(root).as_posix() for path in files]


class Checkout:
    """A copy of a checkout in which sources are changed and tests run."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.root = folder / "checkout"
        shutil.copytree(root, self.root, ignore=LEFT_OUT)
        self._seconds: dict[str, float | None] = {}

    def seconds(self, source: str) -> float | None:
        """Return how long the tests of a source take without a change; None where they fail by themselves."""
        area = area_of(source)
        if area not in self._seconds:
            begin = time.monotonic()
            green = self._passes(tests_of(self.root, source), None)
            self._seconds[area] = time.monotonic() - begin if green else None
        return self._seconds[area]

    def notices(self, source: str, changed: bytes) -> bool:
        """Tell whether the tests of a source fail, or hang, when it is changed."""
        path = self.root / source
        before = path.read_bytes()
        try:
            self._write(path, changed)
            return not self._passes(tests_of(self.root, source), 10.0 + 2.0 * (self.seconds(source) or 0.0))
        finally:
            self._write(path, before)

    @staticmethod
    def _write(path: Path, content: bytes) -> None:
        path.write_bytes(content)
        for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*"):
            compiled.unlink()

    def _passes(self, tests: list[str], timeout: float | None) -> bool:
        if not tests:
            return True
        command = [sys.executable, "-m", "pytest", "-q", "-x", "-m", "not slow", "-p", "no:cacheprovider"]
        command += ["--hypothesis-seed=0", *tests]  # the same drawn examples in every run
        process = subprocess.Popen(
            command,
            cwd=self.root,
            env={**os.environ, "PYTHONPATH": str(self.root), "XDG_CACHE_HOME": str(self.root / ".cache")},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            return process.wait(timeout) in (0, NO_TESTS)
        except subprocess.TimeoutExpired:
            return False
        finally:
            if process.poll() is None:  # with what it has started
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
