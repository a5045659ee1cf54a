"""Axis compensations of CNC machines: from the controller's lists to an FMU.

``Engine`` runs the lists' compensations; ``read_machine``, ``check`` and ``write_machine`` read, judge and write the
lists; ``build_fmu`` packs them; ``show``, ``measure``, ``create``, ``convert`` and ``budget`` do what the commands of
the same names do. The names are loaded when they are first used: the FMU's slave has no NumPy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import (
        Tables as Tables,
        budget as budget,
        build_fmu as build_fmu,
        check as check,
        convert as convert,
        create as create,
        measure as measure,
        show as show,
    )
    from .engine import Engine as Engine, Result as Result
    from .fmu import BuildError as BuildError, Built as Built
    from .lists import (
        Finding as Finding,
        ListError as ListError,
        Reading as Reading,
        Severity as Severity,
        read_machine as read_machine,
        write_machine as write_machine,
    )
    from .measurement import (
        Conditions as Conditions,
        Iso230Result as Iso230Result,
        MeasurementError as MeasurementError,
    )
    from .model import Axis as Axis, Curve as Curve, Grid as Grid, Machine as Machine, models as models

__version__ = "0.2.0"

_HOMES = {
    "api": "Tables budget build_fmu check convert create measure show",
    "engine": "Engine Result",
    "fmu": "BuildError Built",
    "lists": "Finding ListError Reading Severity read_machine write_machine",
    "measurement": "Conditions Iso230Result MeasurementError",
    "model": "Axis Curve Grid Machine models",
}
_ROOM_OF = {name: room for room, names in _HOMES.items() for name in names.split()}

__all__ = [
    "Axis",
    "BuildError",
    "Built",
    "Conditions",
    "Curve",
    "Engine",
    "Finding",
    "Grid",
    "Iso230Result",
    "ListError",
    "Machine",
    "MeasurementError",
    "Reading",
    "Result",
    "Severity",
    "Tables",
    "__version__",
    "budget",
    "build_fmu",
    "check",
    "convert",
    "create",
    "measure",
    "models",
    "read_machine",
    "show",
    "write_machine",
]


def __getattr__(name: str) -> Any:
    if name not in _ROOM_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = globals()[name] = getattr(import_module("." + _ROOM_OF[name], __name__), name)
    return found


def __dir__() -> list[str]:
    return sorted(__all__)
