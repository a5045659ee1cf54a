"""Where in the lists something stands: file, line and entry of what a judgement is about."""

from __future__ import annotations

from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from ...kinds.parameter import ListKind
from ...lists.catalogue import parameter
from ...lists.files import Files
from ...lists.findings import Findings
from ...lists.start_up import MachineFiles, find_lists
from ...lists.values import ListValues, read_values

_NUMBER = "kopf.achs_nr"


class Place(NamedTuple):
    """Where something stands; ``line`` is 0 where that is not known."""

    file: str
    line: int
    parameter: str


class ListPlaces:
    """Finds entries of a machine's lists; the lists are read when the first one is asked for.

    Parameters
    ----------
    path : path or None
        As ``read_machine`` takes it; None: the machine does not come from lists, and every place has file "".
    """

    def __init__(self, path: str | PathLike[str] | None) -> None:
        self._path = None if path is None else Path(path)

    def of_table(self, axis: int, name: str, *indices: int) -> Place:
        """Return the place of an entry in the compensation list of an axis, else of the first one of its table."""
        return self._place(self._compensation.get(axis), ListKind.COMPENSATION, name, indices)

    def of_axis(self, axis: int, name: str) -> Place:
        """Return the place of an entry in the axis list of an axis."""
        return self._place(self._axes.get(axis), ListKind.AXIS, name, ())

    def of_volumetric(self, index: int) -> Place:
        """Return the place that names the list of a volumetric compensation."""
        start_up = self._lists.start_up
        return self._place(start_up, ListKind.START_UP, "vol_comp[i].file_name", (index,))

    def _place(self, values: ListValues | None, kind: ListKind, name: str, indices: tuple[int, ...]) -> Place:
        shown = parameter(kind, name).named(*indices) if indices else name
        if values is None:
            return Place("" if self._path is None else str(self._path), 0, shown)
        if indices and not values.given(name, *indices):
            first = min((line for _, line in values.cells(name).values()), default=0)
            return Place(values.file, first, shown)
        return Place(*values.place(name, *indices), shown)

    @cached_property
    def _lists(self) -> MachineFiles:
        if self._path is None:
            return MachineFiles(Path())
        findings = Findings()
        return find_lists(self._path, Files(findings), findings)

    @cached_property
    def _axes(self) -> dict[int, ListValues]:
        fallback = None
        if self._lists.axis_default is not None:
            fallback = self._values(self._lists.axis_default, ListKind.AXIS)
        return self._by_number([(named.path, 0) for named in self._lists.axis], ListKind.AXIS, fallback)

    @cached_property
    def _compensation(self) -> dict[int, ListValues]:
        named = [(one.path, one.log_ax_nr) for one in self._lists.compensation]
        return self._by_number(named, ListKind.COMPENSATION)

    def _by_number(
        self, lists: list[tuple[Path, int]], kind: ListKind, fallback: ListValues | None = None
    ) -> dict[int, ListValues]:
        """Return lists by the axis they are for; of two for one axis the first counts, as it does for the reader."""
        found: dict[int, ListValues] = {}
        unnumbered = []
        for path, expected in lists:
            values = self._values(path, kind, fallback)
            if values is not None:
                number = (values.integer(_NUMBER) if values.given(_NUMBER) else 0) or expected
                if number:
                    found.setdefault(number, values)
                else:
                    unnumbered.append(values)
        # The reader numbers lists that do not say which axis they are for by the first numbers that are free.
        for values in unnumbered:
            found[next(number for number in range(1, len(found) + 2) if number not in found)] = values
        return found

    @staticmethod
    def _values(path: Path, kind: ListKind, fallback: ListValues | None = None) -> ListValues | None:
        text = Files(Findings()).text(path)
        return None if text is None else read_values(text, str(path), kind, Findings(), fallback)
