"""The motions of the demonstration: for each kind of compensation one that shows its error and little else.

Geometric errors are looked at where the axes stand, 60 ms after they arrived, so that following errors are gone; every
stop is approached from a known side, as in ISO 230-2. Crosstalk is looked at while the master changes its speed and the
slave moves slowly, friction at the reversals of a circle (ISO 230-4). In the volumetric trials the tool tip goes over a
body diagonal (ISO 230-6), and over a turn or swing of each rotary axis; it is looked at where the axes stand, and axes
that do not move stand off the middle, so that all errors act.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..engine import Array, Course, Limits, Setpoints, move
from ..interface import identifier
from ..kinds import KIND_NAMES, KINDS, Crosstalk, Plane
from ..model import LINEAR, Axis, Machine

Cycles = npt.NDArray[np.intp]

STOPS = 12
SETTLING = 0.06
"""Standing still before a position is read, s."""
APPROACH = 1.0
"""Shortest way to a stop, mm or °."""
RAPID = Limits(300.0, 2000.0, 5e4)
RADIUS, FEED = 25.0, 50.0
"""Of the circle, mm and mm/s (° and °/s)."""
CREEP = 20.0
"""Velocity of the slave in the crosstalk trial, mm/s."""
SLOW, FAST = 60.0, 260.0
"""Speeds of the master in the crosstalk trial, mm/s."""
LATENCY = 2
"""Cycles by which the drives' reference, the mean of two setpoints, lags the raw setpoint in the coupled FMUs."""

TOOL_LENGTH = 120.0
"""Of the volumetric trials, mm."""
ASIDE = 0.65
"""Where axes stand that do not move, as a share of their range."""
STOPS_OF_TURN = 24
STANDSTILL = 0.2
"""Before the tip is looked at, s: a linear axis that only follows its correction sticks for a while."""
TURNING = Limits(180.0, 1500.0, 4e4)

VOLUMETRIC = "volumetric"
TCP = "TCP"

GEOMETRIC = tuple(kind for kind in KINDS if kind != "friction")


@dataclass(frozen=True)
class Trial:
    """A motion that shows the error of some axes.

    ``kind``: the compensation it is about; ``all``: all geometric ones together. ``setpoints``: what the controller
    commands each axis, by its name. ``watched``: the cycles at which the error of an axis counts, or that of the tool
    tip (``TCP``). ``moving``: the axes that a volumetric trial moves.
    """

    kind: str
    setpoints: Mapping[str, Setpoints]
    watched: Mapping[str, Cycles]
    moving: tuple[str, ...] = ()

    @property
    def off(self) -> tuple[str, ...]:
        """The compensations that are off in the run *without*."""
        return KIND_NAMES if self.kind == "all" else (self.kind,)

    @property
    def never_on(self) -> tuple[str, ...]:
        """Those that are off in both: what moves the tool tip where it should be moves an axis away from its target."""
        return () if self.kind == VOLUMETRIC else (VOLUMETRIC,)

    def target(self, axis: str) -> Array:
        """Return where an axis should be at the end of each cycle, shape (cycles,): its raw setpoint, delayed."""
        raw = self.setpoints[axis].position
        late = np.concatenate([np.repeat(raw[:1], LATENCY), raw])
        target: Array = 0.5 * (late[: len(raw)] + late[1 : len(raw) + 1])
        return target


def trials_of(machine: Machine, cycle_time: float) -> list[Trial]:
    """Return the trials of a machine; a kind that no axis has is left out."""
    stage = Stage(machine, cycle_time)
    made = [*stage.positioning()]
    for axis in machine.axes:
        if axis.cross is not None:
            made.append(stage.sag(axis))
        if axis.plane is not None:
            made.append(stage.plane(axis))
        if axis.crosstalk is not None:
            made.append(stage.crosstalk(axis))
    return [*made, *stage.circles()]


class Stage:
    """The working space of a machine, and the trials in it."""

    def __init__(self, machine: Machine, cycle_time: float) -> None:
        self.machine = machine
        self.cycle_time = cycle_time
        self.names = {axis.number: name_of(axis) for axis in machine.axes}
        self.spans = {name_of(axis): self._span(axis) for axis in machine.axes}
        self.middle = {name: 0.5 * (low + high) for name, (low, high) in self.spans.items()}

    def axis(self, name: str) -> Axis:
        """Return an axis by its name in the FMUs' variables."""
        return next(axis for axis in self.machine.axes if name_of(axis) == name)

    def positioning(self) -> Iterator[Trial]:
        """All axes along the diagonal of the working space, forth and back: once for the leadscrews, once for all."""
        low = {name: span[0] for name, span in self.spans.items()}
        course = Course({name: q - APPROACH for name, q in low.items()}, self.cycle_time)
        # A share of the step inside the ends, so that the stops fall between the points of the tables.
        shares = (np.arange(STOPS) + 0.37) / STOPS
        stops = []
        for share in (*shares, 1.0, *shares[::-1]):
            turn = APPROACH if share == 1.0 else 0.0
            course.move({name: a + share * (b - a) + turn for name, (a, b) in self.spans.items()}, RAPID)
            if not turn:
                stops.append(settle(course))
        watched = np.array(stops)
        setpoints = course.setpoints()
        for kind in ("leadscrew", "all"):
            kinds = GEOMETRIC if kind == "all" else (kind,)
            axes = [a for a in self.machine.axes if any(getattr(a, k) is not None for k in kinds)]
            if axes:
                yield Trial(kind, setpoints, {name_of(a): watched for a in axes})

    def sag(self, slave: Axis) -> Trial:
        """Return the trial of a cross compensation: the master stop by stop over its table."""
        assert slave.cross is not None
        master = self.names[slave.cross.master]
        low, high = slave.cross.positions[0], slave.cross.positions[-1]
        shares = (np.arange(STOPS) + 0.37) / STOPS
        return self._stop_by_stop("cross", slave, [{master: low + s * (high - low)} for s in shares])

    def plane(self, slave: Axis) -> Trial:
        """Return the trial of a plane compensation: both masters stop by stop, in meander lines over the grid."""
        plane = slave.plane
        assert plane is not None
        first, second = self.names[plane.master1], self.names[plane.master2]
        stops = []
        for row in range(4):
            for column in range(5) if row % 2 == 0 else range(4, -1, -1):
                share1, share2 = (column + 0.37) / 5.0, (row + 0.61) / 4.0
                stops.append(
                    {first: plane.start1 + share1 * _length1(plane), second: plane.start2 + share2 * _length2(plane)}
                )
        return self._stop_by_stop("plane", slave, stops)

    def crosstalk(self, slave: Axis) -> Trial:
        """Return the trial of a crosstalk compensation: the master gets faster and slower, forth and back."""
        assert slave.crosstalk is not None
        master, name = self.names[slave.crosstalk.master], name_of(slave)
        tested = slave.crosstalk
        most = tested.acceleration if isinstance(tested, Crosstalk) else max(map(abs, tested.accelerations))
        change = Limits(0.8 * most, 2e4, 2e6)  # of the speed: acceleration, jerk, and change of the jerk
        # Wait for the slave to get up to its speed.
        speeds = [np.zeros(round(0.2 / self.cycle_time))]
        for sign in (1.0, -1.0):
            pairs = [(0.0, SLOW), *((SLOW, FAST), (FAST, SLOW)) * 3, (SLOW, 0.0)]
            speeds += [sign * move(before, after, self.cycle_time, change) for before, after in pairs]
        speed = np.concatenate(speeds)
        way = self.cycle_time * np.cumsum(speed)
        creep = move(0.0, CREEP * (len(way) * self.cycle_time + 0.2), self.cycle_time, Limits(CREEP, 400.0, 8000.0))
        start = {**self.middle, name: self.middle[name] - 0.5 * creep[-1]}
        start[master] -= 0.5 * float(way.max())
        course = Course(start, self.cycle_time)
        course.follow({master: start[master] + way, name: start[name] + creep})
        course.dwell(SETTLING)
        moving = np.flatnonzero(np.abs(speed) > 0.99 * SLOW) + 1 + LATENCY
        return Trial("crosstalk", course.setpoints(), {name: moving})

    def circles(self) -> Iterator[Trial]:
        """Yield circles in which every axis with friction compensation reverses; a single axis goes to and fro."""
        left = [name_of(axis) for axis in self.machine.axes if axis.friction is not None]
        done: list[str] = []
        while left:
            watched, left = left[:2], left[2:]
            yield self._circle(watched, (watched + done)[:2])
            done += watched

    def _circle(self, watched: Sequence[str], axes: Sequence[str]) -> Trial:
        rate = FEED / RADIUS
        angle = move(0.0, 4.25 * np.pi, self.cycle_time, Limits(rate, 4.0 * rate, 40.0 * rate))
        shapes = dict(zip(axes, (RADIUS * np.cos(angle), RADIUS * np.sin(angle)), strict=False))
        course = Course({**self.middle, axes[0]: self.middle[axes[0]] + RADIUS}, self.cycle_time)
        course.follow({name: self.middle[name] + shape for name, shape in shapes.items()})
        course.dwell(SETTLING)
        # One turn, after half a turn to get up to speed.
        turn = np.flatnonzero((angle > 1.1 * np.pi) & (angle < 3.1 * np.pi)) + 1 + LATENCY
        return Trial("friction", course.setpoints(), dict.fromkeys(watched, turn))

    def _stop_by_stop(self, kind: str, slave: Axis, stops: Sequence[Mapping[str, float]]) -> Trial:
        """Return a trial in which the slave comes to each stop of its masters from the same side."""
        name = name_of(slave)
        at = self.middle[name]
        start = {**self.middle, **stops[0], name: at - APPROACH}
        course = Course(start, self.cycle_time)
        read = []
        for stop in stops:
            course.move({**stop, name: at - APPROACH}, RAPID)
            course.move({name: at}, RAPID)
            read.append(settle(course))
        return Trial(kind, course.setpoints(), {name: np.array(read)})

    def _span(self, axis: Axis) -> tuple[float, float]:
        """Return the range of positions in which the tables know the axis."""
        if axis.leadscrew is not None:
            return axis.leadscrew.positions[0], axis.leadscrew.positions[-1]
        for other in self.machine.axes:
            cross, plane = other.cross, other.plane
            if cross is not None and cross.master == axis.number:
                return cross.positions[0], cross.positions[-1]
            if plane is not None and plane.master1 == axis.number:
                return plane.start1, plane.start1 + _length1(plane)
            if plane is not None and plane.master2 == axis.number:
                return plane.start2, plane.start2 + _length2(plane)
        for volumetric in self.machine.volumetric:
            letters = [letter for letter, number in volumetric.axes if number == axis.number]
            for error in volumetric.errors:
                if letters and letters[0] in error.arguments:
                    along = [node[error.arguments.index(letters[0])] for node in error.nodes]
                    return min(along), max(along)
        return -100.0, 100.0


def volumetric_trials(machine: Machine, cycle_time: float) -> Iterator[Trial]:
    """Yield the trials of a machine; none if it has no volumetric compensation."""
    stage = Stage(machine, cycle_time)
    taking_part = {number: letter for v in machine.volumetric for letter, number in v.axes if letter in v.chain}
    axes = [axis for axis in machine.axes if axis.number in taking_part]
    linear = [axis for axis in axes if taking_part[axis.number] in LINEAR]
    if linear:
        yield _standing(stage, linear, STOPS, RAPID)
    for axis in axes:
        if axis not in linear:
            # A full turn ends where it began: the seam of the tables lies in between.
            yield _standing(stage, [axis], STOPS_OF_TURN, TURNING, closed=axis.modulo is not None)


def _standing(stage: Stage, axes: Sequence[Axis], stops: int, limits: Limits, *, closed: bool = False) -> Trial:
    """Return the trial in which axes go together from one end of their ranges to the other, stop by stop."""
    moving = tuple(name_of(axis) for axis in axes)
    # A share of the step inside the ends, so that the stops fall between the points of the tables.
    targets = [_at(stage, moving, (stop + 0.37) / stops) for stop in range(stops + closed)]
    course = Course({**_at(stage, stage.spans, ASIDE), **targets[0]}, stage.cycle_time)
    read = []
    for target in targets:
        course.move(target, limits)
        read.append(settle(course, STANDSTILL))
    return Trial(VOLUMETRIC, course.setpoints(), {TCP: np.array(read)}, moving)


def _at(stage: Stage, names: Sequence[str] | Mapping[str, object], share: float) -> dict[str, float]:
    return {name: low + share * (high - low) for name, (low, high) in stage.spans.items() if name in names}


def settle(course: Course, duration: float = SETTLING) -> int:
    """Let the axes settle and return the cycle to read them in; in the one after it velocities begin to rise again."""
    return course.dwell(duration) - 2


def _length1(plane: Plane) -> float:
    return plane.interval1 * (len(plane.corrections[0]) - 1)


def _length2(plane: Plane) -> float:
    return plane.interval2 * (len(plane.corrections) - 1)


def name_of(axis: Axis) -> str:
    """Return the name of an axis in the FMUs' variables."""
    return identifier(axis.name) or f"axis{axis.number}"
