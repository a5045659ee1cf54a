"""What a call changes: parameters written through, call graph, and the order of evaluation that C leaves open.

All of it is read from the syntax: a name is written through if a field or element of it is assigned, if it goes to a
function that writes through its parameter, or if an alias of it is written through.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from .program import Function, Program
from .source import Module
from .subset import RefusedError


def root(node: ast.expr) -> str:
    """Return the name a path begins with (``state`` of ``state.axis[i].ring``), empty if it is no path."""
    while isinstance(node, ast.Attribute | ast.Subscript):
        node = node.value
    return node.id if isinstance(node, ast.Name) else ""


def targets(node: ast.AST) -> list[ast.expr]:
    """Return what a statement assigns to."""
    if isinstance(node, ast.Assign):
        return node.targets
    return [node.target] if isinstance(node, ast.AugAssign | ast.AnnAssign) else []


@dataclass
class _Facts:
    """What one function does by itself, and what it inherits from those it calls.

    ``calls``: its calls of other functions, with their parameters' names and the roots of the arguments; ``aliases``:
    locals that are assigned from a path, with its root; ``written``: names it writes through; ``reads`` and ``writes``:
    fields that it, or a function it calls, loads and stores.
    """

    calls: list[tuple[Function, list[tuple[str, str]]]]
    aliases: list[tuple[str, str]]
    written: set[str]
    reads: set[str]
    writes: set[str]

    def grow(self, all_facts: dict[str, _Facts]) -> bool:
        """Add what the functions it calls are known to do; True if there was something new."""
        before = len(self.written) + len(self.reads) + len(self.writes)
        for callee, arguments in self.calls:
            facts = all_facts[callee.c_name]
            self.written.update(origin for name, origin in arguments if name in facts.written)
            self.reads |= facts.reads
            self.writes |= facts.writes
        for name, origin in reversed(self.aliases):
            if name in self.written:
                self.written.add(origin)
        self.written.discard("")
        return len(self.written) + len(self.reads) + len(self.writes) > before


class Effects:
    """Effects of all functions of a program; ``written_fields``: all that are assigned anywhere."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._facts = {function.c_name: self._facts_of(function) for function in program.functions()}
        self.written_fields: set[str] = set().union(*(facts.writes for facts in self._facts.values()))
        grown = True
        while grown:
            grown = False
            for facts in self._facts.values():
                grown = facts.grow(self._facts) or grown

    def _facts_of(self, function: Function) -> _Facts:
        facts = _Facts([], [], set(), _fields(function.node), set())
        for node in ast.walk(function.node):
            for target in targets(node):
                facts.writes |= _fields(target, ast.Store)
                if not isinstance(target, ast.Name):
                    facts.written.add(root(target))
                elif isinstance(node, ast.Assign | ast.AnnAssign) and node.value:
                    facts.aliases.append((target.id, root(node.value)))
        for call, callee in self._calls(function.module, function.node):
            pairs = zip(callee.parameters, call.args, strict=False)
            facts.calls.append((callee, [(parameter, root(argument)) for parameter, argument in pairs]))
        return facts

    def _calls(self, module: Module, node: ast.AST) -> Iterator[tuple[ast.Call, Function]]:
        """Yield every call of a function of the program in ``node``, with that function."""
        for part in ast.walk(node):
            if isinstance(part, ast.Call) and isinstance(part.func, ast.Name):
                callee = self._program.names[module.name].get(part.func.id)
                if isinstance(callee, Function):
                    yield part, callee

    def written(self, function: Function) -> set[str]:
        """Return the parameters and aliases that a function writes through."""
        return self._facts[function.c_name].written

    def callees(self, function: Function) -> list[Function]:
        """Return the functions that a function calls, each once."""
        return list(dict.fromkeys(callee for callee, _ in self._facts[function.c_name].calls))

    def changes(self, module: Module, node: ast.AST) -> ast.Call | None:
        """Return a call in ``node`` that changes one of its arguments, None if there is none."""
        changing = (call for call, callee in self._calls(module, node) if self.written(callee) & set(callee.parameters))
        return next(changing, None)

    def reached_from(self, functions: Iterable[Function]) -> set[str]:
        """Return the names in C of functions and of all they call, directly or through others."""
        found: set[str] = set()
        waiting = list(functions)
        while waiting:
            function = waiting.pop()
            if function.c_name not in found:
                found.add(function.c_name)
                waiting += self.callees(function)
        return found

    def callees_first(self, functions: Sequence[Function]) -> list[Function]:
        """Return the functions of a module, each behind those of them that it calls, else in the order given."""
        ordered: list[Function] = []

        def visit(function: Function) -> None:
            if function not in ordered:
                called = self.callees(function)
                for callee in functions:
                    if callee in called:
                        visit(callee)
                ordered.append(function)

        for function in functions:
            visit(function)
        return ordered

    def check_recursion(self, function: Function) -> None:
        """Refuse a function that calls itself, directly or through others: a step has a bounded stack."""
        if function.c_name in self.reached_from(self.callees(function)):
            raise RefusedError(function.node, f"{function.name} calls itself: the kernel has no recursion")

    def check_order(self, module: Module, node: ast.stmt) -> None:
        """Refuse what Python evaluates in one order and C in any: a change beside another change or a read."""
        if not any(self.changes(module, part) for part in _own_expressions(node)):
            return
        match node:
            case ast.Assign(targets=[target], value=value):
                self._check_siblings(module, [*_indices(target), value])
            case ast.AugAssign(target=target, value=value):
                self._check_siblings(module, [target, value])
        for part in _own_expressions(node):
            for inner in ast.walk(part):
                match inner:
                    case ast.BinOp(left=left, right=right):
                        self._check_siblings(module, [left, right])
                    case ast.Compare(left=left, comparators=others):
                        self._check_siblings(module, [left, *others])
                        call = self.changes(module, inner) if len(others) > 1 else None
                        if call:
                            name = ast.unparse(call.func)
                            raise RefusedError(call, f"{name} changes its arguments: keep it out of a chain")
                    case ast.Call(args=arguments):
                        self._check_siblings(module, arguments)
                    case ast.Subscript(value=value, slice=index):
                        self._check_siblings(module, [value, index])

    def _check_siblings(self, module: Module, siblings: list[ast.expr]) -> None:
        for one in siblings:
            call = self.changes(module, one)
            if call and any(self._minds(module, other, one) for other in siblings if other is not one):
                raise RefusedError(
                    call,
                    f"{ast.unparse(call.func)} changes its arguments, and C may evaluate it before or after the rest:"
                    " give the call a statement of its own",
                )

    def _minds(self, module: Module, other: ast.expr, changing: ast.expr) -> bool:
        """Whether ``other`` also changes something, or reads a field that ``changing`` may write."""
        if self.changes(module, other):
            return True
        reads = _fields(other) | _fields(other, ast.Store)
        for _, callee in self._calls(module, other):
            reads |= self._facts[callee.c_name].reads
        return any(reads & self._facts[callee.c_name].writes for _, callee in self._calls(module, changing))


_ELEMENT = "[]"


def _fields(node: ast.AST, context: type[ast.expr_context] = ast.Load) -> set[str]:
    """Return the fields that are loaded or stored in ``node`` by their names; one word stands for all elements."""
    return {
        part.attr if isinstance(part, ast.Attribute) else _ELEMENT
        for part in ast.walk(node)
        if isinstance(part, ast.Attribute | ast.Subscript) and isinstance(part.ctx, context)
    }


def _indices(target: ast.expr) -> list[ast.expr]:
    return [part.slice for part in ast.walk(target) if isinstance(part, ast.Subscript)]


def _own_expressions(node: ast.stmt) -> list[ast.expr]:
    """Return the expressions of a statement without those of the statements inside it."""
    return [part for part in ast.iter_child_nodes(node) if isinstance(part, ast.expr)]
