"""All formats by name, and the conversion from one to another with its proof: what was written is read and compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from .cec import read_cec, write_cec
from .enc_comp import read_enc_comp, write_enc_comp
from .heidenhain import read_heidenhain, write_heidenhain, write_itnc
from .linuxcnc import read_linuxcnc, write_linuxcnc
from .plain_csv import read_csv, write_csv
from .table import CompensationTable, Difference, largest_difference
from .text import CannotHoldError, Options

LISTS = "lists"
"""The controller's own lists, which are read and written as a whole machine."""
WITHIN = 0.5e-4
"""mm or ° that a conversion may change a correction unless told otherwise: half of what the lists resolve."""


class Format(NamedTuple):
    """A format: its name on the command line, what it is, and its reader and writer.

    A reader returns the tables of a text, FormatError if it is not of the format; a writer returns the text of some
    tables, CannotHoldError for those it has no room for.
    """

    name: str
    summary: str
    read: Callable[[str, Options], list[CompensationTable]]
    write: Callable[[Sequence[CompensationTable], Options], str]


_ALL = (
    Format("enc-comp", "SINUMERIK $AA_ENC_COMP: leadscrew, equidistant, unilateral", read_enc_comp, write_enc_comp),
    Format("cec", "SINUMERIK $AN_CEC: leadscrew (also bilateral) and cross, equidistant", read_cec, write_cec),
    Format(
        "heidenhain", "Heidenhain .COM of TNC 6xx and later: leadscrew and cross", read_heidenhain, write_heidenhain
    ),
    Format(
        "itnc",
        "Heidenhain .COM of TNC 4xx and iTNC 530: one table, equidistant, unilateral",
        read_heidenhain,
        write_itnc,
    ),
    *(
        Format(
            f"linuxcnc-{comp_type}",
            f"LinuxCNC COMP_FILE of COMP_FILE_TYPE {comp_type} ({what}): one leadscrew table",
            partial(read_linuxcnc, comp_type=comp_type),
            partial(write_linuxcnc, comp_type=comp_type),
        )
        for comp_type, what in enumerate(("positions", "trims"))
    ),
    Format("csv", "plain CSV, a line for each point: anything", read_csv, write_csv),
)
FORMATS = {one.name: one for one in _ALL}
"""The formats by name; ``LISTS`` is no file and stands beside them."""


class Compared(NamedTuple):
    """A table, what became of it, and their largest difference."""

    before: CompensationTable
    after: CompensationTable
    difference: Difference


def written(tables: Sequence[CompensationTable], name: str, options: Options) -> tuple[str, list[Compared]]:
    """Return the tables in a format, and each of them compared with what is read back.

    Raises
    ------
    CannotHoldError
        If the format cannot hold a table, or differs from it by more than ``options.within`` (else ``WITHIN``).
    """
    text = FORMATS[name].write(tables, options)
    rotary = {n for t in tables for n, unit in ((t.axis, t.unit), (t.over, t.over_unit)) if unit == "deg"}
    known = replace(options, axis=tables[0].axis, over=tables[0].over, rotary=frozenset(rotary))
    return text, compared(tables, FORMATS[name].read(text, known), options.within)


def compared(
    before: Sequence[CompensationTable], after: Sequence[CompensationTable], within: float | None = None
) -> list[Compared]:
    """Return every table with what became of it; CannotHoldError if one is missing or differs too much."""
    found = {(table.axis, table.over): table for table in after}
    result = []
    for table in before:
        other = found.get((table.axis, table.over))
        if other is None:
            raise CannotHoldError(f"{table.name} is not in what was written")
        difference = largest_difference(table, other)
        factor, unit = table.shown
        allowed = max(within or 0.0, WITHIN * factor)
        if difference.size > allowed * (1.0 + 1e-6):
            raise CannotHoldError(
                f"{table.name} would differ by {difference.size:.3f} {unit} at {difference.position:g} "
                f"{table.over_unit}; {allowed:g} are allowed"
            )
        result.append(Compared(table, other, difference))
    return result


def recognized(text: str) -> str | None:
    """Return the name of the format a text is of, None where that is not certain."""
    upper = text.upper()
    if "$AA_ENC_COMP" in upper:
        return "enc-comp"
    if "$AN_CEC" in upper:
        return "cec"
    if upper.lstrip().startswith("BEGIN "):
        return "heidenhain"
    first = next((line for line in upper.splitlines() if line.strip() and not line.startswith("#")), "")
    return "csv" if "POSITION" in first else None
