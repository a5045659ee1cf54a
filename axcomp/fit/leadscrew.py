"""Leadscrew tables from positioning measurements: actual − programmed, as the controller subtracts it."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ..kinds import Leadscrew
from ..model import shown
from .driver import ON_TOP, rounded
from .over_position import OverPosition, SidedFit, Sides

FULL_TURN = 360.0


class LeadscrewFit(SidedFit):
    """A table of an axis' own errors.

    Both directions measured give a bilateral table. Positions are those of the measurement, thinned where the list does
    not take so many or a bound allows fewer.
    """

    name = "leadscrew"
    meaning = "leadscrew table from a positioning measurement"
    columns = "Renishaw .rtl, or columns target, run, direction, deviation (mm, µm)"
    example = "axcomp create leadscrew --from x.rtl --into achskw1.lis --bound 0.5"
    arguments: ClassVar = {
        **OverPosition.arguments,
        "on-top": ON_TOP,
        "one-sided": {"action": "store_true", "help": "one curve for both directions, their mean"},
    }

    def prepare(self) -> None:
        """Look at the directions measured and at the modulo range where the list's table repeats with it."""
        self.both = not self.options.one_sided and set(self.readings.directions) == {1, -1}
        if self.target.values.flag("kw.ssfk.modulo"):
            modulo = None if self.target.axis is None else self.target.axis.modulo
            self.period = FULL_TURN if modulo is None else modulo.end - modulo.start
        super().prepare()

    def table_of(self, compensation: Leadscrew) -> Sides:
        """Return the errors that a table of the list takes off."""
        values = np.array((compensation.positive, compensation.negative or compensation.positive))
        period = self.period if compensation.modulo else None
        return self.sides(np.array(compensation.positions), shown(self.unit).factor * values, period)

    def compensation(self, table: Sides) -> Leadscrew:
        """Return the errors in mm or °."""
        up, down = (tuple(rounded(np.array(side.y) / shown(self.unit).factor).tolist()) for side in table)
        return Leadscrew(table[0].x, up, down if self.both else None)


FIT = LeadscrewFit
