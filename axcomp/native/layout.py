"""The kernel's records as C lays them out: ctypes structures made from the dataclasses, and copies both ways."""

from __future__ import annotations

import ctypes
from functools import cache
from typing import Annotated, Any, get_args, get_origin

from ..interface import steps_of
from ..kernel import APART, fields_of

_SCALARS = {float: ctypes.c_double, int: ctypes.c_int32, bool: ctypes.c_bool}


def ctypes_of(cls: Any) -> type[ctypes.Structure]:
    """Return the structure of a record class: the same fields in the same order as in the translated header.

    float → double, int → int32, bool → bool, records and arrays in place, arrays that lie apart as pointers.
    """
    return _structure_of(cls)


@cache
def _structure_of(cls: Any) -> type[ctypes.Structure]:
    fields = [(name, _ctype(hint)) for name, hint in fields_of(cls).items()]
    return type(cls.__name__, (ctypes.Structure,), {"_fields_": fields})


def to_c(record: Any, struct: ctypes.Structure) -> None:
    """Copy a record into its structure; a list that is shorter than its array fills the front of it.

    An array that lies apart is made as long as its list where the structure does not point to one yet.
    """
    for name, hint in fields_of(type(record)).items():
        value = getattr(record, name)
        if hint in _SCALARS:
            setattr(struct, name, value)
        elif get_origin(hint) is Annotated:
            array = getattr(struct, name)
            if _is_apart(hint) and not array:
                array = (array._type_ * max(len(value), 1))()
                setattr(struct, name, array)  # which keeps it alive
            _list_to_c(value, array)
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
        element = _ctype(get_args(get_args(hint)[0])[0])
        return ctypes.POINTER(element) if _is_apart(hint) else element * hint.__metadata__[0]
    return ctypes_of(hint)


def _is_apart(hint: Any) -> bool:
    return APART in hint.__metadata__


def _list_to_c(values: list[Any], array: Any) -> None:
    if issubclass(array._type_, ctypes.Structure):
        for record, struct in zip(values, array, strict=False):
            to_c(record, struct)
    else:
        for i, value in enumerate(values):  # a pointer takes no slices
            array[i] = value


def _list_from_c(array: Any, values: list[Any]) -> None:
    if issubclass(array._type_, ctypes.Structure):
        for i, record in enumerate(values):
            from_c(array[i], record)
    else:
        values[:] = array[: len(values)]


def address_of(struct: Any, path: str) -> int:
    """Return where in memory a field of a structure is; ``path`` as in ``interface.slot``."""
    *steps, last = steps_of(path)
    owner: Any = struct
    for step in steps:
        owner = owner[step] if isinstance(step, int) else getattr(owner, step)
    if isinstance(last, int):
        return ctypes.addressof(owner) + last * ctypes.sizeof(owner._type_)
    return ctypes.addressof(owner) + int(getattr(type(owner), last).offset)
