"""Hypothesis strategies for machines: whatever the lists can hold, and nothing else.

``machines()`` draws valid machines with all kinds of compensation; every one compiles, and reads back from its
lists. ``axes``, ``leadscrews`` and the others draw the parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from hypothesis import strategies as st

from axcomp.kinds import (
    Backlash,
    Cross,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
    Friction,
    Leadscrew,
    Plane,
    Temperature,
)
from axcomp.model import Axis, AxisType, Machine, ModuloRange

POSITION_MAX = 200_000.0
"""mm or °; the lists hold SGN32 in 0.1 µm."""

TESTS_MAX = 15


def numbers(low: float, high: float, per_unit: int = 10_000) -> st.SearchStrategy[float]:
    """Floats in [low, high]: half of them such as stand in a list as integers (``per_unit`` in 1)."""
    whole = st.integers(round(low * per_unit), round(high * per_unit)).map(lambda i: i / per_unit)
    return whole | st.floats(low, high)


def positions() -> st.SearchStrategy[float]:
    """Positions in mm or °."""
    return numbers(-POSITION_MAX, POSITION_MAX)


def corrections() -> st.SearchStrategy[float]:
    """Corrections in mm or °."""
    return numbers(-1.0, 1.0)


@st.composite
def ascending(
    draw: st.DrawFn, low: float, high: float, *, largest: int = 12, per_unit: int = 10_000
) -> tuple[float, ...]:
    """Strictly ascending floats, at least one; sometimes at equal distances."""
    if draw(st.booleans()):
        return tuple(sorted(draw(st.sets(numbers(low, high, per_unit), min_size=1, max_size=largest))))
    count = draw(st.integers(2, largest))
    first = draw(st.integers(round(low * per_unit), round(high * per_unit) - count))
    step = draw(st.integers(1, max(1, (round(high * per_unit) - first) // count)))
    return tuple((first + i * step) / per_unit for i in range(count))


def values(count: int) -> st.SearchStrategy[tuple[float, ...]]:
    """``count`` corrections."""
    return st.tuples(*[corrections()] * count)


@st.composite
def leadscrews(draw: st.DrawFn, modulo: ModuloRange | None = None) -> Leadscrew:
    """Leadscrew compensations; on a modulo axis some of them repeat."""
    repeats = modulo is not None and draw(st.booleans())
    span = (modulo.start, modulo.end) if repeats and modulo is not None else (-POSITION_MAX, POSITION_MAX)
    points = draw(ascending(*span))
    count = len(points)
    return Leadscrew(
        points,
        draw(values(count)),
        draw(st.none() | values(count)),
        modulo=repeats,
        without_other_compensations=draw(st.booleans()),
        manual_activation=draw(st.booleans()),
        max_points=draw(st.just(1500) | st.integers(count, 5000)),
    )


@st.composite
def crosses(draw: st.DrawFn, masters: Sequence[int]) -> Cross:
    """Cross compensations."""
    points = draw(ascending(-POSITION_MAX, POSITION_MAX))
    return Cross(
        draw(st.sampled_from(masters)),
        points,
        draw(values(len(points))),
        n_cycles=draw(st.integers(0, 20)),
        manual_activation=draw(st.booleans()),
        max_points=draw(st.just(1001) | st.integers(len(points), 5000)),
    )


@st.composite
def planes(draw: st.DrawFn, masters: Sequence[int]) -> Plane:
    """Plane compensations."""
    rows, columns = draw(st.integers(1, 5)), draw(st.integers(1, 5))
    intervals = numbers(0.0001, 1000.0)
    interval1 = draw(intervals)
    return Plane(
        draw(st.sampled_from(masters)),
        draw(st.sampled_from(masters)),
        draw(positions()),
        draw(positions()),
        interval1,
        draw(st.just(interval1) | intervals),
        tuple(draw(values(columns)) for _ in range(rows)),
        n_cycles=draw(st.integers(0, 20)),
        manual_activation=draw(st.booleans()),
        max_points=draw(st.none() | st.integers(rows * columns, 20_000)),
    )


@st.composite
def frictions(draw: st.DrawFn) -> Friction:
    """Friction compensations."""
    velocities = draw(ascending(0.0, 100_000.0, per_unit=1000))
    currents = numbers(-10_000.0, 10_000.0, per_unit=1)
    return Friction(
        velocities,
        draw(st.tuples(*[currents] * len(velocities))),
        scaling=draw(numbers(-32.7, 32.7, per_unit=1000)),
        position_delay=draw(numbers(0.0, 10.0)),
        reversal_lookahead=draw(st.integers(0, 4)),
        delay_cycles=draw(st.integers(0, 248)),
        max_points=draw(st.just(20) | st.integers(len(velocities), 100)),
    )


def _in_line(tests: Sequence[CrosstalkTest]) -> bool:
    """Whether all tests lie within 1 µm of a line, so that there is nothing to interpolate over."""
    places = [complex(test.position1, test.position2) for test in tests]
    strips = [
        max(abs(((place - a) / (b - a)).imag) * abs(b - a) for place in places) for a, b in combinations(places, 2)
    ]
    return min(strips) < 2e-3


@st.composite
def crosstalks(draw: st.DrawFn, masters: Sequence[int]) -> Crosstalk:
    """Crosstalk compensations of the new variant; what their mode does not use is 0."""
    mode = draw(st.integers(1, 3))
    dependent = draw(st.booleans())
    places = st.integers(-2_000_000, 2_000_000).map(lambda i: i / 10_000)
    place = st.tuples(places if mode > 1 else st.just(0.0), places if mode > 2 else st.just(0.0))
    if mode == 3 and draw(st.booleans()):
        x1, x2 = (sorted(draw(st.sets(places, min_size=2, max_size=3))) for _ in range(2))
        at = [(a, b) for a in x1 for b in x2]
    else:
        at = draw(st.lists(place, unique=True, min_size=mode, max_size=TESTS_MAX if mode > 1 else 1))
    negative = corrections() if dependent else st.just(0.0)
    tests = tuple(
        CrosstalkTest(*where, draw(corrections()), draw(negative), draw(corrections()), draw(negative)) for where in at
    )
    if mode == 3 and _in_line(tests):
        mode, tests = 1, (CrosstalkTest(0.0, 0.0, *draw(values(1)), 0.0, *draw(values(1)), 0.0),)
    return Crosstalk(
        draw(st.sampled_from(masters)),
        draw(numbers(1.0, 10_000.0, per_unit=1)),
        -draw(numbers(1.0, 10_000.0, per_unit=1)),
        mode,
        tests,
        draw(st.sampled_from(masters)) if mode > 1 else None,
        draw(st.sampled_from(masters)) if mode > 2 else None,
        velocity_dependent=dependent,
        n_cycles=draw(st.integers(0, 20)),
        manual_activation=draw(st.booleans()),
    )


@st.composite
def crosstalk_curves(draw: st.DrawFn, masters: Sequence[int]) -> CrosstalkCurve:
    """Crosstalk compensations of the old variant."""
    accelerations = draw(ascending(-10_000.0, 10_000.0, largest=5, per_unit=1))
    return CrosstalkCurve(
        draw(st.sampled_from(masters)),
        accelerations,
        draw(values(len(accelerations))),
        n_cycles=draw(st.integers(0, 20)),
        manual_activation=draw(st.booleans()),
    )


@st.composite
def temperatures(draw: st.DrawFn) -> Temperature:
    """Temperature compensations."""
    return Temperature(
        draw(positions()),
        draw(corrections()),
        draw(numbers(-1e-3, 1e-3, per_unit=1_000_000)),
        n_cycles=draw(st.integers(1, 19)),
    )


@st.composite
def backlashes(draw: st.DrawFn) -> Backlash:
    """Backlash compensations."""
    return Backlash(draw(numbers(-3.2, 3.2)), draw(st.sampled_from((1, 2))))


NAMES = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"], exclude_characters='"“”″'), min_size=1).map(
    lambda name: name[:16]
)
"""Names of axes, also in foreign scripts and with # and (."""


@st.composite
def axes(draw: st.DrawFn, number: int, name: str, kinds: dict[int, AxisType]) -> Axis:
    """An axis of a machine whose axes have the given types, with any of the compensations."""
    axis_type = kinds[number]
    modulo = None
    if axis_type is not AxisType.TRANSLATORY and draw(st.booleans()):
        start = draw(st.sampled_from((0.0, -180.0)) | numbers(-1000.0, 1000.0))
        modulo = ModuloRange(start, start + 360.0)
    turning = [other for other, kind in kinds.items() if kind is not AxisType.SPINDLE]
    straight = [other for other, kind in kinds.items() if kind is AxisType.TRANSLATORY]
    crosstalk = None
    if axis_type is AxisType.TRANSLATORY:
        crosstalk = draw(st.none() | crosstalks(straight) | crosstalk_curves(straight))
    return Axis(
        number,
        name,
        axis_type,
        modulo,
        draw(st.integers(0, 20)),
        volumetric_limit=draw(st.none() | numbers(0.0001, 10.0)),
        gantry_master=draw(st.none() | st.sampled_from(list(kinds))),
        cross=draw(st.none() | crosses(list(kinds))),
        plane=draw(st.none() | planes(turning)) if turning else None,
        crosstalk=crosstalk,
        temperature=None if axis_type is AxisType.SPINDLE else draw(st.none() | temperatures()),
        leadscrew=draw(st.none() | leadscrews(modulo)),
        backlash=draw(st.none() | backlashes()),
        friction=draw(st.none() | frictions()),
    )


@st.composite
def machines(draw: st.DrawFn, largest: int = 3) -> Machine:
    """Machines of 1 to ``largest`` axes."""
    numbers_of_axes = draw(st.lists(st.integers(1, 65_534), unique=True, min_size=1, max_size=largest))
    count = len(numbers_of_axes)
    names = draw(st.lists(NAMES, unique=True, min_size=count, max_size=count))
    types = draw(st.lists(st.sampled_from(AxisType), min_size=count, max_size=count))
    kinds = dict(zip(numbers_of_axes, types, strict=True))
    return Machine(tuple(draw(axes(n, name, kinds)) for n, name in zip(numbers_of_axes, names, strict=True)))
