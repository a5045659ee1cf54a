"""What the FMUs of a machine have in common, whatever runs them: variables, description, tables, lists."""

from __future__ import annotations

import importlib.metadata
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from ..interface import Naming, Variable, identifier, variables_of
from ..kinds import CompileError
from ..lists import Finding, Reading, TypeName, read_machine
from ..model import Machine
from ..runtime import Compiled, compile_tables
from .archive import BuildError, generation_date
from .description import Description
from .packing import packed_lists

NAME = "axcomp"
"""Name of the model, and of its file."""

PACKAGE = Path(__file__).resolve().parents[1]


class Built(NamedTuple):
    """What a machine's lists give for its FMU, and the file that was written from them.

    The machine has at least one axis. The description lacks what depends on the kind of FMU. ``start`` is what
    ``read_machine`` must read in ``resources``, ``lists`` the contents by path there; ``path`` is the file, once it is
    written.
    """

    reading: Reading
    compiled: Compiled
    variables: tuple[Variable, ...]
    description: Description
    start: str
    lists: Mapping[str, bytes]
    path: Path = Path()

    @property
    def machine(self) -> Machine:
        """The machine it is of."""
        return self.reading.machine

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What there was to say about its lists."""
        return self.reading.findings


def read_content(
    lists: str | os.PathLike[str],
    cycle_time: float,
    naming: Naming = "structured",
    axis_type: TypeName | None = None,
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Read and compile the lists of a machine.

    Raises
    ------
    BuildError
        If there is no axis in them, or they cannot be run or packed.
    """
    reading = read_machine(lists, axis_type=axis_type, allow_outside=allow_outside)
    machine = reading.machine
    if not machine.axes:
        raise BuildError("\n".join([*map(str, reading.findings), f"{lists}: there is no axis in these lists."]))
    try:
        compiled = compile_tables(machine, cycle_time)
    except CompileError as error:
        raise BuildError(f"{lists}: {error}") from None
    names = ", ".join(identifier(axis.name) for axis in machine.axes)
    description = Description(
        name=NAME,
        text=f"Axis compensations of {names}",
        step_size=cycle_time,
        version=version(),
        naming=naming,
        generated=generation_date(),
    )
    variables = variables_of(machine, naming, cycle_time)
    return Built(reading, compiled, variables, description, *packed_lists(reading))


def output_path(output: str | os.PathLike[str], name: str) -> Path:
    """Return the file to write: in a folder it has a name of its own."""
    path = Path(output)
    return path / name if path.is_dir() else path


def version() -> str:
    """Return the version of this package: of the checkout it lies in, else of the installed one."""
    project = PACKAGE.parent / "pyproject.toml"
    if project.is_file():
        values = tomllib.loads(project.read_text(encoding="utf-8")).get("project", {})
        if values.get("name") == PACKAGE.name:
            return str(values["version"])
    return importlib.metadata.version(PACKAGE.name)
