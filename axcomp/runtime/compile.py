"""Machine → the kernel's tables: axis numbers become indices, tables one pool of floats, and divisors are checked.

The reader has sorted out what is implausible and said so; a Machine made by hand is checked here.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ..kernel.crosstalk import CROSSTALK_CONSTANT, CROSSTALK_CURVE, CROSSTALK_GRID, CROSSTALK_LINE, CROSSTALK_TRIANGLES
from ..kernel.cycle import LARGEST
from ..kernel.record import zero
from ..kernel.records import (
    CrossTable,
    CrosstalkTable,
    Curve,
    FrictionTable,
    LeadscrewTable,
    PlaneTable,
    SwitchTable,
    Tables,
)
from ..model.delaunay import triangulate
from ..model.machine import (
    AXES_MAX,
    Axis,
    Cross,
    Crosstalk,
    CrosstalkCurve,
    CrosstalkTest,
    Friction,
    Leadscrew,
    Machine,
    Plane,
)
from .compile_pool import CompileError, append
from .compile_volumetric import compile_volumetric

__all__ = ["CYCLE_TIME", "CYCLE_TIME_MAX", "CompileError", "compile_tables"]

CYCLE_TIME = 0.001
"""Default cycle time of the position controller in s: no list names it."""

CYCLE_TIME_MAX = 1e3
"""Cycle times are shorter, s."""

PLANE_POINTS = 10201
"""Entries of a plane where the list does not say how many (P-COMP-00061)."""


def compile_tables(machine: Machine, cycle_time: float = CYCLE_TIME) -> Tables:
    """Return the tables of a machine.

    Parameters
    ----------
    machine : Machine
        At most 32 axes; every master is one of them.
    cycle_time : float
        Of the position controller in s, > 0.

    Raises
    ------
    CompileError
        If an axis is missing, abscissae do not ascend, sizes differ, or a number is out of range.
    """
    if not 0.0 < cycle_time < CYCLE_TIME_MAX:
        raise CompileError(f"the cycle time must be above 0 s, not {cycle_time}")
    if len(machine.axes) > AXES_MAX:
        raise CompileError(f"{len(machine.axes)} axes: at most {AXES_MAX} are possible")
    if len({axis.number for axis in machine.axes}) < len(machine.axes):
        raise CompileError("two axes have the same logical number")
    tables = zero(Tables)
    tables.cycle_time = cycle_time
    tables.axis_count = len(machine.axes)
    for index, axis in enumerate(machine.axes):
        _AxisCompiler(machine, axis, tables, index).compile()
    compile_volumetric(machine, tables)
    return tables


class _AxisCompiler:
    """Fills one axis' tables."""

    def __init__(self, machine: Machine, axis: Axis, tables: Tables, index: int) -> None:
        self.machine = machine
        self.axis = axis
        self.index = index
        self.table = tables.axis[index]
        self.pool = tables.pool

    def compile(self) -> None:
        axis, table = self.axis, self.table
        table.number = axis.number
        table.pool = self.pool
        if axis.modulo is not None:
            table.modulo_range = axis.modulo.end - axis.modulo.start
            self._require(1e-6 < table.modulo_range < LARGEST, "the modulo range must be above 0 and finite")
        self._require(0 <= axis.backlash_cycles <= 20, "n_backlash_cyc is 0 … 20")
        if axis.cross is not None:
            self._cross(axis.cross, table.cross)
        if axis.plane is not None:
            self._plane(axis.plane, table.plane)
        if isinstance(axis.crosstalk, CrosstalkCurve):
            self._crosstalk_curve(axis.crosstalk, table.crosstalk)
        elif axis.crosstalk is not None:
            self._crosstalk(axis.crosstalk, table.crosstalk)
        if axis.leadscrew is not None:
            self._leadscrew(axis.leadscrew, table.leadscrew)
        if axis.friction is not None:
            self._friction(axis.friction, table.friction)
        # A shift of the leadscrew has no n_cycles: it is released as softly as the axis changes direction.
        switched = (table.cross.switching, table.plane.switching, table.crosstalk.switching)
        table.shift_cycles = max(1, axis.backlash_cycles, *(switch.cycles for switch in switched))

    def _cross(self, cross: Cross, table: CrossTable) -> None:
        self._switch(table.switching, cross.manual_activation, cross.n_cycles, at_standstill=True)
        table.max_points = cross.max_points
        table.master = self._index(cross.master)
        self._curve(table.curve, "cross", cross.positions, cross.corrections)

    def _plane(self, plane: Plane, table: PlaneTable) -> None:
        self._switch(table.switching, plane.manual_activation, plane.n_cycles, at_standstill=True)
        table.max_points = plane.max_points or PLANE_POINTS
        table.master1 = self._index(plane.master1)
        table.master2 = self._index(plane.master2)
        table.start1, table.start2 = plane.start1, plane.start2
        table.interval1, table.interval2 = plane.interval1, plane.interval2
        self._require(plane.interval1 > 0.0 and plane.interval2 > 0.0, "plane: the intervals must be above 0")
        self._require(abs(plane.start1) < LARGEST and abs(plane.start2) < LARGEST, "plane: the starts must be finite")
        table.points2 = len(plane.corrections)
        self._require(table.points2 > 0 and len(plane.corrections[0]) > 0, "plane: the table is empty")
        table.points1 = len(plane.corrections[0])
        self._require(all(len(row) == table.points1 for row in plane.corrections), "plane: the rows differ in length")
        table.values = self._append([value for row in plane.corrections for value in row])

    def _crosstalk_curve(self, crosstalk: CrosstalkCurve, table: CrosstalkTable) -> None:
        self._switch(table.switching, crosstalk.manual_activation, crosstalk.n_cycles, at_standstill=True)
        table.variant = CROSSTALK_CURVE
        table.master = self._index(crosstalk.master)
        table.acceleration, table.deceleration = 1.0, -1.0
        self._curve(table.curve, "crosstalk", crosstalk.accelerations, crosstalk.corrections)

    def _crosstalk(self, crosstalk: Crosstalk, table: CrosstalkTable) -> None:
        self._switch(table.switching, crosstalk.manual_activation, crosstalk.n_cycles, at_standstill=True)
        table.master = self._index(crosstalk.master)
        self._require(
            crosstalk.acceleration > 0.0 > crosstalk.deceleration, "crosstalk: acceleration > 0 > deceleration"
        )
        table.acceleration, table.deceleration = crosstalk.acceleration, crosstalk.deceleration
        table.velocity_dependent = crosstalk.velocity_dependent
        self._require(0 < len(crosstalk.tests) <= 15, "crosstalk: there are 1 … 15 tests")
        positions = [p for test in crosstalk.tests for p in (test.position1, test.position2)]
        self._require(all(abs(p) < LARGEST for p in positions), "crosstalk: a position is not finite")
        if crosstalk.mode == 1:
            table.variant = CROSSTALK_CONSTANT
            self._tests(crosstalk.tests[:1], table)
        elif crosstalk.mode == 2:
            table.variant = CROSSTALK_LINE
            table.adaptation1 = self._adaptation(crosstalk.adaptation1)
            tests = sorted(crosstalk.tests, key=lambda test: test.position1)
            self._tests(tests, table)
            self._require(len(tests) > 1, "crosstalk: mode 2 needs two tests")
            self._ascending("crosstalk", [test.position1 for test in tests])
            table.x1 = self._append([test.position1 for test in tests])
        elif crosstalk.mode == 3:
            table.adaptation1 = self._adaptation(crosstalk.adaptation1)
            table.adaptation2 = self._adaptation(crosstalk.adaptation2)
            self._two_adaptation_axes(crosstalk.tests, table)
        else:
            self._require(False, f"crosstalk: mode {crosstalk.mode} is not 1, 2 or 3")

    def _two_adaptation_axes(self, tests: Sequence[CrosstalkTest], table: CrosstalkTable) -> None:
        """Choose the grid where the tests fill a rectangular one, else Delaunay triangles."""
        x1 = sorted({test.position1 for test in tests})
        x2 = sorted({test.position2 for test in tests})
        places = {(test.position2, test.position1) for test in tests}
        self._require(len(places) == len(tests), "crosstalk: two tests stand at the same positions")
        if len(tests) == len(x1) * len(x2) and len(x1) > 1 and len(x2) > 1:
            table.variant = CROSSTALK_GRID
            table.points1, table.points2 = len(x1), len(x2)
            table.x1, table.x2 = self._append(x1), self._append(x2)
            self._tests(sorted(tests, key=lambda test: (test.position2, test.position1)), table)
            return
        table.variant = CROSSTALK_TRIANGLES
        triangulation = triangulate([test.position1 for test in tests], [test.position2 for test in tests])
        self._require(len(triangulation.triangles) > 0, "crosstalk: mode 3 needs three tests that are not in a line")
        table.x1 = self._append([test.position1 for test in tests])
        table.x2 = self._append([test.position2 for test in tests])
        table.triangles = len(triangulation.triangles)
        table.triangle = self._append([float(i) for triangle in triangulation.triangles for i in triangle])
        table.edges = len(triangulation.edges)
        table.edge = self._append([float(i) for edge in triangulation.edges for i in edge])
        self._tests(tests, table)

    def _tests(self, tests: Sequence[CrosstalkTest], table: CrosstalkTable) -> None:
        table.tests = len(tests)
        table.values = self._append([test.accelerate_positive for test in tests])
        self._append([test.accelerate_negative for test in tests])
        self._append([test.decelerate_positive for test in tests])
        self._append([test.decelerate_negative for test in tests])

    def _leadscrew(self, leadscrew: Leadscrew, table: LeadscrewTable) -> None:
        self._switch(table.switching, leadscrew.manual_activation, 0, at_standstill=False)
        table.max_points = leadscrew.max_points
        positions, positive, negative = leadscrew.positions, leadscrew.positive, leadscrew.negative
        table.bilateral = negative is not None
        table.without_other = leadscrew.without_other_compensations
        table.reversal_cycles = max(1, self.axis.backlash_cycles)
        if leadscrew.modulo:
            length = self.table.modulo_range
            self._require(length > 0.0, "leadscrew: a modulo table needs a modulo axis")
            table.modulo = True
            if positions and positions[-1] < positions[0] + length:
                # The gap from the last point back to the first is interpolated.
                positions = (*positions, positions[0] + length)
                positive = (*positive, positive[0])
                negative = None if negative is None else (*negative, negative[0])
        self._curve(table.positive, "leadscrew", positions, positive)
        if negative is not None:
            self._curve(table.negative, "leadscrew", positions, negative, x_at=table.positive.x)

    def _friction(self, friction: Friction, table: FrictionTable) -> None:
        self._switch(table.switching, False, 0, at_standstill=False)
        table.max_points = friction.max_points
        self._curve(table.curve, "friction", friction.velocities, friction.currents)
        self._require(friction.velocities[0] >= 0.0, "friction: velocities are not negative")
        self._require(abs(friction.scaling) < LARGEST, "friction: the scaling must be finite")
        self._require(0.0 <= friction.position_delay < LARGEST, "friction: the position delay is not negative")
        self._require(0 <= friction.reversal_lookahead <= 4, "friction: the look-ahead is 0 … 4 cycles")
        self._require(0 <= friction.delay_cycles < 249, "friction: the delay is 0 … 248 cycles")
        table.scaling = friction.scaling
        table.position_delay = friction.position_delay
        table.lookahead = friction.reversal_lookahead
        table.delay = friction.delay_cycles

    def _switch(self, table: SwitchTable, manual: bool, cycles: int, *, at_standstill: bool) -> None:
        self._require(0 <= cycles <= 20, f"n_cycles is 0 … 20, not {cycles}")
        table.configured = True
        table.manual = manual
        table.at_standstill = at_standstill
        table.cycles = max(1, cycles)

    def _curve(
        self, curve: Curve, kind: str, x: Sequence[float], y: Sequence[float], *, x_at: int | None = None
    ) -> None:
        self._require(len(x) == len(y) and len(x) > 0, f"{kind}: {len(x)} points but {len(y)} values")
        self._ascending(kind, x)
        curve.points = len(x)
        curve.x = self._append(x) if x_at is None else x_at
        curve.y = self._append(y)

    def _append(self, values: Sequence[float]) -> int:
        """Put numbers into the pool; return where they begin."""
        return append(self.pool, values, f"axis {self.axis.name}")

    def _ascending(self, kind: str, x: Sequence[float]) -> None:
        self._require(all(a < b for a, b in pairwise(x)), f"{kind}: the points do not ascend")

    def _adaptation(self, number: int | None) -> int:
        self._require(number is not None, "crosstalk: an adaptation axis is missing")
        return self._index(number or 0)

    def _index(self, number: int) -> int:
        try:
            return self.machine.index_of(number)
        except KeyError:
            raise CompileError(f"axis {self.axis.name}: its master axis {number} does not exist") from None

    def _require(self, condition: bool, message: str) -> None:
        if not condition:
            raise CompileError(f"axis {self.axis.name}: {message}")
