"""Leadscrew error compensation (kw.ssfk): out = in − Δ(in), Δ = actual − programmed position.

Bilateral tables have a Δ for either direction of motion. At a reversal their difference is spread by sin² over the
cycles of lr_param.n_backlash_cyc; turning again midway turns round where it is.
"""

from __future__ import annotations

from .interpolation import curve_value, fold, nearest
from .record import Vec
from .records import LeadscrewState, LeadscrewTable
from .switching import ramp

ROUNDING = 1e-9  # mm or °: a change of the input below this is rounding, not motion


def begin_leadscrew(table: LeadscrewTable, state: LeadscrewState, position: float) -> None:
    """Set the state at the start of a simulation: before any motion the positive direction counts."""
    state.position = position
    state.backward = False
    state.reversal_step = table.reversal_cycles


def leadscrew_value(
    pool: Vec, table: LeadscrewTable, state: LeadscrewState, position: float, modulo_range: float
) -> float:
    """Return −Δ at full weight; ``position``: the input of the compensation, whose changes give the direction."""
    change = nearest(position - state.position, modulo_range)
    if change > ROUNDING or change < -ROUNDING:
        state.position = position
        state.backward = change < 0.0
    if state.backward:
        if state.reversal_step > 0:
            state.reversal_step -= 1
    elif state.reversal_step < table.reversal_cycles:
        state.reversal_step += 1

    x = position
    if table.modulo:
        x = fold(position, pool[table.positive.x], modulo_range)
    if not table.bilateral or state.reversal_step == table.reversal_cycles:
        return -curve_value(pool, table.positive, x, state.lookup)
    if state.reversal_step == 0:
        return -curve_value(pool, table.negative, x, state.lookup)
    positive = curve_value(pool, table.positive, x, state.lookup)
    negative = curve_value(pool, table.negative, x, state.lookup)
    return -(negative + ramp(state.reversal_step, table.reversal_cycles) * (positive - negative))
