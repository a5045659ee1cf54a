"""What can be mended by itself: spelling, entries given twice, rows out of order, sizes and counts that are missing.

A fix changes what a machine does only as its finding says: what was not taken is taken, what was off acts. Comments
stay.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import prod
from pathlib import Path
from typing import Any

from ..kinds import KINDS, Kind, ListKind, key_of
from ..lists import (
    SPELLINGS,
    Document,
    Entry,
    Files,
    Finding,
    Findings,
    Reading,
    TypeName,
    all_similar,
    continued,
    entries,
    parameter,
    read_machine,
    read_values,
)
from .selection import Selection
from .settings import Settings

_PASSES = 1000
"""Fixes may make room for others; each pass mends at least one finding."""

_SPELL = "Spell it "
_NAME = re.compile(r"(\s*)([^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*)([^\S\n]*)")


@dataclass(frozen=True)
class Fix:
    """A change of a list that mends a finding.

    Attributes
    ----------
    title : str
        What it does, in a few words.
    changed : dict of int to str or None
        New texts of lines, counted from 1; None: the line goes.
    added : dict of int to list of str
        Lines that come before a line.
    """

    title: str
    changed: dict[int, str | None] = field(default_factory=dict)
    added: dict[int, list[str]] = field(default_factory=dict)


def fixes_of(document: Document, finding: Finding) -> Fix | None:
    """Return how a finding about a list is mended; None if that is for somebody to decide."""
    mend = _FIXES.get(finding.code)
    if mend is None or document.kind is None or not document.is_text:
        return None
    lines = document.text.split("\n")
    fix = mend(document, lines, finding)
    # A comment that goes on in the next line is not torn apart.
    inside = {line + 1 for line in continued(lines)}
    return None if fix is None or any({line, line + 1} & inside for line in fix.changed) else fix


def fixed(path: Path, settings: Settings, axis_type: TypeName | None = None) -> tuple[Reading, int]:
    """Return the lists of a machine, mended as far as can be but not yet saved, and how many fixes that took.

    Only findings that are told are mended.
    """
    count = 0
    options: dict[str, Any] = {"axis_type": axis_type, "allow_outside": settings.allow_outside}
    reading = read_machine(path, **options)
    for _ in range(_PASSES):
        mended = _mend(reading, Selection(settings, reading.documents))
        if not mended:
            break
        count += mended
        documents = list(reading.documents.values())
        reading = read_machine(path, documents=documents, beside_disk=True, **options)
    return reading, count


def _mend(reading: Reading, selection: Selection) -> int:
    """Mend what can be mended at once, and return how many findings that were."""
    documents = {str(path): document for path, document in reading.documents.items()}
    plans: dict[str, list[Fix]] = {}
    for shown, finding in zip(reading.findings, reading.inner_findings, strict=True):
        document = documents.get(finding.file)
        fix = fixes_of(document, finding) if document is not None and selection.tells(shown) else None
        if fix is not None:
            plans.setdefault(finding.file, []).append(fix)
    count = 0
    for file, fixes in plans.items():
        changed: dict[int, str | None] = {}
        added: dict[int, list[str]] = {}
        # What is only misspelt is not missing.
        spelling = [fix for fix in fixes if fix.title.startswith(_SPELL)]
        for fix in spelling or fixes:
            if not (fix.changed.keys() & changed.keys() or fix.added.keys() & added.keys()):
                changed |= fix.changed
                added |= fix.added
                count += 1
        documents[file].edit_lines(changed, added)
    return count


def _entry_at(lines: Sequence[str], line: int) -> Entry | None:
    return next(entries(lines[line - 1], lambda *_: None), None) if 0 < line <= len(lines) else None


def _renamed(line: str, name: str) -> str:
    """Return a line with another name; its value keeps its column where it can."""
    found = _NAME.match(line)
    assert found is not None
    room = len(found[2]) + len(found[3]) - len(name)
    return f"{found[1]}{name}{' ' * max(room, 1 if found[3] else 0)}{line[found.end() :]}"


def _spelling(document: Document, lines: Sequence[str], finding: Finding) -> Fix | None:
    """Give a name its usual spelling, or the only one it can stand for if that is not there."""
    entry = _entry_at(lines, finding.line)
    kind = document.kind
    if entry is None or kind is None:
        return None
    key = entry.key.lower()
    spelling = SPELLINGS[kind].get(key)
    if spelling is not None:
        meant = spelling.parameter
    else:
        near = all_similar(kind, key)
        if len(near) != 1:
            return None
        meant = parameter(kind, near[0])
        if meant.name.count("[") != len(entry.indices) or document.values.given(meant.name, *entry.indices):
            return None
    line = _renamed(lines[finding.line - 1], meant.named(*entry.indices) if entry.indices else meant.name)
    found = Findings()
    read_values(line, "", kind, found)
    return None if found.all() else Fix(f"{_SPELL}{meant.name}", {finding.line: line})


def _duplicates(document: Document, lines: Sequence[str], finding: Finding) -> Fix | None:
    """Take out what a later entry replaces."""
    last = _entry_at(lines, finding.line)
    kind = document.kind
    if last is None or kind is None or last.key.lower() not in SPELLINGS[kind]:
        return None
    meant = SPELLINGS[kind][last.key.lower()].parameter
    changed: dict[int, str | None] = {}
    for entry in document.entries:
        if entry.line < finding.line and entry.parameter is meant and entry.indices == last.indices:
            comment = entry.comment
            changed[entry.line] = (comment if comment.startswith(("#", "/*")) else f"# {comment}") if comment else None
    return Fix(f"Remove the earlier {last.name}", changed) if changed else None


def _kind_of(kind: ListKind | None, name: str) -> Kind[Any] | None:
    """Return the kind of compensation whose table or size an entry belongs to."""
    owners = (one for one in KINDS.values() if one.list_kind is kind)
    return next((one for one in owners if name in map(key_of, (*one.columns, *one.sizes))), None)


def _sizes(document: Document, lines: Sequence[str], finding: Finding) -> Fix | None:
    """Say how large a table is whose rows are all there, or how many lists there are."""
    del lines
    key, values = key_of(finding.parameter), document.values
    if document.kind is ListKind.START_UP:
        return _counts(document, key)
    owner = _kind_of(document.kind, key)
    if owner is None:
        return None
    rows = {name: set(values.cells(name)) for name in owner.columns if values.cells(name) and ".table[" in name}
    given = set().union(*rows.values())
    if not given or len({len(indices) for indices in given}) != 1 or any(one != given for one in rows.values()):
        return None
    # The first size counts the index that runs fastest, which is the last one.
    names = owner.sizes[-len(next(iter(given))) :]
    counts = [max(indices[-1 - place] for indices in given) + 1 for place in range(len(names))]
    sizes = {name: count - ("last_index" in name) for name, count in zip(names, counts, strict=True)}
    missing = [name for name in names if not values.given(name)]
    agree = all(values.integer(name) == sizes[name] for name in names if name not in missing)
    if not missing or not agree or len(given) != prod(counts) or len(given) > owner.reserved(None, values):
        return None
    first = min(line for name in rows for _, line in values.cells(name).values())
    return Fix("Say how large the table is", added={first: [f"{name:<40} {sizes[name]}" for name in missing]})


def _counts(document: Document, key: str) -> Fix | None:
    names = {"zahl_kw": "achs_kw[i]", "zahl_mds": "achs_mds[i]"}
    cells = document.values.cells(names[key]) if key in names else {}
    if not cells or document.values.given(key) or set(cells) != {(i,) for i in range(len(cells))}:
        return None
    first = min(line for _, line in cells.values())
    return Fix("Say how many lists there are", added={first: [f"{key:<40} {len(cells)}"]})


def _order(document: Document, lines: Sequence[str], finding: Finding) -> Fix | None:
    """Sort the rows of a table by what must ascend: indices, and lines with all that stands in them."""
    key, values = key_of(finding.parameter), document.values
    owner = _kind_of(document.kind, key)
    if owner is None or "[" not in key:
        return None
    cells = values.cells(next(name for name in owner.columns if key_of(name) == key))
    rows: list[tuple[int, ...]] = [(index,) for index in range(len(cells))]
    size = owner.sizes[-1]
    if set(cells) != set(rows) or values.integer(size) + ("last_index" in size) != len(rows):
        return None
    places = [value for value, _ in map(cells.__getitem__, rows) if not isinstance(value, str)]
    if len(set(places)) != len(rows) or (finding.code == "110591" and min(places) < 0):
        return None
    table = key.rpartition(".")[0]
    found = [one for one in document.entries if one.parameter and one.parameter.key.rpartition(".")[0] == table]
    names = Counter((one.key.lower(), one.indices) for one in found)
    if max(names.values()) > 1 or {indices for _, indices in names} != set(rows):
        return None
    rank = {rows[old]: new for new, old in enumerate(sorted(range(len(rows)), key=places.__getitem__))}
    slots = sorted(one.line for one in found)
    moved = sorted(found, key=lambda one: (rank[one.indices], one.line))
    changed: dict[int, str | None] = {}
    for slot, one in zip(slots, moved, strict=True):
        name = one.key.replace("[]", f"[{rank[one.indices]}]")
        changed[slot] = _renamed(lines[one.line - 1], name)
    return Fix("Sort the rows of the table", changed)


def _paths(document: Document, lines: Sequence[str], finding: Finding) -> Fix | None:
    """Name a file as it is called."""
    del lines
    entry = next((one for one in document.entries if one.line == finding.line and one.parameter), None)
    if entry is None or entry.parameter is None or document.outer is not None:
        return None
    folder = document.path.parent
    named = Files(Findings()).named(folder, document.values.text(entry.parameter.name, *entry.indices), ("", 0, ""))
    if named is None or not named.is_relative_to(folder):
        return None
    copy = document.copy()
    copy.set(entry.parameter.name, named.relative_to(folder).as_posix(), *entry.indices)
    return Fix("Name the file as it is called", {finding.line: copy.text.split("\n")[finding.line - 1]})


_FIXES: dict[str, Callable[[Document, Sequence[str], Finding], Fix | None]] = {
    "AXC-TYPO": _spelling,
    "AXC-UNKNOWN": _spelling,
    "AXC-TWICE": _duplicates,
    "AXC-SIZE": _sizes,
    "AXC-UNUSED": _sizes,
    "AXC-ORDER": _order,
    "70245": _order,
    "110591": _order,
    "AXC-PATH": _paths,
}

FIXABLE = tuple(_FIXES)
"""Codes of findings that can be mended by themselves, at least sometimes."""
