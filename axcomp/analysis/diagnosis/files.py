"""Where diagnosis files go, and writing them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

from ...fmu import BuildError
from ...lists import Files, Findings, Reading, is_absolute
from .records import Diagnosis, VolumetricList, diagnose
from .workbook import write_workbook

_SUFFIX = ".xlsx"


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
            path, notes = _named(source, reading) if output is None else (_numbered(output, source, len(sources)), [])
            if path in written:
                path = _numbered(path, source, len(sources))
                notes.append(f"{source.path.name}: another list names the same diagnosis file; {path} is written.")
            written.add(path)
            if path.is_dir():
                raise BuildError(f"{path} cannot be written: it is a folder.")
            diagnosis = diagnose(source, reading)
            write_workbook(diagnosis, path)
        except BuildError as error:
            yield error
        except (OSError, ValueError) as error:
            yield BuildError(f"{source.path.name}: its diagnosis file cannot be written: {error}")
        else:
            yield Written(path, diagnosis, tuple(notes))


def _named(source: VolumetricList, reading: Reading) -> tuple[Path, list[str]]:
    r"""Return where the file goes that a list names, and what there is to say about it.

    Names are relative to the start-up list and lead nowhere else (see ``Files.place``). A folder at the root or on a
    drive is that of a controller: the file goes beside the list unless it may go there.
    """
    name = source.diagnosis_file
    # Both \ and / separate for Windows, as for the controller.
    named = PureWindowsPath(name)
    notes = []
    files = Files(Findings(), allowed=reading.allow_outside)
    path = files.place(source.folder, name)
    if is_absolute(name) and (path is None or not path.parent.is_dir()):
        there = Path(name).is_absolute() and Path(name).parent.is_dir()
        fault = f"{named.parent} is not allowed" if there else f"there is no {named.parent} on this machine"
        path = files.place(source.path.parent, named.name)
        notes.append(f"{source.path.name}: {fault}; {path} is written.")
    if path is None:
        raise BuildError(
            f"{source.path.name}: {name!r} leads out of the folder of the machine; it is not written without "
            "--allow-outside FOLDER."
        )
    if path.suffix.lower() != _SUFFIX:
        notes.append(f"{path.name} is a spreadsheet all the same: programs may ask for the suffix {_SUFFIX}.")
    return path, notes


def _numbered(path: Path, source: VolumetricList, count: int) -> Path:
    return path if count == 1 else path.with_name(f"{path.stem}-{source.index}{path.suffix}")
