"""The lists of a machine as they lie in an FMU: in the folder ``machine``, to each other as they do on disk."""

from __future__ import annotations

import os
from pathlib import Path, PurePosixPath

from ..kinds import ListKind
from ..lists import Document, Project, Reading, read_machine
from .archive import BuildError

FOLDER = "machine"
"""Folder of the lists in ``resources``."""

_NAMING = (ListKind.START_UP, ListKind.VOLUMETRIC)
"""Lists that name others."""


def packed_lists(reading: Reading) -> tuple[str, dict[str, bytes]]:
    """Return what ``read_machine`` must read in ``resources``, and the files there: those that were read.

    Raises
    ------
    BuildError
        If the copies would not be found: lists can name files by absolute paths.
    """
    start = _absolute(reading.path)
    # What stands in a file goes with it.
    found = {_absolute(path): document for path, document in reading.documents.items() if document.outer is None}
    first = start.parent if start in found else start
    try:
        root = Path(os.path.commonpath([first, *(path.parent for path in found)]))
    except ValueError:
        raise BuildError(f"{reading.path}: the lists lie on different drives.") from None
    files = {_packed(root, path): document for path, document in found.items()}
    packed = _packed(root, start)
    lost = set(files) - _found_again(packed, files)
    if lost:
        originals = [str(path) for path in found if _packed(root, path) in lost]
        raise BuildError(
            f"{reading.path} names {', '.join(originals)} by an absolute path; in an FMU, names must be relative to "
            "the list they stand in."
        )
    return packed, {name: document.to_bytes() for name, document in files.items()}


def _absolute(path: Path) -> Path:
    """Return a path from the root, links as they are named: the lists' names must lead to the same files."""
    return Path(os.path.normpath(path.absolute()))


def _packed(root: Path, path: Path) -> str:
    return str(PurePosixPath(FOLDER, path.relative_to(root).as_posix()))


def _found_again(packed: str, files: dict[str, Document]) -> set[str]:
    """Return which files are read when they lie somewhere else. What tables hold does not matter to that."""
    moved = [
        Document(name, document.to_bytes() if document.kind in _NAMING or isinstance(document, Project) else b"")
        for name, document in files.items()
    ]
    return {Path(os.path.normpath(path)).as_posix() for path in read_machine(packed, documents=moved).documents}
