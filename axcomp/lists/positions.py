"""Where something stands in a list: lines taken apart, values replaced in them, columns of findings."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..kinds import DataType, ListKind, Parameter, key_of
from .catalogue import SPELLINGS
from .findings import Finding
from .grammar import QUOTES, Entry, entries, flags, string, with_indices

if TYPE_CHECKING:
    from .document import Document

DOS_END = "\x1a"
"""What some editors put behind the last line; it is nothing."""

INDEX = re.compile(r"\[\s*([0-9]+)\s*\]")
"""A number as an index in a name."""

_NAME = re.compile(r"\s*[^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*")


class Position(NamedTuple):
    """Where something stands; ``line`` is 0 where that is not known."""

    file: str
    line: int
    parameter: str


class DocumentEntry(NamedTuple):
    """One entry with its position.

    Attributes
    ----------
    key : str
        Name as it is written, indices left empty.
    indices : tuple of int
        The indices in their order.
    value : str
        As it is written, quotes included; "" where there is none.
    comment : str
        What follows the value.
    line : int
        Counted from 1.
    column, value_column : int
        Where name and value begin, in characters from 1.
    parameter : Parameter or None
        None where the catalogue has none for such a list.
    """

    key: str
    indices: tuple[int, ...]
    value: str
    comment: str
    line: int
    column: int
    value_column: int
    parameter: Parameter | None

    @property
    def name(self) -> str:
        """Name with its indices."""
        return with_indices(self.key, self.indices)


def detailed(entry: Entry, line: str, kind: ListKind) -> DocumentEntry:
    """Return an entry with where it stands in its line."""
    spelling = SPELLINGS[kind].get(entry.key.lower())
    parameter = None if spelling is None else spelling.parameter
    start, value = _value(line, entry, parameter)
    comment = line[start + len(value) :].strip()
    return DocumentEntry(entry.key, entry.indices, value, comment, entry.line, _begin(line), start + 1, parameter)


def _begin(line: str) -> int:
    return len(line) - len(line.lstrip()) + 1


def _value(line: str, entry: Entry, parameter: Parameter | None) -> tuple[int, str]:
    """Return where in a line the value begins, and the value."""
    name = _NAME.match(line)
    assert name is not None, f"line {entry.line} has no name"
    start = len(line) - len(line[name.end() :].lstrip())
    old = line[start:].rstrip()
    if parameter is not None and parameter.flags:
        return start, flags(old)
    is_string = old[:1] in QUOTES if parameter is None else parameter.type is DataType.STRING
    if not old or not is_string:
        return start, entry.word
    return start, old[: len(old) - len(string(old).comment)].rstrip()


def with_value(line: str, entry: Entry, parameter: Parameter, value: str, comment_stays: bool) -> str:
    """Return a line with another value; a comment that stays keeps its column where it can."""
    line = line.replace(DOS_END, "")
    start, old = _value(line, entry, parameter)
    before, rest = line[:start], line[start + len(old) :]
    if not before[-1:].isspace():
        before += " "
    if not comment_stays:
        return before + value
    if not rest.strip():
        return before + value + rest
    if parameter.type is DataType.STRING and not rest.lstrip().startswith("(") and not value.startswith('"'):
        # Only ( opens a comment after a string without quotes.
        value = f'"{value}"'
    between = "" if rest[0].isspace() or rest[0] == "(" else " "
    return before + value.ljust(len(old)) + between + rest


def located(findings: Iterable[Finding], documents: Mapping[Path, Document]) -> tuple[Finding, ...]:
    """Return findings with the column of the entry they are about, where it stands in the line they name."""
    held = {str(path): document for path, document in documents.items() if document.kind is not None}
    lines: dict[str, list[str]] = {}
    found = []
    for finding in findings:
        column = 0
        document = held.get(finding.file)
        if document is not None and finding.line and finding.parameter:
            if finding.file not in lines:
                lines[finding.file] = document.text.split("\n")
            column = _column(lines[finding.file][finding.line - 1], finding.parameter, document)
        found.append(replace(finding, column=column) if column else finding)
    return tuple(found)


def outside(findings: Iterable[Finding], documents: Mapping[Path, Document]) -> tuple[Finding, ...]:
    """Return findings about lists that stand in another file with the file, line and column they have there."""
    outer = {str(path): document.outer for path, document in documents.items()}
    found = []
    for finding in findings:
        where = outer.get(finding.file)
        if where is None:
            found.append(finding)
            continue
        file, line, column = where
        first = column if finding.line == 1 and finding.column else 0
        place = finding.column + first
        found.append(replace(finding, file=str(file), line=max(finding.line, 1) + line, column=place))
    return tuple(found)


def _column(line: str, name: str, document: Document) -> int:
    """Return where an entry begins in a line, 0 if another one or none stands there."""
    entry = next(entries(line, lambda *_: None), None)
    if entry is None or document.kind is None:
        return 0
    known = SPELLINGS[document.kind]
    written, meant = known.get(entry.key.lower()), known.get(key_of(name))
    same = entry.name == name if written is None or meant is None else written.parameter is meant.parameter
    indices = tuple(map(int, INDEX.findall(name)))
    return _begin(line) if same and indices in ((), entry.indices) else 0
