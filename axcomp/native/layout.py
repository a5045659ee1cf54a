"""The kernel's records as C lays them out: ctypes structures made from the dataclasses, and copies both ways."""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Annotated, Any, get_args, get_origin

from ..interface import steps_of
from ..kernel import fields_of

_SCALARS = {float: ctypes.c_double, int: ctypes.c_int32, bool: ctypes.c_bool}


def ctypes_of(cls: Any) -> type[ctypes.Structure]:
    """Return the structure of a record class: the same fields in the same order as in the translated header.

    float → double, int → int32, bool → bool, records and arrays in place.
    """
    return _structure_of(cls)


@cache
def _structure_of(cls: Any) -> type[ctypes.Structure]:
    fields = [(name, _ctype(hint)) for name, hint in fields_of(cls).items()]
    return type(cls.__name__, (ctypes.Structure,), {"_fields_": fields})


def to_c(record: Any, struct: ctypes.Structure) -> None:
    """Copy a record into its structure; a list that is shorter than its array fills the front of it."""
    for name, hint in fields_of(type(record)).items():
        value = getattr(record, name)
        if hint in _SCALARS:
            setattr(struct, name, value)
        elif get_origin(hint) is Annotated:
            _list_to_c(value, getattr(struct, name))
        else:
            to_c(value, getattr(struct, name))


def from_c(struct: ctypes.Structure, record: Any) -> None:
    """Copy a structure into its record, in place."""
    for name, hint in fields_of(type(record)).items():
        if hint in _SCALARS:
            setattr(record, name, getattr(struct, name))
        elif get_origin(hint) is Annotated:
            _list_from_c(getattr(struct, name), getattr(record, name))
        else:
            from_c(getattr(struct, name), getattr(record, name))


def _ctype(hint: Any) -> Any:
    if hint in _SCALARS:
        return _SCALARS[hint]
    if get_origin(hint) is Annotated:
        return _ctype(get_args(get_args(hint)[0])[0]) * hint.__metadata__[0]
    return ctypes_of(hint)


def _list_to_c(values: list[Any], array: Any) -> None:
    if values and isinstance(array[0], ctypes.Structure):
        for record, struct in zip(values, array, strict=False):
            to_c(record, struct)
    else:
        array[: len(values)] = values


def offset_of(cls: Any, path: str) -> int:
    """Return how many bytes a field lies behind the begin of a record; ``path`` as in ``interface.slot``."""
    kind: Any = ctypes_of(cls)
    offset = 0
    for step in steps_of(path):
        if isinstance(step, int):
            kind = kind._type_
            offset += step * ctypes.sizeof(kind)
        else:
            offset += getattr(kind, step).offset
            kind = dict(kind._fields_)[step]
    return offset


def _list_from_c(array: Any, values: list[Any]) -> None:
    if values and isinstance(array[0], ctypes.Structure):
        for struct, record in zip(array, values, strict=False):
            from_c(struct, record)
    else:
        values[:] = array[: len(values)]
