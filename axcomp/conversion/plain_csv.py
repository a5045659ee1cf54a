"""Plain CSV: one line for each point, tables told apart by the columns ``axis`` and ``over``.

Columns, in any order and case, only ``position`` and a value being needed: ``axis`` (corrected), ``over`` (looked up;
else the axis itself), ``unit`` and ``over_unit`` (mm or deg), ``period``, ``position``, and the values of positive and
negative motion. The name of a value column tells its sign: ``correction_positive``/``correction_negative`` are added to
the setpoint, ``error_positive``/``error_negative`` are actual − programmed, the negative of it; ``correction`` or
``error`` alone serves both directions. Separated by commas, semicolons or tabs; with the latter two a decimal comma is
taken too. ``#`` begins a comment line. Written: corrections, commas, all columns. Our own format: no other source.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from io import StringIO
from typing import NamedTuple

from .table import CompensationTable
from .text import DEFAULTS, FormatError, Options, Unit, decimal, number, shortened

COLUMNS = ("axis", "unit", "over", "over_unit", "period", "position", "correction_positive", "correction_negative")
_SIGNS = {"correction": 1.0, "error": -1.0}
_KNOWN = {*COLUMNS, *(f"{name}{side}" for name in _SIGNS for side in ("", "_positive", "_negative"))}
_UNITS: dict[str, Unit] = {"": "mm", "mm": "mm", "deg": "deg", "°": "deg"}
_LINE_MAX = 1000


class _Values(NamedTuple):
    """Names of the columns of positive and of negative motion, and the sign that makes their values corrections."""

    positive: str
    negative: str
    sign: float


@dataclass
class _Written:
    """The lines of one table: the first one, what all say of its unit and period, and the columns."""

    line: int
    head: tuple[str, str, str]
    positions: list[float] = field(default_factory=list)
    positive: list[float] = field(default_factory=list)
    negative: list[float] = field(default_factory=list)

    def take(self, cells: Mapping[str, str], line: int, values: _Values) -> None:
        """Add a line; FormatError for what is no number or does not ascend."""
        position = number(cells["position"], line, "position")
        if self.positions and position <= self.positions[-1]:
            raise FormatError(line, f"the positions must ascend, but {position:g} follows {self.positions[-1]:g}")
        self.positions.append(position)
        self.positive.append(values.sign * number(cells[values.positive], line, values.positive))
        # An empty cell: the value of the positive direction serves both.
        negative = cells[values.negative] or cells[values.positive]
        self.negative.append(values.sign * number(negative, line, values.negative))


def read_csv(text: str, options: Options = DEFAULTS) -> list[CompensationTable]:
    """Return the tables of a file in the order they begin; of ``options.axis`` where no column names the axis."""
    rows = list(_rows(text))
    if not rows:
        raise FormatError(0, "the file has no line that names the columns")
    header_line, labels = rows[0]
    names = [label.strip().lower() for label in labels]
    for name in names:
        if name not in _KNOWN:
            raise FormatError(
                header_line, f"unknown column {shortened(name)!r}; known are {', '.join(COLUMNS)}, error…"
            )
        if names.count(name) > 1:
            raise FormatError(header_line, f"column {name!r} is there twice")
    values = _value_columns(names, header_line)
    tables: dict[tuple[str, str], _Written] = {}
    for line, row in rows[1:]:
        if len(row) != len(names):
            raise FormatError(line, f"{len(row)} cells stand under {len(names)} columns")
        cells = dict.fromkeys(COLUMNS, "") | dict(zip(names, row, strict=True))
        axis = cells["axis"] or options.axis
        if not axis:
            raise FormatError(line, "the file does not tell the axis, so it must be given")
        over, head = cells["over"] or axis, (cells["unit"], cells["over_unit"], cells["period"])
        written = tables.setdefault((axis, over), _Written(line, head))
        if written.head != head:
            raise FormatError(line, f"unit or period of {axis} over {over} differ from line {written.line}")
        written.take(cells, line, values)
    if not tables:
        raise FormatError(0, "the file has no points")
    return [_table(key, written) for key, written in tables.items()]


def _rows(text: str) -> Iterable[tuple[int, list[str]]]:
    lines = text.splitlines()
    header = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    separator = max(",;\t", key=header.count)
    for number_, line in enumerate(lines, 1):
        if not line.strip() or line.startswith("#"):
            continue
        try:
            cells = next(csv.reader([line[:_LINE_MAX]], delimiter=separator, strict=True))
        except csv.Error as error:
            raise FormatError(number_, f"{error}") from None
        if separator != ",":
            cells = [cell.replace(",", ".") for cell in cells]
        yield number_, [cell.strip() for cell in cells]


def _value_columns(names: Sequence[str], line: int) -> _Values:
    if "position" not in names:
        raise FormatError(line, "there is no column 'position'")
    kinds = [kind for kind in _SIGNS if any(name.startswith(kind) for name in names)]
    if len(kinds) != 1:
        raise FormatError(
            line, "there must be a column 'correction' or 'error', with or without _positive and _negative"
        )
    kind = kinds[0]
    sides = [name for name in names if name.startswith(kind)]
    if kind in sides and len(sides) > 1:
        raise FormatError(line, f"'{kind}' serves both directions: {sides[1]!r} has no place beside it")
    positive = kind if kind in sides else f"{kind}_positive"
    if positive not in sides:
        raise FormatError(line, f"there is no column {positive!r}")
    negative = f"{kind}_negative" if f"{kind}_negative" in sides else positive
    return _Values(positive, negative, _SIGNS[kind])


def _table(key: tuple[str, str], written: _Written) -> CompensationTable:
    unit, over_unit, period = written.head
    for said in (unit, over_unit):
        if said not in _UNITS:
            raise FormatError(written.line, f"a unit is mm or deg, not {shortened(said)!r}")
    own = _UNITS[unit]
    over = own if key[0] == key[1] and not over_unit else _UNITS[over_unit]
    if key[0] == key[1] and own != over:
        raise FormatError(written.line, f"axis {key[0]} cannot be in mm and deg at once")
    repeats = number(period, written.line, "period") if period else None
    try:
        return CompensationTable.of(*key, written.positions, written.positive, written.negative, repeats, own, over)
    except ValueError as error:
        raise FormatError(written.line, str(error)) from None


def write_csv(tables: Sequence[CompensationTable], options: Options = DEFAULTS) -> str:
    """Return the file of any tables."""
    options.check_metric()
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for table in tables:
        period = "" if table.period is None else decimal(table.period)
        head = (table.axis, table.unit, table.over, table.over_unit, period)
        for position, positive, other in zip(table.positions, table.positive.y, table.curve(-1).y, strict=True):
            negative = "" if table.negative is None else decimal(other)
            writer.writerow([*head, decimal(position), decimal(positive), negative])
    return out.getvalue()
