"""What FMI 2.0 knows about one variable of an FMU, and what one number of its value reference means."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Value = float | int | bool | str

Causality = Literal["input", "output", "parameter"]
Limits = tuple[float, float]
Variability = Literal["continuous", "discrete", "fixed", "tunable"]

BLOCK = 64
"""Value references of one block: a reference is ``BLOCK * block + identifier``, whatever the machine is."""


@dataclass(frozen=True)
class Variable:
    """One variable of an FMU.

    Attributes
    ----------
    name : str
        As the host sees it.
    reference : int
        Value reference; no other variable of the FMU has it.
    causality : str
        ``input``, ``output`` or ``parameter``.
    start : float, int, bool or str
        Value before anybody sets it. Its type is the type of the variable: Real, Integer, Boolean or String.
    description : str
        One sentence without a full stop.
    unit : str
        One of ``description.UNITS``, "" for none.
    variability : str
        ``continuous`` for Real and ``discrete`` for other inputs and outputs; ``fixed`` or ``tunable`` for parameters.
    depends_on : tuple of str or None
        Names of the inputs an output is computed from; None: of all inputs.
    axis : int or None
        Place of its axis in the machine; None: it belongs to no axis.
    field : str
        Path of its field in the record of its block (see ``variables.slot_of``).
    volumetric : int or None
        Number of its volumetric compensation; None: it belongs to none.
    quantity : str
        Its name behind that of its axis or compensation: ``setpoint``, ``cross.correction``.
    limits : (float, float) or None
        Least and largest value that is of use; None: any is.
    nominal : float or None
        About how large its values are.
    """

    name: str
    reference: int
    causality: Causality
    start: Value
    description: str
    unit: str = ""
    variability: Variability = "continuous"
    depends_on: tuple[str, ...] | None = ()
    axis: int | None = None
    field: str = ""
    volumetric: int | None = None
    quantity: str = ""
    limits: Limits | None = None
    nominal: float | None = None

    @property
    def type(self) -> str:
        """Name of the type in FMI."""
        return TYPE_NAMES[type(self.start)]


INTEGER_MAX = 2**31 - 1


def whole(value: float) -> int:
    """Return the nearest integer of 32 bits; of what has none the largest, which is no value of a switch."""
    return math.floor(value + 0.5) if abs(value) < INTEGER_MAX else INTEGER_MAX


TYPE_NAMES = {float: "Real", int: "Integer", bool: "Boolean", str: "String"}


def with_causality(variables: Iterable[Variable], causality: Causality) -> tuple[Variable, ...]:
    """Return the inputs, the outputs or the parameters, in their order."""
    return tuple(variable for variable in variables if variable.causality == causality)
