"""The axis list that a compensation goes into which has no table."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any, ClassVar

from ..kinds import KINDS, ListKind
from ..lists import Document, Findings, Lines, Reading, entries
from ..measurement import MeasurementError
from ..model import Axis, AxisType
from .target_list import TargetList


class AxisList(TargetList):
    """An axis list that is to get a compensation: see ``TargetList``.

    It may be opened by its own name; by that of the start-up list, or the folder with one, and a logical number; or by
    the name of the compensation list of the axis, where the start-up list beside that names both.
    """

    list_kind: ClassVar = ListKind.AXIS

    def __init__(self, path: str | Path, number: int | None = None, name: str = "") -> None:
        super().__init__(path, number, name)
        if self.exists and self.axis is None:
            self.unit = Axis(self.number, "", type=AxisType(self.values.integer("kenngr.achs_typ"))).unit

    def _read(self, number: int | None) -> Document:
        self.reading = self._machine_in(self.path if self.path.is_dir() else self.path.parent)
        if self.reading is not None and (self.path.is_dir() or self._is_named()):
            self.path = self._found(self.reading, number)
            return self._document_of(self.reading)
        self.reading = None
        if not self.path.is_file():
            raise MeasurementError(str(self.path), 0, "The list cannot be read: it is no file.")
        document = Document(self.path, self.path.read_bytes(), self.list_kind)
        if not document.is_text:
            raise MeasurementError(str(self.path), 0, "The list is no text.")
        looks_like = document.values.looks_like
        if looks_like is not None:
            sentence = f"This looks like a list {looks_like.value}, not {self.list_kind.value}."
            raise MeasurementError(str(self.path), 0, sentence)
        return document

    def _found(self, reading: Reading, number: int | None) -> Path:
        """Return where the axis list is."""
        given = next((one for path, one in reading.documents.items() if self._is_this(path)), None)
        if given is not None and given.kind is self.list_kind:
            return self.path
        axes = [axis.number for axis in reading.machine.axes]
        own = [axis for axis in axes if given is not None and reading.compensation_list(axis) is given]
        found = [reading.axis_list(axis) for axis in own or ([number] if number else axes)]
        lists = [document.path for document in found if document is not None]
        if len(lists) == 1:
            return lists[0]
        sentence = "give the axis' logical number." if lists else "there is none of this axis."
        raise MeasurementError(str(self.path), 0, f"The compensation goes into an axis list; {sentence}")

    def present(self, kind: str) -> Any:
        """Return the compensation of a kind that acts now, None if there is none."""
        if self.axis is not None:
            return super().present(kind)
        return self._parsed(kind, self.values, Findings()) if KINDS[kind].is_activated(self.values) else None

    def with_compensation(
        self,
        kind: str,
        compensation: Any,
        max_points: int | None = None,  # noqa: ARG002
        settled: Collection[str] = (),  # noqa: ARG002
    ) -> bytes:
        """Return the list with a compensation, activated; ValueError if it cannot hold a value."""
        how, lines = KINDS[kind], Lines(self.list_kind)
        lines.add(how.activator.name, how.activation(compensation))
        how.write(compensation, self.axis or Axis(self.number, ""), lines)
        document = self._with_header()
        for entry in entries(lines.text(), lambda *_: None):
            document.set(entry.name, entry.word)
        self._check(kind, compensation, document)
        return document.to_bytes()
