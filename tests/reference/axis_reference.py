"""A machine's axis compensations a second time, cycle by cycle: from the words of the manuals and of the conventions.

``Reference(machine).cycle(rows)`` takes what every axis gets in a cycle and returns what it must put out. It knows the
description of a machine, and nothing of the kernel: an independent second opinion, written for reading.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from reference_friction import FrictionReference
from reference_tables import (
    cross_correction,
    crosstalk_correction,
    curve_correction,
    leadscrew_errors,
    plane_correction,
)

from axcomp.kinds import CrosstalkCurve
from axcomp.model import Axis, Machine

STANDSTILL = 1e-9
"""mm or ° a cycle below which an axis stands."""

BEFORE_LEADSCREW = ("cross", "plane", "crosstalk", "temperature")
ON_SETPOINT = (*BEFORE_LEADSCREW, "leadscrew", "backlash")
ALL_KINDS = (*ON_SETPOINT, "friction")
UPDATE_ERRORS = {"leadscrew": 110638, "cross": 110639, "plane": 110640, "friction": 110641}
WAITS_FOR_STANDSTILL = ("cross", "plane", "crosstalk")


@dataclass
class Row:
    """What an axis gets in a cycle; names as those of the FMU."""

    setpoint: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0
    actual_position: float = 0.0
    unreferenced: bool = False
    fault: bool = False
    no_move: bool = False
    released: bool = False
    switch: dict[str, int] = field(default_factory=dict)
    offset: float = 0.0  # beyond what the lists say, as the coefficient
    coefficient: float = 0.0
    ahead_known: bool = False
    velocity_ahead: tuple[float, ...] = ()


@dataclass
class Result:
    """What an axis puts out in a cycle."""

    corrected_setpoint: float
    display_position: float
    correction: float
    setpoint_shift: float
    contributions: dict[str, float]
    active: dict[str, bool]
    error: int


def soft(step: int, length: int) -> float:
    """Return sin²(π/2 · step/length)."""
    return math.sin(0.5 * math.pi * step / length) ** 2


def short_way(change: float, axis: Axis) -> float:
    """Return a change of position, the short way round where the axis counts modulo."""
    return change if axis.modulo is None else math.remainder(change, axis.modulo.length)


class Direction:
    """The last way a position went; changes sum up until they are a motion."""

    def __init__(self, axis: Axis) -> None:
        self.axis, self.place, self.sign = axis, math.nan, 0

    def follow(self, position: float) -> int:
        """Return the sign of the motion to a position, 0 as long as it is none."""
        if math.isnan(self.place):
            self.place = position
        change = short_way(position - self.place, self.axis)
        if abs(change) < STANDSTILL:
            return 0
        self.place, self.sign = position, 1 if change > 0 else -1
        return self.sign


class Walk:
    """A weight that goes one step a cycle towards 0 or 1."""

    def __init__(self, length: int, step: int | None = None) -> None:
        self.length = max(length, 1)
        self.step = self.length if step is None else step

    def towards(self, up: bool) -> float:
        """Go one step and return the weight."""
        self.step = min(max(self.step + (1 if up else -1), 0), self.length)
        return self.weight

    @property
    def weight(self) -> float:
        """Return the weight at the present step."""
        return soft(self.step, self.length)

    def stretch(self, length: int) -> None:
        """Take another length at the nearest step of the same share."""
        length = max(length, 1)
        self.step, self.length = math.floor(self.step * length / self.length + 0.5), length

    def stretch_what_runs_out(self, length: int) -> float:
        """Take another length without coming to the end by it; return by what the amount must be multiplied."""
        if self.step == 0:
            return 1.0
        before = self.weight
        self.stretch(length)
        self.step = max(self.step, 1)
        return before / self.weight


class Switch:
    """Whether a compensation is on: commands, standstill, references, manual activation."""

    def __init__(self, kind: str, compensation: Any) -> None:
        self.kind = kind
        self.manual = compensation.manual_activation
        self.walk = Walk(compensation.n_cycles, 0)
        self.asked = self.granted = self.no_move = self.begun = False
        self.said: int | None = None

    def weigh(self, said: int, taken_off: bool, conditions: bool, stands: bool, no_move: bool) -> tuple[float, float]:
        """Return the weight in this cycle, and what part of the value NO_MOVE keeps in the setpoint.

        ``taken_off``: reset, program end, or the axis is given back.
        """
        if said != self.said:
            self.said, on = said, self.means_on(said)
            refused = on and self.manual and (taken_off or not conditions)
            if not refused:
                self.asked, self.no_move = on, no_move
        if self.manual and self.asked and taken_off:
            self.asked, self.no_move = False, no_move
        if not self.begun:
            self.begun, self.granted = True, self.asked
            self.walk.step = self.walk.length if self.granted and conditions else 0
            return self.walk.weight, 0.0
        granted_before = self.granted
        if stands or not conditions or self.kind not in WAITS_FOR_STANDSTILL:
            self.granted = self.asked
        if self.granted != granted_before and self.no_move and conditions:
            old = self.walk.weight
            self.walk.step = self.walk.length if self.granted else 0
            return self.walk.weight, old - self.walk.weight
        return self.walk.towards(self.granted and conditions), 0.0

    def drop(self) -> None:
        """Be off for want of a table."""
        self.walk.step = 0

    def means_on(self, said: int) -> bool:
        """Tell what an input means: 1 on, −1 off, 0 as the lists activate."""
        return {1: True, -1: False, 0: not self.manual}[said]

    def come_back(self, said: int, *, at_once: bool) -> None:
        """Be automatic: that needs no command, and no standstill where there was no table."""
        self.said, self.asked, self.no_move = said, self.means_on(said), False
        self.granted = self.asked if at_once else self.granted


class Shift:
    """What NO_MOVE keeps in the setpoint; two parts: before the leadscrew's input and behind it."""

    def __init__(self) -> None:
        self.waiting, self.leaving, self.walk = [0.0, 0.0], [0.0, 0.0], Walk(1, 0)

    def cycle(self, moves: bool, length: int) -> None:
        """Release what waits with a motion."""
        if self.walk.step == 0:
            self.leaving = [0.0, 0.0]
            if moves and any(self.waiting):
                self.leaving, self.waiting, self.walk = self.waiting, [0.0, 0.0], Walk(length)
        self.walk.towards(False)

    def stretch(self, length: int) -> None:
        """Go on over another length."""
        factor = self.walk.stretch_what_runs_out(length)
        self.leaving = [factor * amount for amount in self.leaving]

    def part(self, place: int) -> float:
        """Return one part."""
        return self.waiting[place] + self.walk.weight * self.leaving[place]


class Rest:
    """What was absorbed when a value became another one: it runs out by sin², whatever the switch does."""

    def __init__(self) -> None:
        self.amount, self.walk = 0.0, Walk(1, 0)

    @property
    def value(self) -> float:
        """Return what is left of it."""
        return self.amount * self.walk.weight

    def stretch(self, cycles: int) -> None:
        """Go on over another length."""
        self.amount *= self.walk.stretch_what_runs_out(cycles)

    def absorb(self, difference: float, cycles: int) -> None:
        """Take up a difference besides what is left."""
        if difference:
            self.amount, self.walk = self.value + difference, Walk(cycles)


def _alone(screw: Any) -> bool | None:
    """Tell whether a leadscrew's position is the setpoint alone (P-COMP-00057); None: there is no table."""
    return screw and screw.without_other_compensations


class AxisReference:
    """One axis with what it remembers."""

    def __init__(self, axis: Axis, machine: Machine, cycle_time: float, derive: bool) -> None:
        self.axis, self.machine, self.cycle_time, self.derive = axis, machine, cycle_time, derive
        self.compensations: dict[str, Any] = {one.kind: one for one in axis.compensations}
        self.switches = {kind: Switch(kind, one) for kind, one in self.compensations.items()}
        self.row = Row()
        self.motion, self.screw_motion = Direction(axis), Direction(axis)
        self.direction, self.stands = 0, True
        self.screw_walk, self.backlash_walk = Walk(axis.backlash_cycles), Walk(axis.backlash_cycles, 0)
        self.line: tuple[float, float] | None = None
        self.rests = {kind: Rest() for kind in ON_SETPOINT}
        self.shift = Shift()
        self.friction = FrictionReference(axis, cycle_time)
        self.was_released = False
        self.error = 0
        self.screw_input = 0.0
        self.declared = dict(self.compensations)
        self.last_setpoint: float | None = None
        self.last_velocity = 0.0

    def accept(self, row: Row) -> None:
        """Take the inputs and decide whether the axis stands and which way it goes."""
        self.row = row
        if self.derive:
            self._derive(row)
        changed = self.motion.follow(row.setpoint)
        velocity = 0 if abs(row.velocity) * self.cycle_time < STANDSTILL else int(math.copysign(1, row.velocity))
        self.stands = not changed and not velocity
        self.direction = velocity or changed or self.direction

    def _derive(self, row: Row) -> None:
        """Backward difference and second difference; before its first setpoint the axis stood there."""
        if self.last_setpoint is None:
            self.last_setpoint = row.setpoint
        row.velocity = short_way(row.setpoint - self.last_setpoint, self.axis) / self.cycle_time
        row.acceleration = (row.velocity - self.last_velocity) / self.cycle_time
        self.last_setpoint, self.last_velocity = row.setpoint, row.velocity

    def needs(self, kind: str) -> list[int]:
        """Return the numbers of the axes that must be referenced."""
        one = self.compensations[kind]
        if kind == "cross":
            return [one.master]
        if kind == "plane":
            return [one.master1, one.master2, self.axis.number]
        if kind == "crosstalk":
            return self._adaptation()
        return [self.axis.number] if kind in ("leadscrew", "temperature") else []

    def _adaptation(self) -> list[int]:
        one = self.compensations["crosstalk"]
        if isinstance(one, CrosstalkCurve):
            return []
        return [one.adaptation1, one.adaptation2][: one.mode - 1]

    def cycle(self, axes: dict[int, AxisReference], reset: bool, program_end: bool) -> Result:
        """Return what comes out; every axis has accepted its inputs."""
        row = self.row
        taken_off = reset or program_end or (row.released and not self.was_released)
        self.was_released = row.released
        weights = {}
        for kind in self.compensations:
            switch = self.switches[kind]
            conditions = not any(axes[number].row.unreferenced for number in self.needs(kind))
            weights[kind] = switch.weigh(row.switch[kind], taken_off, conditions, self.stands, row.no_move)
        self.shift.cycle(not self.stands, self.longest)
        found: dict[str, float] = {}
        for kind in ON_SETPOINT:
            if kind not in self.switches:
                continue
            if kind == "leadscrew":
                self.screw_input = row.setpoint + sum(found.values()) + self.shift.part(0)
            rest = self.rests[kind]
            if kind not in weights:
                rest.walk.towards(False)
                found[kind] = rest.value
                continue
            weight, kept = weights[kind]
            self._step(kind, weight)
            value = self._value(kind, axes)
            rest.walk.towards(False)
            found[kind] = weight * value + rest.value
            self.shift.waiting[0 if kind in BEFORE_LEADSCREW else 1] += kept * value
        correction = sum(found.values())
        shift = self.shift.part(0) + self.shift.part(1)
        if "friction" in weights:
            found["friction"] = weights["friction"][0] * self.friction.current(row)
        self.error = 0 if reset else self.error
        return Result(
            row.setpoint + correction + shift,
            row.actual_position - (correction + shift),
            correction,
            shift,
            found,
            {kind: switch.walk.step > 0 for kind, switch in self.switches.items()},
            self.error,
        )

    def _value(self, kind: str, axes: dict[int, AxisReference]) -> float:
        one = self.compensations[kind]
        if kind == "cross":
            master = axes[one.master]
            return cross_correction(one, master.axis, master.row.setpoint)
        if kind == "plane":
            first, second = axes[one.master1], axes[one.master2]
            return plane_correction(one, (first.axis, second.axis), (first.row.setpoint, second.row.setpoint))
        if kind == "temperature":
            assert self.line is not None
            return self._growth(self.line)
        if kind == "leadscrew":
            return self._leadscrew()
        if kind == "backlash":
            return (-1 if one.mode == 1 else 1) * one.amount * self.backlash_walk.weight
        master = axes[one.master]
        if isinstance(one, CrosstalkCurve):
            return curve_correction(one, master.row.acceleration)
        adaptation = [axes[number] for number in self._adaptation()]
        return crosstalk_correction(
            one,
            [other.axis for other in adaptation],
            [other.row.setpoint for other in adaptation],
            master.row.acceleration,
            master.direction or 1,
        )

    def _growth(self, line: tuple[float, float]) -> float:
        return line[0] + line[1] * (self.row.setpoint - self.compensations["temperature"].position)

    def _take_line(self, weight: float) -> None:
        """Absorb the difference that another offset or coefficient makes."""
        listed = self.compensations["temperature"]
        line = (listed.offset + self.row.offset, listed.coefficient + self.row.coefficient)
        if self.line is not None and line != self.line:
            difference = weight * (self._growth(self.line) - self._growth(line))
            self.rests["temperature"].absorb(difference, self.compensations["temperature"].n_cycles)
        self.line = line

    def _standing(self, kind: str, axes: dict[int, AxisReference]) -> float:
        """Return a value where the axis stands when an update comes; a current is not blended."""
        if kind == "friction":
            return 0.0
        return self._value(kind, axes)

    def _comes_at_once(self, kind: str, axes: dict[int, AxisReference]) -> bool:
        """Tell whether a compensation that had no table is on after a single step: then its values come in softly."""
        on = self.switches[kind].granted and not any(axes[number].row.unreferenced for number in self.needs(kind))
        return on and self.switches[kind].walk.length == 1

    def _begin_again(self, kind: str) -> None:
        """Begin with a table where there was none: the last motion of the axis says the direction of its screw."""
        if kind == "leadscrew":
            self.screw_motion = Direction(self.axis)
            self.screw_motion.sign = self.direction
            self.screw_walk = Walk(self.axis.backlash_cycles, 0 if self.direction < 0 else None)
        elif kind == "backlash":
            self.backlash_walk = Walk(self.axis.backlash_cycles, 0)
        elif kind == "friction":
            self.friction = FrictionReference(self.axis, self.cycle_time)

    def _step(self, kind: str, weight: float) -> None:
        """Go one cycle on with what a value remembers."""
        one = self.compensations[kind]
        if kind == "temperature":
            self._take_line(weight)
        elif kind == "leadscrew":
            self.screw_motion.follow(self._screw_position())
            self.screw_walk.towards(self.screw_motion.sign >= 0)
        elif kind == "backlash":
            self.backlash_walk.towards(self.direction == (-1 if one.mode == 1 else 1))

    def _screw_position(self) -> float:
        return self.row.setpoint if _alone(self.compensations["leadscrew"]) else self.screw_input

    def _leadscrew(self) -> float:
        """Return −Δ."""
        screw = self.compensations["leadscrew"]
        position = self._screw_position()
        positive, negative = leadscrew_errors(screw, self.axis, position)
        return -(negative + self.screw_walk.weight * (positive - negative))

    @property
    def longest(self) -> int:
        """Return over how many cycles a shift is released."""
        return max([self.axis.backlash_cycles, *(one.n_cycles for one in self.compensations.values())])

    def blending(self, kind: str) -> int:
        """Return over how many cycles new values come in."""
        if kind in ("leadscrew", "backlash"):
            return self.axis.backlash_cycles
        return int(self.compensations[kind].n_cycles)

    def update(self, axis: Axis, axes: dict[int, AxisReference]) -> None:
        """Take new lists, unless they reserve other sizes than were declared at the start."""
        new: dict[str, Any] = {one.kind: one for one in axis.compensations}
        for kind, one in new.items():
            if getattr(one, "max_points", 0) != getattr(self.declared[kind], "max_points", 0):
                self.error = UPDATE_ERRORS[kind]
                return
        self.error = 0
        before = {}
        for kind in self.compensations:
            weight = self.switches[kind].walk.weight
            before[kind] = (weight, self.blending(kind), weight * self._standing(kind, axes) if weight else 0.0)
        had = self.compensations
        self.axis, self.friction.axis, self.compensations = axis, axis, new
        self.shift.stretch(self.longest)
        self.screw_walk.stretch(axis.backlash_cycles)
        self.backlash_walk.stretch(axis.backlash_cycles)
        for kind, switch in self.switches.items():
            weight, cycles, value = before.get(kind, (0.0, 1, 0.0))
            if kind not in new:
                switch.drop()
            else:
                cycles = self.blending(kind)
                was_manual, switch.manual = switch.manual, new[kind].manual_activation
                if kind not in had:
                    self._begin_again(kind)
                if kind == "leadscrew" and _alone(had.get(kind)) != _alone(new[kind]):
                    self.screw_motion.place = self._screw_position()
                if not switch.manual and (was_manual or kind not in had):
                    switch.come_back(self.row.switch[kind], at_once=kind not in had)
                switch.walk.stretch(new[kind].n_cycles)
                if kind not in had and self._comes_at_once(kind, axes):
                    weight = switch.walk.step = 1
            if kind == "friction":
                continue
            if kind in new:
                self.rests[kind].stretch(cycles)
                value -= weight * self._standing(kind, axes) if weight else 0.0
            self.rests[kind].absorb(value, cycles)


class Reference:
    """A whole machine."""

    def __init__(self, machine: Machine, cycle_time: float, derive: bool = False) -> None:
        self.axes = {axis.number: AxisReference(axis, machine, cycle_time, derive) for axis in machine.axes}

    def update(self, machine: Machine) -> None:
        """Take new lists between two cycles."""
        for axis in machine.axes:
            self.axes[axis.number].update(axis, self.axes)

    def cycle(self, rows: list[Row], reset: bool, program_end: bool) -> list[Result]:
        """Return what every axis puts out, in the order of the machine."""
        for axis, row in zip(self.axes.values(), rows, strict=True):
            axis.accept(row)
        return [axis.cycle(self.axes, reset, program_end) for axis in self.axes.values()]
