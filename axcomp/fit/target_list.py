"""The compensation list a new table goes into: what it says already, and the list with the new table."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, ClassVar

from ..kinds import KINDS, ListKind, Severity, key_of
from ..lists import (
    CATALOGUE,
    START_UP_NAME,
    Axes,
    AxisSettings,
    Document,
    Findings,
    Lines,
    ListValues,
    Reading,
    TableReader,
    parameter,
    read_machine,
)
from ..measurement import MeasurementError
from ..model import Axis

_SETTINGS = {
    "max_points": "max_points",
    "manual_activation": "manual_activation",
    "n_cycles": "n_cycles",
    "modulo": "modulo",
    "set_pos_without_comp": "without_other_compensations",
    "position_delay": "position_delay",
    "reversal_lookahead": "reversal_lookahead",
    "scaling_factor": "scaling",
    "delay_cycles": "delay_cycles",
}
"""What a measurement says nothing about and a new table leaves as it is: end of the entry's name, and field."""

_PLACES = ("positions", "start1", "start2", "interval1", "interval2", "velocities")
"""Fields that say what the rows of a table are for."""


class TargetList:
    """A compensation list that is to get a new table.

    Attributes
    ----------
    list_kind : ListKind
    path : Path
    exists : bool
        False: it will be made.
    values : ListValues
        What it says; "kw.ssfk.max_points" and so on by ``values.integer``.
    number : int
        Logical number of its axis.
    reading : Reading or None
        The machine it belongs to: that of the ``hochlauf.lis`` beside it which names it, else the list alone.
    axis : Axis or None
        Its axis there; None for a new list.
    unit : str
        Unit of the axis' positions, "" where no axis list says it.
    """

    list_kind: ClassVar = ListKind.COMPENSATION

    def __init__(self, path: str | Path, number: int | None = None, name: str = "") -> None:
        """Open a list; ``number`` and ``name`` of the axis are for one that does not exist yet.

        Raises
        ------
        MeasurementError
            The list cannot be read, or says nothing or something else about the axis' number.
        """
        self.path = Path(path)
        self.exists = self.path.exists()
        self.reading: Reading | None = None
        self.axis: Axis | None = None
        self.unit = ""
        self._document = self._read(number) if self.exists else Document(path, kind=self.list_kind)
        self.values = self._document.values
        written = self.values.integer("kopf.achs_nr")
        if not written and not number:
            sentence = "The list does not say which axis it is for (kopf.achs_nr); give the axis' logical number."
            raise MeasurementError(str(self.path), 0, sentence)
        if written and number and written != number:
            line = self.values.line("kopf.achs_nr")
            raise MeasurementError(str(self.path), line, f"The list is for axis {written}, not {number}.")
        self.number = written or number or 0
        self._header = {} if written else {"kopf.achs_nr": str(self.number)}
        if name and not written:
            self._header["kopf.log_achs_name"] = f'"{name}"'
        if self.reading is not None:
            self.axis = next((axis for axis in self.reading.machine.axes if axis.number == self.number), None)
            if self.axis is not None and self._is_named():
                self.unit = self.axis.unit

    def before(self) -> dict[Path, bytes]:
        """Return what the list held when it was read."""
        return {self.path: self._document.data} if self.exists else {}

    def _read(self, number: int | None) -> Document:  # noqa: ARG002
        """Return the list, read with the machine whose start-up list beside it names it, else alone."""
        if not self.path.is_file():
            raise MeasurementError(str(self.path), 0, "The list cannot be read: it is no file.")
        self.reading = self._machine_in(self.path.parent)
        if self.reading is None or not self._is_named():
            self.reading = read_machine(self.path)
        return self._document_of(self.reading)

    @staticmethod
    def _machine_in(folder: Path) -> Reading | None:
        start_up = next((entry for entry in folder.iterdir() if entry.name.lower() == START_UP_NAME), None)
        return None if start_up is None else read_machine(start_up)

    def _document_of(self, reading: Reading) -> Document:
        document = next((one for path, one in reading.documents.items() if self._is_this(path)), None)
        if document is None or not document.is_text:
            about = next(finding for finding in reading.findings if self._is_this(finding.file))
            raise MeasurementError(str(self.path), 0, about.message.replace("The file", "The list"))
        same = document.kind is self.list_kind
        return document if same else Document(self.path, document.data, self.list_kind)

    def _is_named(self) -> bool:
        """Tell whether the start-up list names this one."""
        reading = self.reading
        return reading is not None and reading.start_up is not None and any(map(self._is_this, reading.documents))

    def _is_this(self, file: str | Path) -> bool:
        return Path(file).resolve() == self.path.resolve()

    def notes(self, kind: str) -> list[str]:
        """Return what was wrong with the list, and what keeps a new table from acting."""
        if self.reading is None:
            return []
        about = [finding for finding in self.reading.findings if self._is_this(finding.file)]
        errors = sum(finding.severity is Severity.ERROR for finding in about)
        notes = [f"The list had {errors} errors before; axcomp check says which."] if errors else []
        inactive = any(f.code in ("AXC-INACTIVE", "70495") and KINDS[kind].prefix in f.parameter for f in about)
        if inactive and self.present(kind) is None:
            notes.append(f"{KINDS[kind].activator.name} of the axis list has to be 1 for the table to act.")
        return notes

    def capacity(self, name: str) -> int:
        """Return how many entries the list reserves by a parameter ``…max_points``; 0 stands for the default."""
        return self.values.integer(name) or int(parameter(ListKind.COMPENSATION, name).default)

    def check_unit(self, unit: str) -> None:
        """Raise MeasurementError if the axis is known not to count in ``unit``."""
        if self.unit and self.unit != unit:
            raise MeasurementError(str(self.path), 0, f"The axis counts in {self.unit}, the measurement in {unit}.")

    def present(self, kind: str) -> Any:
        """Return the compensation of a kind that acts now, None if there is none."""
        return None if self.axis is None else getattr(self.axis, kind)

    def with_compensation(
        self, kind: str, compensation: Any, max_points: int | None = None, settled: Collection[str] = ()
    ) -> bytes:
        """Return the list with a new compensation; what a measurement says nothing about stays as it is.

        Parameters
        ----------
        kind : str
            Name of one.
        compensation : Leadscrew, Cross, Plane, Crosstalk or Friction
            Its ``max_points``, ``manual_activation`` and the like do not count: the list's do.
        max_points : int, optional
            Entries to reserve, where the list is to say so from now on.
        settled : collection of str, optional
            Ends of entries that otherwise stay, which the list is to say as ``compensation`` does.

        Raises
        ------
        ValueError
            A list cannot hold a value, or would not read back to what is meant.
        """
        how = KINDS[kind]
        lines = Lines(ListKind.COMPENSATION)
        if max_points is not None:
            compensation = replace(compensation, max_points=max_points)
        how.write(compensation, self.axis or Axis(self.number, ""), lines)
        owned = {
            row.name
            for row in CATALOGUE[ListKind.COMPENSATION]
            if row.name.startswith(how.prefix) and self._is_owned(row.name, kind, max_points is not None, settled)
        }
        keys = {key_of(name) for name in owned}
        new = [line for line in lines.text().split("\n") if key_of(line.partition(" ")[0]) in keys]
        document = self._with_header()
        document.replace_entries(new, owned, how.title, self._rows_stay(kind, compensation))
        self._check(kind, compensation, document, max_points is not None, settled)
        return document.to_bytes()

    def _with_header(self) -> Document:
        """Return the list that says which axis it is for."""
        document = self._document.copy()
        if self._header:
            header = [f"{name:<40} {value}" for name, value in self._header.items()]
            document.replace_entries(header, self._header, "Axis")
        return document

    @staticmethod
    def _is_owned(name: str, kind: str, with_max_points: bool, settled: Collection[str]) -> bool:
        end = name.rpartition(".")[2]
        if end == "max_points":
            return with_max_points or kind == "crosstalk"
        return end not in _SETTINGS or end in settled

    def _rows_stay(self, kind: str, compensation: Any) -> bool:
        """Tell whether the rows of a table are for the same positions as before."""
        before = self._parsed(kind, self.values, Findings())
        names = [name for name in _PLACES if hasattr(compensation, name)]
        return (
            type(before) is type(compensation)
            and bool(names)
            and all(getattr(before, name) == getattr(compensation, name) for name in names)
        )

    def _parsed(self, kind: str, values: ListValues, findings: Findings) -> Any:
        """Return the compensation that values describe for the axis, whatever axes it refers to."""
        axes = Axes(findings, invent=True)
        for axis in () if self.reading is None else self.reading.axes.all():
            axes.add(axis, values.file, 0, "")
        if self.number not in axes:
            axes.add(AxisSettings(self.number), values.file, 0, "")
        return KINDS[kind].read(TableReader(values, axes.get(self.number), axes, findings))

    def _check(
        self, kind: str, intended: Any, document: Document, with_max_points: bool = False, settled: Collection[str] = ()
    ) -> None:
        """Read the new list and compare: a list with a damaged group could hide what is put into it."""
        findings = Findings()
        found = self._parsed(kind, document.values, findings)
        if type(found) is type(intended):
            names = {field.name for field in fields(intended)}
            kept = {name for end, name in _SETTINGS.items() if name in names and end not in settled}
            if with_max_points or kind == "crosstalk":
                kept.discard("max_points")
            if replace(intended, **{name: getattr(found, name) for name in kept}) == found:
                return
        why = next((f.message for f in findings.all() if f.severity is Severity.ERROR), "is it damaged?")
        raise ValueError(f"{self.path}: with the new {kind} table the list would not say what is meant; {why}")
