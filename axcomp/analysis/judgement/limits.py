"""Limits: the largest volumetric correction of each axis against its ``s_limit`` (P-AXIS-00525).

A correction above it stops the axis and switches the compensation off (semantics §10). The corrections are the
kernel's, at the positions for which there are records, the corners of the work volume among them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

from ...kernel import correction_at, zeros
from ...lists import Findings
from ...model import ERRORS, LETTERS, LINEAR, Axis, Machine, Volumetric
from ...runtime import error_model
from .positions import Positions

POSITIONS_MAX = 1000
"""At which the corrections are computed; where records are at more positions, evenly chosen ones count."""
NEAR = 0.8
"""From this share of the limit on a correction is close to it."""


@dataclass(frozen=True)
class LargestCorrection:
    """The largest correction (mm, with its sign) that the volumetric compensation ``index`` makes to an axis.

    ``position``: where, by the name of the axis, mm or °; with a ``tool_length`` in mm.
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
        return {
            "volumetric": self.index,
            "axis": self.axis.name,
            "correction": self.correction,
            "limit": self.axis.volumetric_limit,
            "position": self.position,
            "tool_length": self.tool_length,
        }


def largest_corrections(machine: Machine, tool_length: float = 0.0) -> Iterator[LargestCorrection]:
    """Yield the largest correction of each axis by each volumetric compensation, gantry slaves included."""
    for volumetric in machine.volumetric:
        names = {letter: machine.numbered(number).name for letter, number in volumetric.axes}
        pool, table = error_model(volumetric)
        found: list[tuple[tuple[float, ...], list[float]]] = []
        for place in product(*_sides(machine, volumetric)):
            correction = zeros(len(LINEAR))
            if correction_at(pool, table, list(place), tool_length, [0] * len(ERRORS), correction):
                found.append((place, list(correction)))
        for index, letter in machine.members(volumetric).items():
            if found and letter in LINEAR and volumetric.sign(letter):
                along = LINEAR.index(letter)
                place, correction = max(found, key=lambda one: abs(one[1][along]))
                where = {names[a]: position for a, position in zip(LETTERS, place, strict=True) if a in names}
                value = volumetric.sign(letter) * correction[along]
                yield LargestCorrection(volumetric.index, machine.axes[index], value, where, tool_length)


def _sides(machine: Machine, volumetric: Volumetric) -> list[list[float]]:
    """Return positions for each letter: those of records, thinned until their combinations are few enough."""
    numbers, nodes = dict(volumetric.axes), machine.error_nodes()
    own = {letter for table in volumetric.errors for letter in table.arguments}
    sides = []
    for letter in LETTERS:
        found = nodes.get(numbers.get(letter, 0), [0.0])
        sides.append(found if letter in own else sorted({found[0], found[-1]}))
    while math.prod(map(len, sides)) > POSITIONS_MAX:
        longest = max(range(len(sides)), key=lambda k: len(sides[k]))
        count = len(sides[longest])
        if count <= 2:
            break
        wanted = max(2, int(0.7 * count))
        sides[longest] = [sides[longest][round(k * (count - 1) / (wanted - 1))] for k in range(wanted)]
    return sides


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
