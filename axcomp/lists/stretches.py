"""Regular stretches of a table: rows of ``name[i].field integer`` whose last index counts up, read column by column.

What is in any way special is no such stretch: a comment, a decimal, a blank line, a gap. It is left to the exact reader
of the grammar, whose results these are too, at a fifth of its cost.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import NamedTuple

_LINE = re.compile(
    r"([^\W0-9][\w.]*+(?:\[(?:0|[1-9][0-9]{0,8})\])?\[)(0|[1-9][0-9]{0,8})(\][\w.]*+\s)\s*+[+-]?[0-9]++\s*+\Z"
)
_FIXED = re.compile(r"\[([0-9]+)\]")
_ROWS_MIN = 4
_ENTRIES_MAX = 4096
"""Entries of one stretch; a longer table is several of them."""
_WIDEST = 16
"""Entries of a row at most."""
_PATIENCE_MAX = 64
"""Lines after which a regular stretch is looked for again, where there was none several times."""

_Row = tuple[tuple[str, str], ...]
"""What stands before and behind the index up to the first blank, for each entry of a row."""


class Stretch(NamedTuple):
    """Some rows of a table.

    Attributes
    ----------
    keys : tuple of str
        Names of a row's entries as in ``Entry``, in the order of their lines.
    fixed : tuple of int
        The indices before the one that counts.
    first : int
        That index in the first row.
    line : int
        Of the first entry, counted from 1.
    columns : list of list of int
        Values, for each of the ``keys``.
    """

    keys: tuple[str, ...]
    fixed: tuple[int, ...]
    first: int
    line: int
    columns: list[list[int]]

    @property
    def lines(self) -> int:
        """How many lines it has."""
        return len(self.keys) * len(self.columns[0])


class Finder:
    """Finds stretches in the lines of a list.

    ``take`` gets told of each, and says whether it is taken: one that is not is left to the exact reader.
    """

    def __init__(self, lines: Sequence[str], take: Callable[[Stretch], bool]) -> None:
        self._lines = lines
        self._take = take
        self._table = self._index = ""
        self._next = 0
        self._patience = 1
        self._rows_before = 1

    def taken(self, at: int, table: str, index: str) -> int:
        """Return how many lines from ``at`` on have been taken, 0 if the line must be read exactly.

        ``table`` is what stands before its first index, ``index`` its last one.
        """
        if table != self._table:
            self._table, self._next, self._patience = table, at, 1
        elif index == self._index or at < self._next:
            return 0
        self._index = index
        stretch = self._find(at)
        if stretch is not None:
            self._index, self._patience = "", 1
            self._next = at + stretch.lines
            return stretch.lines if self._take(stretch) else 0
        self._next = at + self._patience
        self._patience = min(2 * self._patience, _PATIENCE_MAX)
        return 0

    def _find(self, at: int) -> Stretch | None:
        row, first = self._row(at)
        rows = self._rows(at, row, first) if row else 0
        while rows >= _ROWS_MIN:
            columns = self._columns(at, row, first, rows)
            if columns is not None:
                keys = tuple(_FIXED.sub("[]", before) + after[:-1] for before, after in row)
                return Stretch(keys, tuple(map(int, _FIXED.findall(row[0][0]))), first, at + 1, columns)
            rows //= 2
        return None

    def _row(self, at: int) -> tuple[_Row, int]:
        """Return the row that begins in a line, and its index; nothing if that line begins no row."""
        row: list[tuple[str, str]] = []
        first = ""
        for line in self._lines[at : at + _WIDEST + 1]:
            found = _LINE.match(line)
            if found is None:
                break
            before, index, after = found.groups()
            first = first or index
            if index != first:
                same = len({tuple(_FIXED.findall(part)) for part, _ in row}) == 1
                return (tuple(row), int(first)) if same else ((), 0)
            row.append((before, after))
        return (), 0

    def _rows(self, at: int, row: _Row, first: int) -> int:
        """Return how many rows there seem to be, by the names they begin with."""
        (before, after), width, lines = row[0], len(row), self._lines
        most = min(_ENTRIES_MAX // width, (len(lines) - at) // width, 10**9 - first)

        def is_there(count: int) -> bool:
            return count <= most and lines[at + (count - 1) * width].startswith(f"{before}{first + count - 1}{after}")

        # Rows of a plane are all as long as the one before.
        low, high = (1, 2) if not is_there(self._rows_before) else (self._rows_before, self._rows_before + 1)
        while is_there(high):
            low, high = high, 2 * high
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if is_there(middle) else (low, middle)
        self._rows_before = low
        return low

    def _columns(self, at: int, row: _Row, first: int, rows: int) -> list[list[int]] | None:
        """Return the values of rows, None unless they are regular from beginning to end."""
        width = len(row)
        lines = self._lines[at : at + rows * width]
        # A line with another name keeps it, and is no integer. int() takes more than the grammar: _ and other scripts.
        values = list(map(str.removeprefix, lines, _names(row, first, rows)))
        characters = "".join(values)
        if "_" in characters or not characters.isascii():
            return None
        try:
            return [list(map(int, values[column::width])) for column in range(width)]
        except ValueError:
            return None


@lru_cache(maxsize=128)
def _names(row: _Row, first: int, rows: int) -> list[str]:
    """Return the names of all entries; those of one axis are those of all."""
    return [f"{before}{i}{after}" for i in range(first, first + rows) for before, after in row]
