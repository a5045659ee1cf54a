"""Both FMUs in one co-simulation, run by ``python -m axcomp.demo.coupling FOLDER`` in a process of its own.

The compensation computes corrected setpoints and currents, the plant moves, its measured positions go back. Both make
the same communication steps side by side, so what one puts out at the end of a step reaches the other in the next one:
this delay of one step is inherent to co-simulation, as it is to a fieldbus.
"""

from __future__ import annotations

import ctypes
import pickle
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave

from ..engine import Array
from ..saving import write_whole

COMPENSATION, PLANT = "axcomp", "plant"
COMMANDS = ("setpoint", "velocity", "acceleration")
BATCH, RESULTS = "batch.pickle", "results.pickle"
DONE = "done.txt"
"""What a process finds in its folder, and what it leaves there: what ``couple`` returns of each simulation."""


class Simulation(NamedTuple):
    """Setpoints, velocities and accelerations of all axes, shape (cycles, 3 · axes), and switches that are off.

    ``plant``: in which folder the plant's FMU is unpacked.
    """

    commands: Array
    off: tuple[str, ...]
    plant: str = PLANT


class Batch(NamedTuple):
    """What a process has to do.

    ``axes``: names in the variables of both FMUs; ``currents``: those with friction compensation; ``cycle_time``: the
    communication step, s; ``tool_length``: mm, None: the plant knows no tool tip.
    """

    axes: Sequence[str]
    currents: Sequence[str]
    cycle_time: float
    tool_length: float | None
    simulations: Sequence[Simulation]


class CoupledFmu:
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
        """Set switches to −1."""
        references = [self.references[name] for name in names]
        if references:
            self.fmu.setInteger(references, [-1] * len(references))

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


def couple(folder: Path, batch: Batch, simulation: Simulation) -> Array:
    """Run both FMUs, unpacked in folders of a folder, from rest to the end of the commands.

    Returns
    -------
    array, shape (cycles, 3 · axes), or (cycles, 3 · axes + 6) if the plant knows a tool tip
        At the end of each step: true positions, following errors, what of the errors no table holds, and the tip and
        where it should be in the workpiece's coordinates; all in mm or °.
    """
    compensation, plant = CoupledFmu(folder / COMPENSATION), CoupledFmu(folder / simulation.plant)
    axes = batch.axes
    given = compensation.reals(f"{axis}.{name}" for name in COMMANDS for axis in axes)
    actual = compensation.reals(f"{axis}.actual_position" for axis in axes)
    currents = [f"{axis}.current" for axis in batch.currents]
    corrected = compensation.reals([f"{axis}.corrected_setpoint" for axis in axes] + currents)
    driven = plant.reals([f"{axis}.setpoint" for axis in axes] + currents)
    measured = plant.reals(f"{axis}.measured_position" for axis in axes)
    names = [f"{axis}.{name}" for name in ("true_position", "following_error", "beyond_tables") for axis in axes]
    knows_tip = batch.tool_length is not None
    names += [f"tcp.{prefix}{k}" for prefix in ("", "nominal_") for k in "xyz" if knows_tip]
    meant = plant.reals(f"{axis}.commanded_position" for axis in axes if knows_tip)
    shown = plant.reals(names)

    rows = simulation.commands.tolist()
    if batch.tool_length is not None:
        for fmu in (compensation, plant):
            fmu.reals(["tool_length"]).set([batch.tool_length])
    compensation.switch_off(simulation.off)
    given.set(rows[0])
    actual.set(rows[0][: len(axes)])
    compensation.fmu.exitInitializationMode()
    driven.set(corrected.get())
    plant.fmu.exitInitializationMode()

    recorded = np.empty((len(rows), len(names)))
    for cycle, row in enumerate(rows):
        time = cycle * batch.cycle_time
        given.set(row)
        actual.set(measured.get())
        driven.set(corrected.get())
        meant.set(row[: meant.count])
        compensation.fmu.doStep(time, batch.cycle_time)
        plant.fmu.doStep(time, batch.cycle_time)
        recorded[cycle] = shown.get()
    compensation.close()
    plant.close()
    return recorded


def main(folder: Path) -> None:
    """Do what lies in a folder beside those of the FMUs."""
    batch: Batch = pickle.loads((folder / BATCH).read_bytes())
    results = []
    for simulation in batch.simulations:
        results.append(couple(folder.parent, batch, simulation))
        with (folder / DONE).open("a", encoding="ascii") as done:
            done.write(f"{len(simulation.commands)}\n")
    # Complete before the process ends: ending an embedded interpreter is where it may fail.
    write_whole(folder / RESULTS, pickle.dumps(results))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
