"""One run of a sweep, as a worker does it: nothing here knows of the others.

A worker may be on another machine: it gets the lists themselves, not their paths.
"""

from __future__ import annotations

import contextlib
import io
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ..engine import LIMITS, Columns, Engine, InputFile, Motion, completed
from ..fmu import content_guid
from ..lists import Finding, Reading, Severity, read_machine
from ..model import Machine
from ..saving import write_whole
from .list_variation import ListEntry, Table, Value, read_files, varied
from .reductions import Column, Reduction
from .settings import PARAMETERS
from .spec import ERROR, FINDINGS, Run

Row = dict[str, Any]
"""Results of a run by column: numbers, ``findings`` and ``error``; texts are "" where there is nothing to say."""

MACHINES_KEPT = 8
"""Machines that a worker remembers: reading lists takes longer than most runs."""


@dataclass(frozen=True)
class Source:
    """What a machine is made of; equal for equal content, of which ``digest`` is.

    ``start``: what ``read_machine`` is to read among the files, "" for an FMU; ``files``: the lists by relative path,
    or the one FMU; ``known``: findings about the lists as they are: these are no news in a run.
    """

    digest: str
    start: str = field(compare=False)
    files: Mapping[str, bytes] = field(compare=False, repr=False)
    known: frozenset[tuple[str, str]] = field(default=frozenset(), compare=False, repr=False)

    @classmethod
    def of(cls, start: str, files: Mapping[str, bytes]) -> Source:
        """Return the source made of these files."""
        return cls(start + content_guid(files), start, dict(files))

    @property
    def is_fmu(self) -> bool:
        """Whether it is an FMU."""
        return not self.start


@dataclass(frozen=True, eq=False)
class Job:
    """What all runs of a sweep have in common; sent to each worker once."""

    sources: tuple[Source, ...]
    trajectory: InputFile | Motion
    results: Mapping[str, Reduction]
    cycle_time: float
    duration: float | None


def nothing_of(job: Job) -> Row:
    """Return the row of a run without results."""
    return {**dict.fromkeys(job.results, float("nan")), FINDINGS: "", ERROR: ""}


def perform(job: Job, run: Run) -> Row:
    """Return the row of a run; what goes wrong in it stands in its ``error``."""
    row = nothing_of(job)
    try:
        values, cycle_time, row[FINDINGS] = _simulate(job, run)
        for name, reduction in job.results.items():
            unknown = [variable for variable in reduction.names if variable not in values]
            if unknown:
                close = get_close_matches(unknown[0], values, 5, 0.5) or values
                raise ValueError(f"{name}: there is no variable {unknown[0]} in this run; there are {', '.join(close)}")
            try:
                row[name] = reduction.of(values, cycle_time)
            except ValueError as error:
                raise ValueError(f"{name}: {error}") from None
    except Exception as error:  # whatever it is, the other runs go on
        text = error.args[0] if isinstance(error, KeyError) and error.args else str(error)
        row[ERROR] = " ".join(str(text or repr(error)).split())
    return row


def _simulate(job: Job, run: Run) -> tuple[Mapping[str, Column], float, str]:
    """Return inputs and outputs of a run by name, the cycle time, and findings about its lists."""
    source = job.sources[run.machine]
    parameters = {s.name: value for s, value in run.values.items() if s.kind == "parameter"}
    cycle_time = float(parameters.get("cycle_time", job.cycle_time))
    duration = parameters.get("duration", job.duration)
    own = tuple((name, float(parameters[name])) for name in LIMITS if name in parameters)
    columns = _columns(job, own, cycle_time, None if duration is None else float(duration))
    if source.is_fmu:
        starts = {name: value for name, value in parameters.items() if name not in PARAMETERS}
        return _simulate_fmu(source, run, columns, starts, cycle_time)
    unknown = [name for name in parameters if name not in PARAMETERS]
    if unknown:
        raise ValueError(f"there is no parameter {unknown[0]}; there are {', '.join(PARAMETERS)}")
    entries = tuple((s.target, value) for s, value in run.values.items() if isinstance(s.target, ListEntry))
    machine, findings = _machine(source, entries)
    for setting, value in run.values.items():
        if isinstance(setting.target, Table):
            machine = setting.target.applied(machine, float(value))
    engine = Engine(machine, cycle_time)
    inputs = {variable.name for variable in engine.variables if variable.causality == "input"}
    given = _given(run, columns, inputs, cycle_time, engine.modulo)
    return {**given, **engine.run(given).columns}, cycle_time, findings


@lru_cache(MACHINES_KEPT)
def _columns(job: Job, own: tuple[tuple[str, float], ...], cycle_time: float, duration: float | None) -> Columns:
    """Return the trajectory with limits of a run's ``own``; runs that have none share it."""
    trajectory = job.trajectory
    if own and isinstance(trajectory, Motion):
        trajectory = replace(trajectory, limits=replace(trajectory.limits, **dict(own)))
    return trajectory.sampled(cycle_time, duration)


def _given(run: Run, columns: Columns, known: set[str], cycle_time: float, modulo: Mapping[str, float]) -> Columns:
    """Return the inputs of a run: those of the trajectory, what follows from them, and what is varied."""
    found = completed(columns, known, cycle_time, modulo)
    cycles = len(next(iter(found.values())))
    for setting, value in run.values.items():
        if setting.kind == "input":
            found[setting.name] = np.full(cycles, float(value))
        elif setting.kind == "scaled input":
            if setting.name not in found:
                raise ValueError(f"there is no input {setting.name} to scale; there are {', '.join(found)}")
            found[setting.name] = found[setting.name] * float(value)
    return found


@lru_cache(MACHINES_KEPT)
def _machine(source: Source, entries: tuple[tuple[ListEntry, Value], ...]) -> tuple[Machine, str]:
    """Return a machine and what its changes have given rise to."""
    reading = reading_of(source)
    if entries:
        reading = read_machine(reading.path, documents=varied(reading, entries))
    findings = notable(reading)
    if not reading.machine.axes:
        raise ValueError("; ".join(["there is no axis in the lists", *map(str, findings)]))
    return reading.machine, "\n".join(str(f) for f in findings if (f.parameter, f.code) not in source.known)


@lru_cache(MACHINES_KEPT)
def reading_of(source: Source) -> Reading:
    """Return what the lists of a source say as they are: a run reads again only what it changes."""
    return read_files(source.start, source.files)


def notable(reading: Reading) -> list[Finding]:
    """Return errors and warnings about lists."""
    return [finding for finding in reading.findings if finding.severity is not Severity.INFO]


def _simulate_fmu(
    source: Source, run: Run, columns: Columns, starts: Mapping[str, Any], cycle_time: float
) -> tuple[Mapping[str, Column], float, str]:
    from fmpy import simulate_fmu  # only FMUs need it, and it takes long to load

    if any(setting.of_lists for setting in run.values):
        raise ValueError("lists cannot be varied in an FMU; expected a machine given by its lists")
    unpacked = _unpacked(source)
    variables = [v for v in unpacked.description.modelVariables if v.type != "String"]
    types = {v.name: {"Boolean": np.bool_, "Integer": np.int32}.get(v.type, np.float64)
             for v in variables if v.causality == "input"}  # fmt: skip
    given = _given(run, columns, set(types), cycle_time, {})
    for name in given:
        if name not in types:
            raise ValueError(f"{name} is no input; the inputs are {', '.join(types)}")
    cycles = len(next(iter(given.values())))
    rows = np.zeros(cycles, dtype=[("time", np.float64), *((name, types[name]) for name in given)])
    rows["time"] = np.arange(cycles) * cycle_time
    for name, column in given.items():
        rows[name] = column
    outputs = [v.name for v in variables if v.causality == "output"]
    # FMPy prints a line for every input that keeps its start value, in each run.
    with contextlib.redirect_stdout(io.StringIO()):
        recorded = simulate_fmu(
            unpacked.folder,
            model_description=unpacked.description,
            validate=False,
            stop_time=cycles * cycle_time,
            step_size=cycle_time,
            output_interval=cycle_time,
            input=rows,
            output=outputs,
            start_values=dict(starts),
        )
    # What is read after a step belongs to the inputs at its beginning: FMI 2.0 has no feedthrough inside a step.
    return {**given, **{name: recorded[name][1 : cycles + 1] for name in outputs}}, cycle_time, ""


class _Unpacked:
    """An unpacked FMU; its folder goes with it."""

    def __init__(self, source: Source) -> None:
        from fmpy import extract, read_model_description

        self.folder = tempfile.mkdtemp(prefix="axcomp-sweep-")
        packed = Path(self.folder, "packed.fmu")
        write_whole(packed, next(iter(source.files.values())))
        extract(str(packed), unzipdir=self.folder)
        self.description = read_model_description(self.folder, validate=False)

    def __del__(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)


_unpacked = lru_cache(MACHINES_KEPT)(_Unpacked)
