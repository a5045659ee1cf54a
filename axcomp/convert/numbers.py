"""Numbers in text files: read with the line in every message, written without exponent and without useless zeros."""

from __future__ import annotations

import re

from .table import MM_PER_INCH, FormatError, Unit

DECIMALS = 12
"""Decimals written where the other format sets no limit: all that a length has, and none of the noise behind."""
LARGEST = 1e9
"""Largest number in a table: no machine is longer than 1000 km, and nothing overflows."""

_NUMBER = re.compile(r"[+-]?(?:[0-9]{1,40}\.?[0-9]{0,40}|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,3})?\Z")


def number(word: str, line: int, what: str) -> float:
    """Return a number of a sensible size; FormatError names what it should have been."""
    if _NUMBER.match(word):
        value = float(word)
        if abs(value) <= LARGEST:
            return value
        raise FormatError(line, f"{what} is too large: {shortened(word)}")
    raise FormatError(line, f"{what} must be a number, not {shortened(word)!r}")


def shortened(text: str, length: int = 40) -> str:
    """Return a text short enough for a message."""
    return text if len(text) <= length else text[: length - 1] + "…"


def decimal(value: float, decimals: int = DECIMALS) -> str:
    """Return a number as plain decimals: ``0.012``, ``-400``, never ``1e-05`` or ``-0``."""
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def scale(unit: Unit, inch: bool) -> float:
    """Return how many mm (or degrees) one unit of a file is."""
    return MM_PER_INCH if inch and unit == "mm" else 1.0
