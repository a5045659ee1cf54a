"""The inputs of the example machines: one second of motion each, one row a millisecond."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...engine import Array, Course, Limits

CYCLE_TIME = 0.001
CYCLES = 1001

Trajectory = dict[str, Array]
"""Inputs by name, shape (cycles,), and ``time``."""


def three_axis() -> Trajectory:
    """X, Y and Z forth and back, in all of the plane's cells and curves that a second allows."""
    limits = Limits(350.0, 2400.0, 6e4)
    course = Course({"X": -30.0, "Y": 40.0, "Z": -150.0}, CYCLE_TIME)
    course.dwell(0.02)
    course.move({"X": 55.0, "Y": 12.5, "Z": -161.0}, limits)
    course.dwell(0.03)
    course.move({"X": -5.0, "Y": 52.0, "Z": -130.0}, limits)
    return _inputs(course)


def rotary_table() -> Trajectory:
    """C forwards over the end of its range, and back over it; positions are folded as a controller does."""
    course = Course({"C": 335.0}, CYCLE_TIME)
    course.dwell(0.02)
    course.move({"C": 383.0}, Limits(240.0, 2400.0, 6e4))
    course.dwell(0.02)
    course.move({"C": 317.0}, Limits(300.0, 2400.0, 6e4))
    return _inputs(course, folded=("C",))


def manual_examples() -> Trajectory:
    """Over the entries that the manuals print; Y_PRINTED comes to −19.8667 mm from either side."""
    limits = Limits(300.0, 4000.0, 2e5)
    course = Course({"X": 1.0, "Y_ACHSE": -45.0, "Z": -70.0, "Y_PRINTED": -20.05, "Z_PRINTED": 0.0}, CYCLE_TIME)
    course.dwell(0.02)
    course.move({"X": 1.16, "Y_ACHSE": 0.0, "Y_PRINTED": -19.8667}, limits)
    course.dwell(0.05)
    course.move({"Y_PRINTED": -19.7}, limits)
    course.move({"X": 31.0, "Y_ACHSE": 35.0, "Y_PRINTED": -19.8667}, limits)
    return _inputs(course)


def five_axis() -> Trajectory:
    """All axes forth and back, C over the end of its range; in between the tables' compensation goes off and on."""
    limits = Limits(350.0, 2400.0, 6e4)
    course = Course({"X": -60.0, "Y": 20.0, "Z": -150.0, "B": 10.0, "C": 335.0}, CYCLE_TIME)
    course.dwell(0.02)
    off = course.move({"X": 40.0, "Y": -35.0, "Z": -172.0, "B": 31.0, "C": 388.0}, limits)
    on = course.dwell(0.05)
    course.dwell(0.05)
    course.move({"X": -12.0, "Y": 41.0, "Z": -131.0, "B": -14.0, "C": 342.0}, limits)
    inputs = _inputs(course, folded=("C",))
    inputs["tool_length"] = np.full(CYCLES, 120.0)
    inputs["volumetric[1].switch"] = np.zeros(CYCLES)
    inputs["volumetric[1].switch"][off:on] = -1.0
    return inputs


def warm_axis() -> Trajectory:
    """X and Y forth and back; Y turns again within its reversal. X gets warmer, once as it starts to move."""
    limits = Limits(350.0, 4000.0, 2e5)
    course = Course({"X": 100.0, "Y": 40.0}, CYCLE_TIME)
    course.dwell(0.03)
    course.move({"X": 150.0, "Y": 62.0}, limits)
    warmer = course.dwell(0.05)
    course.dwell(0.04)
    course.move({"X": 118.0}, limits)
    for target in (61.98, 62.0, 61.98):
        grown = course.move({"Y": target}, Limits(10.0, 4000.0, 4e6)) - 6
    course.move({"X": 139.0, "Y": 30.0}, limits)
    inputs = _inputs(course)
    at = np.arange(CYCLES)
    inputs["X.temperature.offset"] = np.where(at < warmer, 0.0, 0.0025)
    inputs["X.temperature.coefficient"] = np.where(at < grown, 0.0, 11.5e-6)
    return inputs


TRAJECTORIES: Mapping[str, Callable[[], Trajectory]] = {
    "three_axis": three_axis,
    "rotary_table": rotary_table,
    "five_axis": five_axis,
    "manual_examples": manual_examples,
    "warm_axis": warm_axis,
}
"""By the name of the model's folder."""


def _inputs(course: Course, folded: Sequence[str] = ()) -> Trajectory:
    """Return the inputs of all axes for ``CYCLES`` cycles; the drives are taken to follow at once.

    ``folded``: axes whose positions lie within 0 … 360°.
    """
    if course.cycles > CYCLES:
        raise ValueError(f"the motion takes {course.cycles} cycles")
    course.dwell((CYCLES - course.cycles) * CYCLE_TIME)
    inputs: Trajectory = {"time": np.arange(CYCLES, dtype=np.float64) * CYCLE_TIME}
    for name, commands in course.setpoints().items():
        position = np.mod(commands.position, 360.0) if name in folded else commands.position
        inputs[f"{name}.setpoint"] = position
        inputs[f"{name}.velocity"] = commands.velocity
        inputs[f"{name}.acceleration"] = commands.acceleration
        inputs[f"{name}.actual_position"] = position
    return inputs
