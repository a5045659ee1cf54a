"""Etalon exchange files of the volumetric compensation (manual 003, 6.3.3).

``[NAME]``, then ``VALUE = x`` or ``Gridpoints = { position value … }`` with one pair a line; the position is that of
the axis the parameter's name ends in. ``//`` begins a comment, also right behind a value. ``[HEADER]`` holds free text;
any other section that is no parameter is passed over. Numbers may have decimal commas, lines and cells quotes.
Values are in mm and rad, positions in mm and °.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice

from ..model import PARAMETERS
from .findings import Findings
from .volumetric_blocks import ELISIONS, ParameterBlock, check_values, note_elision, numbers, regular_rows

_FREE_TEXT = "HEADER"
_PLAIN = str.maketrans(";", " ", '"')


def read_etalon(text: str, file: str, findings: Findings) -> list[ParameterBlock]:
    """Return the blocks of a file, one a parameter; ``findings`` grows by what is wrong. Never raises on content."""
    reader = _Reader(file, findings)
    lines = text.split("\n")
    numbered = enumerate(lines, 1)
    for line, written in numbered:
        if count := reader.take_pairs(lines, line):
            next(islice(numbered, count - 1, count - 1), None)
            continue
        content = written.partition("//")[0].translate(_PLAIN).strip()
        if content:
            reader.take(content, line)
    return reader.finish()


class _Reader:
    """Where the reader stands: in which section, and whether between braces."""

    def __init__(self, file: str, findings: Findings) -> None:
        self._file = file
        self._findings = findings
        self._blocks: dict[str, ParameterBlock] = {}
        self._name = _FREE_TEXT
        self._block = ParameterBlock(file, 0, (), ())
        self._has_records = False
        self._brace_expected = False
        self._in_braces = False
        self._line = 0

    def take_pairs(self, lines: Sequence[str], line: int) -> int:
        """Take the lines from one on that are pairs of numbers between braces; return how many these are."""
        block, arguments = self._block, (self._name[-1:],)
        if not self._in_braces or (block.rows and block.arguments != arguments):
            return 0
        rows = regular_rows(lines, line - 1, 2)
        if rows:
            self._line = line + len(rows) - 1
            self._has_records = True
            block.arguments = arguments
            block.take(rows, line)
        return len(rows)

    def take(self, content: str, line: int) -> None:
        """Take a line without comment and outer blanks."""
        self._line = line
        if content.startswith("["):
            self._end_section()
            self._begin_section(content)
        elif self._name not in PARAMETERS:
            return
        elif content in ELISIONS:
            note_elision(content, self._file, line, self._findings)
        elif self._in_braces:
            self._take_pair(content)
        elif self._brace_expected and content.startswith("{"):
            self._open_braces(content)
        else:
            self._take_assignment(content)

    def finish(self) -> list[ParameterBlock]:
        """Return the parameters that have records."""
        self._end_section()
        for block in self._blocks.values():
            check_values(block, self._findings)
        return [block for block in self._blocks.values() if block.rows]

    def _begin_section(self, content: str) -> None:
        name, closed, rest = content[1:].partition("]")
        self._name = name.strip().upper()
        if (not closed or rest.strip()) and self._name in PARAMETERS:
            self._note("AXC-SYNTAX", f"A section is [NAME] alone, not {content!r}; it is read as [{self._name}].")
        self._block = ParameterBlock(self._file, self._line, (), (self._name,))
        self._has_records = False
        if self._name not in PARAMETERS:
            if self._name != _FREE_TEXT:
                self._note("AXC-SECTION", f"[{self._name}] is no parameter; it is passed over.")
        elif self._name in self._blocks:
            self._note("70469", f"[{self._name}] is there twice; the compensation stays off.")
        else:
            self._blocks[self._name] = self._block

    def _end_section(self) -> None:
        if self._in_braces or self._brace_expected:
            missing = "}" if self._in_braces else "{"
            self._note("AXC-SYNTAX", f"{missing} is missing in [{self._name}]; the records up to here are taken.")
        if self._blocks.get(self._name) is self._block and not self._has_records:
            self._note("AXC-NO-RECORD", f"[{self._name}] has neither VALUE nor Gridpoints; it is not taken.")
        self._in_braces = self._brace_expected = False

    def _take_assignment(self, content: str) -> None:
        key, _, value = (part.strip() for part in content.partition("="))
        if key.upper() == "VALUE":
            self._add((), value.split())
        elif key.upper() == "GRIDPOINTS":
            self._brace_expected = True
            if value.startswith("{"):
                self._open_braces(value)
        else:
            self._note("AXC-SYNTAX", f"{content!r} is neither VALUE = … nor Gridpoints = {{ … }}; it is not taken.")

    def _open_braces(self, content: str) -> None:
        self._in_braces = True
        self._brace_expected = False
        if content[1:].strip():
            self._take_pair(content[1:])

    def _take_pair(self, content: str) -> None:
        pair, closing, _ = content.partition("}")
        cells = pair.split()
        if cells and cells[-1] in ELISIONS:
            note_elision(cells.pop(), self._file, self._line, self._findings)
        if cells:
            self._add((self._name[-1:],), cells)
        if closing:
            self._in_braces = False

    def _add(self, arguments: tuple[str, ...], cells: list[str]) -> None:
        """Add a record to the parameter of this section; what belongs to no parameter leads nowhere."""
        block = self._block
        self._has_records = True
        if block.rows and block.arguments != arguments:
            self._note("70469", f"[{self._name}] has both VALUE and Gridpoints; the compensation stays off.")
            return
        if len(cells) != len(arguments) + 1:
            expected = "a position and a value" if arguments else "one value"
            message = f"[{self._name}] needs {expected} here, not {' '.join(cells)!r}; the compensation stays off."
            self._note("AXC-RECORD", message)
            return
        row = numbers(cells, self._file, self._line, self._name, self._findings)
        if row is not None:
            block.arguments = arguments
            block.take([row], self._line)

    def _note(self, code: str, message: str) -> None:
        self._findings.add(code, self._file, self._line, self._name, message)


def write_etalon(blocks: Iterable[ParameterBlock]) -> str:
    """Return the text of a file with these blocks; it reads back to the same numbers.

    Raises
    ------
    ValueError
        If a parameter depends on anything but its own axis: these files cannot hold that.
    """
    parts = []
    for block in blocks:
        for place, name in enumerate(block.names, len(block.arguments)):
            if block.arguments not in ((), (name[-1],)):
                raise ValueError(f"an Etalon exchange file cannot hold {name} over {', '.join(block.arguments)}")
            if block.arguments:
                points = "".join(f"    {row[0]!r} {row[place]!r}\n" for row in block.rows)
                parts.append(f"[{name}]\nGridpoints = {{\n{points}}}  // end of {name}\n")
            else:
                parts.extend(f"[{name}]\nVALUE = {row[place]!r}\n" for row in block.rows)
    return "\n".join(parts)
