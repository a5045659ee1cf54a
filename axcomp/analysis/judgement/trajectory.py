"""What an input file moves, by axis."""

from __future__ import annotations

from collections.abc import Mapping

from ...engine.motion import Array
from ...interface.variables import identifier
from ...model.machine import Axis, Machine

SEPARATORS = (".", "_")
"""Of ``X.setpoint`` and ``X_setpoint``."""


def column_of(trajectory: Mapping[str, Array], axis: Axis, quantity: str) -> Array | None:
    """Return a quantity (``setpoint``, ``acceleration`` …) of an axis; None if the file has no such column."""
    for separator in SEPARATORS:
        found = trajectory.get(f"{identifier(axis.name)}{separator}{quantity}")
        if found is not None:
            return found
    return None


def setpoints(trajectory: Mapping[str, Array], machine: Machine) -> dict[int, Array]:
    """Return the setpoints by axis number, of the axes that the file moves.

    Raises
    ------
    ValueError
        It moves none.
    """
    found = {axis.number: column_of(trajectory, axis, "setpoint") for axis in machine.axes}
    moved = {number: column for number, column in found.items() if column is not None}
    if not moved:
        names = ", ".join(f"{identifier(axis.name)}.setpoint" for axis in machine.axes[:3]) or "none, it has no axis"
        raise ValueError(f"the input file has no setpoint of an axis of this machine: {names}")
    return moved
