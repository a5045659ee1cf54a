"""Plane compensation (``kw.crosscomp2``): list to ``Plane`` and back."""

from __future__ import annotations

from ..model.machine import AxisType, Plane
from .axes import AxisSettings
from .compensation import CompensationList
from .format import Lines

TABLES = ("kw.crosscomp2.table[j][i].correction",)
SIZES = ("kw.crosscomp2.last_index_master1", "kw.crosscomp2.last_index_master2")

_LAST_INDEX_MAX = 100
"""Largest last index where the list does not say how many entries to reserve."""


def read_plane(source: CompensationList) -> Plane | None:
    """Return the compensation, None where its table cannot be used."""
    values = source.values
    columns, rows = (values.integer(f"kw.crosscomp2.last_index_master{i}") + 1 for i in (1, 2))
    reserved = values.integer("kw.crosscomp2.max_points") if values.given("kw.crosscomp2.max_points") else 0
    if not values.cells("kw.crosscomp2.table[j][i].correction"):
        name = "kw.crosscomp2.last_index_master1"
        source.note("70183", name, "The plane compensation has no table; it stays off.")
        return None
    if not _fits(source, columns, rows, reserved):
        return None
    masters = [_master(source, f"kw.crosscomp2.master{i}_ax_nr") for i in (1, 2)]
    if masters[0] is None or masters[1] is None:
        return None
    gear1, gear2, slave_gear = source.gears("kw.crosscomp2.unit", masters[0], masters[1], source.axis)
    rectangular = values.text("kw.crosscomp2.grid") == "RECTANGULAR"
    names = [f"kw.crosscomp2.interval{i if rectangular else ''}" for i in (1, 2)]
    interval1, interval2 = (values.converted(n, gear=g) for n, g in zip(names, (gear1, gear2), strict=True))
    if not _usable_intervals(source, dict(zip(names, (interval1, interval2), strict=True))):
        return None
    corrections = source.column("kw.crosscomp2.table[j][i].correction", rows, columns, gear=slave_gear)
    return Plane(
        master1=masters[0].number,
        master2=masters[1].number,
        start1=values.converted("kw.crosscomp2.start_position_master1", gear=gear1),
        start2=values.converted("kw.crosscomp2.start_position_master2", gear=gear2),
        interval1=interval1,
        interval2=interval2,
        corrections=tuple(tuple(corrections[row * columns : (row + 1) * columns]) for row in range(rows)),
        n_cycles=values.integer("kw.crosscomp2.n_cycles"),
        manual_activation=values.flag("kw.crosscomp2.manual_activation"),
        max_points=reserved or None,
    )


def _fits(source: CompensationList, columns: int, rows: int, reserved: int) -> bool:
    for i, count in enumerate((columns, rows), 1):
        name = f"kw.crosscomp2.last_index_master{i}"
        if not reserved and count > _LAST_INDEX_MAX + 1:
            message = f"{name} = {count - 1:,} is above {_LAST_INDEX_MAX}, and max_points does not reserve more"
            source.note("110647", name, f"{message}; the compensation stays off.")
            return False
    capacity = source.capacity("kw.crosscomp2.max_points")
    return source.fits(columns * rows, capacity, "kw.crosscomp2.last_index_master1")


def _master(source: CompensationList, name: str) -> AxisSettings | None:
    axis = source.axis_of(name, "master", "70182")
    if axis is not None and axis.type is AxisType.SPINDLE:
        source.note(
            "70184", name, f"Axis {axis.number} is a spindle and cannot be a master; the compensation stays off."
        )
        return None
    source.note_own_master(name)
    return axis


def _usable_intervals(source: CompensationList, intervals: dict[str, float]) -> bool:
    for name, interval in intervals.items():
        if not interval > 0.0:
            message = f"{name} is needed and must be above 0; the compensation stays off."
            source.note("AXC-INTERVAL", name, message)
            return False
    return True


def format_plane(plane: Plane, lines: Lines) -> None:
    """Append the entries of a plane compensation."""
    lines.add("kw.crosscomp2.unit", 1)
    if plane.max_points is not None:
        lines.add("kw.crosscomp2.max_points", plane.max_points)
    if plane.interval1 == plane.interval2:
        lines.add_converted("kw.crosscomp2.interval", plane.interval1)
    else:
        lines.add("kw.crosscomp2.grid", "RECTANGULAR")
        lines.add_converted("kw.crosscomp2.interval1", plane.interval1)
        lines.add_converted("kw.crosscomp2.interval2", plane.interval2)
    lines.add("kw.crosscomp2.last_index_master1", len(plane.corrections[0]) - 1)
    lines.add("kw.crosscomp2.last_index_master2", len(plane.corrections) - 1)
    lines.add_converted("kw.crosscomp2.start_position_master1", plane.start1)
    lines.add_converted("kw.crosscomp2.start_position_master2", plane.start2)
    lines.add("kw.crosscomp2.master1_ax_nr", plane.master1)
    lines.add("kw.crosscomp2.master2_ax_nr", plane.master2)
    lines.add_unless_default("kw.crosscomp2.n_cycles", plane.n_cycles)
    lines.add_unless_default("kw.crosscomp2.manual_activation", plane.manual_activation)
    for j, row in enumerate(plane.corrections):
        for i, correction in enumerate(row):
            lines.add_converted("kw.crosscomp2.table[j][i].correction", correction, j, i)
