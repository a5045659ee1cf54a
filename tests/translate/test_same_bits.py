"""Python and the C made of it compute the same bits."""

from __future__ import annotations

import ctypes
import math
import random
import struct
from typing import Any

import pytest
from random_programs import Maker
from translating import PREAMBLE, Builder, Built

from axcomp.kernel import fields_of, zero
from axcomp.native import ctypes_of, from_c, to_c

SPECIAL = [0.0, -0.0, 1.0, -1.0, 0.5, math.inf, -math.inf, math.nan, 5e-324, -5e-324, 1.7976931348623157e308, 3.0]


def bits(value: Any) -> Any:
    """Return what can be compared exactly: floats by their bytes (all NaNs alike), records and lists by theirs."""
    if isinstance(value, float):
        return "nan" if math.isnan(value) else struct.pack("d", value)
    if isinstance(value, list):
        return [bits(element) for element in value]
    if isinstance(value, int):
        return value
    return [bits(getattr(value, name)) for name in fields_of(type(value))]


def fill(record: Any, source: random.Random) -> None:
    """Put random numbers into a record."""
    for name in fields_of(type(record)):
        setattr(record, name, filled(getattr(record, name), source))


def filled(value: Any, source: random.Random) -> Any:
    """Return a random value of the same type."""
    match value:
        case bool():
            return source.random() < 0.5
        case int():
            return source.randint(-40, 40)
        case float():
            return source.choice([source.uniform(-20, 20), 0.0, -0.0, float(source.randint(-3, 3))])
        case list():
            return [filled(element, source) for element in value]
    fill(value, source)
    return value


def check_program(build: Builder, seed: int, calls: int, *options: str) -> None:
    """Run every exported function of a random program many times, in both languages, and compare all it changes."""
    text, exports = Maker(seed).program()
    built = build(text, exports, *options)
    source = random.Random(seed)
    for name in exports:
        function = getattr(built.native, f"axcomp_{name}")
        function.restype = ctypes.c_double
        for _ in range(calls):
            whole, tables = zero(built.python.Whole), zero(built.python.Tables)
            fill(whole, source)
            table = [source.uniform(-5, 5) for _ in range(6)]
            tables.scale = source.uniform(-2, 2)
            c_whole, c_tables = ctypes_of(built.python.Whole)(), ctypes_of(built.python.Tables)()
            to_c(whole, c_whole)
            to_c(tables, c_tables)
            x, i, b = source.uniform(-5, 5), source.randint(-30, 30), source.random() < 0.5
            expected = getattr(built.python, name)(whole, tables, table, x, i, b)
            found = function(
                ctypes.byref(c_whole),
                ctypes.byref(c_tables),
                (ctypes.c_double * len(table))(*table),
                ctypes.c_double(x),
                ctypes.c_int32(i),
                ctypes.c_bool(b),
            )
            after = zero(built.python.Whole)
            from_c(c_whole, after)
            assert bits(found) == bits(expected), (seed, name, x, i, b)
            assert bits(after) == bits(whole), (seed, name, x, i, b)


@pytest.mark.parametrize("seed", range(3))
def test_random_programs_compute_the_same_bits(build: Builder, seed: int) -> None:
    check_program(build, seed, 25)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 130))
def test_many_random_programs_compute_the_same_bits(build: Builder, seed: int) -> None:
    options = random.Random(seed).choice([["-O0"], ["-O2"], ["-O3", "-march=native"], ["-std=gnu11", "-O3", "-mfma"]])
    check_program(build, seed, 40, *options)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(200, 204))
def test_random_programs_are_clean_under_the_sanitizer(build: Builder, seed: int) -> None:
    check_program(build, seed, 25, "-O1", "-fsanitize=undefined", "-fno-sanitize-recover=all", "-static-libubsan")


def call(built: Built, name: str, result: Any, *arguments: Any) -> tuple[Any, Any]:
    """Return what a function of numbers gives in Python and in C."""
    function = getattr(built.native, f"axcomp_{name}")
    function.restype = result
    function.argtypes = [{float: ctypes.c_double, int: ctypes.c_int32, bool: ctypes.c_bool}[type(a)] for a in arguments]
    return getattr(built.python, name)(*arguments), function(*arguments)


FLOAT_FUNCTIONS = (
    PREAMBLE
    + """\
def lesser(x: float, y: float) -> float:
    return min(x, y)


def greater(x: float, y: float) -> float:
    return max(x, y)


def limited(x: float, y: float) -> float:
    return min(max(x, -y), y)


def chosen(x: float, y: float) -> float:
    return x if x < y or x == y else -y


def magnitude(x: float, y: float) -> float:
    return abs(x) - abs(-y)


def in_order(x: float, y: float) -> float:
    return x - y - (y - x) - x * y * 0.1 - x * (y * 0.1)
"""
)


def test_minimum_maximum_and_choice_agree_on_nan_and_negative_zero(build: Builder) -> None:
    names = ["lesser", "greater", "limited", "chosen", "magnitude", "in_order"]
    built = build(FLOAT_FUNCTIONS, names)
    for name in names:
        for x in SPECIAL:
            for y in SPECIAL:
                expected, found = call(built, name, ctypes.c_double, x, y)
                assert bits(found) == bits(expected), (name, x, y)


INT_FUNCTIONS = (
    PREAMBLE
    + """\
def quotient(a: int, b: int) -> int:
    return a // b


def remainder_of(a: int, b: int) -> int:
    return a % b


def both(a: int, b: int) -> int:
    a //= b
    a %= 7
    return a


def ratio(a: int, b: int) -> float:
    return a / b


def floored(a: int, b: int) -> float:
    return whole(a / b) + whole(-0.0)


def truncated(a: int, b: int) -> int:
    return int(a / b) + int(-(a / b) * 0.5)


def of_bits(a: int, b: int) -> int:
    return ((a & b | 8) >> 2) + (a >> 2) - (b >> 3 & 5)
"""
)


def test_whole_number_operators_agree_on_negative_operands(build: Builder) -> None:
    names = ["quotient", "remainder_of", "both", "truncated", "of_bits"]
    built = build(INT_FUNCTIONS, [*names, "ratio", "floored"])
    for a in [*range(-9, 10), 2147483647, -2147483647]:
        for b in [-2147483647, -7, -3, -2, -1, 1, 2, 3, 7, 2147483647]:
            for name in names:
                expected, found = call(built, name, ctypes.c_int32, a, b)
                assert found == expected, (name, a, b)
            for name in ("ratio", "floored"):
                expected, found = call(built, name, ctypes.c_double, a, b)
                assert bits(found) == bits(expected), (name, a, b)


LOOPS = (
    PREAMBLE
    + """\
@dataclass(slots=True)
class Counter:
    end: int
    seen: int


def shrinking(n: int) -> int:
    rounds = 0
    for i in range(n):
        n -= 2
        rounds += 10 * i + 1
    return rounds + n


def grow(counter: Counter) -> None:
    counter.end += 3


def growing(counter: Counter) -> None:
    for i in range(counter.end):
        grow(counter)
        counter.seen += i
    for i in range(1, counter.end - 1):
        counter.seen += 2 * i


def searched(n: int) -> int:
    found = -1
    i = 0
    while True:
        i += 1
        if i * i % 7 == n:
            found = i
            break
        if i > 20:
            break
    return found


def fresh_array(n: int) -> float:
    total = 0.0
    for i in range(n):
        sums = zeros(4)
        sums[i % 4] += 1.0
        total += sums[0] + sums[1] * 2.0 + sums[2] * 4.0
    return total
"""
)


def test_a_loop_keeps_the_end_it_began_with(build: Builder) -> None:
    built = build(LOOPS, ["shrinking", "growing", "searched", "fresh_array"])
    for n in range(-2, 12):
        expected, found = call(built, "shrinking", ctypes.c_int32, n)
        assert found == expected
        expected, found = call(built, "searched", ctypes.c_int32, n)
        assert found == expected
        expected, found = call(built, "fresh_array", ctypes.c_double, n)
        assert found == expected
        counter = built.python.Counter(n, 0)
        native = ctypes_of(built.python.Counter)()
        to_c(counter, native)
        built.python.growing(counter)
        built.native.axcomp_growing(ctypes.byref(native))
        assert (native.end, native.seen) == (counter.end, counter.seen)
