"""How well errors are known: a table with a row for each.

::

    parameter, standard_uncertainty, unit, correlation, compensation
    EXX, 0.8, um
    EAX, 2e-6
    C0Y, 1.5, urad
    X.leadscrew, 0.5, um, nodes

``parameter``: one of the 72 errors, or AXIS.KIND for a table of an axis compensation. ``unit``: mm where it is a
length and rad where it is an angle, if it is not given. ``correlation``: ``common``, one offset of the whole table (as
from the calibration of the instrument), which is what counts without it, or ``nodes``, an error of its own at each
interpolation point (as from repeatability). ``compensation``: 0 … 4, which volumetric compensation it belongs to;
without it, those that have a table of the error. All are normally distributed and independent of each other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...engine import SheetError, number, read_sheets
from ...kinds import KINDS, tables_of
from ...model import ERRORS, AxisType, Interpolation, Machine, is_angle

LENGTHS = {"mm": 1.0, "um": 1e-3, "nm": 1e-6, "m": 1e3}
ANGLES = {"rad": 1.0, "mrad": 1e-3, "urad": 1e-6, "deg": math.pi / 180.0, "arcsec": math.pi / 648000.0}
"""Units, and what they are worth in mm and rad."""

COLUMNS = ("parameter", "standard_uncertainty", "unit", "correlation", "compensation")
COMMON, NODES = "common", "nodes"


class UncertaintyError(ValueError):
    """A table of uncertainties that cannot be used: one sentence that begins with ``file:line:``."""


@dataclass(frozen=True)
class Uncertainty:
    """How well one error is known.

    Attributes
    ----------
    parameter : str
        One of ``volumetric.ERRORS``, or ``X.leadscrew``.
    value : float
        Standard uncertainty, mm or rad.
    nodes : bool
        Each interpolation point has an error of its own; else all have the same.
    compensation : int
        Index of the volumetric compensation; −1 for an axis compensation.
    """

    parameter: str
    value: float
    nodes: bool = False
    compensation: int = -1

    @property
    def label(self) -> str:
        """What it is of, as in the budget."""
        return self.parameter if self.compensation < 0 else f"volumetric[{self.compensation}] {self.parameter}"


def read_uncertainties(path: Path, machine: Machine) -> tuple[Uncertainty, ...]:
    """Read a table of uncertainties for a machine; UncertaintyError with file, line and what was expected."""
    try:
        sheets = read_sheets(path)
    except SheetError as error:
        raise UncertaintyError(str(error)) from None
    found: list[Uncertainty] = []
    header: list[str] = []
    for line, content in ((row.line, row.cells) for sheet in sheets for row in sheet.rows):
        try:
            if not header:
                header = _header(content)
                continue
            found += _row(dict(zip(header, content, strict=False)), machine)
            if len(content) > len(header):
                raise ValueError(f"There are {len(content)} cells for {len(header)} columns.")
        except ValueError as error:
            raise UncertaintyError(f"{path}:{line}: {error}") from None
        labels = [(one.label, one.nodes) for one in found]
        if len(set(labels)) < len(labels):
            raise UncertaintyError(f"{path}:{line}: {content[0]} stands here for the second time.")
    if not found:
        raise UncertaintyError(f"{path}: There is no uncertainty in it; expected the columns {', '.join(COLUMNS)}.")
    return tuple(found)


def _header(cells: Sequence[str]) -> list[str]:
    names = [cell.lower() for cell in cells]
    unknown = [name for name in names if name not in COLUMNS]
    if unknown or not {*COLUMNS[:2]} <= set(names) or len(set(names)) < len(names):
        raise ValueError(f"expected the columns {', '.join(COLUMNS)}, at least the first two, not {', '.join(cells)}.")
    return names


def _row(row: dict[str, str], machine: Machine) -> list[Uncertainty]:
    name = row.get(COLUMNS[0], "")
    units = ANGLES if name in ERRORS and is_angle(name) else LENGTHS
    unit = (row.get("unit") or next(iter(units))).replace("µ", "u").replace("μ", "u")
    if unit not in units:
        raise ValueError(f"{unit} is no unit of {name}; expected one of {', '.join(units)}.")
    written = row.get(COLUMNS[1], "")
    given = number(written)
    if given is None:
        raise ValueError(f"{written!r} is no number, as {COLUMNS[1]} has to be.")
    value = given * units[unit]
    if not 0.0 <= value < math.inf:
        raise ValueError(f"{COLUMNS[1]} is at least 0, not {written}.")
    correlation = row.get("correlation") or COMMON
    if correlation not in {COMMON, NODES}:
        raise ValueError(f"{correlation!r} is no correlation; expected {COMMON} or {NODES}.")
    nodes = correlation == NODES
    if name in ERRORS:
        return _of_error(name, value, nodes, row.get("compensation", ""), machine)
    if row.get("compensation"):
        raise ValueError(f"{name} belongs to no volumetric compensation.")
    return [_of_axis(name, value, nodes, machine)]


def _of_error(name: str, value: float, nodes: bool, index: str, machine: Machine) -> list[Uncertainty]:
    known = [str(one.index) for one in machine.volumetric]
    if not known:
        raise ValueError(f"the machine has no volumetric compensation that {name} could belong to.")
    if index and index not in known:
        raise ValueError(f"there is no volumetric compensation {index}; expected one of {', '.join(known)}.")
    chosen = []
    for one in machine.volumetric:
        letters = [letter for letter, _ in one.axes]
        if name[-1] not in letters or (index and str(one.index) != index):
            continue
        table = next((t for t in one.errors if t.name == name), None)
        # An error that another compensation has a table of is meant to be that one's.
        if not index and table is None and any(t.name == name for other in machine.volumetric for t in other.errors):
            continue
        if nodes and (table is None or len(table.arguments) != 1 or table.interpolation is not Interpolation.GRID):
            raise ValueError(f"{name} has no interpolation points along a single axis; expected correlation {COMMON}.")
        chosen.append(Uncertainty(name, value, nodes, one.index))
    if not chosen:
        raise ValueError(f"no volumetric compensation has an axis {name[-1]}.")
    return chosen


def _of_axis(name: str, value: float, nodes: bool, machine: Machine) -> Uncertainty:
    axis_name, _, kind = name.rpartition(".")
    axis = next((axis for axis in machine.axes if axis.name == axis_name), None)
    if axis is None or kind not in KINDS or kind == "friction" or getattr(axis, kind) is None:
        raise ValueError(f"{name or 'an empty cell'} is no error of the machine; expected one of the 72, or AXIS.KIND.")
    if axis.type is not AxisType.TRANSLATORY:
        letter = name[0] if name[0] in "ABC" else "C"
        raise ValueError(f"{axis_name} turns: give its uncertainty as E{letter}{letter} of a volumetric compensation.")
    if nodes and not any(tables.curves for tables in tables_of(machine, axis_name, kind)):
        raise ValueError(f"{name} has no interpolation points along a single axis; expected correlation {COMMON}.")
    return Uncertainty(name, value, nodes)
