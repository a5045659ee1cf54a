"""Plane compensations from measurements over the positions of two masters."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..kinds import Plane
from ..measurement import (
    ANGLES,
    LENGTHS,
    RUN,
    TARGET_DIGITS,
    Column,
    Columns,
    Outlier,
    Readings,
    angular,
    find_outliers,
    unit_of,
)
from ..model import Grid, Quantity, shown
from ..plot import labelled
from .creation import CannotCreateError
from .driver import ON_TOP, Fit, axis_numbers, rounded
from .hat_functions import hats

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ANY = LENGTHS | ANGLES

POINTS_EACH = 101
"""Points along one master where the list does not reserve entries (P-COMP-00061)."""


@dataclass(frozen=True, eq=False)
class Flatness(Readings):
    """Deviations of a slave over the positions of two masters, in any order.

    Attributes
    ----------
    positions1, positions2 : array, shape (n,)
        Of the masters, mm or °.
    deviations : array, shape (n,)
        Actual − commanded, µm or ″.
    unit : str
        Unit of the slave: ``mm`` or ``deg``.
    """

    positions1: Annotated[Array, Column("master1", _ANY, "mm")]
    positions2: Annotated[Array, Column("master2", _ANY, "mm")]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    deviations: Annotated[Array, Column("deviation", _ANY, "um", aliases=("error",))]
    unit: str = "mm"
    source: str = ""

    @classmethod
    def about(cls, columns: Columns) -> dict[str, Any]:
        """Return the unit."""
        return {**super().about(columns), "unit": unit_of(angular(columns, "deviation"))}

    def grid(self) -> tuple[Array, Array, Array]:
        """Return the masters' positions (m1,), (m2,) and mean deviations (m2, m1).

        Raises
        ------
        CannotCreateError
            The places do not fill a grid.
        """
        targets1, place1 = np.unique(np.round(self.positions1, TARGET_DIGITS), return_inverse=True)
        targets2, place2 = np.unique(np.round(self.positions2, TARGET_DIGITS), return_inverse=True)
        total, count = np.zeros((2, len(targets2), len(targets1)))
        np.add.at(total, (place2, place1), self.deviations)
        np.add.at(count, (place2, place1), 1.0)
        missing = np.argwhere(count == 0.0)
        if len(missing):
            j, i = missing[0]
            raise CannotCreateError(
                f"the measured places have to fill a grid, but {len(missing)} of {count.size} are missing, "
                f"the first at master1 = {targets1[i]:g}, master2 = {targets2[j]:g}"
            )
        if min(count.shape) < 2:
            raise CannotCreateError("a plane takes at least two positions of each master")
        return targets1, targets2, total / count


class PlaneFit(Fit[Flatness, Grid]):
    """Minus the deviation of the slave over the positions of the masters.

    The grid has equal distances along each master. Where the places of the measurement are such a grid and the list
    takes it, it is taken as it stands; else the values at the grid's points are fitted by least squares.
    """

    name = "plane"
    counted = "corrections"
    meaning = "plane table from the deviation of a slave over two masters"
    columns = "columns master1, master2, deviation (mm, µm), and run where there are several"
    example = "axcomp create plane --from table.csv --into achskw3.lis --masters 1 2 --bound 1"
    arguments: ClassVar = {**Fit.arguments, "on-top": ON_TOP, "masters": axis_numbers("numbers of the masters", 2)}
    one_run = few_runs = "There are not two complete runs, so"
    read = Flatness.read

    def counts_in(self) -> str:
        """Return what the slave counts in."""
        return self.readings.unit

    def prepare(self) -> None:
        """Look which axes are the masters, and how many points there may be along each."""
        lacking = "axes are the masters (kw.crosscomp2.master1_ax_nr, …)"
        self.masters = [
            self.axis_number(self.options.masters, i, f"kw.crosscomp2.master{i + 1}_ax_nr", lacking) for i in range(2)
        ]
        super().prepare()
        reserved = self.options.max_points or self.target.values.integer("kw.crosscomp2.max_points")
        given = self.options.max_points or self.target.values.given("kw.crosscomp2.max_points")
        self.each = self.capacity if given and reserved else POINTS_EACH

    def table_of(self, compensation: Plane) -> Grid:
        """Return the errors that a table of the list takes off: its corrections with the other sign."""
        values = -shown(self.unit).factor * np.array(compensation.corrections)
        x, y = (np.arange(float(count)) for count in values.shape[::-1])
        starts, intervals = (compensation.start1, compensation.start2), (compensation.interval1, compensation.interval2)
        return self._grid(starts[0] + intervals[0] * x, starts[1] + intervals[1] * y, values)

    def _grid(self, x: Array, y: Array, values: Array) -> Grid:
        """Return deviations (n2, n1) in µm or ″ over the positions of the masters."""
        over = (Quantity("position of master 1", "mm or °"), Quantity("position of master 2", "mm or °"))
        rows = tuple(tuple(row) for row in values.tolist())
        return Grid(tuple(x.tolist()), tuple(y.tolist()), rows, over, Quantity("deviation", self.small))

    def means(self, readings: Flatness) -> Flatness:
        """Return the mean deviation at each place of the grid."""
        targets1, targets2, values = readings.grid()
        positions1, positions2 = (a.ravel() for a in np.meshgrid(targets1, targets2))
        return replace(
            readings,
            positions1=positions1,
            positions2=positions2,
            runs=np.ones(values.size, dtype=np.int64),
            deviations=values.ravel(),
        )

    def removed(self, table: Grid, readings: Flatness) -> Array:
        """Return the errors of the table at the places of the readings."""
        places = zip(readings.positions1.tolist(), readings.positions2.tolist(), strict=True)
        return np.array([table.at(x, y) for x, y in places])

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that stand apart from those of the same place."""
        found = self.readings
        at = np.round(np.column_stack([found.positions1, found.positions2]), TARGET_DIGITS)
        place = np.unique(at, axis=0, return_inverse=True)[1].ravel()
        return find_outliers(
            place, found.runs, found.deviations, lambda i: f"masters at {at[i, 0]:g}, {at[i, 1]:g}", self.small
        )

    def table(self, means: Flatness) -> Grid:
        """Return the table that a list takes: with the fewest points within a bound, or the closest one."""
        targets1, targets2, values = means.grid()
        if self.old is not None:
            values = values + self.removed(self.old, means).reshape(values.shape)
        fits = [_Fits(targets, self.each) for targets in (targets1, targets2)]

        def off(n1: int, n2: int) -> float:
            return float(np.max(np.abs(fits[1](n2)[1] @ values @ fits[0](n1)[1].T - values)))

        size = (len(targets1), len(targets2))
        n1, n2 = self._size(fits[0].counts, fits[1].counts, size, off)
        fitted = fits[1](n2)[0] @ values @ fits[0](n1)[0].T
        return self._grid(fits[0].points(n1), fits[1].points(n2), self.listed(fitted))

    def _size(
        self, counts1: list[int], counts2: list[int], measured: tuple[int, int], off: Callable[[int, int], float]
    ) -> tuple[int, int]:
        """Return how many points the table gets along each master, of those counts that can be fitted."""
        bound = self.options.bound
        if bound is None:
            possible = [n1 for n1 in counts1 if n1 * counts2[0] <= self.capacity]
            pairs = [(n1, max(n2 for n2 in counts2 if n1 * n2 <= self.capacity)) for n1 in possible]
            if not pairs:
                raise CannotCreateError(f"the list takes {self.capacity} points, too few for a plane")
            if pairs[-1] == measured and off(*pairs[-1]) < self.lost:
                return pairs[-1]
            return min(pairs, key=lambda pair: off(*pair))
        within: float = bound - self.lost

        def fits_within(n1: int, n2: int) -> bool:
            return off(n1, n2) <= within

        least = {n1: _least(counts2, partial(fits_within, n1)) for n1 in counts1}
        pairs = [(n1, n2) for n1, n2 in least.items() if n2 is not None]
        fewest = min(pairs, key=lambda pair: pair[0] * pair[1], default=None)
        if fewest is None or fewest[0] * fewest[1] > self.capacity:
            need = "more points than were measured" if fewest is None else f"{fewest[0]} × {fewest[1]} points"
            sentence = f"{bound:g} {self.small} take {need}, but the list has room for {self.capacity}"
            raise CannotCreateError(sentence)
        return fewest

    def compensation(self, table: Grid) -> Plane:
        """Return the corrections in mm or °."""
        corrections = rounded(-np.array(table.values) / shown(self.unit).factor)
        return Plane(
            self.masters[0],
            self.masters[1],
            start1=table.x[0],
            start2=table.y[0],
            interval1=float(rounded(np.diff(table.x[:2]))[0]),
            interval2=float(rounded(np.diff(table.y[:2]))[0]),
            corrections=tuple(tuple(row) for row in corrections.tolist()),
        )

    def draw(self, ax: Axes, table: Grid) -> None:
        """Draw what is left of the means as a map."""
        targets1, targets2, means = self.readings.grid()
        left = self.left(table, self.means(self.readings)).reshape(means.shape)
        mesh = ax.pcolormesh(targets1, targets2, left, cmap="RdBu_r", shading="nearest")
        limit = float(np.max(np.abs(left)))
        mesh.set_clim(-limit, limit)
        figure = ax.get_figure()
        if figure is not None:
            figure.colorbar(mesh, ax=ax, label=f"predicted deviation [{self.small}]")
        if np.ptp(means) > 0.0:
            ax.clabel(ax.contour(targets1, targets2, means, colors="0.3", linewidths=0.7), fontsize=8)
        title = f"What is left; lines: measured deviation [{self.small}]"
        labelled(ax, title, "position of master 1 [mm or °]", "position of master 2 [mm or °]").grid(visible=False)


FIT = PlaneFit


def _least(counts: Sequence[int], fits: Callable[[int], bool]) -> int | None:
    """Return the least count that fits: where one fits, larger ones are taken to fit as well."""
    if not counts or not fits(counts[-1]):
        return None
    return counts[bisect_left(counts, True, hi=len(counts) - 1, key=fits)]


class _Fits:
    """Least squares along one master: from values at the measured positions to values at equal distances."""

    def __init__(self, targets: Array, each: int) -> None:
        self._targets = targets
        self._matrices: dict[int, tuple[Array, Array]] = {}
        self.counts = [n for n in range(2, min(len(targets), each) + 1) if self._is_determined(n)]

    def points(self, count: int) -> Array:
        """Return so many points over the measured range, from the first target on, shape (count,)."""
        interval = rounded(np.array([np.ptp(self._targets) / (count - 1)]))
        return rounded(self._targets[:1]) + interval * np.arange(float(count))

    def _is_determined(self, count: int) -> bool:
        points = self.points(count)
        return points[1] > points[0] and int(np.linalg.matrix_rank(hats(points, self._targets))) == count

    def __call__(self, count: int) -> tuple[Array, Array]:
        """Return the matrices from measured values to those at the points, and to the table's at the same places."""
        if count not in self._matrices:
            weights = hats(self.points(count), self._targets)
            solve = np.asarray(np.linalg.pinv(weights), dtype=np.float64)
            self._matrices[count] = solve, weights @ solve
        return self._matrices[count]
