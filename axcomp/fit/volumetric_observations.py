"""How readings of the tool tip depend on it: frames of trackers, places of stations, dead paths, centres of spheres.

Every reading is a residual in µm of the actual tip W on the workpiece, with what an instrument does not know itself::

    deviation      W − W_nominal − d                       point     R(ω_s)·W + t_s − p, pose of station s
    length         |W − S_s| − l                           displacement   |W − S_s| − D_s − l, dead path D_s
    sphere         W at X, Y, Z + d, less c_s              centre c_s of sphere s

Stations and spheres stand still on the workpiece.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from ..engine import Array
from .volumetric_algebra import MICRO
from .volumetric_readings import DEVIATION, DISPLACEMENT, LENGTH, POINT, SPHERE, TcpDeviations

_ITERATIONS = 30
_SETTLED = 1e-9


@dataclass
class Unknown:
    """What is not known of a station or sphere, and which readings it concerns.

    ``values``: pose (rotation vector in mrad, shift), place with dead path, or centre; mm. mrad make its columns about
    as long as those of shifts where a machine is about a metre large.
    """

    kind: int
    number: int
    rows: npt.NDArray[np.int64]
    values: Array

    @property
    def name(self) -> str:
        """What a sentence calls it."""
        if self.kind == SPHERE:
            return f"centre of sphere {self.number}"
        what = {POINT: "pose", LENGTH: "place", DISPLACEMENT: "place and dead path"}[self.kind]
        return f"{what} of station {self.number}"


class Observations:
    """Residuals of readings and their derivatives; ``unknowns`` start where they fit a machine without errors."""

    def __init__(self, readings: TcpDeviations, nominal: Array) -> None:
        self.readings = readings
        self.nominal = nominal
        self.scalar = np.isin(readings.kinds, (LENGTH, DISPLACEMENT))
        self.unknowns = [self._first(*one) for one in _groups(readings)]
        self.fit_unknowns(nominal)

    def _first(self, kind: int, number: int, rows: npt.NDArray[np.int64]) -> Unknown:
        tips, measured = self.nominal[rows], self.readings.measured[rows]
        if kind == SPHERE:
            return Unknown(kind, number, rows, tips.mean(axis=0))
        if kind == POINT:
            middle, seen = tips.mean(axis=0), measured.mean(axis=0)
            turn = np.zeros(3)
            if len(rows) > 2:
                u, _, v = np.linalg.svd((measured - seen).T @ (tips - middle))
                proper = np.diag([1.0, 1.0, np.linalg.det(u @ v)])
                turn = Rotation.from_matrix(u @ proper @ v).as_rotvec()
            return Unknown(kind, number, rows, np.append(turn * MICRO, seen - Rotation.from_rotvec(turn).apply(middle)))
        # |p|² − l² = 2 p·S + 2 l D − (|S|² − D²) is linear in S, D and the bracket.
        lengths = measured[:, 0]
        columns = [2.0 * tips, np.ones((len(rows), 1))]
        if kind == DISPLACEMENT:
            columns.append(2.0 * lengths[:, None])
        found = np.linalg.lstsq(np.hstack(columns), np.sum(tips**2, axis=1) - lengths**2, rcond=1e-9)[0]
        return Unknown(kind, number, rows, np.append(found[:3], found[4:]))

    def fit_unknowns(self, tips: Array) -> None:
        """Fit what is unknown of stations and spheres to tips (n, 3), by Gauss and Newton with a Levenberg brake."""
        for one in self.unknowns:
            brake, residuals = 1e-3, self._of(one, tips)[0]
            for _ in range(_ITERATIONS):
                _, slopes = self._of(one, tips)
                jacobian = slopes.reshape(-1, len(one.values))
                normal = jacobian.T @ jacobian
                damped = normal + brake * np.diag(np.diag(normal) + 1e-12)
                step = np.linalg.lstsq(damped, jacobian.T @ residuals.ravel(), rcond=None)[0]
                one.values = one.values - step
                changed = self._of(one, tips)[0]
                if np.sum(changed**2) > np.sum(residuals**2):
                    one.values, brake = one.values + step, brake * 10.0
                else:
                    residuals, brake = changed, brake * 0.1
                if np.linalg.norm(step) < _SETTLED:
                    break

    def residuals(self, tips: Array) -> Array:
        """Return modelled minus measured readings for actual tips, (n, 3), mm; 0 beside the first one of lengths."""
        plain = self.readings.kinds == DEVIATION
        found = np.zeros_like(tips)
        found[plain] = tips[plain] - self.nominal[plain] - self.readings.deviations[plain] / MICRO
        for one in self.unknowns:
            found[one.rows] = self._of(one, tips)[0]
        return found

    def slopes(self, tips: Array, effects: Array) -> Array:
        """Return what parameters do to readings, (n, 3, k), from what they do to the tips, (n, 3, k)."""
        found = effects.copy()
        for one in self.unknowns:
            if one.kind == POINT:
                turn = Rotation.from_rotvec(one.values[:3] / MICRO).as_matrix()
                found[one.rows] = np.einsum("ij,njk->nik", turn, effects[one.rows])
            elif one.kind != SPHERE:
                found[one.rows] = 0.0
                found[one.rows, 0] = np.einsum("nj,njk->nk", self._away(one, tips), effects[one.rows])
        return found

    def unknown_slopes(self, tips: Array) -> Array:
        """Return what the unknowns do to readings, (n, 3, unknown values)."""
        found = np.zeros((len(tips), 3, sum(len(one.values) for one in self.unknowns)))
        first = 0
        for one in self.unknowns:
            found[one.rows, :, first : first + len(one.values)] = self._of(one, tips)[1]
            first += len(one.values)
        return found

    def add(self, steps: Array) -> None:
        """Change the unknowns."""
        first = 0
        for one in self.unknowns:
            one.values = one.values + steps[first : first + len(one.values)]
            first += len(one.values)

    def _away(self, one: Unknown, tips: Array) -> Array:
        """Return unit vectors from a station to tips."""
        arms = tips[one.rows] - one.values[:3]
        return np.asarray(arms / np.maximum(np.linalg.norm(arms, axis=1), 1e-9)[:, None])

    def _of(self, one: Unknown, tips: Array) -> tuple[Array, Array]:
        """Return residuals (rows, 3) and their slopes over the values of an unknown (rows, 3, values)."""
        at, measured = tips[one.rows], self.readings.measured[one.rows]
        slopes = np.zeros((len(at), 3, len(one.values)))
        if one.kind == SPHERE:
            slopes[:] = -np.eye(3)
            return at - one.values, slopes
        if one.kind == POINT:
            turned = Rotation.from_rotvec(one.values[:3] / MICRO).apply(at)
            # The slope over a turn that follows; the pose is changed by rotation vectors that are added, which is the
            # same for small turns and converges as well for others.
            vector = one.values[:3] / MICRO
            for k in range(3):
                step = np.zeros(3)
                step[k] = 1e-6
                ahead, behind = (Rotation.from_rotvec(vector + sign * step).apply(at) for sign in (1.0, -1.0))
                slopes[:, :, k] = (ahead - behind) / 2e-6 / MICRO
            slopes[:, :, 3:] = np.eye(3)
            return turned + one.values[3:] - measured, slopes
        away, residuals = self._away(one, tips), np.zeros_like(at)
        residuals[:, 0] = np.linalg.norm(at - one.values[:3], axis=1) - measured[:, 0]
        slopes[:, 0, :3] = -away
        if one.kind == DISPLACEMENT:
            residuals[:, 0] -= one.values[3]
            slopes[:, 0, 3] = -1.0
        return residuals, slopes


def _groups(readings: TcpDeviations) -> Iterator[tuple[int, int, npt.NDArray[np.int64]]]:
    """Yield kind, number and rows of each station and sphere."""
    for kind in (POINT, LENGTH, DISPLACEMENT, SPHERE):
        mine = readings.kinds == kind
        for number in np.unique(readings.stations[mine]):
            yield kind, int(number), np.flatnonzero(mine & (readings.stations == number))
