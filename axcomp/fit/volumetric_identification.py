"""The errors of a machine by least squares from readings of the tool tip.

The model is all but linear in the errors, so one set of derivatives serves all the way. What readings tell is judged on
the triangle R of the QR decomposition of the derivatives: it has the same lengths and angles between columns as they,
with as many rows as values. (JᵀJ would lose half of the figures where errors are hard to tell apart.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_triangular

from ..engine import Array, TcpModel
from ..model import ERRORS, LETTERS, LINEAR, ROTARY, Volumetric, is_angle
from .creation import CannotCreateError
from .volumetric_algebra import MICRO, inverse_of, radius_of, triangle, without_rigid
from .volumetric_basis import Selection, Sought, sought_errors
from .volumetric_observations import Observations
from .volumetric_readings import DEVIATION, SPHERE, TcpDeviations
from .volumetric_result import CENTER_NAMES, Identification

NODES_MAX = 11
"""Nodes of a component error unless more or fewer are asked for."""

COVERAGE = 2.0
"""Factor k of expanded uncertainties."""

HELD = {"length": 0.1, "angle": 2e-4, "center": 10.0}
"""Standard deviation around 0, mm or rad, of values that readings tell even worse: machines have smaller errors."""
Places = npt.NDArray[np.int64]
_ROUNDS = 12
_SETTLED = 1e-5
"""µm, root mean square, that another step would change."""


class Identifier:
    """Finds the errors with which the model of a machine deviates as was measured.

    Parameters
    ----------
    measurement : TcpDeviations
        Without any volumetric compensation.
    volumetric : Volumetric
        The kinematics; errors in it that are not sought are known and stay.
    names : sequence of str, optional
        The errors, and the coordinates of centres of rotary axes (``PXC``), that are sought; without it all errors of
        the axes in the chain, and the centres if places of spheres are given.
    nodes_max : int
        Values of a component error at most.
    scatter : float, optional
        Standard deviation of a reading in one direction, µm; without it, it comes from the residuals.

    Raises
    ------
    CannotCreateError
        An error does not exist, or positions of an axis in the chain are missing.
    """

    def __init__(
        self,
        measurement: TcpDeviations,
        volumetric: Volumetric,
        names: Sequence[str] | None = None,
        nodes_max: int = NODES_MAX,
        scatter: float | None = None,
    ) -> None:
        spheres = bool((measurement.kinds == SPHERE).any())
        names = _all_names(volumetric, spheres) if names is None else list(names)
        known = (*ERRORS, *CENTER_NAMES)
        unknown = [name for name in names if name not in known or name[-1] not in volumetric.chain]
        if unknown:
            raise CannotCreateError(f"{', '.join(unknown)}: no error of an axis of the chain {volumetric.chain}")
        absent = ", ".join(letter for letter in volumetric.chain if letter not in measurement.given)
        if absent:
            raise CannotCreateError(f"the measurement has no column for {absent}, of the chain {volumetric.chain}")
        kept = replace(volumetric, errors=tuple(table for table in volumetric.errors if table.name not in names))
        self._model = TcpModel(kept)
        self._measurement = measurement
        self._scatter = scatter
        positions = measurement.positions.copy()
        away = measurement.kinds == SPHERE
        positions[away, :3] += measurement.deviations[away] / MICRO
        self._places = self._model.places(positions)
        self._base = self._model.known_errors(self._places)
        centers = [Sought(name, "", np.zeros(1)) for name in CENTER_NAMES if name in names]
        self.sought = [*centers, *sought_errors(names, self._places, nodes_max)]
        self._weights = [sought.weights(self._places) for sought in self.sought]
        self._ends = np.cumsum([weight.shape[1] for weight in self._weights])
        self._nominal = self._model.nominal(self._places, measurement.tool_lengths)
        tips = self._model.tips(self._places, measurement.tool_lengths, self._base)
        self.observations = Observations(measurement, self._nominal)
        self.observations.fit_unknowns(tips)
        self._without = self.observations.residuals(tips)
        self._offset = {sought.name: 0.0 for sought in centers}
        self._fits: dict[bytes, Identification] = {}
        if centers:
            self._move_centers_near(tips)
        self._columns = self._derivatives()

    def _move_centers_near(self, tips: Array) -> None:
        """Move the centres about where they are: errors have other levers where they are far off."""
        columns = [i for i, sought in enumerate(self.sought) if sought.name in CENTER_NAMES]
        for _ in range(3):
            slopes = self.observations.slopes(tips, self._center_effects([self.sought[i].name for i in columns]))
            jacobian = np.concatenate([self.observations.unknown_slopes(tips), slopes], axis=2)
            flat = jacobian.reshape(-1, jacobian.shape[2])
            residuals = self.observations.residuals(tips).ravel()
            step = -np.linalg.lstsq(flat, residuals, rcond=1e-6)[0]
            for i, change in zip(columns, step[-len(columns) :], strict=True):
                axis, direction = divmod(CENTER_NAMES.index(self.sought[i].name), 3)
                self._model.centers[axis, direction] += change
                self._offset[self.sought[i].name] += float(change)
            tips = self._model.tips(self._places, self._measurement.tool_lengths, self._base)
            self.observations.fit_unknowns(tips)
            if np.linalg.norm(step[-len(columns) :]) < 1e-3:
                return

    def _center_effects(self, names: Sequence[str]) -> Array:
        """Return what moving centres does to the tips, (n, 3, names)."""
        found = []
        for name in names:
            axis, direction = divmod(CENTER_NAMES.index(name), 3)
            lengths = self._measurement.tool_lengths
            effects = self._model.center_derivatives(self._places, lengths, self._base, ROTARY[axis])
            found.append(effects[:, :, direction])
        return np.stack(found, axis=2) if found else np.zeros((len(self._places), 3, 0))

    def _derivatives(self) -> Array:
        """Return what each value, behind those of stations and spheres, does to the readings, (n, 3, values)."""
        lengths = self._measurement.tool_lengths
        tips = self._model.tips(self._places, lengths, self._base)
        errors = [sought.name for sought in self.sought if sought.name in ERRORS]
        which = [ERRORS.index(name) for name in errors]
        effects = np.concatenate(
            [
                self._center_effects([sought.name for sought in self.sought if sought.name in CENTER_NAMES]),
                self._model.derivatives(self._places, lengths, self._base, which),
            ],
            axis=2,
        )
        seen = self.observations.slopes(tips, effects)
        unknown = self.observations.unknown_slopes(tips)
        columns = np.empty((*unknown.shape[:2], unknown.shape[2] + int(self._ends[-1] if len(self._ends) else 0)))
        columns[:, :, : unknown.shape[2]] = unknown
        first = unknown.shape[2]
        for i, weight in enumerate(self._weights):
            columns[:, :, first : first + weight.shape[1]] = seen[:, :, i, None] * weight[:, None, :]
            first += weight.shape[1]
        return columns

    @property
    def columns(self) -> Array:
        """What each value, those of stations and spheres first, does to the readings, (n, 3, values)."""
        return self._columns

    @property
    def measured(self) -> Array:
        """Measured minus modelled readings without any error that is sought, (n, 3), µm."""
        return -self._without * MICRO

    def fit(self, chosen: npt.NDArray[np.bool_] | None = None) -> Identification:
        """Return the errors that fit all readings, or those chosen; CannotCreateError if they are too few."""
        rows = np.ones(len(self._places), dtype=bool) if chosen is None else chosen
        if rows.tobytes() not in self._fits:
            self._fits[rows.tobytes()] = self._fit(rows)
        return self._fits[rows.tobytes()]

    def _fit(self, rows: npt.NDArray[np.bool_]) -> Identification:
        start = [one.values.copy() for one in self.observations.unknowns]
        columns = self._columns[rows].reshape(-1, self._columns.shape[2])
        count = int(np.sum(np.where(self.observations.scalar[rows], 1, 3)))
        whole = triangle(columns)
        unknowns = [Sought(u.name, "", np.zeros(len(u.values)), rigid=True) for u in self.observations.unknowns]
        selection = Selection([*unknowns, *self.sought], whole)
        kept = selection.kept
        degrees = count - len(kept)
        if degrees < 1:
            raise CannotCreateError(f"{count} readings are not enough for {len(kept)} values of errors")
        lengths = np.linalg.norm(whole[:, kept], axis=0)
        root = triangle(whole[:, kept] / lengths)
        held, regularized = np.zeros(len(kept)), ()
        # What a linear fit would leave says how well values will be told, before anything is moved by it.
        before = self._left(self._split(self._start(columns)))[rows].ravel()
        explained = solve_triangular(root, columns[:, kept].T @ before / lengths, trans="T")
        rest = max(float(before @ before - explained @ explained), 0.0)
        scatter = self._scatter or float(np.sqrt(rest / degrees))
        uncertain = scatter / MICRO * np.linalg.norm(inverse_of(root), axis=1) / lengths
        limits = self.limits[kept]
        if (uncertain > limits).any():
            names = [self._labels()[value][0] for value in kept[uncertain > limits]]
            regularized = tuple(dict.fromkeys(names))
            # As if each value had been measured to be 0 with the limit as its standard deviation.
            held = np.where(np.isfinite(limits), scatter / MICRO / limits / lengths, 0.0)
            root = triangle(np.vstack([root, np.diag(held)]))
        values, residuals = self._solve(rows, columns, kept, lengths, root, held)
        scatter = self._scatter or float(np.sqrt(np.sum(residuals[rows] ** 2) / degrees))
        inverse = inverse_of(root)
        every = np.zeros(columns.shape[1])
        every[kept] = np.linalg.norm(inverse, axis=1) / lengths * scatter / MICRO
        nuisance = columns.shape[1] - sum(map(len, self._split(np.zeros(columns.shape[1]))))
        mine = kept >= nuisance
        inverse = inverse[mine] / lengths[mine, None]
        labels = self._labels()
        found = Identification(
            sought=tuple(self.sought),
            values=tuple(values),
            uncertainty=tuple(COVERAGE * column for column in self._split(every)),
            redundancies=selection.redundancies,
            regularized=regularized,
            covariance=(scatter / MICRO) ** 2 * inverse @ inverse.T,
            kept=tuple(labels[value] for value in kept[mine]),
            residuals=residuals[rows],
            scatter=scatter,
            degrees_of_freedom=degrees,
            unknowns=tuple((one.name, one.values.copy()) for one in self.observations.unknowns),
        )
        for one, values_before in zip(self.observations.unknowns, start, strict=True):
            one.values = values_before
        return found

    def _solve(
        self, rows: npt.NDArray[np.bool_], columns: Array, kept: Places, lengths: Array, root: Array, held: Array
    ) -> tuple[list[Array], Array]:
        """Return values and residuals, measured − modelled, (n, 3), µm; unknowns are changed on the way."""
        every = self._start(columns)
        nuisance = columns.shape[1] - int(self._ends[-1] if len(self._ends) else 0)
        residuals = self._left(self._split(every))
        for _ in range(_ROUNDS):
            gradient = columns[:, kept].T @ residuals[rows].ravel() / lengths / MICRO - held * held * (
                every[kept] * lengths
            )
            step = solve_triangular(root, solve_triangular(root, gradient, trans="T"))
            full = np.zeros(columns.shape[1])
            full[kept] = step / lengths
            every += full
            self.observations.add(full[:nuisance])
            residuals = self._left(self._split(every))
            if np.linalg.norm(root @ step) * MICRO < _SETTLED * np.sqrt(len(columns)):
                break
        return self._split(every), residuals

    def _start(self, columns: Array) -> Array:
        """Return the values to begin with: 0, and how far centres were moved before."""
        every = np.zeros(columns.shape[1])
        nuisance = columns.shape[1] - int(self._ends[-1] if len(self._ends) else 0)
        for i, sought in enumerate(self.sought):  # centres come first, with one value each
            if sought.name in self._offset:
                every[nuisance + i] = self._offset[sought.name]
        return every

    def _split(self, every: Array) -> list[Array]:
        """Return the values of each error that is sought."""
        if not len(self._ends):
            return []
        return np.split(every[len(every) - int(self._ends[-1]) :], self._ends[:-1])

    def _labels(self) -> list[tuple[str, float]]:
        """Return name and node of each value, those of stations and spheres first."""
        unknown = [(one.name, 0.0) for one in self.observations.unknowns for _ in one.values]
        return unknown + [(sought.name, float(node)) for sought in self.sought for node in sought.nodes]

    @property
    def limits(self) -> Array:
        """Return the standard deviation beyond which a value is held near 0, mm or rad; none of stations."""
        unknown = [np.inf for one in self.observations.unknowns for _ in one.values]
        kinds = [
            "center" if sought.name in CENTER_NAMES else "angle" if is_angle(sought.name) else "length"
            for sought in self.sought
            for _ in sought.nodes
        ]
        return np.array(unknown + [HELD[kind] for kind in kinds])

    def left(self, found: Identification, chosen: npt.NDArray[np.bool_]) -> Array:
        """Return measured minus modelled readings of some, (chosen, 3), µm."""
        before = [one.values for one in self.observations.unknowns]
        for one, (_, values) in zip(self.observations.unknowns, found.unknowns, strict=True):
            one.values = values
        left = self._left(found.values)[chosen]
        for one, values in zip(self.observations.unknowns, before, strict=True):
            one.values = values
        return left

    def _left(self, values: Sequence[Array]) -> Array:
        errors = self._base.copy()
        centers = self._model.centers.copy()
        for sought, weight, column in zip(self.sought, self._weights, values, strict=True):
            if sought.name in CENTER_NAMES:
                axis, direction = divmod(CENTER_NAMES.index(sought.name), 3)
                moved = float(column[0]) - self._offset.get(sought.name, 0.0)
                self._model.centers[axis, direction] += moved
            else:
                errors[:, ERRORS.index(sought.name)] += weight @ column
        tips = self._model.tips(self._places, self._measurement.tool_lengths, errors)
        self._model.centers[:] = centers
        return -self.observations.residuals(tips) * MICRO

    def tip_uncertainty(self, found: Identification, positions: Array, tool_length: float = 0.0) -> Array:
        """Return the radius around the modelled tip that the true one is in with 95 %, at positions (n, 6), µm.

        Where all readings come from stations or spheres, what moves all places alike as a rigid body does not count.
        """
        nodes = {label: k for k, label in enumerate((s.name, float(node)) for s in self.sought for node in s.nodes)}
        slopes = self.tip_slopes(positions, tool_length)[:, :, [nodes[label] for label in found.kept]]
        free = not (self._measurement.kinds == DEVIATION).any()
        return radius_of(without_rigid(slopes, positions[:, :3]) if free else slopes, found.covariance)

    def tip_slopes(self, positions: Array, tool_length: float = 0.0) -> Array:
        """Return what each value does to the tip at positions (n, 6), (n, 3, values), mm per mm or rad."""
        places = self._model.places(positions)
        base, lengths = self._model.known_errors(places), np.full(len(places), tool_length)
        columns = []
        for sought in self.sought:
            if sought.name in CENTER_NAMES:
                axis, direction = divmod(CENTER_NAMES.index(sought.name), 3)
                effect = self._model.center_derivatives(places, lengths, base, ROTARY[axis])[:, :, direction]
            else:
                effect = self._model.derivatives(places, lengths, base, [ERRORS.index(sought.name)])[:, :, 0]
            columns.append(effect[:, :, None] * sought.weights(places)[:, None, :])
        return np.concatenate(columns, axis=2)


def _all_names(volumetric: Volumetric, spheres: bool) -> list[str]:
    names = [error for error in ERRORS if error[-1] in volumetric.chain]
    if not spheres:
        return names
    # Along its axis a centre may lie anywhere.
    for letter in (one for one in ROTARY if one in volumetric.chain):
        direction = volumetric.directions[LETTERS.index(letter)]
        names += [f"P{k}{letter}" for k, along in zip(LINEAR, direction, strict=True) if abs(along) < 0.9]
    return names
