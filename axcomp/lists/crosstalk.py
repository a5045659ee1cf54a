"""Crosstalk compensation (``kw.crosstalk``), the new and the old variant: list to machine and back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

from ..model.delaunay import triangulate
from ..model.machine import AxisType, Crosstalk, CrosstalkCurve, CrosstalkTest
from .axes import AxisSettings
from .compensation import CompensationList
from .format import Lines

_TEST_FIELDS = {
    "position1": "kw.crosstalk.position[i].ax_1",
    "position2": "kw.crosstalk.position[i].ax_2",
    "accelerate_positive": "kw.crosstalk.position[i].correction_accelerate_dir_pos",
    "accelerate_negative": "kw.crosstalk.position[i].correction_accelerate_dir_neg",
    "decelerate_positive": "kw.crosstalk.position[i].correction_decelerate_dir_pos",
    "decelerate_negative": "kw.crosstalk.position[i].correction_decelerate_dir_neg",
}
_OLD = ("kw.crosstalk.table[i].acceleration", "kw.crosstalk.table[i].correction")
_NEW_ONLY = (
    *_TEST_FIELDS.values(),
    "kw.crosstalk.acceleration",
    "kw.crosstalk.deceleration",
    "kw.crosstalk.mode",
    "kw.crosstalk.max_points",
    "kw.crosstalk.velocity_dependent",
    "kw.crosstalk.master_pos1_ax_nr",
    "kw.crosstalk.master_pos2_ax_nr",
)
TABLES = (*_TEST_FIELDS.values(), *_OLD)
SIZES = ("kw.crosstalk.max_points", "kw.crosstalk.last_index")

_MASTER = "kw.crosstalk.master_dyn_ax_nr"


def read_crosstalk(source: CompensationList) -> Crosstalk | CrosstalkCurve | None:
    """Return the compensation, None where it cannot be used. The names of the entries decide the variant."""
    values = source.values
    new = any(values.cells(name) for name in _NEW_ONLY)
    old = next((name for name in (*_OLD, "kw.crosstalk.last_index") if values.cells(name)), None)
    if source.axis.type is not AxisType.TRANSLATORY:
        message = f"Axis {source.axis.number} is not translatory, as crosstalk needs; the compensation stays off."
        source.note("AXC-AXIS-TYPE", _MASTER, message)
        return None
    if new and old:
        message = "There are entries of both variants of the crosstalk compensation; those of the old one are not used."
        source.note("AXC-VARIANT", old, message, *min(values.cells(old)))
    return _read_tests(source) if new else _read_curve(source)


def _translatory(source: CompensationList, name: str, purpose: str) -> AxisSettings | None:
    axis = source.axis_of(name, purpose)
    if axis is not None and axis.type is not AxisType.TRANSLATORY:
        message = f"Axis {axis.number}, the {purpose}, is not translatory; the compensation stays off."
        source.note("AXC-MASTER", name, message)
        return None
    return axis


def _read_tests(source: CompensationList) -> Crosstalk | None:
    values = source.values
    mode = values.integer("kw.crosstalk.mode")
    acceleration, deceleration = (values.converted(f"kw.crosstalk.{sign}celeration") for sign in ("ac", "de"))
    for kind, sign, usable in (("ac", "above", acceleration > 0.0), ("de", "below", deceleration < 0.0)):
        if not usable:
            name = f"kw.crosstalk.{kind}celeration"
            source.note("AXC-ACCELERATION", name, f"{name} is needed and must be {sign} 0; the compensation stays off.")
            return None
    tests = _tests(source, mode)
    if tests is None:
        return None
    master = _translatory(source, _MASTER, "accelerating axis")
    if master is None:
        return None
    source.note_own_master(_MASTER)
    adaptation: list[int | None] = [None, None]
    for i in range(mode - 1):
        axis = _translatory(source, f"kw.crosstalk.master_pos{i + 1}_ax_nr", f"adaptation axis {i + 1}")
        if axis is None:
            return None
        adaptation[i] = axis.number
    return Crosstalk(
        master=master.number,
        acceleration=acceleration,
        deceleration=deceleration,
        mode=mode,
        tests=tuple(tests),
        adaptation1=adaptation[0],
        adaptation2=adaptation[1],
        velocity_dependent=values.flag("kw.crosstalk.velocity_dependent"),
        n_cycles=values.integer("kw.crosstalk.n_cycles"),
        manual_activation=values.flag("kw.crosstalk.manual_activation"),
    )


def _tests(source: CompensationList, mode: int) -> list[CrosstalkTest] | None:
    """Return the tests that a mode uses, each at its own place; None if they are too few."""
    values = source.values
    last = max((index for name in _TEST_FIELDS.values() for (index,) in values.cells(name)), default=-1)
    count = 1 if mode == 1 else values.integer("kw.crosstalk.max_points") or last + 1
    if last < 0:
        source.note("AXC-TESTS", "kw.crosstalk.mode", "There are no crosstalk tests; the compensation stays off.")
        return None
    used = [name for name in _TEST_FIELDS if _is_used(name, mode, values.flag("kw.crosstalk.velocity_dependent"))]
    columns = {name: source.column(_TEST_FIELDS[name], count) for name in used}
    rows = [CrosstalkTest(**dict(zip(used, row, strict=True))) for row in zip(*columns.values(), strict=True)]
    tests = _at_different_places(source, rows, _TEST_FIELDS[used[0]])
    if mode == 2 and len(tests) == 2:
        message = "Mode 2 should have three tests at least; the two that are given are used."
        source.note("AXC-TESTS-FEW", "kw.crosstalk.mode", message)
    if len(tests) < mode or (mode == 3 and _in_line(tests)):
        need = "two tests" if mode == 2 else "three tests that are not in a line"
        message = f"Mode {mode} needs {need} at different places; the compensation stays off."
        source.note("AXC-TESTS", "kw.crosstalk.mode", message)
        return None
    return tests


def _is_used(field: str, mode: int, velocity_dependent: bool) -> bool:
    if field.startswith("position"):
        return mode > int(field[-1])
    return velocity_dependent or field.endswith("positive")


def _at_different_places(source: CompensationList, rows: list[CrosstalkTest], name: str) -> list[CrosstalkTest]:
    """Keep the last test of each place."""
    kept: dict[tuple[float, float], CrosstalkTest] = {}
    for index, test in enumerate(rows):
        if kept.pop((test.position1, test.position2), None) is not None:
            message = "Two tests stand at the same place; the later one counts."
            source.note("AXC-TESTS-TWICE", name, message, index)
        kept[(test.position1, test.position2)] = test
    return list(kept.values())


def _in_line(tests: Sequence[CrosstalkTest]) -> bool:
    """Whether the places span no triangle to interpolate over."""
    return not triangulate([test.position1 for test in tests], [test.position2 for test in tests]).triangles


def _read_curve(source: CompensationList) -> CrosstalkCurve | None:
    values = source.values
    count = values.integer("kw.crosstalk.last_index") + 1
    accelerations = source.column(_OLD[0], count)
    corrections = source.column(_OLD[1], count)
    if not source.ascending(accelerations, _OLD[0], "AXC-ORDER", "kw.crosstalk.last_index"):
        return None
    at_rest = _interpolate(accelerations, corrections, 0.0)
    if at_rest != 0.0:
        message = f"At acceleration 0 the table gives {at_rest:g} mm, which acts all the time; it is used."
        source.note("AXC-AT-REST", _OLD[1], message, 0)
    master = _translatory(source, _MASTER, "accelerating axis")
    if master is None:
        return None
    source.note_own_master(_MASTER)
    return CrosstalkCurve(
        master=master.number,
        accelerations=tuple(accelerations),
        corrections=tuple(corrections),
        n_cycles=values.integer("kw.crosstalk.n_cycles"),
        manual_activation=values.flag("kw.crosstalk.manual_activation"),
    )


def _interpolate(x: Sequence[float], y: Sequence[float], at: float) -> float:
    if at <= x[0]:
        return y[0]
    for i in range(1, len(x)):
        if at <= x[i]:
            return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def format_crosstalk(crosstalk: Crosstalk | CrosstalkCurve, lines: Lines) -> None:
    """Append the entries of a crosstalk compensation."""
    old = isinstance(crosstalk, CrosstalkCurve)
    lines.add("kw.crosstalk.master_ax_nr" if old else _MASTER, crosstalk.master)
    lines.add_unless_default("kw.crosstalk.n_cycles", crosstalk.n_cycles)
    lines.add_unless_default("kw.crosstalk.manual_activation", crosstalk.manual_activation)
    if isinstance(crosstalk, CrosstalkCurve):
        lines.add("kw.crosstalk.last_index", len(crosstalk.accelerations) - 1)
        for i, row in enumerate(zip(crosstalk.accelerations, crosstalk.corrections, strict=True)):
            for name, value in zip(_OLD, row, strict=True):
                lines.add_converted(name, value, i)
        return
    lines.add("kw.crosstalk.mode", crosstalk.mode)
    lines.add("kw.crosstalk.max_points", len(crosstalk.tests))
    lines.add_converted("kw.crosstalk.acceleration", crosstalk.acceleration)
    lines.add_converted("kw.crosstalk.deceleration", crosstalk.deceleration)
    lines.add("kw.crosstalk.velocity_dependent", crosstalk.velocity_dependent)
    for i, number in enumerate((crosstalk.adaptation1, crosstalk.adaptation2), 1):
        if number is not None:
            lines.add(f"kw.crosstalk.master_pos{i}_ax_nr", number)
    for i, test in enumerate(crosstalk.tests):
        for field in fields(test):
            if _is_used(field.name, crosstalk.mode, crosstalk.velocity_dependent):
                lines.add_converted(_TEST_FIELDS[field.name], getattr(test, field.name), i)
