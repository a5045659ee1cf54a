"""Grammar of the ASCII lists: bytes to text, text to entries, words to numbers and strings.

An entry is ``name value [comment]`` on a line of its own. What ends a value depends on its type: a number ends at the
first blank, a string only at ``(``. So an entry carries both its first word and the whole text behind the name.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable, Iterator, Sequence
from decimal import Decimal
from itertools import islice, pairwise
from typing import NamedTuple

from .stretches import Finder, Stretch

QUOTES = '"“”″\x93\x94'
"""Characters that open and close a string; the last two are what Windows' own “ and ” become in Latin-1."""

_NAME_END = rf"(?:\s++|(?=[{QUOTES}])|$)"
# Nothing here can match in two ways, so no repetition need give anything back (++): long tables are read faster.
_ENTRY = re.compile(
    r"\s*+([^\W0-9][\w.]*+)"  # name up to its indices
    r"(?:\[\s*+([0-9]{1,9}+)\s*+\](?:\[\s*+([0-9]{1,9}+)\s*+\])?([\w.]*+))?"  # at most two, and what follows them
    rf"{_NAME_END}([+-]?[0-9]{{1,18}}+(?!\S))?(.*)"  # an integer, if it is one, and what follows
)
_ANY_NAME = re.compile(rf"\s*([^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*){_NAME_END}(.*)")
_INDEX = re.compile(r"\[([0-9\s]*)\]")
# A comment that is not closed in its line, and a line that begins one: before it stands nothing, or an unquoted value.
_UNCLOSED = re.compile(r"/\*[^\n*]*+(?:\*(?!/)[^\n*]*+)*+\n")
_OPENING = re.compile(
    rf"\s*(?:[^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*\s+(?:(?!/\*)[^\s#({QUOTES}]\S*(?:\s*\|\s*\w+)*\s+)?)?/\*"
)
_ELISION = re.compile(r"\s*(?:\.{2,}|…|:+)\s*$")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?\Z")
_HEXADECIMAL = re.compile(r"0[xX]([0-9a-fA-F]{1,16})\Z")
_FLAGS = re.compile(r"\s*[^\s|]+(?:\s*\|\s*\w+)*")
_CONTROLS = bytes({*range(32)} - set(b"\t\n\v\f\r\x1a"))
_NUMBER_LENGTH = 400

Report = Callable[[str, int, str], None]
"""Takes the code, the line and the text of a line that is no entry."""


class Entry(NamedTuple):
    """One entry of a list.

    Attributes
    ----------
    key : str
        Name as it is written, indices left empty: ``kw.ssfk.table[].pos``.
    indices : tuple of int
        The indices in their order.
    integer : str
        The value if it is an integer, else "".
    rest : str
        Everything after the name, or after the integer, comment included.
    line : int
        Counted from 1.
    """

    key: str
    indices: tuple[int, ...]
    integer: str
    rest: str
    line: int

    @property
    def text(self) -> str:
        """Everything after the name."""
        return self.integer + self.rest

    @property
    def word(self) -> str:
        """Value up to the first blank: all there is to a number; "" where a comment stands in its place."""
        word = self.integer or (self.rest.split(None, 1) or [""])[0]
        return "" if word.startswith("/*") else word

    @property
    def name(self) -> str:
        """Name with its indices."""
        return with_indices(self.key, self.indices)


def with_indices(key: str, indices: tuple[int, ...]) -> str:
    """Return a name whose empty indices are filled in."""
    for index in indices:
        key = key.replace("[]", f"[{index}]", 1)
    return key


class Encoding(NamedTuple):
    """How the characters of a file are encoded, and whether a byte order mark leads them."""

    name: str
    mark: bool


def encoding_of(data: bytes) -> Encoding:
    """Return the encoding of a file: UTF-16 where a mark says so, UTF-8 where it is, else Latin-1."""
    return _decoded(data)[0]


def _decoded(data: bytes) -> tuple[Encoding, str | None]:
    """Return the encoding of a file, and its text without mark; None if it is not what its mark says."""
    try:
        for name, mark in (("utf-16-le", codecs.BOM_UTF16_LE), ("utf-16-be", codecs.BOM_UTF16_BE)):
            if data.startswith(mark):
                return Encoding(name, True), data[len(mark) :].decode(name)
    except UnicodeDecodeError:
        return Encoding(name, True), None
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return Encoding("latin-1", False), data.decode("latin-1")
    mark_is_there = data.startswith(codecs.BOM_UTF8)
    return Encoding("utf-8", mark_is_there), text[mark_is_there:]


def decode(data: bytes) -> str | None:
    r"""Return the text of a file (see ``encoding_of``) with ``\n`` between lines; None if it is no text."""
    encoding, text = _decoded(data)
    if text is None:
        return None
    plain = text.encode() if encoding.name.startswith("utf-16") else data
    controls = len(plain) - len(plain.translate(None, _CONTROLS))
    if b"\0" in plain or controls > len(plain) // 20:
        return None
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text.replace("\x1a", "")


def entries(text: str, report: Report, take: Callable[[Stretch], bool] | None = None) -> Iterator[Entry]:
    """Yield the entries of a list up to its ``End``; ``report`` gets the lines that are none.

    ``take`` gets regular stretches; the entries of those that it takes are not yielded.
    """
    match = _ENTRY.match
    lines = text.split("\n")
    if "/*" in text and _UNCLOSED.search(text):
        _blank_comments(lines, report)
    taken = None if take is None else Finder(lines, take).taken
    numbered = enumerate(lines, 1)
    for number, line in numbered:
        found = match(line)
        if found is None:
            if odd := _odd(line, number, report):
                yield odd
            continue
        name, first, second, tail, integer, rest = found.groups("")
        if not first:
            if not integer and not rest and name.lower() in ("end", "ende"):
                _report_after_end(lines, number, report)
                return
            yield Entry(name, (), integer, rest, number)
        elif taken is not None and integer and (count := taken(number - 1, name, second or first)):
            next(islice(numbered, count - 1, count - 1), None)
        elif not second:
            yield Entry(f"{name}[]{tail}", (int(first),), integer, rest, number)
        else:
            yield Entry(f"{name}[][]{tail}", (int(first), int(second)), integer, rest, number)


def continued(lines: Sequence[str]) -> set[int]:
    """Return the places of the lines that belong to a comment which an earlier line begins.

    A comment that another one begins before it is closed ends with its line.
    """
    found: set[int] = set()
    marked = [at for at, line in enumerate(lines) if "/*" in line or "*/" in line]
    for at, following in pairwise(marked):
        opening = None if at in found else _OPENING.match(lines[at])
        if opening is None or "*/" in lines[at][opening.end() :]:
            continue
        if "/*" not in lines[following].partition("*/")[0]:
            found.update(range(at + 1, following + 1))
    return found


def _blank_comments(lines: list[str], report: Report) -> None:
    """Make lines of comments empty; what follows a comment in its last line is reported."""
    for at in sorted(continued(lines)):
        behind = lines[at].partition("*/")[2].strip()
        if behind:
            report("AXC-SYNTAX", at + 1, behind)
        if lines[at - 1].lstrip().startswith("/*"):
            lines[at - 1] = ""
        lines[at] = ""


def _odd(line: str, number: int, report: Report) -> Entry | None:
    """Sort out a line the quick expression does not take: an entry with many indices, or a report."""
    stripped = line.strip()
    if (
        not stripped
        or stripped.startswith("#")
        or (stripped.startswith("/*") and stripped.find("*/", 2) == len(stripped) - 2)
    ):
        return None
    found = _ANY_NAME.match(line)
    if found is not None:
        digits = [index.strip() for index in _INDEX.findall(found[1])]
        if all(index.isdigit() and len(index) < 10 for index in digits):
            return Entry(_INDEX.sub("[]", found[1]), tuple(map(int, digits)), "", found[2], number)
    report("AXC-ELISION" if _ELISION.match(line) else "AXC-SYNTAX", number, stripped)
    return None


def _report_after_end(lines: list[str], end: int, report: Report) -> None:
    for number, line in enumerate(lines[end:], end + 1):
        if line.strip():
            report("AXC-END", number, line.strip())
            return


def number(word: str) -> int | Decimal | None:
    """Return a number exactly as it is written, None if the word is none. Hexadecimal integers are taken too."""
    if len(word) <= _NUMBER_LENGTH:
        if _NUMBER.match(word):
            value = Decimal(word)
            # An exponent can make any number of digits: only numbers of a sensible size become an int.
            return int(value) if value == value.to_integral_value() and abs(value) < 10**30 else value
        if found := _HEXADECIMAL.match(word):
            return int(found[1], 16)
    return None


def flags(text: str) -> str:
    """Return what an entry's text begins with where bits may be joined: ``A`` or ``A | B``."""
    found = _FLAGS.match(text)
    return found[0].strip() if found else ""


class String(NamedTuple):
    """A string value: its text, whether it was quoted, what follows it, and a fault ("" if there is none)."""

    value: str
    quoted: bool
    comment: str
    fault: str


def string(text: str) -> String:
    """Return the string an entry's text begins with; only ``(`` opens a comment after it."""
    text = text.strip()
    if not text or text[0] not in QUOTES:
        value, bracket, comment = text.partition("(")
        value = value.strip()
        special = any(character.isspace() for character in value) or "#" in value or "/*" in value
        fault = "blanks, # and /* stand in quotes only, and only ( opens a comment after a string" if special else ""
        return String(value, False, bracket + comment, fault)
    end = next((place for place, character in enumerate(text) if place and character in QUOTES), None)
    if end is None:
        return String(text[1:].strip(), True, "", "the closing quote is missing")
    comment = text[end + 1 :].strip()
    fault = "only ( opens a comment after a string" if comment and not comment.startswith("(") else ""
    return String(text[1:end].rstrip(), True, comment, fault)
