"""NO_MOVE: what a compensation gains or loses when it is switched stays in the setpoint as a shift.

The shift is constant while the axis stands; with its next motion it is released by sin² (semantics §4).
"""

from __future__ import annotations

from .records import AxisTable, ShiftState
from .switching import ramp


def release_shift(table: AxisTable, shift: ShiftState, moving: bool) -> None:
    """Take the shift back over ``shift_cycles`` cycles, from the first motion on."""
    if moving and not shift.releasing and (shift.before_leadscrew != 0.0 or shift.leadscrew != 0.0):
        shift.releasing = True
        shift.step = table.shift_cycles
        shift.held_before_leadscrew = shift.before_leadscrew
        shift.held_leadscrew = shift.leadscrew
    if shift.releasing:
        shift.step -= 1
        weight = ramp(shift.step, table.shift_cycles)
        shift.before_leadscrew = weight * shift.held_before_leadscrew
        shift.leadscrew = weight * shift.held_leadscrew
        shift.releasing = shift.step > 0
