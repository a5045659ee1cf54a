"""A diagnosis as a workbook (ECMA-376): a sheet with the settings of the list, then one for each parameter file.

Numbers are numbers, units stand in the header, which stays in sight. The same lists give the same bytes.
"""

from __future__ import annotations

import io
import os
import re
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from datetime import datetime
from pathlib import Path

from openpyxl import Workbook
from openpyxl.cell import Cell as OpenpyxlCell, WriteOnlyCell
from openpyxl.styles import Alignment, Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet
from openpyxl.xml.functions import tostring

from ...fmu import generation_date, write_fmu
from ...kinds import ListKind, Parameter
from ...lists import CATALOGUE, ListValues, parameter
from ...model import AXIS_NUMBERS, DIRECTIONS, FILES_MAX, LETTERS, LINEAR, TOOL_ORIENTATION, is_angle
from .records import FILE_NAME, MAX_RECORDS, Diagnosis, ParameterFile, Record

SETTINGS = "settings"
"""Name of the first sheet."""

SETTING_COLUMNS = ("entry", "value", "unit", "id", "meaning", "where")
VALUE_COLUMNS = ("length [mm]", "angle [rad]", "number [1]")
ROWS_MAX = 1_048_576
"""Rows of a sheet, the header among them; what goes beyond is on a further sheet."""

_PROPERTIES = "docProps/core.xml"
_TITLE_MAX = 31
_NOT_IN_TITLES = re.compile(r"[\[\]:*?/\\]")
_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_NUMBERS = frozenset((*TOOL_ORIENTATION, *(name for names in DIRECTIONS for name in names), *AXIS_NUMBERS))
_BOLD, _WRAPPED = Font(bold=True), Alignment(wrap_text=True, vertical="top")

Cell = str | float | None


def write_workbook(diagnosis: Diagnosis, output: Path) -> None:
    """Write a diagnosis; BuildError if the file cannot be written."""
    # The archive of an FMU has no dates either: what makes those reproducible serves here too.
    write_fmu(output, _parts(_workbook(diagnosis)))


def _workbook(diagnosis: Diagnosis) -> Workbook:
    book = Workbook(write_only=True)
    source = diagnosis.source
    book.properties.creator = "axcomp"
    book.properties.title = _text(f"Volumetric compensation {source.index}: {source.path.name}")
    _fill(book.create_sheet(SETTINGS), SETTING_COLUMNS, _settings(diagnosis), (34, 60, 10, 14, 46, 24))
    for file in diagnosis.files:
        columns = _Columns(file)
        parts = range(0, max(1, len(file.records)), ROWS_MAX - 1)
        for number, first in enumerate(parts):
            sheet = book.create_sheet(_sheet_title(file, number))
            records = file.records[first : first + ROWS_MAX - 1]
            _fill(sheet, columns.header, map(columns.row, records), columns.widths)
    return book


def _parts(book: Workbook) -> dict[str, bytes]:
    """Return what is in the archive of a workbook, without the time at which it was written."""
    written = io.BytesIO()
    book.save(written)
    with zipfile.ZipFile(written) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    date = datetime.fromisoformat(generation_date()).replace(tzinfo=None)
    book.properties.created = book.properties.modified = date
    parts[_PROPERTIES] = tostring(book.properties.to_tree())
    return parts


def _fill(sheet: Worksheet, header: Sequence[str], rows: Iterable[Sequence[Cell]], widths: Sequence[int]) -> None:
    sheet.freeze_panes = "A2"
    for number, width in enumerate(widths, 1):
        sheet.column_dimensions[get_column_letter(number)].width = width
    head = [WriteOnlyCell(sheet, title) for title in header]
    for cell in head:
        cell.font = _BOLD
    sheet.append(head)
    count = 1
    for row in rows:
        sheet.append([_cell(sheet, value) for value in row])
        count += 1
    sheet.auto_filter.ref = f"A1:{get_column_letter(len(header))}{count}"


def _cell(sheet: Worksheet, value: Cell) -> Cell | OpenpyxlCell:
    """Return a cell that holds exactly this value: no formula made of text, and no digit less."""
    if isinstance(value, float) and float(f"{value:.16g}") != value:
        cell = WriteOnlyCell(sheet, repr(value))
        cell.data_type = "n"
        return cell
    if not isinstance(value, str):
        return value
    text = _text(value)
    if text[:1] in ("=", "#") or len(text) > 60:
        cell = WriteOnlyCell(sheet, text)
        cell.data_type = "s"
        cell.alignment = _WRAPPED
        return cell
    return text


def _text(text: str) -> str:
    return _NOT_IN_XML.sub("\ufffd", text)


def _sheet_title(file: ParameterFile, part: int) -> str:
    """Return a name that begins with the index of the file, which makes it unique."""
    number = f"{file.index}.{part + 1}" if part else f"{file.index}"
    return _NOT_IN_TITLES.sub("_", _text(f"{number} {file.path.name}"))[:_TITLE_MAX].rstrip("'")


class _Columns:
    """The columns that the records of a file need."""

    def __init__(self, file: ParameterFile) -> None:
        self._axes = sorted({k for record in file.records for k, x in enumerate(record.position) if x is not None})
        self._values = sorted({_value_column(record.parameter) for record in file.records})
        axes = (f"{LETTERS[k]} [{'mm' if LETTERS[k] in LINEAR else '°'}]" for k in self._axes)
        self.header = ("parameter", *axes, *(VALUE_COLUMNS[k] for k in self._values), "line", "note")
        self.widths = (12, *(12 for _ in self._axes), *(16 for _ in self._values), 8, 40)

    def row(self, record: Record) -> list[Cell]:
        """Return the cells of a record."""
        column = _value_column(record.parameter)
        values = (record.value if k == column else None for k in self._values)
        positions = (record.position[k] for k in self._axes)
        return [record.parameter, *positions, *values, record.line, record.note or None]


def _value_column(name: str) -> int:
    if name in _NUMBERS:
        return 2
    return 1 if is_angle(name) else 0


def _settings(diagnosis: Diagnosis) -> Iterator[Sequence[Cell]]:
    """Yield the rows of the first sheet: the list, its records, its entries, then what there is to say about them."""
    source, values = diagnosis.source, diagnosis.source.values
    for name, unit in ((FILE_NAME, ""), (MAX_RECORDS, "records")):
        yield _setting(parameter(ListKind.START_UP, name), source.start_up.values, source.index, unit=unit)
    yield "records used", diagnosis.counted, "records", None, "Records that count against max_records", None
    yield "records spliced", diagnosis.spliced, "records", None, "Those among them that enable_splicing has added", None
    state = "in force" if diagnosis.in_force else "off"
    yield "state", state, None, None, "off: an error keeps the compensation off", None
    for declared in CATALOGUE[ListKind.VOLUMETRIC]:
        if declared.index_max:
            yield from (_setting(declared, values, j) for j in range(FILES_MAX) if values.text("file[j]", j))
        elif declared.name.upper() in diagnosis.axes:
            yield _row(declared, declared.name, *diagnosis.axes[declared.name.upper()])
        else:
            yield _setting(declared, values)
    for finding in diagnosis.findings:
        message = finding.message.replace(f"{source.folder}{os.sep}", "")
        code = f"{finding.severity.value} {finding.code}"
        yield code, message, None, None, finding.parameter, _where(finding.file, finding.line)


def _setting(declared: Parameter, values: ListValues, *indices: int, unit: str = "") -> Sequence[Cell]:
    """Return the row of an entry of a list."""
    value = values.value(declared.name, *indices)
    where = _where(*values.place(declared.name, *indices)) if values.given(declared.name, *indices) else "default"
    return _row(declared, declared.named(*indices), value if isinstance(value, str) else int(value), where, unit)


def _row(declared: Parameter, name: str, value: Cell, where: str, unit: str = "") -> Sequence[Cell]:
    identifier = next(iter(declared.ids.values()), "")
    return name, value, unit or declared.unit or None, identifier or None, declared.meaning, where


def _where(file: str, line: int) -> str:
    return f"{Path(file).name}:{line}" if line else Path(file).name
