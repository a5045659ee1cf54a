"""The registry of kinds, in the order of a cycle.

``KINDS`` is made from the kernel's tables of an axis: a kind that stands there has a module of the same name here.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..model import Axis, Compensation
from .kind import KIND_NAMES, Kind

KINDS: dict[str, Kind[Any]] = {name: import_module(f".{name}", __package__).KIND for name in KIND_NAMES}
"""Name → kind, in the order of a cycle."""

Compensation.arrange(KIND_NAMES)


def kind_of(compensation: Compensation) -> Kind[Any]:
    """Return the kind of a compensation."""
    return KINDS[compensation.kind]


def kinds_of(axis: Axis) -> list[Kind[Any]]:
    """Return the kinds that an axis activates, with or without a table, in the order of a cycle."""
    return [KINDS[name] for name in axis.kinds]
