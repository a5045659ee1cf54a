"""Expressions: from Python's syntax to C's text, with types checked on the way.

Parentheses stand where C's precedence, or a compiler's warning, asks for them; the order of arithmetic is Python's.
Whatever Python and C would evaluate differently is refused, above all an int where a float is meant.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .kinds import NUMBERS, ArrayType, RecordType, Scalar, Type, VecType, element_of
from .program import Constant, Function, Intrinsic, Number, Program, check_range, fold
from .source import Module
from .subset import TEXT, RefusedError, outside
from .writer import UNBROKEN

CONDITION, OR, AND, BIT_OR, BIT_AND, EQUAL, ORDER, SHIFT, SUM, PRODUCT, UNARY, POSTFIX = range(12)
"""C's precedence, weakest first."""

_BINARY: dict[type[ast.operator], tuple[str, int]] = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Div: ("/", PRODUCT),
    ast.BitAnd: ("&", BIT_AND),
    ast.BitOr: ("|", BIT_OR),
    ast.LShift: ("<<", SHIFT),
    ast.RShift: (">>", SHIFT),
}
_HELPER = {ast.FloorDiv: "int_floor_div", ast.Mod: "int_floor_mod"}
_COMPARE: dict[type[ast.cmpop], tuple[str, int]] = {
    ast.Lt: ("<", ORDER),
    ast.LtE: ("<=", ORDER),
    ast.Gt: (">", ORDER),
    ast.GtE: (">=", ORDER),
    ast.Eq: ("==", EQUAL),
    ast.NotEq: ("!=", EQUAL),
}
_KINDS: dict[type, Scalar] = {bool: Scalar.BOOL, int: Scalar.INT, float: Scalar.FLOAT}
_AND_IN_CHAIN = f"{UNBROKEN}&&{UNBROKEN}"
_HINTS = {
    "int for float": ": write 0.0 for 0, or float(…)",
    "float for int": ": write int(…)",
    "bool for int": ": write int(…)",
}


@dataclass(frozen=True)
class Text:
    """An expression in C: what C writes, the precedence of its outermost operator, its type.

    ``value``: where the translator knows it. ``pointer``: a record that is reached through a pointer.
    """

    c: str
    level: int
    kind: Type
    value: Number | None = None
    pointer: bool = False

    def at(self, level: int) -> str:
        """Return the text for a place that takes operators of ``level`` and stronger ones."""
        return self.c if self.level >= level else f"({self.c})"


def operator_of(node: ast.AST, kind: ast.operator, left: Type, right: Type) -> tuple[str, int, Scalar]:
    """Return C's operator or helper, its precedence and the type of the result; refuses operands it does not take."""
    whole_only = not isinstance(kind, ast.Add | ast.Sub | ast.Mult | ast.Div)
    if type(kind) not in _BINARY and type(kind) not in _HELPER:
        raise outside(node, kind)
    for operand in (left, right):
        if operand not in NUMBERS:
            raise RefusedError(node, f"arithmetic is for numbers, not for {operand}")
        if whole_only and operand is not Scalar.INT:
            hint = ": write whole(x / y)" if isinstance(kind, ast.FloorDiv | ast.Mod) else ""
            raise RefusedError(node, f"this operator takes int, not {operand}{hint}")
    floating = isinstance(kind, ast.Div) or Scalar.FLOAT in (left, right)
    result = Scalar.FLOAT if floating else Scalar.INT
    if type(kind) in _HELPER:
        return _HELPER[type(kind)], POSTFIX, result
    return *_BINARY[type(kind)], result


class Expressions:
    """Translates the expressions of one function.

    ``kinds``: the locals known so far; None marks one whose assignment was refused.
    """

    def __init__(self, program: Program, module: Module, kinds: dict[str, Type | None]) -> None:
        self._program, self._module = program, module
        self.kinds = kinds
        self._by_kind: dict[type[ast.expr], Callable[[Any], Text]] = {
            ast.Constant: self._literal,
            ast.Name: self._name,
            ast.Attribute: self._attribute,
            ast.Subscript: self._element,
            ast.UnaryOp: self._unary,
            ast.BinOp: self._binary,
            ast.Compare: self._comparison,
            ast.BoolOp: self._junction,
            ast.IfExp: self._choice,
            ast.Call: self._call,
        }

    def text(self, node: ast.expr) -> Text:
        """Translate any expression."""
        translate = self._by_kind.get(type(node))
        if translate is None:
            raise outside(node)
        return translate(node)

    def of(self, node: ast.expr, kind: Type, what: str) -> Text:
        """Translate an expression whose type must be ``kind``; ``what`` says what it is for."""
        text = self.text(node)
        if text.kind != kind:
            hint = _HINTS.get(f"{text.kind} for {kind}", "")
            raise RefusedError(node, f"{what} is {kind}, this is {text.kind}{hint}")
        return text

    def condition(self, node: ast.expr) -> Text:
        """Translate a condition, which must be a bool: C and Python agree on nothing else."""
        text = self.text(node)
        if text.kind is not Scalar.BOOL:
            raise RefusedError(node, f"a condition is a bool, this is {text.kind}: write a comparison")
        return text

    def index(self, node: ast.expr, length: int | None) -> Text:
        """Translate an index; refuses one that is known to lie outside."""
        if isinstance(node, ast.Slice):
            raise outside(node)
        text = self.of(node, Scalar.INT, "an index")
        if text.value is not None and text.value < 0:
            raise RefusedError(node, "a negative index counts from the end in Python, but not in C")
        if text.value is not None and length is not None and text.value >= length:
            raise RefusedError(node, f"index {text.value} is outside an array of length {length}")
        return text

    def _literal(self, node: ast.Constant) -> Text:
        match node.value:
            case bool(value) | int(value) | float(value):
                return Text(self._module.literal(node), POSTFIX, _KINDS[type(value)], check_range(node, value))
            case str() | bytes():
                raise RefusedError(node, TEXT)
        raise RefusedError(node, f"{node.value!r} is no value in C")

    def _name(self, node: ast.Name) -> Text:
        if node.id in self.kinds:
            kind = self.kinds[node.id]
            if kind is None:
                raise RefusedError(node, "")
            return Text(node.id, POSTFIX, kind, pointer=isinstance(kind, RecordType))
        entity = self._program.entity(self._module, node)
        if isinstance(entity, Constant):
            return Text(entity.c_name, POSTFIX, _KINDS[type(entity.value)], entity.value)
        raise RefusedError(node, f"{node.id} is {'no value' if entity else 'not known here'}")

    def _attribute(self, node: ast.Attribute) -> Text:
        owner = self.text(node.value)
        if not isinstance(owner.kind, RecordType):
            raise RefusedError(node, f"{owner.kind} has no fields")
        fields = self._program.record_of(owner.kind).fields
        if node.attr not in fields:
            raise RefusedError(node, f"{owner.kind} has no field {node.attr}")
        return Text(f"{owner.at(POSTFIX)}{'->' if owner.pointer else '.'}{node.attr}", POSTFIX, fields[node.attr])

    def _element(self, node: ast.Subscript) -> Text:
        owner = self.text(node.value)
        if not isinstance(owner.kind, ArrayType | VecType):
            raise RefusedError(node, f"{owner.kind} has no elements")
        index = self.index(node.slice, owner.kind.length if isinstance(owner.kind, ArrayType) else None)
        return Text(f"{owner.at(POSTFIX)}[{index.c}]", POSTFIX, element_of(owner.kind))

    def _unary(self, node: ast.UnaryOp) -> Text:
        if isinstance(node.op, ast.Not):
            return Text(f"!{self.condition(node.operand).at(UNARY)}", UNARY, Scalar.BOOL)
        if not isinstance(node.op, ast.USub):
            raise outside(node, node.op)
        text = self.text(node.operand)
        if text.kind not in (Scalar.INT, Scalar.FLOAT):
            raise RefusedError(node, f"a sign is for int and float, not for {text.kind}")
        value = None if text.value is None else check_range(node, -text.value)
        inner = text.at(UNARY)
        return Text(f"-({inner})" if inner.startswith("-") else f"-{inner}", UNARY, text.kind, value)

    def _binary(self, node: ast.BinOp) -> Text:
        left, right = self.text(node.left), self.text(node.right)
        sign, level, kind = operator_of(node, node.op, left.kind, right.kind)
        self.check_divisor(node, node.op, right)
        value = None
        if kind is Scalar.INT and left.value is not None and right.value is not None:
            value = fold(node, node.op, left.value, right.value)
        if level == POSTFIX:
            return Text(f"{sign}({left.c}, {right.c})", POSTFIX, kind, value)
        if isinstance(node.op, ast.Div) and Scalar.FLOAT not in (left.kind, right.kind):
            return Text(f"(double){left.at(UNARY)} / {right.at(UNARY)}", level, kind)
        of_bits = level < SUM
        return Text(
            f"{left.at(UNARY if of_bits else level)} {sign} {right.at(UNARY if of_bits else level + 1)}",
            level,
            kind,
            value,
        )

    def check_divisor(self, node: ast.AST, kind: ast.operator, divisor: Text) -> None:
        """Refuse a division by what is known to be 0, and a shift by what is known not to be 0 to 31."""
        if isinstance(kind, ast.Div | ast.FloorDiv | ast.Mod) and divisor.value == 0:
            raise RefusedError(node, "this divides by 0")
        if isinstance(kind, ast.LShift | ast.RShift) and divisor.value is not None and not 0 <= divisor.value < 32:
            raise RefusedError(node, "a shift goes by 0 to 31")

    def _comparison(self, node: ast.Compare) -> Text:
        parts = []
        left = self.text(node.left)
        for kind, other in zip(node.ops, node.comparators, strict=True):
            if type(kind) not in _COMPARE:
                raise outside(node, kind)
            right = self.text(other)
            for operand in (left.kind, right.kind):
                if operand not in NUMBERS:
                    raise RefusedError(node, f"{operand} is not compared: compare its numbers")
            if (left.kind is Scalar.BOOL) != (right.kind is Scalar.BOOL):
                raise RefusedError(node, f"{left.kind} is compared with {right.kind}: write int(…)")
            sign, level = _COMPARE[type(kind)]
            parts.append(Text(f"{left.at(SHIFT)} {sign} {right.at(SHIFT)}", level, Scalar.BOOL))
            left = right
        return parts[0] if len(parts) == 1 else Text(_AND_IN_CHAIN.join(part.c for part in parts), AND, Scalar.BOOL)

    def _junction(self, node: ast.BoolOp) -> Text:
        sign, level, inner = (" && ", AND, AND) if isinstance(node.op, ast.And) else (" || ", OR, BIT_OR)
        return Text(sign.join(self.condition(value).at(inner) for value in node.values), level, Scalar.BOOL)

    def _choice(self, node: ast.IfExp) -> Text:
        test, body, orelse = self.condition(node.test), self.text(node.body), self.text(node.orelse)
        if body.kind not in NUMBERS or body.kind != orelse.kind:
            raise RefusedError(
                node, f"one side is {body.kind}, the other {orelse.kind}: both are the same kind of number"
            )
        return Text(f"{test.at(OR)} ? {body.at(OR)} : {orelse.at(CONDITION)}", CONDITION, body.kind)

    def _call(self, node: ast.Call) -> Text:
        if not isinstance(node.func, ast.Name):
            raise RefusedError(node, f"{ast.unparse(node.func)} is a method: write a function")
        if node.keywords:
            raise RefusedError(node, "arguments are given by position")
        name = node.func.id
        if name in self.kinds:
            raise RefusedError(node, f"{name} is a local, not a function")
        entity = self._program.entity(self._module, node.func)
        if isinstance(entity, Function):
            return self._call_of(node, entity)
        if entity in (None, Intrinsic(name)):
            return self._intrinsic(node, name, known=entity is not None)
        raise RefusedError(node, f"{name} is no function: a record is made outside the kernel")

    def _call_of(self, node: ast.Call, callee: Function) -> Text:
        if len(node.args) != len(callee.parameters):
            raise RefusedError(
                node, f"{callee.name} takes {len(callee.parameters)} arguments, here are {len(node.args)}"
            )
        arguments = [
            self._argument(argument, kind, f"argument {name} of {callee.name}")
            for argument, (name, kind) in zip(node.args, callee.parameters.items(), strict=True)
        ]
        return Text(f"{callee.c_name}({', '.join(arguments)})", POSTFIX, callee.returns)

    def _argument(self, node: ast.expr, kind: Type, what: str) -> str:
        if isinstance(kind, Scalar):
            return self.of(node, kind, what).c
        text = self.text(node)
        match text.kind, kind:
            case ArrayType() as given, ArrayType() as wanted:
                fits = given.element == wanted.element and given.length >= wanted.length
            case ArrayType(element=element), VecType():
                fits = element is Scalar.FLOAT
            case _:
                fits = text.kind == kind
        if not fits:
            raise RefusedError(node, f"{what} is {kind}, this is {text.kind}")
        return f"&{text.at(POSTFIX)}" if isinstance(kind, RecordType) and not text.pointer else text.c

    def _intrinsic(self, node: ast.Call, name: str, *, known: bool) -> Text:
        if name in ("whole", "sqrt") and known:
            (argument,) = self._arguments(node, 1)
            return Text(f"{name}({self.of(argument, Scalar.FLOAT, f'argument of {name}').c})", POSTFIX, Scalar.FLOAT)
        if name in ("int", "float"):
            return self._conversion(node, name)
        if name == "abs":
            (argument,) = self._arguments(node, 1)
            text = self.text(argument)
            if text.kind not in (Scalar.INT, Scalar.FLOAT):
                raise RefusedError(node, f"abs is for int and float, not for {text.kind}")
            return Text(f"{'int_abs' if text.kind is Scalar.INT else 'fabs'}({text.c})", POSTFIX, text.kind)
        if name in ("min", "max"):
            one, other = (self.text(argument) for argument in self._arguments(node, 2))
            if one.kind != other.kind or one.kind not in (Scalar.INT, Scalar.FLOAT):
                raise RefusedError(node, f"{name} of {one.kind} and {other.kind}: both are int, or both are float")
            family = "int" if one.kind is Scalar.INT else "double"
            return Text(f"{family}_{name}({one.c}, {other.c})", POSTFIX, one.kind)
        if name in ("sound", "decided") and known:
            (argument,) = self._arguments(node, 1)
            kind = self.text(argument).kind
            if not isinstance(kind, RecordType):
                raise RefusedError(node, f"{name} is for records, not for {kind}")
            return Text(f"{name}_{kind.name}({self._argument(argument, kind, name)})", POSTFIX, Scalar.BOOL)
        if name == "zeros" and known:
            raise RefusedError(node, "zeros(n) stands alone where a local array is first named")
        raise RefusedError(node, f"{name} is no function of the subset")

    def _conversion(self, node: ast.Call, name: str) -> Text:
        kind = Scalar.INT if name == "int" else Scalar.FLOAT
        (argument,) = self._arguments(node, 1)
        text = self.text(argument)
        if text.kind not in NUMBERS or text.kind is kind:
            raise RefusedError(node, f"{name}() of {text.kind} converts nothing")
        if kind is Scalar.INT and text.value is not None:
            check_range(node, int(text.value))
        return Text(f"({kind.value}){text.at(UNARY)}", UNARY, kind)

    def _arguments(self, node: ast.Call, count: int) -> list[ast.expr]:
        if len(node.args) != count:
            raise RefusedError(node, f"{ast.unparse(node.func)} takes {count} argument{'s' * (count > 1)} here")
        return node.args
