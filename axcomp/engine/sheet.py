"""Tables as instruments and spreadsheets write them, whatever is in them: rows of cells, each with its line.

Text: UTF-8, UTF-16 with its mark or Latin-1; cells are separated by semicolons, tabs, commas or blanks, or as a line
``sep=;`` says, and may be quoted; ``#`` and ``//`` begin a comment. ``# axis: X``, or ``Axis: X`` above the table, is a
detail; where one comes again behind rows, another table begins. Workbooks (``.xlsx``) have a table on each sheet that
is not empty; they need openpyxl.
"""

from __future__ import annotations

import csv
import math
import re
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..lists import decode

WORKBOOKS = (".xlsx", ".xlsm")
_OLD = (".xls", ".ods", ".xlsb")
_SEPARATOR = re.compile(r"\s*\"?sep=(\\t|.)\"?\s*\Z", re.I)
_DETAIL = re.compile(r"\s*(?:#|//)\s*([^\W\d][\w ]*?)\s*[:=]\s*(.*?)\s*\Z")
_PLAIN_DETAIL = re.compile(r"\s*([^\W\d][\w ]*?)\s*[:=][;,\t]?\s*([^;\t]*?)[\s;,]*\Z")
_COMMENT = re.compile(r'((?:"[^"]*"|[^"])*?)(?:#|//)')
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:([.,'])\d{3})(?:\1\d{3})*([.,])\d+\Z")


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


def read_sheets(path: Path, is_header: Callable[[Sequence[str]], bool] = lambda _: True) -> tuple[Sheet, ...]:
    """Return the tables of a file that have rows; SheetError if it cannot be read.

    ``is_header`` tells of the cells of a line whether it names columns: details without ``#`` stand above such a line.
    """
    suffix = path.suffix.lower()
    if suffix in _OLD:
        raise SheetError(str(path), 0, f"Workbooks are read as .xlsx, not as {suffix}: save it so.")
    found = _of_workbook(path) if suffix in WORKBOOKS else _of_text(path, is_header)
    return tuple(sheet for sheet in found if sheet.rows)


def _of_text(path: Path, is_header: Callable[[Sequence[str]], bool]) -> Iterator[Sheet]:
    lines = _text(path).split("\n")
    separator: str | None = None
    known = headed = False
    sheet = Sheet(str(path))
    for line, written in enumerate(lines, 1):
        if not known and (said := _SEPARATOR.match(written)):
            separator, known = said[1].replace("\\t", "\t"), True
            continue
        if detail := _DETAIL.match(written):
            name = detail[1].lower()
            if sheet.rows and name in sheet.details and sheet.details[name] != detail[2]:
                yield sheet
                sheet = Sheet(str(path), details=dict(sheet.details))
            sheet.details[name] = detail[2]
        cut = _COMMENT.match(written)
        content = (cut[1] if cut else written).strip()
        if not content:
            continue
        if not known:
            separator, known = next((one for one in ";\t," if one in content), None), True
        cells = _cells(content, separator)
        plain = _PLAIN_DETAIL.match(content)
        if not headed and plain and not is_header(cells):
            sheet.details[plain[1].lower()] = plain[2].strip('" ')
            known = False
            continue
        headed = True
        if any(cells):
            sheet.rows.append(Row(line, cells))
    yield sheet


def _text(path: Path) -> str:
    try:
        text = decode(path.read_bytes())
    except OSError as error:
        raise SheetError(str(path), 0, f"The file cannot be read: {error.strerror or error}.") from None
    if text is None:
        raise SheetError(str(path), 0, "The file is no text.")
    return text


def _cells(content: str, separator: str | None) -> tuple[str, ...]:
    """Return the cells of a line; an empty one at its end is none."""
    if separator is None:
        return tuple(content.split())
    if '"' in content:
        cells = next(csv.reader([content], delimiter=separator, skipinitialspace=True), [])
    else:
        cells = content.split(separator)
    found = [cell.strip() for cell in cells]
    if found and not found[-1]:
        found.pop()
    return tuple(found)


def _of_workbook(path: Path) -> Iterator[Sheet]:
    try:
        import openpyxl
    except ModuleNotFoundError:
        sentence = "Workbooks need openpyxl: pip install 'axcomp[workbench]'."
        raise SheetError(str(path), 0, sentence) from None
    try:
        with warnings.catch_warnings(), path.open("rb") as file:
            warnings.simplefilter("ignore")  # of styles and the like that are not read
            book = openpyxl.load_workbook(file, read_only=True, data_only=True)
            pages = {page.title: list(page.iter_rows(values_only=True)) for page in book.worksheets}
            book.close()
    except OSError as error:
        raise SheetError(str(path), 0, f"The file cannot be read: {error.strerror or error}.") from None
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
