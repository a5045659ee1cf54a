"""Seams: where a round axis begins again, its corrections must lead on.

A modulo table that is shorter than the range is closed by a straight line from its last point to its first one
(semantics §5): the line must not be much steeper than the table itself. One that is as long steps where its ends
differ, and so does any other table over a round axis, for its ends are held.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...lists.findings import Findings
from ...model.machine import Machine
from .curves import PER_MILLE, Curve, curves_of, thousandth_of, unit_of
from .positions import Positions

STEEPER = 3.0
"""From this ratio on of the slope over the gap to the steepest one of the table, the gap is doubtful."""
STEP_LEAST = 1e-3
"""Smallest step, or change over the gap, that is worth a finding, mm or °."""


class Seam(NamedTuple):
    """What happens where a round axis begins again.

    Attributes
    ----------
    at : float
        Where the gap, or the step, begins, mm or °.
    gap : float
        Its width; 0: a step.
    change : float
        Of what is added, over the gap, mm or °.
    ratio : float
        Slope over the gap divided by the steepest one elsewhere; infinite for a step and where the table is flat.
    """

    at: float
    gap: float
    change: float
    ratio: float

    @property
    def doubtful(self) -> bool:
        """Whether it is worth a finding."""
        return abs(self.change) >= STEP_LEAST and self.ratio > STEEPER


def seam_of(curve: Curve) -> Seam | None:
    """Return the seam of a table, None if the position it is looked up at does not begin again."""
    x, y = np.array(curve.table.positions), np.array(curve.table.curve(curve.direction or 1))
    if curve.table.period is not None:
        gap = curve.table.period - float(x[-1] - x[0])
        change = float(y[0] - y[-1])
        if gap <= 1e-9:
            return Seam(float(x[-1]), 0.0, change, np.inf)
        slopes = np.abs(np.diff(y) / np.diff(x))
        steepest = float(slopes.max()) if slopes.size else 0.0
        return Seam(float(x[-1]), gap, change, abs(change) / gap / steepest if steepest else np.inf)
    modulo = curve.over.modulo
    if modulo is None:
        return None
    before, behind = np.interp([modulo.end, modulo.start], x, y)
    return Seam(modulo.end, 0.0, float(behind - before), np.inf)


def judge_seams(machine: Machine, positions: Positions, findings: Findings) -> None:
    """Note doubtful seams of all leadscrew and cross tables."""
    for curve in curves_of(machine):
        seam = seam_of(curve)
        if seam is None or not seam.doubtful:
            continue
        position, unit = unit_of(curve.over), thousandth_of(curve.axis)
        change = f"{PER_MILLE * seam.change:+.1f} {unit}"
        if seam.gap:
            table = f"{seam.ratio:.1f} times as steep as any part of" if np.isfinite(seam.ratio) else "unlike"
            message = (
                f"From the last point at {seam.at:g} {position} the correction changes by {change} over "
                f"{seam.gap:g} {position} to the first one, {table} {curve.name}."
            )
        else:
            where = f"where {curve.over.name} begins again at {seam.at:g} {position}"
            message = f"The correction steps by {change} {where}, by {curve.name}."
        at = positions.of_table(curve.axis.number, curve.entry, len(curve.table.positions) - 1)
        findings.add("AXC-SEAM", *at, message)
