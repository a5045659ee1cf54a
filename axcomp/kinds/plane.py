"""Plane compensation (``kw.crosscomp2``): a slave is corrected over a grid of the positions of two masters."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from ..kernel import LARGEST
from ..model import Axis, AxisType, Compensation, Grid, Machine
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, Reference, TableArray, TableReader
from .parameter import (
    AXIS_NUMBER,
    DataType,
    Parameter,
    Quantity,
    Severity,
    activation,
    both,
    isg,
    position,
    smooth_switching,
)
from .shown import Table, correction_of, position_of

PREFIX = "kw.crosscomp2."
CORRECTION = f"{PREFIX}table[j][i].correction"
_LAST_INDEX = tuple(f"{PREFIX}last_index_master{i}" for i in (1, 2))
_START = tuple(f"{PREFIX}start_position_master{i}" for i in (1, 2))
_MASTER = tuple(f"{PREFIX}master{i}_ax_nr" for i in (1, 2))
_GRID, _INTERVAL, _UNIT = f"{PREFIX}grid", f"{PREFIX}interval", f"{PREFIX}unit"
_MAX_POINTS, _MANUAL, _CYCLES = f"{PREFIX}max_points", f"{PREFIX}manual_activation", f"{PREFIX}n_cycles"

POINTS = 10201
"""Entries of a plane where the list does not say how many (P-COMP-00061)."""

_LAST_INDEX_MAX = 100
"""Largest last index where the list does not say how many entries to reserve."""


@dataclass(frozen=True, repr=False)
class Plane(Compensation, kind="plane"):
    """Plane compensation (``kw.crosscomp2``): added to the slave, bilinear over the raw setpoints of two masters.

    Attributes
    ----------
    master1, master2 : int
        Logical numbers of the master axes (P-COMP-00014, P-COMP-00015).
    start1, start2 : float
        First grid position of either master (P-COMP-00012, P-COMP-00013).
    interval1, interval2 : float
        Distance of grid positions, > 0 (P-COMP-00009, P-COMP-00032, P-COMP-00033).
    corrections : tuple of tuple of float, shape (points of master 2, points of master 1)
        ``corrections[j][i]``: the first index belongs to the second master (P-COMP-00016).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00027).
    manual_activation : bool
        On only by command (P-COMP-00030).
    max_points : int or None
        Entries the controller reserves (P-COMP-00061); None where the list does not say: 10201, at most 101 each.
    """

    master1: int
    master2: int
    start1: float
    start2: float
    interval1: float
    interval2: float
    corrections: tuple[tuple[float, ...], ...]
    n_cycles: int = 0
    manual_activation: bool = False
    max_points: int | None = None

    def __repr__(self) -> str:
        rows, columns = len(self.corrections), len(self.corrections[0])
        return f"Plane(masters {self.master1} and {self.master2}, {columns} × {rows} points)"


class PlaneKind(Kind[Plane]):
    """See the module."""

    name = "plane"
    title = "Plane compensation"
    word = "PLANE"
    identifier = 20
    activator = activation("lr_param.crosscomp2", "plane compensation", "00174")
    prefix = PREFIX
    parameters = (
        Parameter(_MAX_POINTS, "Reserved entries; 0: default", DataType.UNS32, POINTS, both("00061")),
        Parameter(_UNIT, "Positions: 0 increments, 1 metric (discontinued)", DataType.BOOLEAN, 0, isg("00008")),
        Parameter(
            _GRID,
            "One distance for both masters, or one each",
            DataType.STRING,
            "QUADRATIC",
            both("00031"),
            values=("QUADRATIC", "RECTANGULAR"),
        ),
        *(
            Parameter(f"{_INTERVAL}{i}", meaning, DataType.UNS32, 0, both(number), Quantity.POSITION, "(0, MAX)")
            for i, meaning, number in (
                ("", "Distance of points, QUADRATIC", "00009"),
                ("1", "Distance of points of master 1, RECTANGULAR", "00032"),
                ("2", "Distance of points of master 2, RECTANGULAR", "00033"),
            )
        ),
        *(
            Parameter(name, f"Last index of master {i}", DataType.SGN32, 0, both(number), range="[0, MAX]")
            for i, (name, number) in enumerate(zip(_LAST_INDEX, ("00010", "00011"), strict=True), 1)
        ),
        *(
            position(name, f"First position of master {i}", both(number))
            for i, (name, number) in enumerate(zip(_START, ("00012", "00013"), strict=True), 1)
        ),
        *(
            Parameter(name, f"Logical number of master {i}", DataType.UNS16, 0, both(number), range=AXIS_NUMBER)
            for i, (name, number) in enumerate(zip(_MASTER, ("00014", "00015"), strict=True), 1)
        ),
        smooth_switching(_CYCLES, "00027"),
        Parameter(_MANUAL, "On only by command", DataType.BOOLEAN, 0, both("00030")),
        position(CORRECTION, "Correction of the slave; j counts master 2, i master 1", both("00016")),
    )
    values = ("corrections",)
    columns = (CORRECTION,)
    sizes = _LAST_INDEX
    places = _START
    reserves = _MAX_POINTS
    points_error = 110640
    arrays = (
        TableArray(
            0,
            "corrections",
            "Corrections: a row for each position of the second master",
            "y",
            "{}",
            "values",
            "points1",
            "points2",
        ),
    )
    at_standstill = True
    no_table_code = "70183"
    codes = {
        "70182": (Severity.ERROR, "Plane compensation: invalid master axis number"),
        "70183": (Severity.ERROR, "Plane compensation: no table"),
        "70184": (Severity.ERROR, "Plane compensation: wrong type of master axis"),
        "110640": (Severity.ERROR, "Plane compensation: max_points was changed by an update"),
    }

    def read(self, source: TableReader) -> Plane | None:
        """Return the compensation, None where its table cannot be used."""
        values = source.values
        columns, rows = (values.integer(name) + 1 for name in _LAST_INDEX)
        reserved = values.integer(_MAX_POINTS) if values.given(_MAX_POINTS) else 0
        if not values.count(CORRECTION):
            source.note("70183", _LAST_INDEX[0], "The plane compensation has no table; it stays off.")
            return None
        if not _fits(source, columns, rows, reserved):
            return None
        masters = [_master(source, name) for name in _MASTER]
        if masters[0] is None or masters[1] is None:
            return None
        gear1, gear2, slave_gear = source.gears(_UNIT, masters[0], masters[1], source.axis)
        rectangular = values.text(_GRID) == "RECTANGULAR"
        names = [f"{_INTERVAL}{i if rectangular else ''}" for i in (1, 2)]
        interval1, interval2 = (values.converted(n, gear=g) for n, g in zip(names, (gear1, gear2), strict=True))
        if not _usable_intervals(source, dict(zip(names, (interval1, interval2), strict=True))):
            return None
        corrections = source.column(CORRECTION, rows, columns, gear=slave_gear)
        return Plane(
            master1=masters[0].number,
            master2=masters[1].number,
            start1=values.converted(_START[0], gear=gear1),
            start2=values.converted(_START[1], gear=gear2),
            interval1=interval1,
            interval2=interval2,
            corrections=tuple(tuple(corrections[row * columns : (row + 1) * columns]) for row in range(rows)),
            n_cycles=values.integer(_CYCLES),
            manual_activation=values.flag(_MANUAL),
            max_points=reserved or None,
        )

    def write(self, compensation: Plane, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        lines.add(_UNIT, 1)
        if compensation.max_points is not None:
            lines.add(_MAX_POINTS, compensation.max_points)
        if compensation.interval1 == compensation.interval2:
            lines.add_converted(_INTERVAL, compensation.interval1)
        else:
            lines.add(_GRID, "RECTANGULAR")
            lines.add_converted(f"{_INTERVAL}1", compensation.interval1)
            lines.add_converted(f"{_INTERVAL}2", compensation.interval2)
        lines.add(_LAST_INDEX[0], len(compensation.corrections[0]) - 1)
        lines.add(_LAST_INDEX[1], len(compensation.corrections) - 1)
        lines.add_converted(_START[0], compensation.start1)
        lines.add_converted(_START[1], compensation.start2)
        lines.add(_MASTER[0], compensation.master1)
        lines.add(_MASTER[1], compensation.master2)
        lines.add_unless_default(_CYCLES, compensation.n_cycles)
        lines.add_unless_default(_MANUAL, compensation.manual_activation)
        for j, row in enumerate(compensation.corrections):
            for i, correction in enumerate(row):
                lines.add_converted(CORRECTION, correction, j, i)

    def compile(self, compensation: Plane, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        plane, table, require = compensation, compiler.tables.plane, compiler.require
        require(plane.interval1 > 0.0 and plane.interval2 > 0.0, "plane: the intervals must be above 0")
        require(abs(plane.start1) < LARGEST and abs(plane.start2) < LARGEST, "plane: the starts must be finite")
        table.points2 = len(plane.corrections)
        require(table.points2 > 0 and len(plane.corrections[0]) > 0, "plane: the table is empty")
        table.points1 = len(plane.corrections[0])
        require(all(len(row) == table.points1 for row in plane.corrections), "plane: the rows differ in length")
        table.start1, table.start2 = plane.start1, plane.start2
        table.interval1, table.interval2 = plane.interval1, plane.interval2
        table.values = compiler.append([value for row in plane.corrections for value in row])
        end1 = plane.start1 + (table.points1 - 1) * plane.interval1
        end2 = plane.start2 + (table.points2 - 1) * plane.interval2
        compiler.argument(table.master1, plane.master1, plane.start1, end1)
        compiler.argument(table.master2, plane.master2, plane.start2, end2)

    def tables(self, compensation: Plane, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return the grid over both masters."""
        over = (
            position_of(machine.numbered(compensation.master1)),
            position_of(machine.numbered(compensation.master2)),
        )
        x = tuple(compensation.start1 + compensation.interval1 * i for i in range(len(compensation.corrections[0])))
        y = tuple(compensation.start2 + compensation.interval2 * j for j in range(len(compensation.corrections)))
        return (Grid(x, y, compensation.corrections, over, correction_of(axis), entry=CORRECTION),)

    def needs(self, compensation: Plane, axis: Axis) -> tuple[int, ...]:
        """Return both masters and the slave."""
        return (compensation.master1, compensation.master2, axis.number)

    def looks_up(self, compensation: Plane, axis: Axis) -> Iterable[Reference]:
        """Return the masters' positions."""
        return ((compensation.master1, "setpoint"), (compensation.master2, "setpoint"))


def _fits(source: TableReader, columns: int, rows: int, reserved: int) -> bool:
    for name, count in zip(_LAST_INDEX, (columns, rows), strict=True):
        if not reserved and count > _LAST_INDEX_MAX + 1:
            message = f"{name} = {count - 1:,} is above {_LAST_INDEX_MAX}, and max_points does not reserve more"
            source.note("110647", name, f"{message}; the compensation stays off.")
            return False
    return source.fits(columns * rows, source.capacity(_MAX_POINTS), _LAST_INDEX[0])


def _master(source: TableReader, name: str) -> Any:
    axis = source.axis_of(name, "master", "70182")
    if axis is not None and axis.type is AxisType.SPINDLE:
        source.note(
            "70184", name, f"Axis {axis.number} is a spindle and cannot be a master; the compensation stays off."
        )
        return None
    source.note_own_master(name)
    return axis


def _usable_intervals(source: TableReader, intervals: dict[str, float]) -> bool:
    for name, interval in intervals.items():
        if not interval > 0.0:
            message = f"{name} is needed and must be above 0; the compensation stays off."
            source.note("AXC-INTERVAL", name, message)
            return False
    return True


KIND = PlaneKind()
