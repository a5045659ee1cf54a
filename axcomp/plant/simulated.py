"""Measurements on the simulated machine, as a service engineer takes them on a real one.

Geometric errors are measured at standstill, one axis or pair of axes moved at a time with the others at 0; friction
currents at constant velocity; crosstalk while the master accelerates. All compensations are off. Results are deviations
*actual − commanded* in mm or °, and currents in mA.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..engine import Array, Course, Limits, Setpoints, move
from .machine import FILE_NAME, Plant

CYCLE_TIME = 0.001


def load_plant(folder: Path, **instead: Any) -> Plant:
    """Return the plant that ``plant.json`` in a model's folder describes, with other entries ``instead``."""
    return Plant.from_file(folder / FILE_NAME, **instead)


def deviation(plant: Plant, axis: str, at: Mapping[str, float], direction: int = 1) -> float:
    """Return actual − commanded position of an axis, all standing ``at`` these positions (others at 0).

    Every axis has come from the side that ``direction`` (±1) says.
    """
    commanded = [at.get(name, 0.0) for name in plant.names]
    plant.rest_at(commanded, [float(direction)] * len(commanded))
    index = plant.names.index(axis)
    return plant.true[index] - commanded[index]


def positioning(plant: Plant, axis: str, targets: Sequence[float], direction: int) -> list[float]:
    """Return the deviation of an axis at targets approached in one direction."""
    return [deviation(plant, axis, {axis: target}, direction) for target in targets]


def straightness(plant: Plant, slave: str, master: str, targets: Sequence[float]) -> list[float]:
    """Return how far the slave deviates at the master's targets, against the master at 0."""
    zero = deviation(plant, slave, {})
    return [deviation(plant, slave, {master: target}) - zero for target in targets]


def flatness(
    plant: Plant, slave: str, masters: tuple[str, str], targets1: Sequence[float], targets2: Sequence[float]
) -> list[list[float]]:
    """Return how far the slave deviates over two masters, against both at 0; rows are the second master's targets."""
    zero = deviation(plant, slave, {})
    first, second = masters
    return [[deviation(plant, slave, {first: p, second: q}) - zero for p in targets1] for q in targets2]


def friction_current(plant: Plant, axis: str, velocity: float) -> float:
    """Return the motor current at a constant velocity, mean of both directions, mA."""
    index = plant.names.index(axis)
    run_up, settle, record = 0.1, 0.15, 0.05
    limits = Limits(velocity, velocity / run_up, velocity / run_up / 0.03)
    currents = []
    for sign in (1.0, -1.0):
        course = Course({axis: 0.0}, CYCLE_TIME)
        course.move({axis: sign * velocity * (run_up + settle + record)}, limits)
        setpoints = [0.0] * len(plant.names)
        plant.rest_at(setpoints)
        for cycle, position in enumerate(course.setpoints()[axis].position):
            setpoints[index] = float(position)
            plant.step(setpoints, [0.0] * len(setpoints), CYCLE_TIME)
            if run_up + settle < cycle * CYCLE_TIME <= run_up + settle + record:
                currents.append(sign * plant.currents[index])
    return float(np.mean(currents))


def acceleration_test(
    plant: Plant, slave: str, master: str, at: Mapping[str, float], acceleration: float, direction: int
) -> float:
    """Return how far the slave gives way at an acceleration of the master with sign, in one direction of motion.

    The master passes its position in ``at`` in the middle of the constant acceleration.
    ``acceleration`` · ``direction`` > 0 sets it in motion, < 0 brakes it.
    """
    # Times that are whole numbers of cycles, so that the acceleration is met exactly.
    limits = Limits(velocity=0.15 * abs(acceleration), acceleration=abs(acceleration), jerk=abs(acceleration) / 0.04)
    course = Course({master: 0.0}, CYCLE_TIME)
    course.move({master: direction * 0.5 * limits.velocity}, limits)
    course.dwell(0.05)
    path = course.setpoints()[master]
    middle = _middle_of(path.acceleration, acceleration)
    start = {name: at.get(name, 0.0) for name in plant.names}
    start[master] -= float(path.position[middle])

    index, moving = plant.names.index(slave), plant.names.index(master)
    setpoints = list(start.values())
    plant.rest_at(setpoints, [float(direction)] * len(setpoints))
    passing = []
    for cycle, position in enumerate(path.position):
        setpoints[moving] = start[master] + float(position)
        plant.step(setpoints, [0.0] * len(setpoints), CYCLE_TIME)
        # The drive follows a cycle and a half behind: take the mean around the moment it passes the position.
        if abs(cycle - middle - 1.5) <= 5.0:
            passing.append(plant.true[index])
    moved = float(np.mean(passing))
    return moved - start[slave] - deviation(plant, slave, at, direction)


def _middle_of(accelerations: Array, wanted: float) -> int:
    """Return the middle cycle of the stretch at the wanted acceleration."""
    steady = np.flatnonzero(np.abs(accelerations - wanted) < 1e-6 * abs(wanted))
    return int(steady[len(steady) // 2])


def circular_test(
    plant: Plant,
    axes: tuple[str, str],
    radius: float,
    feed: float,
    direction: int,
    currents: Mapping[str, Array] | None = None,
) -> Array:
    """Return where two axes are on a circle about 0, once round and a quarter more, shape (cycles, 2), mm.

    ``direction``: 1 counter-clockwise; ``currents``: additional ones by axis, as long as ``circle_setpoints``.
    """
    path = circle_setpoints(axes, radius, feed, direction)
    indices = [plant.names.index(axis) for axis in axes]
    setpoints, added = [0.0] * len(plant.names), [0.0] * len(plant.names)
    columns = [path[axis].position.tolist() for axis in axes]
    extra = [(currents or {}).get(axis, np.zeros(len(columns[0]))).tolist() for axis in axes]
    for index, column in zip(indices, columns, strict=True):
        setpoints[index] = column[0]
    plant.rest_at(setpoints)
    found = np.empty((len(columns[0]), 2))
    for cycle in range(len(found)):
        for index, column, current in zip(indices, columns, extra, strict=True):
            setpoints[index], added[index] = column[cycle], current[cycle]
        plant.step(setpoints, added, CYCLE_TIME)
        found[cycle] = [plant.true[index] for index in indices]
    rate = feed / radius
    return found[-round((2.0 * np.pi + 0.5 * np.pi) / rate / CYCLE_TIME) - _RUN_OUT : -_RUN_OUT]


_RUN_OUT = 250
"""Cycles at the end of a circle that are not recorded: the axes slow down."""


def circle_setpoints(axes: tuple[str, str], radius: float, feed: float, direction: int) -> dict[str, Setpoints]:
    """Return what a controller commands two axes on a circle about 0 that begins between two reversals."""
    rate = feed / radius
    turned = move(0.0, 3.0 * np.pi + 0.5, CYCLE_TIME, Limits(rate, 10.0 * rate, 200.0 * rate))
    angle = direction * (turned - 0.25 * np.pi)
    shapes = zip(axes, (np.cos(angle), np.sin(angle)), strict=True)
    return {axis: Setpoints.through(radius * shape, CYCLE_TIME) for axis, shape in shapes}
