"""Cross compensation (``kw.crosscomp``): list to ``Cross`` and back."""

from __future__ import annotations

from ..model.machine import Cross
from .compensation import CompensationList
from .format import Lines

TABLES = ("kw.crosscomp.table[i].setpoint", "kw.crosscomp.table[i].correction")
SIZES = ("kw.crosscomp.last_index",)


def read_cross(source: CompensationList) -> Cross | None:
    """Return the compensation, None where its table cannot be used."""
    values = source.values
    count = values.integer("kw.crosscomp.last_index") + 1
    capacity = source.capacity("kw.crosscomp.max_points")
    if not source.fits(count, capacity, "kw.crosscomp.last_index"):
        return None
    master = source.axis_of("kw.crosscomp.master_ax_nr", "master")
    if master is None:
        return None
    source.note_own_master("kw.crosscomp.master_ax_nr")
    # Positions are the master's, so they count in its increments.
    master_gear, slave_gear = source.gears("kw.crosscomp.unit", master, source.axis)
    positions = source.column("kw.crosscomp.table[i].setpoint", count, gear=master_gear)
    corrections = source.column("kw.crosscomp.table[i].correction", count, gear=slave_gear)
    if not source.ascending(positions, "kw.crosscomp.table[i].setpoint", "70245", "kw.crosscomp.last_index"):
        return None
    return Cross(
        master=master.number,
        positions=tuple(positions),
        corrections=tuple(corrections),
        n_cycles=values.integer("kw.crosscomp.n_cycles"),
        manual_activation=values.flag("kw.crosscomp.manual_activation"),
        max_points=capacity,
    )


def format_cross(cross: Cross, lines: Lines) -> None:
    """Append the entries of a cross compensation."""
    lines.add("kw.crosscomp.unit", 1)
    lines.add_unless_default("kw.crosscomp.max_points", cross.max_points)
    lines.add("kw.crosscomp.last_index", len(cross.positions) - 1)
    lines.add("kw.crosscomp.master_ax_nr", cross.master)
    lines.add_unless_default("kw.crosscomp.n_cycles", cross.n_cycles)
    lines.add_unless_default("kw.crosscomp.manual_activation", cross.manual_activation)
    for i, (position, correction) in enumerate(zip(cross.positions, cross.corrections, strict=True)):
        lines.add_converted("kw.crosscomp.table[i].setpoint", position, i)
        lines.add_converted("kw.crosscomp.table[i].correction", correction, i)
