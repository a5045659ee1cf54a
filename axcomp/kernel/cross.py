"""Cross compensation (kw.crosscomp): the slave is corrected by what stands at the master's raw setpoint. Added."""

from __future__ import annotations

from .interpolation import curve_value
from .record import Vec
from .records import CrossState, CrossTable


def cross_value(pool: Vec, table: CrossTable, state: CrossState, master: float) -> float:
    """Return the correction at full weight; ``master`` is the master's raw setpoint."""
    return curve_value(pool, table.curve, master, state.lookup)
