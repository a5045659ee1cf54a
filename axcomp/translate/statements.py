"""Statements: the body of one function as lines of C, with the comments and blank lines of the source."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from typing import TypeGuard

from .effects import Effects, root
from .expressions import SHIFT, Expressions, Text, operator_of
from .kinds import ArrayType, RecordType, Scalar, Type, VecType, local, parameter
from .margins import Margins
from .program import Constant, Function, Intrinsic, Program, Struct
from .scopes import Block, Declarations, Flow, mentions, names_in, stores
from .subset import RefusedError, check_name, outside
from .writer import Writer

AT_MOST = re.compile(r"at most (\d+) times")
"""In the comment on the head of a loop: an analysis of the C code is told so (ACSL)."""


def prototype(function: Function, effects: Effects) -> str:
    """Return the head of a function in C; parameters it does not write through are const."""
    written = effects.written(function)
    parts = [parameter(kind, name, const=name not in written) for name, kind in function.parameters.items()]
    head = f"{function.returns.value} {function.c_name}({', '.join(parts) or 'void'})"
    return head if function.exported else f"static {head}"


@dataclass(frozen=True)
class _Ahead:
    """A line to be filled in when the type of a local is known."""

    line: int
    depth: int


class Body:
    """Translates the body of one function; ``writer`` takes the lines."""

    def __init__(self, program: Program, effects: Effects, function: Function, writer: Writer) -> None:
        self._program, self._effects, self._function, self.writer = program, effects, function, writer
        self._module, self._report = function.module, program.report
        self._written = effects.written(function)
        self._kinds: dict[str, Type | None] = dict(function.parameters)
        self._expressions = Expressions(program, function.module, self._kinds)
        self._declarations = Declarations()
        self._ahead: dict[str, _Ahead] = {}
        heads = [part.target for part in ast.walk(function.node) if isinstance(part, ast.For)]
        stored = [name for name in names_in(function.node, ast.Store) if name not in heads]
        self._counters = {head.id for head in heads if isinstance(head, ast.Name)}
        self._assigned = {name.id for name in stored}
        self._loops: list[str] = []
        self._arrays: set[str] = set()
        docstring = function.node.body[0] if ast.get_docstring(function.node) is not None else None
        self._statements = function.node.body[1:] if docstring else function.node.body
        start = docstring.end_lineno if docstring else function.node.body[0].lineno - 1
        self._margins = Margins(function.module, writer, start or 0)

    def translate(self) -> None:
        """Write the body; what is refused goes to the program's report."""
        node = self._function.node
        locals_ = self._check_names()
        flow = Flow(node, locals_)
        for refused in flow.refused:
            self._report.add(self._module.file, refused)
        with self._report.catching(self._module.file):
            if flow.ends and self._function.returns is not Scalar.NONE:
                raise RefusedError(node, f"{self._function.name} may end without returning {self._function.returns}")
        for name in sorted(locals_ - self._counters):
            self._declarations.place(name, self._statements)
        self._block(self._statements)

    # ---- names

    def _check_names(self) -> set[str]:
        """Check the function's names and return those of its locals."""
        node, parameters = self._function.node, self._function.parameters
        stored = {name.id: name for name in reversed(names_in(node, ast.Store))}
        loaded = {name.id for name in names_in(node, ast.Load)}
        own: dict[str, ast.AST] = {**dict.fromkeys(parameters, node), **stored}
        called = {callee.c_name for callee in self._effects.callees(self._function)}
        for name, first in own.items():
            with self._report.catching(self._module.file):
                check_name(first, name)
                taken = self._program.defined_as(name)
                if name in called or isinstance(taken, Constant | Struct):
                    raise RefusedError(first, f"{name} is also the name of something at module level: choose another")
                if name not in loaded and name not in self._counters:
                    raise RefusedError(first, f"{name} is never read")
        return set(stored) - set(parameters)

    # ---- blocks and statements

    def _block(self, block: Block, remark: str = "") -> None:
        self.writer.depth += 1
        if remark:
            self.writer.remark(remark)
        for position, node in enumerate(block):
            try:
                self._statement(node, first=position == 0)
            except RefusedError as refused:
                self._report.add(self._module.file, refused)
                for name in names_in(node, ast.Store):
                    self._kinds.setdefault(name.id, None)
        if block:
            self._margins.tail(block[0].col_offset)
        self.writer.depth -= 1

    def _statement(self, node: ast.stmt, *, first: bool) -> None:
        self._margins.lead_in(node.lineno, lambda: self._declare(self._declarations.ahead.get(node, [])), first=first)
        match node:
            case ast.If():
                self._if(node)
            case ast.While():
                self._while(node)
            case ast.For():
                self._for(node)
            case _:
                self._effects.check_order(self._module, node)
                self._simple(node)

    def _declare(self, names: list[str]) -> None:
        for name in names:
            self._ahead[name] = _Ahead(len(self.writer.lines), self.writer.depth)
            self.writer.write(f"{name};")

    def _simple(self, node: ast.stmt) -> None:
        note = self._margins.notes(node)
        match node:
            case ast.Assign(targets=[target], value=value):
                self._assign(node, target, value, None, note)
            case ast.Assign():
                raise RefusedError(node, "one assignment has one target")
            case ast.AnnAssign(value=None):
                raise RefusedError(node, "a local is declared with its first value")
            case ast.AnnAssign(target=target, value=value) if value:
                self._assign(node, target, value, self._program.annotation(self._module, node.annotation, node), note)
            case ast.AugAssign():
                self._augment(node, note)
            case ast.Return():
                self._return(node, note)
            case ast.Break():
                self.writer.write("break;", note)
            case ast.Continue():
                self.writer.write("continue;", note)
            case ast.Pass():
                if note:
                    self.writer.remark(note)
            case ast.Expr(value=ast.Call() as call):
                self.writer.write(f"{self._expressions.text(call).c};", note)
            case ast.Expr(value=ast.Constant(value=str() as text)):
                self.writer.remark(text)
            case ast.Expr(value=value):
                self._expressions.text(value)
                raise RefusedError(node, "this has no effect")
            case _:
                raise outside(node)

    def _return(self, node: ast.Return, note: str) -> None:
        returns = self._function.returns
        if node.value is None:
            if returns is not Scalar.NONE:
                raise RefusedError(node, f"{self._function.name} returns {returns}")
            self.writer.write("return;", note)
            return
        if returns is Scalar.NONE:
            raise RefusedError(node, f"{self._function.name} returns None: write a bare return")
        self.writer.write(f"return {self._expressions.of(node.value, returns, 'what is returned').c};", note)

    def _assign(self, node: ast.stmt, target: ast.expr, value: ast.expr, stated: Type | None, note: str) -> None:
        if isinstance(target, ast.Name):
            self._assign_local(node, target, value, stated, note)
            return
        written = self._target(target)
        text = self._expressions.of(value, written.kind, ast.unparse(target))
        self.writer.write(f"{written.c} = {text.c};", note)

    def _target(self, target: ast.expr) -> Text:
        """Translate the field or element that is assigned to."""
        if not isinstance(target, ast.Attribute | ast.Subscript):
            raise outside(target)
        owner = self._expressions.text(target.value)
        if isinstance(owner.kind, VecType):
            raise RefusedError(target, "a Vec is only read: take Annotated[list[float], N]")
        text = self._expressions.text(target)
        if not isinstance(text.kind, Scalar):
            raise RefusedError(target, f"{text.kind} is not assigned: Python would share it, C would copy it")
        return text

    def _assign_local(self, node: ast.stmt, target: ast.Name, value: ast.expr, stated: Type | None, note: str) -> None:
        name = target.id
        declares = node in self._declarations.by
        if self._is_zeros(value):
            self._local_array(node, name, value, note, declares=declares)
            return
        if name in self._function.parameters and not isinstance(self._function.parameters[name], Scalar):
            raise RefusedError(node, f"the parameter {name} stands for the caller's record or list: it is not rebound")
        if name in self._arrays:
            raise RefusedError(node, f"{name} is an array of its own, made by zeros(n): it is not rebound")
        if name in self._loops:
            raise RefusedError(node, f"{name} counts the loop: it is not assigned in it")
        text = self._expressions.text(value)
        kind = text.kind
        if kind is Scalar.NONE:
            raise RefusedError(node, "the function called returns nothing")
        if stated is not None and stated != kind:
            self._expressions.of(value, stated, name)
        known = self._kinds.get(name, kind)
        if known is None:
            raise RefusedError(node, "")
        if known != kind:
            self._expressions.of(value, known, name)
        if not isinstance(kind, Scalar) and not root(value):
            raise RefusedError(node, f"{kind} is taken from one place: write if … else")
        if name not in self._kinds:
            self._kinds[name] = kind
        declaration = local(kind, name, const=name not in self._written)
        if name in self._ahead:
            ahead = self._ahead.pop(name)
            self.writer.lines[ahead.line] = f"{'    ' * ahead.depth}{declaration};"
        address = "&" if not isinstance(kind, Scalar | ArrayType | VecType) and not text.pointer else ""
        self.writer.write(f"{declaration if declares else name} = {address}{text.c};", note)

    def _is_zeros(self, value: ast.expr) -> bool:
        names = self._program.names[self._module.name]
        match value:
            case ast.Call(func=ast.Name(id="zeros")):
                return names.get("zeros") == Intrinsic("zeros")
        return False

    def _local_array(self, node: ast.stmt, name: str, value: ast.expr, note: str, *, declares: bool) -> None:
        assert isinstance(value, ast.Call)
        if len(value.args) != 1 or value.keywords:
            raise RefusedError(node, "zeros takes one argument, the length")
        length, text = self._program.length(self._module, value.args[0])
        kind = ArrayType(Scalar.FLOAT, length, text)
        if not declares or self._kinds.get(name, kind) != kind:
            raise RefusedError(
                node, f"zeros(n) stands where {name} is first named, and makes the same length everywhere"
            )
        stores = [part.value for part in ast.walk(self._function.node) if _is_store_of_element(part)]
        if all(part in stores for part in names_in(self._function.node, ast.Load) if part.id == name):
            raise RefusedError(node, f"{name} is never read")
        self._kinds[name] = kind
        self._arrays.add(name)
        self.writer.write(f"double {name}[{text}] = {{0}};", note)

    def _augment(self, node: ast.AugAssign, note: str) -> None:
        target = self._expressions.text(node.target) if isinstance(node.target, ast.Name) else self._target(node.target)
        if isinstance(node.target, ast.Name) and node.target.id in self._loops:
            raise RefusedError(node, f"{node.target.id} counts the loop: it is not assigned in it")
        if isinstance(node.target, ast.Name) and node.target.id not in self._kinds:
            raise RefusedError(node, f"{node.target.id} is a constant")
        value = self._expressions.text(node.value)
        sign, _, kind = operator_of(node, node.op, target.kind, value.kind)
        self._expressions.check_divisor(node, node.op, value)
        if kind != target.kind:
            raise RefusedError(node, f"{ast.unparse(node.target)} is {target.kind}, this makes it {kind}")
        if sign.startswith("int_"):
            self.writer.write(f"{target.c} = {sign}({target.c}, {value.c});", note)
        else:
            self.writer.write(f"{target.c} {sign}= {value.c};", note)

    # ---- compound statements

    def _condition(self, node: ast.If | ast.While) -> str:
        """Translate a condition; the block behind it is translated whether or not this is refused."""
        with self._report.catching(self._module.file):
            self._effects.check_order(self._module, node)
            return self._expressions.condition(node.test).c
        return ""

    def _if(self, node: ast.If) -> None:
        word, remark = "if", ""
        while True:
            note = self._margins.head_notes(node, node.body)
            self.writer.write(f"{word} ({self._condition(node)}) {{", note)
            self._block(node.body, remark)
            line = self._margins.else_line(node)
            match node.orelse:
                case [ast.If() as other] if not line:
                    node, word, remark = other, "} else if", self._margins.above(other.lineno)
                    continue
            break
        if node.orelse:
            remark = self._margins.above(line)
            self.writer.write("} else {", self._margins.else_notes(line))
            self._block(node.orelse, remark)
        elif word != "if":  # MISRA C:2012, rule 15.7
            self.writer.write("} else {")
            self.writer.depth += 1
            self.writer.remark("nothing")
            self.writer.depth -= 1
        self.writer.write("}")

    def _while(self, node: ast.While) -> None:
        note = self._margins.head_notes(node, node.body)
        if node.orelse:
            self._report.add(self._module.file, RefusedError(node, "a loop has no else in C"))
        if found := AT_MOST.search(note):
            self.writer.extend([f"{' ' * 4 * self.writer.depth}//@ loop unroll {int(found[1])};"])
        self.writer.write(f"while ({self._condition(node)}) {{", note)
        self._block(node.body)
        self.writer.write("}")

    def _for(self, node: ast.For) -> None:
        note = self._margins.head_notes(node, node.body)
        with self._report.catching(self._module.file):
            self._effects.check_order(self._module, node)
            self.writer.write(self._for_head(node), note)
        if isinstance(node.target, ast.Name):
            self._kinds[node.target.id] = Scalar.INT
            self._loops.append(node.target.id)
            self._block(node.body)
            self._loops.pop()
        self.writer.write("}")

    def _for_head(self, node: ast.For) -> str:
        if node.orelse:
            raise RefusedError(node, "a loop has no else in C")
        if not isinstance(node.target, ast.Name):
            raise outside(node.target)
        name = node.target.id
        if not (
            isinstance(node.iter, ast.Call) and isinstance(node.iter.func, ast.Name) and node.iter.func.id == "range"
        ):
            raise RefusedError(node, "a loop runs over range(…): take the elements by their index")
        if node.iter.keywords or not 1 <= len(node.iter.args) <= 2:
            raise RefusedError(node, "range takes an end, or a start and an end")
        if name in self._loops or name in self._function.parameters or name in self._assigned:
            raise RefusedError(node, f"{name} counts this loop: it is not used for anything else")
        bounds = [self._expressions.of(bound, Scalar.INT, "a bound of range") for bound in node.iter.args]
        start = bounds[0].c if len(bounds) == 2 else "0"
        if name == "_" and all(part.id != name for part in names_in(node, ast.Load)):
            name = self._unused("i")
        if self._is_fixed(node.iter.args[-1], node):
            return f"for (int32_t {name} = {start}; {name} < {bounds[-1].at(SHIFT)}; {name}++) {{"
        end = self._unused(f"{name}_end")
        return f"for (int32_t {name} = {start}, {end} = {bounds[-1].c}; {name} < {end}; {name}++) {{"

    def _unused(self, name: str) -> str:
        """Return a name that means nothing else in the function, the given one if possible."""
        function = self._function
        while mentions(function.node, name) or name in function.parameters or self._program.defined_as(name):
            name += "_"
        return name

    def _is_fixed(self, node: ast.expr, loop: ast.For) -> bool:
        """Whether an expression keeps its value while the loop runs: Python evaluates it once, C in every round."""
        match node:
            case ast.Constant():
                return True
            case ast.Name(id=name):
                return not any(stores(inner, name) for inner in loop.body)
            case ast.Attribute(value=value, attr=attribute):
                return attribute not in self._effects.written_fields and self._is_fixed(value, loop)
            case ast.Subscript(value=ast.Attribute() as value, slice=index):
                return (
                    isinstance(self._expressions.text(node).kind, RecordType)
                    and self._is_fixed(value, loop)
                    and (self._is_fixed(index, loop))
                )
            case ast.BinOp(left=left, op=ast.Add() | ast.Sub() | ast.Mult(), right=right):
                return self._is_fixed(left, loop) and self._is_fixed(right, loop)
        return False


def _is_store_of_element(node: ast.AST) -> TypeGuard[ast.Subscript]:
    return isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store)
