"""Machines and measurements to be judged."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np

from axcomp.analysis.judgement import Judgement, judge
from axcomp.kinds import Cross, Leadscrew, Plane
from axcomp.lists import read_machine
from axcomp.measurement import Positioning
from axcomp.model import Axis, AxisType, Machine, ModuloRange, models
from axcomp.plant import load_plant, positioning, straightness

THREE_AXIS = models() / "three_axis"


def leadscrew_machine(positions: Sequence[float], values: Sequence[float], **more) -> Machine:
    """Return an axis X with a leadscrew table: actual − programmed, mm."""
    return Machine((Axis(1, "X", leadscrew=Leadscrew(tuple(positions), tuple(values), **more)),))


def cross_machine(positions: Sequence[float], values: Sequence[float], **more) -> Machine:
    return Machine((Axis(1, "X", cross=Cross(2, tuple(positions), tuple(values), **more)), Axis(2, "Y")))


def plane_machine(values, **more) -> Machine:
    rows = tuple(tuple(float(v) for v in row) for row in values)
    return Machine((Axis(1, "X", plane=Plane(2, 3, 0.0, 0.0, 10.0, 20.0, rows, **more)), Axis(2, "Y"), Axis(3, "Z")))


def table_of_c(positions: Sequence[float], values: Sequence[float], modulo: bool = True) -> Machine:
    screw = Leadscrew(tuple(positions), tuple(values), modulo=modulo)
    return Machine((Axis(1, "C", AxisType.ROTARY, ModuloRange(), leadscrew=screw),))


def codes(machine: Machine, path: Path | None = None, **evidence) -> list[str]:
    return [
        finding.code for finding in judge(machine, None if path is None else read_machine(path), **evidence).findings
    ]


def said(judgement: Judgement, code: str) -> str:
    """Return the sentence of the only finding with a code."""
    [message] = [finding.message for finding in judgement.findings if finding.code == code]
    return message


@cache
def example() -> Machine:
    return read_machine(THREE_AXIS).machine


@cache
def measured(axis: str, over: str | None = None) -> Positioning:
    """Measure the example plant between the points of its tables, compensation off, three runs with scatter."""
    plant = load_plant(THREE_AXIS, choice="memoryless")
    random = np.random.default_rng(5)
    targets = {
        "X": np.linspace(-487.0, 488.0, 40),
        "Y": np.linspace(-293.0, 291.0, 33),
        "Z": np.linspace(-391.0, -3.0, 30),
    }
    places = targets[over or axis]
    rows = []
    for direction in (1, -1):
        if over is None:
            deviations = positioning(plant, axis, places.tolist(), direction)
        else:
            deviations = straightness(plant, axis, over, places.tolist())
        for run in (1, 2, 3):
            rows += [
                (t, run, direction, 1e3 * d + random.normal(0.0, 0.2)) for t, d in zip(places, deviations, strict=True)
            ]
    target, run, direction, deviation = (np.array(column) for column in zip(*rows, strict=True))
    more = {} if over is None else {"deviating_unit": "mm"}
    return Positioning(target, run.astype(int), direction.astype(int), deviation, axis=axis, source="measured", **more)
