"""Where in the lists something stands: file, line and entry of what a judgement is about."""

from __future__ import annotations

from ...kinds import ListKind
from ...lists import Document, Position, Reading, parameter


def sentence(text: str) -> str:
    """Return a text with a capital at its beginning."""
    return f"{text[:1].upper()}{text[1:]}"


class Positions:
    """Finds entries of a machine's lists; without a reading every position has file ""."""

    def __init__(self, reading: Reading | None) -> None:
        self._reading = reading

    def of_table(self, axis: int, name: str, *indices: int) -> Position:
        """Return the position of an entry in the compensation list of an axis; without indices of the first."""
        document = None if self._reading is None else self._reading.compensation_list(axis)
        return self._position(document, ListKind.COMPENSATION, name, indices or (0,) * name.count("["))

    def of_axis(self, axis: int, name: str) -> Position:
        """Return the position of an entry in the axis list of an axis."""
        document = None if self._reading is None else self._reading.axis_list(axis)
        return self._position(document, ListKind.AXIS, name, ())

    def of_volumetric(self, index: int) -> Position:
        """Return the position that names the list of a volumetric compensation."""
        document = None if self._reading is None else self._reading.start_up
        return self._position(document, ListKind.START_UP, "vol_comp[i].file_name", (index,))

    def _position(self, document: Document | None, kind: ListKind, name: str, indices: tuple[int, ...]) -> Position:
        if document is not None:
            return document.position(name, *indices)
        file = "" if self._reading is None else str(self._reading.path)
        return Position(file, 0, parameter(kind, name).named(*indices) if indices else name)
