"""Variations of a machine: entries of its lists, and tables that are scaled."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from pathlib import PurePosixPath

from ..kinds import KINDS, key_of
from ..lists import SPELLINGS, Document, Reading, number, read_machine, string
from ..model import Axis, Machine

Value = bool | int | float | str

_VOLUMETRIC = re.compile(r"volumetric\[([0-4])\](?:\.(\w+))?\Z")
_INDEX = re.compile(r"\[\s*(\d*)\s*\]")


@dataclass(frozen=True)
class ListEntry:
    """``achskw1.lis: kw.ssfk.table[].pos``: an entry of a list, or one in each row of a table.

    ``file``: name of the list, with as many folders in front as tell it from others; ``entry``: empty indices: all that
    are there; ``scale``: multiply the numbers that are there; else set them.
    """

    file: str
    entry: str
    scale: bool

    def chosen(self, names: Iterable[str]) -> str:
        """Return which of the files is meant; ValueError if none or several are."""
        wanted = PurePosixPath(self.file.replace("\\", "/").lower()).parts
        known = sorted(names)
        found = [name for name in known if PurePosixPath(name.lower()).parts[-len(wanted) :] == wanted]
        if len(found) != 1:
            said = "there are several lists" if found else "there is no list"
            raise ValueError(f"{said} {self.file}; the machine's files are {', '.join(known)}")
        return found[0]

    def applied(self, document: Document, value: Value) -> None:
        """Change the entry in a list; ValueError with a sentence if that cannot be."""
        kind = document.kind
        row = None if kind is None else SPELLINGS[kind].get(key_of(self.entry))
        if kind is None or row is None:
            raise ValueError(f"{f'a list {kind.value}' if kind else self.file} has no entry {self.entry}")
        wanted = tuple(int(index) if index else None for index in _INDEX.findall(self.entry))
        meant = {
            entry.indices: entry.value
            for entry in document.entries
            if entry.parameter is row.parameter
            and all(index in {None, own} for index, own in zip(wanted, entry.indices, strict=False))
        }
        if not meant and (self.scale or None in wanted):
            raise ValueError(f"{self.file} has no entry {self.entry}")
        if not meant:
            document.set(self.entry, _plain(value))
        for indices, word in meant.items():
            document.set(self.entry, self._changed(word, value), *indices)

    def _changed(self, word: str, value: Value) -> Value | Decimal:
        if not self.scale:
            return _plain(value)
        old = number(word)
        if old is None:
            raise ValueError(f"{self.entry} is {word!r}, which is no number to scale")
        return Decimal(old) * Decimal(repr(value))


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
                scaled = axis.having(KINDS[kind].scaled(compensation, factor))
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
                tables.append(replace(table, values=tuple(factor * v for v in table.values)) if meant else table)
            volumetric.append(replace(one, errors=tuple(tables)))
        if not hit:
            raise ValueError(
                f"the machine has no errors {self.name}; there are {', '.join(_tables(machine)) or 'none'}"
            )
        return replace(machine, volumetric=tuple(volumetric))


def _tables(machine: Machine) -> list[str]:
    axes: Sequence[Axis] = machine.axes
    names = [f"{axis.name}.{one.kind}" for axis in axes for one in axis.compensations]
    return names + [f"volumetric[{one.index}]" for one in machine.volumetric]


def _plain(value: Value) -> Value:
    """Return a value without the quotes that a list would have."""
    found = string(value) if isinstance(value, str) else None
    return value if found is None or not found.quoted else found.value


def read_files(start: str, files: Mapping[str, bytes]) -> Reading:
    """Return the machine of lists by relative path, with ``/``; ``start``: what ``read_machine`` is to read."""
    return read_machine(start, documents=[Document(name, data) for name, data in files.items()])


def varied(reading: Reading, changes: Sequence[tuple[ListEntry, Value]]) -> Iterable[Document]:
    """Return the lists of a machine with some entries changed, one after the other; the other lists are shared.

    Raises
    ------
    ValueError
        If an entry cannot be changed.
    """
    documents = {path.as_posix(): document for path, document in reading.documents.items()}
    own = set()
    for entry, value in changes:
        name = entry.chosen(documents)
        if name not in own:
            own.add(name)
            if documents[name].kind is not None and documents[name].is_text:
                documents[name].entries  # noqa: B018  # parsed once, for all copies
            documents[name] = documents[name].copy()
        entry.applied(documents[name], value)
    return documents.values()
