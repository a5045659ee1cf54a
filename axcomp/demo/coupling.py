"""Both FMUs in one co-simulation, run by ``python -m axcomp.demo.coupling JOB`` in a process of its own.

The compensation computes corrected setpoints and currents, the plant moves, its measured positions go back. Both make
the same communication steps side by side, so what one puts out at the end of a step reaches the other in the next one:
this delay of one step is inherent to co-simulation, as it is to a fieldbus.
"""

from __future__ import annotations

import ctypes
import json
import sys
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave

from ..engine.motion import Array

COMPENSATION, PLANT = "axcomp", "plant"
COMMANDS = ("setpoint", "velocity", "acceleration")


@dataclass(frozen=True)
class Job:
    """What a process has to do; its arrays lie beside it in ``inputs.npz`` and ``results.npz``.

    Attributes
    ----------
    axes : tuple of str
        Names of the axes in the variables of both FMUs.
    currents : tuple of str
        Those with friction compensation.
    cycle_time : float
        Communication step, s.
    off : tuple of tuple of str
        For each run the ``enable`` inputs that are false.
    tool_length : float or None
        mm; None: the plant knows no tool tip.
    """

    axes: tuple[str, ...]
    currents: tuple[str, ...]
    cycle_time: float
    off: tuple[tuple[str, ...], ...]
    tool_length: float | None = None


class Recorded(NamedTuple):
    """What a run shows at the end of each step, all in mm or °.

    Attributes
    ----------
    true, lag : array, shape (cycles, axes)
        True positions and following errors.
    tip : array, shape (cycles, 3)
        Error of the tool tip in the workpiece's coordinates; shape (cycles, 0) for a plant that knows none.
    """

    true: Array
    lag: Array
    tip: Array


class Instance:
    """An instance of an unpacked FMU."""

    def __init__(self, folder: Path) -> None:
        description = read_model_description(folder, validate=False)
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu: Any = FMU2Slave(
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=description.modelName,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()

    def reals(self, names: Iterable[str]) -> Reals:
        """Return access to Real variables."""
        return Reals(self.fmu, [self.references[name] for name in names])

    def switch_off(self, names: Iterable[str]) -> None:
        """Set Boolean inputs to false."""
        references = [self.references[name] for name in names]
        if references:
            self.fmu.setBoolean(references, [False] * len(references))

    def close(self) -> None:
        """End the instance."""
        self.fmu.terminate()
        self.fmu.freeInstance()


class Reals:
    """Some Real variables of an instance, in arrays that are allocated once."""

    def __init__(self, fmu: Any, references: Sequence[int]) -> None:
        self.fmu = fmu
        self.count = len(references)
        self.references = (ctypes.c_uint * self.count)(*references)
        self.values: Any = (ctypes.c_double * self.count)()

    def set(self, values: list[float]) -> None:
        """Set all of them."""
        self.values[:] = values
        self.fmu.fmi2SetReal(self.fmu.component, self.references, self.count, self.values)

    def get(self) -> list[float]:
        """Return all of them."""
        self.fmu.fmi2GetReal(self.fmu.component, self.references, self.count, self.values)
        values: list[float] = self.values[:]
        return values


def couple(folder: Path, job: Job, commands: Array, off: Sequence[str]) -> Recorded:
    """Run both FMUs from rest to the end of the commands.

    Parameters
    ----------
    folder : Path
        Holds the unpacked FMUs ``axcomp`` and ``plant``.
    job : Job
        Axes and step size.
    commands : array, shape (cycles, 3 · axes)
        Setpoints, velocities, accelerations of all axes.
    off : sequence of str
        ``enable`` inputs that are false.
    """
    compensation, plant = Instance(folder / COMPENSATION), Instance(folder / PLANT)
    axes = job.axes
    given = compensation.reals(f"{axis}.{name}" for name in COMMANDS for axis in axes)
    actual = compensation.reals(f"{axis}.actual_position" for axis in axes)
    corrected = compensation.reals(
        [f"{axis}.corrected_setpoint" for axis in axes] + [f"{axis}.current" for axis in job.currents]
    )
    driven = plant.reals([f"{axis}.setpoint" for axis in axes] + [f"{axis}.current" for axis in job.currents])
    measured = plant.reals(f"{axis}.measured_position" for axis in axes)
    positions = [f"{axis}.{name}" for name in ("true_position", "following_error") for axis in axes]
    tips = [] if job.tool_length is None else [f"tcp.{prefix}{k}" for prefix in ("", "nominal_") for k in "xyz"]
    meant = plant.reals(f"{axis}.commanded_position" for axis in axes if tips)
    shown = plant.reals(positions + tips)

    rows = commands.tolist()
    if job.tool_length is not None:
        for instance in (compensation, plant):
            instance.reals(["tool_length"]).set([job.tool_length])
    compensation.switch_off(off)
    given.set(rows[0])
    actual.set(rows[0][: len(axes)])
    compensation.fmu.exitInitializationMode()
    driven.set(corrected.get())
    plant.fmu.exitInitializationMode()

    recorded = np.empty((len(rows), len(positions) + len(tips)))
    for cycle, row in enumerate(rows):
        time = cycle * job.cycle_time
        given.set(row)
        actual.set(measured.get())
        driven.set(corrected.get())
        meant.set(row[: meant.count])
        compensation.fmu.doStep(time, job.cycle_time)
        plant.fmu.doStep(time, job.cycle_time)
        recorded[cycle] = shown.get()
    compensation.close()
    plant.close()
    true, lag, tip = np.split(recorded, [len(axes), 2 * len(axes)], axis=1)
    half = len(tips) // 2
    return Recorded(true, lag, tip[:, :half] - tip[:, half:])


def write_job(place: Path, job: Job, commands: Sequence[Array]) -> None:
    """Write a job and the commands of its runs."""
    place.mkdir(parents=True, exist_ok=True)
    (place / "job.json").write_text(json.dumps(asdict(job)), encoding="utf-8")
    arrays: dict[str, Any] = {str(run): rows for run, rows in enumerate(commands)}
    np.savez(place / "inputs.npz", **arrays)


def read_results(place: Path) -> list[Recorded]:
    """Return what each run has recorded; FileNotFoundError if there is nothing."""
    with np.load(place / "results.npz") as arrays:
        runs = range(len(arrays.files) // len(Recorded._fields))
        return [Recorded(*(arrays[f"{name}{run}"] for name in Recorded._fields)) for run in runs]


def main(place: Path) -> None:
    """Do a job that lies in a folder beside those of the FMUs."""
    values = json.loads((place / "job.json").read_text(encoding="utf-8"))
    lists = {name: tuple(values.pop(name)) for name in ("axes", "currents")}
    job = Job(**values | lists | {"off": tuple(map(tuple, values["off"]))})
    results: dict[str, Any] = {}
    with np.load(place / "inputs.npz") as inputs:
        for run, off in enumerate(job.off):
            recorded = couple(place.parent, job, inputs[str(run)], off)
            results.update((f"{name}{run}", values) for name, values in recorded._asdict().items())
    # Complete before the process ends: ending an embedded interpreter is where it may fail.
    unfinished = place / "unfinished.npz"
    np.savez(unfinished, **results)
    unfinished.replace(place / "results.npz")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
