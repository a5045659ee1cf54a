"""Build both FMUs, run every trial without and with compensation, and collect the errors."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from fmpy import extract

from ..engine import Array
from ..fit import Circle, ReversingAxis, tune
from ..fmu import BuildError, Built, NoCompilerError, package_axcomp, package_native
from ..model import CYCLE_TIME, Machine
from ..plant import MEMORYLESS, Plant, load_plant, package_plant, plant_variables
from ..saving import write_whole
from .coupling import BATCH, COMMANDS, COMPENSATION, DONE, PLANT, RESULTS, Batch, Simulation
from .evaluation import Outcome, Trace, outcomes
from .trials import FEED, RADIUS, TOOL_LENGTH, VOLUMETRIC, Trial, name_of, trials_of, volumetric_trials

WITHOUT_MEMORY = f"{PLANT}_{MEMORYLESS}"
"""Name of the other plant's FMU."""

Progress = Callable[[int, int], None]
POLL = 0.1
"""Seconds between two looks at how far the trials are."""
PROCESSES = 2
"""That run the trials side by side."""


class DemoError(Exception):
    """The demonstration is not possible; the message is a sentence for the user."""


class Demo(NamedTuple):
    """What the demonstration has shown.

    ``results``: with the plant that has no memory; ``remembering``: with the one that has, empty where ``plant.json``
    names nothing of the kind. ``note`` says why it was not shown with the native FMU, "" if it was.
    """

    machine: Machine
    results: tuple[Outcome, ...]
    note: str = ""
    remembering: tuple[Outcome, ...] = ()


def demonstrate(
    lists: Path, output: Path, seed: int | None = None, progress: Progress = lambda _done, _of: None
) -> Demo:
    """Build ``axcomp.fmu`` and the plants in a folder, couple them and return the errors of all axes.

    ``plant.fmu`` is all that ``plant.json`` says, with parameters drawn by ``seed`` (None: as it says);
    ``plant_memoryless.fmu`` the same without memory, if that is another.

    ``progress``: called with the cycles that are done, and with all there are.

    Raises
    ------
    BuildError, DemoError
        With a sentence that says what is missing.
    """
    if not lists.exists():
        raise DemoError(f"{lists} does not exist.")
    model = lists if lists.is_dir() else lists.parent
    variables = plant_variables(model)
    output.mkdir(parents=True, exist_ok=True)
    built, note = _compensation(lists, output / f"{COMPENSATION}.fmu")
    drawn: dict[str, Any] = {} if seed is None else {"seed": seed}
    plants = {PLANT: package_plant(model, output / f"{PLANT}.fmu", **drawn)}
    whole = load_plant(model, **drawn)
    if whole.remembers:
        plants[WITHOUT_MEMORY] = package_plant(model, output / f"{WITHOUT_MEMORY}.fmu", choice=MEMORYLESS, **drawn)
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
    simulations, of_trial = _simulations(machine, trials)
    kinds = list(plants)[::-1]
    every = [simulation._replace(plant=kind) for kind in kinds for simulation in simulations]
    with tempfile.TemporaryDirectory(prefix="axcomp_demo_") as temporary:
        folder = Path(temporary)
        for name, path in ((COMPENSATION, built.path), *plants.items()):
            extract(path, folder / name)
        tool_length = TOOL_LENGTH if knows_tip and machine.volumetric else None
        traces, left = _simulate(
            folder, machine, every, tool_length, progress, lambda: _best_left(machine, trials, whole)
        )
    shown = []
    for first in range(0, len(every), len(simulations)):
        pairs = [(traces[first + without], traces[first + compensated]) for without, compensated in of_trial]
        shown.append(tuple(outcomes(machine, trials, pairs)))
    remembering = [
        replace(one, beyond=left[one.axis]) if one.trial.kind == "friction" else one
        for found in shown[1:]
        for one in found
    ]
    return Demo(machine, shown[0], note, tuple(remembering))


def _best_left(machine: Machine, trials: Sequence[Trial], plant: Plant) -> dict[str, float]:
    """Return the peak of each axis on a circle with the friction parameters that serve best, µm or ″, by its name."""
    watched = (
        {axis for trial in trials if trial.kind == "friction" for axis in trial.watched} if plant.remembers else ()
    )
    left = {}
    for axis in machine.axes:
        if axis.friction is not None and name_of(axis) in watched:
            reversing = ReversingAxis(plant, name_of(axis), Circle(RADIUS, FEED))
            left[name_of(axis)] = tune(reversing, axis.friction).left.largest
    return left


def _compensation(lists: Path, path: Path) -> tuple[Built, str]:
    """Build the native FMU; where there is no compiler, the one that runs in Python, and say so."""
    try:
        return package_native(lists, path), ""
    except NoCompilerError as error:
        return package_axcomp(lists, path), f"{error}\nUntil then axcomp.fmu runs in Python."


def _simulations(machine: Machine, trials: Sequence[Trial]) -> tuple[list[Simulation], list[tuple[int, int]]]:
    """Return the simulations that the trials need, and for each trial the ones without and with compensation."""
    simulations: list[Simulation] = []
    known: dict[tuple[int, tuple[str, ...]], int] = {}

    def number_of(trial: Trial, kinds: tuple[str, ...]) -> int:
        key = (id(trial.setpoints), kinds)
        if key not in known:
            known[key] = len(simulations)
            simulations.append(Simulation(_commands(machine, trial), _disabled(machine, kinds)))
        return known[key]

    pairs = [(number_of(trial, trial.off + trial.never_on), number_of(trial, trial.never_on)) for trial in trials]
    return simulations, pairs


def _commands(machine: Machine, trial: Trial) -> Array:
    axes = [trial.setpoints[name_of(axis)] for axis in machine.axes]
    return np.column_stack([getattr(axis, command) for command in ("position", *COMMANDS[1:]) for axis in axes])


def _disabled(machine: Machine, kinds: Sequence[str]) -> tuple[str, ...]:
    names = [f"{name_of(axis)}.{kind}.switch" for axis in machine.axes for kind in axis.kinds if kind in kinds]
    if VOLUMETRIC in kinds:
        names += [f"volumetric[{volumetric.index}].switch" for volumetric in machine.volumetric]
    return tuple(names)


def _simulate(
    folder: Path,
    machine: Machine,
    simulations: Sequence[Simulation],
    tool_length: float | None,
    progress: Progress,
    meanwhile: Callable[[], dict[str, float]],
) -> tuple[list[Trace], dict[str, float]]:
    """Share the simulations out to processes, each of which loads both FMUs.

    Return the traces in their order, and what is computed in the meantime.
    """
    shares: list[list[int]] = [[] for _ in range(min(PROCESSES, os.cpu_count() or 1, len(simulations)))]
    load = [0] * len(shares)
    for index in sorted(range(len(simulations)), key=lambda index: -len(simulations[index].commands)):
        least = load.index(min(load))
        shares[least].append(index)
        load[least] += len(simulations[index].commands)

    axes = [name_of(axis) for axis in machine.axes]
    currents = [name_of(axis) for axis in machine.axes if axis.friction is not None]
    children = []
    for number, share in enumerate(shares):
        own = folder / f"batch{number}"
        own.mkdir()
        batch = Batch(axes, currents, CYCLE_TIME, tool_length, [simulations[index] for index in share])
        write_whole(own / BATCH, pickle.dumps(batch))
        with (own / "messages.txt").open("wb") as messages:
            command = [sys.executable, "-m", f"{__package__}.coupling", str(own)]
            children.append(subprocess.Popen(command, stdout=messages, stderr=messages, env=_environment()))
    traces: dict[int, Trace] = {}
    try:
        computed = meanwhile()
        for number, (child, share) in enumerate(zip(children, shares, strict=True)):
            while True:
                try:
                    child.wait(POLL)
                    break
                except subprocess.TimeoutExpired:
                    progress(sum(map(_done, folder.glob(f"batch*/{DONE}"))), sum(load))
            for index, recorded in zip(share, _results(folder / f"batch{number}"), strict=True):
                traces[index] = Trace.of(axes, recorded)
    finally:
        for child in children:
            child.kill()
            child.wait()
    return [traces[index] for index in range(len(simulations))], computed


def _done(file: Path) -> int:
    """Return how many cycles a process has run, by what it has noted whole."""
    return sum(int(line) for line in file.read_text(encoding="ascii").split("\n")[:-1])


def _results(folder: Path) -> list[Array]:
    try:
        results: list[Array] = pickle.loads((folder / RESULTS).read_bytes())
        return results
    except FileNotFoundError:
        messages = (folder / "messages.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()
        raise DemoError(
            f"The FMUs could not be run: {messages[-1] if messages else 'the process ended early'}."
        ) from None


def _environment() -> dict[str, str]:
    """Return the environment of a process that finds this package where this one has it from."""
    package = Path(__file__).resolve().parents[2]
    paths = [str(package), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}


__all__ = ["BuildError", "Demo", "DemoError", "demonstrate"]
