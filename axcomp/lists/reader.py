"""All lists of a machine, read into one ``Machine``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from ..kinds import KINDS, Kind, ListKind, Severity
from ..model import Axis, AxisType, Compensation, Machine, ModuloRange, Volumetric
from .axes import Axes, AxisSettings, read_axis
from .compensation import TableReader
from .document import Document
from .files import Files
from .findings import Finding, Findings, ListError
from .positions import located, outside
from .reading import Reading, TypeName
from .start_up import MachineFiles, NamedList, find_lists
from .values import ListValues
from .volumetric_list import check_parameters, read_one, read_volumetric

_TYPES: dict[TypeName, dict[str, Any]] = {
    "translatory": {},
    "rotary": {"type": AxisType.ROTARY},
    "modulo": {"type": AxisType.ROTARY, "modulo": ModuloRange()},
}


_NUMBER = "kopf.achs_nr"


def read_machine(
    path: str | PathLike[str],
    *,
    strict: bool = False,
    documents: Iterable[Document] | None = None,
    beside_disk: bool = False,
    axis_type: TypeName | None = None,
    allow_outside: Iterable[str | PathLike[str]] = (),
) -> Reading:
    """Read the lists of a machine.

    Nothing in a list raises: what is wrong becomes a finding, and the controller's default is used.

    Parameters
    ----------
    path : path
        A start-up list, a folder with one, a folder of compensation lists, or a single list of any kind. Without
        any axis list every compensation with a plausible table acts.
    strict : bool
        Raise if there is a finding of severity error.
    documents : iterable of Document, optional
        These are all files there are; the disk is not looked at.
    beside_disk : bool
        The disk is looked at for what ``documents`` lack: so an editor sees lists that are not saved.
    axis_type : str, optional
        ``rotary`` or ``modulo``: without any axis list, of the axes that have compensation lists. All others, and all
        without it, are translatory.
    allow_outside : iterable of path
        Folders that names in the lists may lead into; else only the folder of the machine.

    Raises
    ------
    ListError
        In strict mode, with all findings of severity error.

    Examples
    --------
    >>> from axcomp import models, read_machine
    >>> reading = read_machine(models() / "warm_axis", strict=True)
    >>> [axis.name for axis in reading.machine.axes], len(reading.findings)
    (['X', 'Y'], 0)
    """
    findings = Findings()
    allowed = tuple(map(Path, allow_outside))
    reader = _MachineReader(findings, Files(findings, documents, beside_disk, allowed), axis_type)
    reading = replace(reader.read(Path(path)), allow_outside=allowed)
    errors = [finding for finding in reading.findings if finding.severity is Severity.ERROR]
    if strict and errors:
        raise ListError(errors)
    return reading


def reread_volumetric(
    path: str | PathLike[str], index: int, files: Mapping[int, str], allow_outside: Iterable[str | PathLike[str]] = ()
) -> tuple[Volumetric | None, tuple[Finding, ...]]:
    """Read one volumetric compensation of a machine again.

    Parameters
    ----------
    path : path
        As for ``read_machine``.
    index : int
        Of the compensation.
    files : mapping of int to str
        Parameter files to be read instead of those the list names, by their index.
    allow_outside : iterable of path
        As for ``read_machine``.

    Returns
    -------
    Volumetric or None
        None if there is none, or an error keeps it off.
    tuple of Finding
        What there is to say about this compensation.
    """
    findings, others = Findings(), Findings()
    allowed = tuple(map(Path, allow_outside))
    start = _MachineReader(others, Files(others, allowed=allowed)).start(Path(path))
    if start is None:
        return None, ()
    read = Files(findings, allowed=allowed)
    volumetric = read_one(index, start.lists, read, start.axes, findings, files)
    return volumetric, outside(located(findings.all(), read.documents), read.documents)


class _Start(NamedTuple):
    """What is known before the tables are read: the compensation lists by axis number, and all axes."""

    lists: MachineFiles
    axes: Axes
    tables: dict[int, ListValues]


class _Acting(NamedTuple):
    """The compensations of an axis, and the room that is reserved for tables it does not have yet; by kind."""

    compensations: dict[str, Compensation]
    reserved: dict[str, int]

    def arguments(self) -> dict[str, Any]:
        return {**self.compensations, "reserved": self.reserved}


class _MachineReader:
    """Reads axis lists, then compensation lists, then the tables: these need to know all axes."""

    def __init__(self, findings: Findings, files: Files, axis_type: TypeName | None = None) -> None:
        self.findings = findings
        self.files = files
        self.axis_type = axis_type
        self._axis_lists: dict[int, Document] = {}
        self._compensation_lists: dict[int, Document] = {}

    def start(self, path: Path) -> _Start | None:
        """Read all but the tables; None, with a finding, if that is impossible."""
        try:
            lists = find_lists(path, self.files, self.findings)
        except (OSError, ValueError) as error:
            self.findings.add("AXC-UNREADABLE", str(path), 0, "", f"The path cannot be used: {error}.")
            return None
        axes = Axes(self.findings, invent=not lists.has_axis_lists)
        if self.axis_type and not axes.invent:
            message = f"The axes are not taken to be {self.axis_type}: there are axis lists, which say what they are."
            self.findings.add("AXC-UNUSED", str(path), 0, "", message)
        default = self._default_values(lists)
        self._read_axis_lists(lists, axes, default)
        return _Start(lists, axes, self._read_compensation_lists(lists, axes, default))

    def read(self, path: Path) -> Reading:
        """Return the machine whose lists are at a path."""
        start = self.start(path)
        if start is None:
            start = _Start(MachineFiles(path), Axes(self.findings, invent=True), {})
        lists, axes, tables = start
        machine = self._machine(lists, axes, tables)
        documents = self.files.documents
        inner = located(self.findings.all(), documents)
        return Reading(
            machine,
            outside(inner, documents),
            path,
            documents,
            next((one for one in documents.values() if one.kind is ListKind.START_UP), None),
            axes,
            self._axis_lists,
            self._compensation_lists,
            self.axis_type,
            inner,
        )

    def _machine(self, lists: MachineFiles, axes: Axes, tables: dict[int, ListValues]) -> Machine:
        # Reading a table may add the axes it refers to.
        acting = {
            axis.number: self._compensations(axis, tables.get(axis.number), axes, lists.has_tables)
            for axis in axes.all()
        }
        volumetric = read_volumetric(lists, self.files, axes, self.findings)
        if lists.parameters is not None:
            check_parameters(lists.parameters, self.files, self.findings)
        names = axes.names()
        return Machine(
            tuple(
                Axis(
                    number=axis.number,
                    name=names[axis.number],
                    type=axis.type,
                    modulo=axis.modulo,
                    backlash_cycles=axis.backlash_cycles,
                    volumetric_limit=axis.s_limit or None,
                    volumetric_velocity=axis.v_limit or None,
                    gantry_master=axis.gantry_master or None,
                    **acting.get(axis.number, _Acting({}, {})).arguments(),
                )
                for axis in axes.all()
            ),
            volumetric,
        )

    def _values(self, path: Path, kind: ListKind, fallback: ListValues | None = None) -> ListValues | None:
        """Read one list; None with a finding where there is nothing in it."""
        document = self.files.document(path)
        if document is None:
            return None
        values = document.read_as(kind, self.findings, fallback)
        if values.looks_like is not None:
            message = f"This looks like a list {values.looks_like.value}, not {kind.value}; it is not used."
            self.findings.add("AXC-KIND", str(path), 0, "", message)
        elif not values and not (kind is ListKind.AXIS and values.others):
            self.findings.add("AXC-EMPTY", str(path), 0, "", f"The list has no entry of a list {kind.value}.")
        else:
            return values
        return None

    def _default_values(self, lists: MachineFiles) -> ListValues | None:
        return None if lists.axis_default is None else self._values(lists.axis_default, ListKind.AXIS)

    def _read_axis_lists(self, lists: MachineFiles, axes: Axes, default: ListValues | None) -> None:
        for named in lists.axis:
            values = self._values(named.path, ListKind.AXIS, default)
            if values is None:
                continue
            # The list for all axes cannot number them.
            number = values.integer(_NUMBER) if values.given(_NUMBER) else named.log_ax_nr
            if not number:
                self._note("AXC-NUMBER", values, "The list does not say which axis it is for; it is not used.")
            elif number in axes:
                self._note_twice(number, values)
            elif axes.add(read_axis(number, values, self.findings), *_at_number(values)):
                self._axis_lists[number] = self.files.documents[named.path]

    def _read_compensation_lists(
        self, lists: MachineFiles, axes: Axes, default: ListValues | None
    ) -> dict[int, ListValues]:
        """Return the compensation lists by axis number; axes that no axis list describes are added."""
        read = [(named, self._values(named.path, ListKind.COMPENSATION)) for named in lists.compensation]
        tables: dict[int, ListValues] = {}
        numbers = {values.integer(_NUMBER) for _, values in read if values is not None}
        for named, values in read:
            if values is None or not (number := self._number(named, values, axes, numbers)):
                continue
            if number in tables:
                self._note_twice(number, values)
            elif number in axes or self._add_axis(number, values, axes, default, lists):
                tables[number] = values
                self._compensation_lists[number] = self.files.documents[named.path]
                axis = axes.get(number)
                axis.take_name(values)
        return tables

    def _number(self, named: NamedList, values: ListValues, axes: Axes, numbers: set[int]) -> int:
        """Return the axis a compensation list is for, 0 with a finding where that is not clear."""
        own = values.integer(_NUMBER)
        if own and named.log_ax_nr and own != named.log_ax_nr:
            message = f"Axis {named.log_ax_nr} is expected, but {values.file} is for axis {own}; that list is not used."
            self.findings.add("110229", *named.number_position, message)
            return 0
        if own or named.log_ax_nr:
            return own or named.log_ax_nr
        if not axes.invent:
            self._note("AXC-NUMBER", values, "The list does not say which axis it is for; it is not used.")
            return 0
        free = next(number for number in range(1, len(numbers) + 2) if number not in numbers)
        numbers.add(free)
        self._note("AXC-NUMBER", values, f"The list does not say which axis it is for; {free} is used.")
        return free

    def _add_axis(
        self, number: int, values: ListValues, axes: Axes, default: ListValues | None, lists: MachineFiles
    ) -> bool:
        """Add an axis that has a compensation list but no axis list."""
        if axes.invent:
            return axes.add(AxisSettings(number, **_TYPES[self.axis_type or "translatory"]), *_at_number(values))
        if lists.axis_default is None:
            self._note("AXC-NO-AXIS-LIST", values, f"Axis {number} has no axis list: nothing activates this list.")
        settings = read_axis(number, ListValues("", ListKind.AXIS, default), self.findings)
        return axes.add(settings, *_at_number(values))

    def _note(self, code: str, values: ListValues, message: str) -> None:
        self.findings.add(code, *_at_number(values), message)

    def _note_twice(self, number: int, values: ListValues) -> None:
        message = f"Axis {number} has a list of this kind already; this one is not used."
        self._note("AXC-NUMBER-TWICE", values, message)

    def _compensations(self, axis: AxisSettings, table: ListValues | None, axes: Axes, has_tables: bool) -> _Acting:
        """Return what acts on an axis, and what is activated without a table."""
        found = _Acting({}, {})
        for name, kind in KINDS.items():
            active = axis.activated is None or axis.activated[name]
            values = table if kind.list_kind is ListKind.COMPENSATION else axis.values if active else None
            compensation = None
            if values is not None and (kind.list_kind is ListKind.AXIS or kind.is_present(values)):
                source = TableReader(values, axis, axes, self.findings)
                compensation = kind.read(source)
                if not active and compensation is not None:
                    self._note_inactive(kind, source)
            elif active and axis.values is not None and has_tables:
                code, entry = kind.no_table_code, kind.activator.name
                message = f"{entry} is 1, but axis {axis.number} has no {name} table; nothing is compensated."
                self.findings.add(code, *axis.values.place(entry), entry, message)
            if active and compensation is not None:
                found.compensations[name] = compensation
            elif active and axis.values is not None:
                found.reserved[name] = kind.reserved(None, values)
        return found

    @staticmethod
    def _note_inactive(kind: Kind[Any], source: TableReader) -> None:
        # There may be no more of a table than its size.
        name = next(name for name in (*kind.columns, *kind.sizes) if source.values.cells(name))
        entry = kind.activator.name
        message = f"There is a {kind.name} table, but {entry} of axis {source.axis.number} is 0: it does not act."
        source.note(kind.inactive_code, name, message, *min(source.values.cells(name)))


def _at_number(values: ListValues) -> tuple[str, int, str]:
    return values.file, values.line(_NUMBER), _NUMBER
