"""The page as a folder of files: the package itself, Pyodide, the kernel, the example machines, and the proof.

The proof is what the page compares its kernel with: the digest of what the native kernel gives for inputs by chance.
"""

from __future__ import annotations

import base64
import io
import json
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from .. import __version__
from ..engine import Engine
from ..fmu import archive_of
from ..interface import with_causality
from ..lists import read_machine
from ..model import models
from ..native import compiled_kernel, own_platform, wasm_kernel
from ..saving import write_whole
from .course import columns_of, digest, drawn
from .view import kernel_of

PYODIDE = "314.0.8"
"""Version of the npm package ``pyodide`` that the page runs on."""
PARTS = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json", "package.json")
"""Files of it that a browser loads, and the terms of its licence."""
EXAMPLES = ("three_axis", "rotary_table", "warm_axis", "five_axis", "manual_examples")
CYCLES = 20_000
"""Of the proof, for each example."""
CHUNK = 10_000
ROOMS = (
    *("analysis", "browser", "engine", "fmu", "interface", "kernel", "kinds", "lint", "lists", "model", "native"),
    *("runtime", "saving"),
)
"""What the page loads something of."""
MARK = "site.json"
"""A folder that holds it is the page, and may be made anew."""

_PACKAGE = Path(__file__).resolve().parents[1]
_STATIC = Path(__file__).with_name("static")


class SiteError(ValueError):
    """The page cannot be built, in one sentence."""


def build_site(output: Path, *, pyodide: Path | None = None, cycles: int = CYCLES) -> None:
    """Write the page into a folder.

    Parameters
    ----------
    output : Path
        Made if it is not there; one that holds something else than an earlier page is refused.
    pyodide : Path, optional
        Folder of the npm package ``pyodide``; without it the client ``npm`` fetches that.
    cycles : int
        Of the proof, for each example machine.

    Raises
    ------
    SiteError
        If a part of it cannot be had, or the folder is refused.
    CompilerError
        If there is no kernel in WebAssembly, and none can be made.
    OSError
        If something cannot be written.
    """
    if output.exists() and (not output.is_dir() or (any(output.iterdir()) and not (output / MARK).is_file())):
        raise SiteError(f"{output} holds something else than the page: give a folder that is empty or not there yet")
    kernel = wasm_kernel()
    with tempfile.TemporaryDirectory() as work:
        source = pyodide or _fetched(Path(work))
        if absent := [name for name in PARTS if not (source / name).is_file()]:
            raise SiteError(f"{source} is not the npm package pyodide: {', '.join(absent)} is missing")
        (output / "pyodide").mkdir(parents=True, exist_ok=True)
        # Before anything else, so that a folder in which writing has failed can be written again.
        write_whole(output / MARK, json.dumps({"axcomp": __version__, "pyodide": PYODIDE}))
        for name in PARTS:
            write_whole(output / "pyodide" / name, (source / name).read_bytes())
    for path in sorted(_STATIC.iterdir()):
        if path.suffix in {".html", ".js", ".css", ".svg"}:
            write_whole(output / path.name, path.read_bytes())
    write_whole(output / "axcomp.zip", archive_of(_package_files()))
    write_whole(output / "kernel.wasm", kernel)
    examples = {name: _lists_of(models() / name) for name in EXAMPLES}
    write_whole(output / "examples.json", json.dumps(examples))
    write_whole(output / "proof.json", json.dumps(proof_of(cycles)))


def proof_of(cycles: int) -> dict[str, Any]:
    """Return what the native kernel, or where there is none that in Python, gives for the example machines."""
    native = compiled_kernel() is not None
    machines = []
    for name in EXAMPLES:
        engine = Engine(read_machine(models() / name).machine)
        columns = columns_of(engine.variables)
        names = {one.reference: one.name for one in engine.variables}
        outputs = with_causality(engine.variables, "output")
        crc = 0
        for first in range(0, cycles, CHUNK):
            rows = np.arange(first, min(first + CHUNK, cycles), dtype=np.uint64)
            given = {names[column.reference]: drawn(column, k, rows) for k, column in enumerate(columns)}
            found = engine.run(given)
            crc = digest(np.column_stack([found[one.name].astype("<f8") for one in outputs]).tobytes(), crc)
        machines.append({"name": name, "digest": crc, "kernel": kernel_of(engine.machine)})
    return {"by": f"the native kernel for {own_platform()}" if native else "the kernel in Python", "cycles": cycles,
            "machines": machines}  # fmt: skip


def _fetched(folder: Path) -> Path:
    """Fetch Pyodide with npm; return the folder of the package."""
    npm = shutil.which("npm")
    if npm is None:
        raise SiteError("npm is needed to fetch Pyodide, or --pyodide with the folder of the npm package")
    command = [npm, "pack", "--silent", f"pyodide@{PYODIDE}"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    found = list(folder.glob("*.tgz"))
    if done.returncode != 0 or not found:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise SiteError(f"npm cannot fetch pyodide {PYODIDE}: {said[-1] if said else 'it says nothing'}")
    with tarfile.open(fileobj=io.BytesIO(found[0].read_bytes())) as archive:
        archive.extractall(folder, filter="data")
    return folder / "package"


def _package_files() -> dict[str, bytes]:
    """Return the modules that the page loads, by their paths."""
    paths = [_PACKAGE / "__init__.py", *(path for room in ROOMS for path in (_PACKAGE / room).rglob("*"))]
    return {
        f"axcomp/{path.relative_to(_PACKAGE).as_posix()}": path.read_bytes()
        for path in paths
        if path.suffix == ".py" or path.name == "pages.toml"
    }


def _lists_of(folder: Path) -> dict[str, str]:
    """Return the lists of a machine by their paths, base64."""
    suffixes = {".lis", ".csv", ".exc"}
    others = {"input.csv", "expected.csv"}
    return {
        f"{folder.name}/{path.relative_to(folder).as_posix()}": base64.b64encode(path.read_bytes()).decode()
        for path in sorted(folder.rglob("*"))
        if path.suffix in suffixes and path.name not in others
    }
