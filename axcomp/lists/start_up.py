"""Which lists make up a machine: those that a start-up list names, or those that lie in a folder."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ..kinds import ListKind
from .document import Document
from .files import Files
from .findings import Findings
from .project import Project, looks_like_project
from .recognition import START_UP_NAME, kind_of, parameter_format
from .values import ListValues

_LISTS_MAX = 32


@dataclass(frozen=True)
class NamedList:
    """A list to be read.

    Attributes
    ----------
    path : Path
    log_ax_nr : int
        Logical axis number the start-up list gives it, 0 where it gives none (P-STUP-00036).
    number_position : tuple of str, int and str
        File, line and parameter of that number.
    """

    path: Path
    log_ax_nr: int = 0
    number_position: tuple[str, int, str] = ("", 0, "")


@dataclass
class MachineFiles:
    """The lists of a machine.

    Attributes
    ----------
    compensation, axis : list of NamedList
        In their order.
    axis_default : Path or None
        The axis list that is read first, for all axes (P-STUP-00035).
    start_up : ListValues or None
        The start-up list itself, where there is one.
    volumetric : list of Path
        Volumetric lists that no start-up list names.
    parameters : Path or None
        A file of volumetric parameters that is looked at on its own.
    has_tables : bool
        False for an axis list on its own: nothing can be said about tables.
    folder : Path
        What file names are relative to.
    """

    folder: Path
    compensation: list[NamedList] = field(default_factory=list)
    axis: list[NamedList] = field(default_factory=list)
    axis_default: Path | None = None
    start_up: ListValues | None = None
    volumetric: list[Path] = field(default_factory=list)
    parameters: Path | None = None
    has_tables: bool = True

    @property
    def has_axis_lists(self) -> bool:
        """Whether axis lists decide what acts."""
        return bool(self.axis) or self.axis_default is not None


def find_lists(path: Path, files: Files, findings: Findings) -> MachineFiles:
    """Return the lists of a machine: ``path`` is a start-up list, a folder, or a single list of any kind."""
    is_folder = files.is_dir(path)
    files.enter(path if is_folder else path.parent)
    if is_folder:
        found = _in_folder(path, START_UP_NAME, files)
        if not found:
            return _lists_of_folder(path, files, findings)
        path = found[0]
    document = files.document(path)
    if document is None:
        return MachineFiles(path.parent)
    if looks_like_project(document):
        return _lists_of_project(files.project(path), files, findings)
    kind = kind_of(path.name, document.text)
    if kind is ListKind.START_UP:
        return _lists_of_start_up(document, files, findings)
    if parameter_format(document.text):
        return MachineFiles(path.parent, parameters=path)
    if kind is ListKind.AXIS:
        return MachineFiles(path.parent, axis=[NamedList(path)], has_tables=False)
    if kind is ListKind.VOLUMETRIC:
        return MachineFiles(path.parent, volumetric=[path])
    return MachineFiles(path.parent, [NamedList(path)])


def _in_folder(folder: Path, pattern: str, files: Files) -> list[Path]:
    """Return the files of a folder that match, whatever their case, numbers in their order."""
    found = [entry for entry in files.children(folder) if Path(entry.name.lower()).match(pattern)]

    def by_number(entry: Path) -> list[tuple[int, str]]:
        return [(int(digits or 0), letters) for digits, letters in re.findall(r"([0-9]{1,9})|([^0-9]+)", entry.name)]

    return sorted(found, key=by_number)


def _lists_of_folder(folder: Path, files: Files, findings: Findings) -> MachineFiles:
    """Take all compensation and axis lists of a folder that has no start-up list."""
    lists = MachineFiles(folder)
    for kind, taken in ((ListKind.COMPENSATION, lists.compensation), (ListKind.AXIS, lists.axis)):
        found = _in_folder(folder, kind.value, files)
        taken.extend(map(NamedList, found[:_LISTS_MAX]))
        if len(found) > _LISTS_MAX:
            message = f"{len(found)} files {kind.value}: only the first {_LISTS_MAX} are read."
            findings.add("AXC-AXES", str(folder), 0, "", message)
    if not lists.compensation and not lists.axis:
        message = f"The folder has neither a {START_UP_NAME} nor lists achskw*.lis."
        findings.add("AXC-MISSING", str(folder), 0, "", message)
    return lists


def _lists_of_project(project: Project, files: Files, findings: Findings) -> MachineFiles:
    """Take all lists of a project file; file names in them are relative to it."""
    path = project.path
    if project.fault:
        findings.add("AXC-UNREADABLE", str(path), project.fault_line, "", f"The file is no XML: {project.fault}.")
    elif not project.sections:
        findings.add("AXC-EMPTY", str(path), 0, "", "The project file holds no list of an axis.")
    starts = project.of_kind(ListKind.START_UP)
    lists = _lists_of_start_up(starts[0], files, findings) if starts else MachineFiles(path.parent)
    for kind, taken in ((ListKind.COMPENSATION, lists.compensation), (ListKind.AXIS, lists.axis)):
        taken.extend(NamedList(one.path, one.axis_number, (str(one.path), 0, "")) for one in project.of_kind(kind))
    lists.volumetric = [one.path for one in project.of_kind(ListKind.VOLUMETRIC)]
    return lists


def _lists_of_start_up(document: Document, files: Files, findings: Findings) -> MachineFiles:
    path = document.path
    values = document.read_as(ListKind.START_UP, findings)
    lists = MachineFiles(path.parent, start_up=values)
    if not values and not values.others:
        findings.add("AXC-EMPTY", str(path), 0, "", "The list has no entry.")
    if values.text("default_achs_mds"):
        position = (*values.place("default_achs_mds"), "default_achs_mds")
        lists.axis_default = files.named(path.parent, values.text("default_achs_mds"), position)
    lists.axis.extend(_named_lists(values, "zahl_mds", "achs_mds[i]", files, lists.folder, findings))
    for named in _named_lists(values, "zahl_kw", "achs_kw[i]", files, lists.folder, findings):
        lists.compensation.append(named)
    return lists


def _named_lists(
    values: ListValues, count_name: str, name: str, files: Files, folder: Path, findings: Findings
) -> Iterator[NamedList]:
    """Yield the lists that entries below the count name; findings about missing ones, and compensations beyond it."""
    count = values.integer(count_name)
    if not values.given(count_name) and values.cells(name):
        findings.add("AXC-UNUSED", values.file, 0, count_name, f"{count_name} is missing: no {name} is used.")
    for index in range(count):
        parameter = name.replace("[i]", f"[{index}]")
        if not values.text(name, index):
            message = f"{parameter} is missing, although {count_name} is {count}."
            findings.add("AXC-MISSING", values.file, values.line(count_name), parameter, message)
            continue
        path = files.named(folder, values.text(name, index), (*values.place(name, index), parameter))
        if path is not None:
            number, numbered = f"achs_kw_log_ax_nr[{index}]", "achs_kw_log_ax_nr[i]"
            position = (*values.place(numbered, index), number)
            yield NamedList(path, values.integer(numbered, index) if name == "achs_kw[i]" else 0, position)
    beyond = sorted(indices for indices in values.cells(name) if indices[0] >= count)
    # Start-up lists often name more axes than the machine has.
    if beyond and values.given(count_name) and name == "achs_kw[i]":
        message = f"{len(beyond)} entries {name} lie beyond {count_name} = {count}; they are not used."
        shown = name.replace("[i]", f"[{beyond[0][0]}]")
        findings.add("AXC-UNUSED", values.file, values.line(name, *beyond[0]), shown, message)
