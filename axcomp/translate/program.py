"""What the modules define: constants, records and functions, and the names each module sees."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from .kinds import VEC, ArrayType, RecordType, Scalar, Type
from .source import RUN_TIME_MODULE, Module
from .subset import RefusedError, Report, c_name, check_name, outside

Number: TypeAlias = int | float | bool

_IMPORTABLE = {
    "__future__": {"annotations"},
    "dataclasses": {"dataclass"},
    "math": {"sqrt"},
    "typing": {"Annotated", "Final"},
    RUN_TIME_MODULE: {"APART", "Vec", "decided", "sound", "whole", "zero", "zeros"},
}
_SCALARS = {"int": Scalar.INT, "float": Scalar.FLOAT, "bool": Scalar.BOOL}
_INT_LIMIT = 2**31
OPERATIONS: dict[type[ast.operator], Callable[[Number, Number], Number]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
}


@dataclass(frozen=True)
class Intrinsic:
    """A name that the translator itself knows, such as ``sqrt``."""

    name: str


BROKEN = Intrinsic("")
"""Stands for a definition that has been refused: using it is no second refusal."""


@dataclass(frozen=True, eq=False)
class Constant:
    """A named number: its value, what C writes for it, and the expression in the source if it is not that literal."""

    name: str
    c_name: str
    value: Number
    text: str
    origin: str
    module: Module
    node: ast.Assign | ast.AnnAssign


@dataclass(frozen=True, eq=False)
class Struct:
    """A dataclass: a struct in C."""

    name: str
    c_name: str
    fields: dict[str, Type]
    module: Module
    node: ast.ClassDef


@dataclass(frozen=True, eq=False)
class Function:
    """A function; ``c_name`` carries the prefix if it is exported."""

    name: str
    c_name: str
    exported: bool
    parameters: dict[str, Type]
    returns: Scalar
    module: Module
    node: ast.FunctionDef


@dataclass(frozen=True, eq=False)
class Alias:
    """A name for a type of array, ``Matrix = Annotated[list[float], 9]``; C writes the type itself."""

    name: str
    kind: ArrayType
    module: Module


Definition: TypeAlias = Constant | Struct | Function
Entity: TypeAlias = Definition | Alias | Intrinsic


def fold(node: ast.AST, kind: ast.operator, left: Number, right: Number) -> Number:
    """Return the value of an operation on known numbers; refuses a result that C has not."""
    if type(kind) not in OPERATIONS:
        raise outside(node, kind)
    try:
        value = OPERATIONS[type(kind)](left, right)
    except (ArithmeticError, ValueError, TypeError) as error:
        raise RefusedError(node, f"this has no value: {error}") from None
    return check_range(node, value)


def check_range(node: ast.AST, value: Number) -> Number:
    """Return ``value``; refuses a whole number outside 32 bits and a float that is not finite."""
    if isinstance(value, float) and not abs(value) < float("inf"):
        raise RefusedError(node, "a constant is finite")
    if not isinstance(value, float) and not -_INT_LIMIT <= value < _INT_LIMIT:
        raise RefusedError(node, f"{value} does not fit in 32 bits")
    return value


@dataclass
class Program:
    """All definitions of the modules, which are in order of dependency; what is refused goes to the report.

    ``exports``: functions that other C code may call; ``prefix``: what their names in C begin with; ``names``: for each
    module those it can use; ``definitions``: constants, records and functions in the order of the source.
    """

    modules: Sequence[Module]
    exports: Sequence[str]
    prefix: str
    report: Report
    names: dict[str, dict[str, Entity]] = field(default_factory=dict)
    definitions: list[Definition] = field(default_factory=list)
    _by_c_name: dict[str, Definition] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for module in self.modules:
            self.names[module.name] = {}
            body = module.tree.body
            for node in body[1:] if ast.get_docstring(module.tree) is not None else body:
                try:
                    self._take(module, node)
                except RefusedError as refused:
                    self.report.add(module.file, refused)
                    for name in _bound_by(node):
                        self.names[module.name].setdefault(name, BROKEN)
        for definition in self.definitions:
            if isinstance(definition, Struct):
                self._check_fields(definition)

    def entity(self, module: Module, node: ast.expr) -> Entity | None:
        """Return what a name means in a module, None if nothing; refuses what has been refused where it was defined."""
        entity = self.names[module.name].get(node.id) if isinstance(node, ast.Name) else None
        if entity == BROKEN:
            raise RefusedError(node, "")
        return entity

    def defined_as(self, name_in_c: str) -> Definition | None:
        """Return what has a name at C's file scope."""
        return self._by_c_name.get(name_in_c)

    def record_of(self, kind: RecordType) -> Struct:
        """Return the record of a type."""
        record = self._by_c_name[kind.name]
        assert isinstance(record, Struct)
        return record

    def functions(self) -> list[Function]:
        """Return the functions in the order of the source."""
        return [definition for definition in self.definitions if isinstance(definition, Function)]

    def annotation(self, module: Module, node: ast.expr | None, owner: ast.AST) -> Type:
        """Return the type an annotation names; ``owner`` is where a missing one is reported."""
        if node is None:
            raise RefusedError(owner, f"{getattr(owner, 'arg', getattr(owner, 'name', 'this'))} has no annotation")
        if isinstance(node, ast.Constant) and node.value is None:
            return Scalar.NONE
        entity = self.entity(module, node)
        if isinstance(entity, Struct):
            return RecordType(entity.c_name)
        if isinstance(entity, Alias):
            return entity.kind
        if entity == Intrinsic("Vec"):
            return VEC
        if isinstance(node, ast.Name) and node.id in _SCALARS:
            return _SCALARS[node.id]
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name) and node.value.id == "Annotated":
            return self._array(module, node)
        raise RefusedError(node, f"{ast.unparse(node)} is no type of the subset")

    def length(self, module: Module, node: ast.expr) -> tuple[int, str]:
        """Return the length of an array, a literal or a constant: its value and what C writes."""
        value, text = None, ""
        if isinstance(node, ast.Constant):
            value, text = node.value, str(node.value)
        elif isinstance(entity := self.names[module.name].get(ast.unparse(node)), Constant):
            value, text = entity.value, entity.c_name
        if type(value) is not int or value < 1:
            raise RefusedError(
                node, f"{ast.unparse(node)} is no length: it takes a whole number or a constant, at least 1"
            )
        return value, text

    def _array(self, module: Module, node: ast.Subscript) -> ArrayType:
        match node.slice:
            case ast.Tuple(elts=[ast.Subscript(value=ast.Name(id="list"), slice=inner), length, *marks]) if all(
                self.entity(module, mark) == Intrinsic("APART") for mark in marks
            ):
                element = self.annotation(module, inner, node)
                if not isinstance(element, Scalar | RecordType) or element is Scalar.NONE:
                    raise RefusedError(node, "an array holds int, float, bool or records")
                return ArrayType(element, *self.length(module, length), apart=bool(marks))
        raise RefusedError(node, f"{ast.unparse(node)} is no type of the subset: write Annotated[list[float], N]")

    def _take(self, module: Module, node: ast.stmt) -> None:
        match node:
            case ast.Import() | ast.ImportFrom():
                self._import(module, node)
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Subscript() as value):
                self.names[module.name][name] = Alias(name, self._array(module, value), module)
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                self._constant(module, node, name, value)
            case ast.AnnAssign(target=ast.Name(id=name), value=value) if value and _is_final(node.annotation):
                self._constant(module, node, name, value)
            case ast.ClassDef():
                self._record(module, node)
            case ast.FunctionDef():
                self._function(module, node)
            case ast.Expr(value=ast.Constant(value=str())):
                pass
            case _:
                raise RefusedError(node, "at module level stand imports, constants, records and functions only")

    def _import(self, module: Module, node: ast.Import | ast.ImportFrom) -> None:
        if isinstance(node, ast.Import):
            raise RefusedError(node, "write `from … import …`: the subset has no names with a module before them")
        origin = node.module or ""
        sibling = node.level == 1 and origin in self.names
        known: set[str] = set() if sibling else _IMPORTABLE.get(origin, set())
        if not sibling and (not known or node.level != (1 if origin == RUN_TIME_MODULE else 0)):
            raise RefusedError(node, f"{'.' * node.level}{origin} is not known to the translator")
        for alias in node.names:
            if alias.asname:
                raise RefusedError(node, "an imported name keeps its name")
            entity = self.names[origin].get(alias.name) if sibling else None
            own = isinstance(entity, Definition | Alias) and entity.module.name == origin
            if sibling and not own and entity != BROKEN:
                raise RefusedError(node, f"{origin} does not define {alias.name}")
            if not sibling and alias.name not in known:
                raise RefusedError(node, f"{origin}.{alias.name} is not known to the translator")
            self.names[module.name][alias.name] = entity or Intrinsic(alias.name)

    def _define(self, definition: Definition) -> None:
        node = definition.node
        check_name(node, definition.name, file_scope=True)
        other = self._by_c_name.get(definition.c_name)
        if other:
            line = f"{other.module.file}:{other.node.lineno}"
            raise RefusedError(node, f"{definition.name} would be the same name in C as {other.name} at {line}")
        self._by_c_name[definition.c_name] = definition
        self.names[definition.module.name][definition.name] = definition
        self.definitions.append(definition)

    def _constant(self, module: Module, node: ast.Assign | ast.AnnAssign, name: str, value: ast.expr) -> None:
        number = self._value(module, value)
        literal = value.operand if isinstance(value, ast.UnaryOp) else value
        if isinstance(literal, ast.Constant):
            text, origin = module.literal(literal), ""
            text = text if literal is value else f"(-{text})"
        else:
            text, origin = repr(number), ast.unparse(value)
            text = f"({text})" if text.startswith("-") else text
        self._define(Constant(name, c_name(name), number, text, origin, module, node))

    def _value(self, module: Module, node: ast.expr) -> Number:
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return check_range(node, value)
            case ast.Name() if isinstance(entity := self.entity(module, node), Constant):
                return entity.value
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return check_range(node, -self._value(module, operand))
            case ast.BinOp(left=left, op=kind, right=right):
                return fold(node, kind, self._value(module, left), self._value(module, right))
        raise RefusedError(node, "a constant is made of numbers and earlier constants")

    def _record(self, module: Module, node: ast.ClassDef) -> None:
        if [ast.unparse(decorator) for decorator in node.decorator_list] != ["dataclass(slots=True)"]:
            raise RefusedError(node, f"{node.name} is no record: write @dataclass(slots=True)")
        if node.bases or node.keywords:
            raise RefusedError(node, f"{node.name} has bases: a record stands alone")
        record = Struct(node.name, c_name(node.name), {}, module, node)
        for item in node.body:
            with self.report.catching(module.file):
                match item:
                    case ast.AnnAssign(target=ast.Name(id=name), value=None):
                        record.fields[name] = self.annotation(module, item.annotation, item)
                        check_name(item, name)
                        if record.fields[name] is Scalar.NONE:
                            raise RefusedError(item, f"{name} holds nothing")
                    case ast.AnnAssign():
                        raise RefusedError(item, "a field has no default: a record begins with zeros")
                    case ast.FunctionDef():
                        raise RefusedError(item, f"{item.name} is a method: write a function")
                    case ast.Expr(value=ast.Constant(value=str())):
                        pass
                    case _:
                        raise RefusedError(item, "a record has fields only, each with its type")
        if not any(isinstance(item, ast.AnnAssign) for item in node.body):
            raise RefusedError(node, f"{node.name} has no fields: C has no empty struct")
        self._define(record)

    def _check_fields(self, record: Struct) -> None:
        """Refuse fields that are pointers, and those called like a constant: C would put the number in their place."""
        module = record.module
        for item in record.node.body:
            match item:
                case ast.AnnAssign(target=ast.Name(id=name)) if isinstance(self.defined_as(name), Constant):
                    self.report.add(module.file, RefusedError(item, f"{name} is also the name of a constant"))
                case ast.AnnAssign(target=ast.Name(id=name)) if record.fields.get(name) == VEC:
                    sentence = (
                        f"{name} of the record {record.name} in {module.name} is a Vec, a pointer in C, and a record"
                        " holds none: keep an offset, and hand the Vec to the functions as a parameter"
                    )
                    self.report.add(module.file, RefusedError(item, sentence))

    def _function(self, module: Module, node: ast.FunctionDef) -> None:
        arguments = node.args
        if node.decorator_list:
            raise RefusedError(node, f"{node.name} is decorated: C has no decorators")
        if arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.posonlyargs or arguments.defaults:
            raise RefusedError(node, f"{node.name} takes plain arguments only: no defaults, no *, no /")
        parameters: dict[str, Type] = {}
        for argument in arguments.args:
            check_name(argument, argument.arg)
            parameters[argument.arg] = kind = self.annotation(module, argument.annotation, argument)
            if kind is Scalar.NONE:
                raise RefusedError(argument, f"{argument.arg} holds nothing")
        returns = self.annotation(module, node.returns, node)
        if not isinstance(returns, Scalar):
            raise RefusedError(node, f"{node.name} returns {returns}: a function returns a number or None")
        exported = node.name in self.exports
        name_in_c = f"{self.prefix}{node.name}" if exported else c_name(node.name)
        self._define(Function(node.name, name_in_c, exported, parameters, returns, module, node))


def _is_final(annotation: ast.expr) -> bool:
    outer = annotation.value if isinstance(annotation, ast.Subscript) else annotation
    return isinstance(outer, ast.Name) and outer.id == "Final"


def _bound_by(node: ast.stmt) -> list[str]:
    """Return the module-level names that a statement would have bound."""
    match node:
        case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
            return [name]
        case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
            return [alias.asname or alias.name for alias in aliases]
    return [part.id for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)]
