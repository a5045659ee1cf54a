"""What lies in an FMU for people and tools that show it: documentation, licence, icon, and a terminal for each axis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from html import escape
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from ..interface import Variable
from ..kinds import kind_of
from ..lists import Finding
from ..model import Curve, Grid, Machine, Scatter, Volumetric, fmu_sources, licence
from .archive import file_bytes
from .description import Description, document

ROWS_MAX = 2000
"""Rows that are shown of a table."""

LICENSE = """\
The tables of this FMU come from the lists of the machine and belong to whom those belong. Libraries, sources and model
description are under the licence below; what others have written, and its licences, lies beside this file.

"""

STYLE = "body{font:14px sans-serif;margin:2em}td,th{padding:1px 8px;text-align:left}table{border-collapse:collapse}"
HEADS = ("Name", "Causality", "Type", "Unit", "Start", "Reference", "Meaning")

Row = Sequence[object]


def accompanying(
    description: Description,
    variables: Sequence[Variable],
    machine: Machine | None = None,
    findings: Iterable[Finding] = (),
) -> dict[str, bytes]:
    """Return the files by path; ``machine``: whose tables are shown, None: no table is."""
    icon = file_bytes(fmu_sources() / "model.png")
    return {
        "documentation/index.html": _page(description, variables, machine, findings).encode(),
        "documentation/licenses/license.txt": LICENSE.encode() + file_bytes(licence()),
        "model.png": icon,
        "terminalsAndIcons/icon.png": icon,
        "terminalsAndIcons/terminalsAndIcons.xml": terminals(variables),
    }


def terminals(variables: Sequence[Variable]) -> bytes:
    """Return terminalsAndIcons.xml, which FMI 2.0.4 takes from FMI 3.0: a terminal for each axis, a port a variable."""
    root = Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    graphics = SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
    SubElement(graphics, "Icon", corners)
    every = SubElement(root, "Terminals")
    for axis in dict.fromkeys(variable.axis for variable in variables if variable.axis is not None):
        own = [variable for variable in variables if variable.axis == axis]
        name = own[0].name.removesuffix(own[0].quantity).rstrip("._") if own[0].quantity else own[0].name.split(".")[0]
        terminal = SubElement(every, "Terminal", name=name, matchingRule="bus", description=f"Axis {name}")
        for variable in own:
            member = variable.quantity or variable.name.partition(".")[2]
            SubElement(
                terminal, "TerminalMemberVariable", variableName=variable.name, memberName=member, variableKind="signal"
            )
    if not len(every):
        root.remove(every)
    return document(root)


def _page(
    description: Description, variables: Sequence[Variable], machine: Machine | None, findings: Iterable[Finding]
) -> str:
    parts = [f"<p>{escape(description.text)}. Made by axcomp {escape(description.version)}.</p>"]
    if machine is not None:
        # Not the folder: an FMU is the same wherever it is built.
        told = [(str(replace(finding, file=Path(finding.file).name)),) for finding in findings]
        parts += ["<h2>Findings</h2>", _table(("Of the lists",), told) if told else "<p>None.</p>"]
        parts += ["<h2>Tables</h2>", *_tables(machine)]
    rows = [(v.name, v.causality, v.type, v.unit, v.start, v.reference, v.description) for v in variables]
    parts += ["<h2>Variables</h2>", _table(HEADS, rows)]
    body = "\n".join(parts)
    title = escape(description.name)
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n<h1>{title}</h1>\n{body}\n</body></html>\n'


def _tables(machine: Machine) -> Iterator[str]:
    for axis in machine.axes:
        for one in axis.compensations:
            kind = kind_of(one)
            yield f"<h3>{escape(axis.name)}: {escape(kind.title)}</h3>"
            for table in kind.tables(one, machine, axis):
                text = "; ".join(filter(None, (table.label, str(table.of), table.note)))
                yield f"<p>{escape(text)}</p>{_table(*_rows(table))}"
    for volumetric in machine.volumetric:
        yield f"<h3>volumetric[{volumetric.index}]</h3>"
        yield from _errors(volumetric)


def _rows(table: Curve | Grid | Scatter) -> tuple[Row, list[Row]]:
    if isinstance(table, Curve):
        return (table.over, table.of), list(zip(table.x, table.y, strict=True))
    if isinstance(table, Grid):
        rows: list[Row] = [(y, *row) for y, row in zip(table.y, table.values, strict=True)]
        return (f"{table.over[1]} \\ {table.over[0]}", *table.x), rows
    return (*table.over, table.of), [(*p, v) for p, v in zip(table.places, table.values, strict=True)]


def _errors(volumetric: Volumetric) -> Iterator[str]:
    for error in volumetric.errors:
        nodes = error.nodes or ((),)
        rows = [(*node, value) for node, value in zip(nodes, error.values, strict=True)]
        yield _table((*error.arguments, error.name), rows)


def _table(heads: Row, rows: Sequence[Row]) -> str:
    lines = ["".join(f"<td>{escape(str(cell))}</td>" for cell in row) for row in rows[:ROWS_MAX]]
    more = f"<p>… {len(rows) - ROWS_MAX} more</p>" if len(rows) > ROWS_MAX else ""
    head = "".join(f"<th>{escape(str(cell))}</th>" for cell in heads)
    return "<table><tr>" + "</tr>\n<tr>".join([head, *lines]) + f"</tr></table>{more}"
