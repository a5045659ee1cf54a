"""A list file as it stands: its entries with the positions where they stand, edited in place, saved whole.

Entries that are there get their new value where they stand; those that a new table does not need go, those it has more
come where they belong, and what was not there at all is put before ``End``. The comment behind a value stays, unless
it belongs to a row of a table whose rows now stand for something else. Everything else stays byte for byte.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ..kinds import DataType, ListKind, Parameter, key_of
from ..saving import write_whole
from .catalogue import SPELLINGS, parameter
from .findings import Findings
from .format import text_of
from .grammar import Encoding, Entry, continued, decode, encoding_of, entries
from .positions import DOS_END, INDEX, DocumentEntry, Position, detailed, with_value
from .values import ListValues, read_values

_NEWLINES = re.compile(r"(\r\n|\r|\n)")
_END = re.compile(r"\s*ende?\s*\Z", re.I)

Name = tuple[str, tuple[int, ...]]
"""``key_of`` a parameter's name, and its indices: what an entry is about, however it is spelt."""


class Document:
    """One file.

    Attributes
    ----------
    path : Path
        As it was named; findings name it so.
    data : bytes
        As read or last saved.
    kind : ListKind or None
        None for a file of volumetric parameters, which has no entries.
    outer : tuple of Path, int and int, or None
        Of a list that stands in another file: that file, and how many lines, and characters of a line, are before it.
    """

    def __init__(self, path: str | os.PathLike[str], data: bytes = b"", kind: ListKind | None = None) -> None:
        self.path = Path(path)
        self.data = data
        self.kind = kind
        self.outer: tuple[Path, int, int] | None = None
        # Lines and the line ends behind them, once something is changed.
        self._lines: list[str] | None = None
        self._newlines: list[str] = []
        self._forget()

    def _forget(self) -> None:
        self._text: str | None = None
        self._raw: list[Entry] | None = None
        self._shown: tuple[DocumentEntry, ...] | None = None
        self._at: dict[Name, int] = {}
        self._values: dict[ListKind, tuple[ListValues, ListValues | None, Findings]] = {}

    def copy(self) -> Document:
        """Return a document to be edited on its own."""
        other = Document(self.path, self.data, self.kind)
        if self._lines is not None:
            other._lines, other._newlines = list(self._lines), list(self._newlines)
        # What has been parsed is not parsed again for what is left as it is.
        other._text, other._shown, other._values = self._text, self._shown, dict(self._values)
        other._raw, other._at = None if self._raw is None else list(self._raw), dict(self._at)
        return other

    # What it says

    @property
    def is_text(self) -> bool:
        """Whether there is anything to be read."""
        try:
            return self.text is not None
        except ValueError:
            return False

    @property
    def text(self) -> str:
        r"""All of it with ``\n`` between lines; ValueError if it is no text."""
        if self._text is None:
            self._text = decode(self.data) if self._lines is None else "\n".join(self._lines).replace(DOS_END, "")
        if self._text is None:
            raise ValueError(f"{self.path} is no text")
        return self._text

    @property
    def encoding(self) -> Encoding:
        """Of the characters."""
        return encoding_of(self.data)

    @property
    def newline(self) -> str:
        """The line end that new lines get: that of the first line."""
        if self._lines is not None:
            return self._newlines[0] if self._newlines else "\n"
        found = _NEWLINES.search(self._decoded())
        return found[0] if found else "\n"

    @property
    def entries(self) -> tuple[DocumentEntry, ...]:
        """All entries up to ``End`` in their order."""
        if self._shown is None:
            lines = self.text.split("\n")
            self._shown = tuple(detailed(entry, lines[entry.line - 1], self._kind()) for entry in self._entries())
        return self._shown

    @property
    def values(self) -> ListValues:
        """Its plausible values; ValueError if it is no list."""
        if self.kind is None:
            raise ValueError(f"{self.path} is no list")
        held = self._values.get(self.kind)
        return self.read_as(self.kind, Findings()) if held is None else held[0]

    def read_as(self, kind: ListKind, findings: Findings, fallback: ListValues | None = None) -> ListValues:
        """Return its plausible values as those of a kind of list; read once, ``findings`` gets told each time."""
        self.kind = self.kind or kind
        held = self._values.get(kind)
        if held is None or held[1] is not fallback:
            found = Findings()
            held = self._values[kind] = (read_values(self.text, str(self.path), kind, found, fallback), fallback, found)
        findings.take(held[2])
        return held[0]

    def position(self, name: str, *indices: int) -> Position:
        """Return where an entry stands, else the first one of its table; line 0 where that is not there either."""
        values = self.values
        shown = parameter(values.kind, name).named(*indices) if indices else name
        if indices and not values.given(name, *indices):
            first = min((line for _, line in values.cells(name).values()), default=0)
            return Position(values.file, first, shown)
        return Position(*values.place(name, *indices), shown)

    # Editing

    def set(self, name: str, value: object, *indices: int) -> None:
        """Give an entry a value; a new entry comes behind those of its table that go before it, else before ``End``.

        Parameters
        ----------
        name : str
            Any of its names; indices may be filled in.
        value : bool, int, float, Decimal or str
            In the unit of the list; of a number also the word that is to stand there.
        *indices : int
            Where the name does not have them.

        Raises
        ------
        ValueError
            The list has no such parameter, or cannot hold the value.
        """
        meant, indices = self._meant(name, indices)
        shown = meant.named(*indices) if indices else meant.name
        written = text_of(value, shown, meant.type is DataType.STRING)
        parsed = self._entries()
        at = self._at.get((meant.key, indices))
        if at is None:
            self._insert(meant, indices, f"{shown:<40} {written}")
            return
        line = parsed[at].line
        lines = self._editable()
        lines[line - 1] = with_value(lines[line - 1], parsed[at], meant, written, comment_stays=True)
        entry = next(entries(lines[line - 1], lambda *_: None))._replace(line=line)
        raw, where = parsed, self._at
        self._forget()
        raw[at] = entry
        self._raw, self._at = raw, where

    def remove(self, name: str, *indices: int) -> None:
        """Take an entry out, each time it is given; ValueError if it is not there."""
        meant, indices = self._meant(name, indices)
        wanted = (meant.key, indices)
        inside = continued(self._editable())
        at = [entry.line - 1 for found, _, entry in self._known() if found == wanted]
        gone = {line for first in at for line in (first, *_behind(first, inside))}
        if not gone:
            raise ValueError(f"{self.path} has no entry {meant.named(*indices) if indices else meant.name}")
        self._rebuild(gone, {})

    def replace_entries(
        self, new: Sequence[str], owned: Collection[str], heading: str, keep_row_comments: bool = True
    ) -> None:
        """Give all entries of some parameters new values.

        Parameters
        ----------
        new : sequence of str
            Lines ``name value``, in the order they have in a new list.
        owned : collection of str
            The parameters the new entries are about. Where they have none for one of these, the list must not either.
        heading : str
            Comment above them where the list has none of them; ASCII.
        keep_row_comments : bool
            Rows of tables still stand for the same, so what is said about them stays true.

        Raises
        ------
        ValueError
            The list is no text.
        """
        wanted = {name: entry for name, _, entry in _known(entries("\n".join(new), lambda *_: None), self._kind())}
        keys = {key_of(name) for name in owned}
        present = [found for found in self._known() if found[1].key in keys]
        lines = self._editable()
        inside = continued(lines)
        stay: dict[Name, int] = {}
        gone: set[int] = set()
        for name, known, entry in present:
            at = entry.line - 1
            replacement = wanted.get(name)
            if replacement is None:
                gone.update({at, *_behind(at, inside)})
                continue
            stay[name] = at
            value = replacement.text.rstrip() if known.type is DataType.STRING else replacement.word
            comment_stays = keep_row_comments or not entry.indices
            lines[at] = with_value(lines[at], entry, known, value, comment_stays)
            if not comment_stays:
                gone.update(_behind(at, inside))
        end = self._end()
        first = present[0][2].line - 1 if present else None
        first_row = next((entry.line - 1 for _, _, entry in present if entry.indices), None)
        added = _added(wanted, stay, end if first is None else first, first_row)
        if first is None:
            blank = [""] if end > 0 and lines[end - 1].strip() else []
            added.setdefault(end, [])[:0] = [*blank, f"# {heading}"]
        self._rebuild(gone, added)

    def edit_lines(self, changed: Mapping[int, str | None], added: Mapping[int, Sequence[str]]) -> None:
        """Give lines another text, take them out (None), and put some before a line; lines are counted from 1."""
        lines = self._editable()
        for line, text in changed.items():
            lines[line - 1] = lines[line - 1] if text is None else text
        gone = {line - 1 for line, text in changed.items() if text is None}
        self._rebuild(gone, {line - 1: texts for line, texts in added.items()})

    def replace_text(self, text: str) -> None:
        r"""Give the list another text, with ``\n`` between lines: all of them get the line end of the first one."""
        newline = self.newline
        self._lines = text.split("\n")
        self._newlines = [newline] * (len(self._lines) - 1)
        self._forget()

    # Saving

    def to_bytes(self) -> bytes:
        """Return the file; ValueError if its encoding lacks a new character."""
        if self._lines is None:
            return self.data
        text = "".join(line + newline for line, newline in zip(self._lines, [*self._newlines, ""], strict=True))
        name, mark = self.encoding
        return ("\ufeff" * mark + text).encode(name)

    @property
    def changed(self) -> bool:
        """Whether it says something else than when it was read or saved."""
        return self.to_bytes() != self.data

    def save(self) -> None:
        """Write the file if it is changed, whole or not at all; OSError if that fails."""
        data = self.to_bytes()
        if data != self.data:
            write_whole(self.path, data)
            self.data = data

    # Inside

    def _kind(self) -> ListKind:
        if self.kind is None:
            raise ValueError(f"{self.path} is no list")
        return self.kind

    def _decoded(self) -> str:
        name, mark = self.encoding
        return self.data.decode(name)[mark:]

    def _editable(self) -> list[str]:
        if self._lines is None:
            pieces = _NEWLINES.split(self._decoded())
            self._lines, self._newlines = pieces[::2], pieces[1::2]
        return self._lines

    def _entries(self) -> list[Entry]:
        if self._raw is None:
            self._raw = list(entries(self.text, lambda *_: None))
            known = SPELLINGS[self._kind()]
            for at, entry in enumerate(self._raw):
                spelling = known.get(entry.key.lower())
                if spelling is not None:
                    # Of two the later one counts.
                    self._at[spelling.parameter.key, entry.indices] = at
        return self._raw

    def _known(self) -> Iterator[tuple[Name, Parameter, Entry]]:
        return _known(self._entries(), self._kind())

    def _meant(self, name: str, indices: tuple[int, ...]) -> tuple[Parameter, tuple[int, ...]]:
        spelling = SPELLINGS[self._kind()].get(key_of(name))
        if spelling is None:
            raise ValueError(f"a list {self._kind().value} has no entry {name}")
        found = indices or tuple(map(int, INDEX.findall(name)))
        count = spelling.parameter.name.count("[")
        if len(found) != count:
            raise ValueError(f"{name} needs {count} indices, not {len(found)}")
        return spelling.parameter, found

    def _end(self) -> int:
        """Return before which line new entries come."""
        lines = self._editable()
        # A last line that is empty is none: there is nothing behind the last newline.
        count = len(lines) - (not lines[-1].strip(DOS_END))
        inside = continued(lines)
        ends = (i for i, line in enumerate(lines) if i not in inside and _END.match(line.replace(DOS_END, "")))
        return next(ends, count)

    def _insert(self, meant: Parameter, indices: tuple[int, ...], line: str) -> None:
        table = meant.key.rpartition(".")[0]
        before = [
            (entry.indices, entry.line)
            for (key, _), _, entry in self._known()
            if key.rpartition(".")[0] == table and entry.indices <= indices
        ]
        self._rebuild(set(), {max(before)[1] if before else self._end(): [line]})

    def _rebuild(self, gone: Collection[int], added: Mapping[int, Sequence[str]]) -> None:
        """Take lines out, and put lines before others."""
        lines, newlines, newline = self._editable(), self._newlines, self.newline
        inside = continued(lines)
        # Nothing is put into a comment.
        places: dict[int, list[str]] = {}
        for i in sorted(added):
            places.setdefault(max((i, *(line + 1 for line in _behind(i - 1, inside)))), []).extend(added[i])
        out: list[str] = []
        for i, line in enumerate(lines):
            out.extend(text + newline for text in places.get(i, ()))
            if i not in gone:
                out.append(line + (newlines[i] if i < len(newlines) else ""))
        behind = places.get(len(lines), ())
        if behind and out and out[-1] and not out[-1].endswith(("\n", "\r")):
            out[-1] += newline
        out.extend(text + newline for text in behind)
        pieces = _NEWLINES.split("".join(out))
        self._lines, self._newlines = pieces[::2], pieces[1::2]
        self._forget()


def _behind(at: int, inside: Collection[int]) -> Iterator[int]:
    """Yield the lines over which a comment goes on that begins in a line, or before it; ``inside``: all such lines."""
    while (at := at + 1) in inside:
        yield at


def _known(found: Iterable[Entry], kind: ListKind) -> Iterator[tuple[Name, Parameter, Entry]]:
    """Yield the entries that the catalogue knows, with what they are about."""
    known = SPELLINGS[kind]
    for entry in found:
        spelling = known.get(entry.key.lower())
        if spelling is not None:
            yield (spelling.parameter.key, entry.indices), spelling.parameter, entry


def _added(
    wanted: Mapping[Name, Entry], stay: Mapping[Name, int], start: int, first_row: int | None
) -> dict[int, list[str]]:
    """Return the lines to put before line ``key``: each behind the one it follows in a new list."""
    added: dict[int, list[str]] = {}
    cursor = start
    in_table = False
    for name, entry in wanted.items():
        if entry.indices and not in_table:
            in_table = True
            cursor = cursor if first_row is None else first_row
        if name in stay:
            cursor = stay[name] + 1
        else:
            added.setdefault(cursor, []).append(f"{entry.name:<40} {entry.text.rstrip()}")
    return added
