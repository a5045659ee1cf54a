"""Friction parameters from a circular test: the plant is made to show the measured quadrant peaks, then tuned on.

Of each axis the plant's friction gets the pre-sliding, the level and the asymmetry with which its error around the
reversals comes closest to the measured one, by least squares; drive and control are as ``plant.json`` says. On that
plant the list's parameters are moved until the peaks are least.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from ..engine import Array
from ..kinds import Friction
from ..measurement import AFTER, BEFORE, CircularResult, window_of
from ..model import CYCLE_TIME, shown
from ..plant import Plant, drawn
from .creation import CannotCreateError
from .reversal import Circle, Peaks, ReversingAxis, Tuned, tune

PLAYS = (5e-4, 5e-3)
STARTS = (0.003, 0.01, 0.03)
"""Play and pre-sliding that are begun with, mm."""
TAKE_UP = (2e-4, 0.05)
PRESLIDING = (2e-4, 0.5)
"""Travels within which they are looked for, mm."""


@dataclass(frozen=True)
class TunedAxis:
    """What came of an axis.

    Attributes
    ----------
    axis : str
    measured, modelled : Peaks
        µm, in the conditions of the measurement.
    presliding, level, asymmetry : float
        Of the friction found, mm, as a share of that in ``plant.json``, and see ``plant``.
    play : float
        By which the slide stays behind, mean of both ends, µm.
    left : float
        Root mean square of measured − modelled error around the reversals, µm.
    tuned : Tuned
        Peaks without compensation, with the list as it is, and with the parameters that serve best.
    """

    axis: str
    measured: Peaks
    modelled: Peaks
    presliding: float
    level: float
    asymmetry: float
    play: float
    left: float
    tuned: Tuned


def plant_description(path: Path) -> Mapping[str, Any]:
    """Return what ``plant.json`` says, ranges drawn; PlantError if it is no plant."""
    Plant.from_file(path)
    found = json.loads(path.read_text(encoding="utf-8"))
    described: Mapping[str, Any] = drawn(found, int(found.get("seed", 0)))
    return described


def tune_on_circle(
    result: CircularResult, description: Mapping[str, Any], frictions: Mapping[str, Friction], acting: bool = False
) -> list[TunedAxis]:
    """Return what comes of each axis of a test that has a friction compensation.

    Parameters
    ----------
    result : CircularResult
        Its test has a feed.
    description : mapping
        See ``plant_description``.
    frictions : mapping of str to Friction
        The compensations as the lists say, by axis.
    acting : bool
        They acted during the test.

    Raises
    ------
    CannotCreateError
        The feed is not known, no axis has a friction compensation, or a reversal was not measured.
    """
    test = result.test
    if test.feed is None:
        raise CannotCreateError(
            "the feed of the test is not known: “# feed: 1000” (mm/min) in the file, or --feed, says it"
        )
    axes = [axis for axis in test.axes if axis in frictions]
    known = {axis["name"]: axis for axis in description["axes"]}
    absent = [axis for axis in axes if axis not in known]
    if absent or not axes:
        why = f"the plant has no axis {', '.join(absent)}" if absent else "has a friction compensation: see # plane"
        raise CannotCreateError(why if absent else f"neither {test.axes[0]} nor {test.axes[1]} {why}")
    circle = Circle(test.radius, test.feed)
    made = []
    for axis in axes:
        model = _Model(known[axis], float(description["sub_step"]), circle)
        made.append(model.fit(axis, _measured(result, axis, circle), frictions[axis], acting))
    return made


def _grid(circle: Circle) -> Array:
    """Return angles on the way from the reversal at which cycles end, °."""
    step = np.degrees(circle.feed / circle.radius * CYCLE_TIME)
    cycles = np.arange(-int(BEFORE / step), int(AFTER / step))
    # A drive's reference is the mean of two setpoints: half a cycle further.
    return np.asarray(step * (cycles + 0.5))


def _measured(result: CircularResult, axis: str, circle: Circle) -> list[Array]:
    """Return the mean deviation around the reversals at the positive and at the negative end, at the grid, µm."""
    grid, found = _grid(circle), []
    for sign in "+-":
        at = (0.0 if axis == result.test.axes[0] else 90.0) + (180.0 if sign == "-" else 0.0)
        curves = []
        for path in result.paths:
            way = path.direction * path.angles
            for mask in window_of(way, path.direction * at):
                here = np.mod(way[mask] - path.direction * at + 180.0, 360.0) - 180.0
                order = np.argsort(here)
                curves.append(np.interp(grid, here[order], path.deviations[mask][order]))
        if not curves:
            raise CannotCreateError(f"the test does not pass the reversal of {axis} at {sign}{axis}")
        found.append(np.mean(curves, axis=0))
    return found


class _Model:
    """The plant of one axis with a friction that is sought."""

    def __init__(self, description: Mapping[str, Any], sub_step: float, circle: Circle) -> None:
        self.description, self.sub_step, self.circle = description, sub_step, circle
        grid = _grid(circle)
        self.before, self.after = int(np.sum(grid < 0.0)), int(np.sum(grid > 0.0)) - 1
        self.cosine = np.cos(np.radians(grid))

    def axis(self, x: Array) -> ReversingAxis:
        """Return the axis with log pre-sliding, level, asymmetry, log take-up and play at either end (mm)."""
        friction = self.description["friction"]
        level = float(x[1])
        changed = {
            "bristle_damping": 0.0,
            **friction,
            "model": "lugre",
            "static": level * friction["static"],
            "coulomb": level * friction["coulomb"],
            "presliding": float(np.exp(x[0])),
            "asymmetry": float(x[2]),
        }
        axis = {**self.description, "friction": changed, "errors": {}}
        plant = Plant({"sub_step": self.sub_step, "axes": [axis]})
        plays, take_up = (float(x[4]), float(x[5])), float(np.exp(x[3]))
        return ReversingAxis(plant, axis["name"], self.circle, self.before, self.after, plays, take_up)

    def fit(self, name: str, measured: list[Array], friction: Friction, acting: bool) -> TunedAxis:
        """Return the friction that comes closest, and the parameters that serve best on it."""
        shape = [_bent(curve) for curve in measured]

        def off(x: Array) -> Array:
            modelled = self.axis(x).errors(friction if acting else None)
            return np.concatenate([_bent(self.cosine * m) - s for m, s in zip(modelled, shape, strict=True)])

        low = (np.log(PRESLIDING[0]), 0.2, -0.5, np.log(TAKE_UP[0]), -0.1, -0.1)
        high = (np.log(PRESLIDING[1]), 5.0, 0.5, np.log(TAKE_UP[1]), 0.1, 0.1)
        starts = [np.array([np.log(start), 1.0, 0.0, np.log(play), play, play]) for start in STARTS for play in PLAYS]
        best = min(starts, key=lambda x: float(np.sum(off(x) ** 2)))
        scale = (1.0, 0.3, 0.2, 1.0, 2e-3, 2e-3)
        found = least_squares(off, best, bounds=(low, high), x_scale=scale, diff_step=[1e-3] * 6, xtol=1e-4, ftol=1e-5)
        axis = self.axis(found.x)
        modelled = axis.peaks(friction if acting else None)
        peaks = Peaks(*(float(curve[np.argmax(np.abs(curve))]) for curve in shape))
        left = float(np.sqrt(np.mean(found.fun**2)))
        log, level, asymmetry, _, *plays = found.x.tolist()
        friction_found = float(np.exp(log)), level, asymmetry, shown(axis.unit).factor * float(np.mean(plays))
        return TunedAxis(name, peaks, modelled, *friction_found, left, tune(axis, friction))


def _bent(curve: Array) -> Array:
    """Return a curve less the line between its ends."""
    return np.asarray(curve - np.linspace(curve[0], curve[-1], len(curve)))
