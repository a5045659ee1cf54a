"""The inputs before anybody sets them: referenced, and enabled what activates automatically."""

from __future__ import annotations

from .records import Inputs, Tables


def set_initial_inputs(tables: Tables, inputs: Inputs) -> None:
    """Set inputs that are all 0 to what they are at the start."""
    for i in range(tables.axis_count):
        table = tables.axis[i]
        given = inputs.axis[i]
        given.referenced = True
        given.cross_enable = table.cross.switching.configured and not table.cross.switching.manual
        given.plane_enable = table.plane.switching.configured and not table.plane.switching.manual
        given.crosstalk_enable = table.crosstalk.switching.configured and not table.crosstalk.switching.manual
        given.leadscrew_enable = table.leadscrew.switching.configured and not table.leadscrew.switching.manual
        given.friction_enable = table.friction.switching.configured and not table.friction.switching.manual
    for k in range(tables.volumetrics):
        inputs.volumetric[k].enable = tables.volumetric[k].configured and not tables.volumetric[k].manual
        inputs.volumetric[k].factor_x = 1.0
        inputs.volumetric[k].factor_y = 1.0
        inputs.volumetric[k].factor_z = 1.0
