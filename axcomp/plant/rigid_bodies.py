"""The machine as a chain of rigid bodies from the workpiece over the bed to the tool: where the tool tip really is.

Each axis is a joint that carries one body on another, and does so imperfectly: its direction is tilted, a rotary axis
is offset, and whatever it carries moves a little in all six degrees of freedom along with its position. Each body is
carried by one pose ``motion(q) · nominal motion along or about the displaced axis``; seen from the workpiece the tool
tip is where the poses from the tool to the bed put it, and back through those up to the workpiece.

All bodies stand where they nominally do when all axes are at 0: there the machine is referenced and measured from.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from .curves import MILLI, Curve
from .poses import ORIGIN, Pose, Vector, shifted, turned, unit, vector

MICRO = 1e-6
SHIFTS, TURNS = ("x", "y", "z"), ("a", "b", "c")


class Joint:
    """An axis between two bodies, given in the machine's coordinates.

    The description has ``direction`` of the axis; ``center``, a point on it (rotary axes); ``offset`` in µm by which a
    rotary axis lies beside that point; ``tilt`` of the direction in µrad; and ``motion``, curves over the axis'
    position, ``x``, ``y``, ``z`` in µm and ``a``, ``b``, ``c`` in µrad. What is not given is 0. A rotary one turns
    about its direction rather than travel along it.
    """

    def __init__(self, description: Mapping[str, Any], rotary: bool) -> None:
        self.rotary = rotary
        self.nominal_direction = unit(description["direction"])
        self.nominal_center = vector(description.get("center", ORIGIN))
        x, y, z = vector(description.get("tilt", ORIGIN))
        self.direction = turned((MICRO * x, MICRO * y, MICRO * z)).place(self.nominal_direction)
        x, y, z = vector(description.get("offset", ORIGIN))
        self.center = shifted((MILLI * x, MILLI * y, MILLI * z)).place(self.nominal_center)
        motion = description.get("motion", {})
        strangers = set(motion) - {*SHIFTS, *TURNS}
        if strangers:
            raise ValueError(f"motion has no {', '.join(sorted(strangers))}")
        self.shifts = [_Deviation(motion.get(name, {}), MILLI) for name in SHIFTS]
        self.turns = [_Deviation(motion.get(name, {}), MICRO) for name in TURNS]

    def nominal(self, position: float) -> Pose:
        """Return the pose of the carried body on a perfect machine, at a position in mm or °."""
        return self._driven(position, self.nominal_direction, self.nominal_center)

    def actual(self, position: float) -> Pose:
        """Return the pose of the carried body at a position in mm or °."""
        x, y, z = (deviation(position) for deviation in self.shifts)
        turn = vector([deviation(position) for deviation in self.turns])
        driven = self._driven(position, self.direction, self.center)
        # A slide wobbles about the point that travels with it, a table about the one it turns about.
        middle = self.nominal_center if self.rotary else driven.position
        wobble = turned(turn, middle)
        return Pose(_product(wobble, driven), _sum(wobble.place(driven.position), (x, y, z)))

    def _driven(self, position: float, direction: Vector, center: Vector) -> Pose:
        if self.rotary:
            angle = math.radians(math.fmod(position, 360.0))
            return turned((angle * direction[0], angle * direction[1], angle * direction[2]), center)
        return shifted((position * direction[0], position * direction[1], position * direction[2]))


class _Deviation:
    """A curve in mm or rad, counted from position 0."""

    def __init__(self, description: Mapping[str, Any], unit_of_curve: float) -> None:
        self.curve = Curve(description)
        self.unit = unit_of_curve
        self.at_zero = self.curve(0.0)

    def __call__(self, position: float) -> float:
        return self.unit * (self.curve(position) - self.at_zero)


class RigidBodies:
    """The chain of joints.

    The description has ``workpiece``: names of the axes that carry the workpiece, ``tool``: of those that carry the
    tool, both in the order from workpiece to tool; ``axes``: a description of each (see ``Joint``); ``tool_position``:
    where the tool would be with length 0 when all axes are at 0, mm; ``tool_direction``: from there to the tip.
    ``names`` are the plant's axes, in the order of all positions here, ``rotary`` tells which of them are.
    """

    def __init__(self, description: Mapping[str, Any], names: Sequence[str], rotary: Sequence[bool]) -> None:
        def joints(side: str) -> list[tuple[int, Joint]]:
            chosen = [(names.index(name), name) for name in description[side]]
            return [(index, Joint(description["axes"][name], rotary[index])) for index, name in chosen]

        self.workpiece = joints("workpiece")
        self.tool = joints("tool")
        self.tool_position = vector(description.get("tool_position", ORIGIN))
        self.tool_direction = unit(description["tool_direction"])

    def tip(self, tool_length: float) -> Vector:
        """Return the tip of a tool in the tool's coordinates: where it is when all axes are at 0."""
        (x, y, z), (u, v, w) = self.tool_position, self.tool_direction
        return x + tool_length * u, y + tool_length * v, z + tool_length * w

    def place(self, point: Vector, positions: Sequence[float]) -> Vector:
        """Return where a point that moves with the tool is, seen from the workpiece, mm.

        ``point``: where it is when all axes are at 0, mm; ``positions``: of all axes, mm or °.
        """
        return self._seen(point, positions, Joint.actual)

    def nominal_place(self, point: Vector, positions: Sequence[float]) -> Vector:
        """Return where the point would be on a perfect machine."""
        return self._seen(point, positions, Joint.nominal)

    def _seen(self, point: Vector, positions: Sequence[float], pose: Callable[[Joint, float], Pose]) -> Vector:
        for index, joint in reversed(self.tool):
            point = pose(joint, positions[index]).place(point)
        for index, joint in reversed(self.workpiece):
            point = pose(joint, positions[index]).place_back(point)
        return point


def _sum(first: Vector, second: Vector) -> Vector:
    return first[0] + second[0], first[1] + second[1], first[2] + second[2]


def _product(first: Pose, second: Pose) -> tuple[Vector, Vector, Vector]:
    """Return the rows of the product of two rotations."""
    columns = list(zip(*second.rows, strict=True))
    x, y, z = (vector([sum(map(float.__mul__, row, column)) for column in columns]) for row in first.rows)
    return x, y, z
