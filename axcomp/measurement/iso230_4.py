"""Circular tests by ISO 230-4: the figures of the standard, and what they come from.

* G: separation of the minimum zone circles of one path; G(b): of a path in either direction together.
* D: radius of the least squares circle of both paths − nominal radius (mean bi-directional radial deviation).
* F: distance of a path from the nominal circle, outward positive, about the centre of the least squares circle of the
  path or, where the instrument is set up on it, of the circle as measured; its largest and smallest values.

What else is told comes from least squares of all paths outside of the quadrant peaks, with θ the angle, s = ±1 the
direction: ``r₀ + cₓ cos θ + c_y sin θ + a cos 2θ + b sin 2θ + m s sin 2θ + s (Bₓ/2 sgn(sin θ) cos θ − B_y/2 sgn(cos θ)
sin θ)``: scale mismatch 2a/R (X − Y), squareness −2b/R (angle between the axes − 90°), servo mismatch m (needs both
directions) and the reversal values B. A quadrant peak is what stands out farthest, from ``BEFORE``° to ``AFTER``° on
the way around a reversal, from the line between both ends.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..model import shown
from .circles import least_squares_circle, minimum_zone
from .circular import CircularPath, CircularTest
from .quadrants import peak_of

if TYPE_CHECKING:
    from matplotlib.projections.polar import PolarAxes

BEFORE, AFTER = 2.0, 15.0
"""Angle around a reversal in which its peak is looked for, °."""
FULL = 345.0
"""Angle from which a path counts as all the way round, °."""
ARROWS = {1: "↺", -1: "↻"}
MICRO = shown("mm").factor


@dataclass(frozen=True, eq=False)
class PathResult:
    """Figures of a path, µm: see the module.

    Attributes
    ----------
    direction : int
    G, F_max, F_min : float
    peaks : mapping of str to float
        By where an axis reverses, ``+X`` say, outward positive; NaN where the path does not pass it.
    angles, deviations : array, shape (n,)
        ° and µm, about the centre of F, ascending in the order of the path.
    """

    direction: int
    G: float
    F_max: float
    F_min: float
    peaks: Mapping[str, float]
    angles: Array = field(repr=False)
    deviations: Array = field(repr=False)


@dataclass(frozen=True, eq=False)
class CircularResult:
    """What ISO 230-4 says of a test, µm; NaN where a direction is missing.

    Attributes
    ----------
    test : CircularTest
    paths : tuple of PathResult
    G_bidirectional, D : float
    scale_mismatch, squareness : float
        µm/m: scale of the first axis − that of the second, angle between them − 90°.
    servo_mismatch : float
        µm: amplitude of what goes with the direction.
    reversal : mapping of str to float
        Reversal value of each axis.
    left : float
        Standard deviation of what these do not explain.
    notes : tuple of str
    """

    test: CircularTest
    paths: tuple[PathResult, ...]
    G_bidirectional: float
    D: float
    scale_mismatch: float
    squareness: float
    servo_mismatch: float
    reversal: Mapping[str, float]
    left: float
    notes: tuple[str, ...] = ()

    def peak(self, end: str) -> float:
        """Return the peak where an axis reverses, ``+X`` say: the mean size over the paths, the sign of the largest."""
        values = np.array([path.peaks[end] for path in self.paths if np.isfinite(path.peaks[end])])
        return float(np.copysign(np.mean(np.abs(values)), values[np.argmax(np.abs(values))])) if len(values) else np.nan

    def figures(self) -> dict[str, tuple[float, str]]:
        """Return figures and units by name, in the order of a report."""
        named: dict[str, tuple[float, str]] = {}
        counts: dict[int, int] = {}
        for path in self.paths:
            counts[path.direction] = counts.get(path.direction, 0) + 1
            run = f" {counts[path.direction]}" if counts[path.direction] > 1 else ""
            arrow = f"{ARROWS[path.direction]}{run}"
            figures = {"G": path.G, "F_max": path.F_max, "F_min": path.F_min}
            named |= {f"{name[0]}{arrow}{name[2:]}": (value, "µm") for name, value in figures.items()}
        named |= {"G(b)": (self.G_bidirectional, "µm"), "D": (self.D, "µm")}
        first, second = self.test.axes
        named |= {
            f"scale mismatch {first} − {second}": (self.scale_mismatch, "µm/m"),
            f"squareness {first}{second} (angle − 90°)": (self.squareness, "µm/m"),
            "servo mismatch": (self.servo_mismatch, "µm"),
            **{f"reversal value {axis}": (value, "µm") for axis, value in self.reversal.items()},
            "left unexplained (s)": (self.left, "µm"),
        }
        return named

    def to_dict(self) -> dict[str, Any]:
        """Return everything for JSON; None stands for what is not available."""

        def clean(value: float) -> float | None:
            return None if np.isnan(value) else value

        return {
            "standard": "ISO 230-4",
            "source": self.test.source,
            "axes": list(self.test.axes),
            "radius": self.test.radius,
            "G_bidirectional": clean(self.G_bidirectional),
            "D": clean(self.D),
            "scale_mismatch": clean(self.scale_mismatch),
            "squareness": clean(self.squareness),
            "servo_mismatch": clean(self.servo_mismatch),
            "reversal": {axis: clean(value) for axis, value in self.reversal.items()},
            "left": clean(self.left),
            "paths": [
                {
                    "direction": path.direction,
                    "G": path.G,
                    "F_max": path.F_max,
                    "F_min": path.F_min,
                    "peaks": {end: clean(value) for end, value in path.peaks.items()},
                }
                for path in self.paths
            ],
            "notes": list(self.notes),
        }

    def plot(self, ax: PolarAxes | None = None) -> Any:
        """Draw the paths magnified on polar axes; return these."""
        from .polar import draw_polar

        return draw_polar(self, ax)


def evaluate_circular(test: CircularTest, *, set_up: bool = False) -> CircularResult:
    """Return the figures of a test; ``set_up``: F about the measured centre, not that of the least squares circle."""
    notes = []
    results = tuple(_path(test, path, set_up) for path in test.paths)
    for path, result in zip(test.paths, results, strict=True):
        if np.ptp(result.angles) < FULL:
            turned = f"{ARROWS[path.direction]} goes {np.ptp(result.angles):.0f}°"
            notes.append(f"A path {turned}: less than all the way round.")
    whole = np.concatenate([path.points for path in test.paths])
    both = {path.direction for path in test.paths} == {1, -1}
    if not both:
        notes.append("One direction was measured: no G(b), no D, and servo mismatch counts as squareness.")
    model = _explained(results)
    nan = float("nan")
    return CircularResult(
        test=test,
        paths=results,
        G_bidirectional=MICRO * minimum_zone(whole).width if both else nan,
        D=MICRO * (least_squares_circle(whole).radius - test.radius) if both else nan,
        scale_mismatch=2.0 * model["cos2"] / test.radius * 1e3,
        squareness=-2.0 * model["sin2"] / test.radius * 1e3,
        servo_mismatch=model.get("servo", nan),
        reversal={axis: model[f"reversal{n}"] for n, axis in enumerate(test.axes)},
        left=model["left"],
        notes=tuple(notes),
    )


def _path(test: CircularTest, path: CircularPath, set_up: bool) -> PathResult:
    centre = np.zeros(2) if set_up else least_squares_circle(path.points).centre
    away = path.points - centre
    angles = np.degrees(np.unwrap(np.arctan2(away[:, 1], away[:, 0])))
    deviations = MICRO * (np.hypot(*away.T) - test.radius)
    first, second = test.axes
    peaks = {
        end: _peak(path.direction * angles, deviations, path.direction * at)
        for at, end in ((0.0, f"+{first}"), (90.0, f"+{second}"), (180.0, f"-{first}"), (270.0, f"-{second}"))
    }
    zone = minimum_zone(path.points)
    return PathResult(
        path.direction, MICRO * zone.width, float(deviations.max()), float(deviations.min()), peaks, angles, deviations
    )


def window_of(angles: Array, at: float) -> list[npt.NDArray[np.bool_]]:
    """Return where a path is around each pass of an angle, if it has all of the window; ° on the way, ascending."""
    found = []
    for turn in range(int(np.floor((angles.min() - at) / 360.0)), int(np.ceil((angles.max() - at) / 360.0)) + 1):
        here = angles - at - 360.0 * turn
        if here.min() <= -BEFORE and here.max() >= AFTER:
            found.append((here >= -BEFORE) & (here <= AFTER))
    return [mask for mask in found if np.sum(mask) >= 5]


def _peak(angles: Array, deviations: Array, at: float) -> float:
    peaks = [peak_of(deviations[mask]) for mask in window_of(angles, at)]
    return float(np.mean(peaks)) if peaks else float("nan")


def _explained(results: tuple[PathResult, ...]) -> dict[str, float]:
    """Return what explains the deviations, µm."""
    angle = np.concatenate([result.angles for result in results])
    sign = np.concatenate([np.full(len(result.angles), float(result.direction)) for result in results])
    values = np.concatenate([result.deviations for result in results])
    # On the way from a reversal; peaks and what is right before them do not count.
    gone = np.mod(sign * angle + BEFORE, 90.0) - BEFORE
    rows = gone > AFTER
    theta = np.radians(angle)
    columns = {
        "radius": np.ones(len(theta)),
        "x": np.cos(theta),
        "y": np.sin(theta),
        "cos2": np.cos(2.0 * theta),
        "sin2": np.sin(2.0 * theta),
        "reversal0": 0.5 * sign * np.sign(np.sin(theta)) * np.cos(theta),
        "reversal1": -0.5 * sign * np.sign(np.cos(theta)) * np.sin(theta),
    }
    if len(set(sign.tolist())) > 1:
        columns["servo"] = sign * np.sin(2.0 * theta)
    # Each path has a centre of its own.
    which = np.repeat(np.arange(len(results)), [len(result.angles) for result in results])
    for other in range(1, len(results)):
        columns |= {f"x{other}": (which == other) * np.cos(theta), f"y{other}": (which == other) * np.sin(theta)}
    matrix = np.column_stack(list(columns.values()))[rows]
    weights = np.ones(len(matrix))
    for _ in range(8):
        solution = np.linalg.lstsq(matrix * weights[:, None], values[rows] * weights, rcond=None)[0]
        residuals = values[rows] - matrix @ solution
        spread = 1.4826 * float(np.median(np.abs(residuals))) + 1e-12
        weights = np.sqrt(np.minimum(1.0, 2.0 * spread / np.maximum(np.abs(residuals), 1e-300)))
    found = dict(zip(columns, solution.tolist(), strict=True))
    return {**found, "left": float(np.std(residuals))}
