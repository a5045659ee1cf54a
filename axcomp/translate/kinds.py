"""Types of the subset and how C declares them."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field
from typing import TypeAlias


class Scalar(enum.Enum):
    """A number or truth value, held by value; the value is the type in C."""

    INT = "int32_t"
    FLOAT = "double"
    BOOL = "bool"
    NONE = "void"

    def __str__(self) -> str:
        """Return the type as Python writes it."""
        return {"INT": "int", "FLOAT": "float", "BOOL": "bool", "NONE": "None"}[self.name]


@dataclass(frozen=True)
class RecordType:
    """A record: a struct, always handled through a pointer."""

    name: str

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class ArrayType:
    """``Annotated[list[element], length]`` or ``zeros(length)``: an array of fixed length.

    The element is never Scalar.NONE; ``length_text``: the length as C writes it, a number or the name of a constant;
    ``apart``: a record points to it, and it may be shorter.
    """

    element: Scalar | RecordType
    length: int
    length_text: str = field(compare=False)
    apart: bool = field(default=False, compare=False)

    def __str__(self) -> str:
        return f"list[{self.element}] of length {self.length}"


@dataclass(frozen=True)
class VecType:
    """``Vec``: a table of floats that belongs to someone else and is only read."""

    def __str__(self) -> str:
        return "Vec"


VEC = VecType()
Type: TypeAlias = Scalar | RecordType | ArrayType | VecType
NUMBERS = (Scalar.INT, Scalar.FLOAT, Scalar.BOOL)


def element_of(kind: ArrayType | VecType) -> Scalar | RecordType:
    """Return the type of one element."""
    return kind.element if isinstance(kind, ArrayType) else Scalar.FLOAT


def _base(kind: Scalar | RecordType) -> str:
    return kind.value if isinstance(kind, Scalar) else kind.name


def parameter(kind: Type, name: str, *, const: bool) -> str:
    """Declare a parameter; ``const``: nothing is written through it."""
    if isinstance(kind, ArrayType):
        return f"{'const ' if const else ''}{struct_field(kind, name)}"
    return local(kind, name, const=const)


def local(kind: Type, name: str, *, const: bool) -> str:
    """Declare a local, a pointer if it stands for a record, an array or a table."""
    qualifier = "const " if const or isinstance(kind, VecType) else ""
    match kind:
        case Scalar():
            return f"{kind.value} {name}"
        case RecordType():
            return f"{qualifier}{kind.name} *{name}"
        case ArrayType() | VecType():
            return f"{qualifier}{_base(element_of(kind))} *{name}"


def struct_field(kind: Type, name: str) -> str:
    """Declare a field of a struct, which holds its records and most arrays itself, and no Vec."""
    assert not isinstance(kind, VecType)
    if isinstance(kind, ArrayType):
        if kind.apart:
            return f"{_base(kind.element)} *{name}"
        return f"{_base(kind.element)} {name}[{kind.length_text}]"
    return f"{_base(kind)} {name}"
