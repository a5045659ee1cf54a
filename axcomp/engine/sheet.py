"""Tables as instruments and spreadsheets write them, whatever is in them: rows of cells, each with its line.

Text: UTF-8, UTF-16 with its mark or Latin-1; cells are separated by semicolons, tabs, commas or blanks, or as a line
``sep=;`` says, and may be quoted; ``#`` and ``//`` begin a comment. ``# axis: X``, or ``Axis: X`` above the table, is a
detail; where one comes again behind rows, another table begins. Workbooks (``.xlsx``) have a table on each sheet that
is not empty; ``.parquet`` and ``.feather`` have one with the names of the columns as first row. Any of them may be
compressed (``.gz``).
"""

from __future__ import annotations

import csv
import gzip
import io
import math
import re
import warnings
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..lists import decode
from ..model import needed

WORKBOOKS = (".xlsx", ".xlsm")
FRAMES = (".parquet", ".feather")
_OLD = (".xls", ".ods", ".xlsb")
UNPACKED_MAX = 1 << 30
"""Bytes that a compressed file may have."""
_SEPARATOR = re.compile(r"\s*\"?sep=(\\t|.)\"?\s*\Z", re.I)
_DETAIL = re.compile(r"\s*(?:#|//)\s*([^\W\d][\w ]*?)\s*[:=]\s*(.*?)\s*\Z")
_PLAIN_DETAIL = re.compile(r"\s*([^\W\d][\w ]*?)\s*[:=][;,\t]?\s*([^;\t]*?)[\s;,]*\Z")
_COMMENT = re.compile(r'((?:"[^"]*"|[^"])*?)(?:#|//)')
_OPEN = re.compile(r'(?:(?:"(?:[^"]|"")*"|[^";,\t]*)[;,\t])*\s*"(?:[^"]|"")*\Z')
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:([.,'])\d{3})(?:\1\d{3})*([.,])\d+\Z")


LINES_MAX = 50
"""Lines that a quoted cell has at most."""


class SheetError(ValueError):
    """A file that is no table: file, line (0: all of it) and a sentence."""

    def __init__(self, file: str, line: int, sentence: str) -> None:
        self.file, self.line, self.sentence = file, line, sentence
        super().__init__(f"{file}:{line}: {sentence}" if line else f"{file}: {sentence}")


@dataclass(frozen=True)
class Row:
    """Cells as text, without blanks around them, and where they stand."""

    line: int
    cells: tuple[str, ...]


@dataclass
class Sheet:
    """One table of a file; ``details``: from comments, names in small letters."""

    file: str
    rows: list[Row] = field(default_factory=list)
    details: dict[str, str] = field(default_factory=dict)


def number(cell: str) -> float | None:
    """Return the number in a cell; commas are decimal points there, unless they or points mark thousands."""
    text = cell.strip().replace("−", "-").replace("\u202f", "").replace("\xa0", "")
    if (found := _THOUSANDS.match(text)) and found[1] != found[2]:
        text = text.replace(found[1], "")
    try:
        value = float(text.replace(",", "."))
    except ValueError:
        return None
    return None if "_" in text else value


def read_sheets(
    path: Path, is_header: Callable[[Sequence[str]], bool] = lambda _: True, *, comments: bool = True
) -> tuple[Sheet, ...]:
    """Return the tables of a file that have rows; SheetError if it cannot be read.

    ``is_header`` tells of the cells of a line whether it names columns: details without ``#`` stand above such a line;
    ``comments`` False: ``#`` and ``//`` begin none, and an empty cell at the end of a row is one.
    """
    data, suffix = _unpacked(path)
    if suffix in _OLD:
        raise SheetError(str(path), 0, f"Workbooks are read as .xlsx, not as {suffix}: save it so.")
    if suffix in WORKBOOKS:
        found = _of_workbook(path, data)
    else:
        found = _of_frame(path, data, suffix) if suffix in FRAMES else _of_text(path, data, is_header, comments)
    return tuple(sheet for sheet in found if sheet.rows)


def _unpacked(path: Path) -> tuple[bytes, str]:
    """Return what is in a file, and the suffix that says what it is."""
    suffix = path.suffix.lower()
    try:
        if suffix != ".gz":
            return path.read_bytes(), suffix
        with gzip.open(path) as file:
            data = file.read(UNPACKED_MAX + 1)
    except (OSError, EOFError, zlib.error) as error:
        reason = getattr(error, "strerror", None) or error
        raise SheetError(str(path), 0, f"The file cannot be read: {reason}.") from None
    if len(data) > UNPACKED_MAX:
        raise SheetError(str(path), 0, f"It has more than {UNPACKED_MAX >> 20} MB.")
    return data, path.with_suffix("").suffix.lower()


def _of_text(path: Path, data: bytes, is_header: Callable[[Sequence[str]], bool], comments: bool) -> Iterator[Sheet]:
    text = decode(data)
    if text is None:
        raise SheetError(str(path), 0, "The file is no text.")
    lines = text.split("\n")
    separator: str | None = None
    known = headed = False
    sheet = Sheet(str(path))
    for line, written in _joined(lines):
        if not known and (said := _SEPARATOR.match(written)):
            separator, known = said[1].replace("\\t", "\t"), True
            continue
        commented = comments and ("#" in written or "//" in written)
        if commented and (detail := _DETAIL.match(written)):
            name = detail[1].lower()
            if sheet.rows and name in sheet.details and sheet.details[name] != detail[2]:
                yield sheet
                sheet = Sheet(str(path), details=dict(sheet.details))
            sheet.details[name] = detail[2]
        cut = _COMMENT.match(written) if commented else None
        content = cut[1] if cut else written
        if not content.strip():
            continue
        if not known:
            found = next((one for one in ";\t," if one in content), None)
            separator, known = found or (None if len(content.split()) > 1 else ","), True
        # An empty cell at the begin of a line is one where tabs separate cells.
        tabs = separator == "\t"
        content = content.strip(" \r") if tabs and not comments else content.rstrip() if tabs else content.strip()
        cells = _cells(content, separator, comments)
        if not headed and (plain := _PLAIN_DETAIL.match(content)) and not is_header(cells):
            sheet.details[plain[1].lower()] = plain[2].strip('" ')
            known = False
            continue
        headed = True
        if any(cells):
            sheet.rows.append(Row(line, cells))
    yield sheet


def _joined(lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield lines with their numbers; a quoted cell may go on over the next ones."""
    line = 0
    while line < len(lines):
        first, written = line, lines[line]
        while '"' in written and _OPEN.match(written) and line + 1 < min(len(lines), first + LINES_MAX):
            line += 1
            written += "\n" + lines[line]
        if first < line and _OPEN.match(written):
            line, written = first, lines[first]
        yield first + 1, written
        line += 1


def _cells(content: str, separator: str | None, trimmed: bool = True) -> tuple[str, ...]:
    """Return the cells of a line; an empty one at its end is none if ``trimmed``."""
    if separator is None:
        return tuple(content.split())
    if '"' in content:
        cells = next(csv.reader([content], delimiter=separator, skipinitialspace=True), [])
    else:
        cells = content.split(separator)
    found = [cell.strip() for cell in cells]
    if trimmed and found and not found[-1]:
        found.pop()
    return tuple(found)


def _of_frame(path: Path, data: bytes, suffix: str) -> Iterator[Sheet]:
    pandas = _needed("pandas", path)
    _needed("pyarrow", path)
    read = pandas.read_parquet if suffix == ".parquet" else pandas.read_feather
    try:
        frame = read(io.BytesIO(data))
    except Exception as error:  # whatever pyarrow and pandas raise of damaged files
        raise SheetError(str(path), 0, f"The file cannot be read: {str(error).splitlines()[0]}.") from None
    if any(name is not None for name in frame.index.names):
        frame = frame.reset_index()
    names = Row(1, tuple(map(str, frame.columns)))
    columns = [
        ["" if none else _shown(cell) for cell, none in zip(frame[name], frame[name].isna(), strict=True)]
        for name in frame
    ]
    rows = [Row(line, cells) for line, cells in enumerate(zip(*columns, strict=True), 2)]
    yield Sheet(str(path), [names, *rows])


def _needed(package: str, path: Path) -> Any:
    try:
        return needed(package, "tables", "It")
    except ModuleNotFoundError as error:
        raise SheetError(str(path), 0, f"{error}.") from None


def _of_workbook(path: Path, data: bytes) -> Iterator[Sheet]:
    openpyxl = _needed("openpyxl", path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and the like that are not read
            book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True)
            pages = {page.title: list(page.iter_rows(values_only=True)) for page in book.worksheets}
            book.close()
    except Exception as error:  # whatever a damaged archive, or XML in it, makes openpyxl raise
        raise SheetError(str(path), 0, f"The workbook cannot be read: {error}.") from None
    filled = {title: rows for title, rows in pages.items() if any(any(c is not None for c in row) for row in rows)}
    for title, rows in filled.items():
        sheet = Sheet(f"{path}[{title}]" if len(filled) > 1 else str(path))
        if len(filled) > 1:
            sheet.details["sheet"] = title
        for line, row in enumerate(rows, 1):
            _take(sheet, line, ["" if cell is None else _shown(cell) for cell in row])
        yield sheet


def _take(sheet: Sheet, line: int, cells: list[str]) -> None:
    """Take the row of a workbook: a detail in its first cells, or cells of the table."""
    while cells and not cells[-1]:
        cells.pop()
    if not cells:
        return
    if detail := _DETAIL.match(cells[0]):
        sheet.details[detail[1].lower()] = detail[2]
    elif cells[0].startswith(("#", "//")):
        pass
    elif not sheet.rows and len(cells) <= 2 and cells[0].rstrip().endswith(":"):
        sheet.details[cells[0].rstrip(": ").lower()] = cells[-1] if len(cells) > 1 else ""
    else:
        sheet.rows.append(Row(line, tuple(cells)))


def _shown(cell: object) -> str:
    if isinstance(cell, float) and math.isfinite(cell):
        return repr(cell)
    return str(cell).strip()
