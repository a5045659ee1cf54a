"""The lists of a machine as they lie in an FMU: in the folder ``machine``, to each other as they do on disk."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path, PurePosixPath

from ..lists import list_files
from .archive import BuildError, file_bytes

FOLDER = "machine"
"""Folder of the lists in ``resources``."""


def packed_lists(lists: Path) -> tuple[str, dict[str, bytes]]:
    """Return what ``read_machine`` must read in ``resources``, and the files there.

    Raises
    ------
    BuildError
        If a file cannot be read, or the copies would not be found: lists can name files by absolute paths.
    """
    start, *found = (_absolute(path) for path in (lists, *list_files(lists)))
    try:
        root = Path(os.path.commonpath([start if start.is_dir() else start.parent, *(path.parent for path in found)]))
    except ValueError:
        raise BuildError(f"{lists}: the lists lie on different drives.") from None
    files = {_packed(root, path): file_bytes(path) for path in found}
    place = _packed(root, start)
    lost = set(files) - _found_again(place, files)
    if lost:
        originals = [str(path) for path in found if _packed(root, path) in lost]
        raise BuildError(
            f"{lists} names {', '.join(originals)} by an absolute path; in an FMU, names must be relative to the list "
            "they stand in."
        )
    return place, files


def _absolute(path: Path) -> Path:
    """Return a path from the root, links as they are named: the lists' names must lead to the same files."""
    return Path(os.path.normpath(path.absolute()))


def _packed(root: Path, path: Path) -> str:
    return str(PurePosixPath(FOLDER, path.relative_to(root).as_posix()))


def _found_again(place: str, files: dict[str, bytes]) -> set[str]:
    """Return which files are read when they lie somewhere else."""
    with tempfile.TemporaryDirectory() as folder:
        resources = _absolute(Path(folder))
        for name, data in files.items():
            path = resources / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        found = [_absolute(path) for path in list_files(resources / place)]
        return {path.relative_to(resources).as_posix() for path in found if path.is_relative_to(resources)}
