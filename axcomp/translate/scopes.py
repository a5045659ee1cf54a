"""Locals: where C declares each, and whether each has a value before it is read.

Python knows a local in the whole function, C from its declaration to the end of the block. A local is declared by its
first assignment where that comes before every other mention in the block, else without a value ahead of the statement
that mentions it first.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from functools import lru_cache

from .effects import targets
from .subset import RefusedError

Block = list[ast.stmt]


def blocks_of(node: ast.stmt) -> list[Block]:
    """Return the blocks inside a compound statement; none for a simple one."""
    if isinstance(node, ast.If | ast.While | ast.For):
        return [block for block in (node.body, node.orelse) if block]
    return []


@lru_cache(maxsize=10_000)
def _names(node: ast.AST) -> frozenset[str]:
    return frozenset(part.id for part in ast.walk(node) if isinstance(part, ast.Name))


def mentions(node: ast.AST, name: str) -> bool:
    """Whether ``name`` is read or assigned anywhere in ``node``."""
    return name in _names(node)


def stores(node: ast.AST, name: str) -> bool:
    """Whether ``name`` itself is assigned anywhere in ``node``."""
    return mentions(node, name) and any(part.id == name for part in names_in(node, ast.Store))


def names_in(node: ast.AST, context: type[ast.expr_context]) -> list[ast.Name]:
    """Return the names that are loaded or stored in ``node``, in the order of the walk."""
    return [part for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, context)]


def _is_first_assignment(node: ast.stmt, name: str) -> bool:
    if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None or mentions(node.value, name):
        return False
    return all(isinstance(target, ast.Name) and target.id == name for target in targets(node))


@dataclass
class Declarations:
    """Where the locals of a function are declared: by assignments, or without a value ahead of statements."""

    by: set[ast.stmt] = field(default_factory=set)
    ahead: dict[ast.stmt, list[str]] = field(default_factory=dict)

    def place(self, name: str, block: Block) -> None:
        """Decide for one local, given the body of its function."""
        users = [node for node in block if mentions(node, name)]
        if _stands_alone(name, block):
            self._place_in(name, users)
            return
        inner = [part for part in blocks_of(users[0]) if any(mentions(node, name) for node in part)]
        if len(users) == 1 and len(inner) == 1 and not _in_header(users[0], name):
            self.place(name, inner[0])
        else:
            self.ahead.setdefault(users[0], []).append(name)

    def _place_in(self, name: str, users: Block) -> None:
        for node in users:
            if _is_first_assignment(node, name):
                self.by.add(node)
                return
            for part in blocks_of(node):
                self._place_in(name, [inner for inner in part if mentions(inner, name)])


def _stands_alone(name: str, block: Block) -> bool:
    """Whether no value of ``name`` comes into the block from outside, or from one statement of it to another."""
    for node in block:
        if not mentions(node, name):
            continue
        if _is_first_assignment(node, name):
            return True
        if _in_header(node, name) or not all(_stands_alone(name, part) for part in blocks_of(node)):
            return False
    return True


def _in_header(node: ast.stmt, name: str) -> bool:
    """Whether the statement itself mentions ``name``, not only the blocks inside it."""
    return any(mentions(part, name) for part in ast.iter_child_nodes(node) if isinstance(part, ast.expr))


class Flow:
    """Follows the statements of a function as they may be run; refuses reads without a value and dead statements."""

    def __init__(self, function: ast.FunctionDef, locals_: set[str]) -> None:
        self._locals = locals_
        self._breaks: list[list[set[str]]] = []
        self.refused: list[RefusedError] = []
        self.ends = self._block(function.body, set()) is not None
        """Whether the end of the function can be reached."""

    def _block(self, block: Block, known: set[str] | None) -> set[str] | None:
        """Return the locals that have a value behind the block; None if its end is never reached."""
        for node in block:
            if known is None:
                self.refused.append(RefusedError(node, "this statement is never reached"))
                return None
            known = self._statement(node, known)
        return known

    def _statement(self, node: ast.stmt, known: set[str]) -> set[str] | None:
        match node:
            case ast.If():
                self._read(node.test, known)
                ends = [self._block(node.body, set(known)), self._block(node.orelse, set(known))]
                return _common([end for end in ends if end is not None])
            case ast.While():
                self._read(node.test, known)
                return self._loop(node.body, known, known, endless=_is_true(node.test))
            case ast.For():
                self._read(node.iter, known)
                inside = known | {name.id for name in names_in(node.target, ast.Store)}
                return self._loop(node.body, inside, known, endless=False)
            case ast.Return():
                self._read(node, known)
                return None
            case ast.Break():
                if self._breaks:
                    self._breaks[-1].append(set(known))
                return None
            case ast.Continue():
                return None
        self._read(node, known)
        if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            self._check(node.target, known)
        return known | {name.id for name in names_in(node, ast.Store)}

    def _loop(self, body: Block, inside: set[str], before: set[str], *, endless: bool) -> set[str] | None:
        self._breaks.append([])
        self._block(body, set(inside))
        breaks = self._breaks.pop()
        return _common(breaks) if endless else set(before)

    def _read(self, node: ast.AST, known: set[str]) -> None:
        for name in names_in(node, ast.Load):
            self._check(name, known)

    def _check(self, name: ast.Name, known: set[str]) -> None:
        if name.id in self._locals and name.id not in known:
            self.refused.append(RefusedError(name, f"{name.id} may have no value here"))


def _common(ends: list[set[str]]) -> set[str] | None:
    return set.intersection(*ends) if ends else None


def _is_true(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is True
