"""What declarations are made of: parameters of the lists with their types, units and ranges, and codes of findings."""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cache, cached_property
from typing import Any

Value = int | Decimal | str
"""A value as it stands in a list: Booleans are 0 or 1, decimals are exact."""


class Severity(enum.Enum):
    """How much a finding matters; the order of the members is the order of the matter."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


Codes = Mapping[str, tuple[Severity, str]]
"""Codes of findings → their severity and what they mean."""


class ListKind(enum.Enum):
    """The kinds of lists, with the file names that are usual for them."""

    START_UP = "hochlauf.lis"
    AXIS = "achsmd*.lis"
    COMPENSATION = "achskw*.lis"
    VOLUMETRIC = "vol_comp*.lis"


class Manual(enum.Enum):
    """The manuals that describe parameters. Ids are re-used between them: a name is the only sure key."""

    ISG = "ISG axis compensation"
    TWINCAT = "TwinCAT axis compensation"
    LEADSCREW = "ISG leadscrew compensation"
    VOLUMETRIC = "Volumetric compensation"
    AXIS = "Axis parameters"
    START_UP = "Start-up list"


class DataType(enum.Enum):
    """Data types of the manuals; integers with their smallest and largest value."""

    BOOLEAN = (0, 1)
    UNS08 = (0, 2**8 - 1)
    UNS16 = (0, 2**16 - 1)
    UNS32 = (0, 2**32 - 1)
    SGN16 = (-(2**15), 2**15 - 1)
    SGN32 = (-(2**31), 2**31 - 1)
    SGN64 = (-(2**63), 2**63 - 1)
    STRING = None


class Quantity(enum.Enum):
    """What a number stands for: its unit on a translatory and on a rotary axis, and how many make 1 mm, °, … ."""

    NUMBER = ("", "", 1)
    CYCLES = ("cycles", "cycles", 1)
    POSITION = ("0.1 µm", "0.0001°", 10_000)
    VELOCITY = ("µm/s", "0.001°/s", 1_000)
    ACCELERATION = ("mm/s²", "", 1)
    CURRENT = ("drive unit", "drive unit", 1)
    PER_MILLE = ("0.1 %", "0.1 %", 1_000)
    GRADIENT = ("µm/m", "0.001°/°", 1_000_000)

    @property
    def divisor(self) -> int:
        """Values of the list that make one mm, °, mm/s, °/s or 1."""
        return self.value[2]

    @property
    def whole(self) -> bool:
        """Whether only whole numbers make sense; all else may have decimals, whatever the data type says."""
        return self in (Quantity.NUMBER, Quantity.CYCLES)


@dataclass(frozen=True)
class Range:
    """An interval as in ``[0, MAX)``; MIN and MAX are those of the data type.

    Attributes
    ----------
    text : str
        The interval as the catalogue gives it.
    low, high : int
        Its bounds.
    low_open, high_open : bool
        Whether a bound itself lies outside.
    """

    text: str
    low: int
    high: int
    low_open: bool
    high_open: bool

    @classmethod
    def parse(cls, text: str, data_type: DataType) -> Range:
        """Read ``[low, high]`` with round brackets for bounds that lie outside; ValueError if it is none."""
        match = re.fullmatch(r"([\[(])(-?\d+|MIN), (-?\d+|MAX)([\])])", text)
        if match is None:
            raise ValueError(f"not an interval: {text}")
        low, high = data_type.value or (0, 0)
        return cls(
            text,
            low if match[2] == "MIN" else int(match[2]),
            high if match[3] == "MAX" else int(match[3]),
            match[1] == "(",
            match[4] == ")",
        )

    @property
    def words(self) -> str:
        """The interval for a sentence: ``> 0 and ≤ 20``."""
        return f"{'>' if self.low_open else '≥'} {self.low} and {'<' if self.high_open else '≤'} {self.high}"

    def __contains__(self, value: int | Decimal) -> bool:
        """Whether a number lies inside."""
        low = value > self.low if self.low_open else value >= self.low
        return low and (value < self.high if self.high_open else value <= self.high)


@dataclass(frozen=True)
class Parameter:
    """One parameter of the lists, declared once for reader, writer, plausibility check and documentation.

    Attributes
    ----------
    name : str
        As in the manual, with letters for indices: ``kw.crosscomp2.table[j][i].correction``.
    meaning : str
        In a few words.
    type : DataType
        Of the manual; numbers that are no counts may nevertheless have decimals.
    default : int or str
        Used when the entry is missing or implausible.
    ids : mapping of Manual to str
        Id in each manual that describes the parameter; "" where it has none there, empty for what we added.
    quantity : Quantity
        Unit of a number.
    range : str
        Plausible numbers, see ``Range``.
    usable : str
        Numbers beyond ``range`` that are used all the same, with a warning; "" if there are none.
    values : tuple of int or str
        The only values allowed; empty if the range decides.
    names : mapping of str to int
        Names that stand for numbers, in capitals.
    flags : bool
        Names and numbers are bits that may be joined: ``A | B``.
    index_max : tuple of int
        Largest value of each index; empty if another parameter bounds it.
    index_code : str
        Code of the finding about an index that is too large.
    aliases, typos : tuple of str
        Other names: documented ones, and misspelt ones that are taken with a warning.
    code : str
        Code of the finding about a value outside the range.
    length : int
        Usual greatest length of a string; 0 if there is none.
    """

    name: str
    meaning: str
    type: DataType
    default: int | str
    ids: Mapping[Manual, str]
    quantity: Quantity = Quantity.NUMBER
    range: str = "[MIN, MAX]"
    usable: str = ""
    values: tuple[int | str, ...] = ()
    names: Mapping[str, int] = field(default_factory=dict)
    flags: bool = False
    index_max: tuple[int, ...] = ()
    index_code: str = "AXC-INDEX"
    aliases: tuple[str, ...] = ()
    typos: tuple[str, ...] = ()
    code: str = "AXC-RANGE"
    length: int = 0
    plausible: Range = field(init=False, repr=False)
    tolerable: Range = field(init=False, repr=False)

    def __post_init__(self) -> None:
        plausible = Range.parse(self.range, self.type)
        object.__setattr__(self, "plausible", plausible)
        object.__setattr__(self, "tolerable", Range.parse(self.usable, self.type) if self.usable else plausible)

    @property
    def key(self) -> str:
        """The name to look it up by: small letters, indices left empty."""
        return key_of(self.name)

    @property
    def unit(self) -> str:
        """Unit in the list; for a translatory and a rotary axis where they differ."""
        translatory, rotary, _ = self.quantity.value
        return translatory if rotary in ("", translatory) else f"{translatory} or {rotary}"

    @cached_property
    def _pattern(self) -> str:
        return re.sub(r"\[\w\]", "[{}]", self.name)

    def named(self, *indices: int) -> str:
        """Return the name with its indices filled in."""
        return self._pattern.format(*indices)

    def takes(self, value: Value) -> bool:
        """Whether a value would be used, be it with a warning."""
        if self.values:
            return value in self.values
        if isinstance(value, str) or self.type is DataType.STRING:
            return isinstance(value, str) and self.type is DataType.STRING
        return value in self.tolerable and not (self.quantity.whole and value % 1)


@cache
def key_of(name: str) -> str:
    """Return a name in small letters with empty indices, as the catalogue is searched by."""
    return re.sub(r"\[[^\]]*\]", "[]", name).lower()


def isg(number: str) -> dict[Manual, str]:
    """Return the id that only the ISG manual has."""
    return {Manual.ISG: f"P-COMP-{number}"}


def twincat(number: str) -> dict[Manual, str]:
    """Return the id that only the TwinCAT manual has."""
    return {Manual.TWINCAT: f"P-COMP-{number}"}


def both(number: str) -> dict[Manual, str]:
    """Return the id that both manuals of the compensation lists have."""
    return isg(number) | twincat(number)


def axis(number: str) -> dict[Manual, str]:
    """Return an id of the axis lists, where it is known."""
    return {Manual.AXIS: f"P-AXIS-{number}" if number else ""}


def activation(name: str, what: str, number: str) -> Parameter:
    """Return the axis parameter that activates a compensation."""
    return Parameter(name, f"Activates the {what}", DataType.BOOLEAN, 0, axis(number))


BELOW_MAX = "[MIN, MAX)"
AXIS_NUMBER = "[1, MAX]"


def smooth_switching(name: str, number: str) -> Parameter:
    """Return the number of cycles of smooth switching."""
    return Parameter(name, "Cycles of smooth switching", DataType.UNS16, 0, both(number), Quantity.CYCLES, "[0, 20]")


def position(name: str, meaning: str, ids: Mapping[Manual, str], **more: Any) -> Parameter:
    """Return a position or a correction of 32 bits."""
    return Parameter(name, meaning, DataType.SGN32, 0, ids, Quantity.POSITION, BELOW_MAX, **more)
