"""Crosstalk compensation (``kw.crosstalk``), new and old variant: a slave corrected while its master accelerates."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields

from ..kernel import CROSSTALK_CURVE
from ..model import Axis, AxisType, Curve, Machine, Quantity, Scatter
from .compiling import AxisCompiler
from .crosstalk_data import (
    ADAPTATION,
    BEYOND_TESTS,
    CURVE,
    CYCLES,
    DIRECTIONS,
    LAST_INDEX,
    LIMITS,
    MANUAL,
    MASTER,
    MAX_POINTS,
    MODE,
    NEW_ONLY,
    OLD_MASTER,
    PREFIX,
    TEST_FIELDS,
    TESTS_MAX,
    Crosstalk,
    CrosstalkCurve,
)
from .crosstalk_tests import adaptation_axes, compile_tests, corrections_of, is_used, read_curve, read_tests
from .kind import EntryWriter, Kind, Reference, TableReader
from .parameter import (
    AXIS_NUMBER,
    BELOW_MAX,
    DataType,
    Parameter,
    Quantity as ListQuantity,
    Severity,
    activation,
    both,
    isg,
    position,
    smooth_switching,
    twincat,
)
from .shown import ACCELERATION, NEGATIVE, POSITIVE, Range, Table, correction_of, position_of, ranges_of


def _test(field: str, meaning: str, number: str) -> Parameter:
    return Parameter(
        TEST_FIELDS[field],
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
            MASTER,
            "Logical number of the accelerating axis",
            DataType.UNS16,
            0,
            both("00063"),
            range=AXIS_NUMBER,
            aliases=(OLD_MASTER,),
        ),
        smooth_switching(CYCLES, "00064"),
        Parameter(
            MANUAL,
            "On only by command",
            DataType.BOOLEAN,
            0,
            isg("00065") | twincat("00073"),
            # So it stands in the overview of the TwinCAT manual.
            typos=(f"{OLD_MASTER}.manual_activation",),
        ),
        *(
            Parameter(name, meaning, DataType.SGN32, 0, isg(number), ListQuantity.ACCELERATION, bounds)
            for name, meaning, number, bounds in (
                (LIMITS[0], "Acceleration of the tests", "00066", "(0, MAX)"),
                (LIMITS[1], "Negative acceleration of the tests", "00067", "[MIN, 0)"),
            )
        ),
        *(
            Parameter(name, f"Logical number of adaptation axis {i}", DataType.UNS16, 0, isg(number), range="(0, MAX)")
            for i, (name, number) in enumerate(zip(ADAPTATION, ("00080", "00081"), strict=True), 1)
        ),
        Parameter(
            MODE, "1 constant, 2 over one adaptation axis, 3 over two", DataType.UNS08, 1, isg("00082"), range="[1, 3]"
        ),
        Parameter(
            MAX_POINTS,
            "Number of tests; 0: as many as given",
            DataType.UNS32,
            0,
            isg("00083"),
            range=f"[0, {TESTS_MAX})",
            usable=f"[0, {TESTS_MAX}]",
        ),
        Parameter(DIRECTIONS, "Corrections differ by the master's direction", DataType.BOOLEAN, 0, isg("00084")),
        _test("position1", "Position of adaptation axis 1", "00085"),
        _test("position2", "Position of adaptation axis 2", "00086"),
        _test("accelerate_positive", "Correction, speeding up in positive motion", "00087"),
        _test("accelerate_negative", "Correction, speeding up in negative motion", "00088"),
        _test("decelerate_positive", "Correction, slowing down in positive motion", "00089"),
        _test("decelerate_negative", "Correction, slowing down in negative motion", "00090"),
        Parameter(LAST_INDEX, "Last index of the table", DataType.SGN32, 0, twincat("00065"), range="[0, 5)"),
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
    values = ("corrections", "tests", *list(TEST_FIELDS)[2:])
    columns = (*TEST_FIELDS.values(), *CURVE)
    sizes = (MAX_POINTS, LAST_INDEX)
    at_standstill = True
    codes = {
        "AXC-VARIANT": (
            Severity.WARNING,
            "Entries of both variants of the crosstalk compensation; the new one counts if it has tests",
        ),
        "AXC-TESTS": (Severity.ERROR, "Too few crosstalk tests, one that has no entry, or all in one line or place"),
        "AXC-TESTS-FEW": (Severity.WARNING, "Fewer crosstalk tests than the mode should have"),
        "AXC-TESTS-TWICE": (Severity.WARNING, "Two crosstalk tests at the same place; the later one counts"),
        "AXC-ACCELERATION": (Severity.ERROR, "The acceleration or deceleration of the crosstalk tests is missing"),
        "AXC-DIRECTION": (Severity.WARNING, "Crosstalk corrections for negative motion that nothing uses"),
        "AXC-ADAPTATION": (Severity.WARNING, "Both adaptation axes of the crosstalk compensation are the same"),
        "AXC-AT-REST": (Severity.WARNING, "The crosstalk correction at acceleration 0 is not 0"),
    }
    notice = "the adaptation axes of its crosstalk compensation have left the tests' positions"

    def read(self, source: TableReader) -> Crosstalk | CrosstalkCurve | None:
        """Return the compensation, None where it cannot be used. The names of the entries decide the variant."""
        values = source.values
        tests = any(values.cells(name) for name in TEST_FIELDS.values())
        old = next((name for name in (*CURVE, LAST_INDEX) if values.cells(name)), None)
        if source.axis.type is not AxisType.TRANSLATORY:
            message = f"Axis {source.axis.number} is not translatory, as crosstalk needs; the compensation stays off."
            source.note("AXC-AXIS-TYPE", MASTER, message)
            return None
        stray = old if tests else next((name for name in NEW_ONLY if values.cells(name)), None)
        if old and stray:
            which = "old" if tests else "new"
            both = "There are entries of both variants of the crosstalk compensation"
            message = f"{both}; those of the {which} one are not used."
            source.note("AXC-VARIANT", stray, message, *min(values.cells(stray)))
        return read_tests(source) if tests or not old else read_curve(source)

    def write(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        crosstalk = compensation
        old = isinstance(crosstalk, CrosstalkCurve)
        lines.add(OLD_MASTER if old else MASTER, crosstalk.master)
        lines.add_unless_default(CYCLES, crosstalk.n_cycles)
        lines.add_unless_default(MANUAL, crosstalk.manual_activation)
        if isinstance(crosstalk, CrosstalkCurve):
            lines.add(LAST_INDEX, len(crosstalk.accelerations) - 1)
            for i, row in enumerate(zip(crosstalk.accelerations, crosstalk.corrections, strict=True)):
                for name, value in zip(CURVE, row, strict=True):
                    lines.add_converted(name, value, i)
            return
        lines.add(MODE, crosstalk.mode)
        lines.add(MAX_POINTS, len(crosstalk.tests))
        lines.add_converted(LIMITS[0], crosstalk.acceleration)
        lines.add_converted(LIMITS[1], crosstalk.deceleration)
        lines.add(DIRECTIONS, crosstalk.velocity_dependent)
        for name, number in zip(ADAPTATION, (crosstalk.adaptation1, crosstalk.adaptation2), strict=True):
            if number is not None:
                lines.add(name, number)
        for i, test in enumerate(crosstalk.tests):
            for field in fields(test):
                if is_used(field.name, crosstalk.mode, crosstalk.velocity_dependent):
                    lines.add_converted(TEST_FIELDS[field.name], getattr(test, field.name), i)

    def compile(self, compensation: Crosstalk | CrosstalkCurve, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        table = compiler.tables.crosstalk
        table.master = compiler.index_of(compensation.master)
        if isinstance(compensation, CrosstalkCurve):
            table.variant = CROSSTALK_CURVE
            table.acceleration, table.deceleration = 1.0, -1.0
            compiler.curve(table.curve, self.name, compensation.accelerations, compensation.corrections)
        else:
            compile_tests(compensation, compiler, table)

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
        deciding = tuple(corrections_of(test) for test in tests)
        pair = (over[0], over[1])
        return tuple(Scatter(places, values, pair, of, label, note, deciding=deciding) for label, values in states)

    def ranges(
        self, compensation: Crosstalk | CrosstalkCurve, tables: tuple[Table, ...], machine: Machine
    ) -> list[Range]:
        """Return the range of the tests' accelerations, and those of the adaptation axes."""
        if isinstance(compensation, CrosstalkCurve):
            return ranges_of(tables)
        entry = LIMITS[0]
        over = Quantity(ACCELERATION, "mm/s²", machine.numbered(compensation.master).name)
        places = ranges_of(tables) if compensation.mode > 1 else []
        tested = Range(over, compensation.deceleration, compensation.acceleration, entry)
        return [tested, *(place._replace(entry=entry) for place in places)]

    def needs(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis) -> tuple[int, ...]:
        """Return the adaptation axes."""
        return tuple(number for number in adaptation_axes(compensation) if number is not None)

    def looks_up(self, compensation: Crosstalk | CrosstalkCurve, axis: Axis) -> Iterable[Reference]:
        """Return the master's motion and the positions of the adaptation axes."""
        master = tuple((compensation.master, name) for name in ("setpoint", "velocity", "acceleration"))
        return (*((number, "setpoint") for number in self.needs(compensation, axis)), *master)


KIND = CrosstalkKind()
