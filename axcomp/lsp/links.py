"""What leads from one list to another: file names, numbers of axes, activators; and a number changed everywhere."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from ..kinds import KINDS, ListKind
from ..lists import Document, DocumentEntry, Files, Findings, Reading, number
from ..model import LETTERS
from .entries import FILE_NAMES, entry_at

_NUMBERED = re.compile(r"(?:^|[._])(?:achs_nr|\w*_ax_nr)(?:\[i\])?\Z")
_NUMBER = "kopf.achs_nr"
NUMBER_MAX = 65535
"""Largest logical axis number: UNS16."""


class Place(NamedTuple):
    """Where something stands: characters of a line, both counted from 0."""

    path: Path
    line: int
    start: int
    end: int


def value_place(document: Document, entry: DocumentEntry) -> Place:
    """Return where the value of an entry stands."""
    start = entry.value_column - 1
    return Place(document.path, entry.line - 1, start, start + len(entry.value))


def is_axis_number(document: Document, entry: DocumentEntry) -> bool:
    """Tell whether the value of an entry is the logical number of an axis."""
    if entry.parameter is None or not isinstance(number(entry.value), int):
        return False
    if document.kind is ListKind.VOLUMETRIC:
        return entry.parameter.name.upper() in LETTERS
    return _NUMBERED.search(entry.parameter.name) is not None


def numbers_of(reading: Reading, axis: int) -> Iterator[Place]:
    """Yield every place of a machine's lists where the number of an axis stands."""
    for document in reading.documents.values():
        if document.kind is not None and document.is_text and document.outer is None:
            for entry in document.entries:
                if is_axis_number(document, entry) and number(entry.value) == axis:
                    yield value_place(document, entry)


def definitions(document: Document, line: int, reading: Reading) -> list[Place]:
    """Return where what an entry names is described."""
    entry = entry_at(document, line)
    if entry is None or entry.parameter is None:
        return []
    if entry.parameter.name in FILE_NAMES:
        return _file(document, entry, reading)
    kind = next((one for one in KINDS.values() if one.activator is entry.parameter), None)
    if kind is not None:
        tables = reading.compensation_list(document.values.integer(_NUMBER))
        prefix = kind.prefix.lower()
        rows = [] if tables is None else [one for one in tables.entries if one.key.lower().startswith(prefix)]
        return [value_place(tables, rows[0])] if tables is not None and rows else []
    if not is_axis_number(document, entry):
        return []
    axis = int(number(entry.value) or 0)
    lists = [reading.axis_list(axis), reading.compensation_list(axis)]
    if entry.parameter.name.startswith("achs_kw_log"):
        lists.reverse()
    return [_header(one, axis) for one in lists if one is not None and one is not document]


def _file(document: Document, entry: DocumentEntry, reading: Reading) -> list[Place]:
    assert entry.parameter is not None
    name = document.values.text(entry.parameter.name, *entry.indices)
    files = Files(Findings(), reading.documents.values(), beside_disk=True)
    found = files.named(document.path.parent, name, ("", 0, "")) if name else None
    return [] if found is None else [Place(found, 0, 0, 0)]


def _header(document: Document, axis: int) -> Place:
    for entry in document.entries:
        if is_axis_number(document, entry) and entry.key.lower().startswith("kopf.") and number(entry.value) == axis:
            return value_place(document, entry)
    return Place(document.path, 0, 0, 0)
