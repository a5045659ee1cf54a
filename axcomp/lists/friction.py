"""Friction compensation (``frict_comp``): list to ``Friction`` and back."""

from __future__ import annotations

from ..model.machine import Friction
from .compensation import CompensationList
from .format import Lines

TABLES = ("frict_comp.table[i].in", "frict_comp.table[i].out")
SIZES = ("frict_comp.table_entries",)

_ADDITIVE_CURRENT = 3


def read_friction(source: CompensationList) -> Friction | None:
    """Return the compensation, None where it is off or its table cannot be used."""
    values = source.values
    if values.integer("frict_comp.mode") != _ADDITIVE_CURRENT:
        source.note(
            "AXC-INACTIVE", "frict_comp.mode", "There is a friction table, but frict_comp.mode is 0: it is off."
        )
        return None
    count = values.integer("frict_comp.table_entries")
    capacity = source.capacity("frict_comp.max_points")
    if not source.fits(count, capacity, "frict_comp.table_entries"):
        return None
    velocities = source.column("frict_comp.table[i].in", count)
    currents = source.column("frict_comp.table[i].out", count)
    if not source.ascending(velocities, "frict_comp.table[i].in", "110591", "frict_comp.table_entries"):
        return None
    if velocities[0] < 0.0:
        message = f"A velocity of the table is negative: {velocities[0]:g}; the compensation stays off."
        source.note("110591", "frict_comp.table[i].in", message, 0)
        return None
    return Friction(
        velocities=tuple(velocities),
        currents=tuple(currents),
        scaling=values.converted("frict_comp.scaling_factor"),
        position_delay=values.converted("frict_comp.position_delay"),
        reversal_lookahead=values.integer("frict_comp.reversal_lookahead"),
        delay_cycles=values.integer("frict_comp.delay_cycles"),
        max_points=capacity,
    )


def format_friction(friction: Friction, lines: Lines) -> None:
    """Append the entries of a friction compensation."""
    lines.add("frict_comp.mode", _ADDITIVE_CURRENT)
    lines.add_unless_default("frict_comp.max_points", friction.max_points)
    lines.add("frict_comp.table_entries", len(friction.velocities))
    lines.add_converted("frict_comp.scaling_factor", friction.scaling)
    lines.add_converted("frict_comp.position_delay", friction.position_delay)
    lines.add("frict_comp.reversal_lookahead", friction.reversal_lookahead)
    lines.add("frict_comp.delay_cycles", friction.delay_cycles)
    for i, (velocity, current) in enumerate(zip(friction.velocities, friction.currents, strict=True)):
        lines.add_converted("frict_comp.table[i].in", velocity, i)
        lines.add_converted("frict_comp.table[i].out", current, i)
