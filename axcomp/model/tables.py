"""The tables of a machine's compensations, whatever their kind: what is shown, judged and converted of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

from .curve import Curve
from .grid import Grid, Scatter
from .machine import Axis, Cross, Crosstalk, CrosstalkCurve, Friction, Leadscrew, Machine, Plane
from .quantity import Quantity, symbol

Table: TypeAlias = Curve | Grid | Scatter

POSITION, SPEED, ACCELERATION = "position", "speed", "acceleration"
"""Names of the quantities that tables are over."""
POSITIVE, NEGATIVE, BOTH = "positive motion", "negative motion", "both directions"
BEYOND_TESTS = 1.3
"""How far beyond the acceleration of the tests a crosstalk curve goes on, where it is held."""


def position_of(axis: Axis) -> Quantity:
    """Return the position of an axis with its unit."""
    return Quantity(POSITION, symbol(axis.unit), axis.name)


def correction_of(axis: Axis, name: str = "correction") -> Quantity:
    """Return a correction of an axis with its unit."""
    return Quantity(name, symbol(axis.unit), axis.name)


def leadscrew_tables(machine: Machine, axis: Axis, leadscrew: Leadscrew) -> tuple[Curve, ...]:  # noqa: ARG001
    """Return a curve for each direction, or one for both: actual − programmed, which is subtracted."""
    period = axis.modulo.end - axis.modulo.start if leadscrew.modulo and axis.modulo is not None else None
    sides = [(BOTH if leadscrew.negative is None else POSITIVE, leadscrew.positive, "kw.ssfk.table[i].pos")]
    if leadscrew.negative is not None:
        sides.append((NEGATIVE, leadscrew.negative, "kw.ssfk.table[i].neg"))
    return tuple(
        Curve(
            leadscrew.positions,
            values,
            position_of(axis),
            correction_of(axis, "actual − programmed position"),
            period,
            label,
            entry,
            -1.0,
            "repeats" if period is not None else "",
        )
        for label, values, entry in sides
    )


def cross_tables(machine: Machine, axis: Axis, cross: Cross) -> tuple[Curve, ...]:
    """Return the curve over the master."""
    over = position_of(_numbered(machine, cross.master))
    entry = "kw.crosscomp.table[i].correction"
    return (Curve(cross.positions, cross.corrections, over, correction_of(axis), label=BOTH, entry=entry),)


def plane_tables(machine: Machine, axis: Axis, plane: Plane) -> tuple[Grid, ...]:
    """Return the grid over both masters."""
    over = (position_of(_numbered(machine, plane.master1)), position_of(_numbered(machine, plane.master2)))
    x = tuple(plane.start1 + plane.interval1 * i for i in range(len(plane.corrections[0])))
    y = tuple(plane.start2 + plane.interval2 * j for j in range(len(plane.corrections)))
    return (Grid(x, y, plane.corrections, over, correction_of(axis), entry="kw.crosscomp2.table[j][i].correction"),)


def friction_tables(machine: Machine, axis: Axis, friction: Friction) -> tuple[Curve, ...]:  # noqa: ARG001
    """Return the scaled current over the speed."""
    unit = symbol(axis.unit)
    builds_up = f", builds up over {friction.position_delay:g} {unit}" if friction.position_delay else ""
    return (
        Curve(
            friction.velocities,
            tuple(friction.scaling * current for current in friction.currents),
            Quantity(SPEED, f"{unit}/s", axis.name),
            Quantity("added current", "drive units"),
            label="current",
            entry="frict_comp.table[i].out",
            note=f"scaled by {friction.scaling:g}{builds_up}",
        ),
    )


def crosstalk_tables(machine: Machine, axis: Axis, crosstalk: Crosstalk | CrosstalkCurve) -> tuple[Table, ...]:
    """Return curves over the acceleration, or, for both accelerations of the tests, tables over the adaptation axes.

    The values of tests stand in no column of the list: these tables have no ``entry``.
    """
    acceleration = Quantity(ACCELERATION, "mm/s²", _numbered(machine, crosstalk.master).name)
    of = correction_of(axis)
    if isinstance(crosstalk, CrosstalkCurve):
        entry = "kw.crosstalk.table[i].correction"
        x, y = crosstalk.accelerations, crosstalk.corrections
        return (Curve(x, y, acceleration, of, label="correction", entry=entry),)
    high, low = crosstalk.acceleration, crosstalk.deceleration
    motions = (POSITIVE, NEGATIVE) if crosstalk.velocity_dependent else ("",)
    tests = sorted(crosstalk.tests, key=lambda test: test.position1) if crosstalk.mode == 2 else crosstalk.tests
    columns = {
        (high, POSITIVE): tuple(test.accelerate_positive for test in tests),
        (high, NEGATIVE): tuple(test.accelerate_negative for test in tests),
        (low, POSITIVE): tuple(test.decelerate_positive for test in tests),
        (low, NEGATIVE): tuple(test.decelerate_negative for test in tests),
    }
    if crosstalk.mode == 1:
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
    over = [position_of(_numbered(machine, n)) for n in (crosstalk.adaptation1, crosstalk.adaptation2) if n is not None]
    if crosstalk.mode == 2:
        x = tuple(test.position1 for test in tests)
        return tuple(Curve(x, values, over[0], of, label=label, note=note) for label, values in states)
    places = tuple((test.position1, test.position2) for test in tests)
    return tuple(Scatter(places, values, (over[0], over[1]), of, label, note) for label, values in states)


def _numbered(machine: Machine, number: int) -> Axis:
    return machine.axes[machine.index_of(number)]


TABLES: Mapping[str, Callable[[Machine, Axis, Any], tuple[Table, ...]]] = {
    "cross": cross_tables,
    "plane": plane_tables,
    "crosstalk": crosstalk_tables,
    "leadscrew": leadscrew_tables,
    "friction": friction_tables,
}
"""What is shown, judged and converted of a compensation, by its kind."""


class Range(NamedTuple):
    """Over what a compensation has values of its own, from where to where, and the list entry that says so."""

    over: Quantity
    low: float
    high: float
    entry: str


def ranges_of(tables: tuple[Table, ...]) -> list[Range]:
    """Return the ranges of the first of some tables; beyond them the end values are held."""
    table = tables[0]
    if isinstance(table, Curve):
        return [] if table.period is not None else [Range(table.over, table.x[0], table.x[-1], table.entry)]
    columns = (table.x, table.y) if isinstance(table, Grid) else tuple(zip(*table.places, strict=True))
    return [Range(over, min(x), max(x), table.entry) for over, x in zip(table.over, columns, strict=True)]


def crosstalk_ranges(tables: tuple[Table, ...], crosstalk: Crosstalk | CrosstalkCurve, machine: Machine) -> list[Range]:
    """Return the range of the tests' accelerations, and those of the adaptation axes."""
    if isinstance(crosstalk, CrosstalkCurve):
        return ranges_of(tables)
    entry = "kw.crosstalk.acceleration"
    over = Quantity(ACCELERATION, "mm/s²", _numbered(machine, crosstalk.master).name)
    places = ranges_of(tables) if crosstalk.mode > 1 else []
    tested = Range(over, crosstalk.deceleration, crosstalk.acceleration, entry)
    return [tested, *(place._replace(entry=entry) for place in places)]


@dataclass(frozen=True)
class Tables:
    """The tables of one compensation.

    Attributes
    ----------
    machine : Machine
    axis : Axis
        The one that is corrected.
    kind : str
        One of ``KINDS``.
    compensation : dataclass
        What they are of.
    tables : tuple of Curve, Grid or Scatter
        At least one; all of one class, over the same quantities.
    """

    machine: Machine
    axis: Axis
    kind: str
    compensation: Any
    tables: tuple[Table, ...]

    @property
    def name(self) -> str:
        """The table in words, as sentences have it: ``the cross table of Z over X``."""
        first = self.tables[0]
        over = (first.over,) if isinstance(first, Curve) else first.over
        others = [one.axis for one in over if first.entry and one.name == POSITION and one.axis != self.axis.name]
        return f"the {self.kind} table of {self.axis.name}" + (f" over {' and '.join(others)}" if others else "")

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Curves over a position that stand in a column of the list each; none for other tables."""
        return tuple(one for one in self.tables if isinstance(one, Curve) and one.entry and one.over.name == POSITION)

    @property
    def grids(self) -> tuple[Grid, ...]:
        """Grids that stand in the list."""
        return tuple(one for one in self.tables if isinstance(one, Grid) and one.entry)

    def named(self, curve: Curve) -> str:
        """Return one of several curves in words."""
        return f"{self.name}, {curve.label}" if len(self.tables) > 1 else self.name

    def ranges(self) -> list[Range]:
        """Return over what, and from where to where, the compensation has values of its own."""
        if self.kind == "crosstalk":
            return crosstalk_ranges(self.tables, self.compensation, self.machine)
        return ranges_of(self.tables)


def tables_of(machine: Machine, axis: str | None = None, kind: str | None = None) -> Iterator[Tables]:
    """Yield the tables of the compensations that act, axis by axis in the order of a cycle.

    Parameters
    ----------
    machine : Machine
        With every master its compensations name.
    axis, kind : str or None
        Only of this axis, only of this kind.
    """
    for one in machine.axes:
        if axis in {None, one.name}:
            for name, compensation in one.compensations():
                if kind in {None, name}:
                    yield Tables(machine, one, name, compensation, TABLES[name](machine, one, compensation))
