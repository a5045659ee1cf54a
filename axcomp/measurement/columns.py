"""Measurements as tables: named columns with units, and errors that say in which line they are.

What files may look like says ``engine.read_sheets``. The first row with a name of a column names the columns, in any
order, each with its unit if that is not the usual one: ``deviation [mm]``, ``deviation (mm)`` or ``deviation_mm``.
Without such a row the columns are those asked for, in that order. Where commas do not separate cells, they may stand
for the decimal point. A column ``axis`` makes one table an axis.

One column a run is read too, where the columns asked for have a run, a direction and one that is ``spread``: its name
has the number of the run and the direction, ``1 +``, ``run 2 down``, ``3↑`` (a column ``direction`` may have that).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from ..engine import Array, Row, Sheet, SheetError, number, read_sheets
from ..model import shown

LENGTHS = {"m": 1e6, "mm": 1e3, "um": 1.0, "nm": 1e-3, "in": 25400.0, "uin": 0.0254}
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
_SPELLINGS |= {
    "inch": "in",
    "inches": "in",
    "zoll": "in",
    "microinch": "uin",
    "uinch": "uin",
    "micron": "um",
    "grad": "deg",
}
_HEADER = re.compile(r"\s*([^\W\d]\w*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*\Z")
_UNIT = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*\Z")
_PIECES = re.compile(r"[^\W\d_]+|\d{1,6}|[+\-−↑↓]")
_RUN_WORDS = ("run", "runs", "cycle", "lauf", "zyklus", "r", "no", "nr")
_AXIS = ("axis", "achse")
_DIRECTIONS = {
    **dict.fromkeys(("1", "+1", "+", "pos", "positive", "up", "fwd", "forward", "↑"), 1.0),
    **dict.fromkeys(("-1", "−1", "-", "−", "neg", "negative", "down", "bwd", "backward", "reverse", "↓"), -1.0),
}


class MeasurementError(Exception):
    """A measurement that cannot be used: one sentence that begins with ``file:line:``, or ``file:`` for all of it."""

    def __init__(self, file: str, line: int, sentence: str) -> None:
        self.file, self.line = file, line
        super().__init__(f"{file}:{line}: {sentence}" if line else f"{file}: {sentence}")


class SeveralAxesError(MeasurementError):
    """A file has several axes, and it was not said which one is meant."""


@dataclass(frozen=True, eq=False)
class Column:
    """A column that is looked for, by its name in the first row, in any case, or one of its aliases.

    ``units``: those it may have, and what they are worth, empty for bare numbers; ``unit``: where the file gives none,
    "": there has to be one. ``optional``: it may be missing; only columns that are needed count in a file without
    names. ``direction``: cells are ±1, ``+``/``-``, ``pos``/``neg``, ``up``/``down`` and the like.
    ``instead_of``: the needed column that it stands for. ``spread``: there may be one a run.
    """

    name: str
    units: Mapping[str, float] = field(default_factory=dict)
    unit: str = ""
    optional: bool = False
    direction: bool = False
    aliases: tuple[str, ...] = ()
    instead_of: str = ""
    spread: bool = False


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


class _Place(NamedTuple):
    """What a cell of each row is: a column with its unit, and of one column a run which run and direction."""

    column: Column
    unit: str
    run: int = 0
    direction: float = 0.0


_AXIS_COLUMN = Column("axis", aliases=_AXIS)
_Reading = tuple[str, int, dict[str, float]]
"""Axis, line and cells by column."""


def read_columns(
    path: Path, wanted: Sequence[Column], axis: str = "", needed: Sequence[Column] | None = None
) -> Columns:
    """Read a table; MeasurementError if a column is missing, unknown or given twice, or a cell is no number.

    ``axis``: the one that is meant where the file has several; ``needed``: the columns of a file without names, where
    they are not those that are not optional.
    """
    return of_axis(read_all_columns(path, wanted, needed), axis, str(path))


Measured = TypeVar("Measured")


def of_axis(tables: Sequence[Measured], axis: str, file: str) -> Measured:
    """Return the one of an axis; MeasurementError where there are several and none or more of it."""
    if len(tables) == 1:
        return tables[0]
    names = [_axis_of(table) for table in tables]
    found = [table for table, name in zip(tables, names, strict=True) if axis and name.casefold() == axis.casefold()]
    if len(found) == 1:
        return found[0]
    held = ", ".join(name or "?" for name in names)
    raise SeveralAxesError(file, 0, f"It holds {len(tables)} measurements, of the axes {held}: say which one is meant.")


def _axis_of(table: Any) -> str:
    return str(table.details.get("axis", "")) or str(table.details.get("sheet", ""))


def read_all_columns(
    path: Path, wanted: Sequence[Column], needed: Sequence[Column] | None = None
) -> tuple[Columns, ...]:
    """Read every table of a file, see ``read_columns``; one for each axis."""
    known = _known(wanted)
    needed = [column for column in wanted if not column.optional] if needed is None else needed

    def is_header(cells: Sequence[str]) -> bool:
        return any(_name(cell, known)[0] in known for cell in cells)

    try:
        sheets = read_sheets(path, is_header)
    except SheetError as error:
        raise MeasurementError(error.file, error.line, error.sentence) from None
    places: list[_Place] = []
    found: list[Columns] = []
    for sheet in sheets:
        readings: list[_Reading] = []
        for row in sheet.rows:
            if row is sheet.rows[0] and (_is_named(row, known) or not places):
                named = _is_named(row, known) or all(number(cell) is None for cell in row.cells)
                cells = row.cells if named else [column.name for column in needed]
                places = _header(sheet.file, row.line, cells, wanted)
                if named:
                    continue
            readings += _readings(sheet.file, row, places)
        found += _tables(sheet, readings, places)
    if not found:
        raise MeasurementError(str(path), 0, "There is no measured value in it.")
    return tuple(found)


def _tables(sheet: Sheet, readings: Sequence[_Reading], places: Sequence[_Place]) -> Iterator[Columns]:
    """Yield a table for each axis among readings."""
    for axis in dict.fromkeys(reading[0] for reading in readings):
        mine = [reading for reading in readings if reading[0] == axis]
        units = {place.column.name: place.unit for place in places if place.column is not _AXIS_COLUMN}
        scales = {p.column.name: p.column.units[p.unit] if p.column.units else 1.0 for p in places}
        for name in ("run", "direction"):
            if name in mine[0][2]:
                units.setdefault(name, "")
        values = {name: np.array([cells[name] for *_, cells in mine]) * scales.get(name, 1.0) for name in units}
        details = {**sheet.details, **({"axis": axis} if axis else {})}
        yield Columns(sheet.file, values, units, np.array([line for _, line, _ in mine]), details)


def _known(wanted: Sequence[Column]) -> dict[str, Column]:
    return {name: column for column in (*wanted, _AXIS_COLUMN) for name in (column.name, *column.aliases)}


def _is_named(row: Row, known: Mapping[str, Column]) -> bool:
    """Tell whether a row names columns."""
    return any(_name(cell, known)[0] in known for cell in row.cells)


def _name(cell: str, known: Mapping[str, Column]) -> tuple[str, str]:
    """Return name and unit in the head of a column, empty where it is none."""
    match = _HEADER.match(cell)
    name, unit = (match[1].lower(), match[2] or "") if match else ("", "")
    if name not in known and "_" in name:
        stem, _, suffix = name.rpartition("_")
        if stem in known:
            return stem, suffix
    return name, unit


def _run_of(cell: str) -> tuple[int, float, str, str] | None:
    """Return run, direction (0: none), the word for the value and the unit of one column a run."""
    match = _UNIT.match(cell)
    text, unit = (match[1], match[2] or "") if match else (cell, "")
    run, direction, word = 0, 0.0, ""
    for piece in (piece.lower() for piece in _PIECES.findall(text)):
        if piece.isdecimal() and not run:
            run = int(piece)
        elif piece in _DIRECTIONS and not direction and not piece.isdecimal():
            direction = _DIRECTIONS[piece]
        elif piece not in _RUN_WORDS:
            if word or piece.isdecimal():
                return None
            word = piece
    return (run, direction, word, unit) if run else None


def _header(file: str, line: int, cells: Sequence[str], wanted: Sequence[Column]) -> list[_Place]:
    """Return what the cells of each row are."""
    known, spread = _known(wanted), [column for column in wanted if column.spread]
    found: list[_Place] = []
    for cell in cells:
        name, unit = _name(cell, known)
        run = _run_of(cell) if spread else None
        if name not in known and run is not None and (run[2] in known or not run[2]):
            column = known[run[2]] if run[2] else spread[0]
            if column.spread:
                found.append(_Place(column, _unit(file, line, column, run[3]), run[0], run[1]))
                continue
        if name not in known:
            choice = ", ".join(column.name for column in wanted)
            raise MeasurementError(file, line, f"“{cell}” is none of the columns {choice}.")
        column = known[name]
        if any(column is place.column for place in found):
            raise MeasurementError(file, line, f"There are two columns for {column.name}.")
        found.append(_Place(column, _unit(file, line, column, unit)))
    _check_header(file, line, found, wanted)
    return found


def _check_header(file: str, line: int, found: Sequence[_Place], wanted: Sequence[Column]) -> None:
    columns = {place.column.name for place in found}
    columns |= {place.column.instead_of for place in found}
    runs = [place for place in found if place.run]
    if runs:
        if len({(place.column.name, place.unit) for place in runs}) > 1 or "run" in columns:
            raise MeasurementError(file, line, "Columns of runs do not go with others of the same.")
        if "direction" not in columns and not all(place.direction for place in runs):
            sentence = "The columns of runs need a direction each, as in “1 +” and “1 -”, or a column direction."
            raise MeasurementError(file, line, sentence)
        twice = [p for i, p in enumerate(runs) if (p.run, p.direction) in [(q.run, q.direction) for q in runs[:i]]]
        if twice:
            raise MeasurementError(file, line, f"There are two columns for run {twice[0].run} in one direction.")
        columns |= {"run", "direction"}
    missing = [column.name for column in wanted if not column.optional and column.name not in columns]
    if missing:
        raise MeasurementError(file, line, f"There is no column for {', '.join(missing)}.")
    for place in found:
        other = place.column.instead_of
        if other and any(one.column.name == other for one in found):
            raise MeasurementError(file, line, f"There are columns for both {place.column.name} and {other}.")


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


def _readings(file: str, row: Row, places: Sequence[_Place]) -> Iterator[_Reading]:
    """Yield the readings of a row: one, or one for each column of a run that is not empty."""
    cells, runs = row.cells, [place for place in places if place.run]
    if runs:
        cells += ("",) * (len(places) - len(cells))
    if len(cells) != len(places):
        raise MeasurementError(file, row.line, f"There are {len(cells)} cells for {len(places)} columns.")
    axis, common = "", {}
    for cell, place in zip(cells, places, strict=True):
        if place.column is _AXIS_COLUMN:
            axis = cell
        elif not place.run:
            common[place.column.name] = _value(file, row.line, cell, place.column)
    if not runs:
        yield axis, row.line, common
    for cell, place in zip(cells, places, strict=True):
        if place.run and cell:
            value = _value(file, row.line, cell, place.column)
            direction = place.direction or common["direction"]
            yield axis, row.line, {**common, "run": place.run, "direction": direction, place.column.name: value}


def _value(file: str, line: int, cell: str, column: Column) -> float:
    value = number(cell)
    if column.direction:
        value = _DIRECTIONS.get(cell.lower(), value if value in (1.0, -1.0) else None)
    if value is None or not math.isfinite(value):
        kind = "direction (+ or −)" if column.direction else "number"
        raise MeasurementError(file, line, f"“{cell}” is no {kind}, as {column.name} has to be.")
    if abs(value) > LARGEST:
        raise MeasurementError(file, line, f"{cell} is too large for a measured {column.name}.")
    return value
