"""Files of a machine, on disk or held in memory: found by the names a controller uses, read once each."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

from .document import Document
from .findings import Findings
from .project import Project

SIZE_MAX = 200_000_000
"""Bytes of a list that are read at most; the largest legal one has about 1 MB."""

_DRIVE = re.compile(r"[A-Za-z]:")


_Fault = tuple[str, str]
"""Code and sentence that say why a file cannot be read."""


class _Disk:
    """Files as they lie on the disk."""

    def exists(self, path: Path) -> bool:
        return path.exists()

    def is_dir(self, path: Path) -> bool:
        return path.is_dir()

    def children(self, folder: Path) -> Iterable[Path]:
        return folder.iterdir()

    def read(self, path: Path) -> Document | _Fault:
        try:
            if not path.exists():
                return "AXC-MISSING", "There is no such file."
            if not path.is_file():
                return "AXC-UNREADABLE", "This is no file."
            if path.stat().st_size > SIZE_MAX:
                return "AXC-UNREADABLE", "The file is too large for a list."
            return Document(path, path.read_bytes())
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else error
            return "AXC-UNREADABLE", f"The file cannot be read: {reason}."


class _Opened(_Disk):
    """Documents that are held, as an editor holds them, and beside them what lies on the disk."""

    def __init__(self, documents: Iterable[Document]) -> None:
        self._documents = {_normal(document.path): document for document in documents}

    def exists(self, path: Path) -> bool:
        return _normal(path) in self._documents or super().exists(path)

    def read(self, path: Path) -> Document | _Fault:
        return self._documents.get(_normal(path)) or super().read(path)


class _Memory:
    """Documents that are held: there are no other files."""

    def __init__(self, documents: Iterable[Document]) -> None:
        self._documents = {_normal(document.path): document for document in documents}
        self._folders: dict[Path, dict[Path, None]] = {}
        for path in self._documents:
            for child in (path, *path.parents):
                if child != child.parent:
                    self._folders.setdefault(child.parent, {})[child] = None

    def exists(self, path: Path) -> bool:
        return _normal(path) in self._documents or self.is_dir(path)

    def is_dir(self, path: Path) -> bool:
        return _normal(path) in self._folders

    def children(self, folder: Path) -> Iterable[Path]:
        return [folder / path.name for path in self._folders.get(_normal(folder), ())]

    def read(self, path: Path) -> Document | _Fault:
        return self._documents.get(_normal(path)) or ("AXC-MISSING", "There is no such file.")


def _normal(path: Path) -> Path:
    return Path(os.path.normpath(path))


class Files:
    """Reads the files of a machine, each once, and keeps them.

    Parameters
    ----------
    findings : Findings
        Gets told what cannot be read.
    held : iterable of Document or None
        These are all files there are; None: those on the disk.
    beside_disk : bool
        Beside those that are held there are those on the disk.

    Attributes
    ----------
    documents : dict of Path to Document
        The files read so far, by the path they were named by.
    """

    def __init__(self, findings: Findings, held: Iterable[Document] | None = None, beside_disk: bool = False) -> None:
        self._findings = findings
        self._source: _Disk | _Memory
        self._source = _Disk() if held is None else _Opened(held) if beside_disk else _Memory(held)
        self._faults: dict[Path, _Fault] = {}
        self.documents: dict[Path, Document] = {}

    def document(self, path: Path) -> Document | None:
        """Return a file that is text; a finding and None where there is none."""
        if path not in self.documents and path not in self._faults:
            read = self._source.read(path)
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
            return list(self._source.children(folder))
        except OSError:
            return []

    def named(self, folder: Path, name: str, position: tuple[str, int, str]) -> Path | None:
        r"""Return the file that a list names, relative to ``folder``; a finding at ``position`` if it is not there.

        ``\`` and ``/`` both separate. Names that differ only in case are taken, and of a name that begins at the
        root or with a drive letter the last part, if it lies in ``folder``: lists are often looked at far from the
        controller they come from.
        """
        try:
            exact, other = self._find(folder, name)
        except (OSError, ValueError):
            exact, other = None, None
        if exact is not None:
            return exact
        file, line, parameter = position
        if other is None:
            self._findings.add("AXC-MISSING", file, line, parameter, f"The file {name!r} does not exist.")
        else:
            message = f"The file {name!r} does not exist; {other} is used."
            self._findings.add("AXC-PATH", file, line, parameter, message)
        return other

    def _find(self, folder: Path, name: str) -> tuple[Path | None, Path | None]:
        """Return the file as it is named, else one that may be meant."""
        plain = name.replace("\\", "/")
        exact = folder / plain
        if self._source.exists(exact):
            return exact, None
        absolute = plain.startswith("/") or _DRIVE.match(plain) is not None
        parts = [part for part in plain.split("/") if part not in ("", ".")]
        return None, self._ignoring_case(folder, parts[-1:] if absolute else parts)

    def _ignoring_case(self, folder: Path, parts: list[str]) -> Path | None:
        """Return the path below ``folder`` whose parts are these but for their case."""
        path = folder
        for part in parts:
            if part == "..":
                path = path / part
                continue
            found = [entry for entry in self._source.children(path) if entry.name.casefold() == part.casefold()]
            if not found:
                return None
            path = min(found, key=lambda entry: (entry.name != part, entry.name))
        return path if parts else None
