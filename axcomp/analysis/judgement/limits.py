"""Limits: the largest volumetric correction of each axis against its ``s_limit`` (P-AXIS-00525).

A correction above it stops the axis and switches the compensation off (semantics §10). The corrections are the
kernel's, at the positions for which there are records, the corners of the work volume among them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from ...kernel.record import zeros
from ...kernel.volumetric_model import correction_at
from ...lists.findings import Findings
from ...model.machine import Axis, Machine
from ...model.volumetric import ERRORS, LETTERS, LINEAR, Volumetric
from ...runtime.compile import compile_tables
from .positions import Positions

POSITIONS_MAX = 1000
"""At which the corrections are computed; where records are at more positions, evenly chosen ones count."""
NEAR = 0.8
"""From this share of the limit on a correction is close to it."""


@dataclass(frozen=True)
class LargestCorrection:
    """The largest correction that a volumetric compensation makes to an axis.

    Attributes
    ----------
    index : int
        Of the compensation.
    axis : Axis
    correction : float
        mm, with its sign.
    position : dict of str to float
        Where, by the name of the axis, mm or °.
    tool_length : float
        mm.
    """

    index: int
    axis: Axis
    correction: float
    position: dict[str, float]
    tool_length: float

    @property
    def share(self) -> float | None:
        """Correction over limit; None if the axis has no limit."""
        limit = self.axis.volumetric_limit
        return abs(self.correction) / limit if limit else None

    def to_dict(self) -> dict[str, Any]:
        """Return the figures for JSON."""
        limit = self.axis.volumetric_limit
        return {
            "volumetric": self.index,
            "axis": self.axis.name,
            "correction": self.correction,
            "limit": limit,
            "position": self.position,
            "tool_length": self.tool_length,
        }


def largest_corrections(machine: Machine, tool_length: float = 0.0) -> Iterator[LargestCorrection]:
    """Yield the largest correction of each axis by each volumetric compensation, gantry slaves included."""
    for volumetric in machine.volumetric:
        names = {letter: machine.axes[machine.index_of(number)].name for letter, number in volumetric.axes}
        letters = {number: letter for letter, number in volumetric.axes}
        best: dict[str, tuple[float, tuple[float, ...]]] = {}
        for position, correction in _corrections(machine, volumetric, tool_length):
            for letter, value in zip(LINEAR, correction, strict=True):
                if letter not in best or abs(value) > abs(best[letter][0]):
                    best[letter] = (value, position)
        for number in sorted(machine.corrected_by(volumetric), key=machine.index_of):
            axis = machine.axes[machine.index_of(number)]
            leader = number if number in letters else axis.gantry_master
            letter = "" if leader is None else letters.get(leader, "")
            if letter in best and letter not in volumetric.set_to_zero:
                value, position = best[letter]
                where = {names[a]: p for a, p in zip(LETTERS, position, strict=True) if a in names}
                sign = -1.0 if letter in volumetric.negate else 1.0
                yield LargestCorrection(volumetric.index, axis, sign * value, where, tool_length)


def _corrections(
    machine: Machine, volumetric: Volumetric, tool_length: float
) -> Iterator[tuple[tuple[float, ...], list[float]]]:
    """Yield positions of the six axes and the corrections of X, Y and Z there."""
    axes = tuple(Axis(axis.number, axis.name, axis.type) for axis in machine.axes)
    tables, pool = compile_tables(Machine(axes, (replace(volumetric, index=0),)))
    table = tables.volumetric[0]
    for position in product(*_sides(machine, volumetric)):
        correction = zeros(len(LINEAR))
        if correction_at(pool, table, list(position), tool_length, [0] * len(ERRORS), correction):
            yield position, correction


def _sides(machine: Machine, volumetric: Volumetric) -> list[list[float]]:
    """Return positions for each letter: those of records, thinned until their combinations are few enough."""
    numbers = dict(volumetric.axes)
    places: dict[int, set[float]] = {}
    # A compensation of the rotary axes may have no table over X, Y and Z: the others tell how far these go.
    for one in machine.volumetric:
        for table in one.errors:
            for column, letter in enumerate(table.arguments):
                places.setdefault(dict(one.axes)[letter], set()).update(node[column] for node in table.nodes)
    own = {letter for table in volumetric.errors for letter in table.arguments}
    sides = []
    for letter in LETTERS:
        found = sorted(places.get(numbers.get(letter, 0), {0.0}))
        sides.append(found if letter in own else sorted({found[0], found[-1]}))
    while _count(sides) > POSITIONS_MAX:
        longest = max(range(len(sides)), key=lambda k: len(sides[k]))
        count = len(sides[longest])
        if count <= 2:
            break
        wanted = max(2, int(0.7 * count))
        sides[longest] = [sides[longest][round(i * (count - 1) / (wanted - 1))] for i in range(wanted)]
    return sides


def _count(sides: list[list[float]]) -> int:
    count = 1
    for side in sides:
        count *= len(side)
    return count


def judge_limits(
    machine: Machine, positions: Positions, findings: Findings, tool_length: float = 0.0
) -> list[LargestCorrection]:
    """Note axes whose limit is exceeded or all but reached, and return the largest correction of each."""
    results = list(largest_corrections(machine, tool_length))
    for result in results:
        share = result.share
        if share is None or share < NEAR:
            continue
        at = ", ".join(f"{name} = {position:g}" for name, position in result.position.items())
        if result.tool_length:
            at += f", tool length {result.tool_length:g} mm"
        begin = (
            f"Volumetric compensation {result.index} moves {result.axis.name} by {result.correction:.4f} mm at {at}, "
            f"{100.0 * share:.0f} % of its s_limit of {result.axis.volumetric_limit:g} mm"
        )
        position = positions.of_axis(result.axis.number, "lr_param.vol_comp.s_limit")
        if share > 1.0:
            message = f"{begin}: there the axis stops and the compensation switches off."
            findings.add("AXC-LIMIT-EXCEEDED", *position, message)
        else:
            findings.add("AXC-LIMIT-NEAR", *position, f"{begin}.")
    return results
