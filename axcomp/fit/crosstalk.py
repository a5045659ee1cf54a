"""Crosstalk compensations from acceleration tests: how a slave gives way while a master accelerates."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import comb
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..kinds import Crosstalk, CrosstalkTest
from ..measurement import LENGTHS, RUN, TARGET_DIGITS, AxisTrace, Column, Outlier, Readings, find_outliers
from ..model import shown
from ..plot import labelled
from .creation import CannotCreateError
from .driver import NEW_LIST, TRACE, Fit, axis_numbers, bound, rounded
from .hat_functions import hats
from .trace_readings import accelerations_of, same_places

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ACCELERATIONS = {"mm/s2": 1.0, "mm/s²": 1.0, "m/s2": 1e3, "m/s²": 1e3}
"""Units of acceleration, in mm/s²."""

_PLACES = tuple(Column(f"position{i}", LENGTHS, "mm", optional=True) for i in (1, 2))
TESTS_MAX = 14
"""Tests that are written at most: P-COMP-00083 is below 15 (semantics §8)."""

UNIT = "µm"
"""Of deviations."""
CASES = ("accelerate_positive", "accelerate_negative", "decelerate_positive", "decelerate_negative")
_CHOICES_MAX = 20_000


@dataclass(frozen=True, eq=False)
class AccelerationTests(Readings):
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
    """

    places: Annotated[Array, *_PLACES]
    accelerations: Annotated[Array, Column("acceleration", ACCELERATIONS, "mm/s2")]
    directions: Annotated[npt.NDArray[np.int64], Column("direction", direction=True)]
    deviations: Annotated[Array, Column("deviation", LENGTHS, "um", aliases=("error",))]
    runs: Annotated[npt.NDArray[np.int64], RUN]
    source: str = ""


class _Table(NamedTuple):
    """Corrections (n, cases) at places (n, 2), at the largest acceleration and deceleration, µm."""

    places: Array
    corrections: Array

    def at(self, at: Array) -> Array:
        """Return corrections at places (k, 2): one holds everywhere, a line is linear, a grid bilinear, ends held."""
        axes = [np.unique(self.places[:, i]) for i in range(2)]
        if len(self.places) == len(axes[0]) * len(axes[1]):
            grid = self.corrections.reshape(len(axes[0]), len(axes[1]), -1)
            return np.asarray(np.einsum("ni,ijc,nj->nc", hats(axes[0], at[:, 0]), grid, hats(axes[1], at[:, 1])))
        # Places that fill no grid are never thinned: every test stands at one of them.
        return self.corrections[[int(np.flatnonzero(np.all(self.places == place, axis=1))[0]) for place in at]]

    def only(self, chosen: Any) -> _Table:
        """Return some of the places."""
        return _Table(self.places[chosen], self.corrections[chosen])


class CrosstalkFit(Fit[AccelerationTests, _Table]):
    """Minus the deviation of the slave at the largest acceleration and deceleration measured.

    Deviations at smaller accelerations count in proportion, as the controller has it. Places that vary along one axis
    give mode 2, along two axes mode 3; more than fifteen of them are thinned.
    """

    name = "crosstalk"
    counted = "tests"
    meaning = "crosstalk table from acceleration tests, or from a trace"
    columns = (
        "columns acceleration (mm/s²), direction, deviation (of the slave; µm), and where they vary position1, "
        "position2 (mm), run; a trace has time (s), master_setpoint, master_position, master_velocity or "
        "master_acceleration, and of the slave deviation, or actual and setpoint, named so or by --map"
    )
    example = "axcomp create crosstalk --from tests.csv --into achskw2.lis --master 1 --adaptation 1 3"
    arguments: ClassVar = {
        "bound": bound("µm"),
        **NEW_LIST,
        "master": axis_numbers("number of the master", 1),
        "adaptation": axis_numbers("numbers of the axes of position1 and position2", "+", "adaptation"),
        **TRACE,
    }
    read = AccelerationTests.read

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that stand apart from those of the same test."""
        found = self.readings
        tests = np.column_stack([found.places, found.accelerations, found.directions])
        test = np.unique(tests, axis=0, return_inverse=True)[1].ravel()

        def named(i: int) -> str:
            return f"place {found.places[i, 0]:g}, {found.places[i, 1]:g} mm at {found.accelerations[i]:g} mm/s²"

        return find_outliers(test, found.runs, found.deviations, named)

    @classmethod
    def of_trace(cls, trace: AxisTrace) -> AccelerationTests:
        """Return a test for each stretch of constant acceleration."""
        accelerations, directions, deviations, *places = (
            np.array(c) for c in zip(*accelerations_of(trace), strict=True)
        )
        where = np.column_stack([same_places(place) for place in places])
        ones = np.ones(len(directions), dtype=np.int64)
        return AccelerationTests(where, accelerations, directions, deviations, ones, trace.source)

    def prepare(self) -> None:
        """Look which axes take part, and which cases were measured."""
        super().prepare()
        self.capacity = TESTS_MAX
        name = "kw.crosstalk.master_dyn_ax_nr"
        self.master = self.axis_number(self.options.masters, 0, name, f"axis accelerates ({name})")
        self.readings = replace(self.readings, places=np.round(self.readings.places, TARGET_DIGITS))
        varied = np.ptp(self.readings.places, axis=0) > 0.0
        if varied[1] and not varied[0]:
            raise CannotCreateError("places that vary along one adaptation axis only belong in position1")
        self.mode = 1 + int(varied.sum())
        self.adaptation = [self._adaptation(i) if varied[i] else None for i in range(2)]
        self.largest = float(self.readings.accelerations.max()), float(self.readings.accelerations.min())
        if not self.largest[0] > 0.0 > self.largest[1]:
            raise CannotCreateError("the tests have to hold accelerations (above 0) and decelerations (below 0)")
        self.cases = CASES if set(self.readings.directions) == {1, -1} else CASES[::2]

    def _adaptation(self, i: int) -> int:
        name = f"kw.crosstalk.master_pos{i + 1}_ax_nr"
        return self.axis_number(self.options.adaptation, i, name, f"axis position{i + 1} is of ({name})")

    def _cases(self, tests: AccelerationTests) -> tuple[npt.NDArray[np.int64], Array]:
        """Return for each test which of ``cases`` it is, and which share of the correction acts in it."""
        braking = tests.accelerations < 0.0
        cases = 2 * braking + (tests.directions < 0) if len(self.cases) == len(CASES) else 1 * braking
        shares = tests.accelerations / np.where(braking, self.largest[1], self.largest[0])
        return cases, np.minimum(shares, 1.0)

    def means(self, readings: AccelerationTests) -> AccelerationTests:
        """Return what is left least of in each case at each place, at the largest acceleration."""
        places, place = np.unique(readings.places, axis=0, return_inverse=True)
        cases, shares = self._cases(readings)
        weights, sums = np.zeros((2, len(places), len(self.cases)))
        np.add.at(weights, (place.ravel(), cases), shares**2)
        np.add.at(sums, (place.ravel(), cases), shares * readings.deviations)
        for i, case in np.argwhere(weights == 0.0):
            what = self.cases[case].replace("_", ", ")
            raise CannotCreateError(f"there is no test ({what} direction) at {places[i, 0]:g}, {places[i, 1]:g}")
        return AccelerationTests(
            np.repeat(places, len(self.cases), axis=0),
            np.tile([self.largest["decelerate" in case] for case in self.cases], len(places)),
            np.tile([1 - 2 * ("negative" in case) for case in self.cases], len(places)),
            (sums / weights).ravel(),
            np.ones(weights.size, dtype=np.int64),
        )

    def table(self, means: AccelerationTests) -> _Table:
        """Return corrections at as few places as keep the bound, or the closest ones that a list takes."""
        cases = len(self.cases)
        thinned = self._thinned(_Table(means.places[::cases], -means.deviations.reshape(-1, cases)))
        return _Table(thinned.places, self.listed(thinned.corrections))

    def _thinned(self, full: _Table) -> _Table:
        bound, count = self.options.bound, len(full.places)
        if self.mode == 1 or (bound is None and count <= TESTS_MAX):
            return full
        if self.mode == 2:
            return full.only(self.chosen(full.places[:, 0], full.corrections.T))
        axes = [np.unique(full.places[:, i]) for i in range(2)]
        if len(axes[0]) * len(axes[1]) != count:
            if bound is None:
                sentence = f"a list takes {TESTS_MAX} tests; {count} places that fill no grid are not thinned"
                raise CannotCreateError(sentence)
            return full
        best: tuple[tuple[float, float], _Table] | None = None
        for chosen in _choices(axes):
            inside = np.all([np.isin(full.places[:, i], axis) for i, axis in enumerate(chosen)], axis=0)
            candidate = full.only(inside)
            off = float(np.max(np.abs(candidate.at(full.places) - full.corrections)))
            if bound is not None and off > bound - self.lost:
                continue
            # Within a bound fewest places first, without one least deviation first.
            rank = (float(inside.sum()), off) if bound is not None else (off, float(inside.sum()))
            if best is None or rank < best[0]:
                best = rank, candidate
        if best is None:
            raise CannotCreateError(f"{bound:g} {UNIT} take more than the {TESTS_MAX} tests that a list holds")
        return best[1]

    def removed(self, table: _Table, readings: AccelerationTests) -> Array:
        """Return the correction with the other sign."""
        cases, shares = self._cases(readings)
        return np.asarray(-table.at(readings.places)[np.arange(len(cases)), cases] * shares)

    def compensation(self, table: _Table) -> Crosstalk:
        """Return the corrections in mm."""
        places, values = rounded(table.places).tolist(), rounded(table.corrections / shown("mm").factor).tolist()
        rows = (dict(zip(self.cases, row, strict=True)) for row in values)
        return Crosstalk(
            master=self.master,
            acceleration=self.largest[0],
            deceleration=self.largest[1],
            mode=self.mode,
            tests=tuple(CrosstalkTest(*place, **row) for place, row in zip(places, rows, strict=True)),
            adaptation1=self.adaptation[0],
            adaptation2=self.adaptation[1],
            velocity_dependent=self.cases == CASES,
        )

    def draw(self, ax: Axes, table: _Table) -> None:
        """Draw what was measured and what is left over the acceleration."""
        tests, left = self.readings, self.left(table, self.readings)
        ax.plot(tests.accelerations, tests.deviations, ".", color="#c4511a", ms=5, label="measured")
        ax.plot(tests.accelerations, left, ".", color="#0b62a4", ms=5, label="predicted")
        ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
        labelled(ax, "", "acceleration of the master [mm/s²]", f"deviation of the slave [{UNIT}]")
        ax.legend(loc="best", fontsize=10)


FIT = CrosstalkFit


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
