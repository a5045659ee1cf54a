"""The errors of a machine by least squares from deviations of the tool tip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares

from ..engine import Array, TcpModel
from ..measurement import ANGLES, LENGTHS, RUN, Column, Columns, Readings
from ..model import ERRORS, LETTERS, LINEAR, ROTARY, ErrorTable, Volumetric, shown
from .creation import CannotCreateError
from .volumetric_basis import FULL_TURN, Redundancy, Selection, Sought, sought_errors

NODES_MAX = 11
"""Nodes of a component error unless more or fewer are asked for."""

MICRO = shown("mm").factor
COVERAGE = 2.0
"""Factor k of expanded uncertainties."""

_DEVIATIONS = tuple(Column(f"d{letter.lower()}", LENGTHS, "um") for letter in LINEAR)
_POSITIONS = (
    *(Column(letter.lower(), LENGTHS, "mm") for letter in LINEAR),
    *(Column(letter.lower(), ANGLES, "deg", optional=True) for letter in ROTARY),
)


@dataclass(frozen=True, eq=False)
class TcpDeviations(Readings):
    """Measured deviations of the tool tip, actual − nominal on the workpiece, in any order.

    Attributes
    ----------
    positions : array, shape (n, 6)
        Of X, Y, Z, A, B, C, mm and °; 0 where an axis is not given.
    tool_lengths : array, shape (n,)
        mm.
    deviations : array, shape (n, 3)
        In X, Y, Z of the workpiece, µm.
    given : str
        Letters of the axes whose positions the file gives.
    """

    positions: Annotated[Array, *_POSITIONS]
    tool_lengths: Annotated[Array, Column("tool_length", LENGTHS, "mm", optional=True)]
    deviations: Annotated[Array, *_DEVIATIONS]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    given: str = LETTERS
    source: str = ""

    @classmethod
    def about(cls, columns: Columns) -> dict[str, Any]:
        """Return which axes are given."""
        given = "".join(letter for letter in LETTERS if letter.lower() in columns.values)
        return {**super().about(columns), "given": given}


@dataclass(frozen=True, eq=False)
class Identification:
    """Errors that were found.

    Attributes
    ----------
    sought : tuple of Sought
        The errors and their nodes.
    values, uncertainty : tuple of array, shape (nodes,)
        For each of them, mm or rad; the expanded uncertainty (k = 2) is 0 where a value was not determined and is 0.
    redundancies : tuple of Redundancy
        What the data do not tell apart.
    covariance : array, shape (kept, kept)
        Of the values that are determined, mm and rad.
    kept : tuple of (str, float)
        Error and node of each of these.
    residuals : array, shape (n, 3)
        Measured minus modelled deviation, µm.
    scatter : float
        Standard deviation of the readings, µm: as given, else from the residuals.
    degrees_of_freedom : int
        Readings minus values.
    """

    sought: tuple[Sought, ...]
    values: tuple[Array, ...]
    uncertainty: tuple[Array, ...]
    redundancies: tuple[Redundancy, ...]
    covariance: Array
    kept: tuple[tuple[str, float], ...]
    residuals: Array
    scatter: float
    degrees_of_freedom: int

    def tables(self) -> tuple[ErrorTable, ...]:
        """Return the errors as tables; those that are 0 everywhere are left out."""
        found = []
        for sought, values in zip(self.sought, self.values, strict=True):
            if not values.any():
                continue
            if not sought.argument:
                found.append(ErrorTable(sought.name, (float(values[0]),)))
                continue
            nodes, column = sought.nodes, values
            if sought.periodic:
                nodes, column = np.append(nodes, nodes[0] + FULL_TURN), np.append(values, values[0])
            rows = tuple((float(node),) for node in nodes)
            found.append(ErrorTable(sought.name, tuple(column.tolist()), sought.argument, rows))
        return tuple(found)


class Identifier:
    """Finds the errors with which the model of a machine deviates as was measured.

    Parameters
    ----------
    measurement : TcpDeviations
        Without any volumetric compensation.
    volumetric : Volumetric
        The kinematics; errors in it that are not sought are known and stay.
    names : sequence of str, optional
        The errors that are sought; without it all of the axes in the chain.
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
        names = [error for error in ERRORS if error[-1] in volumetric.chain] if names is None else list(names)
        unknown = [name for name in names if name not in ERRORS or name[-1] not in volumetric.chain]
        if unknown:
            raise CannotCreateError(f"{', '.join(unknown)}: no error of an axis of the chain {volumetric.chain}")
        absent = ", ".join(letter for letter in volumetric.chain if letter not in measurement.given)
        if absent:
            raise CannotCreateError(f"the measurement has no column for {absent}, of the chain {volumetric.chain}")
        known = replace(volumetric, errors=tuple(table for table in volumetric.errors if table.name not in names))
        self._model = TcpModel(known)
        self._measurement = measurement
        self._scatter = scatter
        self._places = self._model.places(measurement.positions)
        self._base = self._model.known_errors(self._places)
        self.sought = sought_errors(names, self._places, nodes_max)
        self._which = [ERRORS.index(sought.name) for sought in self.sought]
        self._weights = [sought.weights(self._places) for sought in self.sought]
        self._ends = np.cumsum([weight.shape[1] for weight in self._weights])
        effects = self._model.derivatives(self._places, measurement.tool_lengths, self._base, self._which)
        self._columns = np.concatenate(
            [effects[:, :, i, None] * weight[:, None, :] for i, weight in enumerate(self._weights)], axis=2
        )

    def fit(self, chosen: npt.NDArray[np.bool_] | None = None) -> Identification:
        """Return the errors that fit all readings, or those chosen; CannotCreateError if they are too few."""
        rows = np.ones(len(self._places), dtype=bool) if chosen is None else chosen
        columns = self._columns[rows].reshape(-1, int(self._ends[-1]))
        selection = Selection(self.sought, columns)
        kept = selection.kept
        degrees = columns.shape[0] - len(kept)
        if degrees < 1:
            raise CannotCreateError(f"{columns.shape[0]} readings are not enough for {len(kept)} values of errors")
        lengths = np.linalg.norm(columns[:, kept], axis=0)
        jacobian = columns[:, kept] / lengths

        def split(scaled: Array) -> list[Array]:
            every = np.zeros(columns.shape[1])
            every[kept] = scaled / lengths
            return np.split(every, self._ends[:-1])

        def too_much(scaled: Array) -> Array:
            return -self._left(split(scaled), rows).ravel() / MICRO

        def slopes(_: Array) -> Array:
            # The model is all but linear in the errors, so its derivatives without them serve all the way.
            return np.asarray(jacobian, dtype=np.float64)

        solution = least_squares(too_much, np.zeros(len(kept)), jac=slopes, method="lm", xtol=1e-12, ftol=1e-12)
        residuals = self._left(split(solution.x), rows)
        scatter = float(np.sqrt(np.sum(residuals**2) / degrees)) if self._scatter is None else self._scatter
        # (JᵀJ)⁻¹ by QR: JᵀJ itself would lose half of the figures where errors are hard to tell apart.
        root = np.linalg.inv(np.linalg.qr(jacobian, mode="r"))
        inverse = root @ root.T
        deviations = split(np.sqrt(np.diag(inverse)) * scatter / MICRO)
        labels = [(sought.name, float(node)) for sought in self.sought for node in sought.nodes]
        return Identification(
            sought=tuple(self.sought),
            values=tuple(split(solution.x)),
            uncertainty=tuple(COVERAGE * column for column in deviations),
            redundancies=selection.redundancies,
            covariance=(scatter / MICRO) ** 2 * inverse / np.outer(lengths, lengths),
            kept=tuple(labels[value] for value in kept),
            residuals=residuals,
            scatter=scatter,
            degrees_of_freedom=degrees,
        )

    def left(self, found: Identification, chosen: npt.NDArray[np.bool_]) -> Array:
        """Return measured minus modelled deviations of some readings, (chosen, 3), µm."""
        return self._left(found.values, chosen)

    def _left(self, values: Sequence[Array], rows: npt.NDArray[np.bool_]) -> Array:
        errors = self._base[rows]
        for error, weight, column in zip(self._which, self._weights, values, strict=True):
            errors[:, error] += weight[rows] @ column
        modelled = self._model.deviations(self._places[rows], self._measurement.tool_lengths[rows], errors)
        return self._measurement.deviations[rows] - modelled * MICRO
