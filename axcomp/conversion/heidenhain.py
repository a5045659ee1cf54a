"""Heidenhain ``.COM`` files: nonlinear axis error compensation, one or several axes over the position of one axis.

Two generations, both read; ``NR`` counts the lines, ``[END]`` closes the table, cells stand below the column's label:

* TNC 6xx, TNC7, MANUALplus: ``BEGIN AXIS_X.COM MM``, columns AXISPOS (position, machine datum), BACKLASH, and one for
  each axis. BACKLASH holds the values of the negative direction of traverse where they differ; the axis column then
  holds those of the positive one.
* TNC 4xx, iTNC 530: ``BEGIN AXIS-X.COM DATUM:+0.0000 DISTANCE:+50.0000``, position NR · DISTANCE + DATUM, no BACKLASH,
  at most 256 lines.

Which axis the positions belong to, the assignment table (``.CMA``) says, not the file; here the file name in BEGIN,
``AXIS_X`` or ``AXIS-X``, tells, or the caller. A rotary axis has entries from 0 to 360 only. Outside the table the end
values are taken to be held; the documents do not say, so a table should cover the whole traverse range.

Sign: what is entered is the **error**, positive where the axis travels too far (as for MP720, the linear error); the
correction of the setpoint is its negative, for screw pitch and sag alike. Units: mm (INCH in BEGIN: read only) and
degrees, written with four decimals, as these controls show them: rounding costs up to 0.05 µm.

Source: Heidenhain Technical Manual MANUALplus 620 (01/2012), 6.10.3, pages 713 to 718; TNC 407/415/425 (01/1998), 1.6.3
and 1.6.4, pages 4-26 to 4-31 and 4.7.3; the header lines from files that public measurement tools write.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from .table import CompensationTable, beginning_at, on_equidistant_points
from .text import DEFAULTS, CannotHoldError, FormatError, Options, number, shortened

DECIMALS = 4
POINTS_MAX_ITNC = 256
TURN = 360.0

_BEGIN = re.compile(r"BEGIN\s+(\S+)\s*(.*?)\s*\Z", re.IGNORECASE)
_FILE = re.compile(r"AXIS[-_](\w{1,13})\.COM\Z", re.IGNORECASE)
_DATUM = re.compile(r"DATUM:\s*(\S+)\s+DIST(?:ANCE)?:\s*(\S+)\Z", re.IGNORECASE)
_WORD = re.compile(r"\S+")
_POSITION, _BACKLASH = "AXISPOS", "BACKLASH"
_WIDTH_NR, _WIDTH = 5, 14


class _Sheet:
    """The cells of a file: column → values, and what the first line says."""

    def __init__(self, text: str) -> None:
        self.lines = [line.expandtabs() for line in text.splitlines()]
        self.columns: dict[str, list[float]] = {}
        self.numbers: list[int] = []
        self.begin = _BEGIN.match(self.lines[0].strip()) if self.lines else None
        if self.begin is None:
            raise FormatError(1, "expected BEGIN and the name of a .COM file")
        self.grid = _DATUM.match(self.begin[2])
        rest = "MM" if self.grid else self.begin[2].upper()
        if rest not in {"", "MM", "INCH"}:
            raise FormatError(
                1, f"expected MM, INCH or DATUM: and DISTANCE: behind the file name, found {shortened(rest)!r}"
            )
        self.inch = rest == "INCH"
        if len(self.lines) < 2:
            raise FormatError(0, "the file ends behind BEGIN")
        self.labels = [(found.start(), found[0].upper()) for found in _WORD.finditer(self.lines[1])]
        self._check_labels()
        for line, row in enumerate(self.lines[2:], 3):
            if row.strip().upper() in {"[END]", "END"}:
                break
            if row.strip():
                self._take(line, row)
        if not self.numbers:
            raise FormatError(0, "the file has no points")
        self.columns = {label: cells for label, cells in self.columns.items() if cells}

    def _check_labels(self) -> None:
        names = [label for _, label in self.labels]
        if not names or names[0] != "NR":
            raise FormatError(2, "expected the names of the columns, NR first")
        if len(set(names)) < len(names):
            raise FormatError(2, "a column is there twice")
        if self.grid is None and _POSITION not in names:
            raise FormatError(2, f"there is neither a column {_POSITION} nor DATUM: and DISTANCE: in the first line")
        if self.grid is not None:
            # The column of positions has no label in this generation; it begins behind NR.
            self.labels.insert(1, (self.labels[0][0] + 2, _POSITION))
        self.columns = {label: [] for _, label in self.labels[1:]}

    def _take(self, line: int, row: str) -> None:
        before = len(self.numbers)
        self.numbers.append(line)
        filled = set()
        for found in _WORD.finditer(row):
            # A sign may stand in front of the column.
            label = next((name for start, name in reversed(self.labels) if start <= found.start() + 1), "NR")
            if label in filled:
                raise FormatError(line, f"two values stand in column {label}")
            filled.add(label)
            value = number(found[0], line, label)
            if label == "NR":
                if value != before:
                    raise FormatError(line, f"line number {before} expected, found {shortened(found[0])}")
            elif len(self.columns[label]) < before:
                raise FormatError(line, f"column {label} has a value here but not in the first line")
            else:
                self.columns[label].append(value)
        if "NR" not in filled:
            raise FormatError(line, "the line has no number")
        for label, cells in self.columns.items():
            if cells and label not in filled:
                raise FormatError(line, f"column {label} is empty here")

    def positions(self) -> list[float]:
        """Return the positions as the file means them, in its unit; checked to ascend."""
        written = self.columns.pop(_POSITION, [])
        if self.grid is None:
            if not written:
                raise FormatError(self.numbers[0], f"column {_POSITION} is empty")
            positions = written
        else:
            datum, distance = number(self.grid[1], 1, "DATUM"), number(self.grid[2], 1, "DISTANCE")
            positions = [datum + index * distance for index in range(len(self.numbers))]
            for line, position, said in zip(self.numbers, positions, written, strict=False):
                if abs(position - said) > 1e-3:
                    raise FormatError(line, f"the position is {said:g}, but DATUM and DISTANCE make it {position:g}")
        for line, before, after in zip(self.numbers[1:], positions, positions[1:], strict=False):
            if after <= before:
                raise FormatError(line, f"the positions must ascend, but {after:g} follows {before:g}")
        return positions


def read_heidenhain(text: str, options: Options = DEFAULTS) -> list[CompensationTable]:
    """Return a table for each axis column that is filled.

    Its positions are those of ``options.over``, else of the axis its name tells, else of the only corrected one.
    """
    sheet = _Sheet(text)
    positions = sheet.positions()
    negative = sheet.columns.pop(_BACKLASH, None)
    axes = list(sheet.columns)
    if not axes:
        raise FormatError(2, "no axis column is filled")
    if negative is not None and len(axes) > 1:
        raise FormatError(2, f"{_BACKLASH} is filled for {len(axes)} axes at once: it belongs to one")
    assert sheet.begin is not None
    named = _FILE.match(sheet.begin[1])
    over = options.over or (named[1].upper() if named else axes[0] if len(axes) == 1 else None)
    if over is None:
        raise FormatError(1, f"the file does not tell the axis whose positions it has, and corrects {', '.join(axes)}")
    over_unit = options.unit(over)
    if over_unit == "deg":
        # A distance of four decimals misses the end of the turn by a little for each line.
        if positions[0] != 0.0 or abs(positions[-1] - TURN) > 1e-4 * len(positions):
            raise FormatError(sheet.numbers[0], f"the table of a rotary axis goes from 0 to {TURN:g}")
        positions = [position * TURN / positions[-1] for position in positions]
    units = Options(inch=sheet.inch)
    positions = [position * units.scale(over_unit) for position in positions]
    period = TURN if over_unit == "deg" else None
    tables = []
    for axis, values in sheet.columns.items():
        unit = options.unit(axis)
        factor = -units.scale(unit)
        positive = [value * factor for value in values]
        reverse = None if negative is None else [value * factor for value in negative]
        tables.append(CompensationTable.of(axis, over, positions, positive, reverse, period, unit, over_unit))
    return tables


def write_heidenhain(tables: Sequence[CompensationTable], options: Options = DEFAULTS) -> str:
    """Return the file of a TNC 6xx or later with tables over one axis, a bilateral one alone.

    Over a rotary axis they repeat every 360°.
    """
    options.check_metric()
    tables, positions = _together(tables)
    if len(tables) > 1 and any(table.negative is not None for table in tables):
        raise CannotHoldError(f"a .COM file holds one bilateral table; there are {len(tables)} over {tables[0].over}")
    labels = ["AXISPOS", "BACKLASH", *(table.axis for table in tables)]
    lines = [f"BEGIN AXIS_{tables[0].over}.COM MM", _row("NR", labels)]
    columns = [[_signed(position) for position in positions]]
    for curve in (tables[0].negative, *(table.positive for table in tables)):
        columns.append([""] * len(positions) if curve is None else [_signed(-y) for y in curve.on(positions).y])
    lines += [_row(str(index), cells) for index, cells in enumerate(zip(*columns, strict=True))]
    return "\n".join([*lines, "[END]"]) + "\n"


def write_itnc(tables: Sequence[CompensationTable], options: Options = DEFAULTS) -> str:
    """Return the file of a TNC 4xx or iTNC 530 with a unilateral table; over a rotary axis it repeats every 360°."""
    options.check_metric()
    if len(tables) != 1:
        raise CannotHoldError(f"there are {len(tables)} tables: write one file for each")
    table = tables[0]
    if table.negative is not None:
        raise CannotHoldError(f"{table.name} is bilateral: this generation has no column for the negative direction")
    if len(table.positions) > POINTS_MAX_ITNC and options.within is None:
        raise CannotHoldError(f"{table.name} has {len(table.positions)} points; the control takes {POINTS_MAX_ITNC}")
    even = on_equidistant_points(_turning(table), POINTS_MAX_ITNC, options.within)
    datum, distance = even.positions[0], even.positions[1] - even.positions[0]
    lines = [
        f"BEGIN AXIS-{even.over}.COM DATUM:{_signed(datum)} DISTANCE:{_signed(distance)}",
        _row("NR", ["", even.axis]),
    ]
    for index, value in enumerate(even.positive.y):
        lines.append(_row(str(index), [_signed(datum + index * distance), _signed(-value)]))
    return "\n".join([*lines, "[END]"]) + "\n"


def _together(tables: Sequence[CompensationTable]) -> tuple[list[CompensationTable], list[float]]:
    """Return the tables, ready for the turn of a rotary axis, and the points of all of them."""
    over = sorted({table.over for table in tables})
    if len(over) != 1:
        raise CannotHoldError(f"a .COM file is over one axis; the tables are over {', '.join(over) or 'none'}")
    ready = [_turning(table) for table in tables]
    positions = sorted({round(position, DECIMALS) for table in ready for position in table.positions})
    if len(ready) == 1 and len(positions) < len(ready[0].positions):
        raise CannotHoldError(f"{ready[0].name} has points less than 0.0001 {ready[0].over_unit} apart")
    return ready, positions


def _turning(table: CompensationTable) -> CompensationTable:
    if table.over_unit == "mm" and table.period is None:
        return table
    if table.over_unit == "mm" or table.period != TURN:
        repeats = "does not repeat" if table.period is None else f"repeats every {table.period:g} {table.over_unit}"
        raise CannotHoldError(f"{table.name} {repeats}: these controls repeat rotary axes every 360 deg, and no others")
    return beginning_at(table, 0.0)


def _signed(value: float) -> str:
    text = f"{value:+.{DECIMALS}f}"
    return text.replace("-", "+") if float(text) == 0.0 else text


def _row(first: str, cells: Sequence[str]) -> str:
    return (first.ljust(_WIDTH_NR) + "".join(cell.ljust(_WIDTH) for cell in cells)).rstrip()
