"""What can be changed in a C source, one change at a time; formatted as the sources here, every change compiles."""

from __future__ import annotations

import re
from collections.abc import Iterator

from .python_mutants import Mutant

OPERATORS = {
    " < ": " <= ",
    " <= ": " < ",
    " > ": " >= ",
    " >= ": " > ",
    " == ": " != ",
    " != ": " == ",
    " && ": " || ",
    " || ": " && ",
    " + ": " - ",
    " - ": " + ",
    " * ": " / ",
    " += ": " -= ",
}
OPERATOR = re.compile("|".join(re.escape(sign) for sign in OPERATORS))
NUMBER = re.compile(r"(?<![\w.])\d+(?![\w.])")
NOT = re.compile(r"!(?=[\w(])")
STATEMENT = re.compile(r"^ +((?:\w+\(.*\)|[\w.>\[\]*-]+ [-+|&]?= .*|break|continue);)$")
UNSEEN = re.compile(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|^ *#[^\n]*", re.DOTALL | re.MULTILINE)


def mutants(source: bytes) -> list[Mutant]:
    """Return all changes of a source: comparison, arithmetic, constant ± 1, and/or, not, removed statement."""
    text = source.decode("ascii", errors="replace").replace("\r", " ")
    seen = UNSEEN.sub(lambda match: re.sub(r"[^\n]", "~", match.group()), text)
    begin, found = 0, []
    for number, line in enumerate(seen.split("\n"), 1):
        for start, end, new in _changes(line):
            a, b = begin + start, begin + end
            context = text[begin : begin + len(line)].strip()
            found.append(Mutant(number, a, b, f"{text[a:b].strip()} in {context}", new))
        begin += len(line) + 1
    return found


def _changes(line: str) -> Iterator[tuple[int, int, str]]:
    for match in OPERATOR.finditer(line):
        yield *match.span(), OPERATORS[match.group()]
    if re.match(r" +\S", line):
        for match in NUMBER.finditer(line):
            yield *match.span(), str(int(match.group()) + 1)
            if int(match.group()) > 0:
                yield *match.span(), str(int(match.group()) - 1)
        for match in NOT.finditer(line):
            yield *match.span(), ""
        for match in STATEMENT.finditer(line):
            yield *match.span(1), ";"
