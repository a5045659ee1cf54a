"""The error model of a machine, evaluated: its errors at a place, and what they do to the tool tip.

The kernel's own interpolation and model are used, so what is shown and identified is what the controller corrects.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..kernel import FRAME, carry_to_workpiece, correction_at, correction_with, errors_at, zeros
from ..model import ERRORS, LETTERS, LINEAR, Axis, AxisType, Machine, Volumetric
from ..runtime import compile_tables
from .motion import Array

_STEP = 1e-4
"""mm and rad by which errors are changed to see what they do; the model is all but linear in them."""


class TcpModel:
    """A machine with a volumetric compensation whose errors can be given.

    ``volumetric`` has its chain, centres, directions, offsets and so on, and the errors that are known.
    """

    def __init__(self, volumetric: Volumetric) -> None:
        types = {letter: AxisType.TRANSLATORY if letter in LINEAR else AxisType.ROTARY for letter in LETTERS}
        axes = tuple(Axis(number, letter, types[letter]) for letter, number in volumetric.axes)
        tables, self._pool = compile_tables(Machine(axes, (replace(volumetric, index=0),)))
        self._table = tables.volumetric[0]
        # Axes without known errors get some here.
        self._table.exact[:] = [False] * len(LETTERS)

    def places(self, positions: Array) -> Array:
        """Return where the axes are for the model, (n, 6): with the offsets of the machine."""
        result: Array = positions + np.array(self._table.offset)
        return result

    def errors_and_deviations(self, positions: Array, tool_length: float = 0.0) -> tuple[Array, Array]:
        """Return the known errors, (n, 72), and what they do to the tool tip, (n, 3), at positions (n, 6)."""
        places = self.places(positions)
        errors = self.known_errors(places)
        return errors, self.deviations(places, np.full(len(places), tool_length), errors)

    def known_errors(self, places: Array) -> Array:
        """Return the 72 errors that are known at places, (n, 72), mm and rad."""
        found = np.empty((len(places), len(ERRORS)))
        for row, place in zip(found, places.tolist(), strict=True):
            errors = zeros(len(ERRORS))
            errors_at(self._pool, self._table, place, [0] * len(ERRORS), errors)
            row[:] = errors
        return found

    def deviations(self, places: Array, tool_lengths: Array, errors: Array) -> Array:
        """Return actual − nominal tool tip on the workpiece, (n, 3), mm, with errors (n, 72)."""
        found = np.empty((len(places), len(LINEAR)))
        rows = zip(found, places.tolist(), tool_lengths.tolist(), errors.tolist(), strict=True)
        for row, place, tool_length, wrong in rows:
            nominal, actual = zeros(FRAME), zeros(FRAME)
            carry_to_workpiece(self._table, place, tool_length, wrong, nominal, actual)
            row[:] = [actual[d] - nominal[d] for d in range(len(LINEAR))]
        return found

    def corrections(self, places: Array, tool_lengths: Array, errors: Array | None = None) -> Array:
        """Return what X, Y and Z must move so that the tool tip is where it should be, (n, 3), mm.

        ``errors`` (n, 72) are those at the places; without them the known ones count where the axes are moved to.
        Whether the lists negate a correction or leave it out is not in it. nan where the position is singular.
        """
        found = np.full((len(places), len(LINEAR)), np.nan)
        given = [None] * len(places) if errors is None else errors.tolist()
        for row, place, length, wrong in zip(found, places.tolist(), tool_lengths.tolist(), given, strict=True):
            correction = zeros(len(LINEAR))
            if wrong is None:
                usable = correction_at(self._pool, self._table, place, length, [0] * len(ERRORS), correction)
            else:
                usable = correction_with(self._table, place, length, wrong, correction)
            if usable:
                row[:] = correction
        return found

    def derivatives(
        self, places: Array, tool_lengths: Array, errors: Array, which: Sequence[int], *, corrections: bool = False
    ) -> Array:
        """Return what each of some errors does to the tool tip or the corrections, (n, 3, errors), mm per mm or rad."""
        effects = self.corrections if corrections else self.deviations
        found = np.empty((len(places), len(LINEAR), len(which)))
        for column, error in enumerate(which):
            sides = []
            for step in (_STEP, -_STEP):
                changed = errors.copy()
                changed[:, error] += step
                sides.append(effects(places, tool_lengths, changed))
            found[:, :, column] = (sides[0] - sides[1]) / (2.0 * _STEP)
        return found
