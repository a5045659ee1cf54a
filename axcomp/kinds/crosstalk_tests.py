"""The tests of a crosstalk compensation: read from a list, and compiled into the kernel's table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..kernel import CROSSTALK_CONSTANT, CROSSTALK_GRID, CROSSTALK_LINE, CROSSTALK_TRIANGLES, LARGEST, CrosstalkTable
from ..model import AxisType, triangulate, width
from .compiling import AxisCompiler
from .crosstalk_data import (
    ADAPTATION,
    CURVE,
    CYCLES,
    DIRECTIONS,
    LAST_INDEX,
    LIMITS,
    MANUAL,
    MASTER,
    MAX_POINTS,
    MODE,
    TEST_FIELDS,
    TESTS_MAX,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
)
from .kind import TableReader

THINNEST = 1e-3
"""Narrowest strip, or shortest way, that tests may lie on, mm (semantics §8)."""


def adaptation_axes(crosstalk: Crosstalk | CrosstalkCurve) -> tuple[int | None, ...]:
    """Return the adaptation axes that the mode of the new variant uses, None where one lacks; none of the old one."""
    if isinstance(crosstalk, CrosstalkCurve):
        return ()
    return (crosstalk.adaptation1, crosstalk.adaptation2)[: crosstalk.mode - 1]


def _translatory(source: TableReader, name: str, purpose: str) -> Any:
    axis = source.axis_of(name, purpose)
    if axis is not None and axis.type is not AxisType.TRANSLATORY:
        message = f"Axis {axis.number}, the {purpose}, is not translatory; the compensation stays off."
        source.note("AXC-MASTER", name, message)
        return None
    return axis


def read_tests(source: TableReader) -> Crosstalk | None:
    """Return a compensation of the new variant, None where it cannot be used."""
    values = source.values
    mode = values.integer(MODE)
    acceleration, deceleration = (values.converted(name) for name in LIMITS)
    for name, sign, usable in zip(LIMITS, ("above", "below"), (acceleration > 0.0, deceleration < 0.0), strict=True):
        if not usable:
            source.note("AXC-ACCELERATION", name, f"{name} is needed and must be {sign} 0; the compensation stays off.")
            return None
    tests = _tests(source, mode)
    if tests is None:
        return None
    master = _translatory(source, MASTER, "accelerating axis")
    if master is None:
        return None
    source.note_own_master(MASTER)
    adaptation: list[int | None] = [None, None]
    for i in range(mode - 1):
        axis = _translatory(source, ADAPTATION[i], f"adaptation axis {i + 1}")
        if axis is None:
            return None
        adaptation[i] = axis.number
    if mode == 3 and adaptation[0] == adaptation[1]:
        message = f"Axis {adaptation[0]} is both adaptation axes: its tests can only lie in a line."
        source.note("AXC-ADAPTATION", ADAPTATION[1], message)
    return Crosstalk(
        master=master.number,
        acceleration=acceleration,
        deceleration=deceleration,
        mode=mode,
        tests=tuple(tests),
        adaptation1=adaptation[0],
        adaptation2=adaptation[1],
        velocity_dependent=values.flag(DIRECTIONS),
        n_cycles=values.integer(CYCLES),
        manual_activation=values.flag(MANUAL),
    )


def _tests(source: TableReader, mode: int) -> list[CrosstalkTest] | None:
    """Return the tests that a mode uses, each at its own position; None if they are too few."""
    values = source.values
    given = {index for name in TEST_FIELDS.values() for (index,) in values.cells(name)}
    count = 1 if mode == 1 else values.integer(MAX_POINTS) or max(given, default=-1) + 1
    missing = [index for index in range(count) if index not in given]
    if not given or missing:
        what = f"Test {missing[0]} of {count} has no entry" if given else "There are no crosstalk tests"
        source.note("AXC-TESTS", MAX_POINTS if given else MODE, f"{what}; the compensation stays off.")
        return None
    both = values.flag(DIRECTIONS)
    unused = [name for name in TEST_FIELDS.values() if name.endswith("_neg") and values.cells(name) and not both]
    if unused:
        message = f"{DIRECTIONS} is 0: the corrections for negative motion are not used, those for positive serve both."
        source.note("AXC-DIRECTION", unused[0], message, *min(values.cells(unused[0])))
    used = [name for name in TEST_FIELDS if is_used(name, mode, both)]
    columns = {name: source.column(TEST_FIELDS[name], count) for name in used}
    rows = [CrosstalkTest(**dict(zip(used, row, strict=True))) for row in zip(*columns.values(), strict=True)]
    tests = _at_different_positions(source, rows, TEST_FIELDS[used[0]])
    if mode == 2 and len(tests) == 2:
        message = "Mode 2 should have three tests at least; the two that are given are used."
        source.note("AXC-TESTS-FEW", MODE, message)
    if len(tests) < mode or _in_line(tests, mode):
        need = "two tests" if mode == 2 else "three tests that are not within 1 µm of a line"
        message = f"Mode {mode} needs {need} at different positions; the compensation stays off."
        source.note("AXC-TESTS", MODE, message)
        return None
    return tests


def is_used(field: str, mode: int, velocity_dependent: bool) -> bool:
    """Tell whether a field of the tests means something in a mode."""
    if field.startswith("position"):
        return mode > int(field[-1])
    return velocity_dependent or field.endswith("positive")


def _at_different_positions(source: TableReader, rows: list[CrosstalkTest], name: str) -> list[CrosstalkTest]:
    """Keep the last test at each position."""
    kept: dict[tuple[float, float], CrosstalkTest] = {}
    for index, test in enumerate(rows):
        if kept.pop((test.position1, test.position2), None) is not None:
            message = "Two tests stand at the same position; the later one counts."
            source.note("AXC-TESTS-TWICE", name, message, index)
        kept[(test.position1, test.position2)] = test
    return list(kept.values())


def _in_line(tests: Sequence[CrosstalkTest], mode: int) -> bool:
    """Whether the positions of mode 3 span nothing to interpolate over (semantics: within 1 µm of a line)."""
    x, y = ([test.position1 for test in tests], [test.position2 for test in tests])
    return mode == 3 and (width(x, y) < THINNEST or not triangulate(x, y).triangles)


def corrections_of(test: CrosstalkTest) -> tuple[float, ...]:
    """Return the four corrections of a test, in the order of the kernel's blocks."""
    return (test.accelerate_positive, test.accelerate_negative, test.decelerate_positive, test.decelerate_negative)


def read_curve(source: TableReader) -> CrosstalkCurve | None:
    """Return a compensation of the old variant, None where it cannot be used."""
    values = source.values
    count = values.integer(LAST_INDEX) + 1
    accelerations = source.column(CURVE[0], count)
    corrections = source.column(CURVE[1], count)
    if not source.ascending(accelerations, CURVE[0], "AXC-ORDER", LAST_INDEX):
        return None
    at_rest = _interpolate(accelerations, corrections, 0.0)
    if at_rest != 0.0:
        message = f"At acceleration 0 the table gives {at_rest:g} mm, which acts all the time; it is used."
        source.note("AXC-AT-REST", CURVE[1], message, 0)
    master = _translatory(source, MASTER, "accelerating axis")
    if master is None:
        return None
    source.note_own_master(MASTER)
    return CrosstalkCurve(
        master=master.number,
        accelerations=tuple(accelerations),
        corrections=tuple(corrections),
        n_cycles=values.integer(CYCLES),
        manual_activation=values.flag(MANUAL),
    )


def _interpolate(x: Sequence[float], y: Sequence[float], at: float) -> float:
    if at <= x[0]:
        return y[0]
    for i in range(1, len(x)):
        if at <= x[i]:
            return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def compile_tests(crosstalk: Crosstalk, compiler: AxisCompiler, table: CrosstalkTable) -> None:
    """Fill the kernel's table with the tests; CompileError if they are none that it can interpolate."""
    require, tests = compiler.require, crosstalk.tests
    require(crosstalk.acceleration > 0.0 > crosstalk.deceleration, "crosstalk: acceleration > 0 > deceleration")
    table.acceleration, table.deceleration = crosstalk.acceleration, crosstalk.deceleration
    table.velocity_dependent = crosstalk.velocity_dependent
    require(0 < len(tests) <= TESTS_MAX, f"crosstalk: there are 1 … {TESTS_MAX} tests")
    positions = [p for test in tests for p in (test.position1, test.position2)]
    require(all(abs(p) < LARGEST for p in positions), "crosstalk: a position is not finite")
    require(1 <= crosstalk.mode <= 3, f"crosstalk: mode {crosstalk.mode} is not 1, 2 or 3")
    for i, argument in enumerate((table.adaptation1, table.adaptation2)[: crosstalk.mode - 1]):
        number = adaptation_axes(crosstalk)[i]
        require(number is not None, "crosstalk: an adaptation axis is missing")
        compiler.argument(argument, number or 0, min(positions[i::2]), max(positions[i::2]))
    if crosstalk.mode == 1:
        table.variant = CROSSTALK_CONSTANT
        _append_tests(tests[:1], compiler, table)
    elif crosstalk.mode == 2:
        table.variant = CROSSTALK_LINE
        tests = tuple(sorted(tests, key=lambda test: test.position1))
        _append_tests(tests, compiler, table)
        require(len(tests) > 1, "crosstalk: mode 2 needs two tests")
        compiler.ascending("crosstalk", [test.position1 for test in tests])
        table.x1 = compiler.append([test.position1 for test in tests])
    else:
        _compile_two_adaptation_axes(tests, compiler, table)


def _compile_two_adaptation_axes(tests: Sequence[CrosstalkTest], compiler: AxisCompiler, table: CrosstalkTable) -> None:
    """Choose the grid where the tests fill a rectangular one, else Delaunay triangles."""
    x1 = sorted({test.position1 for test in tests})
    x2 = sorted({test.position2 for test in tests})
    different = {(test.position2, test.position1) for test in tests}
    compiler.require(len(different) == len(tests), "crosstalk: two tests stand at the same positions")
    if len(tests) == len(x1) * len(x2) and len(x1) > 1 and len(x2) > 1:
        table.variant = CROSSTALK_GRID
        table.points1, table.points2 = len(x1), len(x2)
        table.x1, table.x2 = compiler.append(x1), compiler.append(x2)
        _append_tests(sorted(tests, key=lambda test: (test.position2, test.position1)), compiler, table)
        return
    table.variant = CROSSTALK_TRIANGLES
    x1, x2 = [test.position1 for test in tests], [test.position2 for test in tests]
    triangulation = triangulate(x1, x2, [corrections_of(test) for test in tests])
    compiler.require(len(triangulation.triangles) > 0, "crosstalk: mode 3 needs three tests that are not in a line")
    table.x1, table.x2 = compiler.append(x1), compiler.append(x2)
    table.triangles = len(triangulation.triangles)
    table.triangle = compiler.append([float(i) for triangle in triangulation.triangles for i in triangle])
    table.edges = len(triangulation.edges)
    table.edge = compiler.append([float(i) for edge in triangulation.edges for i in edge])
    _append_tests(tests, compiler, table)


def _append_tests(tests: Sequence[CrosstalkTest], compiler: AxisCompiler, table: CrosstalkTable) -> None:
    table.tests = len(tests)
    blocks = [compiler.append(block) for block in zip(*map(corrections_of, tests), strict=True)]
    table.values = blocks[0]
