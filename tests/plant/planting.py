"""Plants to test: descriptions that are as simple as a test needs them."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from typing import Any

from axcomp.plant import Plant

AXIS: dict[str, Any] = {
    "name": "X",
    "type": "translatory",
    "drive": {
        "mass": 200.0,
        "force_constant": 100.0,
        "current_limit": 50.0,
        "position_gain": 100.0,
        "velocity_gain": 400.0,
        "integral_time": 0.008,
        "current_time": 0.0005,
    },
    "friction": {"static": 300.0, "coulomb": 250.0, "stribeck_velocity": 5.0, "viscous": 0.5},
    "errors": {},
}


def axis(**changes: Any) -> dict[str, Any]:
    """Return a description of an axis; a dict as value changes only the entries it has."""
    made = copy.deepcopy(AXIS)
    for name, value in changes.items():
        made[name] = {**made.get(name, {}), **value} if isinstance(value, dict) else value
    return made


def plant_of(*axes: dict[str, Any], sub_step: float = 0.0002) -> Any:
    return Plant({"sub_step": sub_step, "axes": list(axes)})


def follow(plant: Any, setpoints: Sequence[float], current: float = 0.0, cycle: float = 0.001) -> Iterator[Any]:
    """Drive the only axis through setpoints from rest at the first; yield its drive after each cycle."""
    plant.rest_at([setpoints[0]])
    for setpoint in setpoints:
        plant.step([setpoint], [current], cycle)
        yield plant.drives[0]
