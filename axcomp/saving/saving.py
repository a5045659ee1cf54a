"""Writing files whole or not at all: beside what was there, to the disk, then in its place."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from collections.abc import Mapping
from pathlib import Path

PREFIX = ".axcomp-"
"""Of the unfinished file beside; only a process that was killed leaves one."""


def write_whole(path: str | os.PathLike[str], data: bytes | str) -> None:
    r"""Write a file as ``write_all`` does; text is UTF-8, its lines end in ``\n`` on every system."""
    write_all({Path(path): data.encode() if isinstance(data, str) else data})


def write_all(files: Mapping[Path, bytes]) -> None:
    """Write files that belong together: all that is new is on the disk before the first old file is replaced.

    The file that a link leads to is replaced, the link stays. A file keeps its mode. Devices and pipes are written to.

    Raises
    ------
    OSError
        With the name of the file that could not be written; all are as they were, unless replacing itself has failed.
    """
    ready: list[tuple[Path, Path, Path]] = []
    path = Path()
    try:
        for path, data in files.items():
            target = Path(os.path.realpath(path))
            if target.exists() and not target.is_file():
                target.write_bytes(data)  # a device or a pipe is not to be replaced by a file
                continue
            if target.exists() and not os.access(target, os.W_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
            unfinished = target.with_name(PREFIX + secrets.token_hex(8))
            ready.append((path, target, unfinished))
            _write_beside(target, unfinished, data)
        for path, target, unfinished in ready:  # noqa: B007
            unfinished.replace(target)
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise
    finally:
        for _, _, unfinished in ready:
            with contextlib.suppress(OSError):
                unfinished.unlink(missing_ok=True)


def _write_beside(target: Path, unfinished: Path, data: bytes) -> None:
    """Write what is to become ``target``; it is on the disk when this returns."""
    with unfinished.open("xb") as file:
        if target.exists():
            unfinished.chmod(target.stat().st_mode & 0o7777)
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
