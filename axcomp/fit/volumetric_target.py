"""The volumetric list that identified errors go into, and its parameter file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..kinds import ListKind, Severity
from ..lists import (
    AUTO,
    ETALON_EXCHANGE,
    ISG_CSV,
    START_UP_NAME,
    Axes,
    Document,
    Files,
    Finding,
    Findings,
    MachineFiles,
    VolumetricReader,
    assemble,
    blocks_of,
    find_lists,
    format_volumetric_list,
    parameter_file,
    read_etalon,
    read_isg_csv,
    write_etalon,
    write_isg_csv,
)
from ..measurement import MeasurementError
from ..model import COMPENSATIONS_MAX, FILES_MAX, Interpolation, Volumetric
from .keeping import owners

_FILE_NAME = "vol_comp[i].file_name"
_INDEX = re.compile(r"([0-9])\D*\Z")

_HARMLESS = ("AXC-NO-RECORD", "AXC-MISSING", "AXC-EMPTY", "AXC-MAX-RECORDS")
"""Errors of a list whose parameters are still to come."""


class VolumetricTarget:
    """A volumetric list, with the kinematics it describes.

    Attributes
    ----------
    path : Path
        The list.
    parameters : Path
        Its parameter file.
    volumetric : Volumetric
        What both say so far.
    reserved : int
        Records that the start-up list reserves; 0 where there is none.
    """

    def __init__(self, path: str | Path, new: Volumetric | None = None) -> None:
        """Open a list; ``new`` describes the kinematics for one that does not exist yet.

        Raises
        ------
        MeasurementError
            The list cannot be read or has errors, or its parameters do not stand in one file over grids.
        """
        self.path = Path(path)
        self._exists = self.path.exists()
        self._document = Document(path, kind=ListKind.VOLUMETRIC)
        self._etalon = False
        self._splicing = False
        self._comments = ""
        self._before: dict[Path, bytes] = {}
        self._names_file = True
        self.reserved = 0
        if self._exists:
            self._open()
            return
        if new is None:
            raise MeasurementError(str(path), 0, "There is no such list; give the chain and its axes to make one.")
        found = _INDEX.search(self.path.stem)
        index = min(int(found[1]), COMPENSATIONS_MAX - 1) if found else 0
        self.volumetric = replace(new, index=index)
        self.parameters = self.path.with_suffix(Path(parameter_file(self.volumetric)).suffix)
        self._refuse_owned()

    def _open(self) -> None:
        findings = Findings()
        files = Files(findings)
        files.enter(self.path.parent)
        lists, index = self._machine(files)
        document = files.document(self.path)
        if document is None:
            raise _unreadable(self.path, findings)
        self._document = document
        self._before[self.path] = document.data
        values = document.read_as(ListKind.VOLUMETRIC, findings)
        if lists.start_up is not None:
            self.reserved = lists.start_up.integer("vol_comp[i].max_records", index)
        axes = Axes(findings, invent=True)
        self.volumetric = VolumetricReader(index, values, lists, files, axes, findings).read()
        names = [values.text("file[j]", j) for j in range(FILES_MAX) if values.text("file[j]", j)]
        if len(names) > 1 or (names and not values.text("file[j]", 0)):
            sentence = "The parameters stand in several files; put them into file[0] to have them replaced."
            raise MeasurementError(str(self.path), values.line("file[j]", 0), sentence)
        mode = values.text("interpolation")
        if mode not in (Interpolation.GRID.value, AUTO):
            sentence = f"The list interpolates by {mode}; identified errors stand on grids and need GRID or AUTO."
            raise MeasurementError(str(self.path), values.line("interpolation"), sentence)
        self._refuse_errors(findings.all())
        self._splicing = values.flag("enable_splicing")
        self._etalon = values.text("file_format[j]", 0) == ETALON_EXCHANGE
        self._names_file = bool(names)
        named = files.named(lists.folder, names[0], (str(self.path), 0, "file[0]")) if names else None
        default = (names[0] if names else f"{self.path.stem}.csv").replace("\\", "/")
        self.parameters = named or lists.folder / default
        self._refuse_owned(files)
        if self.parameters.exists():
            parameters = files.document(self.parameters)
            if parameters is None:
                raise _unreadable(self.parameters, findings)
            self._before[self.parameters] = parameters.data
            self._comments = "" if self._etalon else _leading_comments(parameters.text)

    def _machine(self, files: Files) -> tuple[MachineFiles, int]:
        """Return the machine the list belongs to, and its index there."""
        folder = self.path.parent
        start_up = next((entry for entry in folder.iterdir() if entry.name.lower() == START_UP_NAME), None)
        if start_up is not None:
            lists = find_lists(start_up, files, Findings())
            for index in range(COMPENSATIONS_MAX):
                name = lists.start_up.text(_FILE_NAME, index) if lists.start_up is not None else ""
                path = files.named(lists.folder, name, ("", 0, "")) if name else None
                if path is not None and path.resolve() == self.path.resolve():
                    return lists, index
        return MachineFiles(folder), 0

    def _refuse_errors(self, findings: tuple[Finding, ...]) -> None:
        for finding in findings:
            if finding.severity is Severity.ERROR and finding.code not in _HARMLESS:
                raise MeasurementError(finding.file, finding.line, finding.message)

    def before(self) -> dict[Path, bytes]:
        """Return what the files held when they were read."""
        return self._before

    def _refuse_owned(self, files: Files | None = None) -> None:
        def read(path: Path) -> bytes:
            document = None if files is None else files.document(path)
            return path.read_bytes() if document is None else document.data

        if named := owners(self.parameters, [self.path], read):
            others = ", ".join(one.name for one in named)
            sentence = f"Its parameter file {self.parameters.name} is not overwritten: {others} names it too."
            raise MeasurementError(str(self.path), 0, sentence)

    def check_kinematics(self, given: Mapping[str, Any]) -> None:
        """Refuse kinematics that are given, by field, and contradict the list; MeasurementError."""
        for name, value in given.items():
            held = getattr(self.volumetric, name)
            if held != value:
                option = name.replace("_", "-")
                sentence = f"The list says {_plain(held)}, not {_plain(value)} as --{option} does; it stays as it is."
                raise MeasurementError(str(self.path), 0, sentence)

    def with_errors(self, volumetric: Volumetric) -> tuple[bytes, bytes | None]:
        """Return the parameter file and the list for new errors; no list where the old one serves.

        Raises
        ------
        ValueError
            The parameters would not read back to what is meant.
        """
        blocks = blocks_of(volumetric)
        text = write_etalon(blocks) if self._etalon else self._comments + write_isg_csv(blocks)
        findings = Findings()
        again = (read_etalon if self._etalon else read_isg_csv)(text, str(self.parameters), findings)
        found = assemble(again, Interpolation.GRID.value, self._splicing, findings)
        intended = {table.name: table for table in volumetric.errors}
        if (
            findings.errors()
            or found.errors != intended
            or len(found.description) < len(tuple(volumetric.description()))
        ):
            raise ValueError(f"{self.parameters}: the parameters would not read back to what is meant")
        return text.encode(), self._list(volumetric)

    def _list(self, volumetric: Volumetric) -> bytes | None:
        if not self._exists:
            made = Document(self.path, format_volumetric_list(volumetric).encode(), ListKind.VOLUMETRIC)
            made.set("file[0]", self.parameters.name)
            return made.to_bytes()
        if self._names_file:
            return None
        new = [f"{'file[0]':<40} {self.parameters.name}", f"{'file_format[0]':<40} {ISG_CSV}"]
        document = self._document.copy()
        document.replace_entries(new, ["file[j]", "file_format[j]"], "Parameters")
        return document.to_bytes()


def _plain(value: Any) -> str:
    """Return a value of the kinematics for a sentence."""
    if isinstance(value, tuple):
        return " ".join(f"{one[0]}={one[1]}" if isinstance(one, tuple) else f"{one:g}" for one in value)
    return str(value)


def _unreadable(path: Path, findings: Findings) -> MeasurementError:
    """Return what was found to be wrong with a file as a whole."""
    about = next(finding for finding in findings.all() if finding.file == str(path))
    return MeasurementError(str(path), 0, about.message)


def _leading_comments(text: str) -> str:
    """Return the comment lines a file begins with."""
    lines = []
    for line in text.split("\n"):
        if line.strip() and not line.lstrip().startswith("//"):
            break
        lines.append(line + "\n")
    return "".join(lines) if any(line.strip() for line in lines) else ""
