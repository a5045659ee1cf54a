"""What all formats share: options, what is wrong with a file or a table, and numbers in text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal, TypeAlias

Unit: TypeAlias = Literal["mm", "deg"]

MM_PER_INCH = 25.4
MAX_POINTS = 5000
"""Points a table may have unless told otherwise; what a SINUMERIK takes is set on it (MD38000, MD18342)."""
DECIMALS = 12
"""Decimals written where the other format sets no limit: all that a length has, and none of the noise behind."""
LARGEST = 1e9
"""Largest number in a table: no machine is longer than 1000 km, and nothing overflows."""

_NUMBER = re.compile(r"[+-]?(?:[0-9]{1,40}\.?[0-9]{0,40}|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,3})?\Z")


class FormatError(ValueError):
    """A file that is not of its format, with the line that shows it (counted from 1; 0: the file as a whole)."""

    def __init__(self, line: int, message: str) -> None:
        self.line = line
        self.message = message
        super().__init__(f"line {line}: {message}" if line else message)


class CannotHoldError(ValueError):
    """A table that the other format has no room for: the message says which one and what is missing."""


@dataclass(frozen=True)
class Options:
    """What a file does not tell of itself.

    Attributes
    ----------
    axis, over : str or None
        The corrected axis and the axis looked up, where the format names none.
    rotary : frozenset of str
        Names of the rotary axes.
    inch : bool
        Lengths are in inches: the basic system of a SINUMERIK, the machine units of LinuxCNC.
    encoder : int
        Measuring system of ENC_COMP, 0 or 1.
    max_points : int
        Points the other control reserves for a table.
    within : float or None
        µm (″) that another choice of points may cost; None: the points stay as they are.
    """

    axis: str | None = None
    over: str | None = None
    rotary: frozenset[str] = frozenset()
    inch: bool = False
    encoder: int = 0
    max_points: int = MAX_POINTS
    within: float | None = None

    def unit(self, axis: str) -> Unit:
        """Return the unit of an axis."""
        return "deg" if axis in self.rotary else "mm"

    def scale(self, unit: Unit) -> float:
        """Return how many mm (or degrees) one unit of the file is."""
        return MM_PER_INCH if self.inch and unit == "mm" else 1.0

    def check_metric(self) -> None:
        """Refuse inches, for a format that is written in mm only."""
        if self.inch:
            raise CannotHoldError("this format is written in mm only")


DEFAULTS = Options()


def number(word: str, line: int, what: str) -> float:
    """Return a number of a sensible size; FormatError names what it should have been."""
    if not _NUMBER.match(word):
        raise FormatError(line, f"{what} must be a number, not {shortened(word)!r}")
    if abs(float(word)) > LARGEST:
        raise FormatError(line, f"{what} is too large: {shortened(word)}")
    return float(word)


def shortened(text: str, length: int = 40) -> str:
    """Return a text short enough for a message."""
    return text if len(text) <= length else text[: length - 1] + "…"


def decimal(value: float) -> str:
    """Return a number as plain decimals: ``0.012``, ``-400``, never ``1e-05`` or ``-0``."""
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
