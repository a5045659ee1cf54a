"""Leadscrew error compensation (``kw.ssfk``): an axis is corrected by its own position."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext

from ..model import Axis, Compensation, Curve, Machine
from . import shown
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, TableArray, TableReader
from .parameter import BELOW_MAX, DataType, Manual, Parameter, Quantity, Severity, activation, both, position
from .shown import Table, correction_of, position_of
from .units import equidistant, in_list, span

PREFIX = "kw.ssfk."
POSITIVE, NEGATIVE = f"{PREFIX}table[i].pos", f"{PREFIX}table[i].neg"
_SETPOINT = f"{PREFIX}table[i].setpoint"
_COUNT, _INTERVAL, _START = f"{PREFIX}kw_nr_max", f"{PREFIX}interval", f"{PREFIX}kw_startpos"
_BILATERAL, _MODULO, _ALONE = f"{PREFIX}bilateral", f"{PREFIX}modulo", f"{PREFIX}set_pos_without_comp"
_UNIT, _MAX_POINTS, _MANUAL = f"{PREFIX}unit", f"{PREFIX}max_points", f"{PREFIX}manual_activation"
_POINTS = 1500
_SPAN_TOLERANCE = 1e-9


def _all(number: str) -> dict[Manual, str]:
    return both(number) | {Manual.LEADSCREW: ""}


@dataclass(frozen=True, repr=False)
class Leadscrew(Compensation, kind="leadscrew"):
    """Leadscrew error compensation (``kw.ssfk``): subtracted from the setpoint of its own axis.

    Attributes
    ----------
    positions : tuple of float
        Interpolation points, strictly ascending (P-COMP-00018/00019/00025).
    positive : tuple of float
        Actual − programmed position in positive motion, one for each point (P-COMP-00023).
    negative : tuple of float or None
        The same in negative motion (P-COMP-00024); None: unilateral, ``positive`` serves both (P-COMP-00021).
    modulo : bool
        The position is folded into one modulo range of the axis, beginning at the first point (P-COMP-00022).
    without_other_compensations : bool
        Table position and direction come from the raw setpoint (P-COMP-00057).
    manual_activation : bool
        On only by command (P-COMP-00028).
    max_points : int
        Entries the controller reserves; cannot change while it runs (P-COMP-00059).
    """

    positions: tuple[float, ...]
    positive: tuple[float, ...]
    negative: tuple[float, ...] | None = None
    modulo: bool = False
    without_other_compensations: bool = False
    manual_activation: bool = False
    max_points: int = _POINTS

    def __repr__(self) -> str:
        sides = "unilateral" if self.negative is None else "bilateral"
        return f"Leadscrew({len(self.positions)} points {span(self.positions)}, {sides})"


class LeadscrewKind(Kind[Leadscrew]):
    """See the module."""

    name = "leadscrew"
    title = "Leadscrew error compensation"
    word = "LEAD"
    identifier = 28
    activator = activation("lr_param.ssfk", "leadscrew compensation", "00175")
    prefix = PREFIX
    parameters = (
        Parameter(_MAX_POINTS, "Reserved entries; 0: default", DataType.UNS32, _POINTS, both("00059")),
        Parameter(_UNIT, "Positions: 0 increments, 1 metric", DataType.BOOLEAN, 0, _all("00017")),
        Parameter(
            _INTERVAL,
            "Distance of points; 0: each has its setpoint",
            DataType.SGN32,
            0,
            _all("00018"),
            Quantity.POSITION,
            "[0, MAX)",
            typos=(f"{PREFIX}intervall",),
        ),
        position(_START, "First position", _all("00019")),
        Parameter(_COUNT, "Number of entries", DataType.SGN32, 0, _all("00020"), range="[0, MAX]"),
        Parameter(_BILATERAL, "Own values for negative motion", DataType.BOOLEAN, 0, _all("00021")),
        Parameter(_MODULO, "The table repeats with the modulo range", DataType.BOOLEAN, 0, _all("00022")),
        Parameter(_MANUAL, "On only by command", DataType.BOOLEAN, 0, both("00028")),
        Parameter(_ALONE, "Other compensations left out of the position", DataType.BOOLEAN, 0, both("00057")),
        position(POSITIVE, "Error in positive motion, actual − programmed", _all("00023")),
        position(NEGATIVE, "Error in negative motion, actual − programmed", _all("00024")),
        Parameter(
            _SETPOINT,
            "Position of a point",
            DataType.SGN64,
            0,
            _all("00025"),
            Quantity.POSITION,
            BELOW_MAX,
            aliases=(f"{PREFIX}table[i].sollw",),
        ),
    )
    values = ("positive", "negative")
    columns = (POSITIVE, NEGATIVE, _SETPOINT)
    sizes = (_COUNT,)
    places = (_INTERVAL, _START)
    reserves = _MAX_POINTS
    points_error = 110638
    arrays = (
        TableArray(
            0, "positions", "Positions of the points", "x", "{}", "positive.x", "positive.points", "", "argument"
        ),
        TableArray(
            1, "positive", "Actual − programmed position in positive motion", "y", "{}", "positive.y", "positive.points"
        ),
        TableArray(
            2, "negative", "Actual − programmed position in negative motion", "y", "{}", "negative.y", "negative.points"
        ),
    )
    codes = {
        "AXC-MODULO-AXIS": (
            Severity.WARNING,
            "A modulo table on an axis without modulo counting; it is read without modulo",
        ),
        "AXC-MODULO-SPAN": (Severity.ERROR, "A modulo table spans more than one modulo range"),
        "AXC-MODULO-SEAM": (Severity.WARNING, "A modulo table spans exactly one range and its end values differ"),
        "110638": (Severity.ERROR, "Leadscrew compensation: max_points was changed by an update"),
    }

    def read(self, source: TableReader) -> Leadscrew | None:
        """Return the compensation, None where its table cannot be used."""
        values = source.values
        count = values.integer(_COUNT)
        capacity = source.capacity(_MAX_POINTS)
        if not source.fits(count, capacity, _COUNT):
            return None
        [gear] = source.gears(_UNIT, source.axis)
        if values.number(_INTERVAL) > 0:
            source.note_unused(_SETPOINT, f"{_INTERVAL} gives the positions")
            points_name = _INTERVAL
            start, interval = values.number(_START), values.number(_INTERVAL)
            positions = equidistant(start, interval, count, Quantity.POSITION.divisor, gear)
        else:
            points_name = _SETPOINT
            positions = source.column(points_name, count, gear=gear)
        positive = source.column(POSITIVE, count, gear=gear)
        negative = source.column(NEGATIVE, count, gear=gear) if values.flag(_BILATERAL) else None
        if negative is None:
            source.note_unused(NEGATIVE, f"{_BILATERAL} is 0")
        if not source.ascending(positions, points_name, "AXC-ORDER", _COUNT):
            return None
        modulo = values.flag(_MODULO)
        if modulo and source.axis.modulo is None:
            message = f"Axis {source.axis.number} has no modulo range; the table is read without modulo."
            source.note("AXC-MODULO-AXIS", _MODULO, message)
            modulo = False
        if modulo and not _fits_modulo(source, positions, positive, negative):
            return None
        return Leadscrew(
            positions=tuple(positions),
            positive=tuple(positive),
            negative=None if negative is None else tuple(negative),
            modulo=modulo,
            without_other_compensations=values.flag(_ALONE),
            manual_activation=values.flag(_MANUAL),
            max_points=capacity,
        )

    def write(self, compensation: Leadscrew, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        leadscrew = compensation
        start, interval = _even_distance(leadscrew.positions)
        lines.add(_UNIT, 1)
        lines.add_unless_default(_MAX_POINTS, leadscrew.max_points)
        lines.add(_COUNT, len(leadscrew.positions))
        lines.add(_INTERVAL, interval)
        if interval:
            lines.add(_START, start)
        lines.add(_BILATERAL, leadscrew.negative is not None)
        lines.add_unless_default(_MODULO, leadscrew.modulo)
        lines.add_unless_default(_ALONE, leadscrew.without_other_compensations)
        lines.add_unless_default(_MANUAL, leadscrew.manual_activation)
        for i, place in enumerate(leadscrew.positions):
            if not interval:
                lines.add_converted(_SETPOINT, place, i)
            lines.add_converted(POSITIVE, leadscrew.positive[i], i)
            if leadscrew.negative is not None:
                lines.add_converted(NEGATIVE, leadscrew.negative[i], i)

    def compile(self, compensation: Leadscrew, compiler: AxisCompiler) -> None:
        """Fill the kernel's table; the way back to the first point of a modulo table becomes a section of its own."""
        leadscrew, table = compensation, compiler.tables.leadscrew
        positions, positive, negative = leadscrew.positions, leadscrew.positive, leadscrew.negative
        table.bilateral = negative is not None
        table.without_other = leadscrew.without_other_compensations
        table.reversal_cycles = max(1, compiler.axis.backlash_cycles)
        table.modulo_range = length = compiler.modulo_range
        if leadscrew.modulo:
            compiler.require(length > 0.0, "leadscrew: a modulo table needs a modulo axis")
            if positions and positions[-1] < positions[0] + length:
                positions = (*positions, positions[0] + length)
                positive = (*positive, positive[0])
                negative = None if negative is None else (*negative, negative[0])
        compiler.curve(table.positive, self.name, positions, positive)
        if negative is not None:
            compiler.curve(table.negative, self.name, positions, negative, x_at=table.positive.x)
        compiler.argument(table.argument, compiler.axis.number, positions[0], positions[-1])
        if leadscrew.modulo:
            table.argument.start = positions[0]

    def tables(self, compensation: Leadscrew, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return a curve for each direction, or one for both: actual − programmed, which is subtracted."""
        period = axis.modulo.end - axis.modulo.start if compensation.modulo and axis.modulo is not None else None
        sides = [(shown.BOTH if compensation.negative is None else shown.POSITIVE, compensation.positive, POSITIVE)]
        if compensation.negative is not None:
            sides.append((shown.NEGATIVE, compensation.negative, NEGATIVE))
        return tuple(
            Curve(
                compensation.positions,
                values,
                position_of(axis),
                correction_of(axis, "actual − programmed position"),
                period,
                label,
                entry,
                -1.0,
                "repeats" if period is not None else "",
            )
            for label, values, entry in sides
        )

    def follows(self, compensation: Leadscrew) -> bool:
        """Tell whether its position contains the corrections before it (P-COMP-00057)."""
        return not compensation.without_other_compensations


def _fits_modulo(
    source: TableReader, positions: Sequence[float], positive: Sequence[float], negative: Sequence[float] | None
) -> bool:
    """Check a modulo table against the axis' range: not longer, and closed where it is as long."""
    modulo = source.axis.modulo
    assert modulo is not None
    excess = positions[-1] - positions[0] - modulo.length
    if excess > _SPAN_TOLERANCE:
        message = f"The table is longer than the modulo range {modulo.start:g} … {modulo.end:g}"
        source.note("AXC-MODULO-SPAN", _MODULO, f"{message}; the compensation stays off.")
        return False
    sides = (positive,) if negative is None else (positive, negative)
    if abs(excess) <= _SPAN_TOLERANCE and any(side[0] != side[-1] for side in sides):
        message = "The table spans one modulo range but its first and last values differ; both are used, with a step."
        source.note("AXC-MODULO-SEAM", _MODULO, message)
    return True


def _even_distance(positions: tuple[float, ...]) -> tuple[int | Decimal, int | Decimal]:
    """Return start and interval in the unit of the list, interval 0 where they would not give these very positions."""
    if len(positions) > 1:
        start, second = (in_list(place, Quantity.POSITION) for place in positions[:2])
        with localcontext(prec=1000):
            interval = second - start
        rows = (next(row for row in KIND.parameters if row.name == name) for name in (_START, _INTERVAL))
        takes = all(row.takes(value) for row, value in zip(rows, (start, interval), strict=True))
        divisor = Quantity.POSITION.divisor
        if takes and equidistant(start, interval, len(positions), divisor) == list(positions):
            return start, interval
    return 0, 0


KIND = LeadscrewKind()
