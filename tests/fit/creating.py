"""Measurements on the example plant with scatter, and the example's lists to put tables into."""

import shutil
from functools import cache
from pathlib import Path

import numpy as np

from axcomp.measurement import Positioning
from axcomp.model import models
from axcomp.plant import MEMORYLESS, load_plant, positioning

THREE_AXIS = models() / "three_axis"


@cache
def plant():
    return load_plant(THREE_AXIS, choice=MEMORYLESS)


def copied_lists(folder: Path, *, plane: bool = False) -> Path:
    """Copy the lists of the example machine, without its long plane table if that is not needed."""
    folder.mkdir()
    for file in THREE_AXIS.glob("*.lis"):
        shutil.copy(file, folder)
    if not plane:
        for name, prefix in (("achskw1.lis", "kw.crosscomp2."), ("achsmd1.lis", "lr_param.crosscomp2")):
            lines = (folder / name).read_text().splitlines()
            (folder / name).write_text("\n".join(line for line in lines if not line.startswith(prefix)) + "\n")
    return folder


def measured(targets, curves, runs=5, scatter=0.0, seed=1, **more) -> Positioning:
    """Make a measurement of mean deviations (µm) by direction, each reading with normal scatter."""
    random = np.random.default_rng(seed)
    rows = [
        (target, run, direction, deviation + random.normal(0.0, scatter))
        for direction, curve in curves.items()
        for run in range(1, runs + 1)
        for target, deviation in zip(targets, curve, strict=True)
    ]
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    return Positioning(columns[0], columns[1].astype(int), columns[2].astype(int), columns[3], **more)


def positioning_of(axis, targets, **options) -> Positioning:
    """Measure an axis of the example plant in both directions."""
    curves = {d: np.array(positioning(plant(), axis, targets.tolist(), d)) * 1e3 for d in (1, -1)}
    return measured(targets, curves, axis=axis, **options)
