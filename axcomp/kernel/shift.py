"""NO_MOVE: what a compensation gains or loses when it is switched stays in the setpoint as a shift.

The shift is constant while the axis stands; with its next motion it is released by sin² (semantics §4). What is
absorbed while a release is under way waits for the next one.
"""

from __future__ import annotations

from dataclasses import dataclass

from .switching import mapped_step, ramp


@dataclass(slots=True)
class Shift:
    """An offset that NO_MOVE has taken out of the output."""

    now: float  # in force
    waiting: float  # absorbed since the last release began
    released: float  # as it was when the release began


@dataclass(slots=True)
class ShiftState:
    """The shift of an axis: what it has before the leadscrew, whose input contains it, and behind."""

    before: Shift
    behind: Shift
    step: int  # of the release: shift_cycles … 0; 0: none is under way
    pending: bool  # there is a shift


def release_shift(cycles: int, state: ShiftState, moving: bool) -> None:
    """Take a shift back over so many cycles, from the first motion on."""
    if moving and state.step == 0 and (state.before.waiting != 0.0 or state.behind.waiting != 0.0):
        state.step = cycles
        begin_release(state.before)
        begin_release(state.behind)
    if state.step > 0:
        state.step -= 1
    weight = ramp(state.step, cycles)
    state.before.now = state.before.waiting + weight * state.before.released
    state.behind.now = state.behind.waiting + weight * state.behind.released
    state.pending = state.step > 0 or state.before.waiting != 0.0 or state.behind.waiting != 0.0


def begin_release(shift: Shift) -> None:
    """Let what waits be released."""
    shift.released = shift.waiting
    shift.waiting = 0.0


def absorb_switch(state: ShiftState, is_before: bool, gain: float) -> None:
    """Take out of the output what a compensation gains by being switched; ``is_before``: it is before the leadscrew."""
    if gain != 0.0:
        state.pending = True
        if is_before:
            absorb(state.before, gain)
        else:
            absorb(state.behind, gain)


def absorb(shift: Shift, gain: float) -> None:
    """Let a gain wait."""
    shift.waiting -= gain
    shift.now -= gain


def shift_state_fits(cycles: int, state: ShiftState) -> bool:
    """Tell whether the state belongs to releases of so many cycles."""
    return 0 <= state.step <= cycles


def adopt_shift(before: int, after: int, state: ShiftState) -> None:
    """Go on with a release of another length from where it stands."""
    if state.step > 0:
        weight = ramp(state.step, before)
        state.step = max(mapped_step(state.step, before, after), 1)
        weight = weight / ramp(state.step, after)
        state.before.released *= weight
        state.behind.released *= weight
