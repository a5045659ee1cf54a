"""LinuxCNC compensation files (``COMP_FILE``): a line ``nominal forward reverse`` for each point of one joint.

Type 0 (``COMP_FILE_TYPE = 0``): ``forward`` and ``reverse`` are the actual positions in positive and negative motion.
Type 1: they are trims, nominal − actual. Nominals ascend strictly; between them the trim is linear, outside the end
values are held; at most 256 points. There are no comments: LinuxCNC stops reading at the first line that does not begin
with three numbers, without a word, so such a line is an error here. A file names no axis and no type.

Sign: LinuxCNC adds the trim to the commanded position, so a trim is the correction itself; actual − nominal is its
negative. Units: machine units (mm or inch by ``LINEAR_UNITS`` or ``UNITS`` of the joint), degrees for angular joints.

Source: LinuxCNC, INI Configuration, section [JOINT_<num>]; ``usrmotLoadComp`` in src/emc/usr_intf/usrmotintf.cc and
``EMCMOT_SET_JOINT_COMP`` in src/emc/motion/command.c for what the text leaves open.
"""

from __future__ import annotations

from collections.abc import Sequence

from .table import CompensationTable
from .text import CannotHoldError, FormatError, Options, decimal, number, shortened

POINTS_MAX = 256
"""Triplets of a joint."""
_LINE_MAX = 250
_COMMENT = ("#", ";")
_COLUMNS = ("nominal", "forward", "reverse")


def read_linuxcnc(text: str, options: Options, comp_type: int) -> list[CompensationTable]:
    """Return the table of a file for ``options.axis``; ``comp_type``: ``COMP_FILE_TYPE``, 0 positions, 1 trims."""
    axis = options.axis
    if axis is None:
        raise FormatError(0, "a LinuxCNC file does not tell its axis: give it with --axis")
    unit = options.unit(axis)
    factor = options.scale(unit)
    nominals: list[float] = []
    forward: list[float] = []
    reverse: list[float] = []
    for line, written in enumerate(text.rstrip().split("\n") if text.strip() else [], 1):
        words = written.split()
        if len(words) < 3 or (len(words) > 3 and not words[3].startswith(_COMMENT)):
            raise FormatError(
                line, f"expected three numbers, found {shortened(written.strip())!r}: LinuxCNC stops reading here"
            )
        if len(written) > _LINE_MAX:
            raise FormatError(line, f"a line has at most {_LINE_MAX} characters")
        nominal, *sides = (number(word, line, what) for word, what in zip(words, _COLUMNS, strict=False))
        if nominals and nominal * factor <= nominals[-1]:
            raise FormatError(
                line, f"the nominal positions must ascend, but {words[0]} follows {nominals[-1] / factor:g}"
            )
        if len(nominals) == POINTS_MAX:
            raise FormatError(line, f"a joint has at most {POINTS_MAX} points")
        nominals.append(nominal * factor)
        trims = [nominal - side for side in sides] if comp_type == 0 else sides
        forward.append(trims[0] * factor)
        reverse.append(trims[1] * factor)
    if not nominals:
        raise FormatError(0, "the file has no points")
    return [CompensationTable.of(axis, axis, nominals, forward, reverse, None, unit, unit)]


def write_linuxcnc(tables: Sequence[CompensationTable], options: Options, comp_type: int) -> str:
    """Return the file of one leadscrew table that does not repeat, of at most 256 points."""
    if len(tables) != 1:
        names = ", ".join(table.name for table in tables)
        raise CannotHoldError(f"a LinuxCNC file holds one table; there are {len(tables)}: {names}")
    [table] = tables
    if table.kind == "cross":
        raise CannotHoldError(f"{table.name} cannot be held: LinuxCNC corrects a joint over its own position")
    if table.period is not None:
        raise CannotHoldError(
            f"{table.name} repeats every {table.period:g} {table.over_unit}: LinuxCNC holds the end values"
        )
    if len(table.positions) > POINTS_MAX:
        raise CannotHoldError(f"{table.name} has {len(table.positions)} points; LinuxCNC takes {POINTS_MAX}")
    factor = options.scale(table.unit)
    lines = []
    for position, positive, negative in zip(table.positions, table.positive.y, table.curve(-1).y, strict=True):
        nominal = position / factor
        sides = (positive / factor, negative / factor)
        written = [nominal - side for side in sides] if comp_type == 0 else sides
        lines.append(" ".join(decimal(value) for value in (nominal, *written)))
    return "\n".join(lines) + "\n"
