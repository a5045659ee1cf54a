"""Accuracy and repeatability of positioning by ISO 230-2:2014, clause 3 (definitions) and clause 5 (evaluation).

With readings ``x_ij`` of run j at target i, ↑ in positive and ↓ in negative direction::

    x̄_i↑ = mean_j x_ij↑          s_i↑ = sqrt(Σ_j (x_ij↑ − x̄_i↑)² / (n − 1))          x̄_i = (x̄_i↑ + x̄_i↓) / 2
    B_i  = x̄_i↑ − x̄_i↓           B = max |B_i|             B̄ = mean B_i             M = max x̄_i − min x̄_i
    R_i↑ = 4 s_i↑                R_i = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓)       R↑ = max R_i↑,  R = max R_i
    E↑   = max x̄_i↑ − min x̄_i↑   E = max(x̄_i↑, x̄_i↓) − min(x̄_i↑, x̄_i↓)
    A↑   = max(x̄_i↑ + 2 s_i↑) − min(x̄_i↑ − 2 s_i↑)    A = max(x̄_i↑ + 2 s_i↑, x̄_i↓ + 2 s_i↓) − min(… − 2 s …)

What readings do not suffice for is NaN, and a note says why: with one run there is no s, so no R and no A; with one
direction there is no B, M, E, R and A, only their one-directional kin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..model import Tabular, Tabulated, symbol
from .outliers import Outlier
from .positioning import Positioning
from .uncertainty import Conditions

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

RUNS_STANDARD = 5
"""Runs in each direction the standard asks for (clause 4.3)."""

PARAMETERS = ("A", "A_up", "A_down", "R", "R_up", "R_down", "E", "E_up", "E_down", "M", "B", "B_mean")
"""Names of the figures of an axis, in the order they are reported in."""

SYMBOLS = {name: name.replace("_up", "↑").replace("_down", "↓").replace("B_mean", "B̄") for name in PARAMETERS}
"""As the standard writes them."""

OF_TARGETS = {
    "mean_up": "x̄↑",
    "mean_down": "x̄↓",
    "mean": "x̄",
    "reversal": "B",
    "s_up": "s↑",
    "s_down": "s↓",
    "repeatability_up": "R↑",
    "repeatability_down": "R↓",
    "repeatability": "R",
}
"""Names of the figures of each target, and how the standard writes them."""


@dataclass(frozen=True, eq=False)
class Iso230Result(Tabular, Mapping[str, float]):
    r"""What ISO 230-2 says of a measurement; all but ``positions`` in ``unit``, m targets.

    Attributes
    ----------
    axis, source : str
        Which axis, and from which file.
    position_unit, unit : str
        ``mm`` and ``µm``, or ``deg`` and ``″``.
    positions : array, shape (m,)
        Targets, ascending, mm or °.
    count_up, count_down : array of int, shape (m,)
        Readings in positive and in negative direction.
    mean_up, mean_down, mean : array, shape (m,)
        x̄_i↑, x̄_i↓ and x̄_i.
    s_up, s_down : array, shape (m,)
        s_i↑ and s_i↓.
    reversal : array, shape (m,)
        B_i.
    repeatability_up, repeatability_down, repeatability : array, shape (m,)
        R_i↑, R_i↓ and R_i.
    A, A_up, A_down, R, R_up, R_down, E, E_up, E_down, M, B, B_mean : float
        Figures of the axis; NaN where the readings do not suffice.
    uncertainty : mapping of str to float
        Expanded uncertainty (k = 2) of the figures by ``uncertainty.Conditions``, by name; empty without conditions.
    readings : Positioning
        What was evaluated.
    outliers : tuple of Outlier
        Readings that stand apart from those of the same target and direction; the standard lets them count.
    robust : Iso230Result or None
        What the standard would say without them; None: there are none.
    notes : tuple of str
        What is missing, and why.

    It is a mapping of the figures of the axis; ``to_frame()`` has those of the targets.

    Examples
    --------
    >>> from pathlib import Path
    >>> from axcomp import measure
    >>> _ = Path("x.csv").write_text("target,run,direction,deviation\n0,1,+,0\n0,1,-,3\n9,1,+,1\n9,1,-,2\n")
    >>> result = measure("x.csv")
    >>> float(result["B"]), result.unit, result.to_frame().attrs["units"]["target"]
    (3.0, 'µm', 'mm')
    """

    axis: str
    source: str
    position_unit: str
    unit: str
    positions: Array
    count_up: npt.NDArray[np.int64]
    count_down: npt.NDArray[np.int64]
    mean_up: Array
    mean_down: Array
    mean: Array
    s_up: Array
    s_down: Array
    reversal: Array
    repeatability_up: Array
    repeatability_down: Array
    repeatability: Array
    A: float
    A_up: float
    A_down: float
    R: float
    R_up: float
    R_down: float
    E: float
    E_up: float
    E_down: float
    M: float
    B: float
    B_mean: float
    readings: Positioning = field(repr=False)
    outliers: tuple[Outlier, ...] = ()
    robust: Iso230Result | None = field(default=None, repr=False)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def parameters(self) -> dict[str, float]:
        """Return the figures of the axis by name, in the order of a report."""
        return {name: getattr(self, name) for name in PARAMETERS}

    def table(self) -> pd.DataFrame:
        """Return the figures of each target as a data frame, one row a target, symbols of the standard as columns."""
        return self.to_frame().rename_axis(f"target [{self.position_unit}]")

    def tabulated(self) -> Tabulated:
        """Return the figures of each target, symbols of the standard as columns."""
        columns = {
            "n↑": self.count_up,
            "n↓": self.count_down,
            **{written: getattr(self, name) for name, written in OF_TARGETS.items()},
            "U(x̄↑)": mean_uncertainty(self.s_up, self.count_up),
            "U(x̄↓)": mean_uncertainty(self.s_down, self.count_down),
        }
        units = {name: "" if name.startswith("n") else self.unit for name in columns}
        return Tabulated("target", self.positions, columns, {"target": self.position_unit, **units})

    def __getitem__(self, name: str) -> float:
        """Return a figure of the axis by its name in ``PARAMETERS``."""
        return self.parameters()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(PARAMETERS)

    def __len__(self) -> int:
        return len(PARAMETERS)

    def to_dict(self) -> dict[str, Any]:
        """Return everything for JSON; None stands for what is not available."""
        return {
            "axis": self.axis,
            "source": self.source,
            "standard": "ISO 230-2:2014",
            "position_unit": self.position_unit,
            "unit": self.unit,
            "parameters": {name: _plain(value) for name, value in self.parameters().items()},
            "expanded_uncertainty_k2": {name: _plain(value) for name, value in self.uncertainty.items()},
            "targets": [
                {
                    "position": float(position),
                    "count_up": int(self.count_up[i]),
                    "count_down": int(self.count_down[i]),
                    **{name: _plain(getattr(self, name)[i]) for name in OF_TARGETS},
                }
                for i, position in enumerate(self.positions)
            ],
            "outliers": [{"run": one.run, "at": one.at, "size": one.size, "limit": one.limit} for one in self.outliers],
            "parameters_without_outliers": None
            if self.robust is None
            else {name: _plain(value) for name, value in self.robust.parameters().items()},
            "notes": list(self.notes),
        }

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw mean deviations in both directions with bands of ±2s and the single readings, as the standard does.

        It goes into ``ax``, or into a new figure; return the axes.
        """
        from ..plot import DOWN, UP, labelled, new_figure

        ax = new_figure().add_subplot() if ax is None else ax
        sides = ((UP, 1, "↑", self.mean_up, self.s_up), (DOWN, -1, "↓", self.mean_down, self.s_down))
        for colour, direction, arrow, mean, s in sides:
            there = ~np.isnan(mean)
            if not there.any():
                continue
            chosen = self.readings.directions == direction
            targets, deviations = self.readings.targets[chosen], self.readings.deviations[chosen]
            ax.plot(targets, deviations, ".", color=colour, ms=3.5, alpha=0.35)
            known = there & ~np.isnan(s)
            if known.any():
                x, low, high = self.positions[known], (mean - 2.0 * s)[known], (mean + 2.0 * s)[known]
                ax.fill_between(x, low, high, color=colour, alpha=0.13, lw=0, label=f"x̄{arrow} ± 2s{arrow}")
                for edge in (low, high):
                    ax.plot(x, edge, color=colour, lw=0.7, alpha=0.7)
            ax.plot(self.positions[there], mean[there], "o-", color=colour, ms=4, lw=1.4, label=f"x̄{arrow}")
        if np.any(~np.isnan(self.mean)):
            ax.plot(self.positions, self.mean, "--", color="0.25", lw=1.1, label="x̄")
        ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
        shown = {SYMBOLS[name]: getattr(self, name) for name in ("A", "R", "E", "M", "B")}
        figures = [f"{name} = {value:.1f}" for name, value in shown.items() if not math.isnan(value)]
        title = f"Positioning of axis {self.axis}" if self.axis else "Positioning"
        title += f":  {',  '.join(figures)} {self.unit}" if figures else ""
        ax.legend(loc="best", ncols=3, fontsize=10, framealpha=0.9)
        position = f"target position [{symbol(self.position_unit)}]"
        return labelled(ax, title, position, f"deviation, actual − target [{self.unit}]")

    def __repr__(self) -> str:
        figures = ", ".join(
            f"{SYMBOLS[name]} = {value:.2f}" for name, value in self.parameters().items() if not math.isnan(value)
        )
        return f"Iso230Result({self.axis or 'axis'}, {len(self.positions)} targets, {figures} {self.unit})"


def evaluate_robustly(measurement: Positioning, conditions: Conditions | None = None) -> Iso230Result:
    """Evaluate as ``evaluate`` does, with outliers named and the figures without them beside."""
    result, outliers = evaluate(measurement, conditions), measurement.outliers()
    if not outliers:
        return result
    robust = evaluate(measurement.without(outliers), conditions)
    notes = tuple(f"Outlier: {one}." for one in outliers)
    return replace(result, outliers=outliers, robust=robust, notes=(*notes, *result.notes))


def evaluate(measurement: Positioning, conditions: Conditions | None = None) -> Iso230Result:
    """Evaluate a positioning measurement of any number of runs; targets may be missing in some.

    With the conditions of the test the result has expanded uncertainties. ValueError if they are given for a rotary
    axis.
    """
    if conditions is not None and measurement.unit != "mm":
        raise ValueError("conditions of a test, and uncertainties from them, are for linear axes only")
    positions, _, deviations = measurement.grid()
    counts = np.sum(~np.isnan(deviations), axis=2)
    means = np.nansum(deviations, axis=2) / np.where(counts > 0, counts, np.nan)
    squares = np.nansum((deviations - means[:, :, None]) ** 2, axis=2)
    s = np.sqrt(squares / np.where(counts > 1, counts - 1.0, np.nan))
    mean_up, mean_down = means
    s_up, s_down = s
    mean, reversal = (mean_up + mean_down) / 2.0, mean_up - mean_down
    repeatability_up, repeatability_down = 4.0 * s_up, 4.0 * s_down
    repeatability = np.maximum.reduce(
        [2.0 * s_up + 2.0 * s_down + np.abs(reversal), repeatability_up, repeatability_down]
    )
    both = bool(np.any(counts[0]) and np.any(counts[1]))
    result = Iso230Result(
        axis=measurement.axis,
        source=measurement.source,
        position_unit=measurement.unit,
        unit=measurement.deviation_unit,
        positions=positions,
        count_up=counts[0],
        count_down=counts[1],
        mean_up=mean_up,
        mean_down=mean_down,
        mean=mean,
        s_up=s_up,
        s_down=s_down,
        reversal=reversal,
        repeatability_up=repeatability_up,
        repeatability_down=repeatability_down,
        repeatability=repeatability,
        A=_spread(means + 2.0 * s, means - 2.0 * s) if both else math.nan,
        A_up=_spread(mean_up + 2.0 * s_up, mean_up - 2.0 * s_up),
        A_down=_spread(mean_down + 2.0 * s_down, mean_down - 2.0 * s_down),
        R=_largest(repeatability),
        R_up=_largest(repeatability_up),
        R_down=_largest(repeatability_down),
        E=_spread(means, means) if both else math.nan,
        E_up=_spread(mean_up, mean_up),
        E_down=_spread(mean_down, mean_down),
        M=_spread(mean, mean),
        B=_largest(np.abs(reversal)),
        B_mean=float(np.nanmean(reversal)) if np.any(~np.isnan(reversal)) else math.nan,
        readings=measurement,
        notes=_notes(counts),
    )
    if conditions is None:
        return result
    travel = float(positions[-1] - positions[0])
    runs = int(min((n for n in counts.ravel() if n > 0), default=1))
    uncertainty = conditions.of_parameters(travel, runs)
    known = {name: u for name, u in uncertainty.items() if not math.isnan(getattr(result, name))}
    return replace(result, uncertainty=known)


def mean_uncertainty(s: Array, count: npt.NDArray[np.int64]) -> Array:
    """Return the expanded uncertainty (k = 2) of means from the scatter alone, 2 s/√n (JCGM 100:2008, 4.2.3)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return 2.0 * s / np.sqrt(count)


def _spread(upper: Array, lower: Array) -> float:
    """Return the largest of one minus the smallest of the other, NaN where there is nothing."""
    return _largest(upper) + _largest(-lower)


def _largest(values: Array) -> float:
    known = values[~np.isnan(values)]
    return float(known.max()) if known.size else math.nan


def _notes(counts: npt.NDArray[np.int64]) -> tuple[str, ...]:
    notes = []
    arrows = {0: "positive", 1: "negative"}
    measured = [d for d in arrows if counts[d].any()]
    if len(measured) == 1:
        notes.append(f"Only the {arrows[measured[0]]} direction was measured: B, M, E, R and A do not exist.")
    for d in measured:
        missing, single = int(np.sum(counts[d] == 0)), int(np.sum(counts[d] == 1))
        if missing:
            notes.append(f"{missing} of {counts.shape[1]} targets have no reading in {arrows[d]} direction.")
        if single == np.sum(counts[d] > 0):
            notes.append(f"There is one run in {arrows[d]} direction: s, R and A do not exist for it.")
        elif single:
            notes.append(f"{single} targets have a single reading in {arrows[d]} direction: no s, R and A there.")
    runs = int(counts[measured].max())
    if runs < RUNS_STANDARD:
        plural = "is one" if runs == 1 else f"are {runs}"
        notes.append(f"ISO 230-2 asks for {RUNS_STANDARD} runs in each direction; there {plural}.")
    return tuple(notes)


def _plain(value: float) -> float | None:
    return None if math.isnan(value) else float(value)
