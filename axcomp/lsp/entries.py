"""What there is to know about the entries of a list: hover, completion, symbols, hints in mm, colours."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from decimal import Decimal
from pathlib import Path

from lsprotocol import types

from ..kinds import DataType, ListKind, Parameter, Quantity, convert, key_of
from ..lists import CATALOGUE, HEADINGS, Document, DocumentEntry, Reading, cells, continued, number
from ..model import AxisType
from .text import characters, span

FILE_NAMES = ("achs_kw[i]", "achs_mds[i]", "default_achs_mds", "vol_comp[i].file_name", "file[j]")
"""Entries that name files."""

TOKENS = ("property", "number", "string", "comment", "keyword", "enumMember")
"""Types of semantic tokens, by their number."""

NAME = re.compile(r"\s*([^\W0-9][\w.]*(?:\[[0-9\s]*\][\w.]*)*)")
"""The name of an entry, in its line."""
_TYPED = re.compile(r"\s*([\w.\[\] ]*)\Z")


def entry_at(document: Document, line: int) -> DocumentEntry | None:
    """Return the entry in a line, which is counted from 0."""
    return next((one for one in document.entries if one.line == line + 1), None) if document.kind else None


def hover(document: Document, lines: Sequence[str], at: types.Position, reading: Reading) -> types.Hover | None:
    """Return what the catalogue says about the entry under the cursor."""
    entry = entry_at(document, at.line)
    if entry is None or entry.parameter is None:
        return None
    rows = dict(zip(HEADINGS, cells(entry.parameter), strict=True))
    told = [f"**{entry.parameter.name}** — {entry.parameter.meaning}", ""]
    told += [f"* {name}: {rows[name]}" for name in ("Id", "Type", "Unit", "Range", "Default") if rows[name]]
    manuals = [f"{manual.value} ({identifier})" for manual, identifier in entry.parameter.ids.items() if identifier]
    told += [f"* Manual: {', '.join(manuals)}"] if manuals else []
    meant = shown(entry, document, reading)
    told += [f"* Here: {meant}"] if meant else []
    begin = entry.column - 1
    text = types.MarkupContent(types.MarkupKind.Markdown, "\n".join(told))
    return types.Hover(text, span(lines, at.line, begin, entry.value_column - 1 + len(entry.value)))


def shown(entry: DocumentEntry, document: Document, reading: Reading) -> str:
    """Return the value of an entry in mm, °, mm/s or as a factor; "" where the list says it so already."""
    parameter = entry.parameter
    value = number(entry.value)
    if parameter is None or parameter.quantity.divisor == 1 or value is None:
        return ""
    axis = _axis_of(document, entry, reading)
    gear = None
    if parameter.quantity is Quantity.POSITION:
        unit = next((name for name in _units(document.kind) if name.startswith(_prefix(parameter.name))), "")
        if unit and not document.values.flag(unit):
            settings = next((one for one in reading.axes.all() if one.number == axis), None)
            gear = None if settings is None else settings.gear
    converted = convert(value, parameter.quantity.divisor, *([gear] if gear is not None else []))
    rotary = any(one.number == axis and one.type is not AxisType.TRANSLATORY for one in reading.machine.axes)
    unit = {
        Quantity.POSITION: "°" if rotary else "mm",
        Quantity.VELOCITY: "°/s" if rotary else "mm/s",
        Quantity.PER_MILLE: "",
        Quantity.GRADIENT: "°/°" if rotary else "mm/mm",
    }.get(parameter.quantity, "")
    return f"{Decimal(repr(converted)).normalize():f} {unit}".strip()


def _units(kind: ListKind | None) -> list[str]:
    return [] if kind is None else [one.name for one in CATALOGUE[kind] if one.name.endswith(".unit")]


def _prefix(name: str) -> str:
    return ".".join(name.split(".")[:2]) + "."


def _axis_of(document: Document, entry: DocumentEntry, reading: Reading) -> int:
    """Return the number of the axis whose position or correction an entry holds."""
    if document.kind not in (ListKind.AXIS, ListKind.COMPENSATION) or entry.parameter is None:
        return 0
    values, name = document.values, entry.parameter.name
    masters = {
        "kw.crosscomp.table[i].setpoint": "kw.crosscomp.master_ax_nr",
        "kw.crosscomp2.start_position_master1": "kw.crosscomp2.master1_ax_nr",
        "kw.crosscomp2.start_position_master2": "kw.crosscomp2.master2_ax_nr",
        "kw.crosstalk.position[i].ax_1": "kw.crosstalk.master_pos1_ax_nr",
        "kw.crosstalk.position[i].ax_2": "kw.crosstalk.master_pos2_ax_nr",
    }
    if name in masters:
        return values.integer(masters[name])
    own = (axis.number for axis in reading.machine.axes if reading.compensation_list(axis.number) is document)
    return values.integer("kopf.achs_nr") or next(own, 0)


def inlay_hints(
    document: Document, lines: Sequence[str], wanted: types.Range, reading: Reading
) -> list[types.InlayHint]:
    """Return mm and ° behind values that stand in 0.1 µm and 0.0001°."""
    found = []
    for entry in document.entries if document.kind else ():
        if wanted.start.line <= entry.line - 1 <= wanted.end.line and (label := shown(entry, document, reading)):
            end = entry.value_column - 1 + len(entry.value)
            at = span(lines, entry.line - 1, end, end).start
            found.append(types.InlayHint(at, f"= {label}", padding_left=True))
    return found


def completion(
    document: Document, lines: Sequence[str], at: types.Position, folder: Path
) -> list[types.CompletionItem]:
    """Return names where a name is typed, values and files where a value is."""
    line = lines[at.line] if at.line < len(lines) else ""
    column = characters(line, at.character)
    before = line[:column]
    name = NAME.match(before)
    if document.kind is None:
        return []
    if name is not None and name.end() < len(before):
        return _values(document, lines, at.line, name, column, folder)
    typed = _TYPED.match(before)
    if typed is None:
        return []
    end = column + len(re.match(r"[\w.\[\]]*", line[column:])[0])  # type: ignore[index]
    where = span(lines, at.line, typed.start(1), end)
    return list(_names(document, where))


def _names(document: Document, where: types.Range) -> Iterator[types.CompletionItem]:
    assert document.kind is not None
    following = _next_indices(document)
    for parameter in CATALOGUE[document.kind]:
        name = parameter.named(*following.get(parameter.key, (0,) * parameter.name.count("[")))
        rows = cells(parameter)
        yield types.CompletionItem(
            label=parameter.name,
            kind=types.CompletionItemKind.Property,
            detail=parameter.meaning,
            documentation=", ".join(row for row in rows[1:-1] if row),
            filter_text=name,
            text_edit=types.TextEdit(where, f"{name} "),
        )


def _next_indices(document: Document) -> dict[str, tuple[int, ...]]:
    """Return for every column of a table the indices behind its last row."""
    found: dict[str, tuple[int, ...]] = {}
    for entry in document.entries:
        if entry.parameter is not None and entry.indices:
            after = (*entry.indices[:-1], entry.indices[-1] + 1)
            found[entry.parameter.key] = max(found.get(entry.parameter.key, after), after)
    return found


def _values(
    document: Document, lines: Sequence[str], line: int, name: re.Match[str], column: int, folder: Path
) -> list[types.CompletionItem]:
    assert document.kind is not None
    parameter = next((one for one in CATALOGUE[document.kind] if key_of(name[1]) in _keys(one)), None)
    if parameter is None:
        return []
    text = lines[line]
    start = len(text) - len(text[name.end() :].lstrip()) if text[name.end() :].strip() else column
    start = min(start, column)
    where = span(lines, line, start, max(column, start + len(re.match(r"\S*", text[start:])[0])))  # type: ignore[index]
    words: list[tuple[str, str]] = [(str(value), "") for value in parameter.values]
    words += [(word, str(value)) for word, value in parameter.names.items()]
    if parameter.type is DataType.BOOLEAN:
        words += [("0", "off"), ("1", "on")]
    if parameter.name in FILE_NAMES:
        words += [(one, "") for one in _files(folder)]
    kind = types.CompletionItemKind.File if parameter.name in FILE_NAMES else types.CompletionItemKind.Value
    return [
        types.CompletionItem(label=word, kind=kind, detail=detail or None, text_edit=types.TextEdit(where, word))
        for word, detail in words
    ]


def _keys(parameter: Parameter) -> set[str]:
    return {key_of(name) for name in (parameter.name, *parameter.aliases, *parameter.typos)}


def _files(folder: Path) -> list[str]:
    try:
        names = sorted(one.name for one in folder.iterdir() if one.suffix.lower() in (".lis", ".csv", ".exc", ".txt"))
    except OSError:
        names = []
    return [f'"{name}"' if " " in name else name for name in names]


def symbols(document: Document, lines: Sequence[str]) -> list[types.DocumentSymbol]:
    """Return the structures of a list with their entries; a table is one."""
    groups: dict[str, list[DocumentEntry]] = {}
    for entry in document.entries if document.kind else ():
        name = re.split(r"\[", entry.key)[0]
        groups.setdefault(name.rpartition(".")[0] or name, []).append(entry)
    return [_symbol(name, found, lines) for name, found in groups.items()]


def _symbol(name: str, found: Sequence[DocumentEntry], lines: Sequence[str]) -> types.DocumentSymbol:
    children = []
    tables: dict[str, list[DocumentEntry]] = {}
    for entry in found:
        if entry.indices:
            tables.setdefault(entry.key.partition("[")[0], []).append(entry)
        else:
            where = _range(entry, lines)
            children.append(
                types.DocumentSymbol(entry.name, types.SymbolKind.Property, where, where, detail=entry.value)
            )
    for table, rows in tables.items():
        whole = types.Range(_range(rows[0], lines).start, _range(rows[-1], lines).end)
        detail = f"{len({one.indices for one in rows})} rows"
        children.append(
            types.DocumentSymbol(table, types.SymbolKind.Array, whole, _range(rows[0], lines), detail=detail)
        )
    whole = types.Range(_range(found[0], lines).start, _range(found[-1], lines).end)
    return types.DocumentSymbol(
        name, types.SymbolKind.Struct, whole, _range(found[0], lines), children=children, detail=f"{len(found)} entries"
    )


def _range(entry: DocumentEntry, lines: Sequence[str]) -> types.Range:
    return span(lines, entry.line - 1, entry.column - 1, entry.value_column - 1 + len(entry.value))


def semantic_tokens(document: Document, lines: Sequence[str]) -> list[int]:
    """Return the colours of a list, each token as five numbers, relative to the one before it."""
    tokens: list[tuple[int, int, int, str]] = []
    found = {entry.line - 1: entry for entry in document.entries} if document.kind else {}
    inside = continued(lines)
    for at, line in enumerate(lines):
        begin, end = len(line) - len(line.lstrip()), len(line.rstrip())
        entry = found.get(at)
        if entry is not None and at not in inside:
            tokens += _of_entry(entry, line, at, end)
        elif begin < end:
            ending = line.strip().lower() in ("end", "ende")
            comment = at in inside or line.lstrip().startswith(("#", "/*"))
            if ending or comment:
                tokens.append((at, begin, end, "keyword" if ending and at not in inside else "comment"))
    data: list[int] = []
    last_line, last_start = 0, 0
    for at, begin, end, kind in sorted(tokens):
        where = span(lines, at, begin, end)
        start = where.start.character
        data += [at - last_line, start - (last_start if at == last_line else 0), where.end.character - start]
        data += [TOKENS.index(kind), 0]
        last_line, last_start = at, start
    return data


def _of_entry(entry: DocumentEntry, line: str, at: int, end: int) -> Iterator[tuple[int, int, int, str]]:
    name = NAME.match(line)
    if name is not None:
        yield at, name.start(1), name.end(1), "property"
    start, stop = entry.value_column - 1, entry.value_column - 1 + len(entry.value)
    if entry.value:
        kind = "number" if number(entry.value) is not None else "string"
        named = entry.parameter is not None and entry.value.upper() in (*entry.parameter.names, *entry.parameter.values)
        yield at, start, stop, "enumMember" if kind == "string" and named else kind
    comment = len(line) - len(line[stop:].lstrip())
    if comment < end:
        yield at, comment, end, "comment"
