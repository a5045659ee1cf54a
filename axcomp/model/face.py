"""The face of a room: the names it offers, imported from its modules when they are first used.

So a command loads only what it runs: a room that draws does not load Matplotlib for one that counts.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any


def face(room: str, **modules: str) -> tuple[list[str], Callable[[str], Any], Callable[[], list[str]]]:
    """Return ``__all__``, ``__getattr__`` and ``__dir__`` of a room.

    Parameters
    ----------
    room : str
        Its ``__name__``.
    **modules : str
        The names that each of its modules offers, separated by blanks.
    """
    homes = {name: module for module, names in modules.items() for name in names.split()}
    if shared := homes.keys() & modules.keys():
        raise ValueError(f"{room}: {', '.join(shared)} would be hidden by the module of that name")

    def getattribute(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {room!r} has no attribute {name!r}")
        found = getattr(import_module(f".{homes[name]}", room), name)
        setattr(sys.modules[room], name, found)
        return found

    return sorted(homes), getattribute, lambda: sorted(homes)
