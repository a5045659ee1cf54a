"""Where the value of a variable is: a field of the kernel's records, or an element of a list in them."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from typing import Any, NamedTuple

_STEP = re.compile(r"(\w+)((?:\[\d+\])*)")
_INDEX = re.compile(r"\[(\d+)\]")


class Slot(NamedTuple):
    """A value in a record: ``read(container, key)`` returns it, ``write(container, key, value)`` sets it."""

    read: Callable[[Any, Any], Any]
    write: Callable[[Any, Any, Any], None]
    container: Any
    key: str | int

    def get(self) -> Any:
        """Return the value."""
        return self.read(self.container, self.key)

    def set(self, value: Any) -> None:
        """Set the value."""
        self.write(self.container, self.key, value)

    def as_real(self, kind: Callable[[float], Any]) -> Slot:
        """Return the same place as a Real; ``kind`` makes of it what is there."""
        return Slot(
            lambda container, key: float(self.read(container, key)),
            lambda container, key, value: self.write(container, key, kind(value)),
            self.container,
            self.key,
        )


def steps_of(path: str) -> list[str | int]:
    """Return the fields and indices of a path such as ``compensation.cross.need[2]``."""
    steps: list[str | int] = []
    for name, indices in _STEP.findall(path):
        steps += [name, *map(int, _INDEX.findall(indices))]
    return steps


def slot_in(record: Any, path: str) -> Slot | None:
    """Return where a path leads in a record; None if the record has no such field."""
    *before, last = steps_of(path)
    container = record
    for step in before:
        container = container[step] if isinstance(step, int) else getattr(container, step, None)
        if container is None:
            return None
    if isinstance(last, int):
        return Slot(operator.getitem, operator.setitem, container, last)
    return Slot(getattr, setattr, container, last) if hasattr(container, last) else None
