"""Lines of C: indentation, comments, and the wrapping of long lines."""

from __future__ import annotations

import re
from collections.abc import Sequence

WIDTH = 120
_STEP = "    "
_BREAK = re.compile(r"(?<=[,;]) | (?=(&&|\|\||[-+*/?:&|]|<<|>>|<=|>=|==|!=|<|>) )")
_TRUTH = re.compile(r"\b(True|False)\b")
_BINDING = ("?", ":", "||", "&&", "==", "!=", "<", ">", "<=", ">=", "|", "&", "<<", ">>", "+", "-", "*", "/")
"""Operators, weakest first: a line is broken at a weak one."""
UNBROKEN = "\N{NO-BREAK SPACE}"
"""A space where no line is broken."""


def comment(text: str) -> list[str]:
    """Return a text as the lines of one C comment, truth values and code quoted as C has them.

    What C would read as the end of the comment is taken apart.
    """
    safe = text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").replace("``", "`")
    safe = _TRUTH.sub(lambda match: match[0].lower(), safe)
    lines = [line.rstrip() for line in safe.splitlines()]
    if len(lines) <= 1:
        return [f"/* {safe.strip()} */"]
    return [f"/* {lines[0]}", *(f" * {line}".rstrip() for line in lines[1:]), " */"]


class Writer:
    """Collects the lines of a C file; ``depth``: blocks around the next line."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.depth = 0

    def write(self, text: str, note: str = "") -> None:
        """Write one line of code, wrapped if it is long, with a comment behind it, or above it where it is too long."""
        start = _STEP * self.depth
        behind = f"  {comment(note)[0]}" if note else ""
        if note and ("\n" in note or len(start + text + behind) > WIDTH):
            self.remark(note)
            behind = ""
        *lines, last = wrap(start + text, len(start))
        self.lines += [*lines, last + behind]

    def remark(self, text: str) -> None:
        """Write a comment on lines of its own."""
        self.lines += [f"{_STEP * self.depth}{line}" for line in comment(text)]

    def blank(self) -> None:
        """Write an empty line, but no second one and none at the beginning."""
        if self.lines and self.lines[-1]:
            self.lines.append("")

    def extend(self, lines: Sequence[str]) -> None:
        """Write lines as they are."""
        self.lines += lines

    def text(self) -> str:
        """Return the file."""
        return "\n".join(self.lines).rstrip() + "\n"


def wrap(line: str, indent: int) -> list[str]:
    """Break a long line where its parentheses are shallowest and its operators weakest; the rest is indented twice."""
    start = indent + 2 * len(_STEP)
    lines = []
    while len(line) > WIDTH:
        breaks = [match for match in _BREAK.finditer(line) if start < match.start() <= WIDTH]
        if not breaks:
            break
        best = min(breaks, key=lambda match: _cost(line, match)).start()
        lines.append(line[:best])
        line = " " * start + line[best + 1 :]
    return [part.replace(UNBROKEN, " ") for part in (*lines, line)]


def _cost(line: str, match: re.Match[str]) -> tuple[int, int, int]:
    """Return how bad it is to break a line here: in parentheses, at a strong operator, early."""
    column, operator = match.start(), match.group(1)
    depth = line.count("(", 0, column) - line.count(")", 0, column)
    return depth, _BINDING.index(operator) if operator else -1, -column
