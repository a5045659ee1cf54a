"""The inputs before anybody sets them: referenced, and enabled what activates automatically."""

from __future__ import annotations

from .compensations import KINDS, begin_inputs
from .records import Inputs, Tables


def set_initial_inputs(tables: Tables, inputs: Inputs) -> None:
    """Set inputs that are all 0 to what they are at the start."""
    for i in range(tables.axis_count):
        table = tables.axis[i]
        given = inputs.axis[i]
        given.referenced = True
        for kind in range(KINDS):
            given.enable[kind] = table.switching[kind].reserved > 0 and not table.switching[kind].manual
        begin_inputs(table.compensation, given.compensation)
    for k in range(tables.volumetrics):
        inputs.volumetric[k].enable = tables.volumetric[k].configured and not tables.volumetric[k].manual
        inputs.volumetric[k].factor_x = 1.0
        inputs.volumetric[k].factor_y = 1.0
        inputs.volumetric[k].factor_z = 1.0
