"""One list with the axis it is for: what the kinds of compensation need to be read (see ``kinds.kind.TableReader``)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby, pairwise, product
from typing import Any

from ..kinds import METRIC, Gear, convert
from .axes import Axes, AxisSettings
from .catalogue import parameter
from .column import Indices
from .findings import Findings
from .values import ListValues

POINTS_MAX = 1_000_000
"""Entries of a table that are taken at most, whatever max_points says."""

POSITION_MAX = 1e15
"""Largest position in mm or ° that a table may hold; beyond it a float no longer resolves the list's unit."""

_MISSING = (0, 0)


class TableReader:
    """A list of an axis being read: its values, its axis, the other axes, and where to note findings."""

    def __init__(self, values: ListValues, axis: AxisSettings, axes: Axes, findings: Findings) -> None:
        self.values = values
        self.axis = axis
        self.axes = axes
        self._findings = findings

    def note(self, code: str, name: str, message: str, *indices: int) -> None:
        """Note a finding at an entry of this list."""
        shown = parameter(self.values.kind, name).named(*indices) if indices else name
        line = self._line(parameter(self.values.kind, name).name, indices)
        self._findings.add(code, self.values.file, line, shown, message)

    def _line(self, name: str, indices: Indices) -> int:
        """Return the line of an entry, or of the one before it in the table where it is missing."""
        cells = self.values.cells(name)
        before = [given for given in cells if given <= indices]
        return cells[max(before)][1] if before else 0

    def axis_of(self, name: str, purpose: str, code: str = "AXC-MASTER") -> AxisSettings | None:
        """Return the axis whose number an entry gives; a finding and None if there is none."""
        number = self.values.integer(name)
        if number in self.axes:
            return self.axes.get(number)
        if number == 0:
            self.note(code, name, f"{name} does not say which axis is the {purpose}; the compensation stays off.")
            return None
        if self.axes.invent:
            place = (self.values.file, self.values.line(name), name)
            return self.axes.get(number) if self.axes.add(AxisSettings(number), *place) else None
        self.note(code, name, f"Axis {number}, the {purpose}, does not exist; the compensation stays off.")
        return None

    def note_own_master(self, name: str) -> None:
        """Warn when an axis is named as its own master."""
        if self.values.integer(name) == self.axis.number:
            self.note("AXC-MASTER-SELF", name, f"Axis {self.axis.number} is its own master; it is read so.")

    def gears(self, unit: str, *axes: AxisSettings) -> list[Gear]:
        """Return how to convert positions of axes: as they stand, or from encoder increments."""
        if self.values.flag(unit):
            return [METRIC] * len(axes)
        if not self.values.given(unit) and any(axis.gear != METRIC for axis in axes):
            self.note("AXC-UNIT", unit, f"{unit} is missing: the values are read as encoder increments.")
        return [axis.gear for axis in axes]

    def capacity(self, name: str) -> int:
        """Return max_points; 0 stands for the default."""
        return self.values.integer(name) or int(parameter(self.values.kind, name).default)

    def fits(self, used: int, capacity: int, size_name: str) -> bool:
        """Check the used size of a table, with a finding if it is 0 or too large."""
        if used < 1:
            self.note("AXC-SIZE", size_name, f"{size_name} is 0: the table is not used; the compensation stays off.")
        elif used > min(capacity, POINTS_MAX):
            message = (
                f"By {size_name} the table has {used:,} entries, but there is room for {min(capacity, POINTS_MAX):,}"
            )
            self.note("110647", size_name, f"{message}; the compensation stays off.")
        else:
            return True
        return False

    def column(self, name: str, *counts: int, gear: Gear = METRIC) -> list[float]:
        """Return the used part of a table, converted, the last index running fastest.

        An entry that is missing is 0, as in the controller, with a finding; so are entries beyond the used part.
        """
        divisor = parameter(self.values.kind, name).quantity.divisor
        metric = gear == METRIC
        if (regular := self.values.filled(name, counts)) is not None:
            return [v / divisor if metric else convert(v, divisor, gear) for v in regular]
        cells = self.values.cells(name)
        used = list(product(*map(range, counts)))
        found: list[tuple[Any, int]] = [cells.get(indices, _MISSING) for indices in used]
        missing = found.count(_MISSING)
        if missing:
            self._note_gaps(name, used)
        if len(cells) > len(used) - missing:
            beyond = set(cells).difference(used)
            message = f"{len(beyond):,} entries of {name} lie beyond the used size of the table; they are not used."
            self.note("AXC-UNUSED", name, message, *min(beyond))
        # An integer in the unit of the list is what nearly every value is: it saves a call.
        return [v / divisor if metric and type(v) is int else convert(v, divisor, gear) for v, _ in found]

    def _note_gaps(self, name: str, used: list[Indices]) -> None:
        """Note each run of missing entries, at the line of the entry before it."""
        row = parameter(self.values.kind, name)
        cells = self.values.cells(name)
        for missing, run in groupby(enumerate(used), lambda numbered: numbered[1] not in cells):
            if missing:
                (place, first), *others = run
                line = cells[used[place - 1]][1] if place else self.first_line(name)
                what = f"{row.named(*first)} … {row.named(*others[-1][1])} are" if others else f"{row.named(*first)} is"
                message = f"{what} missing; 0 is used."
                self._findings.add("AXC-GAP", self.values.file, line, row.named(*first), message)

    def first_line(self, name: str) -> int:
        """Return the line of a column's first entry in the list, 0 where there is none."""
        return min((line for _, line in self.values.cells(name).values()), default=0)

    def note_unused(self, name: str, reason: str) -> None:
        """Say that entries which are there are not used."""
        count = self.values.count(name)
        if count:
            first = min(self.values.cells(name))
            self.note("AXC-UNUSED", name, f"{count:,} entries of {name} are not used: {reason}.", *first)

    def ascending(self, positions: Sequence[float], name: str, code: str, size_name: str) -> bool:
        """Check that positions ascend strictly and are of a sensible size; a finding at the first that does not."""
        for index, (before, after) in enumerate(pairwise(positions), 1):
            if after <= before:
                message = self._not_ascending(name, index, size_name)
                self.note(code, name, f"{message}; the compensation stays off.", *([index] if "[" in name else []))
                return False
        if max(-positions[0], positions[-1]) >= POSITION_MAX:
            self.note(code, name, f"The values of {name} go beyond ±{POSITION_MAX:g}; the compensation stays off.")
            return False
        return True

    def _not_ascending(self, name: str, index: int, size_name: str) -> str:
        """Say which entry does not ascend, in the numbers that stand in the list."""
        values = self.values
        if "[" not in name:
            return f"{name} is too small for positions as large as these: they do not ascend"
        shown = parameter(self.values.kind, name).named(index)
        before, after = values.value(name, index - 1), values.value(name, index)
        if values.given(name, index):
            return f"{shown} = {after} is not above the entry before it, {before}"
        size = f"is {size_name} = {values.value(size_name)} too large?"
        return f"{shown} is missing, and the {after} in its place is not above {before} before it ({size})"
