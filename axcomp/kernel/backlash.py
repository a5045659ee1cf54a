"""Backlash compensation (lr_param.anwahl_losekomp, getriebe[i].lose): the drive goes further after a reversal. Added.

The drive moves before the slide does. Mode 1: right after a motion in positive direction, after one in negative
direction −lose. Mode 2: right after negative motion, after positive motion +lose. The change runs by sin² over
lr_param.n_backlash_cyc cycles; turning again midway turns round where it is.
"""

from __future__ import annotations

from dataclasses import dataclass

from .interpolation import LARGEST
from .switching import CYCLES_MAX, mapped_step, ramp


@dataclass(slots=True)
class BacklashTable:
    """What is added after a motion in one of the two directions."""

    amount: float  # −lose in mode 1, +lose in mode 2, mm or °
    direction: int  # of the motion after which it is added: −1 in mode 1, 1 in mode 2
    reversal_cycles: int  # at least 1 (1: at once)


@dataclass(slots=True)
class BacklashState:
    """What the backlash compensation remembers."""

    step: int  # reversal_cycles: the amount is added, 0: nothing is


def backlash_value(table: BacklashTable, state: BacklashState, direction: int) -> float:
    """Return the correction at full weight; ``direction``: of the axis' last motion, 0 before any."""
    if direction == table.direction:
        if state.step < table.reversal_cycles:
            state.step += 1
    elif state.step > 0:
        state.step -= 1
    return backlash_at(table, state)


def backlash_at(table: BacklashTable, state: BacklashState) -> float:
    """Return the correction where a reversal stands."""
    return table.amount * ramp(state.step, table.reversal_cycles)


def adopt_backlash(before: BacklashTable, after: BacklashTable, state: BacklashState) -> None:
    """Go on with other lists; a reversal that is under way stays as far as it is."""
    state.step = mapped_step(state.step, before.reversal_cycles, after.reversal_cycles)


def backlash_fits(table: BacklashTable) -> bool:
    """Tell whether the table can be used."""
    return 1 <= table.reversal_cycles <= CYCLES_MAX and abs(table.amount) < LARGEST


def backlash_state_fits(table: BacklashTable, state: BacklashState) -> bool:
    """Tell whether the state belongs to such a table."""
    return 0 <= state.step <= table.reversal_cycles
