"""The five-axis example as it is commissioned: X, Y, Z first, then the tables B and C (manual 003, 5.2.2).

The values come from measurements on the plant (``measurement.simulated_volume``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...model import ERRORS, Axis, AxisType, ErrorTable, Machine, ModuloRange, Triple, Volumetric, is_angle
from ...plant import IsoErrors, Plant, linear_axis_errors, table_errors

NUMBERS = {"X": 1, "Y": 2, "Z": 3, "B": 5, "C": 6}
"""Logical axis numbers."""

TARGETS: Mapping[str, Sequence[float]] = {
    "X": [25.0 * i for i in range(-12, 13)],
    "Y": [25.0 * i for i in range(-10, 11)],
    "Z": [20.0 * i for i in range(-20, 1)],
    "B": [5.0 * i for i in range(-20, 21)],
    "C": [5.0 * i for i in range(73)],
}
"""Where the axes are measured, mm or °."""

CENTERS: Mapping[str, Triple] = {"A": (0.0, 0.0, 0.0), "B": (0.0, 0.0, -450.0), "C": (0.0, 0.0, -400.0)}
"""Points on the axes of the tables, from the drawing, mm."""

OVER_THE_TABLE = {"Z": -250.0}
TOOL_ORIENTATION = (0.0, 0.0, -1.0)
LIMIT = 1.0
"""Largest correction, mm."""
VELOCITY = 5.0
"""Largest velocity at which a correction is switched, mm/s."""


def five_axis(plant: Plant) -> Machine:
    """Return X, Y, Z, B and C, measured on ``models/five_axis``: a Cartesian compensation, then one of the tables."""
    linear = [(linear_axis_errors(plant, letter, TARGETS[letter]), letter) for letter in "XYZ"]
    tables = [
        (table_errors(plant, letter, CENTERS[letter], TARGETS[letter], OVER_THE_TABLE), letter) for letter in "BC"
    ]
    cartesian = Volumetric(
        index=0,
        axes=tuple((letter, NUMBERS[letter]) for letter in "XYZ"),
        chain="YXZ",
        errors=_tables(linear),
        tool_orientation=TOOL_ORIENTATION,
    )
    rotary = Volumetric(
        index=1,
        axes=tuple(NUMBERS.items()),
        chain="CBYXZ",
        workpiece_axes=2,
        errors=_tables(tables),
        tool_orientation=TOOL_ORIENTATION,
        centers=tuple(CENTERS.values()),
        files=("vol_comp1.exc",),
    )
    axes = [Axis(NUMBERS[letter], letter, volumetric_limit=LIMIT, volumetric_velocity=VELOCITY) for letter in "XYZ"]
    axes.append(Axis(NUMBERS["B"], "B", AxisType.ROTARY))
    axes.append(Axis(NUMBERS["C"], "C", AxisType.ROTARY, ModuloRange(0.0, 360.0)))
    return Machine(tuple(axes), (cartesian, rotary))


def _tables(measured: Sequence[tuple[IsoErrors, str]]) -> tuple[ErrorTable, ...]:
    """Return the errors as the tables of a compensation, in its order."""
    made: dict[str, ErrorTable] = {}
    for errors, letter in measured:
        nodes = tuple((target,) for target in TARGETS[letter])
        for name, value in errors.position.items():
            made[name] = ErrorTable(name, (_rounded(name, value),))
        for name, values in errors.component.items():
            made[name] = ErrorTable(name, tuple(_rounded(name, value) for value in values), letter, nodes)
    return tuple(made[name] for name in ERRORS if name in made)


def _rounded(name: str, value: float) -> float:
    """Round to 10 nm or 1 nrad: what instruments put out."""
    return float(np.round(value, 9 if is_angle(name) else 5)) + 0.0
