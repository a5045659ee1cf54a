"""A machine to try compensations on: drives with friction and elastic, geometric errors, in the standard library only.

Independent of the compensation itself, which it must not import: its errors are smooth functions, not tables.
Positions are in mm or °, velocities and accelerations in these per s and s², currents in mA.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .drawing import drawn as drawn
    from .fmu import package_plant as package_plant, plant_variables as plant_variables
    from .machine import MEMORYLESS as MEMORYLESS, REMEMBERING as REMEMBERING, Plant as Plant, PlantError as PlantError
    from .simulated import (
        CYCLE_TIME as CYCLE_TIME,
        acceleration_test as acceleration_test,
        circle_setpoints as circle_setpoints,
        circular_test as circular_test,
        deviation as deviation,
        flatness as flatness,
        friction_current as friction_current,
        load_plant as load_plant,
        positioning as positioning,
        straightness as straightness,
    )
    from .simulated_volume import (
        IsoErrors as IsoErrors,
        linear_axis_errors as linear_axis_errors,
        table_errors as table_errors,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        drawing="drawn",
        fmu="package_plant plant_variables",
        machine="MEMORYLESS Plant PlantError REMEMBERING",
        simulated="CYCLE_TIME acceleration_test circle_setpoints circular_test deviation flatness friction_current "
        "load_plant positioning straightness",
        simulated_volume="IsoErrors linear_axis_errors table_errors",
    )
