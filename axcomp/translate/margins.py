"""What stands between and beside the statements: comments and blank lines, from the source to the C."""

from __future__ import annotations

import ast
from collections.abc import Callable

from .scopes import Block
from .source import Module
from .writer import Writer


class Margins:
    """Follows one function from its first line to its last; each comment is written once.

    ``line``: the last one that needs nothing more, that of the docstring or of the function's head.
    """

    def __init__(self, module: Module, writer: Writer, line: int) -> None:
        self._module, self._writer, self._last = module, writer, line

    def lead_in(self, line: int, declare: Callable[[], None], *, first: bool = False) -> None:
        """Write what stands above a statement that begins at ``line``.

        ``declare`` writes the declarations that belong above it: behind the blank line, ahead of the comments.
        ``first``: the statement is the first of its block, no blank line goes above it.
        """
        pending: list[str] = []
        declared = False
        for number in range(self._last + 1, line + 1):
            note = self._module.comments.get(number)
            if pending and (number == line or not note):
                self._writer.remark("\n".join(pending))
                pending = []
            if self._module.is_blank(number) and not first:
                self._writer.blank()
            if (note and note.alone) or number == line:
                if not declared:
                    declare()
                declared, first = True, False
            if note and note.alone and number < line:
                pending.append(note.text)
        self._last = max(self._last, line - 1)

    def notes(self, node: ast.stmt) -> str:
        """Take the comments on a simple statement's own lines."""
        return self._take(node.lineno, node.end_lineno or node.lineno)

    def head_notes(self, node: ast.stmt, body: Block) -> str:
        """Take the comments on the head of a compound statement."""
        line = body[0].lineno - 1
        while line > node.lineno and self._is_open(line):
            line -= 1
        return self._take(node.lineno, max(line, node.lineno))

    def above(self, line: int) -> str:
        """Take the comments above an ``else`` or ``elif``, which go inside its block."""
        return self._take(self._last + 1, line - 1)

    def else_line(self, node: ast.If) -> int:
        """Return the line of ``else:``, 0 where ``elif`` or nothing follows."""
        if not node.orelse:
            return 0
        lines = range(node.orelse[0].lineno, node.body[-1].end_lineno or 0, -1)
        return next((line for line in lines if self._module.text_of(line).startswith("else")), 0)

    def else_notes(self, line: int) -> str:
        """Take the comment behind ``else:``."""
        return self._take(line, line)

    def tail(self, column: int) -> None:
        """Write the comments that end a block whose statements begin at ``column``."""
        line, end = self._last + 1, self._last
        while line <= self._module.last_line and self._is_open(line):
            note = self._module.comments.get(line)
            if note and note.column < column:
                break
            end = line if note else end
            line += 1
        if end > self._last:
            self.lead_in(end + 1, lambda: None)

    def _take(self, first: int, last: int) -> str:
        self._last = max(self._last, last)
        comments = self._module.comments
        return "\n".join(comments[line].text for line in range(first, last + 1) if line in comments)

    def _is_open(self, line: int) -> bool:
        return self._module.is_blank(line) or self._module.text_of(line).startswith("#")
