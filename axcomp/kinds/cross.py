"""Cross compensation (``kw.crosscomp``): a slave is corrected by the position of its master."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..model import Axis, Compensation, Curve, Machine
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, Reference, TableArray, TableReader
from .parameter import AXIS_NUMBER, DataType, Parameter, Severity, activation, both, isg, position, smooth_switching
from .shown import BOTH, Table, correction_of, position_of
from .units import span

PREFIX = "kw.crosscomp."
CORRECTION = f"{PREFIX}table[i].correction"
_SETPOINT = f"{PREFIX}table[i].setpoint"
_LAST_INDEX, _MASTER, _SLAVE = f"{PREFIX}last_index", f"{PREFIX}master_ax_nr", f"{PREFIX}slave_ax_nr"
_MAX_POINTS, _MANUAL, _CYCLES = f"{PREFIX}max_points", f"{PREFIX}manual_activation", f"{PREFIX}n_cycles"
_POINTS = 1001


@dataclass(frozen=True, repr=False)
class Cross(Compensation, kind="cross"):
    """Cross (sag) compensation (``kw.crosscomp``): added to the slave, looked up at the master's raw setpoint.

    Attributes
    ----------
    master : int
        Logical number of the master axis (P-COMP-00005).
    positions : tuple of float
        Master positions, strictly ascending (P-COMP-00006).
    corrections : tuple of float
        Correction of the slave, one for each position (P-COMP-00007).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00026).
    manual_activation : bool
        On only by command (P-COMP-00029).
    max_points : int
        Entries the controller reserves (P-COMP-00060).
    """

    master: int
    positions: tuple[float, ...]
    corrections: tuple[float, ...]
    n_cycles: int = 0
    manual_activation: bool = False
    max_points: int = _POINTS

    def __repr__(self) -> str:
        return f"Cross(master {self.master}, {len(self.positions)} points {span(self.positions)})"


class CrossKind(Kind[Cross]):
    """See the module."""

    name = "cross"
    title = "Cross compensation"
    word = "CROSS"
    identifier = 16
    activator = activation("lr_param.crosscomp", "cross compensation", "00047")
    prefix = PREFIX
    parameters = (
        Parameter(_MAX_POINTS, "Reserved entries; 0: default", DataType.UNS32, _POINTS, both("00060")),
        Parameter(
            f"{PREFIX}unit", "Positions: 0 increments, 1 metric (discontinued)", DataType.BOOLEAN, 0, isg("00003")
        ),
        Parameter(_LAST_INDEX, "Last index of the table", DataType.SGN32, 0, both("00004"), range="[0, MAX]"),
        Parameter(
            _MASTER,
            "Logical number of the master",
            DataType.UNS16,
            0,
            both("00005"),
            range=AXIS_NUMBER,
            aliases=(_SLAVE,),
        ),
        smooth_switching(_CYCLES, "00026"),
        Parameter(_MANUAL, "On only by command", DataType.BOOLEAN, 0, both("00029")),
        position(_SETPOINT, "Position of the master", both("00006"), aliases=(f"{PREFIX}table[i].sollw",)),
        position(CORRECTION, "Correction of the slave", both("00007")),
    )
    values = ("corrections",)
    columns = (_SETPOINT, CORRECTION)
    sizes = (_LAST_INDEX,)
    reserves = _MAX_POINTS
    points_error = 110639
    arrays = (
        TableArray(0, "positions", "Positions of the master", "x", "{}", "curve.x", "curve.points", "", "master"),
        TableArray(1, "corrections", "Corrections of the slave there", "y", "{}", "curve.y", "curve.points"),
    )
    at_standstill = True
    codes = {
        "AXC-SLAVE": (Severity.WARNING, "Cross compensation: slave_ax_nr is read as the number of the master"),
        "70245": (Severity.ERROR, "Cross compensation: setpoints are not ascending"),
        "110639": (Severity.ERROR, "Cross compensation: max_points was changed by an update"),
    }

    def read(self, source: TableReader) -> Cross | None:
        """Return the compensation, None where its table cannot be used."""
        values = source.values
        count = values.integer(_LAST_INDEX) + 1
        capacity = source.capacity(_MAX_POINTS)
        if not source.fits(count, capacity, _LAST_INDEX):
            return None
        master = source.axis_of(_MASTER, "master")
        if master is None:
            return None
        if values.spelt(_SLAVE):
            corrected = f"axis {source.axis.number}, whose list this is, is corrected by the position of axis"
            source.note("AXC-SLAVE", _SLAVE, f"{_SLAVE} names the master: {corrected} {master.number}.")
        source.note_own_master(_MASTER)
        # Positions are the master's, so they count in its increments.
        master_gear, slave_gear = source.gears(f"{PREFIX}unit", master, source.axis)
        positions = source.column(_SETPOINT, count, gear=master_gear)
        corrections = source.column(CORRECTION, count, gear=slave_gear)
        if not source.ascending(positions, _SETPOINT, "70245", _LAST_INDEX):
            return None
        return Cross(
            master=master.number,
            positions=tuple(positions),
            corrections=tuple(corrections),
            n_cycles=values.integer(_CYCLES),
            manual_activation=values.flag(_MANUAL),
            max_points=capacity,
        )

    def write(self, compensation: Cross, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        lines.add(f"{PREFIX}unit", 1)
        lines.add_unless_default(_MAX_POINTS, compensation.max_points)
        lines.add(_LAST_INDEX, len(compensation.positions) - 1)
        lines.add(_MASTER, compensation.master)
        lines.add_unless_default(_CYCLES, compensation.n_cycles)
        lines.add_unless_default(_MANUAL, compensation.manual_activation)
        for i, row in enumerate(zip(compensation.positions, compensation.corrections, strict=True)):
            for name, value in zip((_SETPOINT, CORRECTION), row, strict=True):
                lines.add_converted(name, value, i)

    def compile(self, compensation: Cross, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        table, x = compiler.tables.cross, compensation.positions
        compiler.curve(table.curve, self.name, x, compensation.corrections)
        compiler.argument(table.master, compensation.master, x[0], x[-1])

    def tables(self, compensation: Cross, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return the curve over the master."""
        over = position_of(machine.numbered(compensation.master))
        return (
            Curve(
                compensation.positions,
                compensation.corrections,
                over,
                correction_of(axis),
                label=BOTH,
                entry=CORRECTION,
            ),
        )

    def needs(self, compensation: Cross, axis: Axis) -> tuple[int, ...]:
        """Return the master."""
        return (compensation.master,)

    def looks_up(self, compensation: Cross, axis: Axis) -> Iterable[Reference]:
        """Return the master's position."""
        return ((compensation.master, "setpoint"),)


KIND = CrossKind()
