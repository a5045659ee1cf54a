"""Records of the kernel as plain Python: nothing here is needed by the C side.

A record is a dataclass with slots whose fields are float, int, bool, another record, ``Vec`` (a table owned by someone
else) or ``Annotated[list[T], N]`` (N elements of T). ``zero`` makes one with everything 0; C makes it with memset.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from functools import cache
from typing import Annotated, Any, TypeVar, cast, get_args, get_origin, get_type_hints

Vec = list[float]
"""A table of floats owned by the caller; in C ``const double *``."""

Record = TypeVar("Record")

_NUMBERS = (float, int, bool)


def whole(x: float) -> float:
    """Return the largest whole number not above ``x``, as a float; in C ``floor(x) + 0.0`` (never −0)."""
    return float(math.floor(x))


def zeros(n: int) -> list[float]:
    """Return a local array of ``n`` zeros; in C ``double name[n] = {0}``."""
    return [0.0] * n


def zero(cls: type[Record]) -> Record:
    """Return a record of class ``cls`` with every number 0, every Boolean False and every ``Vec`` empty."""
    return cls(**{name: _zero_of(hint) for name, hint in fields_of(cast(Hashable, cls)).items()})


@cache
def fields_of(cls: Hashable) -> dict[str, Any]:
    """Return the fields of a record class in declaration order: name → type, with its length where it has one."""
    return get_type_hints(cast(type, cls), include_extras=True)


def _zero_of(hint: Any) -> Any:
    if get_origin(hint) is Annotated:
        element = get_args(get_args(hint)[0])[0]
        length = hint.__metadata__[0]
        return [element()] * length if element in _NUMBERS else [_zero_of(element) for _ in range(length)]
    if hint in _NUMBERS:
        return hint()
    if hint == Vec:
        return []
    return zero(hint)
