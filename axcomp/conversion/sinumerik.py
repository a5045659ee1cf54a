"""What the compensation files of SINUMERIK controls have in common: NC blocks that set elements of system variables.

Such a file is an NC program: ``%_N_…`` or ``N10`` may begin a line, ``;`` begins a comment, ``CHANDATA(1)`` opens and
``M17`` (M2, M30) closes the data. Source of the syntax: Siemens, SINUMERIK 840D sl/828D Function Manual Extended
Functions (6FC5397-1BP40-3BA1, 03/2013), K3 Compensations, 4.4.2.3 and 4.4.3.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from .table import CompensationTable
from .text import FormatError, Options, Unit, decimal, number, shortened

TABLE_LIMIT = 100_000
"""Largest index that is read: what is beyond is a slip of the pen."""
GRID = ("STEP", "MIN", "MAX")
"""Parameters of a table that say where its points are."""

_BLANK = re.compile(
    r"\s*(?:%\s*_N_\w+|CHANDATA\s*\(\s*[0-9]+\s*\)|(?:N[0-9]+\s*)?M\s*(?:0?2|17|30))?\s*\Z", re.IGNORECASE
)
_BLOCK = re.compile(r"\s*(?:N[0-9]+\s+)?(\$[A-Z]{2}_\w+)\s*\[([^\[\]]*)\]\s*=\s*(.*?)\s*\Z", re.IGNORECASE | re.DOTALL)
_INDEX = re.compile(r"[0-9]{1,7}\Z")
_NAME = re.compile(r"[A-Z_]\w{0,31}\Z", re.IGNORECASE)


class Setting(NamedTuple):
    """One element of a system variable: its name in capitals, its indices and its value as they are written."""

    line: int
    variable: str
    indices: tuple[str, ...]
    value: str

    def _index(self, which: int) -> str:
        return self.indices[which] if which < len(self.indices) else ""

    def whole_index(self, which: int, limit: int = TABLE_LIMIT) -> int:
        """Return an index as a whole number."""
        written = self._index(which)
        if not _INDEX.match(written) or int(written) > limit:
            raise FormatError(
                self.line, f"index {which + 1} of {self.variable} must be 0 to {limit}, not {shortened(written)!r}"
            )
        return int(written)

    def axis_index(self, which: int) -> str:
        """Return an index that is an axis name."""
        return _axis(self._index(which), self.line, f"index {which + 1} of {self.variable}")

    def check_indices(self, wanted: int) -> None:
        """Refuse another number of indices."""
        if len(self.indices) != wanted:
            raise FormatError(self.line, f"{self.variable} has {wanted} indices, not {len(self.indices)}")

    def number(self) -> float:
        """Return the value as a number; SINUMERIK writes exponents with EX."""
        return number(re.sub("EX", "e", self.value, flags=re.IGNORECASE), self.line, self.variable)

    def axis(self) -> str:
        """Return the value as an axis name, with or without brackets or quotes."""
        return _axis(self.value.strip('()" '), self.line, self.variable)

    def flag(self) -> bool:
        """Return the value as a Boolean: 0, 1, FALSE or TRUE."""
        try:
            return {"0": False, "1": True, "FALSE": False, "TRUE": True}[self.value.upper()]
        except KeyError:
            raise FormatError(self.line, f"{self.variable} must be 0 or 1, not {shortened(self.value)!r}") from None


def _axis(word: str, line: int, what: str) -> str:
    if not _NAME.match(word):
        raise FormatError(line, f"{what} must be the name of an axis, not {shortened(word)!r}")
    return word


@dataclass
class Written:
    """What a file says of one table: the line where it begins, its values by index, its parameters by name."""

    line: int
    points: dict[int, float] = field(default_factory=dict)
    parameters: dict[str, Setting] = field(default_factory=dict)

    def number(self, name: str, default: float) -> float:
        """Return a parameter as a number."""
        return self.parameters[name].number() if name in self.parameters else default

    def flag(self, name: str, default: bool) -> bool:
        """Return a parameter as a Boolean."""
        return self.parameters[name].flag() if name in self.parameters else default

    def check_has(self, who: str, prefix: str, names: Sequence[str]) -> None:
        """Refuse a table that lacks a parameter."""
        for needed in names:
            if needed not in self.parameters:
                raise FormatError(self.line, f"{who} has no {prefix}_{needed}")

    def table(
        self, name: str, pair: tuple[str, str], units: tuple[Unit, Unit], weight: float, options: Options
    ) -> CompensationTable:
        """Return the unilateral table of a pair (corrected axis, axis looked up) with their units.

        ``name``: the table in messages; ``weight``: on the values, −1 where they are errors.
        """
        step, low, high = (self.parameters[needed].number() for needed in GRID)
        line = self.parameters["MAX"].line
        last = _index_of_last_point(low, high, step, line, name)
        values = self._values(last, name)
        modulo = self.flag("IS_MODULO", False)
        if modulo and last == 0:
            raise FormatError(line, f"{name} repeats but has no length")
        own, over = map(options.scale, units)
        positions = [(low + index * step) * over for index in range(last + 1)]
        corrections = [value * weight * own for value in values]
        period = last * step * over if modulo else None
        try:
            return CompensationTable.of(*pair, positions, corrections, None, period, *units)
        except ValueError as error:
            raise FormatError(line, str(error)) from None

    def _values(self, last: int, name: str) -> list[float]:
        """Return the values 0 … last; FormatError if one is missing or there is one beyond."""
        for index in range(last + 1):
            if index not in self.points:
                raise FormatError(self.line, f"{name} lacks the value with index {index} of 0 to {last}")
        if len(self.points) > last + 1:
            raise FormatError(self.line, f"{name} ends with index {last}, but index {max(self.points)} has a value too")
        return [self.points[index] for index in range(last + 1)]


def _index_of_last_point(low: float, high: float, step: float, line: int, name: str) -> int:
    """Return k = (high − low)/step, the index of the last point."""
    if step <= 0.0 or high < low:
        raise FormatError(line, f"{name} needs a distance above 0 and an end that is not before its beginning")
    steps = (high - low) / step
    if not steps <= TABLE_LIMIT:
        raise FormatError(line, f"{name} would have {steps + 1:.3g} points")
    if abs(steps - round(steps)) > 1e-3:
        raise FormatError(line, f"{name} is {steps:g} distances long: its end must be a point")
    return round(steps)


def settings(text: str) -> Iterator[Setting]:
    """Yield what a file sets; FormatError for a line that is nothing of the kind."""
    for line, written in enumerate(text.splitlines(), 1):
        block = written.partition(";")[0]
        if _BLANK.match(block):
            continue
        found = _BLOCK.match(block)
        if found is None:
            raise FormatError(line, f"expected $VARIABLE[…]=value, found {shortened(block.strip())!r}")
        indices = tuple(index.strip() for index in found[2].split(","))
        yield Setting(line, found[1].upper(), indices, found[3])


def blocks(
    prefix: str,
    before: Sequence[object],
    behind: Sequence[object],
    table: CompensationTable,
    values: Sequence[float],
    options: Options,
) -> list[str]:
    """Return the blocks of an equidistant table: its points, where they are, and whether it repeats.

    ``before`` and ``behind`` are the indices around that of a point, ``values`` those the control means, in mm or °.
    """

    def indexed(*indices: object) -> str:
        return f"[{','.join(map(str, indices))}]"

    of_table = indexed(*before, *behind)
    own, over = options.scale(table.unit), options.scale(table.over_unit)
    low, high = table.positions[0] / over, table.positions[-1] / over
    step = (high - low) / (len(values) - 1)
    return [
        *(f"{prefix}{indexed(*before, index, *behind)}={decimal(value / own)}" for index, value in enumerate(values)),
        *(f"{prefix}_{name}{of_table}={decimal(value)}" for name, value in zip(GRID, (step, low, high), strict=True)),
        f"{prefix}_IS_MODULO{of_table}={int(table.period is not None)}",
    ]


def program(name: str, lines: list[str]) -> str:
    """Return the file with its opening and closing blocks."""
    return "\n".join([f"%_N_{name}_INI", "CHANDATA(1)", *lines, "M17"]) + "\n"
