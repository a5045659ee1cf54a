"""The plant's FMU: its variables, from the declarations that its slave uses, and its package."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from .. import __version__
from ..fmu import PACKAGE, BuildError, Description, accompanying, file_bytes, generation_date, write_python_fmu
from ..interface import Variable, identifier
from ..model import fmu_sources
from . import variables as declared
from .machine import FILE_NAME, Plant

STEP_SIZE = 0.001


def plant_variables(folder: Path) -> tuple[Variable, ...]:
    """Return the variables of the plant in a model's folder.

    Raises
    ------
    BuildError
        If the file is missing or wrong.
    """
    try:
        plant = Plant.from_file(folder / FILE_NAME)
    except ValueError as error:
        raise BuildError(str(error)) from None
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
            Variable(d.name, first + offset, d.causality, 0.0, d.description, d.unit, depends_on=None)
            for offset, d in enumerate(declared.OF_MACHINE)
        ]
    return tuple(variables)


def package_plant(
    model: str | os.PathLike[str], output: str | os.PathLike[str], *, external_tool: bool = True, **instead: Any
) -> Path:
    """Write the FMU of the plant that ``plant.json`` in a model's folder describes; a folder: ``plant.fmu`` in it.

    ``instead``: entries of the description that are others, ``seed`` and ``choice`` say.

    Raises
    ------
    BuildError
        If the description is missing or wrong, pythonfmu is missing, or the file cannot be written.
    """
    variables = plant_variables(Path(model))
    data = file_bytes(Path(model) / FILE_NAME)
    if instead:
        data = json.dumps({**json.loads(data), **instead}, indent=1).encode()
    description = Description(
        name="plant",
        text="Drives, friction and geometric errors of a machine",
        step_size=STEP_SIZE,
        version=__version__,
        generated=generation_date(),
        capabilities={"needsExecutionTool": external_tool},
    )
    sources = (fmu_sources() / "plant_slave.py", PACKAGE)
    shown = accompanying(description, variables)
    return write_python_fmu(output, description, variables, sources, {FILE_NAME: data}, shown)
