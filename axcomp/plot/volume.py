"""Volumetric compensations as contents: errors over their axes, constant errors, TCP error over the work volume.

What is drawn comes from the kernel's interpolation and model, so it is what the machine corrects.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..engine.tcp_model import TcpModel
from ..model.curve import Curve
from ..model.machine import Machine
from ..model.quantity import Quantity, shown
from ..model.volumetric import ERRORS, LETTERS, LINEAR, ROTARY, ErrorTable, Volumetric, is_angle
from .bars import Bars
from .content import Content, Subject
from .curves import Array, Curves
from .field import Field
from .maps import Layer, Map

SAMPLES = 41
"""Places along each side of a map."""
ARROWS = 4
"""Arrows along each side of the work volume."""
TURNED = 73
"""Places of a rotary axis at which the TCP error is taken."""


def volumetric_contents(machine: Machine, axis: str | None = None, tool_length: float = 0.0) -> list[Content]:
    """Return what there is to show of the volumetric compensations.

    Parameters
    ----------
    machine : Machine
        With the axes of its compensations.
    axis : str or None
        Only the errors of the axis with this name, and not the TCP error.
    tool_length : float
        For the TCP error, mm.
    """
    found: list[Content] = []
    for volumetric in machine.volumetric:
        names = _names(machine, volumetric)
        model = TcpModel(volumetric)
        for letter in LETTERS:
            if letter in names and axis in {None, names[letter]}:
                found += _errors_of_axis(volumetric, model, letter, names)
        if axis is None:
            found += _constants(volumetric)
            field = tcp_field(machine, volumetric, model, tool_length)
            turning = [a for a in ROTARY if any(a in table.arguments for table in volumetric.errors)]
            if field.largest() > 0.0 or not turning:
                found.append(field)
            found += [tcp_curves(machine, volumetric, model, letter, tool_length) for letter in turning]
    return found


def work_volume(machine: Machine, volumetric: Volumetric) -> dict[str, tuple[float, float]]:
    """Return the least and the largest position of each axis of a compensation, by letter, in mm or °.

    They are those of all error tables of the machine, for a compensation of the rotary axes has none over X, Y and Z;
    (0, 0) for an axis that is in no table.
    """
    places: dict[int, list[float]] = {}
    for one in machine.volumetric:
        numbers = dict(one.axes)
        for table in one.errors:
            for column, letter in enumerate(table.arguments):
                places.setdefault(numbers[letter], []).extend(node[column] for node in table.nodes)
    found = {letter: places.get(number, [0.0]) for letter, number in volumetric.axes}
    return {letter: (min(positions), max(positions)) for letter, positions in found.items()}


def tcp_field(machine: Machine, volumetric: Volumetric, model: TcpModel, tool_length: float = 0.0) -> Field:
    """Return the TCP error at a grid of places in the work volume, the rotary axes at 0 or as near as they get."""
    ranges = work_volume(machine, volumetric)
    sides = []
    for letter in LINEAR:
        low, high = ranges.get(letter, (0.0, 0.0))
        sides.append(np.linspace(low, high, ARROWS) if high > low else np.array([low]))
    grid = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, len(LINEAR))
    rotary = [float(np.clip(0.0, *ranges.get(letter, (0.0, 0.0)))) for letter in ROTARY]
    positions = np.column_stack([grid, np.tile(rotary, (len(grid), 1))])
    errors = model.errors_and_deviations(positions, tool_length)[1]
    subject = Subject(str(volumetric.index), "volumetric", "TCP error")
    return Field(subject, grid, shown("mm").factor * errors, _tool(tool_length))


def tcp_curves(
    machine: Machine, volumetric: Volumetric, model: TcpModel, letter: str, tool_length: float = 0.0
) -> Curves:
    """Return the TCP error while a rotary axis turns, the linear axes in the middle of the work volume."""
    ranges = work_volume(machine, volumetric)
    names = _names(machine, volumetric)
    place = [0.5 * sum(ranges.get(linear, (0.0, 0.0))) for linear in LINEAR]
    place += [float(np.clip(0.0, *ranges.get(rotary, (0.0, 0.0)))) for rotary in ROTARY]
    turned = np.linspace(*ranges[letter], TURNED)
    positions = np.tile(place, (len(turned), 1))
    positions[:, LETTERS.index(letter)] = turned
    of = Quantity("TCP error, actual − nominal", "mm")
    values = model.errors_and_deviations(positions, tool_length)[1]
    where = ", ".join(f"{names.get(linear, linear)} = {place[d]:g}" for d, linear in enumerate(LINEAR))
    return Curves(
        Subject(str(volumetric.index), "volumetric", f"TCP error over {names[letter]}"),
        tuple(
            _line(turned, column, _position(letter, names), of, f"along {linear}")
            for linear, column in zip(LINEAR, values.T, strict=True)
        ),
        note=", ".join(word for word in (where, _tool(tool_length)) if word),
    )


def _tool(length: float) -> str:
    return f"tool length {length:g} mm" if length else ""


def _names(machine: Machine, volumetric: Volumetric) -> dict[str, str]:
    return {letter: machine.axes[machine.index_of(number)].name for letter, number in volumetric.axes}


def _errors_of_axis(volumetric: Volumetric, model: TcpModel, letter: str, names: dict[str, str]) -> list[Content]:
    """Return the errors of one axis: curves by argument and unit, maps for those over several axes."""
    found: list[Content] = []
    tables = [table for table in volumetric.errors if table.name[-1] == letter and any(table.values)]
    for argument in LETTERS:
        for angular in (False, True):
            chosen = [t for t in tables if t.arguments == argument and is_angle(t.name) == angular]
            if chosen:
                found.append(_curves(volumetric, model, letter, argument, chosen, names))
    found += [_map(volumetric, model, table, names) for table in tables if len(table.arguments) > 1]
    return found


def _position(letter: str, names: dict[str, str]) -> Quantity:
    return Quantity("position", "°" if letter in ROTARY else "mm", names.get(letter, letter))


def _error(name: str, what: str = "error") -> Quantity:
    return Quantity(f"{what}, actual − nominal", "rad" if is_angle(name) else "mm")


def _line(x: Array, y: Array, over: Quantity, of: Quantity, label: str) -> Curve:
    return Curve(tuple(x.tolist()), tuple(y.tolist()), over, of, label=label).shown()


def _curves(
    volumetric: Volumetric,
    model: TcpModel,
    letter: str,
    argument: str,
    tables: Sequence[ErrorTable],
    names: dict[str, str],
) -> Curves:
    over, of = _position(argument, names), _error(tables[0].name)
    lines = []
    for table in tables:
        x = np.unique([node[0] for node in table.nodes])
        places = np.zeros((len(x), len(LETTERS)))
        places[:, LETTERS.index(argument)] = x
        lines.append(_line(x, model.known_errors(places)[:, ERRORS.index(table.name)], over, of, table.name))
    what = "angular errors" if is_angle(tables[0].name) else "linear errors"
    elsewhere = "" if argument == letter else f" over {argument}"
    subject = Subject(str(volumetric.index), "volumetric", f"{what} of {names.get(letter, letter)}{elsewhere}")
    return Curves(subject, tuple(lines), zero_if_absent=True)


def _map(volumetric: Volumetric, model: TcpModel, table: ErrorTable, names: dict[str, str]) -> Map:
    """Return one error over its first two axes, the others in the middle of their ranges."""
    first, second, *others = list(table.arguments)
    columns = {argument: [node[place] for node in table.nodes] for place, argument in enumerate(table.arguments)}
    middle = {argument: 0.5 * (min(columns[argument]) + max(columns[argument])) for argument in others}
    over, of = (_position(first, names), _position(second, names)), _error(table.name, table.name)

    def at(x: float, y: float) -> float:
        place = np.zeros((1, len(LETTERS)))
        for argument, position in (*middle.items(), (first, x), (second, y)):
            place[0, LETTERS.index(argument)] = position
        return of.factor * float(model.known_errors(place)[0, ERRORS.index(table.name)])

    x, y = (np.linspace(min(columns[argument]), max(columns[argument]), SAMPLES) for argument in (first, second))
    at_middle = ", ".join(f"{names.get(argument, argument)} = {position:g}" for argument, position in middle.items())
    return Map(
        Subject(str(volumetric.index), "volumetric", table.name),
        (Layer("", over, of.scaled(), at),),
        x,
        y,
        np.array(list(zip(columns[first], columns[second], strict=True))) if not others else np.empty((0, 2)),
        f"at {at_middle}" if at_middle else "",
    )


def _constants(volumetric: Volumetric) -> list[Content]:
    """Return the errors that do not depend on any position."""
    found: list[Content] = []
    for angular, what in ((False, "linear"), (True, "angular")):
        tables = [t for t in volumetric.errors if not t.arguments and is_angle(t.name) == angular]
        if tables:
            of = _error(tables[0].name)
            subject = Subject(str(volumetric.index), "volumetric", f"constant {what} errors")
            found.append(Bars(subject, of.scaled(), {table.name: of.factor * table.values[0] for table in tables}))
    return found
