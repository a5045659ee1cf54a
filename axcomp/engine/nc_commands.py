"""The blocks that are understood, and what they say (semantics §10 and §11).

``X[COMP ON CROSS PLANE]  Y[COMP OFF LEAD NO_MOVE]  Z[COMP OFF_ALL]``; ``#VOLCOMP ON [ID=0 NO_MOVE CFACT_X=0.5]``,
``#VOLCOMP OFF [ID=0]``, ``#VOLCOMP [ID=0 UPDATE]``, ``#VOLCOMP ON ALL``; ``V.G.VOLCOMP[0].FILE[1] = "new.csv"`` and,
to have their values told, ``V.G.VOLCOMP[0].ACTIVE`` and ``V.A.CROSS_COMP_ACTIVE.X``. ``ID0`` and ``ID 0`` are other
spellings of ``ID=0``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..kinds import KINDS
from ..model import COMPENSATIONS_MAX, FILES_MAX, LINEAR
from .nc_scanner import Cursor, NcError, Word, scan

WORDS = {kind.word: name for name, kind in KINDS.items()}
"""Keyword of a command → kind of compensation."""


@dataclass(frozen=True)
class AxisCommand:
    """``X[COMP …]``.

    Attributes
    ----------
    place : int
        Character of the block where it begins.
    axis : str
        Name in capitals.
    on, off : tuple of str
        Kinds of compensation.
    all_on, all_off : bool
        ``ON`` without a kind, ``OFF_ALL``: all that are configured.
    no_move : bool
    """

    place: int
    axis: str
    on: tuple[str, ...] = ()
    off: tuple[str, ...] = ()
    all_on: bool = False
    all_off: bool = False
    no_move: bool = False


@dataclass(frozen=True)
class VolumetricSwitch:
    """``#VOLCOMP ON|OFF …``; ``index`` None: all. ``factors``: CFACT of X, Y, Z."""

    place: int
    on: bool
    index: int | None
    no_move: bool = False
    factors: tuple[float, ...] = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class VolumetricUpdate:
    """``#VOLCOMP [ID=n UPDATE]``."""

    place: int
    index: int


@dataclass(frozen=True)
class Variable:
    """``V.G.VOLCOMP[i].FILE[j]`` (``file`` = j) or ``V.G.VOLCOMP[i].ACTIVE`` (``file`` None)."""

    place: int
    index: int
    file: int | None

    def __str__(self) -> str:
        rest = "ACTIVE" if self.file is None else f"FILE[{self.file}]"
        return f"V.G.VOLCOMP[{self.index}].{rest}"


@dataclass(frozen=True)
class AxisVariable:
    """``V.A.CROSS_COMP_ACTIVE.X`` and the like: whether a kind of compensation of an axis is active."""

    place: int
    kind: str
    axis: str

    def __str__(self) -> str:
        return f"V.A.{KINDS[self.kind].word}_COMP_ACTIVE.{self.axis}"


@dataclass(frozen=True)
class Assignment:
    """``variable = value``; the value is a string or another variable."""

    variable: Variable
    value: str | Variable


Command = AxisCommand | VolumetricSwitch | VolumetricUpdate | Variable | AxisVariable | Assignment


def parse_block(block: str) -> tuple[Command, ...]:
    """Return the commands of a block, or of several on lines of their own.

    NcError with what was expected at which character.
    """
    cursor = Cursor(scan(block))
    commands: list[Command] = []
    first = True  # in its line
    while cursor.word.kind != "end":
        word = cursor.word
        if word.kind == "line" or (first and re.fullmatch(r"N\d+", word.text)):
            first = cursor.take().kind == "line"
            continue
        first = False
        if word.text == "#":
            cursor.take()
            cursor.expect("VOLCOMP")
            commands.append(_volumetric(cursor, word.place))
        elif word.text.startswith("V.G."):
            variable = _variable(cursor)
            commands.append(_assignment(cursor, variable) if cursor.take_if("=") else variable)
        elif word.text.startswith("V.A."):
            commands.append(_axis_variable(cursor))
        elif word.kind == "name":
            commands.append(_axis_command(cursor))
        else:
            raise cursor.wrong("an axis, #VOLCOMP or V.G.VOLCOMP")
    return tuple(commands)


def parse_variable(cursor: Cursor) -> Variable | AxisVariable:
    """Take a variable ``V.G.VOLCOMP[i]…`` or ``V.A.…_COMP_ACTIVE.X``."""
    return _axis_variable(cursor) if cursor.word.text.startswith("V.A.") else _variable(cursor)


def _axis_variable(cursor: Cursor) -> AxisVariable:
    word = cursor.take()
    found = re.fullmatch(r"V\.A\.(\w+)_COMP_ACTIVE\.(.+)", word.text)
    if found is None or found[1] not in WORDS:
        raise NcError(word.place, f"V.A.…_COMP_ACTIVE.X with {', '.join(WORDS)} is expected, not “{word.text}”")
    return AxisVariable(word.place, WORDS[found[1]], found[2])


def _variable(cursor: Cursor) -> Variable:
    place = cursor.expect("V.G.VOLCOMP").place
    index = _index(cursor, COMPENSATIONS_MAX, "70506", "a volumetric compensation")
    member = cursor.expect(".FILE", ".ACTIVE")
    file = _index(cursor, FILES_MAX, "70507", "a parameter file") if member.text == ".FILE" else None
    return Variable(place, index, file)


def _index(cursor: Cursor, count: int, code: str, what: str) -> int:
    cursor.expect("[")
    word = cursor.expect_kind("number", f"the number of {what}")
    index = _whole(word, count, code, what)
    cursor.expect("]")
    return index


def _whole(word: Word, count: int, code: str, what: str) -> int:
    value = float(word.text)
    if value != int(value) or not 0 <= value < count:
        raise NcError(word.place, f"the number of {what} is 0 … {count - 1}, not {word.text}", code)
    return int(value)


def _assignment(cursor: Cursor, variable: Variable) -> Assignment:
    if variable.file is None:
        raise NcError(variable.place, f"{variable} can only be read")
    if cursor.word.text.startswith("V.G."):
        return Assignment(variable, _variable(cursor))
    return Assignment(variable, cursor.expect_kind("string", "a string in quotes").text)


def _axis_command(cursor: Cursor) -> AxisCommand:
    axis = cursor.take()
    cursor.expect("[")
    cursor.expect("COMP")
    switched: dict[bool, list[str]] = {True: [], False: []}
    all_on = all_off = no_move = False
    action = cursor.expect("ON", "OFF", "OFF_ALL")
    while True:
        if action.text == "OFF_ALL":
            all_off = True
        else:
            kinds = switched[action.text == "ON"]
            before = len(kinds)
            while (word := cursor.take_if(*WORDS)) is not None:
                kinds.append(WORDS[word.text])
            if len(kinds) == before:
                if action.text == "OFF":
                    raise cursor.wrong(", ".join(WORDS))
                all_on = True
        no_move = cursor.take_if("NO_MOVE") is not None or no_move
        if cursor.take_if("]"):
            if all_off and (all_on or any(switched.values())):
                raise NcError(axis.place, "OFF_ALL stands alone")
            if contradictory := [kind for kind in switched[False] if all_on or kind in switched[True]]:
                raise NcError(axis.place, f"{', '.join(KINDS[kind].word for kind in contradictory)} is both on and off")
            return AxisCommand(
                axis.place, axis.text, tuple(switched[True]), tuple(switched[False]), all_on, all_off, no_move
            )
        more = (*WORDS, "NO_MOVE") if action.text != "OFF_ALL" else ("NO_MOVE",)
        if (following := cursor.take_if("ON", "OFF", "OFF_ALL")) is None:
            raise cursor.wrong(", ".join((*more, "ON, OFF", "]")))
        action = following


def _volumetric(cursor: Cursor, place: int) -> Command:
    action = cursor.take_if("ON", "OFF")
    if action is None:
        if cursor.take_if("[") is None:
            raise cursor.wrong("ON, OFF or [")
        index = _identifier(cursor)
        cursor.expect("UPDATE")
        cursor.expect("]")
        return VolumetricUpdate(place, index)
    if cursor.take_if("ALL"):
        return VolumetricSwitch(place, action.text == "ON", None)
    if cursor.take_if("[") is None:
        raise cursor.wrong("ALL or [ID=…")
    index = _identifier(cursor)
    no_move = False
    factors = [1.0, 1.0, 1.0]
    while not cursor.take_if("]"):
        word = cursor.take_if("NO_MOVE", *(f"CFACT_{letter}" for letter in LINEAR))
        if word is None:
            raise cursor.wrong("NO_MOVE, CFACT_X, CFACT_Y, CFACT_Z or ]")
        if word.text == "NO_MOVE":
            no_move = True
        else:
            factors[LINEAR.index(word.text[-1])] = _factor(cursor, word.text)
    return VolumetricSwitch(place, action.text == "ON", index, no_move, tuple(factors))


def _identifier(cursor: Cursor) -> int:
    what = "a volumetric compensation"
    word = cursor.word
    if old := re.fullmatch(r"ID(\d+)", word.text):
        cursor.take()
        return _whole(Word("number", old[1], word.place + 2), COMPENSATIONS_MAX, "21749", what)
    if cursor.take_if("ID") is None:
        raise cursor.wrong("ID=…")
    cursor.take_if("=")
    return _whole(cursor.expect_kind("number", f"the number of {what}"), COMPENSATIONS_MAX, "21749", what)


def _factor(cursor: Cursor, name: str) -> float:
    cursor.expect("=")
    word = cursor.expect_kind("number", "a number 0 … 1")
    if not 0.0 <= float(word.text) <= 1.0:
        raise NcError(word.place, f"{name} is 0 … 1, not {word.text}")
    return float(word.text)
