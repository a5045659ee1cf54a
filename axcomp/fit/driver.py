"""One way from readings to a list, whatever the kind: each says only what is special about it (see ``Fit``)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Self, TypeVar

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..kinds import KINDS
from ..measurement import AxisTrace, Outlier, Readings, is_trace, joined, read_axis_trace
from ..model import shown
from .creation import LEFT_OUT, MEASURED, PREDICTED, CannotCreateError, Creation, Report
from .target_list import TargetList
from .thinning import Places, closest, deviation, fewest

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REPORT, DROP, KEEP = "report", "drop", "keep"
"""What becomes of outliers: they stop it, are left out, or count like the others."""
RESOLUTION = 1e-4
"""What positions and corrections in a list count in, mm or °."""

R = TypeVar("R", bound=Readings)
T = TypeVar("T")
Option = Mapping[str, Any]
"""Of the command, as argparse takes it."""


def bound(unit: str, more: str = " (rotary axes: ″)") -> Option:
    """Return the option to thin a table within a bound."""
    return {"type": float, "metavar": unit, "help": f"thin, but stay within this of the measured means{more}"}


MAX_POINTS: Option = {"type": int, "metavar": "N", "help": "let the list reserve so many entries"}
ON_TOP: Option = {"action": "store_true", "help": "the compensation acted during the measurement: add to its table"}
NEW_LIST: dict[str, Option] = {
    "axis": {"type": int, "metavar": "N", "help": "logical axis number of a new list"},
    "name": {"default": "", "help": "name of the axis in a new list"},
}


TRACE: dict[str, Option] = {
    "map": {
        "action": "append",
        "default": [],
        "metavar": "COLUMNS",
        "help": "what the columns of a trace are: velocity=v_ist[mm/s],current=I,time=t[ms]",
    },
    "cycle-time": {"type": float, "metavar": "s", "help": "distance of the rows of a trace without time"},
}


def axis_numbers(what: str, count: int | str, field: str = "masters") -> Option:
    """Return the option to give logical numbers of axes."""
    help_text = f"logical {what} (default: as the list says)"
    return {"type": int, "nargs": count, "metavar": "N", "default": (), "dest": field, "help": help_text}


@dataclass(frozen=True)
class Options:
    """How a table is made; each kind looks at what concerns it.

    Attributes
    ----------
    bound : float or None
        How far it may be from the measured means, in the unit of the deviations; None: as close as its size allows.
    max_points : int or None
        Entries the list is to reserve; None: those it reserves already, else the controller's default.
    on_top : bool
        The compensation acted during the measurement: what was measured is what it left.
    one_sided : bool
        One curve for both directions, the mean (leadscrew).
    masters, adaptation : sequence of int
        Logical numbers of the masters (cross, plane; crosstalk: the accelerating axis) and of the adaptation axes
        (crosstalk); 0 or none: as the list says.
    outliers : str
        ``report``: readings that stand apart stop it; ``drop``: they are left out; ``keep``: they count.
    errors, nodes, scatter : sequence of str, int, float or None
        The errors that are sought, values of one at most, standard deviation of a reading in µm (volumetric); None: all
        of the chain, as many as usual, as the residuals say.
    bin : float or None
        Velocities within so many percent count as one (friction).
    reversal : bool
        The list is to say what the reversals of a trace propose (friction).
    """

    bound: float | None = None
    max_points: int | None = None
    on_top: bool = False
    one_sided: bool = False
    masters: Sequence[int] = ()
    adaptation: Sequence[int] = ()
    outliers: str = REPORT
    errors: Sequence[str] | None = None
    nodes: int | None = None
    scatter: float | None = None
    bin: float | None = None
    reversal: bool = False


class Fit(ABC, Generic[R, T]):
    """How readings become a table of a list; every module here that is named like a kind has one, ``FIT``.

    Made for readings, a list and options; ``create`` goes the way, the other methods are its steps.

    Parameters
    ----------
    readings : R
        One class of ``Readings`` a kind.
    target : TargetList
        What ``open`` returns.
    options : Options

    Attributes
    ----------
    name, meaning, columns, example : str
        The kind, what is made, what a measurement has, and how the command is called.
    counted : str
        Field of the compensation with one element an entry.
    into : str
        What the command's ``--into`` names.
    arguments : mapping of str to Option
        Besides those that every kind has, by name.
    labels : mapping of str to str
        Name of each figure → how it is shown.
    one_run, few_runs : str
        How the sentence begins that there is no check by leaving runs out.
    unit, small : str
        What the deviating axis counts in, ``mm`` or ``deg``, and the unit of figures, bounds and deviations.
    lost : float
        How far rounding changes a value, in ``small``.
    capacity : int
        Entries the controller takes.
    old : T or None
        What acted during the measurement, where one is said to have.

    Raises
    ------
    CannotCreateError
        The readings do not suffice, the list does not say enough, or the table does not fit.
    MeasurementError
        The list is for another axis.
    """

    name: ClassVar[str]
    meaning: ClassVar[str]
    columns: ClassVar[str]
    example: ClassVar[str]
    counted: ClassVar[str] = "positions"
    into: ClassVar[str] = "list; made if it is not there"
    arguments: ClassVar[Mapping[str, Option]] = {"bound": bound("µm"), "max-points": MAX_POINTS, **NEW_LIST}
    labels: ClassVar[Mapping[str, str]] = {"largest": "largest", "range": "range", "rms": "root mean square"}
    one_run: ClassVar[str] = "With one run"
    few_runs: ClassVar[str] = "There are not two runs that suffice on their own, so"
    old: T | None = None

    def __init__(self, readings: R, target: Any, options: Options) -> None:
        if options.max_points is not None and options.max_points < 2:
            raise CannotCreateError("a table has two entries at least")
        self.readings, self.target, self.options = readings, target, options
        self.unit = self.counts_in()
        self.small, self.lost = shown(self.unit).unit, 0.5 * RESOLUTION * shown(self.unit).factor
        self.prepare()

    @classmethod
    def description(cls) -> str:
        """Say what the command does."""
        columns = f"A measurement has {cls.columns}; other units stand in the first row: deviation [mm]."
        return f"Makes a {cls.meaning}. {columns}"

    @staticmethod
    @abstractmethod
    def read(path: str | Path, axis: str = "") -> R:
        """Read a file, of several axes in it that of ``axis``; MeasurementError if it, or a line of it, cannot be."""

    @classmethod
    def load(cls, paths: Sequence[Path], given: Mapping[str, Any], read: Callable[[Path], R]) -> R:
        """Read files as one measurement, traces among them; ``given``: values of the command's options."""
        if "map" not in given:
            return joined([read(path) for path in paths])
        return joined(
            [
                cls.of_trace(read_axis_trace(path, given["map"], given["cycle_time"]))
                if given["map"] or is_trace(path)
                else read(path)
                for path in paths
            ]
        )

    @classmethod
    def of_trace(cls, trace: AxisTrace) -> R:
        """Return what a trace reads, for kinds with the arguments ``TRACE``."""
        raise NotImplementedError

    @classmethod
    def open(cls, path: Path, given: Mapping[str, Any]) -> Any:
        """Open the list that gets the table; ``given``: values of the command's options."""
        return TargetList(path, given["axis"], given["name"])

    def counts_in(self) -> str:
        """Return what the deviating axis counts in."""
        return "mm"

    def prepare(self) -> None:
        """Look at what the list says; ``old`` is None in here."""
        self.target.check_unit(self.unit)
        reserves = KINDS[self.name].reserves
        self.capacity = self.options.max_points or (self.target.capacity(reserves) if reserves else 1)
        if not self.options.on_top:
            return
        before = self.target.present(self.name)
        if before is None:
            sentence = f"no {self.name} compensation of this axis acts, so nothing can be put on top of it"
            raise CannotCreateError(sentence)
        self.old = self.table_of(before)

    def table_of(self, compensation: Any) -> T:
        """Return what a compensation takes off; for kinds that can be put on top of one."""
        raise NotImplementedError

    def measured(self, readings: R) -> Array:
        """Return what a table is to take off from each reading."""
        return np.asarray(vars(readings)["deviations"])

    @abstractmethod
    def means(self, readings: R) -> R:
        """Return what a table is made of: one reading a place, the mean of those there."""

    @abstractmethod
    def table(self, means: R) -> T:
        """Return a table, thinned and rounded as a list holds it, on top of ``old``."""

    @abstractmethod
    def removed(self, table: T, readings: R) -> Array:
        """Return what a table takes off from each reading."""

    @abstractmethod
    def compensation(self, table: T) -> Any:
        """Return what the list is to say."""

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that stand apart from their like."""
        return ()

    def moved(self, other: Self) -> float:
        """Return how far the table is from that of a fit of some of the readings, at most, in ``small``."""
        mine, its = (one.table(one.means(one.readings)) for one in (self, other))
        means = other.means(other.readings)
        return float(np.max(np.abs(self.removed(mine, means) - other.removed(its, means))))

    def points(self, table: T) -> int:
        """Return the number of entries."""
        return int(np.size(getattr(self.compensation(table), self.counted)))

    @property
    def settled(self) -> tuple[str, ...]:
        """Entries that the list is to say besides the table: ends of their names."""
        return ()

    @abstractmethod
    def draw(self, ax: Axes, table: T) -> None:
        """Draw measurement, table and what is left."""

    def report(self, table: T) -> Report:
        """Return what came of it."""
        within = f"within {self.deviation(table):.2f} {self.small} of the measured means"
        sentence = f"{self.points(table)} of {self.capacity} points; the table is {within}."
        return Report((sentence,), tuple(self.target.notes(self.name)))

    def files(self, compensation: Any) -> dict[Path, bytes]:
        """Return the list with the compensation, and what else changes."""
        data = self.target.with_compensation(self.name, compensation, self.options.max_points, self.settled)
        return {self.target.path: data}

    def figures(self, left: Array) -> dict[str, float]:
        """Return figures of what is left: largest amount, whole range and root mean square."""
        return {
            "largest": float(np.max(np.abs(left))),
            "range": float(np.ptp(left)),
            "rms": float(np.sqrt(np.mean(left**2))),
        }

    def left(self, table: T, readings: R) -> Array:
        """Return what a table leaves of each reading."""
        removed = self.removed(table, readings)
        if self.old is not None:
            removed = removed - self.removed(self.old, readings)
        return self.measured(readings) - removed

    def deviation(self, table: T) -> float:
        """Return how far a table is from the means, at most."""
        return float(np.max(np.abs(self.left(table, self.means(self.readings)))))

    def without(self, run: npt.NDArray[np.bool_]) -> Array:
        """Return what is left of a run by a table made of the others."""
        return self.left(self.table(self.means(self.readings.only(~run))), self.readings.only(run))

    def create(self) -> Creation:
        """Make the table and the list."""
        self.check_bound()
        table = self.table(self.means(self.readings))
        figures = {
            MEASURED: self.figures(self.measured(self.readings)),
            PREDICTED: self.figures(self.left(table, self.readings)),
        }
        report = self.report(table)
        held_out = self._held_out()
        if held_out is not None:
            figures[LEFT_OUT] = self.figures(held_out)
        else:
            why = self.few_runs if np.ptp(self.readings.runs) else self.one_run
            report = report.noted(f"{why} there is no check by leaving runs out.")
        compensation = self.compensation(table)
        return Creation(
            kind=self.name,
            compensation=compensation,
            files=self.files(compensation),
            points=self.points(table),
            capacity=self.capacity,
            deviation=self.deviation(table),
            unit=self.small,
            figures=figures,
            labels=self.labels,
            report=report,
            before=self.target.before(),
            draw=lambda ax: self.draw(ax, table),
        )

    def _held_out(self) -> Array | None:
        """Return what is left of every reading by a table made without its run; None if that cannot be."""
        left, runs = np.empty_like(self.measured(self.readings)), np.unique(self.readings.runs)
        if len(runs) < 2:
            return None
        try:
            for run in runs:
                left[self.readings.runs == run] = self.without(self.readings.runs == run)
        except CannotCreateError:
            return None
        return left

    # Steps that several kinds share

    def axis_number(self, given: Sequence[int], place: int, entry: str, lacking: str) -> int:
        """Return the logical number of another axis, as an option or else the list says."""
        number = (given[place] if place < len(given) else 0) or self.target.values.integer(entry)
        if not number:
            raise CannotCreateError(f"the list does not say which {lacking}")
        return int(number)

    def listed(self, values: Array) -> Array:
        """Return corrections in ``small`` as a list can hold them."""
        factor = shown(self.unit).factor
        return rounded(values / factor) * factor

    def check_bound(self) -> None:
        """Refuse a bound that is finer than the list's resolution."""
        if self.options.bound is not None and self.options.bound < self.lost:
            cannot = f"so {self.options.bound:g} {self.small} cannot be kept"
            raise CannotCreateError(f"values are rounded to {2 * self.lost:g} {self.small}, {cannot}")

    def chosen(self, positions: Array, curves: Array) -> Places:
        """Return the places of the points a table is to have.

        Parameters
        ----------
        positions : array, shape (m,)
            Where the curves were measured, ascending.
        curves : array, shape (k, m)
            In ``small``.
        """
        if self.options.bound is None:
            return closest(positions, curves, self.capacity)
        places = fewest(positions, curves, self.options.bound - self.lost)
        if len(places) > self.capacity:
            least = deviation(positions, curves, closest(positions, curves, self.capacity)) + self.lost
            raise CannotCreateError(
                f"{self.options.bound:g} {self.small} take {len(places)} points, but the list has room for "
                f"{self.capacity}, which keep {least:.2f} {self.small}"
            )
        return places


def rounded(values: Array) -> Array:
    """Return positions or corrections in mm or ° as a list can hold them; no −0."""
    result: Array = np.round(values / RESOLUTION) * RESOLUTION
    return np.round(result, 10) + 0.0
