"""The volumetric trials: the tool tip over a body diagonal (ISO 230-6), and over a turn or swing of each rotary axis.

The tip is looked at where the axes stand. Axes that do not move stand off the middle, so that all errors act.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ..engine.motion import Course, Limits
from ..model.machine import Axis, Machine
from ..model.volumetric import LINEAR
from .trials import RAPID, TCP, VOLUMETRIC, Stage, Trial, name_of, settle

TOOL_LENGTH = 120.0
"""mm"""
ASIDE = 0.65
"""Where axes stand that do not move, as a share of their range."""
STOPS, STOPS_OF_TURN = 12, 24
STANDSTILL = 0.2
"""Before the tip is looked at, s: a linear axis that only follows its correction sticks for a while."""
TURNING = Limits(180.0, 1500.0, 4e4)


def volumetric_trials(machine: Machine, cycle_time: float) -> Iterator[Trial]:
    """Yield the trials of a machine; none if it has no volumetric compensation."""
    stage = Stage(machine, cycle_time)
    taking_part = {number: letter for v in machine.volumetric for letter, number in v.axes if letter in v.chain}
    axes = [axis for axis in machine.axes if axis.number in taking_part]
    linear = [axis for axis in axes if taking_part[axis.number] in LINEAR]
    if linear:
        yield _trial(stage, linear, STOPS, RAPID)
    for axis in axes:
        if axis not in linear:
            # A full turn ends where it began: the seam of the tables lies in between.
            yield _trial(stage, [axis], STOPS_OF_TURN, TURNING, closed=axis.modulo is not None)


def _trial(stage: Stage, axes: Sequence[Axis], stops: int, limits: Limits, *, closed: bool = False) -> Trial:
    """Return the trial in which axes go together from one end of their ranges to the other, stop by stop."""
    moving = tuple(name_of(axis) for axis in axes)
    # A share of the step inside the ends, so that the stops fall between the points of the tables.
    targets = [_at(stage, moving, (stop + 0.37) / stops) for stop in range(stops + closed)]
    course = Course({**_at(stage, stage.spans, ASIDE), **targets[0]}, stage.cycle_time)
    read = []
    for target in targets:
        course.move(target, limits)
        read.append(settle(course, STANDSTILL))
    return Trial(VOLUMETRIC, course.setpoints(), {TCP: np.array(read)}, moving)


def _at(stage: Stage, names: Sequence[str] | Mapping[str, object], share: float) -> dict[str, float]:
    return {name: low + share * (high - low) for name, (low, high) in stage.spans.items() if name in names}
