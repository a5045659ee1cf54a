"""NO_MOVE: what a compensation gains or loses when it is switched stays in the setpoint as a shift.

The shift is constant while the axis stands; with its next motion it is released by sin² (semantics §4). What is
absorbed while a release is under way waits for the next one.
"""

from __future__ import annotations

from .records import AxisTable, ShiftState
from .switching import ramp


def release_shift(table: AxisTable, shift: ShiftState, moving: bool) -> None:
    """Take the shift back over ``shift_cycles`` cycles, from the first motion on."""
    if moving and shift.step == 0 and (shift.waiting_before_leadscrew != 0.0 or shift.waiting_leadscrew != 0.0):
        shift.step = table.shift_cycles
        shift.released_before_leadscrew = shift.waiting_before_leadscrew
        shift.released_leadscrew = shift.waiting_leadscrew
        shift.waiting_before_leadscrew = 0.0
        shift.waiting_leadscrew = 0.0
    if shift.step > 0:
        shift.step -= 1
    weight = ramp(shift.step, table.shift_cycles)
    shift.before_leadscrew = shift.waiting_before_leadscrew + weight * shift.released_before_leadscrew
    shift.leadscrew = shift.waiting_leadscrew + weight * shift.released_leadscrew


def absorb_before_leadscrew(shift: ShiftState, gain: float) -> None:
    """Take out of the output what cross, plane or crosstalk gain by being switched."""
    shift.waiting_before_leadscrew -= gain
    shift.before_leadscrew -= gain


def absorb_leadscrew(shift: ShiftState, gain: float) -> None:
    """Take out of the output what the leadscrew compensation gains by being switched."""
    shift.waiting_leadscrew -= gain
    shift.leadscrew -= gain
