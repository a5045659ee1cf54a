"""What the page shows of lists: findings as the command line tells them, tables, axes, and an image for the kernel.

This runs in the browser: standard library only.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from .. import __version__
from ..interface import Slot, Variable, slot_of, variables_of, with_causality
from ..kinds import KINDS, CompileError, tables_of
from ..lint import Checked, Style, as_text, check_machine, find_machines, find_settings, pages, written
from ..model import (
    LETTERS,
    ROTARY,
    Axis,
    Curve,
    ErrorTable,
    Grid,
    Machine,
    Quantity,
    Scatter,
    Volumetric,
    is_angle,
    symbol,
)
from ..native import image_of
from ..runtime import Runtime, compile_tables
from .course import columns_of, digest, drawn


def look(path: str) -> list[Checked]:
    """Return the machines below a path, each of them checked as ``axcomp check`` does."""
    start = Path(path)
    settings = find_settings(start)
    found = find_machines([start], settings)
    return [check_machine(one, settings, reading=reading) for one, reading in found]


def shown(checked: Sequence[Checked], path: str) -> str:
    """Return as JSON what there is to show of the machines below a path.

    ``check``: what ``axcomp check --format json`` writes; ``text``: what it prints; ``codes``: what the codes in it
    mean; ``machines``: axes, tables and kernel of each.
    """
    codes = sorted({finding.code for one in checked for finding in one.findings})
    told = {
        "check": json.loads(written("json", checked, find_settings(Path(path)), __version__)),
        "text": as_text(checked, Style()),
        "codes": {code: {name: getattr(pages()[code], name) for name in ("meaning", "why", "mend")} for code in codes},
        "machines": [_machine(one) for one in checked],
    }
    return json.dumps(told)


def cyclic(machine: Machine, runtime: Runtime) -> list[tuple[Variable, Slot]]:
    """Return the variables that a cycle knows, and where they are."""
    records = (runtime.inputs, runtime.outputs)
    found = ((v, slot_of(v, v.axis, *records, volumetric=v.volumetric)) for v in variables_of(machine))
    return [(variable, slot) for variable, slot in found if slot is not None]


def digest_of(machine: Machine, cycles: int) -> int:
    """Run the kernel in Python over inputs by chance; return the digest of its outputs."""
    runtime = Runtime(machine)
    variables = cyclic(machine, runtime)
    slots = {variable.reference: slot for variable, slot in variables}
    types = {variable.reference: type(variable.start) for variable, _ in variables}
    columns = columns_of(variable for variable, _ in variables)
    outputs = [slots[one.reference] for one in with_causality((variable for variable, _ in variables), "output")]
    crc = 0
    for row in range(cycles):
        for number, column in enumerate(columns):
            slots[column.reference].set(types[column.reference](drawn(column, number, row)))
        runtime.cycle()
        crc = digest(struct.pack(f"<{len(outputs)}d", *(slot.get() for slot in outputs)), crc)
    return crc


def kernel_of(machine: Machine) -> dict[str, Any]:
    """Return for JSON what the kernel needs: an image, and the variables that a cycle knows.

    Raises
    ------
    CompileError
        If the machine cannot be run.
    """
    compiled = compile_tables(machine)
    variables = [variable for variable, _ in cyclic(machine, Runtime(machine))]
    return {
        "image": base64.b64encode(image_of(compiled, "")).decode(),
        "cycleTime": compiled.tables.cycle_time,
        "course": [column._asdict() for column in columns_of(variables)],
        "variables": [
            {"name": v.name, "reference": v.reference, "causality": v.causality, "unit": symbol(v.unit),
             "axis": v.axis, "quantity": v.quantity, "volumetric": v.volumetric, "description": v.description}
            for v in variables
        ],
    }  # fmt: skip


def _machine(checked: Checked) -> dict[str, Any]:
    machine = checked.machine
    try:
        kernel, complaint = kernel_of(machine) if machine.axes else None, ""
    except CompileError as error:
        kernel, complaint = None, str(error)
    return {
        "name": checked.reading.name,
        "path": str(checked.path),
        "axes": [_axis(machine, axis) for axis in machine.axes],
        "tables": [
            *_of_axes(machine),
            *(table for one in machine.volumetric for table in _of_volumetric(machine, one)),
        ],
        "judged": [str(one) for one in checked.judgement.findings],
        "limits": [one.to_dict() for one in checked.judgement.limits],
        "kernel": kernel,
        "complaint": complaint,
    }


def _axis(machine: Machine, axis: Axis) -> dict[str, Any]:
    volumetric = [one.index for one in machine.volumetric if axis.number in machine.corrected_by(one)]
    return {
        "name": axis.name,
        "number": axis.number,
        "type": axis.type.name.lower(),
        "unit": symbol(axis.unit),
        "modulo": None if axis.modulo is None else [axis.modulo.start, axis.modulo.end],
        "kinds": [*(one.kind for one in axis.compensations), *(f"volumetric {index}" for index in volumetric)],
    }


def _of_axes(machine: Machine) -> Iterator[dict[str, Any]]:
    for tables in tables_of(machine):
        yield {
            "title": f"{tables.axis.name}: {KINDS[tables.kind].title.lower()}",
            "kind": tables.kind,
            "axis": tables.axis.name,
            "parts": [_part(table) for table in tables.tables],
        }


def _part(table: Curve | Grid | Scatter) -> dict[str, Any]:
    if isinstance(table, Curve):
        curve = table.shown()
        return {
            "shape": "curve",
            "label": curve.label,
            "note": curve.note,
            "over": _quantity(curve.over),
            "of": _quantity(curve.of),
            "x": curve.closed().x,
            "y": curve.closed().y,
            "period": curve.period,
        }
    first, second = map(_quantity, table.over)
    factor = table.of.factor
    part = {"label": table.label, "note": table.note, "over": [first, second], "of": _quantity(table.of.scaled())}
    if isinstance(table, Grid):
        values = [[factor * value for value in row] for row in table.values]
        return {"shape": "grid", "x": table.x, "y": table.y, "values": values, **part}
    return {"shape": "scatter", "places": table.places, "values": [factor * v for v in table.values], **part}


def _quantity(quantity: Quantity) -> dict[str, str]:
    return {"name": quantity.name, "unit": quantity.unit, "axis": quantity.axis}


def _of_volumetric(machine: Machine, one: Volumetric) -> Iterator[dict[str, Any]]:
    """Yield the errors over one axis, by axis and unit; of those over several axes, and constant ones, the ranges."""
    names = {letter: machine.numbered(number).name for letter, number in one.axes}
    title = f"Volumetric {one.index}"
    for letter in LETTERS:
        for angular in (False, True):
            tables = [t for t in one.errors if t.arguments == letter and is_angle(t.name) is angular and any(t.values)]
            if tables:
                what = "angular" if angular else "linear"
                parts = [_part(_error_curve(table, names[letter])) for table in tables]
                name = f"{title}: {what} errors over {names[letter]}"
                yield {"title": name, "kind": "volumetric", "axis": names[letter], "parts": parts}
    rest = [table for table in one.errors if len(table.arguments) != 1]
    if rest:
        of = [_error_quantity(table) for table in rest]
        rows = [
            [table.name, ", ".join(names[letter] for letter in table.arguments) or "–", len(table.values),
             quantity.factor * min(table.values), quantity.factor * max(table.values), quantity.scaled().unit]
            for table, quantity in zip(rest, of, strict=True)
        ]  # fmt: skip
        columns = ["error", "over", "values", "least", "greatest", "unit"]
        ranges = {"shape": "rows", "columns": columns, "rows": rows, "label": "", "note": ""}
        yield {"title": f"{title}: other errors", "kind": "volumetric", "axis": "", "parts": [ranges]}


def _error_curve(table: ErrorTable, name: str) -> Curve:
    over = Quantity("position", "°" if table.arguments in ROTARY else "mm", name)
    nodes = sorted(zip((x for (x,) in table.nodes), table.values, strict=True))
    x, y = zip(*nodes, strict=True)
    return Curve(x, y, over, _error_quantity(table), label=table.name)


def _error_quantity(table: ErrorTable) -> Quantity:
    return Quantity("error", "rad" if is_angle(table.name) else "mm")
