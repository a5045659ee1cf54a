"""The FMU as a file: a ZIP archive that has the same bytes whenever and wherever it is written."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import subprocess
import uuid
import zipfile
import zlib
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

from ..lists import open_regular
from ..native import MAGIC
from ..saving import write_whole

DATE = (1980, 1, 1, 0, 0, 0)
"""Of every entry: the earliest that ZIP knows."""

INSTALLED = "946684800"
"""Date of generation by an installed package, s: 2000-01-01."""

LEVEL = 6
"""Of the compression: 9 takes four times as long and saves 5 %."""
UNIX = 3
_MARKS = {
    "modelDescription.xml": b'generationTool="axcomp',
    "SystemStructure.ssd": b'generationTool="axcomp',
    "docProps/core.xml": b">axcomp</dc:creator>",
}
"""What axcomp puts into the archives that it writes, an FMU, a system and a workbook."""
_EDITED = b"lastModifiedBy"
"""What others put into a workbook that they have saved."""
_IMAGE = MAGIC[:-1]
_PART_MAX = 100_000
MODE = 0o100644 << 16


class BuildError(Exception):
    """An FMU cannot be built; the message is a sentence for the user."""


def file_bytes(path: Path) -> bytes:
    """Return the contents of a file; BuildError if it cannot be read."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise BuildError(f"{path} cannot be read: {error.strerror or error}") from None


def content_guid(parts: Mapping[str, bytes]) -> str:
    """Return a GUID in braces that depends on names and contents only."""
    digest = hashlib.sha256()
    for name in sorted(parts):
        digest.update(f"{name}\0{len(parts[name])}\0".encode())
        digest.update(parts[name])
    return f"{{{uuid.UUID(bytes=digest.digest()[:16], version=5)}}}"


def generation_date() -> str:
    """Return SOURCE_DATE_EPOCH as FMI writes a date, else that of the sources: a rebuild has the same bytes."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH") or _date_of_sources()
    try:
        return datetime.fromtimestamp(int(seconds), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    except (ValueError, OverflowError, OSError):
        raise BuildError(f"SOURCE_DATE_EPOCH is no number of seconds: {seconds}") from None


@cache
def _date_of_sources() -> str:
    """Return the seconds of the last commit of the checkout; of an installed package a constant."""
    root = Path(__file__).resolve().parents[2]
    if (root / ".git").exists() and (root / "build_fmu.py").exists():
        command = ["git", "-C", str(root), "log", "-1", "--format=%ct"]
        with contextlib.suppress(OSError, subprocess.SubprocessError):
            found = subprocess.run(command, capture_output=True, text=True, check=True, timeout=10).stdout.strip()
            return found or INSTALLED
    return INSTALLED


def write_fmu(output: Path, files: Mapping[str, bytes]) -> None:
    """Write an archive as ``write_file`` does."""
    write_file(output, archive_of(files))


def archive_of(files: Mapping[str, bytes]) -> bytes:
    """Return an archive of files; the model description comes first."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL) as archive:
        for name in sorted(files, key=lambda name: (name != "modelDescription.xml", name)):
            entry = zipfile.ZipInfo(name, DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = UNIX
            entry.external_attr = MODE
            archive.writestr(entry, files[name], compresslevel=LEVEL)
    return packed.getvalue()


def is_own(path: Path) -> bool:
    """Whether axcomp has written a file: an FMU, a system, an image, a diagnosis; OSError if it cannot be read."""
    with open_regular(path) as file:
        if file.read(len(_IMAGE)) == _IMAGE:
            return True
        try:
            with zipfile.ZipFile(file) as archive:
                name = next((name for name in _MARKS if name in archive.namelist()), "")
                text = archive.open(name).read(_PART_MAX) if name else b""
        except (zipfile.BadZipFile, ValueError, NotImplementedError, RuntimeError, zlib.error):
            return False
    return bool(name) and _MARKS[name] in text and _EDITED not in text


def write_file(output: Path, data: bytes) -> None:
    """Write a file and its folders; BuildError if that fails, or another's file is there: that stays as it is then."""
    try:
        if output.is_file() and not is_own(output):
            raise BuildError(f"{output} is there and was not written by axcomp; it stays as it is.")
        output.parent.mkdir(parents=True, exist_ok=True)
        write_whole(output, data)
    except OSError as error:
        raise BuildError(f"{output} cannot be written: {error.strerror or error}") from None
