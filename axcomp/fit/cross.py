"""Cross tables from positioning measurements: minus the deviation of the slave over the position of the master."""

from __future__ import annotations

from functools import partial
from typing import ClassVar

import numpy as np

from ..kinds import Cross
from ..measurement import read_positioning
from ..model import shown
from .driver import ON_TOP, axis_numbers, rounded
from .over_position import SidedFit, Sides

_MASTER = "kw.crosscomp.master_ax_nr"


class CrossFit(SidedFit):
    """A table in the list of the slave.

    Targets are positions of the master. The table knows no direction: what differs by direction is left.
    """

    name = "cross"
    meaning = "cross (sag) table from the deviation of a slave over a master"
    columns = "columns target (of the master), run, direction, deviation (of the slave; mm, µm)"
    example = "axcomp create cross --from sag.csv --into achskw3.lis --master 1"
    arguments: ClassVar = {**SidedFit.arguments, "on-top": ON_TOP, "master": axis_numbers("number of the master", 1)}
    read = staticmethod(partial(read_positioning, of_another_axis=True))
    shown_as = "table × (−1)"

    def prepare(self) -> None:
        """Look which axis is the master."""
        lacking = f"axis is the master ({_MASTER})"
        self.master = self.axis_number(self.options.masters, 0, _MASTER, lacking)
        super().prepare()

    def table_of(self, compensation: Cross) -> Sides:
        """Return the errors that a table of the list takes off: its corrections with the other sign."""
        values = -shown(self.unit).factor * np.tile(compensation.corrections, (2, 1))
        return self.sides(np.array(compensation.positions), values)

    def compensation(self, table: Sides) -> Cross:
        """Return the corrections in mm or °."""
        corrections = rounded(-np.array(table[0].y) / shown(self.unit).factor)
        return Cross(self.master, table[0].x, tuple(corrections.tolist()))


FIT = CrossFit
