"""."""

from __future__ import annotations

from .declarations import (
    AXIS_BLOCK,
    AXIS_DECLARATIONS,
    MACHINE_BLOCK,
    OF_MACHINE,
    OF_VOLUMETRIC,
    VOLUMETRIC_BLOCK,
    Declaration,
)
from .errors import ERROR_CALL, ERRORS
from .reference import PAGE, README, readme_with_section, reference_page
from .slot import Slot, slot_in, steps_of
from .variable import BLOCK, TYPE_NAMES, Value, Variable, whole, with_causality
from .variables import Controls, Naming, Types, by_name, every_slot, identifier, slot_of, variables_of

__all__ = [
    "AXIS_BLOCK",
    "AXIS_DECLARATIONS",
    "BLOCK",
    "ERRORS",
    "ERROR_CALL",
    "MACHINE_BLOCK",
    "OF_MACHINE",
    "OF_VOLUMETRIC",
    "PAGE",
    "README",
    "TYPE_NAMES",
    "VOLUMETRIC_BLOCK",
    "Controls",
    "Declaration",
    "Naming",
    "Slot",
    "Types",
    "Value",
    "Variable",
    "by_name",
    "every_slot",
    "identifier",
    "readme_with_section",
    "reference_page",
    "slot_in",
    "slot_of",
    "steps_of",
    "variables_of",
    "whole",
    "with_causality",
]
