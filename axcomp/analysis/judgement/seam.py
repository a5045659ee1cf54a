"""Seams: where a round axis begins again, its corrections must lead on.

A modulo table that is shorter than the range is closed by a straight line from its last point to its first one
(semantics §5): the line must not be much steeper than the table itself. One that is as long steps where its ends
differ, and so does any other table over a round axis, for its ends are held.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ...kinds import tables_of
from ...lists import Findings
from ...model import Curve, Machine, ModuloRange
from .positions import Positions

STEEPER = 3.0
"""From this ratio on of the slope over the gap to the steepest one of the table, the gap is doubtful."""
STEP_LEAST = 1e-3
"""Smallest step, or change over the gap, that is worth a finding, mm or °."""


class Seam(NamedTuple):
    """What happens where a round axis begins again.

    The gap, or the step where its width is 0, begins at ``at``, mm or °; ``change`` is that of what is added over it,
    mm or °. ``ratio``: slope over the gap by the steepest one elsewhere; infinite for a step and in a flat table.
    """

    at: float
    gap: float
    change: float
    ratio: float

    @property
    def doubtful(self) -> bool:
        """Whether it is worth a finding."""
        return abs(self.change) >= STEP_LEAST and self.ratio > STEEPER


def seam_of(curve: Curve, modulo: ModuloRange | None) -> Seam | None:
    """Return the seam of what a table adds, None if its position does not begin again; ``modulo``: of that axis."""
    added = curve.added()
    if curve.period is not None:
        gap = curve.period - curve.span
        change = added.y[0] - added.y[-1]
        if gap <= 1e-9:
            return Seam(curve.x[-1], 0.0, change, math.inf)
        steepest = max(map(abs, added.slopes()), default=0.0)
        return Seam(curve.x[-1], gap, change, abs(change) / gap / steepest if steepest else math.inf)
    if modulo is None:
        return None
    return Seam(modulo.end, 0.0, added.at(modulo.start) - added.at(modulo.end), math.inf)


def judge_seams(machine: Machine, positions: Positions, findings: Findings) -> None:
    """Note doubtful seams of all tables over one position."""
    for tables in tables_of(machine):
        for curve in tables.curves:
            seam = seam_of(curve, machine.axis(curve.over.axis).modulo)
            if seam is None or not seam.doubtful:
                continue
            position, name = curve.over.unit, tables.named(curve)
            change = f"{curve.of.factor * seam.change:+.1f} {curve.of.scaled().unit}"
            if seam.gap:
                table = f"{seam.ratio:.1f} times as steep as any part of" if math.isfinite(seam.ratio) else "unlike"
                message = (
                    f"From the last point at {seam.at:g} {position} the correction changes by {change} over "
                    f"{seam.gap:g} {position} to the first one, {table} {name}."
                )
            else:
                where = f"where {curve.over.axis} begins again at {seam.at:g} {position}"
                message = f"The correction steps by {change} {where}, by {name}."
            findings.add("AXC-SEAM", *positions.of_table(tables.axis.number, curve.entry, len(curve.x) - 1), message)
