"""Records as bytes: a snapshot of the engine, with a check before it is trusted."""

from __future__ import annotations

import dataclasses
import struct
import zlib
from array import array
from collections.abc import Iterator
from typing import Annotated, Any, get_args, get_origin

from ..kernel import Vec, fields_of

MAGIC = b"axcompS2"
NUMBERS = (float, int, bool)
HEADER = struct.Struct("<8sIII")  # magic, identity, numbers, CRC-32 of the numbers


class SnapshotError(ValueError):
    """Bytes that are no snapshot of these records; the message says why."""


def identity_of(*records: Any) -> int:
    """Return a CRC-32 of the numbers of the records, without any ``Vec`` in them: equal for equal machines."""
    return zlib.crc32(array("d", [number for record in records for number in _numbers(record)]).tobytes())


def pack(identity: int, *records: Any) -> bytes:
    """Return the numbers of the records as bytes, without any ``Vec`` in them.

    ``identity`` tells apart what the numbers belong to: a state may point behind the end of another machine's tables.
    """
    numbers = array("d", [number for record in records for number in _numbers(record)])
    body = numbers.tobytes()
    return HEADER.pack(MAGIC, identity, len(numbers), zlib.crc32(body)) + body


def unpack(data: bytes, identity: int, *records: Any) -> None:
    """Put the numbers of a snapshot back into records of the same shape.

    Raises
    ------
    SnapshotError
        If the bytes are truncated or altered, or belong to something else; the records are as before then, unless a
        number is not finite that must be whole.
    """
    if len(data) < HEADER.size:
        raise SnapshotError("the snapshot is truncated")
    magic, owner, count, check = HEADER.unpack_from(data)
    body = data[HEADER.size :]
    if magic != MAGIC:
        raise SnapshotError("this is no snapshot of axcomp, or one of another version")
    if len(body) != 8 * count or zlib.crc32(body) != check:
        raise SnapshotError("the snapshot is truncated or altered")
    if owner != identity or count != sum(1 for record in records for _ in _numbers(record)):
        raise SnapshotError("the snapshot belongs to another machine")
    numbers = array("d")
    numbers.frombytes(body)
    source = iter(numbers)
    try:
        for record in records:
            _restore(record, source)
    except (ValueError, OverflowError):
        raise SnapshotError("the snapshot has a number where only whole ones are") from None


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, list):
        if value and isinstance(value[0], float):
            yield from value
            return
        for element in value:
            yield from _numbers(element)
    elif dataclasses.is_dataclass(value):
        for name, hint in fields_of(type(value)).items():
            if hint != Vec:
                yield from _numbers(getattr(value, name))
    else:
        yield float(value)


def _restore(value: Any, source: Iterator[float]) -> None:
    """Fill a record or a list of floats in place, whatever numbers a caller has put there meanwhile."""
    if isinstance(value, list):
        _restore_list(value, float, source)
        return
    for name, hint in fields_of(type(value)).items():
        if get_origin(hint) is Annotated:
            _restore_list(getattr(value, name), get_args(get_args(hint)[0])[0], source)
        elif hint in NUMBERS:
            setattr(value, name, hint(next(source)))
        else:
            _restore(getattr(value, name), source)


def _restore_list(values: list[Any], kind: Any, source: Iterator[float]) -> None:
    if kind in NUMBERS:
        values[:] = [kind(next(source)) for _ in values]
        return
    for value in values:
        _restore(value, source)
