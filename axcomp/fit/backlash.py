"""Backlash from positioning measurements: how far the drive has to go further after a reversal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from ..engine import Array
from ..kinds import MODE, NEGATIVE, Backlash
from ..measurement import AxisTrace, Outlier, Positioning, evaluate
from ..model import shown
from .axis_list import AxisList
from .creation import Report
from .driver import NEW_LIST, ON_TOP, TRACE, rounded
from .over_position import OverPosition
from .trace_readings import positioning_of

_NOTES = "notes"
COVERAGE = 2.0
"""Factor k of expanded uncertainties."""
_SPREAD = 0.5
"""Share of the mean that reversal values may be away from it before another compensation is proposed."""


class BacklashFit(OverPosition[Backlash]):
    """Minus the mean reversal value B̄ over the targets: above 0 where the drive moves before the slide does.

    The axis list says which mode; where it says none, the position stays right after positive motion (mode 1).
    """

    name = "backlash"
    counted = "amount"
    meaning = "backlash compensation from a positioning measurement in both directions, or from a trace"
    columns = (
        "Renishaw .rtl, or columns target, run, direction, deviation (mm, µm); a trace has time (s), position (of the "
        "motor) or setpoint, and actual (of the slide) or deviation, named so or by --map"
    )
    example = "axcomp create backlash --from x.rtl --into achsmd1.lis"
    into = "axis list, made if it is not there; or what leads to it: start-up list, its folder, compensation list"
    arguments: ClassVar = {
        **NEW_LIST,
        "axis": {**NEW_LIST["axis"], "help": "logical axis number of a new list, or to find the axis list"},
        "on-top": ON_TOP,
        **TRACE,
    }
    both = True

    @classmethod
    def of_trace(cls, trace: AxisTrace) -> Positioning:
        """Return what the passes to and fro read at targets."""
        readings, notes = positioning_of(trace)
        return replace(readings, details={_NOTES: " ".join(notes)})

    def outliers(self) -> Sequence[Outlier]:
        """Return readings that stand apart; the passes of a trace differ by their speeds, none of them is one."""
        return () if _NOTES in self.readings.details else super().outliers()

    @classmethod
    def open(cls, path: Path, given: Mapping[str, Any]) -> AxisList:
        """Open the axis list."""
        return AxisList(path, given["axis"], given["name"])

    def prepare(self) -> None:
        """Look at the mode."""
        super().prepare()
        self.mode = self.target.values.integer(MODE) or NEGATIVE

    def table_of(self, compensation: Backlash) -> Backlash:
        """Return what is compensated already."""
        return compensation

    def table(self, means: Positioning) -> Backlash:
        """Return the backlash as a list holds it."""
        amount = -float(np.mean(_reversal(means))) / shown(self.unit).factor
        before = 0.0 if self.old is None else self.old.amount
        return Backlash(float(rounded(np.array(amount + before))), self.mode)

    def removed(self, table: Backlash, readings: Positioning) -> Array:
        """Return what the drive going further takes off: what is added to the setpoint, with the other sign."""
        amount = shown(self.unit).factor * table.amount
        shifted = (readings.directions < 0) if table.mode == NEGATIVE else (readings.directions > 0)
        return np.where(shifted, amount if table.mode == NEGATIVE else -amount, 0.0)

    def compensation(self, table: Backlash) -> Backlash:
        """Return the table, which is one."""
        return table

    def deviation(self, table: Backlash) -> float:
        """Return the largest reversal value that is left at a target."""
        means = self.means(self.readings)
        return float(np.max(np.abs(_reversal(replace(means, deviations=self.left(table, means))))))

    def report(self, table: Backlash) -> Report:
        """Say how well the backlash is known, and how alike it is at the targets."""
        values, each = -_reversal(self.means(self.readings)), self._uncertainties()
        count, mean = len(values), float(values.mean())
        far = float(np.max(np.abs(values - mean))) > max(_SPREAD * abs(mean), np.nan_to_num(each).max())
        if np.isnan(each).any():
            # A target without repetitions: what all of them scatter by around their mean.
            each = np.full(count, COVERAGE * np.std(values, ddof=1) if count > 1 else np.nan)
        uncertainty = float(np.sqrt(np.sum(each**2))) / count
        known = "" if np.isnan(uncertainty) else f" (U = {uncertainty:.2f} {self.small}, k = {COVERAGE:g})"
        unknown = abs(mean) <= uncertainty
        leadscrew = None if self.target.axis is None else self.target.axis.leadscrew
        after = "negative" if table.mode == NEGATIVE else "positive"
        amount = shown(self.unit).factor * table.amount
        sentences = (
            f"The measured backlash is {mean:.2f} {self.small}{known}; "
            f"at the targets it is from {values.min():.2f} to {values.max():.2f} {self.small}.",
            f"In mode {table.mode} the drive goes {amount:.1f} {self.small} further after {after} motion; "
            f"a reversal value of {self.deviation(table):.2f} {self.small} at most is left.",
        )
        details = {
            "mode": table.mode,
            "backlash": amount,
            "measured": mean,
            "uncertainty": None if np.isnan(uncertainty) else uncertainty,
            "reversal_values": (-values).tolist(),
        }
        return Report(sentences, super().report(table).notes, details=details).noted(
            self.readings.details.get(_NOTES, ""),
            "The backlash differs much over the targets: a bilateral leadscrew table would leave less." if far else "",
            "The backlash is within its uncertainty: there may be none." if unknown else "",
            "The backlash is below 0: are the directions of the measurement right?"
            if mean < 0.0 and not unknown
            else "",
            "A bilateral leadscrew table takes a reversal error off too: had it not acted during the measurement, both "
            "together would do so twice."
            if leadscrew is not None and leadscrew.negative is not None
            else "",
        )

    def _uncertainties(self) -> Array:
        """Return the expanded uncertainty of each target's reversal value from the scatter of its readings."""
        result = evaluate(self.readings)
        known = ~np.isnan(result.reversal)
        with np.errstate(divide="ignore", invalid="ignore"):
            squares = result.s_up**2 / result.count_up + result.s_down**2 / result.count_down
        return np.asarray(COVERAGE * np.sqrt(squares[known]))


def _reversal(means: Positioning) -> Array:
    """Return B = x̄↑ − x̄↓ at each target."""
    up, down = means.deviations.reshape(2, -1)
    return np.asarray(up - down)


FIT = BacklashFit
