"""A list as text with some of its entries replaced: everything else, comments, order and encoding, stays as it stands.

Entries that are there already get their new value in their place; those that the new table does not need go, those it
has more come where they belong, and what was not there at all is put before ``End``. The comment behind a value stays,
unless it belongs to a row of a table whose rows now stand for something else.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Collection, Mapping, Sequence

from ..kinds.parameter import DataType, ListKind, Parameter, key_of
from .catalogue import SPELLINGS, Spelling
from .grammar import Entry, decode, entries, string

_NEWLINES = re.compile(r"(\r\n|\r|\n)")
_END = re.compile(r"\s*end\s*\Z", re.I)

Name = tuple[str, tuple[int, ...]]


def edited(
    data: bytes,
    new: Sequence[str],
    owned: Collection[str],
    heading: str,
    keep_row_comments: bool,
    kind: ListKind = ListKind.COMPENSATION,
) -> bytes:
    """Return a list with new entries.

    Parameters
    ----------
    data : bytes
        The list; empty for a new one.
    new : sequence of str
        Lines ``name value``, in the order they have in a new list.
    owned : collection of str
        The parameters the new entries are about. Where they have none for one of these, the list must not either.
    heading : str
        Comment above them where the list has none of them; ASCII.
    keep_row_comments : bool
        Rows of tables still stand for the same, so what is said about them stays true.
    kind : ListKind
        Of the list.

    Raises
    ------
    ValueError
        The list is no text.
    """
    text = decode(data)
    if text is None:
        raise ValueError("the list is no text")
    pieces = _NEWLINES.split(_decoded(data))
    lines, newlines = pieces[::2], pieces[1::2]
    newline = newlines[0] if newlines else "\n"
    known = SPELLINGS[kind]
    wanted = {name: entry for name, _, entry in _known("\n".join(new), known)}
    present = _known(text, known)
    keys = {key_of(name) for name in owned}

    places: dict[Name, int] = {}
    gone: set[int] = set()
    first = first_row = None
    for name, parameter, entry in present:
        if parameter.key not in keys:
            continue
        first = entry.line - 1 if first is None else first
        at = entry.line - 1
        if entry.indices and first_row is None:
            first_row = at
        replacement = wanted.get(name)
        if replacement is not None:
            places[name] = at
            comment_stays = keep_row_comments or not entry.indices
            lines[at] = _with_value(lines[at], entry, parameter, _text_of(replacement, parameter), comment_stays)
        else:
            gone.add(at)

    # A last line that is empty is none: there is nothing behind the last newline.
    count = len(lines) - (not lines[-1])
    end = next((i for i, line in enumerate(lines) if _END.match(line)), count)
    added = _added(wanted, places, end if first is None else first, first_row)
    if first is None:
        blank = [""] if end > 0 and lines[end - 1].strip() else []
        added.setdefault(end, [])[:0] = [*blank, f"# {heading}"]
    return _encoded(_joined(lines, newlines, gone, added, newline), data)


def _known(text: str, known: Mapping[str, Spelling]) -> list[tuple[Name, Parameter, Entry]]:
    """Return the entries of a list that the catalogue knows, with their names and parameters."""
    found = []
    for entry in entries(text, lambda *_: None):
        spelling = known.get(entry.key.lower())
        if spelling is not None:
            found.append(((spelling.parameter.key, entry.indices), spelling.parameter, entry))
    return found


def _text_of(entry: Entry, parameter: Parameter) -> str:
    return entry.text.rstrip() if parameter.type is DataType.STRING else entry.word


def _with_value(line: str, entry: Entry, parameter: Parameter, value: str, comment_stays: bool) -> str:
    """Return a line with another value; a comment that stays keeps its column where it can."""
    start = len(line) - len(line[_after_name(line, entry) :].lstrip())
    old = line[start:]
    if parameter.type is DataType.STRING:
        comment = string(entry.text).comment
        length = len(old) - len(comment) if comment else len(old)
    else:
        length = len(entry.word)
    rest = old[length:]
    before = line[:start] if line[:start][-1:].isspace() else line[:start] + " "
    if not comment_stays or not rest.strip():
        return before + value
    return before + value.ljust(len(old[:length].rstrip())) + (rest if rest[:1].isspace() else " " + rest)


def _after_name(line: str, entry: Entry) -> int:
    """Return where the value's blanks begin: behind the name and its last index."""
    name = re.match(r"\s*[^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*", line)
    assert name is not None, f"line {entry.line} has no name"
    return name.end()


def _added(
    wanted: dict[Name, Entry], places: dict[Name, int], start: int, first_row: int | None
) -> dict[int, list[str]]:
    """Return the lines to put before line ``key``: each behind the one it follows in a new list."""
    added: dict[int, list[str]] = {}
    cursor = start
    in_table = False
    for name, entry in wanted.items():
        if entry.indices and not in_table:
            in_table = True
            cursor = cursor if first_row is None else first_row
        if name in places:
            cursor = places[name] + 1
        else:
            added.setdefault(cursor, []).append(f"{entry.name:<40} {entry.text.rstrip()}")
    return added


def _joined(
    lines: Sequence[str], newlines: Sequence[str], gone: set[int], added: dict[int, list[str]], newline: str
) -> str:
    out: list[str] = []
    for i, line in enumerate(lines):
        out.extend(text + newline for text in added.get(i, ()))
        if i not in gone:
            out.append(line + (newlines[i] if i < len(newlines) else ""))
    behind = added.get(len(lines), ())
    if behind and out and out[-1] and not out[-1].endswith(("\n", "\r")):
        out[-1] += newline
    out.extend(text + newline for text in behind)
    return "".join(out)


def _decoded(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _encoded(text: str, like: bytes) -> bytes:
    try:
        like.decode("utf-8")
    except UnicodeDecodeError:
        return text.encode("latin-1")
    return (codecs.BOM_UTF8 if like.startswith(codecs.BOM_UTF8) else b"") + text.encode("utf-8")
