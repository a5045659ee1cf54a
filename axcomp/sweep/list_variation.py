"""Variations of a machine: entries of its lists, and tables that are scaled."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from pathlib import Path, PurePosixPath
from typing import Any

from ..kinds import KINDS
from ..kinds.parameter import ListKind, key_of
from ..lists import Finding, Severity, read_machine
from ..lists.catalogue import SPELLINGS
from ..lists.edit import edited
from ..lists.grammar import decode, entries, number
from ..model.machine import Axis, Machine

Value = bool | int | float | str

_VOLUMETRIC = re.compile(r"volumetric\[([0-4])\](?:\.(\w+))?\Z")
_INDEX = re.compile(r"\[\s*(\d*)\s*\]")


@dataclass(frozen=True)
class ListEntry:
    """``achskw1.lis: kw.ssfk.table[].pos``: an entry of a list, or one in each row of a table.

    Attributes
    ----------
    file : str
        Name of the list, with as many folders in front as tell it from others.
    entry : str
        Name of the entry; empty indices: all that are there.
    scale : bool
        Multiply the numbers that are there; else set them.
    """

    file: str
    entry: str
    scale: bool

    def place(self, files: Mapping[str, bytes]) -> str:
        """Return which of the files is meant; ValueError if none or several are."""
        wanted = PurePosixPath(self.file.replace("\\", "/").lower()).parts
        found = [name for name in files if PurePosixPath(name.lower()).parts[-len(wanted) :] == wanted]
        if len(found) != 1:
            said = "there are several lists" if found else "there is no list"
            raise ValueError(f"{said} {self.file}; the machine's files are {', '.join(sorted(files))}")
        return found[0]

    def applied(self, data: bytes, value: Value) -> bytes:
        """Return the list with the entry changed; ValueError with a sentence if that cannot be."""
        text = decode(data)
        if text is None:
            raise ValueError(f"{self.file} is no text")
        written = list(entries(text, lambda *_: None))
        kind = _kind_of({entry.key.lower() for entry in written})
        spelling = SPELLINGS[kind].get(key_of(self.entry))
        if spelling is None:
            raise ValueError(f"a list {kind.value} has no entry {self.entry}")
        parameter = spelling.parameter
        indices = tuple(int(index) if index else None for index in _INDEX.findall(self.entry))
        lines, hit = [], False
        for entry in written:
            known = SPELLINGS[kind].get(entry.key.lower())
            if known is None or known.parameter is not parameter:
                continue
            meant = all(wanted in {None, index} for wanted, index in zip(indices, entry.indices, strict=False))
            hit = hit or meant
            lines.append(f"{entry.name} {self._changed(entry.word, value) if meant else entry.text}")
        if not hit:
            if self.scale or None in indices:
                raise ValueError(f"{self.file} has no entry {self.entry}")
            lines.append(f"{self.entry} {_written(value)}")
        return edited(data, lines, [parameter.name], "Varied", True, kind)

    def _changed(self, word: str, value: Value) -> str:
        if not self.scale:
            return _written(value)
        old = number(word)
        if old is None:
            raise ValueError(f"{self.entry} is {word!r}, which is no number to scale")
        return str(Decimal(old) * Decimal(repr(value)))


@dataclass(frozen=True)
class Table:
    """``X.leadscrew``, ``volumetric[0]``, ``volumetric[0].EXX``: a compensation whose values are multiplied."""

    name: str

    def applied(self, machine: Machine, factor: float) -> Machine:
        """Return the machine with the values multiplied; ValueError if it has no such compensation."""
        if found := _VOLUMETRIC.match(self.name):
            return self._scaled_volume(machine, int(found[1]), found[2], factor)
        name, _, kind = self.name.rpartition(".")
        for place, axis in enumerate(machine.axes):
            compensation = getattr(axis, kind) if kind in KINDS and axis.name == name else None
            if compensation is not None:
                scaled = replace(axis, **{kind: _scaled(compensation, factor)})
                return replace(machine, axes=(*machine.axes[:place], scaled, *machine.axes[place + 1 :]))
        raise ValueError(f"there is no compensation {self.name}; there are {', '.join(_tables(machine)) or 'none'}")

    def _scaled_volume(self, machine: Machine, index: int, error: str | None, factor: float) -> Machine:
        volumetric = []
        hit = False
        for one in machine.volumetric:
            tables = []
            for table in one.errors:
                meant = one.index == index and error in {None, table.name}
                hit = hit or meant
                tables.append(replace(table, values=_times(table.values, factor)) if meant else table)
            volumetric.append(replace(one, errors=tuple(tables)))
        if not hit:
            raise ValueError(
                f"the machine has no errors {self.name}; there are {', '.join(_tables(machine)) or 'none'}"
            )
        return replace(machine, volumetric=tuple(volumetric))


_VALUES = {
    "Leadscrew": ("positive", "negative"),
    "Cross": ("corrections",),
    "Plane": ("corrections",),
    "Friction": ("currents",),
    "CrosstalkCurve": ("corrections",),
}
"""Fields with the values of each compensation; those of the crosstalk tests stand in records of their own."""


def _scaled(compensation: Any, factor: float) -> Any:
    fields = _VALUES.get(type(compensation).__name__)
    if fields is not None:
        return replace(compensation, **{name: _times(getattr(compensation, name), factor) for name in fields})
    tests = []
    for test in compensation.tests:
        sides = [f"{what}_{sign}" for what in ("accelerate", "decelerate") for sign in ("positive", "negative")]
        tests.append(replace(test, **{name: getattr(test, name) * factor for name in sides}))
    return replace(compensation, tests=tuple(tests))


def _times(values: Any, factor: float) -> Any:
    if values is None:
        return None
    return tuple(_times(value, factor) for value in values) if isinstance(values, tuple) else values * factor


def _tables(machine: Machine) -> list[str]:
    axes: Sequence[Axis] = machine.axes
    names = [f"{axis.name}.{one.kind}" for axis in axes for one in axis.compensations]
    return names + [f"volumetric[{one.index}]" for one in machine.volumetric]


def _kind_of(keys: set[str]) -> ListKind:
    """Return the kind of list that knows most of some names."""
    return max(ListKind, key=lambda kind: sum(key in SPELLINGS[kind] for key in keys))


def _written(value: Value) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)


def read_files(
    start: str, files: Mapping[str, bytes], changes: Sequence[tuple[ListEntry, Value]] = ()
) -> tuple[Machine, list[tuple[Finding, str]]]:
    """Return the machine that lists describe, with some entries changed, and what there is to say about it.

    Parameters
    ----------
    start : str
        What ``read_machine`` is to read, relative to where the files lie.
    files : mapping of str to bytes
        By relative path, with ``/``.
    changes : sequence of (ListEntry, Value)
        In the order in which they are made.

    Returns
    -------
    Machine, list of (Finding, str)
        Each finding with its text, in which files are relative.

    Raises
    ------
    ValueError
        If an entry cannot be changed.
    """
    changed = dict(files)
    for entry, value in changes:
        place = entry.place(changed)
        changed[place] = entry.applied(changed[place], value)
    with tempfile.TemporaryDirectory(prefix="axcomp-sweep-") as folder:
        for name, data in changed.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        machine, findings = read_machine(Path(folder, start))
        relative: Callable[[Finding], str] = lambda finding: str(finding).replace(f"{folder}{os.sep}", "")  # noqa: E731
        return machine, [(f, relative(f)) for f in findings if f.severity in {Severity.ERROR, Severity.WARNING}]
