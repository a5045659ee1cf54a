"""Where diagnosis files go, and writing them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

from ...fmu import BuildError
from ...lists import Reading
from .records import Diagnosis, VolumetricList, diagnose
from .workbook import write_workbook

_SUFFIX = ".xlsx"
_ARCHIVE = b"PK"


class Written(NamedTuple):
    """A diagnosis file, what is in it, and sentences about where it lies."""

    path: Path
    diagnosis: Diagnosis
    notes: tuple[str, ...]


def write_diagnoses(
    sources: Sequence[VolumetricList], reading: Reading, output: Path | None = None
) -> Iterator[Written | BuildError]:
    """Write the diagnosis file of each list, and yield it, or why it could not be written.

    It is the one the list names, else ``output``, to whose name the index is added if there are several lists.
    """
    written: set[Path] = set()
    for source in sources:
        try:
            path, notes = _named(source) if output is None else (_numbered(output, source, len(sources)), [])
            if path in written:
                path = _numbered(path, source, len(sources))
                notes.append(f"{source.path.name}: another list names the same diagnosis file; {path} is written.")
            written.add(path)
            _check_replaced(path)
            diagnosis = diagnose(source, reading)
            write_workbook(diagnosis, path)
        except BuildError as error:
            yield error
        except (OSError, ValueError) as error:
            yield BuildError(f"{source.path.name}: its diagnosis file cannot be written: {error}")
        else:
            yield Written(path, diagnosis, tuple(notes))


def _named(source: VolumetricList) -> tuple[Path, list[str]]:
    r"""Return where the file goes that a list names, and what there is to say about it.

    Names are relative to the start-up list. A folder at the root or on a drive is that of a controller; where there is
    none on this machine the file goes beside the list.
    """
    name = source.diagnosis_file
    # Both \ and / separate for Windows, as for the controller.
    named = PureWindowsPath(name)
    notes = []
    path = source.folder / named.as_posix()
    if named.anchor:
        path = Path(name)
        if not (path.is_absolute() and path.parent.is_dir()):
            path = source.path.with_name(named.name)
            notes.append(f"{source.path.name}: there is no {named.parent} on this machine; {path} is written.")
    if path.suffix.lower() != _SUFFIX:
        notes.append(f"{path.name} is a spreadsheet all the same: programs may ask for the suffix {_SUFFIX}.")
    return path, notes


def _numbered(path: Path, source: VolumetricList, count: int) -> Path:
    return path if count == 1 else path.with_name(f"{path.stem}-{source.index}{path.suffix}")


def _check_replaced(path: Path) -> None:
    """Refuse to replace what cannot be an earlier diagnosis: a list may name any file, another list too."""
    if path.is_dir():
        raise BuildError(f"{path} cannot be written: it is a folder.")
    if path.is_file():
        with path.open("rb") as file:
            if file.read(len(_ARCHIVE)) not in (b"", _ARCHIVE):
                raise BuildError(f"{path} is there and is no spreadsheet; it stays as it is.")
