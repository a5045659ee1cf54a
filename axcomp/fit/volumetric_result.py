"""What a volumetric identification finds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engine import Array
from ..model import CENTERS, ErrorTable, Triple
from .volumetric_basis import FULL_TURN, Redundancy, Sought

CENTER_NAMES = tuple(name for names in CENTERS for name in names)


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
    regularized : tuple of str
        Errors that the data tell so badly that they are held near 0 (``HELD``).
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
    unknowns : tuple of (str, array)
        What was found of stations and spheres, mm: pose (rotation vector, mrad, and shift), place, dead path, centre.
    """

    sought: tuple[Sought, ...]
    values: tuple[Array, ...]
    uncertainty: tuple[Array, ...]
    redundancies: tuple[Redundancy, ...]
    regularized: tuple[str, ...]
    covariance: Array
    kept: tuple[tuple[str, float], ...]
    residuals: Array
    scatter: float
    degrees_of_freedom: int
    unknowns: tuple[tuple[str, Array], ...] = ()

    def tables(self) -> tuple[ErrorTable, ...]:
        """Return the errors as tables; those that are 0 everywhere are left out."""
        found = []
        for sought, values in zip(self.sought, self.values, strict=True):
            if not values.any() or sought.name in CENTER_NAMES:
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

    def centers(self, before: Sequence[Triple]) -> tuple[Triple, ...]:
        """Return the centres of A, B and C, those that were sought changed, mm."""
        found = [list(center) for center in before]
        for sought, values in zip(self.sought, self.values, strict=True):
            if sought.name in CENTER_NAMES:
                axis, direction = divmod(CENTER_NAMES.index(sought.name), 3)
                found[axis][direction] = round(found[axis][direction] + float(values[0]), 7)
        return tuple((x, y, z) for x, y, z in found)
