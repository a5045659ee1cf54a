"""All values of one parameter in one list by their indices; regular stretches stay columns until cells are wanted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ..kinds import DataType, Parameter, Value

Indices = tuple[int, ...]


class Run(NamedTuple):
    """Values of a regular stretch: index and line of the first one, and how many lines lie from one to the next."""

    first: int
    values: list[int]
    line: int
    step: int


class Column:
    """See the module."""

    __slots__ = ("_cells", "_runs", "high", "index_max", "low", "parameter", "quick", "spellings")

    def __init__(self, parameter: Parameter) -> None:
        self.parameter = parameter
        self.spellings: set[str] = set()
        self._cells: dict[Indices, tuple[Value, int]] = {}
        # By the indices before the last one; runs of one row follow each other.
        self._runs: dict[Indices, list[Run]] = {}
        plausible = parameter.plausible
        self.low = plausible.low + plausible.low_open
        self.high = plausible.high - plausible.high_open
        self.index_max = parameter.index_max
        special = parameter.values or parameter.names or parameter.index_max
        self.quick = parameter.type is not DataType.STRING and not special

    @property
    def cells(self) -> dict[Indices, tuple[Value, int]]:
        """Indices → (value, line) of all that is given; to be added to."""
        for fixed, runs in self._runs.items():
            for first, values, line, step in runs:
                lines = range(line, line + step * len(values), step)
                self._cells.update(((*fixed, i), cell) for i, cell in enumerate(zip(values, lines, strict=True), first))
        self._runs.clear()
        return self._cells

    def __len__(self) -> int:
        return len(self._cells) + sum(len(run.values) for runs in self._runs.values() for run in runs)

    def has_room(self, fixed: Indices, first: int, values: Sequence[int]) -> bool:
        """Tell whether values are plausible and nothing else is given for their indices."""
        runs = self._runs.get(fixed)
        if not self.quick or min(values) < self.low or max(values) > self.high:
            return False
        if runs and runs[-1].first + len(runs[-1].values) > first:
            return False
        return not self._cells or not any((*fixed, i) in self._cells for i in range(first, first + len(values)))

    def add(self, fixed: Indices, run: Run) -> None:
        """Take values for which there is room."""
        self._runs.setdefault(fixed, []).append(run)

    def filled(self, counts: Sequence[int]) -> list[int] | None:
        """Return all values, the last index running fastest, if they are those from 0 to ``counts`` and regular."""
        *outer, count = counts
        rows: list[Indices] = [(j,) for j in range(outer[0])] if outer else [()]
        if self._cells or len(self._runs) != len(rows):
            return None
        found: list[int] = []
        for number, row in enumerate(rows):
            for run in self._runs.get(row, ()):
                if number * count + run.first != len(found):
                    return None
                found += run.values
            if len(found) != (number + 1) * count:
                return None
        return found
