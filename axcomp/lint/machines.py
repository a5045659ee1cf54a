"""Machines found below paths, and each of them checked: lists, tables, and whether an FMU can be made of it."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

from ..analysis.judgement import Evidence, Judgement
from ..fmu import BuildError, packed_lists
from ..kinds import CompileError, ListKind, Severity
from ..lists import (
    CODES,
    START_UP_NAME,
    Document,
    Finding,
    Reading,
    TypeName,
    is_project,
    kind_of,
    open_regular,
    read_machine,
)
from ..model import CYCLE_TIME, Machine
from ..runtime import compile_tables
from .selection import Selection
from .settings import Settings, relative

_SKIPPED = {"node_modules", "__pycache__", "build", "dist"}
_OF_FOLDER = re.compile(r"(?:achskw|achsmd).*\.lis\Z", re.I)
_LIST = re.compile(r".*\.lis\Z", re.I)


@dataclass(frozen=True)
class Checked:
    """One machine, and what there is to say about it.

    Attributes
    ----------
    path : Path
        As it was asked for, or found.
    reading : Reading
    judgement : Judgement
    findings : tuple of Finding
        Those that are asked for, file by file.
    hidden : int
        How many settings and lists hide.
    """

    path: Path
    reading: Reading
    judgement: Judgement
    findings: tuple[Finding, ...]
    hidden: int

    @property
    def machine(self) -> Machine:
        """The machine that the lists describe."""
        return self.reading.machine


def check_machine(
    path: Path,
    settings: Settings,
    *,
    documents: Sequence[Document] | None = None,
    axis_type: TypeName | None = None,
    evidence: Evidence | None = None,
    reading: Reading | None = None,
) -> Checked:
    """Check the machine at a path.

    Parameters
    ----------
    path : Path
        As ``read_machine`` takes it.
    settings : Settings
        What is asked for.
    documents : sequence of Document, optional
        Used instead of what lies on the disk at their paths.
    axis_type : str, optional
        Instead of that of the settings.
    evidence : Evidence, optional
        What the tables are judged by.
    reading : Reading, optional
        Of this path, where it has been read before.
    """
    if reading is None:
        reading = read_machine(
            path,
            documents=documents,
            beside_disk=documents is not None,
            axis_type=axis_type or settings.axis_type,
            allow_outside=settings.allow_outside,
        )
    judgement = (evidence or Evidence()).judge(reading)
    found = [*reading.findings, *judgement.findings]
    found += [] if any(one.severity is Severity.ERROR for one in found) else _not_buildable(path, reading)
    findings, hidden = Selection(settings, reading.documents).chosen(found)
    return Checked(path, reading, judgement, tuple(findings), hidden)


def _not_buildable(path: Path, reading: Reading) -> Iterator[Finding]:
    """Yield why ``axcomp build`` refuses lists in which nothing else is wrong."""
    document = next(iter(reading.documents.values()), None)
    file = str(path if document is None else document.path)
    if not reading.machine.axes:
        # A file of volumetric parameters is only a part of a machine; so is a list that is looked at on its own.
        if reading.start_up is not None or path.is_dir():
            yield Finding(CODES["AXC-BUILD"][0], file, 0, "", "AXC-BUILD", "There is no axis in these lists.")
        return
    try:
        compile_tables(reading.machine, CYCLE_TIME)
        packed_lists(reading)
    except (BuildError, CompileError) as error:
        yield Finding(CODES["AXC-BUILD"][0], file, 0, "", "AXC-BUILD", f"No FMU can be made of these lists: {error}")


def find_machines(
    paths: Iterable[Path], settings: Settings, axis_type: TypeName | None = None
) -> Iterator[tuple[Path, Reading | None]]:
    """Yield what there is to be checked below some paths: a file as it is, of a folder every machine in it.

    A machine is what a start-up list names, the axis and compensation lists of a folder without one, a project file
    that holds lists, and every list that belongs to none of these. What had to be read to find it comes with it.
    """
    for path in paths:
        try:
            is_folder = path.is_dir()
        except (OSError, ValueError):
            is_folder = False
        if is_folder:
            yield from _Search(settings, axis_type or settings.axis_type).below(path)
        else:
            yield path, None


class _Search:
    """Looks for machines in a folder, and reads each file once."""

    def __init__(self, settings: Settings, axis_type: TypeName | None) -> None:
        self._settings = settings
        self._axis_type = axis_type
        self._documents: dict[Path, Document] = {}
        self._used: set[Path] = set()
        self._found: dict[Path, Reading] = {}

    def below(self, root: Path) -> Iterator[tuple[Path, Reading | None]]:
        """Yield the machines of a folder and of those in it."""
        folders = list(_walk(root, self._settings))
        for folder, files in folders:
            if any(file.name.lower() == START_UP_NAME for file in files):
                self._take(folder)
        for _, files in folders:
            for file in self._unused(files):
                if is_project(file) or (_LIST.match(file.name) and self._kind(file) is ListKind.START_UP):
                    self._take(file)
        for folder, files in folders:
            lists = [file for file in self._unused(files) if _LIST.match(file.name)]
            if any(_OF_FOLDER.match(file.name) for file in lists) and not any(
                _normal(one) in self._used for one in files
            ):
                self._take(folder)
            for file in self._unused(lists):
                if self._kind(file) is not None:
                    self._take(file)
        # A folder in which there is nothing is told by the reader.
        yield from sorted(self._found.items())
        if not self._found:
            yield root, None

    def _take(self, path: Path) -> None:
        documents = self._documents.values()
        reading = read_machine(
            path,
            documents=documents,
            beside_disk=True,
            axis_type=self._axis_type,
            allow_outside=self._settings.allow_outside,
        )
        self._found[path] = reading
        self._documents |= reading.documents
        self._used.update(map(_normal, reading.documents))

    def _unused(self, files: Iterable[Path]) -> list[Path]:
        return [file for file in files if _normal(file) not in self._used]

    def _kind(self, file: Path) -> ListKind | None:
        try:
            document = self._documents.get(file) or self._opened(file)
        except OSError:
            return None
        self._documents[file] = document
        return kind_of("", document.text) if document.is_text else None

    @staticmethod
    def _opened(file: Path) -> Document:
        """Return a list; OSError for what is no regular file, and for a link that leads out of its folder."""
        if Path(os.path.realpath(file)).parent != Path(os.path.realpath(file.parent)):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES))
        with open_regular(file) as opened:
            return Document(file, opened.read())


def _walk(root: Path, settings: Settings) -> Iterator[tuple[Path, list[Path]]]:
    for folder, names, files in os.walk(root):
        here = Path(folder)
        names[:] = sorted(
            name
            for name in names
            if not name.startswith(".") and name not in _SKIPPED and not _excluded(here / name, settings)
        )
        yield here, [here / file for file in sorted(files) if not _excluded(here / file, settings)]


def _excluded(path: Path, settings: Settings) -> bool:
    seen = relative(str(path), settings.folder)
    return any(fnmatch(seen, pattern) or fnmatch(path.name, pattern) for pattern in settings.exclude)


def _normal(path: Path) -> Path:
    return Path(os.path.normpath(path))
