"""Trajectories for the host program's command ``replay``, and what the Python engine makes of them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from axcomp import Engine, Machine
from axcomp.interface import Variable, variables_of
from axcomp.model import CYCLE_TIME

Columns = Mapping[str, NDArray[Any]]
NOT_GIVEN = ("reload",)


def motion(machine: Machine, source: Generator, cycles: int) -> dict[str, NDArray[Any]]:
    """Motions that stop and turn, commands now and then, and an input that is not finite, for every input."""
    columns: dict[str, NDArray[Any]] = {}
    sections = cycles // 40 + 1
    for variable in _of(machine, "input"):
        if isinstance(variable.start, bool):
            switched = (source.random(cycles) < 0.003).cumsum() % 2 == 1
            columns[variable.name] = switched != variable.start
        elif isinstance(variable.start, int):
            columns[variable.name] = source.choice([-1, 0, 1, 1, 0, 9], sections)[np.arange(cycles) // 40]
        elif variable.field == "setpoint":
            speed = np.repeat(source.normal(0, 0.08, sections) * (source.random(sections) > 0.25), 40)[:cycles]
            columns[variable.name] = speed.cumsum() + source.normal(0, 100)
        else:
            columns[variable.name] = source.normal(0, 100, cycles) * (source.random(cycles) < 0.9)
    reals = [name for name, column in columns.items() if column.dtype == np.float64]
    # Not in the first cycle: the FMU then holds what it had at the end of initialization, the engine nothing.
    columns[source.choice(reals)][source.integers(1, cycles)] = source.choice([np.nan, np.inf, -np.inf])
    return columns


def _of(machine: Machine, causality: str) -> list[Variable]:
    return [v for v in variables_of(machine) if v.causality == causality and v.name not in NOT_GIVEN]


def _typed(machine: Machine, causality: str, kind: type) -> list[Variable]:
    return [v for v in _of(machine, causality) if type(v.start) is kind]


def write_trajectory(path: Path, machine: Machine, columns: Columns) -> None:
    """Write a trajectory as ``replay`` reads it; inputs without a column keep their start."""
    given = [v for kind in (float, bool, int) for v in _typed(machine, "input", kind)]
    wanted = [v for kind in (float, int, bool) for v in _typed(machine, "output", kind)]
    rows = len(next(iter(columns.values())))
    counts = [rows, *(len(_typed(machine, "input", kind)) for kind in (float, bool, int))]
    counts += [len(_typed(machine, "output", kind)) for kind in (float, int, bool)]
    references = [v.reference for v in (*given, *wanted)]
    values = np.column_stack([np.broadcast_to(columns.get(v.name, v.start), rows).astype(np.float64) for v in given])
    with path.open("wb") as file:
        file.write(np.array([*counts, *references], "<u4").tobytes())
        file.write(np.array(CYCLE_TIME, "<f8").tobytes())
        file.write(values.astype("<f8").tobytes())


def expected_results(machine: Machine, columns: Columns) -> bytes:
    """Return what ``replay`` must write: all outputs of the engine as doubles, row by row."""
    result = Engine(machine).run({name: column for name, column in columns.items() if name not in NOT_GIVEN})
    wanted = [v for kind in (float, int, bool) for v in _typed(machine, "output", kind)]
    return np.column_stack([result[v.name].astype("<f8") for v in wanted]).tobytes()
