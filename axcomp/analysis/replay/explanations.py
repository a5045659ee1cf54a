"""What could make a trace differ from the engine: each reading is tried by running the engine with it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any

import numpy as np

from ...engine import Array, Columns, Engine
from ...interface import variables_of
from ...kinds import KINDS, Backlash, Crosstalk, Leadscrew
from ...model import LINEAR, Axis, AxisType, Machine, ModuloRange, Volumetric

Outputs = Mapping[str, Array]
"""By name, shape (cycles,)."""

_WAYS, _SIGNS = ("accelerate", "decelerate"), ("positive", "negative")


@dataclass(eq=False)
class Bench:
    """A machine and what it is to run through, a row for each cycle of ``cycle_time`` s."""

    machine: Machine
    trajectory: Columns
    cycle_time: float

    def __post_init__(self) -> None:
        variables = variables_of(self.machine)
        self.names = {(v.axis, v.quantity): v.name for v in variables if v.axis is not None}
        self.result = Engine(self.machine, self.cycle_time).run(self.trajectory)
        self.outputs: Outputs = self.result.columns

    def run(self, machine: Machine | None = None, inputs: Mapping[str, Array] | None = None) -> Outputs:
        """Return the outputs of another machine, or with other inputs."""
        engine = Engine(machine or self.machine, self.cycle_time)
        known = {variable.name for variable in engine.variables}
        given = {name: values for name, values in {**self.trajectory, **(inputs or {})}.items() if name in known}
        return engine.run(given).columns

    def having(self, axis: Axis) -> Machine:
        """Return the machine with another axis in the place of the one with the same number."""
        axes = (axis if one.number == axis.number else one for one in self.machine.axes)
        return replace(self.machine, axes=tuple(axes))

    def readings(self, place: int, wanted: Iterable[str]) -> Iterator[tuple[str, Outputs]]:
        """Yield other readings of the lists and the manuals in words, with wanted outputs of an axis by them."""
        axis = self.machine.axes[place]
        nothing = np.zeros(self.result.cycles)
        axes = [*_other_axes(axis), *(other for one in self.machine.axes for other in _folding(one))]
        machines = [*((text, self.having(other)) for text, other in axes), *self._volumes(place)]
        others = ((text, self.run(machine)) for text, machine in machines)
        for text, outputs in chain(others, self._corrected_masters(place), self._linear_ramps(place)):
            yield text, {name: outputs.get(name, nothing) for name in wanted}

    def _volumes(self, place: int) -> Iterator[tuple[str, Machine]]:
        """Yield the machine with one thing about a volumetric compensation of the axis otherwise."""
        for one in self.machine.volumetric:
            letter = self.machine.members(one).get(place, "")
            if letter not in LINEAR or not letter:
                continue
            negate = one.negate.replace(letter, "") if letter in one.negate else one.negate + letter
            others: dict[str, Volumetric | None] = {
                f"the sign of volumetric[{one.index}] inverted": replace(one, negate=negate),
                f"volumetric[{one.index}] off": None,
                f"volumetric[{one.index}] switched at once (filter_steps 0)": replace(one, filter_steps=0),
            }
            for text, other in others.items():
                volumes = (other if v is one else v for v in self.machine.volumetric)
                yield text, replace(self.machine, volumetric=tuple(v for v in volumes if v is not None))

    def _corrected_masters(self, place: int) -> Iterator[tuple[str, Outputs]]:
        axis = self.machine.axes[place]
        for one in axis.compensations:
            numbers = {number for number in KINDS[one.kind].needs(one, axis) if number != axis.number}
            masters = [(self.machine.index_of(number), self.machine.numbered(number).name) for number in numbers]
            seen = {self.names[index, "setpoint"]: self.names[index, "corrected_setpoint"] for index, _ in masters}
            inputs = {name: self.outputs[output] for name, output in seen.items() if name in self.trajectory}
            if inputs:
                who = " and ".join(sorted(name for _, name in masters))
                text = f"the {one.kind} compensation taking the corrected position of {who} (order)"
                yield text, self.run(inputs=inputs)

    def _linear_ramps(self, place: int) -> Iterator[tuple[str, Outputs]]:
        """Yield outputs with sin²(π/2 · u) between two values replaced by u, for each kind that has a ramp."""
        axis = self.machine.axes[place]
        for one in axis.compensations:
            name = self.names.get((place, f"{one.kind}.correction"), "")
            low: Any = 0.0
            high: Any = 0.0
            if isinstance(one, Leadscrew) and one.negative is not None and axis.backlash_cycles > 1:
                low = self.run(self.having(axis.having(replace(one, positive=one.negative))))[name]
                high = self.run(self.having(axis.having(replace(one, negative=one.positive))))[name]
            elif isinstance(one, Backlash) and axis.backlash_cycles > 1:
                high = -one.amount if one.mode == 1 else one.amount
            elif one.n_cycles > 1 and name:
                always = np.ones(len(self.outputs[name]))
                high = self.run(inputs={self.names[place, f"{one.kind}.switch"]: always})[name]
            else:
                continue
            between = np.abs(high - low) > 1e-12
            share = np.clip((self.outputs[name] - low) / np.where(between, high - low, 1.0), 0.0, 1.0)
            linear = low + (high - low) * np.arcsin(np.sqrt(share)) * 2.0 / np.pi
            change = np.where(between, linear - self.outputs[name], 0.0)
            text = f"a linear instead of the sin² ramp of the {one.kind} compensation"
            changed = (name, self.names[place, "correction"], self.names[place, "corrected_setpoint"])
            yield text, {**self.outputs, **{output: self.outputs[output] + change for output in changed}}


def _other_axes(axis: Axis) -> Iterator[tuple[str, Axis]]:
    """Yield the axis with one thing about its compensations otherwise."""
    one: Any
    for one in axis.compensations:
        what = f"the {one.kind} compensation"
        yield f"the sign of {what} inverted", axis.having(KINDS[one.kind].scaled(one, -1.0))
        others = tuple(other for other in axis.compensations if other is not one)
        yield f"{what} off", replace(axis, compensations=others)
        if one.n_cycles > 1:
            text = f"{what} switched at once (n_cycles 0 instead of {one.n_cycles})"
            yield text, axis.having(replace(one, n_cycles=0))
        if isinstance(one, Leadscrew):
            alone = not one.without_other_compensations
            how = "without" if alone else "with"
            text = f"the position of the leadscrew {how} the other corrections (order, P-COMP-00057 = {alone:d})"
            yield text, axis.having(replace(one, without_other_compensations=alone))
            if one.negative is not None:
                swapped = replace(one, positive=one.negative, negative=one.positive)
                yield "the leadscrew's positive and negative tables interchanged", axis.having(swapped)
                yield "the leadscrew's positive table for both directions", axis.having(replace(one, negative=None))
            if one.modulo:
                yield "the leadscrew table not repeated (modulo 0)", axis.having(replace(one, modulo=False))
        if isinstance(one, Backlash):
            yield f"backlash mode {3 - one.mode} instead of {one.mode}", axis.having(replace(one, mode=3 - one.mode))
        if isinstance(one, Crosstalk) and one.velocity_dependent:
            sides = {f"{way}_{sign}": f"{way}_{other}" for way in _WAYS for sign, other in (_SIGNS, _SIGNS[::-1])}
            tests = (replace(t, **{name: getattr(t, other) for name, other in sides.items()}) for t in one.tests)
            text = "the crosstalk's positive and negative values interchanged"
            yield text, axis.having(replace(one, tests=tuple(tests)))
    if axis.backlash_cycles > 1:
        text = f"reversals at once (n_backlash_cyc 0 instead of {axis.backlash_cycles})"
        yield text, replace(axis, backlash_cycles=0)


def _folding(axis: Axis) -> Iterator[tuple[str, Axis]]:
    """Yield a rotary axis that counts otherwise."""
    if axis.modulo is not None:
        screw = axis.of(Leadscrew)
        plain = axis if screw is None else axis.having(replace(screw, modulo=False))
        yield f"positions of {axis.name} that are not folded (no modulo)", replace(plain, modulo=None)
    elif axis.type is AxisType.ROTARY:
        yield f"positions of {axis.name} that are folded (modulo)", replace(axis, modulo=ModuloRange())
