"""What the numbers of the output ``error`` mean."""

from __future__ import annotations

from ..kernel import (
    ERROR_INPUT,
    ERROR_LIMIT_EXCEEDED,
    ERROR_LIMIT_UNDEFINED,
    ERROR_PROGRAM_END,
    ERROR_SINGULAR,
    ERROR_SWITCH,
    ERROR_UPDATE,
)
from ..kinds import KINDS

ERROR_CALL = 903  # AXC-903

ERRORS = {
    ERROR_INPUT: "An input of the axis is not a finite number; its outputs are held",
    ERROR_UPDATE: "The lists read by `reload` are refused, the old ones stay in force; the log says why",
    ERROR_SWITCH: "A switch of the axis, or of a volumetric compensation of it, was neither -1, 0 nor 1: it commanded "
    "nothing, what was commanded before holds",
    ERROR_CALL: "A call of the FMU could not be carried out; the log says why",
    ERROR_LIMIT_UNDEFINED: "A volumetric compensation cannot be switched on: the axis has no s_limit (P-AXIS-00525)",
    ERROR_LIMIT_EXCEEDED: "A volumetric correction was above the axis' s_limit; it is held, the compensation is off",
    ERROR_SINGULAR: "X, Y and Z cannot move the tool in three directions here; a volumetric compensation is off",
    ERROR_PROGRAM_END: "The program ended while a volumetric compensation of its channel was on; it is off",
    **{
        kind.points_error: f"`reload` changes max_points of the {kind.name} compensation; the axis keeps its old lists"
        for kind in KINDS.values()
        if kind.points_error
    },
}
"""Number → meaning, in the order of the reference page."""
