"""Records of the kernel as plain Python: nothing here is needed by the C side.

A record is a dataclass with slots whose fields are float, int, bool, another record, ``Vec`` (a table owned by someone
else) or ``Annotated[list[T], N]`` (N elements of T; with ``APART`` behind it, at most N). ``zero`` makes one with
everything 0; C makes it with memset.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterator
from functools import cache, partial
from typing import Annotated, Any, TypeVar, cast, get_args, get_origin, get_type_hints

Vec = list[float]
"""A table of floats owned by the caller; in C ``const double *``."""

APART = "apart"
"""Marks a list of a record that is as long as the machine needs: in C it lies apart, and the record points to it."""

Record = TypeVar("Record")

_NUMBERS = (float, int, bool)


def whole(x: float) -> float:
    """Return the largest whole number not above ``x``, as a float; in C ``floor(x) + 0.0`` (never −0)."""
    return float(math.floor(x))


def sound(record: Any) -> bool:
    """Tell whether every number of a record is finite; in C also whether every Boolean is 0 or 1."""
    return decided(record) and all(map(math.isfinite, _numbers_of(record)))


def decided(record: Any) -> bool:
    """Tell whether every Boolean of a record is 0 or 1: in Python always."""
    return record is not None


def _numbers_of(value: Any) -> Iterator[float]:
    if isinstance(value, list):
        for element in value:
            yield from _numbers_of(element)
    elif isinstance(value, _NUMBERS):
        yield value
    else:
        for name in fields_of(type(value)):
            yield from _numbers_of(getattr(value, name))


def zeros(n: int) -> list[float]:
    """Return a local array of ``n`` zeros; in C ``double name[n] = {0}``."""
    return [0.0] * n


def zero(cls: type[Record]) -> Record:
    """Return a record of class ``cls`` with every number 0, every Boolean False and every ``Vec`` empty."""
    return cls(*[make() for make in _makers_of(cast(Hashable, cls))])


def fields_of(cls: Any) -> dict[str, Any]:
    """Return the fields of a record class in declaration order: name → type, with its length where it has one."""
    return _fields_of(cls)


@cache
def _fields_of(cls: Hashable) -> dict[str, Any]:
    return get_type_hints(cast(type, cls), include_extras=True)


@cache
def _makers_of(cls: Hashable) -> tuple[Callable[[], Any], ...]:
    return tuple(_maker_of(hint) for hint in fields_of(cls).values())


def _maker_of(hint: Any) -> Callable[[], Any]:
    """Return what makes the zero of a field: an engine has thousands of them."""
    if get_origin(hint) is Annotated:
        element = get_args(get_args(hint)[0])[0]
        length = hint.__metadata__[0]
        if element in _NUMBERS:
            return lambda: [element()] * length
        return lambda: [zero(element) for _ in range(length)]
    if hint in _NUMBERS:
        return cast(Callable[[], Any], hint)
    return list if hint == Vec else partial(zero, hint)
