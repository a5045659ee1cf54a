"""Files of a machine, on disk or held in memory: found by the names a controller uses, read once each."""

from __future__ import annotations

import errno
import os
import re
import stat
from collections.abc import Iterable
from pathlib import Path
from typing import BinaryIO

from .document import Document
from .findings import Findings
from .project import Project

LIST_MAX = 8_000_000
"""Bytes of a list that are read at most; the largest legal one has about 1 MB."""

SIZE_MAX = 200_000_000
"""Bytes of any file that are read at most."""

_DRIVE = re.compile(r"[A-Za-z]:")


_Fault = tuple[str, str]
"""Code and sentence that say why a file cannot be read."""


def open_regular(path: str | os.PathLike[str]) -> BinaryIO:
    """Open a regular file to be read; OSError for all else: that may wait for ever, or do something."""
    if not stat.S_ISREG(os.stat(path).st_mode):  # noqa: PTH116
        raise OSError(errno.EINVAL, _NO_FILE)
    # What the path leads to may have become another: a pipe that nobody writes to is not waited for.
    file = os.fdopen(os.open(path, _TO_READ), "rb")
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise OSError(errno.EINVAL, _NO_FILE)
    return file


_TO_READ = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_NO_FILE = "it is no regular file"
_LEAVES = "This leads out of the folder of the machine; it is not opened without --allow-outside FOLDER."


class _Disk:
    """Files as they lie on the disk."""

    def real(self, path: Path) -> Path:
        """Return a path without links: where it leads."""
        return Path(os.path.realpath(path))

    def exists(self, path: Path) -> bool:
        return path.exists()

    def is_dir(self, path: Path) -> bool:
        return path.is_dir()

    def children(self, folder: Path) -> Iterable[Path]:
        return folder.iterdir()

    def read(self, path: Path, at_most: int) -> Document | _Fault:
        try:
            with open_regular(path) as file:
                size = os.fstat(file.fileno()).st_size
                return _too_large(size) if size > at_most else Document(path, file.read(size))
        except FileNotFoundError:
            return "AXC-MISSING", "There is no such file."
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else error
            return "AXC-UNREADABLE", f"The file cannot be read: {reason}."


def _too_large(size: int) -> _Fault:
    return "AXC-UNREADABLE", f"The file is too large for what it is to hold ({size:,} bytes); it is not read."


class _Opened(_Disk):
    """Documents that are held, as an editor holds them, and beside them what lies on the disk."""

    def __init__(self, documents: Iterable[Document]) -> None:
        self._documents = {_normal(document.path): document for document in documents}

    def exists(self, path: Path) -> bool:
        return _normal(path) in self._documents or super().exists(path)

    def read(self, path: Path, at_most: int) -> Document | _Fault:
        return self._documents.get(_normal(path)) or super().read(path, at_most)


class _Memory:
    """Documents that are held: there are no other files."""

    def __init__(self, documents: Iterable[Document]) -> None:
        self._documents = {_normal(document.path): document for document in documents}
        self._folders: dict[Path, dict[Path, None]] = {}
        for path in self._documents:
            for child in (path, *path.parents):
                if child != child.parent:
                    self._folders.setdefault(child.parent, {})[child] = None

    @staticmethod
    def real(path: Path) -> Path:
        return _normal(path)

    def exists(self, path: Path) -> bool:
        return _normal(path) in self._documents or self.is_dir(path)

    def is_dir(self, path: Path) -> bool:
        return _normal(path) in self._folders

    def children(self, folder: Path) -> Iterable[Path]:
        return [folder / path.name for path in self._folders.get(_normal(folder), ())]

    def read(self, path: Path, at_most: int) -> Document | _Fault:
        document = self._documents.get(_normal(path))
        if document is None:
            return "AXC-MISSING", "There is no such file."
        return document if len(document.data) <= at_most else _too_large(len(document.data))


def _normal(path: Path) -> Path:
    return Path(os.path.normpath(path))


class Files:
    r"""Reads the files of a machine, each once, and keeps them.

    A list may come from anywhere: what it names must lie, links resolved, in the folder that its machine is in, and is
    named relative to that, without ``..``. Whoever reads it can allow other folders.

    Parameters
    ----------
    findings : Findings
        Gets told what cannot be read.
    held : iterable of Document or None
        These are all files there are; None: those on the disk.
    beside_disk : bool
        Beside those that are held there are those on the disk.
    allowed : iterable of Path
        Folders that names may lead into besides, also by ``..`` and from the root.

    Attributes
    ----------
    documents : dict of Path to Document
        The files read so far, by the path they were named by.
    """

    def __init__(
        self,
        findings: Findings,
        held: Iterable[Document] | None = None,
        beside_disk: bool = False,
        allowed: Iterable[Path] = (),
    ) -> None:
        self._findings = findings
        self._source: _Disk | _Memory
        self._source = _Disk() if held is None else _Opened(held) if beside_disk else _Memory(held)
        self._faults: dict[Path, _Fault] = {}
        self._allowed = tuple(map(self._source.real, allowed))
        self._folders = set(self._allowed)
        self.documents: dict[Path, Document] = {}

    def enter(self, folder: Path) -> None:
        """Take a folder for that of a machine."""
        self._folders.add(self._source.real(folder))

    def document(self, path: Path, at_most: int = LIST_MAX) -> Document | None:
        """Return a file that is text, of so many bytes at most; a finding and None where there is none."""
        if path not in self.documents and path not in self._faults:
            read = self._source.read(path, at_most) if self._holds(path) else ("AXC-FOLDER", _LEAVES)
            if isinstance(read, Document):
                self.documents[path] = read
            else:
                self._faults[path] = read
        document = self.documents.get(path)
        if document is not None and document.is_text:
            return document
        code, sentence = self._faults.get(path, ("AXC-BINARY", "The file is no text; nothing of it is taken."))
        self._findings.add(code, str(path), 0, "", sentence)
        return None

    def project(self, path: Path) -> Project:
        """Return a file that has been read as a project; its lists are files of their own from now on."""
        read = self.documents[path]
        project = read if isinstance(read, Project) else Project(path, read.data)
        self.documents[path] = project
        self.documents.update((section.path, section) for section in project.sections)
        return project

    def is_dir(self, path: Path) -> bool:
        """Whether a path is a folder; OSError or ValueError for one that cannot be."""
        return self._source.is_dir(path)

    def children(self, folder: Path) -> list[Path]:
        """Return what lies in a folder, nothing where that cannot be said."""
        try:
            return list(self._source.children(folder)) if self._holds(folder) else []
        except OSError:
            return []

    def place(self, folder: Path, name: str) -> Path | None:
        r"""Return where a name of a list leads from ``folder``, that of its machine; None if that is not allowed.

        ``\`` and ``/`` both separate. Nothing needs to be there; OSError or ValueError where nothing can be.
        """
        self.enter(folder)
        parts = _parts(name)
        leaves = is_absolute(name) or parts[:1] == [".."]
        path = folder / ("/" * name.startswith(("/", "\\")) + "/".join(parts))
        return path if self._holds(path, self._allowed if leaves else None) else None

    def named(self, folder: Path, name: str, position: tuple[str, int, str]) -> Path | None:
        """Return the file that a list names (see ``place``); a finding at ``position`` if it is not there or outside.

        Names that differ only in case are taken, and of a name that begins at the root or with a drive letter the last
        part, if it lies in ``folder``: lists are often looked at far from the controller they come from.
        """
        file, line, parameter = position
        code, message = "AXC-MISSING", f"The file {name!r} does not exist."
        found = None
        try:
            exact = self.place(folder, name)
            if exact is not None and self._source.exists(exact):
                return exact
            if exact is None:
                code, message = "AXC-FOLDER", f"{name!r}: {_LEAVES}"
            if exact is not None or is_absolute(name):
                found = self._ignoring_case(folder, _parts(name)[-1:] if is_absolute(name) else _parts(name))
        except (OSError, ValueError):
            pass
        if found is not None:
            message = f"The file {name!r} does not exist, or must not be read; {found} is used."
            self._findings.add("AXC-PATH", file, line, parameter, message)
        else:
            self._findings.add(code, file, line, parameter, message)
        return found

    def _holds(self, path: Path, folders: Iterable[Path] | None = None) -> bool:
        """Tell whether a path leads into one of some folders, None: of all that are allowed."""
        real = self._source.real(path)
        return any(real.is_relative_to(folder) for folder in (self._folders if folders is None else folders))

    def _ignoring_case(self, folder: Path, parts: list[str]) -> Path | None:
        """Return the path below ``folder`` whose parts are these but for their case."""
        path = folder
        for part in parts:
            if part == "..":
                path = path / part
                continue
            found = [entry for entry in self.children(path) if entry.name.casefold() == part.casefold()]
            if not found:
                return None
            path = min(found, key=lambda entry: (entry.name != part, entry.name))
        return path if parts and self._holds(path) else None


def _parts(name: str) -> list[str]:
    """Return the parts of a name, ``..`` at its begin only."""
    return [
        part
        for part in os.path.normpath(name.replace("\\", "/")).replace("\\", "/").split("/")
        if part not in ("", ".")
    ]


def is_absolute(name: str) -> bool:
    """Whether a name in a list begins at the root or with a drive."""
    return name.startswith(("/", "\\")) or _DRIVE.match(name) is not None
