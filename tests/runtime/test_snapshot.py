"""Records as bytes and back: every number, and nothing that was damaged."""

import math
import struct
from dataclasses import dataclass
from typing import Annotated

import pytest
from hypothesis import given, settings, strategies as st

from axcomp.kernel import Inputs, Outputs, State, zero
from axcomp.runtime import SnapshotError, identity_of, pack, unpack


@dataclass(slots=True)
class Inner:
    flag: bool
    count: int


@dataclass(slots=True)
class Outer:
    x: float
    inner: Inner
    line: Annotated[list[float], 3]
    inners: Annotated[list[Inner], 2]


def outer(x: float = 0.5) -> Outer:
    return Outer(x, Inner(True, -7), [x, -0.0, 1e300], [Inner(False, 3), Inner(True, 2**31 - 1)])


@settings(max_examples=50)
@given(st.floats(), st.booleans(), st.integers(-(2**31), 2**31 - 1))
def test_every_number_comes_back(x: float, flag: bool, count: int) -> None:
    record, clock = outer(x), [x, 3.0]
    record.inner, record.inners[1] = Inner(flag, count), Inner(not flag, -1)
    data = pack(5, record, clock)
    other, other_clock = zero(Outer), [0.0, 0.0]
    unpack(data, 5, other, other_clock)
    assert repr((other, other_clock)) == repr((record, clock))  # NaN and −0 included
    assert pack(5, other, other_clock) == data


def test_the_records_stay_the_same_objects() -> None:
    record = outer()
    line, inner = record.line, record.inners[1]
    data = pack(0, record)
    line[0], inner.count = 99.0, 99
    unpack(data, 0, record)
    assert (record.line is line, record.inners[1] is inner, line[0], inner.count) == (True, True, 0.5, 2**31 - 1)


def test_declared_types_come_back_whatever_numbers_stand_there() -> None:
    data = pack(0, outer(0.75))
    record = outer()
    record.x, record.inner.flag, record.inners[0].count, record.line[0] = 0, 1, 2.5, False  # type: ignore[assignment]
    unpack(data, 0, record)
    assert repr(record) == repr(outer(0.75))


def test_truncated_bytes_are_refused_and_nothing_changes() -> None:
    data = pack(0, outer(2.0))
    for length in range(len(data)):
        record = outer(1.0)
        with pytest.raises(SnapshotError, match="truncated"):
            unpack(data[:length], 0, record)
        assert record == outer(1.0)


def test_every_altered_byte_is_noticed() -> None:
    data = pack(0, outer(2.0))
    for place in range(len(data)):
        altered = bytearray(data)
        altered[place] ^= 0x10
        record = outer(1.0)
        with pytest.raises(SnapshotError):
            unpack(bytes(altered), 0, record)
        assert record == outer(1.0)


def test_something_longer_is_refused() -> None:
    with pytest.raises(SnapshotError, match="truncated or altered"):
        unpack(pack(0, outer()) + b"\0", 0, outer())


def test_another_shape_and_another_owner_are_refused() -> None:
    with pytest.raises(SnapshotError, match="another machine"):
        unpack(pack(0, outer(), [0.0]), 0, outer())
    with pytest.raises(SnapshotError, match="another machine"):
        unpack(pack(1, outer()), 2, outer())
    with pytest.raises(SnapshotError, match="no snapshot"):
        unpack(struct.pack("<8sIII", b"elsewise", 0, 0, 0), 0)


def test_the_identity_is_of_all_numbers() -> None:
    one, other = outer(), outer()
    assert identity_of(one) == identity_of(other)
    other.inners[1].count -= 1
    assert identity_of(one) != identity_of(other)
    assert identity_of(one, [math.pi]) != identity_of(one, [math.e])


def test_the_kernels_records_survive() -> None:
    records = zero(State), zero(Inputs), zero(Outputs)
    records[0].axis[31].compensation.friction.line[248] = math.inf
    records[1].axis[3].unreferenced = True
    records[2].axis[0].error = 110641
    data = pack(9, *records)
    fresh = zero(State), zero(Inputs), zero(Outputs)
    unpack(data, 9, *fresh)
    assert fresh == records
