"""Crosstalk compensation (``kw.crosstalk``), new and old variant: a slave corrected while its master accelerates."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from typing import Any

from ..kernel.crosstalk import (
    CROSSTALK_CONSTANT,
    CROSSTALK_CURVE,
    CROSSTALK_GRID,
    CROSSTALK_LINE,
    CROSSTALK_TRIANGLES,
    CrosstalkTable,
)
from ..kernel.cycle import LARGEST
from ..model.curve import Curve
from ..model.delaunay import triangulate
from ..model.grid import Scatter
from ..model.machine import Axis, AxisType, Compensation, Machine
from ..model.quantity import Quantity
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, Reference, TableReader
from .parameter import (
    AXIS_NUMBER,
    BELOW_MAX,
    DataType,
    Parameter,
    Severity,
    activation,
    both,
    isg,
    position,
    smooth_switching,
    twincat,
)
from .parameter import Quantity as ListQuantity
from .shown import ACCELERATION, NEGATIVE, POSITIVE, Range, Table, correction_of, position_of, ranges_of
from .units import span

PREFIX = "kw.crosstalk."
_TEST = f"{PREFIX}position[i]."
_TEST_FIELDS = {
    "position1": f"{_TEST}ax_1",
    "position2": f"{_TEST}ax_2",
    "accelerate_positive": f"{_TEST}correction_accelerate_dir_pos",
    "accelerate_negative": f"{_TEST}correction_accelerate_dir_neg",
    "decelerate_positive": f"{_TEST}correction_decelerate_dir_pos",
    "decelerate_negative": f"{_TEST}correction_decelerate_dir_neg",
}
CURVE = (f"{PREFIX}table[i].acceleration", f"{PREFIX}table[i].correction")
_LIMITS = (f"{PREFIX}acceleration", f"{PREFIX}deceleration")
_MODE, _MAX_POINTS, _DIRECTIONS = f"{PREFIX}mode", f"{PREFIX}max_points", f"{PREFIX}velocity_dependent"
_MASTER, _OLD_MASTER = f"{PREFIX}master_dyn_ax_nr", f"{PREFIX}master_ax_nr"
_ADAPTATION = tuple(f"{PREFIX}master_pos{i}_ax_nr" for i in (1, 2))
_LAST_INDEX, _CYCLES, _MANUAL = f"{PREFIX}last_index", f"{PREFIX}n_cycles", f"{PREFIX}manual_activation"
_NEW_ONLY = (*_TEST_FIELDS.values(), *_LIMITS, _MODE, _MAX_POINTS, _DIRECTIONS, *_ADAPTATION)
TESTS_MAX = 15
BEYOND_TESTS = 1.3
"""How far beyond the acceleration of the tests a curve is shown, where it is held."""


@dataclass(frozen=True)
class CrosstalkTest:
    """One acceleration test of the crosstalk compensation (``kw.crosstalk.position[i]``), all in mm.

    Attributes
    ----------
    position1, position2 : float
        Positions of the adaptation axes (P-COMP-00085, P-COMP-00086).
    accelerate_positive, accelerate_negative : float
        Correction at the acceleration of the tests, by direction of motion (P-COMP-00087, P-COMP-00088).
    decelerate_positive, decelerate_negative : float
        Correction at the deceleration of the tests (P-COMP-00089, P-COMP-00090).
    """

    position1: float = 0.0
    position2: float = 0.0
    accelerate_positive: float = 0.0
    accelerate_negative: float = 0.0
    decelerate_positive: float = 0.0
    decelerate_negative: float = 0.0


@dataclass(frozen=True, repr=False)
class Crosstalk(Compensation, kind="crosstalk"):
    """Crosstalk compensation (``kw.crosstalk``) of manual 000: added to the slave while the master accelerates.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    acceleration, deceleration : float
        Of the tests, mm/s²: > 0 and < 0 (P-COMP-00066, P-COMP-00067).
    mode : int
        1: one test; 2: linear over ``adaptation1``; 3: over both adaptation axes (P-COMP-00082).
    tests : tuple of CrosstalkTest
        1 to 15 of them (P-COMP-00083).
    adaptation1, adaptation2 : int or None
        Logical numbers of the adaptation axes (P-COMP-00080, P-COMP-00081); None where the mode needs none.
    velocity_dependent : bool
        Corrections differ by the direction of the master (P-COMP-00084).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00065).
    """

    master: int
    acceleration: float
    deceleration: float
    mode: int
    tests: tuple[CrosstalkTest, ...]
    adaptation1: int | None = None
    adaptation2: int | None = None
    velocity_dependent: bool = False
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"Crosstalk(master {self.master}, mode {self.mode}, {len(self.tests)} tests)"


@dataclass(frozen=True, repr=False)
class CrosstalkCurve(Compensation, kind="crosstalk"):
    """Crosstalk compensation (``kw.crosstalk``) of manual 001: linear over the master's acceleration.

    Attributes
    ----------
    master : int
        Logical number of the accelerating axis (P-COMP-00063).
    accelerations : tuple of float
        mm/s², strictly ascending, with sign; 1 to 5 of them (P-COMP-00066).
    corrections : tuple of float
        mm, one for each acceleration (P-COMP-00067).
    n_cycles : int
        Cycles of smooth switching, 0..20 (P-COMP-00064).
    manual_activation : bool
        On only by command (P-COMP-00073).
    """

    master: int
    accelerations: tuple[float, ...]
    corrections: tuple[float, ...]
    n_cycles: int = 0
    manual_activation: bool = False

    def __repr__(self) -> str:
        return f"CrosstalkCurve(master {self.master}, {len(self.accelerations)} points {span(self.accelerations)})"


def _test(field: str, meaning: str, number: str) -> Parameter:
    return Parameter(
        _TEST_FIELDS[field],
        meaning,
        DataType.SGN64,
        0,
        isg(number),
        ListQuantity.POSITION,
        BELOW_MAX,
        index_max=(TESTS_MAX - 1,),
    )


class CrosstalkKind(Kind["Crosstalk | CrosstalkCurve"]):
    """See the module."""

    name = "crosstalk"
    title = "Crosstalk compensation"
    word = "CROSSTALK"
    identifier = 24
    activator = activation("lr_param.crosstalk", "crosstalk compensation", "00789")
    prefix = PREFIX
    parameters = (
        Parameter(
            _MASTER,
            "Logical number of the accelerating axis",
            DataType.UNS16,
            0,
            both("00063"),
            range=AXIS_NUMBER,
            aliases=(_OLD_MASTER,),
        ),
        smooth_switching(_CYCLES, "00064"),
        Parameter(
            _MANUAL,
            "On only by command",
            DataType.BOOLEAN,
            0,
            isg("00065") | twincat("00073"),
            # So it stands in the overview of the TwinCAT manual.
            typos=(f"{_OLD_MASTER}.manual_activation",),
        ),
        *(
            Parameter(name, meaning, DataType.SGN32, 0, isg(number), ListQuantity.ACCELERATION, bounds)
            for name, meaning, number, bounds in (
                (_LIMITS[0], "Acceleration of the tests", "00066", "(0, MAX)"),
                (_LIMITS[1], "Negative acceleration of the tests", "00067", "[MIN, 0)"),
            )
        ),
        *(
            Parameter(name, f"Logical number of adaptation axis {i}", DataType.UNS16, 0, isg(number), range="(0, MAX)")
            for i, (name, number) in enumerate(zip(_ADAPTATION, ("00080", "00081"), strict=True), 1)
        ),
        Parameter(
            _MODE,
            "1 constant, 2 over one adaptation axis, 3 over two",
            DataType.UNS08,
            1,
            isg("00082"),
            range="[1, 3]",
        ),
        Parameter(
            _MAX_POINTS,
            "Number of tests; 0: as many as given",
            DataType.UNS32,
            0,
            isg("00083"),
            range=f"[0, {TESTS_MAX}]",
        ),
        Parameter(_DIRECTIONS, "Corrections differ by the master's direction", DataType.BOOLEAN, 0, isg("00084")),
        _test("position1", "Position of adaptation axis 1", "00085"),
        _test("position2", "Position of adaptation axis 2", "00086"),
        _test("accelerate_positive", "Correction, speeding up in positive motion", "00087"),
        _test("accelerate_negative", "Correction, speeding up in negative motion", "00088"),
        _test("decelerate_positive", "Correction, slowing down in positive motion", "00089"),
        _test("decelerate_negative", "Correction, slowing down in negative motion", "00090"),
        Parameter(_LAST_INDEX, "Last index of the table", DataType.SGN32, 0, twincat("00065"), range="[0, 5)"),
        Parameter(
            CURVE[0],
            "Acceleration of the master, with sign",
            DataType.SGN32,
            0,
            twincat("00066"),
            ListQuantity.ACCELERATION,
            BELOW_MAX,
            index_max=(4,),
        ),
        position(CURVE[1], "Correction of the slave", twincat("00067"), index_max=(4,)),
    )
    columns = (*_TEST_FIELDS.values(), *CURVE)
    sizes = (_MAX_POINTS, _LAST_INDEX)
    at_standstill = True
    codes = {
        "AXC-VARIANT": (
            Severity.WARNING,
            "Entries of both variants of the crosstalk compensation; the new one counts",
        ),
        "AXC-TESTS": (Severity.ERROR, "Too few crosstalk tests, or all in one line"),
        "AXC-TESTS-FEW": (Severity.WARNING, "Fewer crosstalk tests than the mode should have"),
        "AXC-TESTS-TWICE": (Severity.WARNING, "Two crosstalk tests at the same place; the later one counts"),
        "AXC-ACCELERATION": (Severity.ERROR, "The acceleration or deceleration of the crosstalk tests is missing"),
        "AXC-AT-REST": (Severity.WARNING, "The crosstalk correction at acceleration 0 is not 0"),
    }
    notice = "the adaptation axes of its crosstalk compensation have left the tests' positions"

    def read(self, source: TableReader) -> Crosstalk | CrosstalkCurve | None:
        """Return the compensation, None where it cannot be used. The names of the entries decide the variant."""
        values = source.values
        new = any(values.cells(name) for name in _NEW_ONLY)
        old = next((name for name in (*CURVE, _LAST_INDEX) if values.cells(name)), None)
        if source.axis.type is not AxisType.TRANSLATORY:
            message = f"Axis {source.axis.number} is not translatory, as crosstalk needs; the compensation stays off."
            source.note("AXC-AXIS-TYPE", _MASTER, message)
            return None
        if new and old:
            message = (
                "There are entries of both variants of the crosstalk compensation; those of the old one are not used."
            )
            source.note("AXC-VARIANT", old, message, *min(values.cells(old)))
        return _read_tests(source) if new else _read_curve(source)

    def write(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        crosstalk = compensation
        old = isinstance(crosstalk, CrosstalkCurve)
        lines.add(_OLD_MASTER if old else _MASTER, crosstalk.master)
        lines.add_unless_default(_CYCLES, crosstalk.n_cycles)
        lines.add_unless_default(_MANUAL, crosstalk.manual_activation)
        if isinstance(crosstalk, CrosstalkCurve):
            lines.add(_LAST_INDEX, len(crosstalk.accelerations) - 1)
            for i, row in enumerate(zip(crosstalk.accelerations, crosstalk.corrections, strict=True)):
                for name, value in zip(CURVE, row, strict=True):
                    lines.add_converted(name, value, i)
            return
        lines.add(_MODE, crosstalk.mode)
        lines.add(_MAX_POINTS, len(crosstalk.tests))
        lines.add_converted(_LIMITS[0], crosstalk.acceleration)
        lines.add_converted(_LIMITS[1], crosstalk.deceleration)
        lines.add(_DIRECTIONS, crosstalk.velocity_dependent)
        for name, number in zip(_ADAPTATION, (crosstalk.adaptation1, crosstalk.adaptation2), strict=True):
            if number is not None:
                lines.add(name, number)
        for i, test in enumerate(crosstalk.tests):
            for field in fields(test):
                if _is_used(field.name, crosstalk.mode, crosstalk.velocity_dependent):
                    lines.add_converted(_TEST_FIELDS[field.name], getattr(test, field.name), i)

    def compile(self, compensation: Crosstalk | CrosstalkCurve, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        table = compiler.tables.crosstalk
        table.master = compiler.index_of(compensation.master)
        if isinstance(compensation, CrosstalkCurve):
            table.variant = CROSSTALK_CURVE
            table.acceleration, table.deceleration = 1.0, -1.0
            compiler.curve(table.curve, self.name, compensation.accelerations, compensation.corrections)
        else:
            _compile_tests(compensation, compiler, table)

    def tables(self, compensation: Crosstalk | CrosstalkCurve, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return curves over the acceleration; for both accelerations of the tests, tables over the adaptation axes.

        The values of tests stand in no column of the list: these tables have no ``entry``.
        """
        acceleration = Quantity(ACCELERATION, "mm/s²", machine.numbered(compensation.master).name)
        of = correction_of(axis)
        if isinstance(compensation, CrosstalkCurve):
            entry = CURVE[1]
            x, y = compensation.accelerations, compensation.corrections
            return (Curve(x, y, acceleration, of, label="correction", entry=entry),)
        high, low = compensation.acceleration, compensation.deceleration
        motions = (POSITIVE, NEGATIVE) if compensation.velocity_dependent else ("",)
        tests = (
            sorted(compensation.tests, key=lambda test: test.position1)
            if compensation.mode == 2
            else compensation.tests
        )
        columns = {
            (high, POSITIVE): tuple(test.accelerate_positive for test in tests),
            (high, NEGATIVE): tuple(test.accelerate_negative for test in tests),
            (low, POSITIVE): tuple(test.decelerate_positive for test in tests),
            (low, NEGATIVE): tuple(test.decelerate_negative for test in tests),
        }
        if compensation.mode == 1:
            x = (BEYOND_TESTS * low, low, 0.0, high, BEYOND_TESTS * high)
            ends = [(columns[low, motion or POSITIVE][0], columns[high, motion or POSITIVE][0]) for motion in motions]
            return tuple(
                Curve(x, (down, down, 0.0, up, up), acceleration, of, label=motion or "correction")
                for motion, (down, up) in zip(motions, ends, strict=True)
            )
        note = f"{acceleration.name} of {acceleration.axis}: {high:g} and {low:g} mm/s²"
        states = [
            (", ".join(word for word in (f"{limit:+g} mm/s²", motion) if word), columns[limit, motion or POSITIVE])
            for limit in (high, low)
            for motion in motions
        ]
        over = [
            position_of(machine.numbered(n))
            for n in (compensation.adaptation1, compensation.adaptation2)
            if n is not None
        ]
        if compensation.mode == 2:
            x = tuple(test.position1 for test in tests)
            return tuple(Curve(x, values, over[0], of, label=label, note=note) for label, values in states)
        places = tuple((test.position1, test.position2) for test in tests)
        return tuple(Scatter(places, values, (over[0], over[1]), of, label, note) for label, values in states)

    def ranges(
        self, compensation: Crosstalk | CrosstalkCurve, tables: tuple[Table, ...], machine: Machine
    ) -> list[Range]:
        """Return the range of the tests' accelerations, and those of the adaptation axes."""
        if isinstance(compensation, CrosstalkCurve):
            return ranges_of(tables)
        entry = _LIMITS[0]
        over = Quantity(ACCELERATION, "mm/s²", machine.numbered(compensation.master).name)
        places = ranges_of(tables) if compensation.mode > 1 else []
        tested = Range(over, compensation.deceleration, compensation.acceleration, entry)
        return [tested, *(place._replace(entry=entry) for place in places)]

    def needs(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis) -> tuple[int, ...]:
        """Return the adaptation axes."""
        return tuple(number for number in _adaptation(compensation) if number is not None)

    def looks_up(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis) -> Iterable[Reference]:
        """Return the master's motion and the positions of the adaptation axes."""
        master = tuple((compensation.master, name) for name in ("setpoint", "velocity", "acceleration"))
        return (*((number, "setpoint") for number in self.needs(compensation, axis)), *master)


def _adaptation(crosstalk: Crosstalk | CrosstalkCurve) -> tuple[int | None, ...]:
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


def _read_tests(source: TableReader) -> Crosstalk | None:
    values = source.values
    mode = values.integer(_MODE)
    acceleration, deceleration = (values.converted(name) for name in _LIMITS)
    for name, sign, usable in zip(_LIMITS, ("above", "below"), (acceleration > 0.0, deceleration < 0.0), strict=True):
        if not usable:
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
        axis = _translatory(source, _ADAPTATION[i], f"adaptation axis {i + 1}")
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
        velocity_dependent=values.flag(_DIRECTIONS),
        n_cycles=values.integer(_CYCLES),
        manual_activation=values.flag(_MANUAL),
    )


def _tests(source: TableReader, mode: int) -> list[CrosstalkTest] | None:
    """Return the tests that a mode uses, each at its own place; None if they are too few."""
    values = source.values
    last = max((index for name in _TEST_FIELDS.values() for (index,) in values.cells(name)), default=-1)
    count = 1 if mode == 1 else values.integer(_MAX_POINTS) or last + 1
    if last < 0:
        source.note("AXC-TESTS", _MODE, "There are no crosstalk tests; the compensation stays off.")
        return None
    used = [name for name in _TEST_FIELDS if _is_used(name, mode, values.flag(_DIRECTIONS))]
    columns = {name: source.column(_TEST_FIELDS[name], count) for name in used}
    rows = [CrosstalkTest(**dict(zip(used, row, strict=True))) for row in zip(*columns.values(), strict=True)]
    tests = _at_different_places(source, rows, _TEST_FIELDS[used[0]])
    if mode == 2 and len(tests) == 2:
        message = "Mode 2 should have three tests at least; the two that are given are used."
        source.note("AXC-TESTS-FEW", _MODE, message)
    if len(tests) < mode or (mode == 3 and _in_line(tests)):
        need = "two tests" if mode == 2 else "three tests that are not in a line"
        message = f"Mode {mode} needs {need} at different places; the compensation stays off."
        source.note("AXC-TESTS", _MODE, message)
        return None
    return tests


def _is_used(field: str, mode: int, velocity_dependent: bool) -> bool:
    if field.startswith("position"):
        return mode > int(field[-1])
    return velocity_dependent or field.endswith("positive")


def _at_different_places(source: TableReader, rows: list[CrosstalkTest], name: str) -> list[CrosstalkTest]:
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


def _read_curve(source: TableReader) -> CrosstalkCurve | None:
    values = source.values
    count = values.integer(_LAST_INDEX) + 1
    accelerations = source.column(CURVE[0], count)
    corrections = source.column(CURVE[1], count)
    if not source.ascending(accelerations, CURVE[0], "AXC-ORDER", _LAST_INDEX):
        return None
    at_rest = _interpolate(accelerations, corrections, 0.0)
    if at_rest != 0.0:
        message = f"At acceleration 0 the table gives {at_rest:g} mm, which acts all the time; it is used."
        source.note("AXC-AT-REST", CURVE[1], message, 0)
    master = _translatory(source, _MASTER, "accelerating axis")
    if master is None:
        return None
    source.note_own_master(_MASTER)
    return CrosstalkCurve(
        master=master.number,
        accelerations=tuple(accelerations),
        corrections=tuple(corrections),
        n_cycles=values.integer(_CYCLES),
        manual_activation=values.flag(_MANUAL),
    )


def _interpolate(x: Sequence[float], y: Sequence[float], at: float) -> float:
    if at <= x[0]:
        return y[0]
    for i in range(1, len(x)):
        if at <= x[i]:
            return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1])
    return y[-1]


def _compile_tests(crosstalk: Crosstalk, compiler: AxisCompiler, table: CrosstalkTable) -> None:
    require, tests = compiler.require, crosstalk.tests
    require(crosstalk.acceleration > 0.0 > crosstalk.deceleration, "crosstalk: acceleration > 0 > deceleration")
    table.acceleration, table.deceleration = crosstalk.acceleration, crosstalk.deceleration
    table.velocity_dependent = crosstalk.velocity_dependent
    require(0 < len(tests) <= TESTS_MAX, f"crosstalk: there are 1 … {TESTS_MAX} tests")
    positions = [p for test in tests for p in (test.position1, test.position2)]
    require(all(abs(p) < LARGEST for p in positions), "crosstalk: a position is not finite")
    require(1 <= crosstalk.mode <= 3, f"crosstalk: mode {crosstalk.mode} is not 1, 2 or 3")
    for i, argument in enumerate((table.adaptation1, table.adaptation2)[: crosstalk.mode - 1]):
        number = _adaptation(crosstalk)[i]
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
    triangulation = triangulate([test.position1 for test in tests], [test.position2 for test in tests])
    compiler.require(len(triangulation.triangles) > 0, "crosstalk: mode 3 needs three tests that are not in a line")
    table.x1 = compiler.append([test.position1 for test in tests])
    table.x2 = compiler.append([test.position2 for test in tests])
    table.triangles = len(triangulation.triangles)
    table.triangle = compiler.append([float(i) for triangle in triangulation.triangles for i in triangle])
    table.edges = len(triangulation.edges)
    table.edge = compiler.append([float(i) for edge in triangulation.edges for i in edge])
    _append_tests(tests, compiler, table)


def _append_tests(tests: Sequence[CrosstalkTest], compiler: AxisCompiler, table: CrosstalkTable) -> None:
    table.tests = len(tests)
    table.values = compiler.append([test.accelerate_positive for test in tests])
    compiler.append([test.accelerate_negative for test in tests])
    compiler.append([test.decelerate_positive for test in tests])
    compiler.append([test.decelerate_negative for test in tests])


KIND = CrosstalkKind()
