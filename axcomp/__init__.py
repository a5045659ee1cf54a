"""Axis compensations of CNC machines: from the controller's lists to an FMU.

``Engine`` runs the lists' compensations, ``read_machine`` and ``write_machine`` read and write the lists; the command
``axcomp`` does the rest. The names are loaded when they are first used: the FMU's slave has no NumPy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .engine import Engine, Result
    from .lists import read_machine, write_machine
    from .model import Machine

__version__ = "0.2.0"
__all__ = ["Engine", "Machine", "Result", "read_machine", "write_machine"]

_MODULES = {"Engine": "engine.engine", "Result": "engine.engine", "Machine": "model.machine", "read_machine": "lists"}
_MODULES["write_machine"] = "lists"


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_MODULES[name]}", __name__), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
