"""Crosstalk compensations from acceleration tests: how a slave gives way while a master accelerates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import comb
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..kinds import Crosstalk, CrosstalkTest
from ..measurement.columns import LENGTHS, Column, read_columns
from ..measurement.positioning import TARGET_DIGITS, whole_runs
from ..model.quantity import shown
from ..plot.style import labelled
from .creation import (
    LEFT_OUT,
    MEASURED,
    PREDICTED,
    SPREAD_LABELS,
    CannotCreateError,
    Creation,
    Options,
    chosen_points,
    leave_one_run_out,
    listed,
    lost_by_rounding,
    rounded,
    spread_figures,
)
from .target_list import TargetList

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ACCELERATIONS = {"mm/s2": 1.0, "mm/s²": 1.0, "m/s2": 1e3, "m/s²": 1e3}
"""Units of acceleration, in mm/s²."""

COLUMNS = (
    Column("acceleration", ACCELERATIONS, "mm/s2"),
    Column("direction", direction=True),
    Column("deviation", LENGTHS, "um", aliases=("error",)),
    Column("position1", LENGTHS, "mm", optional=True),
    Column("position2", LENGTHS, "mm", optional=True),
    Column("run", optional=True, aliases=("cycle",)),
)

TESTS_MAX = 15
"""Tests a list holds (P-COMP-00083)."""

UNIT, LOST = "µm", lost_by_rounding("mm")
"""Of deviations, and how much of it rounding costs."""
CASES = ("accelerate_positive", "accelerate_negative", "decelerate_positive", "decelerate_negative")
_CHOICES_MAX = 20_000


@dataclass(frozen=True, eq=False)
class AccelerationTests:
    """Readings while the master accelerates or brakes, in any order.

    Attributes
    ----------
    places : array, shape (n, 2)
        Positions of the adaptation axes, mm; 0 where there is none.
    accelerations : array, shape (n,)
        Of the master, with sign, mm/s².
    directions : array of int, shape (n,)
        1 or −1: in which direction the master moves.
    deviations : array, shape (n,)
        Actual − commanded position of the slave, against standstill at the same place, µm.
    runs : array of int, shape (n,)
        1 everywhere if there is one run only.
    source : str
        The file.
    """

    places: Array
    accelerations: Array
    directions: npt.NDArray[np.int64]
    deviations: Array
    runs: npt.NDArray[np.int64]
    source: str = ""

    def only(self, chosen: npt.NDArray[np.bool_]) -> AccelerationTests:
        """Return some of the readings."""
        return replace(
            self,
            places=self.places[chosen],
            accelerations=self.accelerations[chosen],
            directions=self.directions[chosen],
            deviations=self.deviations[chosen],
            runs=self.runs[chosen],
        )


def read_acceleration_tests(path: str | Path) -> AccelerationTests:
    """Read a table with ``acceleration, direction, deviation`` and, if they vary, ``position1, position2, run``.

    Raises
    ------
    MeasurementError
        The file cannot be read, or a line of it.
    """
    columns = read_columns(Path(path), COLUMNS)
    places = [np.round(columns.positions(name), TARGET_DIGITS) for name in ("position1", "position2")]
    return AccelerationTests(
        np.column_stack(places),
        columns.values["acceleration"],
        columns.values["direction"].astype(np.int64),
        columns.values["deviation"],
        whole_runs(columns),
        columns.file,
    )


@dataclass(frozen=True, eq=False)
class _Model:
    """Corrections at a few places: for each the four cases, at the largest acceleration and deceleration, µm."""

    places: Array
    corrections: Array
    largest: tuple[float, float]

    def at(self, tests: AccelerationTests) -> Array:
        """Return the correction that the controller adds in each test."""
        cases, shares = _cases(tests, self.largest)
        table = np.stack([_interpolated(self.places, values, tests.places) for values in self.corrections.T])
        result: Array = table[cases, np.arange(len(cases))] * shares
        return result


def create_crosstalk(tests: AccelerationTests, target: TargetList, options: Options | None = None) -> Creation:
    """Make a crosstalk table: minus the deviation of the slave at the largest acceleration and deceleration measured.

    Deviations at smaller accelerations count in proportion, as the controller has it. Places that vary along one axis
    give mode 2, along two axes mode 3; more than fifteen of them are thinned.

    Raises
    ------
    CannotCreateError
        A test is missing, an axis number is not known, or the table does not fit.
    """
    options = options or Options()
    target.check_unit("mm")
    master = options.masters[0] or target.values.integer("kw.crosstalk.master_dyn_ax_nr")
    if not master:
        raise CannotCreateError("the list does not say which axis accelerates (kw.crosstalk.master_dyn_ax_nr)")
    varied = [bool(np.ptp(tests.places[:, i]) > 0.0) for i in range(2)]
    if varied[1] and not varied[0]:
        raise CannotCreateError("places that vary along one adaptation axis only belong in position1")
    mode = 1 + sum(varied)
    adaptation = [_adaptation(options, target, i) if varied[i] else None for i in range(2)]
    largest = float(tests.accelerations.max()), float(tests.accelerations.min())
    if not largest[0] > 0.0 > largest[1]:
        raise CannotCreateError("the tests have to hold accelerations (above 0) and decelerations (below 0)")
    both = set(tests.directions) == {1, -1}

    def make(some: AccelerationTests) -> _Model:
        thinned = _thinned(_fitted(some, largest, both), mode, options.bound)
        return replace(thinned, corrections=listed(thinned.corrections, "mm"))

    model = make(tests)
    figures = {
        MEASURED: spread_figures(tests.deviations),
        PREDICTED: spread_figures(tests.deviations + model.at(tests)),
    }
    notes = target.notes("crosstalk")
    held_out = leave_one_run_out(
        tests.runs,
        lambda some, others: tests.only(others).deviations + make(tests.only(some)).at(tests.only(others)),
    )
    if held_out is None:
        notes.append("With one run there is no check by leaving runs out.")
    else:
        figures[LEFT_OUT] = spread_figures(held_out)
    full = _fitted(tests, largest, both)
    shown = np.stack([_interpolated(model.places, v, full.places) for v in model.corrections.T], axis=1)
    compensation = Crosstalk(
        master=master,
        acceleration=largest[0],
        deceleration=largest[1],
        mode=mode,
        tests=tuple(_test(place, row, both) for place, row in zip(model.places, model.corrections, strict=True)),
        adaptation1=adaptation[0],
        adaptation2=adaptation[1],
        velocity_dependent=both,
    )
    return Creation(
        kind="crosstalk",
        compensation=compensation,
        path=target.path,
        data=target.with_compensation("crosstalk", compensation),
        points=len(model.places),
        capacity=TESTS_MAX,
        deviation=float(np.max(np.abs(shown - full.corrections))),
        unit=UNIT,
        figures=figures,
        labels=SPREAD_LABELS,
        notes=tuple(notes),
        draw=lambda ax: _draw(ax, tests, model),
    )


def _adaptation(options: Options, target: TargetList, i: int) -> int:
    name = f"kw.crosstalk.master_pos{i + 1}_ax_nr"
    number = options.adaptation[i] or target.values.integer(name)
    if not number:
        raise CannotCreateError(f"the list does not say which axis position{i + 1} is of ({name})")
    return number


def _test(place: Array, corrections: Array, both: bool) -> CrosstalkTest:
    used = [i for i in range(4) if both or i % 2 == 0]
    values = rounded(corrections / shown("mm").factor)
    return CrosstalkTest(*rounded(place).tolist(), **{CASES[i]: float(values[i]) for i in used})


def _cases(tests: AccelerationTests, largest: tuple[float, float]) -> tuple[npt.NDArray[np.int64], Array]:
    """Return for each test which of ``CASES`` it is, and which share of the correction acts in it."""
    braking = tests.accelerations < 0.0
    cases = 2 * braking.astype(np.int64) + (tests.directions < 0)
    shares = tests.accelerations / np.where(braking, largest[1], largest[0])
    return cases, np.minimum(shares, 1.0)


def _fitted(tests: AccelerationTests, largest: tuple[float, float], both: bool) -> _Model:
    """Return the corrections that leave least at every place measured."""
    places, place = np.unique(tests.places, axis=0, return_inverse=True)
    cases, shares = _cases(tests, largest)
    if not both:
        cases = cases - cases % 2
    weights, sums = np.zeros((2, len(places), 4))
    np.add.at(weights, (place.ravel(), cases), shares**2)
    np.add.at(sums, (place.ravel(), cases), -shares * tests.deviations)
    needed = [i for i in range(4) if both or i % 2 == 0]
    missing = np.argwhere(weights[:, needed] == 0.0)
    if len(missing):
        i, case = missing[0]
        what = CASES[needed[case]].replace("_", ", ")
        raise CannotCreateError(f"there is no test ({what} direction) at {places[i, 0]:g}, {places[i, 1]:g}")
    corrections = np.zeros((len(places), 4))
    corrections[:, needed] = sums[:, needed] / weights[:, needed]
    if not both:
        corrections[:, 1::2] = corrections[:, ::2]
    return _Model(places, corrections, largest)


def _thinned(model: _Model, mode: int, bound: float | None) -> _Model:
    """Return a model with as few places as keep the bound, or the closest one that a list takes."""
    count = len(model.places)
    if mode == 1 or (bound is None and count <= TESTS_MAX):
        return model
    if bound is not None and bound < LOST:
        raise CannotCreateError(f"values are rounded to {2 * LOST:g} {UNIT}, so {bound:g} {UNIT} cannot be kept")
    if mode == 2:
        places = chosen_points(model.places[:, 0], model.corrections.T, TESTS_MAX, bound, UNIT, LOST)
        return replace(model, places=model.places[places], corrections=model.corrections[places])
    axes = [np.unique(model.places[:, i]) for i in range(2)]
    if len(axes[0]) * len(axes[1]) != count:
        if bound is None:
            raise CannotCreateError(f"a list takes {TESTS_MAX} tests; {count} places that fill no grid are not thinned")
        return model
    best: tuple[tuple[float, float], _Model] | None = None
    for chosen in _choices(axes):
        candidate = _at_places(model, chosen)
        off = _off(candidate, model)
        if bound is not None and off > bound - LOST:
            continue
        # Within a bound fewest places first, without one least deviation first.
        rank = (float(len(candidate.places)), off) if bound is not None else (off, float(len(candidate.places)))
        if best is None or rank < best[0]:
            best = rank, candidate
    if best is None:
        raise CannotCreateError(f"{bound:g} {UNIT} take more than the {TESTS_MAX} tests that a list holds")
    return best[1]


def _choices(axes: list[Array]) -> Iterator[tuple[Array, ...]]:
    """Yield choices of positions along each axis, ends always among them, that a list takes as a grid."""
    for counts in product(*(range(2, len(axis) + 1) for axis in axes)):
        if np.prod(counts) > TESTS_MAX:
            continue
        number = np.prod([comb(len(axis) - 2, n - 2) for axis, n in zip(axes, counts, strict=True)])
        if number > _CHOICES_MAX:
            yield tuple(
                axis[np.linspace(0, len(axis) - 1, n).round().astype(int)] for axis, n in zip(axes, counts, strict=True)
            )
            continue
        for inner in product(*(combinations(axis[1:-1], n - 2) for axis, n in zip(axes, counts, strict=True))):
            yield tuple(np.array([axis[0], *some, axis[-1]]) for axis, some in zip(axes, inner, strict=True))


def _at_places(model: _Model, axes: tuple[Array, ...]) -> _Model:
    inside = np.all([np.isin(model.places[:, i], axis) for i, axis in enumerate(axes)], axis=0)
    return _Model(model.places[inside], model.corrections[inside], model.largest)


def _off(candidate: _Model, model: _Model) -> float:
    values = [_interpolated(candidate.places, v, model.places) for v in candidate.corrections.T]
    return float(np.max(np.abs(np.stack(values, axis=1) - model.corrections)))


def _interpolated(places: Array, values: Array, at: Array) -> Array:
    """Return values at places (n, 2): one place holds everywhere, a line is linear, a grid bilinear, ends held."""
    axis1, axis2 = np.unique(places[:, 0]), np.unique(places[:, 1])
    if len(places) == len(axis1) * len(axis2):
        grid = np.empty((len(axis1), len(axis2)))
        grid[np.searchsorted(axis1, places[:, 0]), np.searchsorted(axis2, places[:, 1])] = values
        along2 = np.stack([np.interp(at[:, 1], axis2, row) for row in grid])
        clamped = np.clip(at[:, 0], axis1[0], axis1[-1])
        left = np.clip(np.searchsorted(axis1, clamped, side="right") - 1, 0, max(len(axis1) - 2, 0))
        right = np.minimum(left + 1, len(axis1) - 1)
        width = axis1[right] - axis1[left]
        share = np.divide(clamped - axis1[left], width, out=np.zeros_like(clamped), where=width > 0.0)
        n = np.arange(len(at))
        result: Array = (1.0 - share) * along2[left, n] + share * along2[right, n]
        return result
    # Places that fill no grid are never thinned: every test stands at one of them.
    found = [int(np.flatnonzero(np.all(places == place, axis=1))[0]) for place in at]
    return values[found]


def _draw(ax: Axes, tests: AccelerationTests, model: _Model) -> None:
    """Draw what was measured and what is left over the acceleration."""
    left = tests.deviations + model.at(tests)
    ax.plot(tests.accelerations, tests.deviations, ".", color="#c4511a", ms=5, label="measured")
    ax.plot(tests.accelerations, left, ".", color="#0b62a4", ms=5, label="predicted")
    ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
    labelled(ax, "", "acceleration of the master [mm/s²]", f"deviation of the slave [{UNIT}]")
    ax.legend(loc="best", fontsize=10)
