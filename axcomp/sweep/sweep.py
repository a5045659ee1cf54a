"""A whole sweep: what is missing is run, and all rows come out in the order of the specification."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from ..fmu import FOLDER, BuildError, packed_lists
from ..lists import read_machine
from ..saving import write_whole
from .journal import SUFFIX, Journal, keys_of
from .list_variation import ListEntry, varied
from .spec import ERROR, FINDINGS, MACHINE, RUN, Run, Spec, SpecError
from .task import Job, Row, Source, notable, nothing_of, perform, reading_of
from .units import units_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LINES_NAMED = 12
"""Lines that a legend has room for."""

Progress = Callable[[int, int], None]
"""Called with how many rows there are, and how many there are to be."""


@dataclass(frozen=True)
class Sweep:
    """Results of a sweep.

    ``table`` has a row a run, in the order of the specification: ``run``, what was varied (columns ``varied``), the
    results, ``findings``, ``error``. ``taken_over``: rows that were there already. ``units``: of columns that have
    one; they stand in ``table.attrs["units"]`` too, which a Parquet file keeps.
    """

    table: pd.DataFrame
    varied: tuple[str, ...]
    taken_over: int
    units: Mapping[str, str] = field(default_factory=dict)

    def labelled(self, name: str) -> str:
        """Return the name of a column with its unit."""
        return f"{name} [{self.units[name]}]" if name in self.units else name

    @property
    def failed(self) -> pd.DataFrame:
        """The rows of the runs that failed."""
        return self.table[self.table[ERROR] != ""]

    def save(self, path: Path) -> None:
        """Write the table, as ``.parquet`` or ``.csv``: there is either all of it or what was there before."""
        if path.suffix.lower() == ".csv":
            write_whole(path, self.table.to_csv(index=False, lineterminator="\n"))
        else:
            write_whole(path, self.table.to_parquet(index=False, engine="pyarrow"))

    def plot(self, x: str, y: str, ax: Axes | None = None) -> Any:
        """Draw a result over a column, a line for each combination of the others that were varied.

        These need not be numbers, ``x`` has to be. Return the Matplotlib axes; ValueError if a column is not there.
        """
        from ..plot import labelled, line_styles, new_figure

        numeric = [str(name) for name in self.table if pd.api.types.is_numeric_dtype(self.table[name])]
        for name in (x, y):
            if name not in numeric:
                raise ValueError(f"there is no column {name} of numbers; there are {', '.join(numeric)}")
        ax = new_figure().add_subplot() if ax is None else ax
        done = self.table[self.table[ERROR] == ""]
        others = [name for name in self.varied if name != x and done[name].nunique(dropna=False) > 1]
        groups = list(done.groupby(others, dropna=False, sort=False)) if others else [((), done)]
        for (values, group), (colour, marker) in zip(groups, line_styles(len(groups)), strict=True):
            ordered = group.sort_values(x)
            texts = [f"{v:g}" if isinstance(v, float) else str(v) for v in values]
            label = ", ".join(f"{name} = {text}" for name, text in zip(others, texts, strict=True))
            ax.plot(ordered[x], ordered[y], color=colour, marker=marker, ms=4, lw=1.2, label=label or None)
        title = f"{y} over {x}"
        if len(groups) > LINES_NAMED:
            title += f", {len(groups)} lines by {', '.join(others)}"
        elif others:
            ax.legend(fontsize=9)
        return labelled(ax, title, self.labelled(x), self.labelled(y))


def job_of(spec: Spec) -> tuple[Job, list[str]]:
    """Return what the runs of a specification have in common, and findings about the lists as they are.

    Raises
    ------
    SpecError
        If a machine cannot be read, or lists have no such entry.
    """
    sources: list[Source] = []
    said: list[str] = []
    for path in spec.machines:
        if path.suffix.lower() == ".fmu":
            sources.append(Source.of("", {path.name: path.read_bytes()}))
            continue
        try:
            start, packed = packed_lists(read_machine(path))
        except (BuildError, OSError) as error:
            raise SpecError(spec.file, MACHINE, str(error)) from None
        files = {name.removeprefix(f"{FOLDER}/"): data for name, data in packed.items()}
        source = Source.of(start.removeprefix(f"{FOLDER}/") if start != FOLDER else ".", files)
        reading = reading_of(source)
        findings = notable(reading)
        said += map(str, findings)
        if not reading.machine.axes:
            raise SpecError(spec.file, MACHINE, f"{path}: there is no axis in these lists")
        sources.append(replace(source, known=frozenset((finding.parameter, finding.code) for finding in findings)))
    _check_entries(spec, sources)
    return Job(tuple(sources), spec.trajectory, spec.results, spec.cycle_time, spec.duration), said


def _check_entries(spec: Spec, sources: list[Source]) -> None:
    """Try every setting of a list entry on every machine."""
    for setting in spec.settings:
        values = spec.vary.get(setting) or tuple(run[setting] for run in spec.runs if setting in run)
        for source, path in zip(sources, spec.machines, strict=True):
            try:
                if source.is_fmu and setting.of_lists:
                    raise ValueError(f"{path} is an FMU, whose lists cannot be varied; expected a machine's lists")
                if isinstance(setting.target, ListEntry):
                    varied(reading_of(source), [(setting.target, values[0])])
            except ValueError as error:
                raise SpecError(spec.file, f'vary."{setting.key}"', str(error)) from None


def run_sweep(
    spec: Spec,
    job: Job,
    output: Path,
    *,
    scheduler: str | None = None,
    workers: int | None = None,
    retry: bool = False,
    progress: Progress | None = None,
) -> Sweep:
    """Run what is missing, and write the results to ``output``, ``.parquet`` or ``.csv``.

    Beside it lies a journal until the results are there. ``job`` is what ``job_of`` makes of the specification,
    ``scheduler`` and ``workers`` are as in ``cluster.completed``. ``retry``: try runs again that have failed before.
    ``progress`` is told at the start and after every run.

    Raises
    ------
    ClusterError
        If there is no cluster to work on.
    """
    runs = list(spec.every_run())
    keys = keys_of(job, runs)
    with Journal(output.with_name(output.name + SUFFIX)) as journal:
        rows = {key: row for key, row in journal.rows(failed=not retry).items() if key in set(keys)}
        missing = [run for run, key in zip(runs, keys, strict=True) if key not in rows]
        taken_over = len(runs) - len(missing)
        tell = progress or (lambda *_: None)
        tell(taken_over, len(runs))
        if missing:
            for done, (run, row) in enumerate(_performed(job, missing, scheduler, workers), taken_over + 1):
                rows[keys[run.index]] = row
                journal.add(keys[run.index], row)
                tell(done, len(runs))
        table = _table(spec, runs, [rows[key] for key in keys])
        varied = tuple(str(name) for name in table if name not in {RUN, FINDINGS, ERROR, *spec.results})
        table.attrs["units"] = units = units_of(spec, job)
        sweep = Sweep(table, varied, taken_over, units)
        sweep.save(output)
        if sweep.failed.empty:
            journal.remove()
    return sweep


def _performed(job: Job, runs: list[Run], scheduler: str | None, workers: int | None) -> Iterator[tuple[Run, Row]]:
    from ..native import compiled_kernel
    from .cluster import completed

    if scheduler is None:
        # Compiled once here, it is there for all workers.
        compiled_kernel()
    for run, found, error in completed(perform, job, runs, scheduler, workers):
        row: Row = found
        if error is not None:
            row = {**nothing_of(job), ERROR: f"the worker ended during this run: {' '.join(str(error).split())}"}
        yield run, row


def _table(spec: Spec, runs: list[Run], rows: list[Row]) -> pd.DataFrame:
    """Return all rows; a column of values of different kinds is one of texts."""
    columns: dict[str, Any] = {RUN: [run.index for run in runs]}
    if len(spec.machines) > 1:
        columns[MACHINE] = [os.path.relpath(spec.machines[run.machine], spec.file.parent) for run in runs]
    for setting in spec.settings:
        values = [run.values.get(setting) for run in runs]
        kinds = {type(value) for value in values if value is not None}
        mixed = len(kinds - {int, float}) > (0 if kinds & {int, float} else 1)
        columns[setting.key] = [str(v) if mixed and v is not None else v for v in values]
    for name in (*spec.results, FINDINGS, ERROR):
        columns[name] = [row[name] for row in rows]
    return pd.DataFrame(columns)
