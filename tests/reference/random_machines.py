"""Machines, motions and events by chance: what a controller could be asked to do, from one seed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from axis_reference import ALL_KINDS, Row
from numpy.typing import NDArray

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

CYCLE_TIME = 1e-3


@dataclass
class Course:
    """Motion of one axis, cycle by cycle."""

    setpoint: NDArray[np.float64]
    velocity: NDArray[np.float64]
    acceleration: NDArray[np.float64]


def _chance(rng: np.random.Generator, share: float = 0.5) -> bool:
    return bool(rng.random() < share)


def _floats(values: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(values.tolist())


def _ascending(rng: np.random.Generator, count: int, span: float) -> tuple[float, ...]:
    """Return points over a span about 0, not too close."""
    steps = rng.uniform(0.5, 1.5, count)
    points = np.cumsum(steps)
    return _floats((points - points[0]) / (points[-1] - points[0] + 1e-9) * span - 0.5 * span + rng.uniform(-30, 30))


def _values(rng: np.random.Generator, count: int, largest: float = 0.05) -> tuple[float, ...]:
    return _floats(rng.uniform(-largest, largest, count))


def _switching(rng: np.random.Generator) -> dict[str, Any]:
    cycles = int(rng.choice([0, 1, 2, 5, 20]))
    return {"n_cycles": cycles, "manual_activation": _chance(rng, 0.3)}


def leadscrew(rng: np.random.Generator, modulo: ModuloRange | None) -> Leadscrew:
    """Draw a table over half or a whole turn, or the travel."""
    count = int(rng.integers(2, 9))
    repeats = modulo is not None and _chance(rng, 0.7)
    whole = repeats and _chance(rng)
    if whole:
        start = float(rng.choice([0.0, -180.0, 10.0]))
        positions: tuple[float, ...] = _floats(start + np.linspace(0.0, 360.0, count))
    else:
        positions = _ascending(rng, count, float(rng.uniform(50.0, 330.0)))
    positive = _values(rng, count)
    return Leadscrew(
        positions,
        positive,
        _values(rng, count) if _chance(rng, 0.7) else None,
        modulo=repeats,
        without_other_compensations=_chance(rng, 0.3),
        manual_activation=_chance(rng, 0.3),
    )


def cross(rng: np.random.Generator, others: list[int]) -> Cross:
    """Draw a cross compensation."""
    count = int(rng.integers(1, 9))
    points = _ascending(rng, count, float(rng.uniform(20.0, 330.0)))
    return Cross(int(rng.choice(others)), points, _values(rng, count, 0.2), **_switching(rng))


def plane(rng: np.random.Generator, others: list[int]) -> Plane:
    """Draw a plane compensation."""
    rows, columns = int(rng.integers(1, 5)), int(rng.integers(1, 5))
    start = rng.uniform(-120.0, 0.0, 2).tolist()
    intervals = rng.uniform(5.0, 70.0, 2).tolist()
    table = tuple(_values(rng, columns) for _ in range(rows))
    first, second = (int(rng.choice(others)) for _ in range(2))
    return Plane(first, second, *start, *intervals, table, **_switching(rng))


def crosstalk(rng: np.random.Generator, masters: list[int], others: list[int]) -> Crosstalk | CrosstalkCurve:
    """Draw a crosstalk compensation: the old variant, or the new one in all its modes, on grids and scattered."""
    master = int(rng.choice(masters))
    if _chance(rng, 0.3):
        points = _floats(np.cumsum(rng.uniform(100.0, 2000.0, int(rng.integers(1, 6)))) - 3000.0)
        return CrosstalkCurve(master, points, _values(rng, len(points)), **_switching(rng))
    mode = int(rng.integers(1, 4))
    if mode == 1:
        places = [(0.0, 0.0)]
    elif mode == 2:
        places = [(x, 0.0) for x in rng.permutation(_ascending(rng, int(rng.integers(2, 6)), 200.0)).tolist()]
    elif _chance(rng):
        places = [(a, b) for a in _ascending(rng, 3, 150.0) for b in _ascending(rng, 2, 250.0)]
    else:
        angles = np.cumsum(rng.uniform(0.7, 1.2, 5))
        radii = rng.uniform(40.0, 150.0, 5)
        places = list(zip((radii * np.cos(angles)).tolist(), (radii * np.sin(angles)).tolist(), strict=True))
    tests = tuple(CrosstalkTest(a, b, *_values(rng, 4)) for a, b in places)
    adaptation = [int(rng.choice(others)) if mode > n else None for n in (1, 2)]
    limits = (float(rng.uniform(500.0, 5000.0)), -float(rng.uniform(500.0, 5000.0)))
    return Crosstalk(master, *limits, mode, tests, *adaptation, _chance(rng), **_switching(rng))


def friction(rng: np.random.Generator, *, turning: bool) -> Friction:
    """Draw a friction compensation, its look-ahead in the delay line or not."""
    count = int(rng.integers(1, 6))
    velocities = _floats(np.cumsum(rng.uniform(0.5, 40.0, count)) - 0.5 * _chance(rng))
    build_up = float(rng.uniform(0.5, 9.0) if turning else rng.uniform(0.05, 3.0)) * _chance(rng, 0.7)
    lookahead, delay = int(rng.integers(0, 5)), int(rng.choice([0, 1, 2, 3, 4, 9, 60]))
    return Friction(velocities, _values(rng, count, 5.0), float(rng.uniform(-1, 2)), build_up, lookahead, delay)


def temperature(rng: np.random.Generator) -> Temperature:
    """Draw a temperature compensation."""
    position, offset = float(rng.uniform(-200.0, 200.0)), float(rng.uniform(-0.1, 0.1))
    return Temperature(position, offset, float(rng.uniform(-1e-4, 1e-4)), int(rng.integers(1, 21)))


def axis(rng: np.random.Generator, number: int, numbers: list[int], straight: list[int]) -> Axis:
    """Draw an axis with several compensations."""
    turning = number not in straight
    start = float(rng.choice([0.0, -180.0]))
    modulo = ModuloRange(start, start + 360.0) if turning and _chance(rng, 0.8) else None
    makers = {
        "leadscrew": lambda: leadscrew(rng, modulo),
        "cross": lambda: cross(rng, numbers),
        "plane": lambda: plane(rng, numbers),
        "crosstalk": lambda: None if turning else crosstalk(rng, straight, numbers),
        "friction": lambda: friction(rng, turning=turning),
        "temperature": lambda: temperature(rng),
        "backlash": lambda: Backlash(float(rng.uniform(-0.05, 0.05)), int(rng.integers(1, 3))),
    }
    drawn = {kind: make() for kind, make in makers.items() if _chance(rng, 0.6)}
    kind = AxisType.ROTARY if turning else AxisType.TRANSLATORY
    cycles = int(rng.choice([0, 1, 3, 12, 20]))
    return Axis(number, f"axis{number}", kind, modulo, cycles, **drawn)


def machine(rng: np.random.Generator) -> Machine:
    """Draw a machine of two to four axes; where there are three, the last one turns."""
    count = int(rng.integers(2, 5))
    numbers = sorted(rng.choice(np.arange(1, 40), count, replace=False).tolist())
    straight = numbers[:-1] if count > 2 else numbers
    return Machine(tuple(axis(rng, number, numbers, straight) for number in numbers))


def updated(rng: np.random.Generator, first: Machine) -> Machine:
    """Draw other lists for a machine: those of its start, with tables dropped, drawn anew, or switched otherwise."""
    numbers = [one.number for one in first.axes]
    straight = [one.number for one in first.axes if one.type is AxisType.TRANSLATORY]
    axes = []
    for one in first.axes:
        kinds = {old.kind: _updated(rng, old, one, numbers, straight) for old in one.compensations}
        cycles = int(rng.choice([one.backlash_cycles, 0, 7, 20]))
        axes.append(replace(one, backlash_cycles=cycles, **kinds))
    return Machine(tuple(axes))


def _updated(rng: np.random.Generator, old: Any, of: Axis, numbers: list[int], straight: list[int]) -> Any:
    choice = rng.choice(["same", "drop", "cycles", "other", "size"], p=[0.3, 0.1, 0.2, 0.35, 0.05])
    if choice == "size" and hasattr(old, "max_points"):
        return replace(old, max_points=(old.max_points or 10201) + 1)
    if choice == "drop" and not old.manual_activation:
        return None
    if choice == "cycles" and hasattr(old, "n_cycles") and not isinstance(old, (Leadscrew, Friction, Backlash)):
        return replace(old, n_cycles=int(rng.integers(1, 21)))
    if choice != "other":
        return old
    if isinstance(old, Friction):
        build_up = float(rng.uniform(0.5, 3.0))
        currents = tuple(1.5 * current for current in old.currents)
        return replace(old, currents=currents, scaling=float(rng.uniform(-1, 2)), position_delay=build_up)
    makers = {
        "leadscrew": lambda: leadscrew(rng, of.modulo),
        "cross": lambda: cross(rng, numbers),
        "plane": lambda: plane(rng, numbers),
        "crosstalk": lambda: crosstalk(rng, straight, numbers),
        "temperature": lambda: temperature(rng),
        "backlash": lambda: Backlash(float(rng.uniform(-0.05, 0.05)), int(rng.integers(1, 3))),
    }
    return makers[old.kind]()


def course(rng: np.random.Generator, cycles: int, of: Axis) -> Course:
    """Draw a motion: strokes that stop, swings that reverse, jogs without ramp, creeping, and standstill."""
    reach = 500.0 if of.modulo else 160.0
    parts: list[NDArray[np.float64]] = []
    at, total = float(rng.uniform(-100.0, 100.0)), 0
    while total < cycles:
        n = int(rng.integers(2, 90))
        k = np.arange(1, n + 1)
        choice = rng.choice(["stand", "stroke", "swing", "jog", "creep"], p=[0.3, 0.35, 0.15, 0.15, 0.05])
        if choice == "stroke":
            way, x = float(rng.uniform(-reach, reach)) - at, math.pi / n
            s, v, a = (
                at + way * 0.5 * (1 - np.cos(x * k)),
                way * 0.5 * x * np.sin(x * k),
                way * 0.5 * x * x * np.cos(x * k),
            )
        elif choice == "swing":
            size, x = float(rng.uniform(-20.0, 20.0)), float(rng.uniform(0.03, 0.9))
            s, v, a = at + size * np.sin(x * k), size * x * np.cos(x * k), -size * x * x * np.sin(x * k)
        elif choice == "jog":
            step = float(rng.choice([-1.0, 1.0]) * np.exp(rng.uniform(-9.0, 0.0)))
            s, v, a = at + step * k, np.full(n, step), np.zeros(n)
        elif choice == "creep":
            s, v, a = at + float(rng.choice([-3.1e-10, 3.3e-10])) * k, np.zeros(n), np.zeros(n)
        else:
            # What rounding leaves is no motion.
            s, v, a = np.full(n, at), rng.choice([0.0, 1e-18, -1e-18], n), np.zeros(n)
        parts.append(np.stack([s, v / CYCLE_TIME, a / CYCLE_TIME**2]))
        at, total = float(s[-1]), total + n
    s, v, a = np.concatenate(parts, axis=1)[:, :cycles]
    if of.modulo and _chance(rng):
        s = of.modulo.start + (s - of.modulo.start) % of.modulo.length
    return Course(s, v, a)


def held(rng: np.random.Generator, cycles: int, share: float, *, long: float = 40.0) -> NDArray[np.bool_]:
    """Draw a flag that is true for about a share of the time and changes every ``long`` cycles or so."""
    lengths = rng.integers(1, int(2 * long), cycles)
    blocks = np.repeat(rng.random(cycles) < share, lengths)
    return blocks[:cycles]


def rows(rng: np.random.Generator, cycles: int, of: Axis) -> list[Row]:
    """Draw everything one axis gets."""
    moved = course(rng, cycles, of)
    switch = {kind: np.select([held(rng, cycles, 0.5), held(rng, cycles, 0.5)], [0, 1], -1) for kind in ALL_KINDS}
    shares = {"unreferenced": 0.15, "fault": 0.05, "no_move": 0.3}
    flags = {name: held(rng, cycles, share) for name, share in shares.items()}
    flags["released"] = held(rng, cycles, 0.1, long=15.0)
    offset = 0.02 * np.cumsum(rng.random(cycles) < 0.02)
    coefficient = np.where(held(rng, cycles, 0.5), 0.0, 2e-5)
    known = _chance(rng)
    ahead = np.concatenate([moved.velocity, np.full(4, moved.velocity[-1])])
    noise = rng.normal(0.0, 1e-3, cycles)
    return [
        Row(
            float(moved.setpoint[k]),
            float(moved.velocity[k]),
            float(moved.acceleration[k]),
            float(moved.setpoint[k] + noise[k]),
            **{name: bool(column[k]) for name, column in flags.items()},
            switch={kind: int(column[k]) for kind, column in switch.items()},
            offset=float(offset[k]),
            coefficient=float(coefficient[k]),
            ahead_known=known,
            velocity_ahead=_floats(ahead[k + 1 : k + 5]),
        )
        for k in range(cycles)
    ]
