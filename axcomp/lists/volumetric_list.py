"""The volumetric lists (``vol_comp*.lis``) that a start-up list names, with their parameter files.

An error in a list or a file keeps its compensation off: with half of its parameters it would correct wrongly.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

from ..kinds import ListKind
from ..model import (
    AXIS_NUMBERS,
    CENTERS,
    COMPENSATIONS_MAX,
    COPLANAR,
    DIRECTIONS,
    FILES_MAX,
    LETTERS,
    LINEAR,
    NO_VECTOR,
    NOMINAL_DIRECTIONS,
    OFFSETS,
    ROTARY,
    TOOL_ORIENTATION,
    TOOL_POSITION,
    UNIT_TOLERANCE,
    AxisType,
    ErrorTable,
    Triple,
    Volumetric,
    is_angle,
    jump_of,
    shown,
)
from .axes import Axes, AxisSettings
from .catalogue_volumetric import AUTO, ETALON_EXCHANGE
from .etalon import read_etalon
from .files import SIZE_MAX, Files, is_absolute
from .findings import Findings
from .isg_csv import read_isg_csv
from .recognition import parameter_format
from .start_up import MachineFiles
from .values import ListValues
from .volumetric_blocks import ParameterBlock
from .volumetric_parameters import Parameters, assemble

LIMIT_MAX = 429_496.7295
"""Largest s_limit that an axis list can hold, mm."""
_JUMP = 1e-9
"""mm or rad; below that a table is continuous."""

_HEAD_BYTES, _RECORD_BYTES = 1_000_000, 400
"""Bytes that a parameter file may have for its comments, and for each record: 7 numbers, blanks and a comment."""

_FILE_NAME, _MAX_RECORDS = "vol_comp[i].file_name", "vol_comp[i].max_records"


def read_volumetric(lists: MachineFiles, files: Files, axes: Axes, findings: Findings) -> tuple[Volumetric, ...]:
    """Return the volumetric compensations of a machine; where there are no axis lists, ``axes`` grows by their axes."""
    found = (read_one(index, lists, files, axes, findings) for index in range(COMPENSATIONS_MAX))
    return tuple(one for one in found if one is not None)


def read_one(
    index: int,
    lists: MachineFiles,
    files: Files,
    axes: Axes,
    findings: Findings,
    named: Mapping[int, str] = MappingProxyType({}),
) -> Volumetric | None:
    """Return one compensation, None where there is none or an error keeps it off.

    ``named``: parameter files to be read instead of those the list names, by their index.
    """
    path = _list_of(index, lists, files)
    document = None if path is None else files.document(path)
    if document is None:
        return None
    errors = findings.errors()
    values = document.read_as(ListKind.VOLUMETRIC, findings)
    reader = VolumetricReader(index, values, lists, files, axes, findings, named)
    volumetric = reader.read()
    is_faulty = findings.errors() > errors
    reader.check_diagnosis_file()
    if is_faulty:
        return None
    reader.check_limits(dict(volumetric.axes))
    return volumetric


def _list_of(index: int, lists: MachineFiles, files: Files) -> Path | None:
    """Return the list of a compensation: the one the start-up list names, or the only list there is."""
    start_up = lists.start_up
    name = "" if start_up is None else start_up.text(_FILE_NAME, index)
    if start_up is None or not name:
        return lists.volumetric[index] if index < len(lists.volumetric) else None
    parameter = _FILE_NAME.replace("[i]", f"[{index}]")
    return files.named(lists.folder, name, (*start_up.place(_FILE_NAME, index), parameter))


def check_parameters(path: Path, files: Files, findings: Findings) -> None:
    """Read a file of volumetric parameters that no list names: what can be said of it alone."""
    document = files.document(path)
    if document is not None:
        read = read_etalon if parameter_format(document.text) == ETALON_EXCHANGE else read_isg_csv
        assemble(read(document.text, str(path), findings), AUTO, False, findings)


class VolumetricReader:
    """Reads one volumetric list."""

    def __init__(
        self,
        index: int,
        values: ListValues,
        lists: MachineFiles,
        files: Files,
        axes: Axes,
        findings: Findings,
        named: Mapping[int, str] = MappingProxyType({}),
    ) -> None:
        self.index = index
        self.named = [named.get(j, values.text("file[j]", j)) for j in range(FILES_MAX)]
        self.values = values
        self.lists = lists
        self.files = files
        self.axes = axes
        self.findings = findings

    def read(self) -> Volumetric:
        """Return the compensation, which must not be used if there are new errors among the findings."""
        values = self.values
        chain = self._chain()
        parameters = assemble(
            self._blocks(), values.text("interpolation"), values.flag("enable_splicing"), self.findings
        )
        self._check_records(parameters)
        assigned = self._assigned(chain, parameters)
        directions = tuple(
            self._direction(names, parameters) or nominal
            for names, nominal in zip(DIRECTIONS, NOMINAL_DIRECTIONS, strict=True)
        )
        self._check_directions(chain, directions, parameters)
        errors = tuple(self._acting_errors(chain, parameters))
        self._check_turns(errors, assigned, parameters)
        if values.flag("use_axis_offsets"):
            self._note("AXC-NOT-MODELLED", "use_axis_offsets", "Offsets of the axes are not modelled; they are 0.")
        return Volumetric(
            index=self.index,
            axes=tuple(assigned.items()),
            chain=chain,
            workpiece_axes=values.integer("workpiece_axes"),
            errors=errors,
            tool_position=_triple(TOOL_POSITION, parameters),
            tool_orientation=self._direction(TOOL_ORIENTATION, parameters) or NO_VECTOR,
            centers=tuple(_triple(names, parameters) for names in CENTERS),
            directions=directions,
            offsets=tuple(_value(name, parameters) for name in OFFSETS),
            alternative_model=values.flag("alternative_model"),
            negate=self._letters("negate"),
            set_to_zero=self._letters("set_to_zero"),
            manual_activation=values.flag("manual_activation"),
            filter_steps=values.integer("filter_steps"),
            associate_to_channel=values.flag("associate_to_channel"),
            max_records=self._max_records(),
            files=tuple(self.named),
            diagnosis_file=values.text("diagnosis_file"),
        )

    def _chain(self) -> str:
        chain = self.values.text("chain").replace(" ", "").upper()
        if not (len(set(chain)) == len(chain) and set(LINEAR) <= set(chain) <= set(LETTERS)):
            message = f"The chain {chain} is not X, Y, Z and some of A, B, C, each once; the compensation stays off."
            self._note("AXC-CHAIN", "chain", message)
        elif self.values.integer("workpiece_axes") > len(chain):
            message = f"workpiece_axes is larger than the chain {chain}; the compensation stays off."
            self._note("AXC-CHAIN", "workpiece_axes", message)
        return chain

    def _blocks(self) -> Iterator[ParameterBlock]:
        """Yield what the parameter files hold."""
        empty = True
        for j, name in enumerate(self.named):
            if not name:
                continue
            path = self.files.named(self.lists.folder, name, (*self.values.place("file[j]", j), f"file[{j}]"))
            document = None if path is None else self.files.document(path, size_of_records(self._max_records()))
            if document is None:
                empty = False
                continue
            etalon = self.values.text("file_format[j]", j) == ETALON_EXCHANGE
            for block in (read_etalon if etalon else read_isg_csv)(document.text, str(path), self.findings):
                empty = False
                yield block
        if empty:
            self._note("AXC-NO-RECORD", "file[0]", "The compensation has no parameters; it corrects nothing.")

    def _max_records(self) -> int:
        start_up = self.lists.start_up
        return 0 if start_up is None else start_up.integer(_MAX_RECORDS, self.index)

    def _check_records(self, parameters: Parameters) -> None:
        start_up = self.lists.start_up
        bound, records = self._max_records(), parameters.records()
        if start_up is not None and records > bound:
            given = start_up.given(_MAX_RECORDS, self.index)
            place = start_up.place(_MAX_RECORDS if given else _FILE_NAME, self.index)
            shown = _MAX_RECORDS.replace("[i]", f"[{self.index}]")
            reserved = f"{bound} are reserved" if given else f"{shown} is missing"
            message = f"The parameter files have {records} records, but {reserved}; the compensation stays off."
            self.findings.add("AXC-MAX-RECORDS", *place, shown, message)

    def _assigned(self, chain: str, parameters: Parameters) -> dict[str, int]:
        """Return the logical axis number of each letter; ``LN*`` in a parameter file beats the list."""
        assigned: dict[str, int] = {}
        for letter, name in zip(LETTERS, AXIS_NUMBERS, strict=True):
            place = self.values.place(letter.lower())
            shown = letter.lower()
            number: float = self.values.integer(letter.lower())
            if name in parameters.description:
                constant = parameters.description[name]
                number, place, shown = constant.value, (constant.file, constant.line), name
            fault = ""
            if number in assigned.values():
                fault = "is the number of another of its axes"
            elif number and not (number == int(number) and self._exists(int(number), letter)):
                fault = "is no logical number of an axis of the machine"
            elif number and not self._has_type(int(number), letter):
                fault = f"is no {'translatory' if letter in LINEAR else 'rotary'} axis"
            elif not number and letter in {*chain, *LINEAR, *_arguments(parameters)}:
                place = place if place[1] else self.values.place("chain")
                fault = "is not assigned"
            if fault:
                what = f"{shown} = {number:g}" if number else shown
                self.findings.add("AXC-ASSIGNMENT", *place, shown, f"{what} {fault}; the compensation stays off.")
            elif number:
                assigned[letter] = int(number)
        return assigned

    def _exists(self, number: int, letter: str) -> bool:
        if self.axes.invent and 0 < number < 2**16:
            if number not in self.axes:
                self.axes.add(AxisSettings(number), *self.values.place(letter.lower()), letter.lower())
            if number in self.axes and letter not in LINEAR:
                self.axes.get(number).type = AxisType.ROTARY
        return number in self.axes

    def _has_type(self, number: int, letter: str) -> bool:
        return (self.axes.get(number).type is AxisType.TRANSLATORY) == (letter in LINEAR)

    def check_diagnosis_file(self) -> None:
        """Find a diagnosis file that would not be written: it is to lie outside."""
        name = self.values.text("diagnosis_file")
        try:
            outside = name and not is_absolute(name) and self.files.place(self.lists.folder, name) is None
        except (OSError, ValueError):
            outside = False
        if outside:
            message = f"{name!r} leads out of the folder of the machine; it is not written without --allow-outside."
            self._note("AXC-FOLDER", "diagnosis_file", message)

    def check_limits(self, assigned: dict[str, int]) -> None:
        """Look for the limits that switching on will ask for."""
        free = []
        for letter in LINEAR:
            for axis in self.axes.all():
                leader = axis.number if axis.number in assigned.values() else axis.gantry_master
                if leader != assigned[letter]:
                    continue
                if self.axes.invent:
                    # Without axis lists a list can be tried on its own: nothing limits it then.
                    axis.s_limit = axis.s_limit or LIMIT_MAX
                if not axis.s_limit:
                    message = (
                        f"Axis {axis.number} has no lr_param.vol_comp.s_limit: "
                        f"volumetric compensation {self.index} cannot be switched on."
                    )
                    self._note("AXC-LIMIT", letter.lower(), message)
                elif not axis.v_limit and not self.axes.invent:
                    free.append(axis.number)
        if free:
            numbers = ", ".join(map(str, sorted(free)))
            message = f"No lr_param.vol_comp.v_limit for axis {numbers}: nothing but filter_steps slows a switch down."
            self._note("AXC-V-LIMIT", "filter_steps", message)

    def _direction(self, names: tuple[str, ...], parameters: Parameters) -> Triple | None:
        """Return a vector of length 1; None where it is not given or 0."""
        vector = _triple(names, parameters)
        given = [parameters.description[name] for name in names if name in parameters.description]
        if not given:
            return None
        length = math.hypot(*vector)
        if length == 0.0:
            self.findings.add(
                "AXC-VECTOR",
                given[0].file,
                given[0].line,
                names[0],
                f"The vector {' '.join(names)} is 0; it is left out.",
            )
            return None
        if abs(length - 1.0) <= UNIT_TOLERANCE:
            return vector
        message = f"The vector {' '.join(names)} has length {length:g}; it is scaled to 1."
        self.findings.add("AXC-VECTOR", given[0].file, given[0].line, names[0], message)
        x, y, z = (component / length for component in vector)
        return x, y, z

    def _check_directions(self, chain: str, directions: tuple[Triple, ...], parameters: Parameters) -> None:
        """Find X, Y and Z in one plane, wherever the rotary axes stand; in other chains it depends on these."""
        if "".join(letter for letter in chain if letter in LINEAR) not in chain:
            return
        (a, b, c), (d, e, f), (g, h, i) = directions[:3]
        if abs(a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)) < COPLANAR:
            name = next(name for names in DIRECTIONS[:3] for name in names if name in parameters.description)
            constant = parameters.description[name]
            message = "The directions of X, Y and Z lie in one plane; the compensation stays off."
            self.findings.add("AXC-SINGULAR", constant.file, constant.line, name, message)

    def _acting_errors(self, chain: str, parameters: Parameters) -> Iterator[ErrorTable]:
        for name, table in parameters.errors.items():
            if name[-1] in chain:
                yield table
            else:
                file, line = parameters.places[name]
                message = f"{name} is not used: {name[-1]} is not in the chain {chain}."
                self.findings.add("AXC-UNUSED", file, line, name, message, group=f"errors of {name[-1]}")

    def _check_turns(self, errors: tuple[ErrorTable, ...], assigned: dict[str, int], parameters: Parameters) -> None:
        """Find tables that jump while a rotary axis goes on turning, and splicing that changes nothing."""
        if self.values.flag("enable_splicing") and not parameters.spliced:
            message = "enable_splicing has no effect: no table over one rotary axis lacks a record one turn later."
            self._note("AXC-SPLICING", "enable_splicing", message)
        jumps: dict[tuple[tuple[str, int], str, float], list[str]] = {}
        for table in errors:
            for letter in set(table.arguments).intersection(assigned, ROTARY):
                modulo = self.axes.get(assigned[letter]).modulo
                at, jump = jump_of(table, letter, None if modulo is None else modulo.length)
                if abs(jump) > _JUMP:
                    factor, unit = shown("rad" if is_angle(table.name) else "mm")
                    size = f"{table.name} by {factor * abs(jump):.3g} {unit}"
                    jumps.setdefault((parameters.places[table.name], letter, at), []).append(size)
        for ((file, line), letter, at), sizes in jumps.items():
            message = f"The records over {letter} do not close: at {at:g}° the correction jumps, {', '.join(sizes)}."
            self.findings.add("AXC-OPEN", file, line, letter, message)

    def _letters(self, name: str) -> str:
        """Return the linear axes that an entry names, in the order X, Y, Z."""
        text = self.values.text(name).upper()
        strangers = set(text) - set(LINEAR) - set(" ,")
        if strangers:
            message = f"{name}: {' '.join(sorted(strangers))} is not taken; only X, Y and Z are corrected."
            self._note("AXC-RANGE", name, message)
        return "".join(letter for letter in LINEAR if letter in text)

    def _note(self, code: str, name: str, message: str) -> None:
        key, _, index = name.partition("[")
        place = self.values.place(f"{key}[j]", int(index[:-1])) if index else self.values.place(key)
        self.findings.add(code, *place, name, message)


def size_of_records(count: int) -> int:
    """Return how many bytes a parameter file may have of which so many records are read."""
    return min(_HEAD_BYTES + _RECORD_BYTES * count, SIZE_MAX)


def _arguments(parameters: Parameters) -> set[str]:
    return {letter for table in parameters.errors.values() for letter in table.arguments}


def _value(name: str, parameters: Parameters) -> float:
    constant = parameters.description.get(name)
    return 0.0 if constant is None else constant.value


def _triple(names: tuple[str, ...], parameters: Parameters) -> Triple:
    x, y, z = (_value(name, parameters) for name in names)
    return x, y, z
