"""Frama-C's Eva on the generated kernel: does any input, in any cycle, lead to undefined behaviour?"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

from program import files_of

from axcomp.model import Machine, fmu_sources

OPTIONS = (
    *("-machdep", "gcc_x86_64", "-warn-special-float", "none", "-no-unicode"),
    *("-eva-auto-loop-unroll", "80", "-eva-slevel", "25", "-eva-ilevel", "128", "-eva-plevel", "100000"),
)
"""IEEE doubles, rounded to nearest; what is no number and what is infinite are values like others."""

_ALARM = re.compile(r"^\[eva:alarm\] .*?([\w.]+):(\d+): Warning:\s*(.*?)(?=^\[)", re.MULTILINE | re.DOTALL)


def is_installed() -> bool:
    """Tell whether Frama-C is here (Debian: frama-c-base)."""
    return shutil.which("frama-c") is not None


def alarms(machine: Machine, folder: Path, *, kernel: str | None = None, minutes: float = 20.0) -> list[str]:
    """Return what Eva cannot exclude for a machine: file, line and the assertion, as text.

    ``folder``: for the program; ``kernel``: another text of kernel.c. RuntimeError if the analysis does not end.
    """
    native = fmu_sources() / "native"
    for name, text in files_of(machine).items():
        (folder / name).write_text(text, encoding="utf-8")
    source = native / "kernel.c"
    if kernel is not None:
        source = folder / "kernel.c"
        source.write_text(kernel, encoding="utf-8")
    command = ["frama-c", "-eva", *OPTIONS, f"-cpp-extra-args=-I{native}", str(folder / "main.c"), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60.0 * minutes)
    if done.returncode != 0 or "====== VALUES COMPUTED ======" not in done.stdout:
        raise RuntimeError(f"the analysis has not ended: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return [f"{file}:{line}: {' '.join(said.split())}" for file, line, said in _ALARM.findall(done.stdout)]
