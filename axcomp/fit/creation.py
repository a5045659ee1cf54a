"""What making a list from measurements gives, whatever the kind: the table, the list, and what it will do."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..model import Tabular, Tabulated
from ..saving import write_all
from .keeping import backed_up, changes, owners

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MEASURED, PREDICTED, LEFT_OUT = "measured", "predicted", "leave one run out"
"""States that figures are given for: without the new table, with it, and each run with a table made of the others."""


class CannotCreateError(ValueError):
    """No table can be made as asked for; one sentence."""


class Report(NamedTuple):
    """What came of it.

    Attributes
    ----------
    sentences, notes : tuple of str
        How good it is, and what else should be known.
    rows : tuple of tuple of str
        Of a table of what was found, the first row its header; empty where the list says it all.
    details : mapping of str to object
        What else was found, for JSON.
    """

    sentences: tuple[str, ...]
    notes: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()
    details: Mapping[str, Any] = MappingProxyType({})

    def noted(self, *notes: str) -> Report:
        """Return the same with more notes; empty ones do not count."""
        return self._replace(notes=(*self.notes, *filter(None, notes)))


@dataclass(frozen=True, eq=False)
class Creation(Tabular, Mapping[str, Mapping[str, float]]):
    """A list with a new table.

    Attributes
    ----------
    kind : str
        ``leadscrew``, ``cross``, …
    compensation : Compensation or Volumetric
        What it says, in mm or °.
    files : mapping of Path to bytes
        The list, all of it, with the new table; behind it what else changes.
    points, capacity : int
        Entries of the table, and how many the controller takes.
    deviation : float
        How far the table, thinned and rounded, is from the measured means where they were measured, at most.
    unit : str
        Of ``deviation`` and the figures.
    figures : mapping of str to mapping of str to float
        For each state (``MEASURED``, ``PREDICTED``, ``LEFT_OUT``) the figures by name.
    labels : mapping of str to str
        Name of each figure → how it is shown.
    report : Report
    before : mapping of Path to bytes
        What files held when they were read.
    draw : callable
        Draws measurement, table and what is left into axes.
    """

    kind: str
    compensation: Any
    files: Mapping[Path, bytes]
    points: int
    capacity: int
    deviation: float
    unit: str
    figures: Mapping[str, Mapping[str, float]]
    labels: Mapping[str, str]
    report: Report
    before: Mapping[Path, bytes] = field(repr=False, default_factory=dict)
    draw: Callable[[Axes], None] = field(repr=False, default=lambda _: None)

    def __getitem__(self, state: str) -> Mapping[str, float]:
        """Return the figures of a state."""
        return self.figures[state]

    def __iter__(self) -> Iterator[str]:
        return iter(self.figures)

    def __len__(self) -> int:
        return len(self.figures)

    def tabulated(self) -> Tabulated:
        """Return the figures, a column for each state."""
        columns = {state: [one.get(name, math.nan) for name in self.labels] for state, one in self.figures.items()}
        return Tabulated("figure", list(self.labels), columns, dict.fromkeys(columns, self.unit))

    @property
    def path(self) -> Path:
        """The list."""
        return next(iter(self.files))

    @property
    def data(self) -> bytes:
        """All of the list, with the new table."""
        return self.files[self.path]

    @property
    def notes(self) -> tuple[str, ...]:
        """What else should be known."""
        return self.report.notes

    def noted(self, *notes: str) -> Creation:
        """Return the same with notes in front of the others."""
        return replace(self, report=self.report._replace(notes=(*notes, *self.report.notes)))

    def changes(self, path: str | Path | None = None) -> list[str]:
        """Return what ``write`` would change, line by line, as a unified diff."""
        return changes(self._files(path))

    def write(self, path: str | Path | None = None) -> list[Path]:
        """Write everything where it was read, or the list alone elsewhere, whole or not at all; return what was.

        CannotCreateError if a list names the other place.
        """
        files = self._files(path)
        if path is not None and Path(path).resolve() != self.path.resolve() and (named := owners(Path(path))):
            raise CannotCreateError(f"{path} is not overwritten: {', '.join(map(str, named))} names it")
        write_all(files)
        return list(files)

    def backups(self, path: str | Path | None = None) -> list[Path]:
        """Keep what ``write`` would replace beside it, as ``.bak``; return where it is."""
        kept = [backed_up(file, data, self.before.get(file)) for file, data in self._files(path).items()]
        return [one for one in kept if one is not None]

    def _files(self, path: str | Path | None) -> Mapping[Path, bytes]:
        return self.files if path is None else {Path(path): self.data}

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw measurement, table and what is left; return the axes."""
        if ax is None:
            from matplotlib.figure import Figure  # takes long to load

            ax = Figure(figsize=(10.0, 5.6), dpi=120, layout="constrained").add_subplot()
        self.draw(ax)
        return ax

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON; None stands for what is not available."""
        return {
            "kind": self.kind,
            "list": str(self.path),
            "points": self.points,
            "capacity": self.capacity,
            "deviation": self.deviation,
            "unit": self.unit,
            "figures": {
                state: {name: None if math.isnan(value) else value for name, value in figures.items()}
                for state, figures in self.figures.items()
            },
            "notes": list(self.notes),
            **self.report.details,
        }
