"""What there is to show of a machine: its tables, and its volumetric errors with what they do to the tool tip.

Volumetric errors and the TCP error come from the kernel's interpolation and model, so they are what the machine
corrects.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..engine import TcpModel
from ..kinds import SPEED, Tables, tables_of
from ..model import (
    ERRORS,
    LETTERS,
    LINEAR,
    ROTARY,
    Curve,
    ErrorTable,
    Grid,
    Machine,
    Quantity,
    Scatter,
    Volumetric,
    is_angle,
    shown,
)
from .bars import Bars
from .content import VOLUMETRIC, Content, Subject
from .curves import Curves
from .field import Field
from .maps import Layer, Map
from .style import Array

SAMPLES_SCATTERED = 31
"""Samples along each side of a map that is given by scattered tests."""
SAMPLES = 41
"""Samples along each side of a map of volumetric errors."""
ARROWS = 4
"""Arrows along each side of the work volume."""
TURNED = 73
"""Positions of a rotary axis at which the TCP error is taken."""


def contents_of(
    machine: Machine, axis: str | None = None, kind: str | None = None, tool_length: float = 0.0
) -> list[Content]:
    """Return what there is to show: axis by axis in the order of a cycle, then the volumetric compensations.

    ``axis``: only of the axis with this name, which leaves the TCP error out; ``kind``: only of this kind, or
    ``VOLUMETRIC``; ``tool_length``: for the TCP error, mm. The machine has every master its compensations name.
    """
    found = [_content(tables) for tables in tables_of(machine, axis, kind)]
    if kind in {None, VOLUMETRIC}:
        for one in machine.volumetric:
            found += _VolumetricContents(machine, one, tool_length).all(axis)
    return found


def _content(tables: Tables) -> Content:
    """Return the picture of a compensation: values are shown as they stand in the list."""
    subject = Subject(tables.axis.name, tables.kind)
    first = tables.tables[0]
    if isinstance(first, Curve):
        lines = tuple(one.closed().shown() for one in tables.tables if isinstance(one, Curve))
        reversal = len(tables.curves) == 2
        return Curves(subject, lines, reversal, logarithmic=first.over.name == SPEED, note=first.note)
    if isinstance(first, Grid):
        x, y, points = np.array(first.x), np.array(first.y), np.empty((0, 2))
    else:
        points = np.array(first.places)
        x, y = (np.union1d(side, np.linspace(side.min(), side.max(), SAMPLES_SCATTERED)) for side in points.T)
    layers = tuple(Layer.shown(one) for one in tables.tables if isinstance(one, Grid | Scatter))
    return Map(subject, layers, x, y, points, note=first.note)


class _VolumetricContents:
    """Makes the contents of one volumetric compensation."""

    def __init__(self, machine: Machine, volumetric: Volumetric, tool_length: float) -> None:
        self._volumetric = volumetric
        self._model = TcpModel(volumetric)
        self._tool_length = tool_length
        self._tool = f"tool length {tool_length:g} mm" if tool_length else ""
        self._names = {letter: machine.numbered(number).name for letter, number in volumetric.axes}
        nodes = machine.error_nodes()
        ends = {letter: nodes.get(number, [0.0]) for letter, number in volumetric.axes}
        # The work volume: from the first to the last node of each axis, mm or °; an axis without nodes stays at 0.
        self._ranges = {
            letter: (ends[letter][0], ends[letter][-1]) if letter in ends else (0.0, 0.0) for letter in LETTERS
        }

    def all(self, axis: str | None) -> Iterator[Content]:
        """Yield all: the errors of each axis, constant errors, and the TCP error; of one axis its own alone."""
        for letter, name in self._names.items():
            if axis in {None, name}:
                yield from self._errors_of_axis(letter)
        if axis is None:
            yield from self._constants()
            field = self._tcp_field()
            turning = [a for a in ROTARY if any(a in table.arguments for table in self._volumetric.errors)]
            if field.largest() > 0.0 or not turning:
                yield field
            yield from map(self._tcp_curves, turning)

    def _errors_of_axis(self, letter: str) -> Iterator[Content]:
        """Yield the errors of one axis: curves by argument and unit, maps for those over several axes."""
        tables = [table for table in self._volumetric.errors if table.name[-1] == letter and any(table.values)]
        for argument in LETTERS:
            for angular in (False, True):
                chosen = [t for t in tables if t.arguments == argument and is_angle(t.name) == angular]
                if chosen:
                    yield self._curves(letter, argument, chosen)
        yield from (self._map(table) for table in tables if len(table.arguments) > 1)

    def _curves(self, letter: str, argument: str, tables: Sequence[ErrorTable]) -> Curves:
        over, of = self._position(argument), _error(tables[0].name)
        lines = []
        for table in tables:
            x = np.unique(table.positions(argument))
            poses = np.zeros((len(x), len(LETTERS)))
            poses[:, LETTERS.index(argument)] = x
            lines.append(_line(x, self._error_at(table.name, poses), over, of, table.name))
        what = "angular errors" if is_angle(tables[0].name) else "linear errors"
        elsewhere = "" if argument == letter else f" over {argument}"
        subject = self._subject(f"{what} of {self._names[letter]}{elsewhere}")
        return Curves(subject, tuple(lines), zero_if_absent=True)

    def _map(self, table: ErrorTable) -> Map:
        """Return one error over its first two axes, the others in the middle of their ranges."""
        first, second, *others = list(table.arguments)
        columns = {argument: table.positions(argument) for argument in table.arguments}
        middle = {argument: 0.5 * (min(columns[argument]) + max(columns[argument])) for argument in others}
        over, of = (self._position(first), self._position(second)), _error(table.name, table.name)

        def at(x: float, y: float) -> float:
            pose = np.zeros((1, len(LETTERS)))
            for argument, position in (*middle.items(), (first, x), (second, y)):
                pose[0, LETTERS.index(argument)] = position
            return of.factor * float(self._error_at(table.name, pose)[0])

        x, y = (np.linspace(min(columns[argument]), max(columns[argument]), SAMPLES) for argument in (first, second))
        points = np.empty((0, 2)) if others else np.column_stack([columns[first], columns[second]])
        layers = (Layer("", over, of.scaled(), at),)
        return Map(self._subject(table.name), layers, x, y, points, note=f"at {self._at(middle)}" if middle else "")

    def _constants(self) -> Iterator[Content]:
        """Yield the errors that do not depend on any position."""
        for angular, what in ((False, "linear"), (True, "angular")):
            tables = [t for t in self._volumetric.errors if not t.arguments and is_angle(t.name) == angular]
            if tables:
                of = _error(tables[0].name)
                values = {table.name: of.factor * table.values[0] for table in tables}
                yield Bars(self._subject(f"constant {what} errors"), of.scaled(), values)

    def _tcp_field(self) -> Field:
        """Return the TCP error all over the work volume, the rotary axes at 0 or as near as they get."""
        ends = [self._ranges[letter] for letter in LINEAR]
        sides = [np.linspace(low, high, ARROWS if high > low else 1) for low, high in ends]
        grid = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, len(LINEAR))
        positions = np.column_stack([grid, np.tile(self._rotary(), (len(grid), 1))])
        errors = self._model.errors_and_deviations(positions, self._tool_length)[1]
        return Field(self._subject("TCP error"), grid, shown("mm").factor * errors, note=self._tool)

    def _tcp_curves(self, letter: str) -> Curves:
        """Return the TCP error while a rotary axis turns, the linear axes in the middle of the work volume."""
        middle = {linear: 0.5 * sum(self._ranges[linear]) for linear in LINEAR}
        turned = np.linspace(*self._ranges[letter], TURNED)
        positions = np.tile([*middle.values(), *self._rotary()], (len(turned), 1))
        positions[:, LETTERS.index(letter)] = turned
        values = self._model.errors_and_deviations(positions, self._tool_length)[1]
        over, of = self._position(letter), Quantity("TCP error, actual − nominal", "mm")
        return Curves(
            self._subject(f"TCP error over {self._names[letter]}"),
            tuple(_line(turned, side, over, of, f"along {d}") for d, side in zip(LINEAR, values.T, strict=True)),
            note=", ".join(word for word in (self._at(middle), self._tool) if word),
        )

    def _rotary(self) -> list[float]:
        """Return the positions of the rotary axes nearest to 0."""
        return [float(np.clip(0.0, *self._ranges[letter])) for letter in ROTARY]

    def _error_at(self, name: str, poses: Array) -> Array:
        return self._model.known_errors(poses)[:, ERRORS.index(name)]

    def _position(self, letter: str) -> Quantity:
        return Quantity("position", "°" if letter in ROTARY else "mm", self._names.get(letter, letter))

    def _at(self, positions: dict[str, float]) -> str:
        return ", ".join(f"{self._names.get(letter, letter)} = {x:g}" for letter, x in positions.items())

    def _subject(self, part: str) -> Subject:
        return Subject(str(self._volumetric.index), VOLUMETRIC, part)


def _error(name: str, what: str = "error") -> Quantity:
    return Quantity(f"{what}, actual − nominal", "rad" if is_angle(name) else "mm")


def _line(x: Array, y: Array, over: Quantity, of: Quantity, label: str) -> Curve:
    return Curve(tuple(x.tolist()), tuple(y.tolist()), over, of, label=label).shown()
