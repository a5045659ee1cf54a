"""Leadscrew error compensation (``kw.ssfk``): list to ``Leadscrew`` and back."""

from __future__ import annotations

from decimal import Decimal, localcontext

from ..model.machine import Leadscrew
from .catalogue import parameter
from .compensation import CompensationList
from .format import Lines, in_list
from .parameter import ListKind, Quantity
from .values import equidistant

TABLES = ("kw.ssfk.table[i].pos", "kw.ssfk.table[i].neg", "kw.ssfk.table[i].setpoint")
SIZES = ("kw.ssfk.kw_nr_max",)

_SPAN_TOLERANCE = 1e-9


def read_leadscrew(source: CompensationList) -> Leadscrew | None:
    """Return the compensation, None where its table cannot be used."""
    values = source.values
    count = values.integer("kw.ssfk.kw_nr_max")
    capacity = source.capacity("kw.ssfk.max_points")
    if not source.fits(count, capacity, "kw.ssfk.kw_nr_max"):
        return None
    [gear] = source.gears("kw.ssfk.unit", source.axis)
    if values.number("kw.ssfk.interval") > 0:
        source.note_unused("kw.ssfk.table[i].setpoint", "kw.ssfk.interval gives the positions")
        points_name = "kw.ssfk.interval"
        start, interval = values.number("kw.ssfk.kw_startpos"), values.number(points_name)
        positions = equidistant(start, interval, count, Quantity.POSITION.divisor, gear)
    else:
        points_name = "kw.ssfk.table[i].setpoint"
        positions = source.column(points_name, count, gear=gear)
    positive = source.column("kw.ssfk.table[i].pos", count, gear=gear)
    negative = source.column("kw.ssfk.table[i].neg", count, gear=gear) if values.flag("kw.ssfk.bilateral") else None
    if negative is None:
        source.note_unused("kw.ssfk.table[i].neg", "kw.ssfk.bilateral is 0")
    if not source.ascending(positions, points_name, "AXC-ORDER", "kw.ssfk.kw_nr_max"):
        return None
    modulo = values.flag("kw.ssfk.modulo")
    if modulo and source.axis.modulo is None:
        message = f"Axis {source.axis.number} has no modulo range; the table is read without modulo."
        source.note("AXC-MODULO-AXIS", "kw.ssfk.modulo", message)
        modulo = False
    if modulo and not _fits_modulo(source, positions, positive, negative):
        return None
    return Leadscrew(
        positions=tuple(positions),
        positive=tuple(positive),
        negative=None if negative is None else tuple(negative),
        modulo=modulo,
        without_other_compensations=values.flag("kw.ssfk.set_pos_without_comp"),
        manual_activation=values.flag("kw.ssfk.manual_activation"),
        max_points=capacity,
    )


def _fits_modulo(
    source: CompensationList, positions: list[float], positive: list[float], negative: list[float] | None
) -> bool:
    """Check a modulo table against the axis' range: not longer, and closed where it is as long."""
    modulo = source.axis.modulo
    assert modulo is not None
    excess = positions[-1] - positions[0] - (modulo.end - modulo.start)
    if excess > _SPAN_TOLERANCE:
        message = f"The table is longer than the modulo range {modulo.start:g} … {modulo.end:g}"
        source.note("AXC-MODULO-SPAN", "kw.ssfk.modulo", f"{message}; the compensation stays off.")
        return False
    sides = (positive,) if negative is None else (positive, negative)
    if abs(excess) <= _SPAN_TOLERANCE and any(side[0] != side[-1] for side in sides):
        message = "The table spans one modulo range but its first and last values differ; both are used, with a step."
        source.note("AXC-MODULO-SEAM", "kw.ssfk.modulo", message)
    return True


def format_leadscrew(leadscrew: Leadscrew, lines: Lines) -> None:
    """Append the entries of a leadscrew compensation."""
    start, interval = _even_distance(leadscrew.positions)
    lines.add("kw.ssfk.unit", 1)
    lines.add_unless_default("kw.ssfk.max_points", leadscrew.max_points)
    lines.add("kw.ssfk.kw_nr_max", len(leadscrew.positions))
    lines.add("kw.ssfk.interval", interval)
    if interval:
        lines.add("kw.ssfk.kw_startpos", start)
    lines.add("kw.ssfk.bilateral", leadscrew.negative is not None)
    lines.add_unless_default("kw.ssfk.modulo", leadscrew.modulo)
    lines.add_unless_default("kw.ssfk.set_pos_without_comp", leadscrew.without_other_compensations)
    lines.add_unless_default("kw.ssfk.manual_activation", leadscrew.manual_activation)
    for i, position in enumerate(leadscrew.positions):
        if not interval:
            lines.add_converted("kw.ssfk.table[i].setpoint", position, i)
        lines.add_converted("kw.ssfk.table[i].pos", leadscrew.positive[i], i)
        if leadscrew.negative is not None:
            lines.add_converted("kw.ssfk.table[i].neg", leadscrew.negative[i], i)


def _even_distance(positions: tuple[float, ...]) -> tuple[int | Decimal, int | Decimal]:
    """Return start and interval in the unit of the list, interval 0 where they would not give these very positions."""
    if len(positions) > 1:
        start, second = (in_list(position, Quantity.POSITION) for position in positions[:2])
        with localcontext(prec=1000):
            interval = second - start
        rows = (parameter(ListKind.COMPENSATION, f"kw.ssfk.{name}") for name in ("kw_startpos", "interval"))
        takes = all(row.takes(value) for row, value in zip(rows, (start, interval), strict=True))
        divisor = Quantity.POSITION.divisor
        if takes and equidistant(start, interval, len(positions), divisor) == list(positions):
            return start, interval
    return 0, 0
