"""The page ``docs/lists.md``, made from the catalogue: ``python -m axcomp.lists`` writes it again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ..kinds import DataType, ListKind, Manual, Parameter
from ..model import models
from .catalogue import CATALOGUE
from .findings import CODES

HEADINGS = ("Parameter", "Id", "Type", "Range", "Unit", "Default", "Meaning")
"""What ``cells`` returns."""

PAGE = models().parent / "docs" / "lists.md"
"""Where the page is in a checkout."""

_MANUAL_MARKS = {
    Manual.ISG: "ISG",
    Manual.TWINCAT: "TwinCAT",
    Manual.LEADSCREW: "SSFK",
    Manual.VOLUMETRIC: "volumetric",
    Manual.AXIS: "axis",
    Manual.START_UP: "start-up",
}

_TITLES = {
    ListKind.START_UP: "Start-up list",
    ListKind.AXIS: "Axis list",
    ListKind.COMPENSATION: "Compensation value list",
    ListKind.VOLUMETRIC: "Volumetric list",
}


def cells(parameter: Parameter) -> tuple[str, ...]:
    """Return what the catalogue says about a parameter, one text for each of ``HEADINGS``."""
    return (
        parameter.name,
        _ids(parameter),
        parameter.type.name,
        _range(parameter),
        parameter.unit,
        str(parameter.default),
        parameter.meaning,
    )


def as_dict(kind: ListKind, parameter: Parameter) -> dict[str, Any]:
    """Return all that the catalogue says about a parameter, for programs."""
    return {
        "list": kind.value,
        "name": parameter.name,
        "ids": {manual.value: identifier for manual, identifier in parameter.ids.items()},
        "type": parameter.type.name,
        "range": _range(parameter),
        "usable": parameter.usable,
        "unit": parameter.unit,
        "default": parameter.default,
        "names": dict(parameter.names),
        "index_max": list(parameter.index_max),
        "aliases": list(parameter.aliases),
        "typos": list(parameter.typos),
        "meaning": parameter.meaning,
    }


def _ids(parameter: Parameter) -> str:
    """Return the id; where manuals differ, which one is whose."""
    identifiers = {identifier for identifier in parameter.ids.values() if identifier}
    if len(identifiers) == 1:
        return identifiers.pop()
    return ", ".join(f"{i} ({_MANUAL_MARKS[manual]})" for manual, i in parameter.ids.items() if i)


def _range(parameter: Parameter) -> str:
    if parameter.values:
        return ", ".join(map(str, parameter.values))
    if parameter.type is DataType.STRING:
        return f"{parameter.length} characters" if parameter.length else ""
    if parameter.type is DataType.BOOLEAN:
        return "0, 1"
    return parameter.range


def page() -> str:
    """Return the text of the page."""
    return "\n".join((*_lines(), ""))


def _lines() -> Iterator[str]:
    yield "# List parameters"
    yield ""
    yield "Made by `python -m axcomp.lists`; the catalogue in `axcomp/lists` is the source."
    yield ""
    yield "Names are case-insensitive. MIN and MAX are those of the data type; a round bracket excludes the bound."
    yield "Values that are no counts may have decimals, whatever their type. Where both manuals of the compensation"
    yield "lists know a parameter under different ids, both are given."
    for kind, parameters in CATALOGUE.items():
        yield from ("", f"## {_TITLES[kind]} (`{kind.value}`)", "")
        yield from _table(HEADINGS, [_marked(cells(parameter)) for parameter in parameters])
        yield from _notes(parameters)
    yield from ("", "## Findings", "")
    yield "Numbers are the vendor's, codes `AXC-…` this program's own."
    yield ""
    rows = [(code, severity.value, f"{meaning}.") for code, (severity, meaning) in CODES.items()]
    yield from _table(("Code", "Severity", "Meaning"), rows)


def _marked(row: tuple[str, ...]) -> tuple[str, ...]:
    return (f"`{row[0]}`", *row[1:])


def _table(headings: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(headings)} |"
    yield f"|{' --- |' * len(headings)}"
    for row in rows:
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"


def _notes(parameters: tuple[Parameter, ...]) -> Iterator[str]:
    notes = []
    for parameter in parameters:
        if parameter.aliases:
            notes.append(f"* `{parameter.name}` may also be written {_listed(parameter.aliases)}.")
        if parameter.typos:
            notes.append(f"* `{parameter.name}` is also taken as {_listed(parameter.typos)}, with a warning.")
        if parameter.usable:
            notes.append(f"* `{parameter.name}`: values in {parameter.usable} are used too, with a warning.")
        if parameter.names:
            named = ", ".join(f"`{name}` = {value}" for name, value in parameter.names.items())
            notes.append(f"* `{parameter.name}` may be a name: {named}.")
    if notes:
        yield ""
        yield from notes


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)
