"""The kernel's tables as numbers one behind the other: in images, and in the C that reads or initializes them.

``python -m axcomp.native`` writes ``records.c``.
"""

from __future__ import annotations

import struct
import textwrap
from collections.abc import Hashable, Iterator
from functools import cache
from typing import Annotated, Any, NamedTuple, cast, get_args, get_origin

from ..kernel import AxisTable, VolumetricTable, fields_of

GENERATED = "/* Generated from axcomp/interface/variables.py by `python -m axcomp.native`; do not edit. */"
_LETTERS = {float: "d", int: "i", bool: "b"}
_FORMATS = {float: "d", int: "i", bool: "?"}
_C_TYPES = {float: "double", int: "int32_t", bool: "bool"}
GENERATED = "/* Generated from axcomp/interface/declarations.py by `python -m axcomp.native`; do not edit. */"
ROOTS = {"axcomp_axis_parts": AxisTable, "axcomp_volumetric_parts": VolumetricTable}
"""Table of parts in C → record."""


class Part(NamedTuple):
    """A field of a record: ``length`` elements of a type; ``is_list``: in an array."""

    name: str
    type: Any
    length: int
    is_list: bool


def parts_of(cls: Any) -> tuple[Part, ...]:
    """Return the fields of a record."""
    return _parts_of(cls)


@cache
def _parts_of(cls: Hashable) -> tuple[Part, ...]:
    parts = []
    for name, hint in fields_of(cls).items():
        is_list = get_origin(hint) is Annotated
        element = get_args(get_args(hint)[0])[0] if is_list else hint
        parts.append(Part(name, element, hint.__metadata__[0] if is_list else 1, is_list))
    return tuple(parts)


@cache
def _format(cls: Hashable) -> str:
    return "".join(_FORMATS.get(part.type) or _format(part.type) for part in parts_of(cls) for _ in range(part.length))


def size_of(cls: Hashable) -> int:
    """Return how many bytes of an image a record has."""
    return struct.calcsize("<" + _format(cls))


def record_bytes(record: Any) -> bytes:
    """Return the fields of a record: little-endian, without gaps."""
    return struct.pack("<" + _format(cast(Hashable, type(record))), *_numbers(record))


def _numbers(record: Any) -> Iterator[float]:
    for part in parts_of(type(record)):
        value = getattr(record, part.name)
        for element in value if part.is_list else (value,):
            if part.type in _LETTERS:
                yield element
            else:
                yield from _numbers(element)


def initializer(value: Any) -> str:
    """Return a record, or what is in one, as C initializes it; zeros at the end of an array are left out."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list):
        used = [initializer(element) for element in value]
        while len(used) > 1 and not any(_numbers_in(value[len(used) - 1])):
            used.pop()
    else:
        used = [initializer(getattr(value, part.name)) for part in parts_of(type(value))]
    return f"{{{', '.join(used)}}}"


def _numbers_in(value: Any) -> Iterator[float]:
    return iter((value,)) if isinstance(value, bool | int | float) else _numbers(value)


def records_source() -> str:
    """Return the text of ``records.c``."""
    lines = [GENERATED, '#include "records.h"', ""]
    written: set[Any] = set()

    def name_of(cls: Any) -> str:
        return next((name for name, root in ROOTS.items() if root is cls), f"{cls.__name__}_parts")

    def write(cls: Any) -> None:
        if cls in written:
            return
        written.add(cls)
        for part in parts_of(cls):
            if part.type not in _LETTERS:
                write(part.type)
        lines.append(f"{'' if cls in ROOTS.values() else 'static '}const Part {name_of(cls)}[] = {{")
        for part in parts_of(cls):
            known = part.type in _LETTERS
            kind = _C_TYPES[part.type] if known else part.type.__name__
            inner = "NULL" if known else name_of(part.type)
            place = f"offsetof({cls.__name__}, {part.name})"
            lines.append(f"    {{'{_LETTERS.get(part.type, 'r')}', {part.length}, {place}, sizeof({kind}), {inner}}},")
        lines.extend(["    {0, 0, 0, 0, NULL}", "};", ""])

    for root in ROOTS.values():
        write(root)
    return "\n".join(lines)


def wrapped(text: str) -> str:
    """Return an initializer on lines that are not too long."""
    return textwrap.fill(text, 118, initial_indent="    ", subsequent_indent="    ", break_long_words=False)
