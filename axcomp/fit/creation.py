"""What making a list from measurements gives, whatever the kind: the table, the list, and what it will do."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..engine.motion import Array
from ..lists.saving import write_whole
from ..model.quantity import shown
from .target_list import TargetList
from .thinning import Places, closest, deviation, fewest

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RESOLUTION = 1e-4
"""What positions and corrections in a list count in, mm or °."""

MEASURED, PREDICTED, LEFT_OUT = "measured", "predicted", "leave one run out"
"""States that figures are given for: without the new table, with it, and each run with a table made of the others."""


class CannotCreateError(ValueError):
    """No table can be made as asked for; one sentence."""


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
        Leadscrew: one curve for both directions, the mean.
    masters : (int, int)
        Logical numbers of the master or masters (cross, plane; crosstalk: the accelerating axis); 0: as the list says.
    adaptation : (int, int)
        Crosstalk: logical numbers of the adaptation axes; 0: as the list says.
    """

    bound: float | None = None
    max_points: int | None = None
    on_top: bool = False
    one_sided: bool = False
    masters: tuple[int, int] = (0, 0)
    adaptation: tuple[int, int] = (0, 0)


@dataclass(frozen=True, eq=False)
class Creation:
    """A list with a new table.

    Attributes
    ----------
    kind : str
        ``leadscrew``, ``cross``, …
    compensation : Leadscrew, Cross, Plane, Crosstalk or Friction
        What it says, in mm or °.
    path : Path
        The list.
    data : bytes
        All of it, with the new table.
    points, capacity : int
        Entries of the table, and how many the controller takes.
    deviation : float
        How far the table, thinned and rounded, is from the measured means where they were measured, at most.
    unit : str
        Of ``deviation`` and the figures.
    figures : mapping of str to mapping of str to float
        For each state (``MEASURED``, ``PREDICTED``, ``LEFT_OUT``) the figures by name.
    labels : mapping of str to str
        Name of each figure → how it is shown.
    notes : tuple of str
        What else should be known.
    draw : callable
        Draws measurement, table and what is left into axes.
    """

    kind: str
    compensation: Any
    path: Path
    data: bytes
    points: int
    capacity: int
    deviation: float
    unit: str
    figures: Mapping[str, Mapping[str, float]]
    labels: Mapping[str, str]
    notes: tuple[str, ...] = ()
    draw: Callable[[Axes], None] = field(repr=False, default=lambda _: None)

    def write(self, path: str | Path | None = None) -> Path:
        """Write the list where it was read or elsewhere, whole or not at all; return where it is."""
        target = self.path if path is None else Path(path)
        write_whole(target, self.data)
        return target

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw measurement, table and what is left; return the axes."""
        if ax is None:
            from matplotlib.figure import Figure  # takes long to load

            ax = Figure(figsize=(10.0, 5.6), dpi=120, layout="constrained").add_subplot()
        self.draw(ax)
        return ax

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON; None stands for what is not available."""
        return {
            "kind": self.kind,
            "list": str(self.path),
            "points": self.points,
            "capacity": self.capacity,
            "deviation": self.deviation,
            "unit": self.unit,
            "figures": {
                state: {name: None if math.isnan(value) else value for name, value in figures.items()}
                for state, figures in self.figures.items()
            },
            "notes": list(self.notes),
        }


def put_on_top(target: TargetList, kind: str, options: Options) -> Any:
    """Return the compensation that acted during the measurement, None where none is said to have.

    Raises
    ------
    CannotCreateError
        One is said to have acted, but none of the kind does.
    """
    before = target.present(kind) if options.on_top else None
    if options.on_top and before is None:
        raise CannotCreateError(f"no {kind} compensation of this axis acts, so nothing can be put on top of it")
    return before


def rounded(values: Array) -> Array:
    """Return positions or corrections in mm or ° as a list can hold them; no −0."""
    result: Array = np.round(values / RESOLUTION) * RESOLUTION
    return np.round(result, 10) + 0.0


def lost_by_rounding(unit: str) -> float:
    """Return how far rounding changes a value in ``mm`` or ``deg``, in µm or ″."""
    return 0.5 * RESOLUTION * shown(unit).factor


def listed(values: Array, unit: str) -> Array:
    """Return corrections in µm or ″, of an axis that counts in ``mm`` or ``deg``, as a list can hold them."""
    factor = shown(unit).factor
    return rounded(values / factor) * factor


def chosen_points(
    positions: Array, curves: Array, capacity: int, bound: float | None, unit: str, rounding: float
) -> Places:
    """Return the places of the points a table is to have.

    Parameters
    ----------
    positions : array, shape (m,)
        Where the curves were measured, ascending.
    curves : array, shape (k, m)
        In ``unit``.
    capacity : int
        Points the controller takes.
    bound : float or None
        How far the rounded table may be from the measured curves; None: as close as the capacity allows.
    unit : str
        For the sentence.
    rounding : float
        How far rounding may change a value, in ``unit``.

    Raises
    ------
    CannotCreateError
        The bound cannot be kept with so many points, or not with values of the list's resolution.
    """
    if bound is None:
        return closest(positions, curves, capacity)
    if bound < rounding:
        raise CannotCreateError(f"values are rounded to {2 * rounding:g} {unit}, so {bound:g} {unit} cannot be kept")
    places = fewest(positions, curves, bound - rounding)
    if len(places) > capacity:
        least = deviation(positions, curves, closest(positions, curves, capacity)) + rounding
        raise CannotCreateError(
            f"{bound:g} {unit} take {len(places)} points, but the list has room for {capacity}, "
            f"which keep {least:.2f} {unit}"
        )
    return places


def leave_one_run_out(
    runs: npt.NDArray[np.int64], left: Callable[[npt.NDArray[np.bool_], npt.NDArray[np.bool_]], Array]
) -> Array | None:
    """Return what is left of every reading by a table made without its run; None with a single run.

    Parameters
    ----------
    runs : array, shape (n,)
        Run of each reading.
    left : callable
        Takes which readings to make the table of and which to apply it to, returns what is left of the latter.
    """
    numbers = np.unique(runs)
    if len(numbers) < 2:
        return None
    result = np.empty(len(runs))
    for number in numbers:
        result[runs == number] = left(runs != number, runs == number)
    return result


def spread_figures(deviations: Array) -> dict[str, float]:
    """Return the largest amount, the whole range and the root mean square of deviations."""
    return {
        "largest": float(np.max(np.abs(deviations))),
        "range": float(np.ptp(deviations)),
        "rms": float(np.sqrt(np.mean(deviations**2))),
    }


SPREAD_LABELS = {"largest": "largest", "range": "range", "rms": "root mean square"}
