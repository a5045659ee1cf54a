"""Sign: what a table does to a measured error, as it is written, with the opposite sign, with directions interchanged.

The measurement is one without the compensation. What is added to the setpoint is added to the deviations, and ISO 230-2
gives the figures: the bidirectional systematic deviation E, which a constant offset of the measurement does not change,
or its kin of one direction where only that was measured.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...engine import Array
from ...kinds import Tables, tables_of
from ...lists import Findings
from ...measurement import Iso230Result, Positioning, evaluate
from ...model import Machine, symbol
from .positions import Positions, sentence

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CLEARLY = 0.9
"""Another reading of the table must leave less than this share of the error to be the better one."""

WITHOUT, WRITTEN, REVERSED, INTERCHANGED = "without", "as written", "opposite sign", "directions interchanged"

_CODES = {
    WRITTEN: "AXC-SIGN",
    REVERSED: "AXC-SIGN-INVERTED",
    INTERCHANGED: "AXC-SIGN-SWAPPED",
    WITHOUT: "AXC-SIGN-NO-HELP",
}


@dataclass(frozen=True, eq=False)
class SignResult:
    """What a table does to a measured error.

    Attributes
    ----------
    name : str
        The table in words.
    entry : str
        Name of its entries in the list.
    evaluations : mapping of str to Iso230Result
        Of the measurement ``without``, and with the table ``as written``, with the ``opposite sign`` and, if it is
        bilateral, with ``directions interchanged``.
    gain : float
        The factor on the table that would leave the least squares; 1: it fits; NaN: the table is flat there.
    """

    name: str
    entry: str
    evaluations: Mapping[str, Iso230Result]
    gain: float

    @property
    def symbol(self) -> str:
        """Which figure of ISO 230-2 counts."""
        result = self.evaluations[WITHOUT]
        return next(name for name in ("E", "E_up", "E_down") if not math.isnan(getattr(result, name)))

    def error(self, reading: str) -> float:
        """Return the figure that counts for one of ``evaluations``, in their unit."""
        value: float = getattr(self.evaluations[reading], self.symbol)
        return value

    @property
    def verdict(self) -> str:
        """Return the reading of the table that is right: ``without`` where none helps."""
        best = min((name for name in self.evaluations if name not in {WITHOUT, WRITTEN}), key=self.error)
        if self.error(best) < CLEARLY * min(self.error(WRITTEN), self.error(WITHOUT)):
            return best
        return WRITTEN if self.error(WRITTEN) < self.error(WITHOUT) else WITHOUT

    @property
    def code(self) -> str:
        """Code of the finding."""
        return _CODES[self.verdict]

    @property
    def message(self) -> str:
        """Return the finding's sentence."""
        unit = self.evaluations[WITHOUT].unit
        letter = self.symbol.replace("_up", "↑").replace("_down", "↓")
        shown = {name: f"{self.error(name):.2f} {unit}" for name in self.evaluations}
        does = "shrinks" if self.error(WRITTEN) < self.error(WITHOUT) else "goes"
        begin = f"With {self.name} the measured error {letter} {does} from {shown[WITHOUT]} to {shown[WRITTEN]}"
        if self.verdict == WRITTEN:
            return f"{begin}."
        if self.verdict == REVERSED:
            return f"{begin}, with the opposite sign to {shown[REVERSED]}: the table looks inverted."
        if self.verdict == INTERCHANGED:
            return f"{begin}, with the directions interchanged to {shown[INTERCHANGED]}: they look swapped."
        factor = "" if math.isnan(self.gain) else f" the factor that fits best is {self.gain:.2f};"
        return f"{begin}:{factor} was the compensation on during the measurement, or is it another axis or unit?"

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON."""
        unit = self.evaluations[WITHOUT].unit
        return {
            "table": self.name,
            "source": self.evaluations[WITHOUT].source,
            "verdict": self.verdict,
            "figure": self.symbol,
            "unit": unit,
            "errors": {name: self.error(name) for name in self.evaluations},
            "gain": None if math.isnan(self.gain) else self.gain,
        }

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the mean deviations without the compensation and as written; return the axes."""
        from ...plot import DOWN, UP, labelled, new_figure

        ax = new_figure().add_subplot() if ax is None else ax
        for name, style, words in ((WITHOUT, "--", "without"), (WRITTEN, "-", "with the table")):
            evaluation = self.evaluations[name]
            for arrow, mean, colour in (("↑", evaluation.mean_up, UP), ("↓", evaluation.mean_down, DOWN)):
                known = ~np.isnan(mean)
                if known.any():
                    points = (evaluation.positions[known], mean[known])
                    ax.plot(*points, style, marker="o", ms=3.5, color=colour, label=f"{words} {arrow}")
        ax.axhline(0.0, color="0.6", lw=0.8, zorder=0)
        ax.legend(ncols=2, fontsize=10)
        unit, position = evaluation.unit, symbol(evaluation.position_unit)
        figures = f"{self.symbol} {self.error(WITHOUT):.1f} → {self.error(WRITTEN):.1f} {unit}"
        title = f"{sentence(self.name)}: {figures}"
        return labelled(ax, title, f"target position [{position}]", f"deviation, actual − target [{unit}]")


def sign_of(machine: Machine, measurement: Positioning, axis: str, over: str) -> SignResult:
    """Return what the table of an axis does to the error that was measured without it.

    ``measurement``: deviations of ``axis`` at targets of ``over``, the compensation off. Both are the same for a
    leadscrew table, else it is the cross table of ``axis`` over ``over``.

    Raises
    ------
    ValueError
        There is no such axis or table, or the measurement is in other units; the message says so.
    """
    table = _table(machine, axis, over)
    curves = [curve.added() for curve in table.curves]
    units = (measurement.unit, measurement.deviating_unit or measurement.unit)
    own = (machine.axis(over).unit, machine.axis(axis).unit)
    if units != own:
        raise ValueError(
            f"{measurement.source}: it is in {' and '.join(dict.fromkeys(units))}, {table.name} in "
            f"{' and '.join(dict.fromkeys(own))}"
        )
    # In the unit of the deviations.
    forwards, backwards = (np.array(side.shown().at(measurement.targets)) for side in (curves[0], curves[-1]))
    added, interchanged = (
        np.where(directions > 0, forwards, backwards)
        for directions in (measurement.directions, -measurement.directions)
    )
    readings = {WITHOUT: np.zeros_like(added), WRITTEN: added, REVERSED: -added}
    if len(curves) > 1:
        readings[INTERCHANGED] = interchanged
    evaluations = {
        name: evaluate(measurement.with_deviations(measurement.deviations + one)) for name, one in readings.items()
    }
    return SignResult(table.name, curves[0].entry, evaluations, _gain(measurement.deviations, added))


def _table(machine: Machine, axis: str, over: str) -> Tables:
    names = [one.name for one in machine.axes]
    for name in (axis, over):
        if name not in names:
            raise ValueError(f"there is no axis {name!r}; the machine has {', '.join(names) or 'none'}")
    found = [
        one for one in tables_of(machine, axis) if one.curves and (one.curves[0].over.axis == axis) == (axis == over)
    ]
    if not found:
        kind = "leadscrew" if axis == over else "cross"
        raise ValueError(f"no {kind} compensation of axis {axis} is in force")
    table = found[0]
    if table.curves[0].over.axis != over:
        raise ValueError(f"the {table.kind} table of {axis} is over {table.curves[0].over.axis}, not over {over}")
    return table


def _gain(deviations: Array, added: Array) -> float:
    wanted, given = -(deviations - deviations.mean()), added - added.mean()
    power = float(given @ given)
    return float(wanted @ given) / power if power > 0.0 else math.nan


def judge_signs(
    machine: Machine, measurements: Sequence[tuple[Positioning, str, str]], positions: Positions, findings: Findings
) -> list[SignResult]:
    """Note and return what the tables do to measurements, each with the axis that deviates and the one that moved.

    Raises
    ------
    ValueError
        As ``sign_of`` does.
    """
    results = []
    for measurement, axis, over in measurements:
        result = sign_of(machine, measurement, axis, over)
        findings.add(result.code, *positions.of_table(machine.axis(axis).number, result.entry, 0), result.message)
        results.append(result)
    return results
