"""Measurements as text tables: named columns with units, and errors that say in which line they are.

Cells are separated by semicolons, tabs, commas or blanks; ``#`` and ``//`` begin a comment. The first row, if there is
no number in it, names the columns, in any order, each with its unit if that is not the usual one: ``deviation [mm]``,
``deviation (mm)`` or ``deviation_mm``. Without such a row the columns are those asked for, in that order. Where commas
do not separate cells, they may stand for the decimal point. Comments of the form ``# axis: X`` are kept as details.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..lists import decode
from ..model import shown

LENGTHS = {"m": 1e6, "mm": 1e3, "um": 1.0, "nm": 1e-3}
"""Units of length, in µm."""

_PER_RAD = 648e3 / math.pi
ANGLES = {
    "deg": 3600.0,
    "mdeg": 3.6,
    "arcmin": 60.0,
    "arcsec": 1.0,
    "rad": _PER_RAD,
    "mrad": _PER_RAD * 1e-3,
    "urad": _PER_RAD * 1e-6,
}
"""Units of angle, in ″."""

LARGEST = 1e9
"""Numbers beyond it, whatever the unit, are no measurement."""

_SPELLINGS = {"°": "deg", '"': "arcsec", "''": "arcsec", "″": "arcsec", "'": "arcmin", "′": "arcmin", "0.001°": "mdeg"}
_HEADER = re.compile(r"\s*([^\W\d]\w*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*\Z")
_DETAIL = re.compile(r"\s*(?:#|//)\s*([^\W\d][\w ]*?)\s*[:=]\s*(.*?)\s*\Z")
_COMMENT = re.compile(r"#|//")
_DIRECTIONS = {
    **dict.fromkeys(("1", "+1", "+", "pos", "positive", "up", "fwd", "forward", "↑"), 1.0),
    **dict.fromkeys(("-1", "−1", "-", "−", "neg", "negative", "down", "bwd", "backward", "reverse", "↓"), -1.0),
}


class MeasurementError(Exception):
    """A measurement that cannot be used: one sentence that begins with ``file:line:``, or ``file:`` for all of it."""

    def __init__(self, file: str, line: int, sentence: str) -> None:
        self.file, self.line = file, line
        super().__init__(f"{file}:{line}: {sentence}" if line else f"{file}: {sentence}")


@dataclass(frozen=True)
class Column:
    """A column that is looked for, by its name in the first row, in any case, or one of its aliases.

    ``units``: those it may have, and what they are worth, empty for bare numbers; ``unit``: where the file gives none,
    "": there has to be one. ``optional``: it may be missing; only columns that are needed count in a file without
    names. ``direction``: cells are ±1, ``+``/``-``, ``pos``/``neg``, ``up``/``down`` and the like.
    """

    name: str
    units: Mapping[str, float] = field(default_factory=dict)
    unit: str = ""
    optional: bool = False
    direction: bool = False
    aliases: tuple[str, ...] = ()


@dataclass(frozen=True)
class Columns:
    """What a file says, by the name of the column: values, shape (rows,), in the units asked for; only what is there.

    ``units``: the unit each column had, "" for bare numbers; ``lines``: where each row stands; ``details``: from
    comments, names in small letters.
    """

    file: str
    values: Mapping[str, Array]
    units: Mapping[str, str]
    lines: npt.NDArray[np.int64]
    details: Mapping[str, str]

    def positions(self, name: str) -> Array:
        """Return a column in mm or °; zeros where there is none."""
        if name not in self.values:
            return np.zeros(len(self.lines))
        return self.values[name] / shown("deg" if self.units[name] in ANGLES else "mm").factor


def read_text(path: Path) -> str:
    """Return the text of a file with newlines between lines; MeasurementError if there is none."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise MeasurementError(str(path), 0, f"The file cannot be read: {error.strerror or error}.") from error
    text = decode(data)
    if text is None:
        raise MeasurementError(str(path), 0, "The file is no text.")
    return text


def read_columns(path: Path, wanted: Sequence[Column]) -> Columns:
    """Read a table; MeasurementError if a column is missing, unknown or given twice, or a cell is no number."""
    file = str(path)
    details: dict[str, str] = {}
    names: list[tuple[Column, str]] | None = None
    rows: list[list[float]] = []
    lines: list[int] = []
    separator: str | None = None
    for line, written in enumerate(read_text(path).split("\n"), 1):
        if found := _DETAIL.match(written):
            details[found[1].lower()] = found[2]
        content = _COMMENT.split(written, 1)[0].strip()
        if not content:
            continue
        if names is None:
            separator = next((s for s in ";\t," if s in content), None)
            cells = _cells(content, separator)
            if all(_number(cell) is None for cell in cells):
                names = _header(file, line, cells, wanted)
                continue
            names = _header(file, line, [column.name for column in wanted if not column.optional], wanted)
        rows.append(_row(file, line, _cells(content, separator), names))
        lines.append(line)
    if names is None or not rows:
        raise MeasurementError(file, 0, "There is no measured value in it.")
    values = {
        column.name: cells * (column.units[unit] if column.units else 1.0)
        for cells, (column, unit) in zip(np.array(rows).T, names, strict=True)
    }
    units = {column.name: unit for column, unit in names}
    return Columns(file, values, units, np.array(lines), details)


def _cells(content: str, separator: str | None) -> list[str]:
    cells = [cell.strip() for cell in content.split(separator)]
    if separator is not None and not cells[-1]:
        cells.pop()
    return cells if separator == "," else [cell.replace(",", ".") for cell in cells]


def _number(cell: str) -> float | None:
    try:
        value = float(cell.replace("−", "-"))
    except ValueError:
        return None
    return None if "_" in cell else value


def _header(file: str, line: int, cells: Sequence[str], wanted: Sequence[Column]) -> list[tuple[Column, str]]:
    """Return column and unit of each cell of the first row."""
    known = {name: column for column in wanted for name in (column.name, *column.aliases)}
    found: list[tuple[Column, str]] = []
    for cell in cells:
        match = _HEADER.match(cell)
        name, unit = (match[1].lower(), match[2] or "") if match else ("", "")
        if name not in known and "_" in name:
            stem, _, suffix = name.rpartition("_")
            if stem in known:
                name, unit = stem, suffix
        if name not in known:
            choice = ", ".join(column.name for column in wanted)
            raise MeasurementError(file, line, f"“{cell}” is none of the columns {choice}.")
        column = known[name]
        if any(column is other for other, _ in found):
            raise MeasurementError(file, line, f"There are two columns for {column.name}.")
        found.append((column, _unit(file, line, column, unit)))
    missing = [column.name for column in wanted if not column.optional and column not in [c for c, _ in found]]
    if missing:
        raise MeasurementError(file, line, f"There is no column for {', '.join(missing)}.")
    return found


def _unit(file: str, line: int, column: Column, written: str) -> str:
    if not column.units:
        return ""
    unit = written.replace("µ", "u").replace("μ", "u").strip().lower() or column.unit
    unit = _SPELLINGS.get(unit, unit)
    if unit not in column.units:
        known = ", ".join(column.units)
        fault = f"“{written}” is no unit of {column.name}" if written else f"{column.name} needs a unit"
        raise MeasurementError(file, line, f"{fault}; one of {known} is.")
    return unit


def _row(file: str, line: int, cells: Sequence[str], names: Sequence[tuple[Column, str]]) -> list[float]:
    if len(cells) != len(names):
        raise MeasurementError(file, line, f"There are {len(cells)} cells for {len(names)} columns.")
    row = []
    for cell, (column, _) in zip(cells, names, strict=True):
        value = _number(cell)
        if column.direction:
            value = _DIRECTIONS.get(cell.lower(), value if value in (1.0, -1.0) else None)
        if value is None or not math.isfinite(value):
            kind = "direction (+ or −)" if column.direction else "number"
            raise MeasurementError(file, line, f"“{cell}” is no {kind}, as {column.name} has to be.")
        if abs(value) > LARGEST:
            raise MeasurementError(file, line, f"{cell} is too large for a measured {column.name}.")
        row.append(value)
    return row
