"""Traces as a controller records them: German CSV, nm setpoints, corrections rounded to 0.1 µm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from axcomp.analysis.replay import Comparison, compare, read_trace
from axcomp.engine import Engine, read_input
from axcomp.lists import read_machine
from axcomp.model import Compensation, Machine, models

Columns = dict[str, NDArray[Any]]

DECIMALS = {"setpoint": 6, "velocity": 9, "acceleration": 9, "current": 0}
"""Digits behind the comma; all that is not here has 4, which is 0.1 µm."""


def example(name: str = "three_axis") -> tuple[Machine, Columns]:
    """Return an example machine and its input, without the columns of a measurement."""
    given = read_input(models() / name / "input.csv")
    columns = {name: values for name, values in given.columns.items() if not name.endswith("actual_position")}
    return read_machine(models() / name).machine, columns


def having(machine: Machine, name: str, *compensations: Compensation, **changes: Any) -> Machine:
    """Return a machine, one axis of which has other compensations or fields."""
    changed = replace(machine.axis(name), **changes)
    for one in compensations:
        changed = changed.having(one)
    return replace(machine, axes=tuple(changed if axis.name == name else axis for axis in machine.axes))


def recorded(machine: Machine, columns: Columns, *outputs: str) -> Columns:
    """Return what a controller with this machine would record."""
    result = Engine(machine).run(columns)
    return {**columns, **{name: result[name].astype(float) for name in outputs}}


def write_german(path: Path, columns: Mapping[str, NDArray[Any]], encoding: str = "utf-8") -> None:
    """Write columns with semicolons and decimal commas, rounded; time in ms."""
    cycles = len(next(iter(columns.values())))
    cells = [["Zeit [ms]", *(str(n) for n in range(cycles))]]
    for name, values in columns.items():
        digits = DECIMALS.get(name.rpartition(".")[2].strip("]"), 4)
        cells.append([name, *(f"{value:.{digits}f}".replace(".", ",") for value in values)])
    path.write_bytes("".join(";".join(row) + "\r\n" for row in zip(*cells, strict=True)).encode(encoding))


def compared(folder: Path, machine: Machine, columns: Columns, **options: Any) -> dict[str, Comparison]:
    """Write a trace, read it again, and compare it with a machine."""
    write_german(folder / "trace.csv", columns)
    trace = read_trace(folder / "trace.csv", machine, ["time=Zeit"])
    return {one.output: one for one in compare(trace, machine, **options)[0]}


def best(one: Comparison) -> str:
    """Return the best explanation, which leaves only what rounding makes."""
    assert not one.agrees
    assert one.explanations, one.sentence()
    assert one.explanations[0].left <= 0.2 * one.largest
    return one.explanations[0].text
