"""What can be changed in a Python source, one change at a time."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import NamedTuple


class Mutant(NamedTuple):
    """One change of a source: bytes from ``start`` to ``end`` become ``new``."""

    line: int
    start: int
    end: int
    old: str
    new: str

    def of(self, source: bytes) -> bytes:
        """Return the changed source."""
        return source[: self.start] + self.new.encode() + source[self.end :]

    def column(self, source: bytes) -> int:
        """Return the column of the change in bytes, from 1."""
        return self.start - source.rfind(b"\n", 0, self.start)

    def __str__(self) -> str:
        old = " ".join(self.old.split())
        return f"{old if len(old) <= 60 else old[:57] + '...'} -> {self.new}"


COMPARED = {
    ast.Lt: ("<", "<="),
    ast.LtE: ("<=", "<"),
    ast.Gt: (">", ">="),
    ast.GtE: (">=", ">"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
COMPUTED = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "*"),
    ast.Mod: ("%", "*"),
    ast.Pow: ("**", "*"),
}
JOINED = {ast.And: ("and", "or"), ast.Or: ("or", "and")}


class _Places:
    """Where the nodes of a source stand in its bytes."""

    def __init__(self, source: bytes) -> None:
        self.source = source
        self.begins = [0]
        for line in source.splitlines(keepends=True):
            self.begins.append(self.begins[-1] + len(line))

    def start(self, node: ast.expr | ast.stmt) -> int:
        return self.begins[node.lineno - 1] + node.col_offset

    def end(self, node: ast.expr | ast.stmt) -> int:
        return self.begins[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)

    def whole(self, node: ast.expr | ast.stmt, new: str) -> Mutant:
        start, end = self.start(node), self.end(node)
        return Mutant(node.lineno, start, end, self.source[start:end].decode(), new)

    def between(self, left: ast.expr, right: ast.expr, signs: tuple[str, str]) -> Iterator[Mutant]:
        """Yield the change of the operator between two operands."""
        start = self.source.find(signs[0].encode(), self.end(left), self.start(right))
        if start >= 0:
            end = start + len(signs[0])
            text = self.source[self.start(left) : self.end(right)].decode()
            line = self.source.count(b"\n", 0, start) + 1
            yield Mutant(line, start, end, f"{signs[0]} in {text}", signs[1])


def mutants(source: bytes) -> list[Mutant]:
    """Return all changes of a source: comparison, arithmetic, constant ± 1, and/or, not, return value, statement."""
    places = _Places(source)
    return [change for node in _executed(ast.parse(source)) for change in _changes(node, places)]


def _executed(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what is run: no annotations, decorators, texts or what only type checkers read."""
    if isinstance(node, ast.JoinedStr) or (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"):
        return
    yield node
    for name, value in ast.iter_fields(node):
        if name not in {"annotation", "returns", "decorator_list"}:
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from _executed(child)


def _changes(node: ast.AST, places: _Places) -> Iterator[Mutant]:
    match node:
        case ast.Compare():
            for left, sign, right in zip([node.left, *node.comparators], node.ops, node.comparators, strict=False):
                yield from places.between(left, right, COMPARED[type(sign)])
        case ast.BinOp() if type(node.op) in COMPUTED:
            yield from places.between(node.left, node.right, COMPUTED[type(node.op)])
        case ast.BoolOp():
            for left, right in zip(node.values, node.values[1:], strict=False):
                yield from places.between(left, right, JOINED[type(node.op)])
        case ast.UnaryOp(op=ast.Not() | ast.USub()):
            yield places.whole(node, ast.unparse(node.operand))
        case ast.Constant(value=bool()):
            yield places.whole(node, str(not node.value))
        case ast.Constant(value=int() | float()):
            yield places.whole(node, repr(node.value + 1))
            yield places.whole(node, repr(node.value - 1))
        case ast.If() | ast.IfExp() | ast.While() if isinstance(node.test, ast.Name | ast.Attribute | ast.Call):
            yield places.whole(node.test, f"(not {ast.unparse(node.test)})")
        case ast.Return(value=ast.expr()) if not isinstance(node.value, ast.Constant):
            yield places.whole(node, "return None")
        case ast.AugAssign() | ast.Raise() | ast.Continue() | ast.Break() | ast.Expr(value=ast.Call()):
            yield places.whole(node, "pass")
        case ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            yield places.whole(node, "pass")


def compiles(source: bytes) -> bool:
    """Tell whether a changed source can be imported at all: what cannot proves nothing."""
    try:
        compile(source, "mutant", "exec")
    except (SyntaxError, ValueError):
        return False
    return True
