"""What the FMUs of a machine have in common, whatever runs them: variables, description, tables, lists."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal, NamedTuple

from .. import __version__
from ..interface import Naming, Types, Variable, identifier, variables_of
from ..kinds import CompileError
from ..lists import Finding, Reading, TypeName, read_machine
from ..model import Machine
from ..runtime import Compiled, compile_tables
from .archive import BuildError, generation_date
from .description import Description
from .documentation import accompanying
from .packing import packed_lists

NAME = "axcomp"
"""Name of the model and of its file, unless another one is given."""

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")

PACKAGE = Path(__file__).resolve().parents[1]


Version = Literal["2.0", "3.0"]
"""Of FMI."""


class Built(NamedTuple):
    """What a machine's lists give for its FMU, and the file that was written from them.

    Attributes
    ----------
    reading : Reading
        The lists; there is at least one axis.
    compiled : Compiled
        The kernel's tables.
    variables : tuple of Variable
    description : Description
        Without what depends on the kind of FMU.
    start : str
        What ``read_machine`` must read in ``resources``.
    lists : mapping of str to bytes
        The lists by their paths there.
    path : Path
        The file, once it is written.
    note : str
        What there is to say about its libraries.

    Examples
    --------
    >>> from axcomp import build_fmu, models
    >>> built = build_fmu(models() / "rotary_table", "table.fmu")
    >>> built.path.name, [axis.name for axis in built.machine.axes], built.start
    ('table.fmu', ['C'], 'machine')
    """

    reading: Reading
    compiled: Compiled
    variables: tuple[Variable, ...]
    description: Description
    start: str
    lists: Mapping[str, bytes]
    path: Path = Path()
    note: str = ""

    @property
    def machine(self) -> Machine:
        """The machine it is of."""
        return self.reading.machine

    def accompanying(self, *, with_tables: bool = True) -> dict[str, bytes]:
        """Return documentation, licence, icon and terminals by path; unless ``with_tables`` no findings either."""
        machine = self.machine if with_tables else None
        return accompanying(self.description, self.variables, machine, self.findings)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What there was to say about its lists."""
        return self.reading.findings


def read_content(
    lists: str | os.PathLike[str],
    cycle_time: float,
    naming: Naming = "structured",
    axis_type: TypeName | None = None,
    name: str = NAME,
    types: Types = "own",
    allow_outside: Sequence[str | os.PathLike[str]] = (),
) -> Built:
    """Read and compile the lists of a machine; ``name``: of the model, an identifier of C.

    Raises
    ------
    BuildError
        If there is no axis in them, they cannot be run or packed, or the name is no identifier.
    """
    if not _IDENTIFIER.fullmatch(name):
        raise BuildError(f"{name!r} is no model name: it takes letters, digits and _, and begins with no digit.")
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
        name=name,
        text=f"Axis compensations of {names}",
        step_size=cycle_time,
        version=__version__,
        naming=naming,
        generated=generation_date(),
    )
    variables = variables_of(machine, naming, cycle_time, types)
    return Built(reading, compiled, variables, description, *packed_lists(reading))


def output_path(output: str | os.PathLike[str], name: str) -> Path:
    """Return the file to write: in a folder it has a name of its own."""
    path = Path(output)
    return path / name if path.is_dir() else path
