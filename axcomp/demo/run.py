"""Build both FMUs, run every trial without and with compensation, and collect the errors."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from fmpy import extract

from ..engine.motion import Array
from ..fmu.archive import BuildError
from ..fmu.content import Built
from ..fmu.native_package import NoCompilerError, package_native
from ..fmu.package import package_axcomp
from ..model.machine import CYCLE_TIME, Machine
from ..plant.fmu import package_plant, read_plant
from .coupling import COMMANDS, COMPENSATION, PLANT, Job, Recorded, read_results, write_job
from .evaluation import Outcome, Record, outcomes
from .trials import VOLUMETRIC, Trial, name_of, trials_of
from .volume import TOOL_LENGTH, volumetric_trials

PROCESSES = 2
"""That run the trials side by side."""


class DemoError(Exception):
    """The demonstration is not possible; the message is a sentence for the user."""


class Demo(NamedTuple):
    """What the demonstration has shown; ``note`` says why it was not shown with the native FMU, "" if it was."""

    machine: Machine
    results: tuple[Outcome, ...]
    note: str = ""


class Run(NamedTuple):
    """One simulation: the commands, shape (cycles, 3 · axes), and the ``enable`` inputs that are false."""

    commands: Array
    off: tuple[str, ...]


def demonstrate(lists: Path, output: Path) -> Demo:
    """Build ``axcomp.fmu`` and ``plant.fmu`` in a folder, couple them and return the errors of all axes.

    Raises
    ------
    BuildError, DemoError
        With a sentence that says what is missing.
    """
    if not lists.exists():
        raise DemoError(f"{lists} does not exist.")
    model = lists if lists.is_dir() else lists.parent
    variables, _ = read_plant(model)
    output.mkdir(parents=True, exist_ok=True)
    built, note = _compensation(lists, output / f"{COMPENSATION}.fmu")
    plant = package_plant(model, output / f"{PLANT}.fmu")
    machine = built.machine
    known = {variable.name.rpartition(".")[0] for variable in variables}
    missing = [name_of(axis) for axis in machine.axes if name_of(axis) not in known]
    if missing:
        raise DemoError(f"The plant has no axis {', '.join(missing)}.")

    trials = trials_of(machine, CYCLE_TIME)
    knows_tip = any(variable.name == "tcp.x" for variable in variables)
    if knows_tip:
        trials += volumetric_trials(machine, CYCLE_TIME)
    if not trials:
        raise DemoError(f"{lists}: no compensation acts, so there is nothing to show.")
    runs, of_trial = _runs(machine, trials)
    with tempfile.TemporaryDirectory(prefix="axcomp_demo_") as temporary:
        folder = Path(temporary)
        for name, path in ((COMPENSATION, built.path), (PLANT, plant)):
            extract(path, folder / name)
        records = _simulate(folder, machine, runs, TOOL_LENGTH if knows_tip and machine.volumetric else None)
    pairs = [(records[without], records[compensated]) for without, compensated in of_trial]
    return Demo(machine, tuple(outcomes(machine, trials, pairs)), note)


def _compensation(lists: Path, path: Path) -> tuple[Built, str]:
    """Build the native FMU; where there is no compiler, the one that runs in Python, and say so."""
    try:
        return package_native(lists, path), ""
    except NoCompilerError as error:
        return package_axcomp(lists, path), f"{error}\nUntil then axcomp.fmu runs in Python."


def _runs(machine: Machine, trials: Sequence[Trial]) -> tuple[list[Run], list[tuple[int, int]]]:
    """Return the simulations that the trials need, and for each trial the ones without and with compensation."""
    runs: list[Run] = []
    known: dict[tuple[int, tuple[str, ...]], int] = {}
    of_trial = []
    for trial in trials:
        pair = []
        for kinds in (trial.off + trial.never_on, trial.never_on):
            key = (id(trial.setpoints), kinds)
            if key not in known:
                known[key] = len(runs)
                runs.append(Run(_commands(machine, trial), _disabled(machine, kinds)))
            pair.append(known[key])
        of_trial.append((pair[0], pair[1]))
    return runs, of_trial


def _commands(machine: Machine, trial: Trial) -> Array:
    axes = [trial.setpoints[name_of(axis)] for axis in machine.axes]
    return np.column_stack([getattr(axis, command) for command in ("position", *COMMANDS[1:]) for axis in axes])


def _disabled(machine: Machine, kinds: Sequence[str]) -> tuple[str, ...]:
    names = [f"{name_of(axis)}.{kind}.enable" for axis in machine.axes for kind in axis.kinds if kind in kinds]
    if VOLUMETRIC in kinds:
        names += [f"volumetric[{volumetric.index}].enable" for volumetric in machine.volumetric]
    return tuple(names)


def _simulate(folder: Path, machine: Machine, runs: Sequence[Run], tool_length: float | None) -> list[Record]:
    """Share the runs out to processes, each of which loads both FMUs; return the records in their order."""
    shares: list[list[int]] = [[] for _ in range(min(PROCESSES, os.cpu_count() or 1, len(runs)))]
    load = [0] * len(shares)
    for index in sorted(range(len(runs)), key=lambda index: -len(runs[index].commands)):
        least = load.index(min(load))
        shares[least].append(index)
        load[least] += len(runs[index].commands)

    axes = tuple(name_of(axis) for axis in machine.axes)
    currents = tuple(name_of(axis) for axis in machine.axes if axis.friction is not None)
    children = []
    for number, share in enumerate(shares):
        place = folder / f"job{number}"
        job = Job(axes, currents, CYCLE_TIME, tuple(runs[index].off for index in share), tool_length)
        write_job(place, job, [runs[index].commands for index in share])
        with (place / "messages.txt").open("wb") as messages:
            command = [sys.executable, "-m", f"{__package__}.coupling", str(place)]
            children.append(subprocess.Popen(command, stdout=messages, stderr=messages, env=_environment()))
    records: list[Record | None] = [None] * len(runs)
    try:
        for number, (child, share) in enumerate(zip(children, shares, strict=True)):
            child.wait()
            for index, (true, lag, tip) in zip(share, _results(folder / f"job{number}"), strict=True):
                records[index] = Record(dict(zip(axes, true.T, strict=True)), dict(zip(axes, lag.T, strict=True)), tip)
    finally:
        for child in children:
            child.kill()
            child.wait()
    return [record for record in records if record is not None]


def _results(place: Path) -> list[Recorded]:
    try:
        return read_results(place)
    except FileNotFoundError:
        messages = (place / "messages.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()
        raise DemoError(
            f"The FMUs could not be run: {messages[-1] if messages else 'the process ended early'}."
        ) from None


def _environment() -> dict[str, str]:
    """Return the environment of a process that finds this package where this one has it from."""
    package = Path(__file__).resolve().parents[2]
    paths = [str(package), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


__all__ = ["BuildError", "Demo", "DemoError", "demonstrate"]
