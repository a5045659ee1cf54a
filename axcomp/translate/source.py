"""The kernel's modules as they lie in their folder: syntax trees, comments, blank lines, order of dependency."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .subset import Refusal, RefusedError, Report, TranslationError

RUN_TIME_MODULE = "record"
"""The module that gives the subset its types and intrinsics in Python; C has its own."""

_FOR_TOOLS = re.compile(r"(noqa|type:|pragma:|fmt:|ruff:|mypy:)")


@dataclass(frozen=True)
class Comment:
    """A comment without its ``#``; ``alone``: nothing else is on its line."""

    text: str
    column: int
    alone: bool


class Module:
    """One source file: its name without ``.py``, its path as refusals name it, its syntax.

    ``comments``: by line; those meant for linters are left out.
    """

    def __init__(self, name: str, file: str, text: str) -> None:
        self.name, self.file = name, file
        try:
            self.tree = ast.parse(text)
        except SyntaxError as error:
            raise TranslationError((Refusal(file, error.lineno or 1, f"no Python: {error.msg}"),)) from None
        self._lines = text.splitlines()
        self.comments: dict[int, Comment] = {}
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            note = token.string.lstrip("#").strip()
            if token.type == tokenize.COMMENT and not _FOR_TOOLS.match(note):
                line, column = token.start
                self.comments[line] = Comment(note, column, alone=not token.line[:column].strip())

    def is_blank(self, line: int) -> bool:
        """Return whether nothing stands on a line of the file."""
        return 1 <= line <= len(self._lines) and not self._lines[line - 1].strip()

    def literal(self, node: ast.Constant) -> str:
        """Return a number or truth value as C writes it: a number as it stands in the source, as far as C reads it."""
        if isinstance(node.value, bool):
            return str(node.value).lower()
        line = self._lines[node.lineno - 1].encode()
        text = line[node.col_offset : node.end_col_offset].decode().replace("_", "")
        return repr(node.value) if text[:2] in ("0o", "0O", "0b", "0B", "00") else text

    def text_of(self, line: int) -> str:
        """Return a line without its indentation, empty behind the end."""
        return self._lines[line - 1].strip() if 1 <= line <= len(self._lines) else ""

    @property
    def last_line(self) -> int:
        """Number of the last line."""
        return len(self._lines)

    def imported(self) -> list[ast.ImportFrom]:
        """Return the imports of sibling modules, ``from .records import State``."""
        return [
            node
            for node in self.tree.body
            if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module and node.module != RUN_TIME_MODULE
        ]

    def functions(self) -> list[str]:
        """Return the names of the functions it defines."""
        return [node.name for node in self.tree.body if isinstance(node, ast.FunctionDef)]


def read_modules(folder: Path, exports: Sequence[str]) -> list[Module]:
    """Read the modules that the exported functions need, each behind the ones it imports.

    Raises TranslationError where a file is no Python, an export or an imported module is missing, or modules import
    each other in a ring.
    """
    modules = {
        path.stem: Module(path.stem, str(path), path.read_text(encoding="utf-8"))
        for path in sorted(folder.glob("*.py"))
        if path.stem not in ("__init__", RUN_TIME_MODULE)
    }
    report = Report()
    ordered: list[Module] = []
    open_names: list[str] = []

    def visit(module: Module) -> None:
        if module in ordered:
            return
        open_names.append(module.name)
        for node in module.imported():
            with report.catching(module.file):
                if node.module not in modules:
                    raise RefusedError(node, f"there is no module {node.module} beside this one")
                if node.module in open_names:
                    raise RefusedError(node, f"{node.module} imports this module in turn: modules stand in one order")
                visit(modules[node.module])
        open_names.pop()
        ordered.append(module)

    for export in exports:
        owners = [module for module in modules.values() if export in module.functions()]
        if not owners:
            report.refusals.add(Refusal(str(folder), 1, f"no module here defines the exported function {export}"))
        for module in owners:
            visit(module)
    report.finish()
    return ordered
