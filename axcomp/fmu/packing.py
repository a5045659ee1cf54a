"""The lists of a machine as they lie in an FMU: in the folder ``machine``, to each other as they do on disk."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from ..kinds import ListKind
from ..lists import Document, Project, Reading, read_machine
from .archive import BuildError
from .packed_interface import FOLDER

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
        common = Path(os.path.commonpath([first, *(path.parent for path in found)]))
    except ValueError:
        raise BuildError(f"{reading.path}: the lists lie on different drives.") from None
    # Names may go up further than all the files lie.
    for root in (common, *common.parents):
        packed = _packed(root, start)
        places = {path: _packed(root, path) for path in found}
        lost = _lost(packed, places, found)
        if not lost:
            break
    else:
        # What is named from the root is found again beside the list.
        packed, places = _packed(common, start), {path: _packed(common, path) for path in found}
        places.update((path, f"{_packed(common, first)}/{path.name}") for path in lost)
        if len(set(places.values())) < len(places) or _lost(packed, places, found):
            raise BuildError(
                f"{reading.path} names {', '.join(map(str, lost))} by an absolute path; in an FMU, names must be "
                "relative to the list they stand in."
            )
    return packed, {places[path]: document.to_bytes() for path, document in found.items()}


def _absolute(path: Path) -> Path:
    """Return a path from the root, links as they are named: the lists' names must lead to the same files."""
    return Path(os.path.normpath(path.absolute()))


def _packed(root: Path, path: Path) -> str:
    return str(PurePosixPath(FOLDER, path.relative_to(root).as_posix()))


def _lost(packed: str, places: Mapping[Path, str], found: Mapping[Path, Document]) -> list[Path]:
    """Return which files are not read when they lie somewhere else. What tables hold does not matter to that."""
    moved = [
        Document(
            places[path], document.to_bytes() if document.kind in _NAMING or isinstance(document, Project) else b""
        )
        for path, document in found.items()
    ]
    again = read_machine(packed, documents=moved, allow_outside=[FOLDER]).documents
    read = {Path(os.path.normpath(path)).as_posix() for path in again}
    return [path for path in found if places[path] not in read]
