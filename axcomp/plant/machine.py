"""The plant: all drives, the geometric errors of each axis, and the rigid bodies between workpiece and tool."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .drawing import drawn
from .drive import STATE, Drive
from .geometry import AxisErrors
from .memory import Remembering
from .motion import MotionState
from .poses import Vector
from .rigid_bodies import RigidBodies

FILE_NAME = "plant.json"

REMEMBERING, MEMORYLESS = CHOICES = ("remembering", "memoryless")
"""What a plant may be, ``choice`` in its description."""

WRONG = (AttributeError, KeyError, TypeError, ValueError, OverflowError, ZeroDivisionError)
"""What using a wrong description raises."""


class PlantError(ValueError):
    """The description of the plant is not usable; the message says where."""


class Plant:
    """Drives, masses and geometric errors of a machine.

    The description has ``sub_step`` in s and ``axes``, one for each, as in ``models/*/plant.json``, and
    ``rigid_bodies`` (see there) for a machine whose tool tip is of interest. ``choice`` is ``remembering``, all of it,
    or ``memoryless``: friction without memory, no swinging, no growth, only compliance that tables hold. Numbers that
    are ranges are drawn by ``seed`` (0). Everything that is a list of axes has the order of ``names``; ``units`` are
    ``mm`` or ``deg``, ``modulo`` the range of a modulo axis in °, 0.0 for the others.
    """

    def __init__(self, description: Mapping[str, Any]) -> None:
        choice = description.get("choice", REMEMBERING)
        if choice not in CHOICES:
            raise PlantError(f"choice is {' or '.join(CHOICES)}, not {choice!r}")
        memoryless = choice == MEMORYLESS
        description = drawn(description, int(description.get("seed", 0)))
        axes = description["axes"]
        self.sub_step = float(description["sub_step"])
        if not self.sub_step > 0.0:
            raise PlantError(f"sub_step is a time in s, not {self.sub_step:g}")
        self.names = tuple(str(axis["name"]) for axis in axes)
        self.drives: list[Drive] = []
        self.errors: list[AxisErrors] = []
        units = []
        for index, axis in enumerate(axes):
            rotary = axis["type"] == "rotary"
            units.append("deg" if rotary else "mm")
            try:
                self.drives.append(Drive(axis, rotary, float(axis.get("modulo", 0.0)), memoryless))
                self.errors.append(AxisErrors(axis["errors"], index, self.names, memoryless))
            except WRONG as error:
                raise PlantError(f"axis {axis['name']}: {_what(error)}") from error
        self.units = tuple(units)
        self.modulo = tuple(drive.modulo for drive in self.drives)
        self.bodies: RigidBodies | None = None
        if "rigid_bodies" in description:
            try:
                self.bodies = RigidBodies(description["rigid_bodies"], self.names, [unit == "deg" for unit in units])
            except WRONG as error:
                raise PlantError(f"rigid_bodies: {_what(error)}") from error
        self.remembers = not memoryless and any(
            axis["friction"].get("model") == "lugre" or errors.remembering
            for axis, errors in zip(axes, self.errors, strict=True)
        )
        """Whether the choice without memory is another plant."""
        self.motion = MotionState(len(axes))
        self.rest_at([0.0] * len(axes))

    @classmethod
    def from_file(cls, path: Path, **instead: Any) -> Plant:
        """Read ``plant.json``, with other entries ``instead``; PlantError says what is wrong with it."""
        try:
            return cls({**json.loads(path.read_text(encoding="utf-8"), parse_constant=_refuse), **instead})
        except OSError as error:
            raise PlantError(f"{path}: {error.strerror or error}") from error
        except PlantError as error:
            raise PlantError(f"{path}: {error}") from error
        except (*WRONG, RecursionError) as error:
            raise PlantError(f"{path}: {_what(error)}") from error

    @property
    def measured(self) -> list[float]:
        """Positions of the encoders."""
        return self.motion.positions

    @property
    def true(self) -> list[float]:
        """Positions of the tool: what the encoders see and the geometric errors."""
        motion = self.motion
        return [position + errors.error(motion) for position, errors in zip(motion.positions, self.errors, strict=True)]

    @property
    def beyond(self) -> list[float]:
        """The parts of the geometric errors that no table of positions and accelerations holds."""
        return [errors.beyond(self.motion) for errors in self.errors]

    @property
    def remembering(self) -> list[Remembering]:
        """All errors with a state."""
        return [part for errors in self.errors for part in errors.remembering]

    def place(self, point: Vector) -> Vector:
        """Return where a point that moves with the tool is, seen from the workpiece, mm (see ``RigidBodies.place``).

        Raises
        ------
        PlantError
            If the plant has no rigid bodies.
        """
        if self.bodies is None:
            raise PlantError("the plant has no rigid bodies")
        return self.bodies.place(point, self.true)

    @property
    def currents(self) -> list[float]:
        """Motor currents, mA."""
        return [drive.current for drive in self.drives]

    def rest_at(self, positions: Sequence[float], approach: Sequence[float] | None = None) -> None:
        """Stand still at ``positions``, reached in the directions ``approach`` (±1; without: positive)."""
        for drive, position in zip(self.drives, positions, strict=True):
            drive.rest_at(position)
        self.motion.approach = list(approach) if approach is not None else [1.0] * len(self.drives)
        self._see()
        for part in self.remembering:
            part.rest(self.motion)

    def step(self, setpoints: Sequence[float], currents: Sequence[float], duration: float) -> None:
        """Go on for ``duration`` s towards ``setpoints`` (mm or °) with additive ``currents`` (mA)."""
        count = max(1, math.ceil(duration / self.sub_step - 1e-6))
        approach = self.motion.approach
        for index, drive in enumerate(self.drives):
            before = drive.position
            drive.advance(setpoints[index], currents[index], duration, count)
            travel = drive.position - before
            if drive.modulo:
                travel -= drive.modulo * round(travel / drive.modulo)
            approach[index] = self.errors[index].take_up(approach[index], travel)
        self._see()
        for part in self.remembering:
            part.advance(self.motion, duration)

    def _see(self) -> None:
        motion = self.motion
        for index, drive in enumerate(self.drives):
            motion.positions[index] = drive.position
            motion.velocities[index] = drive.velocity
            motion.accelerations[index] = drive.acceleration
            motion.powers[index] = drive.power

    @property
    def state(self) -> list[float]:
        """Everything the plant remembers, as one list of floats."""
        values = [getattr(drive, name) for drive in self.drives for name in STATE]
        return values + self.motion.approach + [value for part in self.remembering for value in part.state]

    @state.setter
    def state(self, values: Sequence[float]) -> None:
        for index, drive in enumerate(self.drives):
            for name, value in zip(STATE, values[index * len(STATE) :], strict=False):
                setattr(drive, name, value)
        at = len(self.drives) * (len(STATE) + 1)
        self.motion.approach = list(values[at - len(self.drives) : at])
        for part in self.remembering:
            part.state = list(values[at : at + len(part.state)])
            at += len(part.state)
        self._see()


def _what(error: Exception) -> str:
    return f"{error} is missing" if isinstance(error, KeyError) else f"{type(error).__name__}: {error}"


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no number")
