"""List files on disk: found by the names a controller uses, and read as text."""

from __future__ import annotations

import re
from pathlib import Path

from .findings import Findings
from .grammar import decode

SIZE_MAX = 200_000_000
"""Bytes of a list that are read at most; the largest legal one has about 1 MB."""

_DRIVE = re.compile(r"[A-Za-z]:")


class Files:
    """Reads list files and remembers which.

    Attributes
    ----------
    read : list of Path
        The files read so far.
    """

    def __init__(self, findings: Findings) -> None:
        self._findings = findings
        self.read: list[Path] = []

    def text(self, path: Path) -> str | None:
        """Return the text of a list; a finding and None where there is none."""
        data, fault = _read(path)
        text = None if data is None else decode(data)
        if data is not None and text is None:
            fault = ("AXC-BINARY", "The file is no text; nothing of it is taken.")
        if fault is not None:
            code, message = fault
            self._findings.add(code, str(path), 0, "", message)
            return None
        self.read.append(path)
        return text

    def named(self, folder: Path, name: str, place: tuple[str, int, str]) -> Path | None:
        r"""Return the file that a list names, relative to ``folder``; a finding at ``place`` if it is not there.

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
        file, line, parameter = place
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
        if exact.exists():
            return exact, None
        absolute = plain.startswith("/") or _DRIVE.match(plain) is not None
        parts = [part for part in plain.split("/") if part not in ("", ".")]
        return None, _ignoring_case(folder, parts[-1:] if absolute else parts)


def _read(path: Path) -> tuple[bytes | None, tuple[str, str] | None]:
    """Return what is in a file, or the code and the sentence that say why it cannot be read."""
    try:
        if not path.exists():
            return None, ("AXC-MISSING", "There is no such file.")
        if not path.is_file():
            return None, ("AXC-UNREADABLE", "This is no file.")
        if path.stat().st_size > SIZE_MAX:
            return None, ("AXC-UNREADABLE", "The file is too large for a list.")
        return path.read_bytes(), None
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        return None, ("AXC-UNREADABLE", f"The file cannot be read: {reason}.")


def _ignoring_case(folder: Path, parts: list[str]) -> Path | None:
    """Return the path below ``folder`` whose parts are these but for their case."""
    path = folder
    for part in parts:
        if part == "..":
            path = path / part
            continue
        found = [entry for entry in path.iterdir() if entry.name.casefold() == part.casefold()]
        if not found:
            return None
        path = min(found, key=lambda entry: (entry.name != part, entry.name))
    return path if parts else None
