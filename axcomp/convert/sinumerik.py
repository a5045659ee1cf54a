"""What the compensation files of SINUMERIK controls have in common: NC blocks that set elements of system variables.

Such a file is an NC program: ``%_N_…`` or ``N10`` may begin a line, ``;`` begins a comment, ``CHANDATA(1)`` opens and
``M17`` (M2, M30) closes the data. Source of the syntax: Siemens, SINUMERIK 840D sl/828D Function Manual Extended
Functions (6FC5397-1BP40-3BA1, 03/2013), K3 Compensations, 4.4.2.3 and 4.4.3.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from .numbers import number, shortened
from .table import FormatError

MAX_POINTS = 5000
"""Points a table may have unless told otherwise; what a control takes is set on it (MD38000, MD18342)."""
TABLE_LIMIT = 100_000
"""Largest index that is read: what is beyond is a slip of the pen."""

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

    def whole_index(self, place: int, limit: int = TABLE_LIMIT) -> int:
        """Return an index as a whole number."""
        if place < len(self.indices) and _INDEX.match(self.indices[place]) and int(self.indices[place]) <= limit:
            return int(self.indices[place])
        written = self.indices[place] if place < len(self.indices) else ""
        raise FormatError(
            self.line, f"index {place + 1} of {self.variable} must be 0 to {limit}, not {shortened(written)!r}"
        )

    def axis_index(self, place: int) -> str:
        """Return an index that is an axis name."""
        return _axis(
            self.indices[place] if place < len(self.indices) else "", self.line, f"index {place + 1} of {self.variable}"
        )

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


def index_of_last_point(low: float, high: float, step: float, line: int, name: str) -> int:
    """Return k = (high − low)/step, the index of the last point."""
    if step <= 0.0 or high < low:
        raise FormatError(line, f"{name} needs a distance above 0 and an end that is not before its beginning")
    steps = (high - low) / step
    if not steps <= TABLE_LIMIT:
        raise FormatError(line, f"{name} would have {steps + 1:.3g} points")
    if abs(steps - round(steps)) > 1e-3:
        raise FormatError(line, f"{name} is {steps:g} distances long: its end must be a point")
    return round(steps)


def values_of(points: dict[int, float], last: int, line: int, name: str) -> tuple[float, ...]:
    """Return the values 0 … last; FormatError if one is missing or there is one beyond."""
    for index in range(last + 1):
        if index not in points:
            raise FormatError(line, f"{name} lacks the value with index {index} of 0 to {last}")
    if len(points) > last + 1:
        raise FormatError(line, f"{name} ends with index {last}, but index {max(points)} has a value too")
    return tuple(points[index] for index in range(last + 1))


def program(name: str, lines: list[str]) -> str:
    """Return the file with its opening and closing blocks."""
    return "\n".join([f"%_N_{name}_INI", "CHANDATA(1)", *lines, "M17"]) + "\n"
