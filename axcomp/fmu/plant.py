"""The variables of the plant's FMU, from the declarations that its slave uses."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

from ..measurement.simulated import load_plant
from .archive import BuildError
from .variable import Variable
from .variables import identifier


def read_plant(folder: Path) -> tuple[tuple[Variable, ...], Path]:
    """Return the variables of the plant in a model's folder, and the file that describes it.

    Raises
    ------
    BuildError
        If the file is missing or wrong.
    """
    try:
        plant: Any = load_plant(folder)
    except ValueError as error:
        raise BuildError(str(error)) from None
    declared: Any = importlib.import_module("plant_model.variables")
    file_name: str = importlib.import_module("plant_model.machine").FILE_NAME
    present = [d for d in declared.OF_AXIS if not d.of_bodies or plant.bodies]
    variables = [
        Variable(
            f"{identifier(name)}.{declaration.name}",
            declared.BLOCK * index + declared.OF_AXIS.index(declaration),
            declaration.causality,
            0.0,
            declaration.description,
            declaration.unit.format(unit),
            depends_on=None,
            axis=index,
        )
        for index, (name, unit) in enumerate(zip(plant.names, plant.units, strict=True))
        for declaration in present
    ]
    if plant.bodies:
        first = declared.BLOCK * len(plant.names)
        variables += [
            Variable(d.name, first + place, d.causality, 0.0, d.description, d.unit, depends_on=None)
            for place, d in enumerate(declared.OF_MACHINE)
        ]
    return tuple(variables), folder / file_name
