"""What the parameter files of a volumetric list hold, record by record, each with the line where it stands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

from ...lists import (
    ETALON_EXCHANGE,
    Document,
    Files,
    Finding,
    Findings,
    ListValues,
    ParameterBlock,
    Parameters,
    Reading,
    assemble,
    read_etalon,
    read_isg_csv,
)
from ...model import AXIS_NUMBERS, COMPENSATIONS_MAX, DESCRIPTION, ERRORS, FILES_MAX, LETTERS, Interpolation, sentence

FILE_NAME, MAX_RECORDS = "vol_comp[i].file_name", "vol_comp[i].max_records"
"""P-STUP-00101 and P-STUP-00100."""

_RANK = {name: rank for rank, name in enumerate(ERRORS + DESCRIPTION)}
_POLYLINES = (Interpolation.PATH.value, Interpolation.PATH_XY.value)


@dataclass(frozen=True)
class VolumetricList:
    """A volumetric list that a start-up list names: its index there, 0..4, and both as they were read."""

    index: int
    start_up: Document
    document: Document

    @property
    def values(self) -> ListValues:
        """What it says."""
        return self.document.values

    @property
    def path(self) -> Path:
        """Of the list."""
        return self.document.path

    @property
    def folder(self) -> Path:
        """What file names are relative to."""
        return self.start_up.path.parent

    @property
    def diagnosis_file(self) -> str:
        """The file the list asks for (P-VOLC-00016), "" if it asks for none."""
        return self.values.text("diagnosis_file")


Position = tuple[float | None, ...]
"""Of the axes in ``LETTERS``, mm or °; None for those a parameter does not depend on."""


class Record(NamedTuple):
    """One value of a parameter file, in mm or rad or a bare number, with its line.

    ``parameter`` is one of ``PARAMETERS``; ``note`` says why the record does not count, "" if it does.
    """

    parameter: str
    position: Position
    value: float
    line: int
    note: str


@dataclass(frozen=True)
class ParameterFile:
    """A parameter file with its records, sorted by parameter (``ERRORS``, then ``DESCRIPTION``) and position.

    Those of a polyline stand in the order of the file. ``index``, 0..9, is ``j`` of ``file[j]``; ``path`` is the name
    alone if there is no such file; ``was_read`` is false if there is none, or it is no text.
    """

    index: int
    path: Path
    was_read: bool
    records: tuple[Record, ...]


@dataclass(frozen=True)
class Diagnosis:
    """All that was read for a volumetric compensation.

    Attributes
    ----------
    source : VolumetricList
    files : tuple of ParameterFile
        In the order of the list.
    counted, spliced : int
        Records that count against ``max_records``, and how many of them ``enable_splicing`` has added.
    axes : dict of str to (float, str)
        Letter → logical axis number and where it stands: ``LN*`` in a parameter file beats the list.
    in_force : bool
        Whether no error keeps the compensation off.
    findings : tuple of Finding
        Those about the list and its files.
    """

    source: VolumetricList
    files: tuple[ParameterFile, ...]
    counted: int
    spliced: int
    axes: dict[str, tuple[float, str]]
    in_force: bool
    findings: tuple[Finding, ...]


def volumetric_lists(reading: Reading) -> tuple[list[VolumetricList], list[str]]:
    """Return the volumetric lists of a machine, and a sentence for each that could not be read."""
    found: list[VolumetricList] = []
    faults: list[str] = []
    start_up = reading.start_up
    if start_up is None:
        return found, faults
    files = Files(Findings(), reading.documents.values())
    for index in range(COMPENSATIONS_MAX):
        name = start_up.values.text(FILE_NAME, index)
        path = files.named(start_up.path.parent, name, ("", 0, "")) if name else None
        document = None if path is None else files.document(path)
        if document is not None:
            found.append(VolumetricList(index, start_up, document))
        elif name:
            faults.append(f"the volumetric list {name!r}, which {start_up.path.name} names, cannot be read.")
    return found, faults


def write_named_diagnoses(reading: Reading, index: int | None = None) -> Iterator[Path | str]:
    """Write the diagnosis files that volumetric lists name, or only that of one of them.

    Yields the path of each, and sentences; what stands in the way of a file is one of these.
    """
    sources = [one for one in volumetric_lists(reading)[0] if one.diagnosis_file and index in (None, one.index)]
    if not sources:
        return
    try:
        from .files import Written, write_diagnoses
    except ModuleNotFoundError as error:
        names = ", ".join(source.diagnosis_file for source in sources)
        yield f"{names} is not written: {sentence(error.name or '', 'tables', 'it')}."
        return
    for result in write_diagnoses(sources, reading):
        if isinstance(result, Written):
            yield result.path
            yield from result.notes
        else:
            yield str(result)


def diagnose(source: VolumetricList, reading: Reading) -> Diagnosis:
    """Return all records of the parameter files of a list; ``reading``: of its machine."""
    values = source.values
    read = list(_parameter_files(source, reading))
    blocks = [block for _, _, held in read for block in held or ()]
    mode = values.text("interpolation")
    parameters = assemble(blocks, mode, enable_splicing=False, findings=Findings())
    counted = parameters.records()
    if values.flag("enable_splicing"):
        counted = assemble(blocks, mode, enable_splicing=True, findings=Findings()).records()
    sorted_records = _Sorter(values.text("chain").upper(), mode, blocks)
    files = tuple(ParameterFile(j, path, held is not None, sorted_records(held or [])) for j, path, held in read)
    names = {str(source.path), *(str(file.path) for file in files)}
    entry = f"vol_comp[{source.index}]."
    return Diagnosis(
        source,
        files,
        counted,
        counted - parameters.records(),
        dict(_axes(values, parameters)),
        any(one.index == source.index for one in reading.machine.volumetric),
        tuple(finding for finding in reading.findings if finding.file in names or finding.parameter.startswith(entry)),
    )


def _parameter_files(
    source: VolumetricList, reading: Reading
) -> Iterator[tuple[int, Path, list[ParameterBlock] | None]]:
    """Yield index, path and blocks (None: unreadable) of each file the list names; its faults are known already."""
    findings = Findings()
    files = Files(findings, reading.documents.values())
    for j in range(FILES_MAX):
        name = source.values.text("file[j]", j)
        if not name:
            continue
        path = files.named(source.folder, name, ("", 0, ""))
        document = None if path is None else files.document(path)
        path = path or Path(PureWindowsPath(name).name)
        etalon = source.values.text("file_format[j]", j) == ETALON_EXCHANGE
        reader = read_etalon if etalon else read_isg_csv
        yield j, path, None if document is None else reader(document.text, str(path), findings)


def _axes(values: ListValues, parameters: Parameters) -> Iterator[tuple[str, tuple[float, str]]]:
    for letter, name in zip(LETTERS, AXIS_NUMBERS, strict=True):
        entry = letter.lower()
        constant = parameters.description.get(name)
        if constant is not None:
            yield letter, (constant.value, f"{Path(constant.file).name}:{constant.line}")
        elif values.given(entry):
            yield letter, (values.integer(entry), f"{Path(values.file).name}:{values.line(entry)}")


class _Sorter:
    """Sorts records, and knows which do not count: others stand for them, or their axis takes no part."""

    def __init__(self, chain: str, mode: str, blocks: Sequence[ParameterBlock]) -> None:
        self._chain = chain
        self._polylines = mode in _POLYLINES
        self._last: dict[tuple[str, Position], tuple[ParameterBlock, int]] = {}
        for block in blocks:
            for i, position in enumerate(_positions(block)):
                for name in block.names:
                    self._last[name, position] = (block, i)

    def __call__(self, blocks: Sequence[ParameterBlock]) -> tuple[Record, ...]:
        """Return the records of some blocks by parameter, then by position unless they are those of a polyline."""

        def order(record: Record) -> tuple[int, tuple[float, ...]]:
            position = () if self._polylines else record.position
            return _RANK[record.parameter], tuple(-math.inf if x is None else x for x in position)

        found = [
            Record(name, position, value, block.lines[i], self._note(block, i, name, position))
            for block in blocks
            for i, position in enumerate(_positions(block))
            for name, value in zip(block.names, block.rows[i][len(block.arguments) :], strict=True)
        ]
        return tuple(sorted(found, key=order))

    def _note(self, block: ParameterBlock, i: int, name: str, position: Position) -> str:
        """Return why the record of a parameter in row ``i`` of a block does not count, "" if it does."""
        if block.arguments and self._polylines:
            # A polyline may come back to a position: only the next record, at the same one, replaces one.
            width = len(block.arguments)
            again = i + 1 < len(block.rows) and block.rows[i + 1][:width] == block.rows[i][:width]
            by, row = block, i + again
        else:
            by, row = self._last[name, position]
        if by is not block or row != i:
            return f"replaced by {Path(by.file).name}:{by.lines[row]}"
        if name in ERRORS and name[-1] not in self._chain:
            return f"not used: {name[-1]} is not in the chain {self._chain}"
        return ""


def _positions(block: ParameterBlock) -> Iterator[Position]:
    columns = [block.arguments.index(letter) if letter in block.arguments else None for letter in LETTERS]
    for row in block.rows:
        yield tuple([None if column is None else row[column] for column in columns])
