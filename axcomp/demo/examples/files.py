"""The files of an example machine that are not written by hand."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ...engine import Array, Engine
from ...lists import write_machine
from ...plant import MEMORYLESS, load_plant
from ...saving import write_whole
from .machines import MACHINES
from .trajectories import TRAJECTORIES

INPUT, EXPECTED = "input.csv", "expected.csv"
DECIMALS = 9
"""Of all numbers in these files: 1e-9 mm or °."""


def write_lists(model: Path, folder: Path) -> list[Path]:
    """Measure the plant of a model and write its lists into a folder; nothing for a model without a plant.

    The plant is the memoryless one: careful measurements wait until a structure is calm, and take means of directions.
    """
    make = MACHINES.get(model.name)
    return [] if make is None else write_machine(make(load_plant(model, choice=MEMORYLESS)), folder)


def write_input(model: Path, folder: Path) -> Path:
    """Write ``input.csv`` as FMPy reads it: the inputs at each instant."""
    return _write(folder / INPUT, TRAJECTORIES[model.name]())


def write_expected(model: Path, folder: Path) -> Path:
    """Write ``expected.csv``: what FMPy records of the FMU on ``input.csv``, which lies in ``folder`` too.

    The row of an instant holds the outputs at the end of the step before it, which belong to the inputs at its
    beginning; the first row those computed at the end of initialization.
    """
    inputs = read_csv(folder / INPUT)
    result = Engine(model).run(inputs)
    columns = {"time": inputs["time"]}
    for name, values in result.items():
        columns[name] = np.concatenate([values[:1], values[:-1]])
    return _write(folder / EXPECTED, columns)


def read_csv(path: Path) -> dict[str, Array]:
    """Return the columns of a file that ``write_input`` or ``write_expected`` wrote, shape (rows,)."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    columns = np.array(rows, dtype=float).T
    return dict(zip(header, columns, strict=True))


def _write(path: Path, columns: Mapping[str, Any]) -> Path:
    rows = [",".join(f'"{name}"' for name in columns)]
    rounded = [[_text(value) for value in np.asarray(values, dtype=float).tolist()] for values in columns.values()]
    rows += [",".join(row) for row in zip(*rounded, strict=True)]
    write_whole(path, "\n".join(rows) + "\n")
    return path


def _text(value: float) -> str:
    return f"{round(value, DECIMALS) + 0.0:.{DECIMALS}f}".rstrip("0").rstrip(".")
