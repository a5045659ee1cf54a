"""."""

from __future__ import annotations

from .arrays import TABLE_BLOCK, TIME_REFERENCE, ArrayVariable, arrays_of, every_array
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
from .variable import BLOCK, INTEGER_MAX, TYPE_NAMES, Value, Variable, whole, with_causality
from .variables import Controls, Naming, Types, by_name, every_slot, identifier, slot_of, variables_of

__all__ = [
    "AXIS_BLOCK",
    "AXIS_DECLARATIONS",
    "BLOCK",
    "ERRORS",
    "ERROR_CALL",
    "INTEGER_MAX",
    "MACHINE_BLOCK",
    "OF_MACHINE",
    "OF_VOLUMETRIC",
    "PAGE",
    "README",
    "TABLE_BLOCK",
    "TIME_REFERENCE",
    "TYPE_NAMES",
    "VOLUMETRIC_BLOCK",
    "ArrayVariable",
    "Controls",
    "Declaration",
    "Naming",
    "Slot",
    "Types",
    "Value",
    "Variable",
    "arrays_of",
    "by_name",
    "every_array",
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
