"""Text as editors count it: lines from 0, columns in units of UTF-16; ours are characters from 1."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence

from lsprotocol import types

_LINE_END = re.compile(r"\r\n|\r|\n")


def units(text: str) -> int:
    """Return how many units of UTF-16 a text has."""
    return len(text) + sum(character > "\uffff" for character in text)


def characters(line: str, column: int) -> int:
    """Return how many characters of a line lie before a column in units of UTF-16."""
    if line.isascii():
        return min(column, len(line))
    count = 0
    for place, character in enumerate(line):
        if count >= column:
            return place
        count += 2 if character > "\uffff" else 1
    return len(line)


def span(lines: Sequence[str], line: int, start: int, end: int) -> types.Range:
    """Return a range in a line, which is counted from 0 as the characters are."""
    text = lines[line] if 0 <= line < len(lines) else ""
    return types.Range(types.Position(line, units(text[:start])), types.Position(line, units(text[:end])))


class Text:
    """What an editor holds of a file, changed piece by piece.

    Attributes
    ----------
    source : str
        All of it, line ends included.
    """

    def __init__(self, source: str) -> None:
        self.source = source

    def change(self, change: types.TextDocumentContentChangeEvent) -> None:
        """Apply a change: of a range, or of everything."""
        if isinstance(change, types.TextDocumentContentChangeWholeDocument):
            self.source = change.text
            return
        starts = [0, *(found.end() for found in _LINE_END.finditer(self.source))]
        start, end = (self._offset(starts, at) for at in (change.range.start, change.range.end))
        self.source = self.source[:start] + change.text + self.source[max(start, end) :]

    def _offset(self, starts: list[int], at: types.Position) -> int:
        if at.line >= len(starts):
            return len(self.source)
        begin = starts[at.line]
        found = _LINE_END.search(self.source, begin)
        line = self.source[begin : len(self.source) if found is None else found.start()]
        return begin + characters(line, at.character)

    def position(self, offset: int) -> types.Position:
        """Return where a character stands."""
        starts = [0, *(found.end() for found in _LINE_END.finditer(self.source))]
        line = bisect_right(starts, offset) - 1
        return types.Position(line, units(self.source[starts[line] : offset]))
