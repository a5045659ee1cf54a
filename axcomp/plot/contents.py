"""The compensations of a machine's axes as contents: curves and maps with what they mean and their units."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ..convert.machines import tables_of
from ..convert.table import closed
from ..kernel.crosstalk import CrosstalkState, crosstalk_value
from ..kernel.motion import Motion
from ..kernel.record import zero
from ..kinds import KINDS
from ..kinds.crosstalk import Crosstalk, CrosstalkCurve
from ..kinds.friction import Friction
from ..kinds.plane import Plane
from ..model.machine import Axis, Machine
from ..runtime.compile import compile_tables
from .content import Content, Subject
from .curves import Array, Curves, Line, Quantity
from .maps import Map

PER_MILLE = 1e3
"""mm to µm, ° to m°."""
BEYOND_TESTS = 1.3
"""How far beyond the acceleration of the tests a crosstalk curve is drawn, where it is held."""
SAMPLES = 61
"""Places along each side of a map that is given by scattered tests."""

POSITIVE, NEGATIVE = "positive motion", "negative motion"


def contents_of(machine: Machine, axis: str | None = None, kind: str | None = None) -> list[Content]:
    """Return what there is to show of the axes' compensations, axis by axis in the order of a cycle.

    Parameters
    ----------
    machine : Machine
        With every master its compensations name.
    axis, kind : str or None
        Only of this axis, only of this kind.
    """
    found: list[Content] = []
    for one in machine.axes:
        for name in KINDS:
            compensation = getattr(one, name)
            if compensation is None or axis not in {None, one.name} or kind not in {None, name}:
                continue
            if name in {"leadscrew", "cross"}:
                found.append(_curves_over_axis(machine, one, name))
            elif isinstance(compensation, Plane):
                found.append(_plane(machine, one, compensation))
            elif isinstance(compensation, Friction):
                found.append(_friction(one, compensation))
            elif isinstance(compensation, CrosstalkCurve):
                found.append(_crosstalk_curve(machine, one, compensation))
            else:
                found += _crosstalk(machine, one, compensation)
    return found


def position_of(axis: Axis) -> Quantity:
    """Return the position of an axis with its unit."""
    return Quantity(f"position of {axis.name}", "mm" if axis.unit == "mm" else "°")


def correction_of(axis: Axis, name: str = "correction") -> Quantity:
    """Return a correction of an axis with the unit it is shown in."""
    return Quantity(f"{name} of {axis.name}", "µm" if axis.unit == "mm" else "m°")


def _axis(machine: Machine, number: int) -> Axis:
    return machine.axes[machine.index_of(number)]


def _curves_over_axis(machine: Machine, axis: Axis, kind: str) -> Curves:
    """Leadscrew values are shown as they stand in the list, actual − programmed; cross values are added."""
    [table] = tables_of(machine, axis.name, kind)
    table = closed(table)
    sign = -1.0 if kind == "leadscrew" else 1.0
    x = np.array(table.positions)
    directions = ((POSITIVE, 1), (NEGATIVE, -1)) if table.negative is not None else (("both directions", 1),)
    return Curves(
        Subject(axis.name, kind),
        position_of(machine.axis(table.over)),
        correction_of(axis, "actual − programmed position" if kind == "leadscrew" else "correction"),
        tuple(
            Line(name, x, sign * PER_MILLE * np.array(table.curve(direction)) + 0.0, table.period)
            for name, direction in directions
        ),
        reversal=table.negative is not None,
        note="repeats" if table.period is not None else "",
    )


def _plane(machine: Machine, axis: Axis, plane: Plane) -> Map:
    values = PER_MILLE * np.array(plane.corrections)
    across: Array = plane.start1 + plane.interval1 * np.arange(float(values.shape[1]))
    up: Array = plane.start2 + plane.interval2 * np.arange(float(values.shape[0]))

    def at(x: Array, y: Array) -> Array:
        # A side of one point is a constant along it.
        x_index = np.interp(x, across, np.arange(len(across)))
        y_index = np.interp(y, up, np.arange(len(up)))
        wide = np.pad(values, ((0, int(len(up) == 1)), (0, int(len(across) == 1))), mode="edge")
        grid = (np.arange(wide.shape[0]), np.arange(wide.shape[1]))
        bilinear = RegularGridInterpolator(grid, wide)
        found: Array = bilinear(np.stack(np.meshgrid(y_index, x_index, indexing="ij"), axis=-1))
        return found[np.newaxis]

    return Map(
        Subject(axis.name, "plane"),
        position_of(_axis(machine, plane.master1)),
        position_of(_axis(machine, plane.master2)),
        correction_of(axis),
        across,
        up,
        ("",),
        at,
        np.empty((0, 2)),
    )


def _friction(axis: Axis, friction: Friction) -> Curves:
    unit = "mm/s" if axis.unit == "mm" else "°/s"
    currents = friction.scaling * np.array(friction.currents)
    builds_up = f", builds up over {friction.position_delay:g} {'mm' if axis.unit == 'mm' else '°'}"
    return Curves(
        Subject(axis.name, "friction"),
        Quantity(f"speed of {axis.name}", unit),
        Quantity("added current", "drive units"),
        (Line("current", np.array(friction.velocities), currents),),
        logarithmic=True,
        note=f"scaled by {friction.scaling:g}{builds_up if friction.position_delay else ''}",
    )


def _crosstalk_curve(machine: Machine, axis: Axis, crosstalk: CrosstalkCurve) -> Curves:
    values = PER_MILLE * np.array(crosstalk.corrections)
    return Curves(
        Subject(axis.name, "crosstalk"),
        Quantity(f"acceleration of {_axis(machine, crosstalk.master).name}", "mm/s²"),
        correction_of(axis),
        (Line("correction", np.array(crosstalk.accelerations), values),),
    )


def _crosstalk(machine: Machine, axis: Axis, crosstalk: Crosstalk) -> Iterator[Content]:
    master = _axis(machine, crosstalk.master)
    directions = ((POSITIVE, 1), (NEGATIVE, -1)) if crosstalk.velocity_dependent else (("", 1),)
    correction = correction_of(axis)
    if crosstalk.mode == 1:
        shares = (BEYOND_TESTS, 1.0)
        x = np.array(
            [share * crosstalk.deceleration for share in shares]
            + [0.0]
            + [share * crosstalk.acceleration for share in reversed(shares)]
        )
        lines = [Line(name or "correction", x, _sampled(machine, axis, x, direction)) for name, direction in directions]
        acceleration = Quantity(f"acceleration of {master.name}", "mm/s²")
        yield Curves(Subject(axis.name, "crosstalk"), acceleration, correction, tuple(lines))
        return
    assert crosstalk.adaptation1 is not None
    first = _axis(machine, crosstalk.adaptation1)
    limits = (crosstalk.acceleration, crosstalk.deceleration)
    layers = [
        (", ".join(word for word in (f"{limit:+g} mm/s²", name) if word), limit, direction)
        for limit in limits
        for name, direction in directions
    ]
    note = f"acceleration of {master.name}: {limits[0]:g} and {limits[1]:g} mm/s²"
    x = np.unique([test.position1 for test in crosstalk.tests])
    if crosstalk.mode == 2:
        lines = [
            Line(name, x, _sampled(machine, axis, np.full(len(x), a), direction, x)) for name, a, direction in layers
        ]
        yield Curves(Subject(axis.name, "crosstalk"), position_of(first), correction, tuple(lines), note=note)
        return
    assert crosstalk.adaptation2 is not None
    points = np.array([(test.position1, test.position2) for test in crosstalk.tests])

    def at(across: Array, up: Array) -> Array:
        p, q = np.meshgrid(across, up)
        return np.stack(
            [
                _sampled(machine, axis, np.full(p.size, a), direction, p.ravel(), q.ravel()).reshape(p.shape)
                for _, a, direction in layers
            ]
        )

    yield Map(
        Subject(axis.name, "crosstalk"),
        position_of(first),
        position_of(_axis(machine, crosstalk.adaptation2)),
        correction,
        np.union1d(x, np.linspace(x[0], x[-1], SAMPLES)),
        np.union1d(points[:, 1], np.linspace(points[:, 1].min(), points[:, 1].max(), SAMPLES)),
        tuple(name for name, _, _ in layers),
        at,
        points,
        note,
    )


def _sampled(
    machine: Machine,
    axis: Axis,
    accelerations: Array,
    direction: int,
    first: Array | None = None,
    second: Array | None = None,
) -> Array:
    """Return what the kernel adds in µm or m° while the master accelerates at places of the adaptation axes."""
    # What else the axes have would only cost time.
    axes = tuple(Axis(one.number, one.name, crosstalk=axis.crosstalk if one == axis else None) for one in machine.axes)
    tables, pool = compile_tables(Machine(axes))
    table = tables.axis[machine.index_of(axis.number)].compensation.crosstalk
    nowhere = np.zeros(len(accelerations))
    places = zip(
        accelerations.tolist(),
        (nowhere if first is None else first).tolist(),
        (nowhere if second is None else second).tolist(),
        strict=True,
    )
    state = zero(CrosstalkState)
    motion = zero(Motion)
    found = []
    for acceleration, position1, position2 in places:
        motion.axis[table.adaptation1.axis].setpoint = position1
        motion.axis[table.adaptation2.axis].setpoint = position2
        motion.axis[table.master].acceleration = acceleration
        motion.axis[table.master].direction = direction
        found.append(crosstalk_value(pool, table, state, motion))
    return PER_MILLE * np.array(found)
