"""Volumetric measurements on the simulated machine: the ISO 230-1 errors of one axis after the other.

An instrument watches reflectors on the spindle from the workpiece while a single axis moves; what rigidly maps the
reflectors from where they were with the axis at 0 is the pose the axis gives the body it carries. Compensations are
off. Lengths in mm, angles in rad, positions of rotary axes in °.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from ..engine import Array
from ..model import LETTERS, LINEAR, NOMINAL_DIRECTIONS, Triple
from .machine import Plant

REFLECTORS = ((150.0, 0.0, -120.0), (-150.0, 0.0, -120.0), (0.0, 150.0, -250.0), (0.0, -150.0, -40.0))
"""Where they are when all axes are at 0, mm."""


class IsoErrors(NamedTuple):
    """The errors of one axis; the motion has both kinds added.

    ``position`` has position errors by name (``B0X`` …), ``component`` component errors by name (``EXX`` …) at each
    target; mm or rad.
    """

    position: dict[str, float]
    component: dict[str, list[float]]


def linear_axis_errors(plant: Plant, letter: str, targets: Sequence[float]) -> IsoErrors:
    """Return the errors of X, Y or Z, which carries the tool; the others stand at 0.

    What the straightness deviations have in common is the tilt of the axis: the slope of their best lines.
    """
    nominal = np.array(NOMINAL_DIRECTIONS[LETTERS.index(letter)])
    zero = _readings(plant, {})
    poses = [_mapping(zero, _readings(plant, {letter: target})) for target in targets]
    shifts = np.array([shift for _, shift in poses])
    slopes = np.polyfit(targets, shifts, 1)[0]
    tilt = np.cross(nominal, slopes)
    travelled = np.outer(targets, Rotation.from_euler("xyz", tilt).apply(nominal))
    turns = np.array([turn.as_euler("xyz") for turn, _ in poses])
    across = [k for k, along in zip("ABC", nominal, strict=True) if not along]
    position = {f"{k}0{letter}": float(tilt["ABC".index(k)]) for k in across}
    return IsoErrors(position, _component(letter, np.hstack([shifts - travelled, turns])))


def table_errors(
    plant: Plant, letter: str, center: Triple, targets: Sequence[float], at: Mapping[str, float]
) -> IsoErrors:
    """Return the errors of A, B or C, which carries the workpiece, while the other axes stand ``at`` these positions.

    Offset and tilt of the axis are the means of what is measured, as the model takes them (manual 003, 3.4); along and
    about the axis itself there are none.
    """
    direction = np.array(NOMINAL_DIRECTIONS[LETTERS.index(letter)])
    zero = _readings(plant, at)
    rows = []
    for target in targets:
        # The table carries the instrument: it sees the reflectors go the opposite way.
        turn, shift = _mapping(_readings(plant, {**at, letter: target}), zero)
        turned = turn * Rotation.from_rotvec(np.radians(target) * direction).inv()
        # Errors stand in the machine's coordinates: the table turns about its centre, then all of it is displaced.
        moved = turn.apply(center) + shift - turned.apply(center)
        rows.append([*moved, *turned.as_euler("xyz")])
    errors = np.array(rows)
    apart = np.unique(np.mod(targets, 360.0), return_index=True)[1]
    means = errors[apart].mean(axis=0) * np.tile(direction == 0.0, 2)
    position = {f"{k}0{letter}": float(means[i]) for i, k in enumerate(LETTERS) if not direction[i % len(LINEAR)]}
    return IsoErrors(position, _component(letter, errors - means))


def _component(letter: str, errors: Array) -> dict[str, list[float]]:
    return {f"E{k}{letter}": column for k, column in zip(LETTERS, errors.T.tolist(), strict=True)}


def _readings(plant: Plant, at: Mapping[str, float]) -> Array:
    """Return where the instrument sees the reflectors, all axes standing ``at`` these positions (others at 0)."""
    plant.rest_at([at.get(name, 0.0) for name in plant.names])
    return np.array([plant.place(reflector) for reflector in REFLECTORS])


def _mapping(before: Array, after: Array) -> tuple[Rotation, Array]:
    """Return the turn, and the shift after it, that map points, shape (points, 3), to others."""
    middle_before, middle_after = before.mean(axis=0), after.mean(axis=0)
    turn, _ = Rotation.align_vectors(after - middle_after, before - middle_before)
    shift: Array = middle_after - turn.apply(middle_before)
    return turn, shift
