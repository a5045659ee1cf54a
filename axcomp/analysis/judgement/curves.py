"""The tables of a machine as what a judgement looks at: values over positions, and where each of them stands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ...convert.machines import tables_of
from ...convert.table import CompensationTable, closed
from ...kinds.plane import Plane
from ...model.machine import Axis, Machine

Array = npt.NDArray[np.float64]

PER_MILLE = 1e3
"""mm to µm, ° to 0.001°."""

_LEADSCREW = {1: "kw.ssfk.table[i].pos", -1: "kw.ssfk.table[i].neg"}
CROSS_ENTRY = "kw.crosscomp.table[i].correction"
PLANE_ENTRY = "kw.crosscomp2.table[j][i].correction"


@dataclass(frozen=True, eq=False)
class Curve:
    """One column of a leadscrew or cross table.

    Attributes
    ----------
    axis, over : Axis
        The axis that is corrected, and the one whose position counts.
    kind : str
        ``leadscrew`` or ``cross``.
    direction : int
        1 or −1: of which motion; 0: of both.
    entry : str
        Name of its entries in the list.
    table : CompensationTable
        As ``convert.machines.tables_of`` returns it: values are what is added to the setpoint.
    """

    axis: Axis
    over: Axis
    kind: str
    direction: int
    entry: str
    table: CompensationTable

    @property
    def positions(self) -> Array:
        """Return the points, shape (n,), mm or °; a table that repeats ends with the repetition of its first point."""
        return np.array(closed(self.table).positions)

    @property
    def values(self) -> Array:
        """Return what is added at each of the points, shape (n,), mm or °."""
        return np.array(closed(self.table).curve(self.direction or 1))

    @property
    def name(self) -> str:
        """Return the curve in words."""
        side = {1: ", positive motion", -1: ", negative motion", 0: ""}[self.direction]
        return f"{table_name(self.axis, self.kind, self.over)}{side}"


def curves_of(machine: Machine) -> Iterator[Curve]:
    """Yield the columns of all leadscrew and cross tables of a machine."""
    for axis in machine.axes:
        for kind in ("leadscrew", "cross"):
            if getattr(axis, kind) is None:
                continue
            [table] = tables_of(machine, axis.name, kind)
            over = machine.axis(table.over)
            if kind == "cross":
                yield Curve(axis, over, kind, 0, CROSS_ENTRY, table)
            elif table.negative is None:
                yield Curve(axis, over, kind, 0, _LEADSCREW[1], table)
            else:
                yield from (Curve(axis, over, kind, d, _LEADSCREW[d], table) for d in (1, -1))


@dataclass(frozen=True, eq=False)
class Grid:
    """The table of a plane compensation.

    Attributes
    ----------
    axis, first, second : Axis
        The axis that is corrected, and its masters.
    across, up : array, shape (nx,) and (ny,)
        Positions of the masters, mm or °.
    values : array, shape (ny, nx)
        What is added, mm or °.
    """

    axis: Axis
    first: Axis
    second: Axis
    across: Array
    up: Array
    values: Array

    @property
    def name(self) -> str:
        """Return the table in words."""
        return f"the plane table of {self.axis.name} over {self.first.name} and {self.second.name}"


def grids_of(machine: Machine) -> Iterator[Grid]:
    """Yield the tables of all plane compensations of a machine."""
    for axis in machine.axes:
        plane = axis.plane
        if isinstance(plane, Plane):
            values = np.array(plane.corrections)
            yield Grid(
                axis,
                machine.axes[machine.index_of(plane.master1)],
                machine.axes[machine.index_of(plane.master2)],
                plane.start1 + plane.interval1 * np.arange(float(values.shape[1])),
                plane.start2 + plane.interval2 * np.arange(float(values.shape[0])),
                values,
            )


def table_name(axis: Axis, kind: str, over: Axis) -> str:
    """Return a table in words, as sentences begin with it."""
    where = "" if axis == over else f" over {over.name}"
    return f"the {kind} table of {axis.name}{where}"


def rate(value: float) -> str:
    """Return a velocity or an acceleration in words: four digits, never with an exponent where it is large."""
    return f"{value:.0f}" if abs(value) >= 1e3 else f"{value:.4g}"


def unit_of(axis: Axis) -> str:
    """Return the unit of an axis' positions as sentences have it."""
    return "mm" if axis.unit == "mm" else "°"


def thousandth_of(axis: Axis) -> str:
    """Return the unit of an axis' corrections as sentences have it."""
    return "µm" if axis.unit == "mm" else "m°"
