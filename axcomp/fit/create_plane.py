"""Plane compensations from measurements over the positions of two masters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..kinds import Plane
from ..measurement.columns import ANGLES, LENGTHS, Column, read_columns
from ..measurement.positioning import TARGET_DIGITS, angular, unit_of, whole_runs
from ..model.grid import Grid
from ..model.quantity import Quantity, shown
from ..plot.style import labelled
from .creation import (
    LEFT_OUT,
    MEASURED,
    PREDICTED,
    SPREAD_LABELS,
    CannotCreateError,
    Creation,
    Options,
    leave_one_run_out,
    listed,
    lost_by_rounding,
    put_on_top,
    rounded,
    spread_figures,
)
from .hats import hats
from .target_list import TargetList

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLUMNS = (
    Column("master1", LENGTHS | ANGLES, "mm"),
    Column("master2", LENGTHS | ANGLES, "mm"),
    Column("deviation", LENGTHS | ANGLES, "um", aliases=("error",)),
    Column("run", optional=True, aliases=("cycle",)),
)

POINTS_EACH = 101
"""Points along one master where the list does not reserve entries (P-COMP-00061)."""


@dataclass(frozen=True, eq=False)
class Flatness:
    """Deviations of a slave over the positions of two masters, in any order.

    Attributes
    ----------
    positions1, positions2 : array, shape (n,)
        Of the masters, mm or °.
    runs : array of int, shape (n,)
        1 everywhere if there is one run only.
    deviations : array, shape (n,)
        Actual − commanded, µm or ″.
    unit : str
        Unit of the slave: ``mm`` or ``deg``.
    source : str
        The file.
    """

    positions1: Array
    positions2: Array
    runs: npt.NDArray[np.int64]
    deviations: Array
    unit: str = "mm"
    source: str = ""

    def only(self, chosen: npt.NDArray[np.bool_]) -> Flatness:
        """Return the measurement with some of its readings."""
        return replace(
            self,
            positions1=self.positions1[chosen],
            positions2=self.positions2[chosen],
            runs=self.runs[chosen],
            deviations=self.deviations[chosen],
        )

    def means(self) -> tuple[Array, Array, Array]:
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


def read_flatness(path: str | Path) -> Flatness:
    """Read a table with ``master1, master2, deviation`` and, if there are several, ``run``.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it.
    """
    columns = read_columns(Path(path), COLUMNS)
    return Flatness(
        columns.positions("master1"),
        columns.positions("master2"),
        whole_runs(columns),
        columns.values["deviation"],
        unit_of(angular(columns, "deviation")),
        columns.file,
    )


def _grid(x: Array, y: Array, values: Array, unit: str) -> Grid:
    """Return deviations (n2, n1) in µm or ″ over the positions of the masters."""
    over = (Quantity("position of master 1", "mm or °"), Quantity("position of master 2", "mm or °"))
    rows = tuple(tuple(row) for row in values.tolist())
    return Grid(tuple(x.tolist()), tuple(y.tolist()), rows, over, Quantity("deviation", shown(unit).unit))


def _errors(plane: Plane, unit: str) -> Grid:
    """Return the errors that a table of the list removes: its corrections with the other sign."""
    values = -shown(unit).factor * np.array(plane.corrections)
    x, y = (np.arange(float(count)) for count in values.shape[::-1])
    return _grid(plane.start1 + plane.interval1 * x, plane.start2 + plane.interval2 * y, values, unit)


def _at(grid: Grid, positions1: Array, positions2: Array) -> Array:
    return np.array([grid.at(x, y) for x, y in zip(positions1.tolist(), positions2.tolist(), strict=True)])


def create_plane(measurement: Flatness, target: TargetList, options: Options | None = None) -> Creation:
    """Make a plane table: minus the deviation of the slave over the positions of the masters.

    The grid has equal distances along each master. Where the places of the measurement are such a grid and the list
    takes it, it is taken as it stands; else the values at the grid's points are fitted by least squares.

    Raises
    ------
    CannotCreateError
        The measurement is no grid, the masters are not known, or the table does not fit.
    """
    options = options or Options()
    target.check_unit(measurement.unit)
    masters = [options.masters[i] or target.values.integer(f"kw.crosscomp2.master{i + 1}_ax_nr") for i in range(2)]
    if not all(masters):
        raise CannotCreateError("the list does not say which axes are the masters (kw.crosscomp2.master1_ax_nr, …)")
    before = put_on_top(target, "plane", options)
    factor, unit = shown(measurement.unit)
    old = None if before is None else _errors(before, measurement.unit)
    reserved = options.max_points or target.values.integer("kw.crosscomp2.max_points")
    given = bool(options.max_points) or target.values.given("kw.crosscomp2.max_points")
    capacity = reserved or target.capacity("kw.crosscomp2.max_points")
    each = capacity if given and reserved else POINTS_EACH

    def make(readings: Flatness) -> Grid:
        targets1, targets2, means = readings.means()
        if old is not None:
            all1, all2 = (a.ravel() for a in np.meshgrid(targets1, targets2))
            means = means + _at(old, all1, all2).reshape(means.shape)
        return _fitted(targets1, targets2, means, capacity, each, options.bound, measurement.unit)

    def left(table: Grid, readings: Flatness) -> Array:
        removed = _at(table, readings.positions1, readings.positions2)
        if old is not None:
            removed = removed - _at(old, readings.positions1, readings.positions2)
        return readings.deviations - removed

    table = make(measurement)
    figures = {MEASURED: spread_figures(measurement.deviations), PREDICTED: spread_figures(left(table, measurement))}
    notes = target.notes("plane")
    try:
        held_out = leave_one_run_out(
            measurement.runs, lambda some, others: left(make(measurement.only(some)), measurement.only(others))
        )
    except CannotCreateError:
        held_out = None
    if held_out is None:
        notes.append("There are not two complete runs, so there is no check by leaving runs out.")
    else:
        figures[LEFT_OUT] = spread_figures(held_out)
    targets1, targets2, means = measurement.means()
    all1, all2 = (a.ravel() for a in np.meshgrid(targets1, targets2))
    mean_left = left(table, replace(measurement, positions1=all1, positions2=all2, deviations=means.ravel()))
    compensation = Plane(
        masters[0],
        masters[1],
        start1=table.x[0],
        start2=table.y[0],
        interval1=float(rounded(np.diff(table.x[:2]))[0]),
        interval2=float(rounded(np.diff(table.y[:2]))[0]),
        corrections=tuple(tuple(row) for row in rounded(-np.array(table.values) / factor).tolist()),
    )
    return Creation(
        kind="plane",
        compensation=compensation,
        path=target.path,
        data=target.with_compensation("plane", compensation, options.max_points),
        points=len(table.x) * len(table.y),
        capacity=capacity,
        deviation=float(np.max(np.abs(mean_left))),
        unit=unit,
        figures=figures,
        labels=SPREAD_LABELS,
        notes=tuple(notes),
        draw=lambda ax: _draw(ax, measurement, mean_left.reshape(means.shape)),
    )


def _fitted(
    targets1: Array, targets2: Array, means: Array, capacity: int, each: int, bound: float | None, unit: str
) -> Grid:
    """Return the table that a list takes: with the fewest points within a bound, or the closest one."""
    fits = [_Fits(targets, each) for targets in (targets1, targets2)]

    def table(n1: int, n2: int) -> Grid:
        values = fits[1].solve(n2) @ means @ fits[0].solve(n1).T
        return _grid(fits[0].points(n1), fits[1].points(n2), listed(values, unit), unit)

    def off(n1: int, n2: int) -> float:
        return float(np.max(np.abs(fits[1].smooth(n2) @ means @ fits[0].smooth(n1).T - means)))

    counts1, counts2, lost = fits[0].counts, fits[1].counts, lost_by_rounding(unit)
    if bound is None:
        pairs = [
            (n1, max(n2 for n2 in counts2 if n1 * n2 <= capacity)) for n1 in counts1 if n1 * counts2[0] <= capacity
        ]
        if not pairs:
            raise CannotCreateError(f"the list takes {capacity} points, too few for a plane")
        if pairs[-1] == (len(targets1), len(targets2)) and off(*pairs[-1]) < lost:
            return table(*pairs[-1])
        return table(*min(pairs, key=lambda pair: off(*pair)))
    small = shown(unit).unit
    if bound < lost:
        raise CannotCreateError(f"values are rounded to {2 * lost:g} {small}, so {bound:g} {small} cannot be kept")
    within: float = bound - lost

    def fits_within(n1: int, n2: int) -> bool:
        return off(n1, n2) <= within

    least = {n1: _least(counts2, partial(fits_within, n1)) for n1 in counts1}
    pairs = [(n1, n2) for n1, n2 in least.items() if n2 is not None]
    fewest = min(pairs, key=lambda pair: pair[0] * pair[1], default=None)
    if fewest is None or fewest[0] * fewest[1] > capacity:
        need = "more points than were measured" if fewest is None else f"{fewest[0]} × {fewest[1]} points"
        raise CannotCreateError(f"{bound:g} {small} take {need}, but the list has room for {capacity}")
    return table(*fewest)


def _least(counts: Sequence[int], fits: Callable[[int], bool]) -> int | None:
    """Return the least count that fits, by halving: where one fits, larger ones are taken to fit as well."""
    low, high = 0, len(counts) - 1
    if high < 0 or not fits(counts[high]):
        return None
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if fits(counts[middle]) else (middle + 1, high)
    return counts[low]


class _Fits:
    """Least squares along one master: from values at the measured positions to values at equal distances."""

    def __init__(self, targets: Array, each: int) -> None:
        self._targets = targets
        self.start = float(rounded(targets[:1])[0])
        self._matrices: dict[int, tuple[Array, Array]] = {}
        self.counts = [n for n in range(2, min(len(targets), each) + 1) if self._is_determined(n)]

    def interval(self, count: int) -> float:
        """Return the distance of so many points over the measured range."""
        return float(rounded(np.array([np.ptp(self._targets) / (count - 1)]))[0])

    def points(self, count: int) -> Array:
        """Return so many points from the first target on, shape (count,)."""
        return self.start + self.interval(count) * np.arange(float(count))

    def _hats(self, count: int) -> Array:
        return hats(self.points(count), self._targets)

    def _is_determined(self, count: int) -> bool:
        return self.interval(count) > 0.0 and int(np.linalg.matrix_rank(self._hats(count))) == count

    def solve(self, count: int) -> Array:
        """Return the matrix from measured values to those at the points, (count, m)."""
        return self._both(count)[0]

    def smooth(self, count: int) -> Array:
        """Return the matrix from measured values to those of the table at the same places, (m, m)."""
        return self._both(count)[1]

    def _both(self, count: int) -> tuple[Array, Array]:
        if count not in self._matrices:
            weights = self._hats(count)
            solve = np.asarray(np.linalg.pinv(weights), dtype=np.float64)
            self._matrices[count] = solve, weights @ solve
        return self._matrices[count]


def _draw(ax: Axes, measurement: Flatness, left: Array) -> None:
    """Draw what is left of the means as a map."""
    targets1, targets2, means = measurement.means()
    unit = shown(measurement.unit).unit
    mesh = ax.pcolormesh(targets1, targets2, left, cmap="RdBu_r", shading="nearest")
    limit = float(np.max(np.abs(left)))
    mesh.set_clim(-limit, limit)
    figure = ax.get_figure()
    if figure is not None:
        figure.colorbar(mesh, ax=ax, label=f"predicted deviation [{unit}]")
    if np.ptp(means) > 0.0:
        ax.clabel(ax.contour(targets1, targets2, means, colors="0.3", linewidths=0.7), fontsize=8)
    title = f"What is left; lines: measured deviation [{unit}]"
    labelled(ax, title, "position of master 1 [mm or °]", "position of master 2 [mm or °]").grid(visible=False)
