r"""An NC block as words: names, numbers, strings and signs, each with its place.

``;`` begins a comment up to the end of the line, ``(`` one up to ``)``. A ``\`` at the end of a line continues the
block on the next one.
"""

from __future__ import annotations

import re
from typing import NamedTuple


class NcError(ValueError):
    """A block that cannot be carried out: what was expected, and at which character.

    Attributes
    ----------
    place : int
        Character of the block, counted from 1.
    code : str
        The vendor's number where there is one, else "".
    """

    def __init__(self, place: int, message: str, code: str = "") -> None:
        self.place = place
        self.code = code
        super().__init__(f"character {place}: {f'error {code}: ' if code else ''}{message}")


class Word(NamedTuple):
    """A word of a block.

    Attributes
    ----------
    kind : str
        ``name``, ``number``, ``string``, ``sign``, ``line`` (its end) or ``end`` (of the block).
    text : str
        Names in capitals; strings without their quotes.
    place : int
        Of its first character, counted from 1.
    """

    kind: str
    text: str
    place: int

    @property
    def shown(self) -> str:
        """The word as a message shows it."""
        return {"end": "the end of the block", "line": "the end of the line"}.get(self.kind, f"“{self.text}”")


_WORD = re.compile(
    r"""(?P<blank>[ \t\r]+|\\[ \t\r]*\n|;[^\n]*|\([^)\n]*\))
    |(?P<line>\n)
    |(?P<name>\.?[^\W\d][\w.\-]*)
    |(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)
    |"(?P<string>[^"\n]*)"
    |(?P<sign>[\[\]=\#,])""",
    re.VERBOSE,
)


def scan(block: str) -> list[Word]:
    """Return the words of a block, closed by one of kind ``end``; NcError for a character that begins none."""
    words: list[Word] = []
    at = 0
    while at < len(block):
        found = _WORD.match(block, at)
        if found is None:
            raise NcError(at + 1, f"“{block[at]}” begins neither a name nor a number nor a string")
        kind = str(found.lastgroup)
        if kind != "blank":
            text = found[kind]
            words.append(Word(kind, text.upper() if kind == "name" else text, at + 1))
        at = found.end()
    words.append(Word("end", "", len(block) + 1))
    return words


class Cursor:
    """Where a parser stands among the words."""

    def __init__(self, words: list[Word]) -> None:
        self._words = words
        self._next = 0

    @property
    def word(self) -> Word:
        """The next word."""
        return self._words[self._next]

    def take(self) -> Word:
        """Return the next word and go on behind it."""
        word = self.word
        self._next = min(self._next + 1, len(self._words) - 1)
        return word

    def take_if(self, *texts: str) -> Word | None:
        """Return the next word and go on if it is one of these names or signs."""
        return self.take() if self.word.kind in ("name", "sign") and self.word.text in texts else None

    def expect(self, *texts: str) -> Word:
        """Return the next word, which must be one of these names or signs."""
        word = self.take_if(*texts)
        if word is None:
            raise self.wrong(" or ".join(texts))
        return word

    def expect_kind(self, kind: str, expected: str) -> Word:
        """Return the next word, which must be of a kind."""
        if self.word.kind != kind:
            raise self.wrong(expected)
        return self.take()

    def wrong(self, expected: str) -> NcError:
        """Return the error that something else was expected than the next word."""
        return NcError(self.word.place, f"{expected} is expected, not {self.word.shown}")
