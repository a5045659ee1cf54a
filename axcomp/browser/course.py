"""Inputs by chance that are the same bits in Python, in NumPy and in a browser, and a digest of what comes out.

``static/course.js`` says the same in JavaScript.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from typing import Any, NamedTuple

from ..interface import Variable

STRETCH = 64
"""Cycles over which an input goes straight on; a power of two."""
RARE = 16
"""A Boolean is true in one of so many stretches."""
_MASK = 0xFFFFFFFF

_RANGES = {
    "setpoint": (-400.0, 400.0),
    "actual_position": (-400.0, 400.0),
    "velocity": (-100.0, 100.0),
    "acceleration": (-2000.0, 2000.0),
    "tool_length": (0.0, 200.0),
    "offset": (-0.1, 0.1),
    "coefficient": (-1e-4, 1e-4),
}
"""By the last part of the name; others go from 0 to 1, velocities to come as velocities."""


class Column(NamedTuple):
    """An input: its value reference, its type (r, i or b as in C), and from where to where it goes."""

    reference: int
    type: str
    low: float
    high: float


def columns_of(variables: Iterable[Variable]) -> list[Column]:
    """Return the inputs among some variables."""
    letters = {float: "r", int: "i", bool: "b"}
    return [
        Column(
            one.reference,
            letters[type(one.start)],
            *_RANGES.get(one.quantity.split(".")[-1].split("_ahead")[0], (0.0, 1.0)),
        )
        for one in variables
        if one.causality == "input" and type(one.start) in letters
    ]


def mixed(number: Any) -> Any:
    """Return 32 bits that look like chance; ``number``: one of 32 bits, or a NumPy array of uint64."""
    number = (number ^ (number >> 16)) * 0x7FEB352D & _MASK
    number = (number ^ (number >> 15)) * 0x846CA68B & _MASK
    return number ^ (number >> 16)


def drawn(column: Column, number: int, row: Any) -> Any:
    """Return the value of the input with a number in a row, or in rows: a NumPy array of uint64."""
    own, stretch = mixed(number), row // STRETCH
    before, after = mixed((own + stretch) & _MASK), mixed((own + stretch + 1) & _MASK)
    share = before / 2.0**32
    if column.type == "b":
        return (share * RARE < 1.0) * 1.0
    if column.type == "i":
        return share * 3.0 // 1.0 - 1.0
    moves = (before & 3 != 0) * 1.0
    way = (after / 2.0**32 - share) * moves * ((row % STRETCH) / STRETCH)
    return column.low + (column.high - column.low) * (share + way)


def digest(rows: bytes, before: int = 0) -> int:
    """Return the CRC-32 of rows of doubles, little-endian, going on from that of the rows before."""
    return zlib.crc32(rows, before)
