"""ISG CSV parameter files of the volumetric compensation (manual 003, 6.3.2).

A header names the columns, axes and parameters in any order; the records follow, one a line. Columns are separated by
blanks, tabs or semicolons; commas are decimal ones, or separate too where the columns are not enough without. Cells may
be quoted. ``//`` begins a comment; a line that begins with ``#`` ends the block, and the next
line is a new header. Values are in mm and rad, positions of axes in mm and °.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import islice

from ..model import LETTERS
from .findings import Findings
from .volumetric_blocks import ELISIONS, ParameterBlock, check_name, check_values, note_elision, numbers, regular_rows

_SEPARATORS, _COMMAS = str.maketrans(";", " "), str.maketrans(",;", "  ")
_CELL = re.compile(r'"([^"]*)"|([^\s;"]+)')
_CELL_OR_COMMA = re.compile(r'"([^"]*)"|([^\s;,"]+)')


def read_isg_csv(text: str, file: str, findings: Findings) -> list[ParameterBlock]:
    """Return the blocks of a file that have records; ``findings`` grows by what is wrong. Never raises on content."""
    headers: list[_Columns] = []
    columns: _Columns | None = None
    lines = text.split("\n")
    numbered = enumerate(lines, 1)
    for line, written in numbered:
        if columns is not None and (rows := regular_rows(lines, line - 1, columns.width)):
            columns.take_all(rows, line)
            next(islice(numbered, len(rows) - 1, len(rows) - 1), None)
            continue
        content = written.partition("//")[0]
        cells = _split(content, at_commas=True) if columns is None else columns.split(content)
        if not cells:
            continue
        if cells[0].startswith("#"):
            columns = None
            continue
        if cells[-1] in ELISIONS:
            note_elision(cells.pop(), file, line, findings)
            if not cells:
                continue
        if columns is None:
            columns = _Columns(content, [cell.upper() for cell in cells], file, line, findings)
            headers.append(columns)
        else:
            columns.take(cells, line, findings)
    for header in headers:
        if not header.has_records:
            message = "There is no record below this header; its columns are not taken."
            findings.add("AXC-NO-RECORD", file, header.block.line, " ".join(header.block.names), message)
        check_values(header.block, findings)
    return [header.block for header in headers if header.block.rows]


def _split(content: str, at_commas: bool) -> list[str]:
    if '"' not in content:
        return content.translate(_COMMAS if at_commas else _SEPARATORS).split()
    return [quoted.strip() or plain for quoted, plain in (_CELL_OR_COMMA if at_commas else _CELL).findall(content)]


class _Columns:
    """A header: which column of its records goes where."""

    def __init__(self, content: str, labels: list[str], file: str, line: int, findings: Findings) -> None:
        self.width = len(labels)
        self._decimal_commas = ";" in content or "\t" in content
        self._at_commas = "," in content and not self._decimal_commas
        arguments: dict[str, int] = {}
        names: dict[str, int] = {}
        for place, label in enumerate(labels):
            if label in arguments or label in names:
                message = f"{label} has two columns; the compensation stays off."
                findings.add("70469", file, line, label, message, group="")
            elif label in LETTERS:
                arguments[label] = place
            elif check_name(label, file, line, findings):
                names[label] = place
        self._places = [*arguments.values(), *names.values()]
        self._as_written = self._places == list(range(self.width))
        self.block = ParameterBlock(file, line, tuple(arguments), tuple(names))
        self.has_records = False

    def split(self, content: str) -> list[str]:
        """Return the cells of a record, of whose commas the header or else their number says what they are."""
        if self._at_commas:
            return _split(content, at_commas=True)
        cells = _split(content, at_commas=False)
        if "," not in content or self._decimal_commas:
            return cells
        complete = len(cells) == self.width and not any(cell.startswith(",") or cell.endswith(",") for cell in cells)
        return cells if complete else _split(content, at_commas=True)

    def take(self, cells: list[str], line: int, findings: Findings) -> None:
        """Add a record, or note what is wrong with it."""
        block = self.block
        self.has_records = True
        if len(cells) != self.width:
            message = f"The record has {len(cells)} columns, its header {self.width}; the compensation stays off."
            findings.add("AXC-RECORD", block.file, line, "", message)
            return
        row = numbers(cells, block.file, line, "", findings)
        if row is not None:
            self.take_all([row], line)

    def take_all(self, rows: list[list[float]], line: int) -> None:
        """Add records that stand in lines from ``line`` on."""
        self.has_records = True
        self.block.take(rows if self._as_written else [[row[place] for place in self._places] for row in rows], line)


def write_isg_csv(blocks: Iterable[ParameterBlock]) -> str:
    """Return the text of a file with these blocks; it reads back to the same numbers."""
    parts = []
    for block in blocks:
        lines = ["\t".join((*block.arguments, *block.names)), *("\t".join(map(repr, row)) for row in block.rows)]
        parts.append("\n".join(lines) + "\n")
    return "#\n".join(parts)
