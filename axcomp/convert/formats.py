"""All formats by name, and the conversion from one to another with its proof: what was written is read and compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from .cec import read_cec, write_cec
from .enc_comp import read_enc_comp, write_enc_comp
from .heidenhain import read_heidenhain, write_heidenhain, write_itnc
from .linuxcnc import read_linuxcnc, write_linuxcnc
from .plain_csv import read_csv, write_csv
from .sinumerik import MAX_POINTS
from .table import CannotHoldError, CompensationTable, Difference, FormatError, largest_difference

LISTS = "lists"
"""The controller's own lists, which are read and written as a whole machine."""
WITHIN = 0.5e-4
"""mm or ° that a conversion may change a correction unless told otherwise: half of what the lists resolve."""


@dataclass(frozen=True)
class Options:
    """What a file does not tell of itself.

    Attributes
    ----------
    axis : str or None
        The corrected axis, where the format names none.
    over : str or None
        The axis looked up, where the format names none.
    rotary : frozenset of str
        Names of the rotary axes.
    inch : bool
        Lengths are in inches.
    encoder : int
        Measuring system of ENC_COMP, 0 or 1.
    max_points : int
        Points the other control reserves for a table.
    within : float or None
        µm (″) that another choice of points may cost; None: the points stay as they are.
    """

    axis: str | None = None
    over: str | None = None
    rotary: frozenset[str] = field(default_factory=frozenset)
    inch: bool = False
    encoder: int = 0
    max_points: int = MAX_POINTS
    within: float | None = None


@dataclass(frozen=True)
class Format:
    """A format: its name on the command line, what it is, and its reader and writer."""

    name: str
    summary: str
    read: Callable[[str, Options], list[CompensationTable]]
    write: Callable[[Sequence[CompensationTable], Options], str]


def _read_linuxcnc(text: str, options: Options, comp_type: int) -> list[CompensationTable]:
    if options.axis is None:
        raise FormatError(0, "a LinuxCNC file does not tell its axis: give it with --axis")
    rotary = options.axis in options.rotary
    return [read_linuxcnc(text, comp_type=comp_type, axis=options.axis, inch=options.inch, rotary=rotary)]


def _write_linuxcnc(tables: Sequence[CompensationTable], options: Options, comp_type: int) -> str:
    if len(tables) != 1:
        names = ", ".join(table.name for table in tables)
        raise CannotHoldError(f"a LinuxCNC file holds one table; there are {len(tables)}: {names}")
    return write_linuxcnc(tables[0], comp_type=comp_type, inch=options.inch)


def _metric(write: Callable[[Sequence[CompensationTable], Options], str]) -> Callable[..., str]:
    def checked(tables: Sequence[CompensationTable], options: Options) -> str:
        if options.inch:
            raise CannotHoldError("this format is written in mm only")
        return write(tables, options)

    return checked


FORMATS = {
    one.name: one
    for one in (
        Format(
            "enc-comp",
            "SINUMERIK $AA_ENC_COMP: leadscrew, equidistant, unilateral",
            lambda text, o: read_enc_comp(text, encoder=o.encoder, inch=o.inch, rotary=o.rotary),
            lambda tables, o: write_enc_comp(
                tables, encoder=o.encoder, inch=o.inch, max_points=o.max_points, within=o.within
            ),
        ),
        Format(
            "cec",
            "SINUMERIK $AN_CEC: leadscrew (also bilateral) and cross, equidistant",
            lambda text, o: read_cec(text, inch=o.inch, rotary=o.rotary),
            lambda tables, o: write_cec(tables, inch=o.inch, max_points=o.max_points, within=o.within),
        ),
        Format(
            "heidenhain",
            "Heidenhain .COM of TNC 6xx and later: leadscrew and cross",
            lambda text, o: read_heidenhain(text, over=o.over, rotary=o.rotary),
            _metric(lambda tables, _: write_heidenhain(tables)),
        ),
        Format(
            "itnc",
            "Heidenhain .COM of TNC 4xx and iTNC 530: one table, equidistant, unilateral",
            lambda text, o: read_heidenhain(text, over=o.over, rotary=o.rotary),
            _metric(lambda tables, o: write_itnc(tables, within=o.within)),
        ),
        *(
            Format(
                f"linuxcnc-{comp_type}",
                f"LinuxCNC COMP_FILE of COMP_FILE_TYPE {comp_type} ({what}): one leadscrew table",
                partial(_read_linuxcnc, comp_type=comp_type),
                partial(_write_linuxcnc, comp_type=comp_type),
            )
            for comp_type, what in enumerate(("positions", "trims"))
        ),
        Format(
            "csv",
            "plain CSV, a line for each point: anything",
            lambda text, o: read_csv(text, axis=o.axis or ""),
            _metric(lambda tables, _: write_csv(tables)),
        ),
    )
}
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
    known = Options(
        axis=tables[0].axis, over=tables[0].over, rotary=frozenset(rotary), inch=options.inch, encoder=options.encoder
    )
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
        allowed = max(within or 0.0, WITHIN * table.positive.of.factor)
        if difference.size > allowed * (1.0 + 1e-6):
            raise CannotHoldError(
                f"{table.name} would differ by {difference.size:.3f} {shown_unit(table)} at {difference.position:g} "
                f"{table.over_unit}; {allowed:g} are allowed"
            )
        result.append(Compared(table, other, difference))
    return result


def shown_unit(table: CompensationTable) -> str:
    """Return the unit of a table's differences: µm or ″."""
    return table.positive.of.scaled().unit


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
