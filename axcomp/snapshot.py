"""Records as bytes: a snapshot of the engine, with a check before it is trusted."""

from __future__ import annotations

import dataclasses
import struct
import zlib
from array import array
from collections.abc import Iterator
from typing import Any

MAGIC = b"axcompS1"
HEADER = struct.Struct("<8sII")  # magic, numbers, CRC-32 of the numbers


class SnapshotError(ValueError):
    """Bytes that are no snapshot of these records; the message says why."""


def pack(*records: Any) -> bytes:
    """Return the numbers of the records as bytes; a ``Vec`` must not be among the fields."""
    numbers = array("d", [number for record in records for number in _numbers(record)])
    body = numbers.tobytes()
    return HEADER.pack(MAGIC, len(numbers), zlib.crc32(body)) + body


def unpack(data: bytes, *records: Any) -> None:
    """Put the numbers of a snapshot back into records of the same shape.

    Raises
    ------
    SnapshotError
        If the bytes are truncated, altered, or of records of another shape; the records are as before then.
    """
    if len(data) < HEADER.size:
        raise SnapshotError("the snapshot is truncated")
    magic, count, check = HEADER.unpack_from(data)
    body = data[HEADER.size :]
    if magic != MAGIC:
        raise SnapshotError("this is no snapshot of axcomp, or one of another version")
    if len(body) != 8 * count or zlib.crc32(body) != check:
        raise SnapshotError("the snapshot is truncated or altered")
    if count != sum(1 for record in records for _ in _numbers(record)):
        raise SnapshotError("the snapshot belongs to another machine")
    numbers = array("d")
    numbers.frombytes(body)
    source = iter(numbers)
    for record in records:
        _restore(record, source)


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, list):
        if value and isinstance(value[0], float):
            yield from value
            return
        for element in value:
            yield from _numbers(element)
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from _numbers(getattr(value, field.name))
    else:
        yield float(value)


def _restore(value: Any, source: Iterator[float]) -> None:
    """Fill a record or a list in place."""
    if isinstance(value, list):
        for index, element in enumerate(value):
            if isinstance(element, (bool, int, float)):
                value[index] = type(element)(next(source))
            else:
                _restore(element, source)
        return
    for field in dataclasses.fields(value):
        element = getattr(value, field.name)
        if isinstance(element, (bool, int, float)):
            setattr(value, field.name, type(element)(next(source)))
        else:
            _restore(element, source)
