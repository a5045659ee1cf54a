"""SINUMERIK CEC: sag and angularity compensation, one axis corrected over another or over itself.

``$AN_CEC[t,N]`` is the value at point N of table t, ``$AN_CEC_STEP/MIN/MAX[t]`` set the points as in ENC_COMP,
``…_INPUT_AXIS`` names the axis looked up, ``…_OUTPUT_AXIS`` the corrected one, ``…_DIRECTION`` says whether the table
acts in both directions (0) or only in positive (1) or negative (−1) motion of the input axis, ``…_IS_MODULO`` repeats
it. Tables of one pair of axes add up; two with directions 1 and −1 and the same axis twice are a bilateral leadscrew
compensation. ``…_MULT_BY_TABLE`` other than 0 adds the product with another table, which no table over one axis holds.
Weights are multiplied in: ``…_FACTOR`` and setting data SD41310 ``$SN_CEC_TABLE_WEIGHT[t]``; SD41300
``$SN_CEC_TABLE_ENABLE[t]`` = 0 leaves a table out.

Sign: the control changes the **setpoint** of the output axis by the value, looked up at the setpoint of the input axis;
a positive value moves the axis in the positive direction. This is the correction itself, as in the cross table of the
lists, and the opposite of ENC_COMP, which changes the measured position. Units: as in ENC_COMP; MD32711 may give them a
system of their own.

Source: Siemens 6FC5397-1BP40-3BA1 (03/2013), K3, 4.4.3 and 4.4.4, pages 244 to 266; 6FC5397-1CP10-5BA0, 11.3.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .sinumerik import GRID, Written, blocks, program, settings
from .table import CompensationTable, on_equidistant_points
from .text import DEFAULTS, FormatError, Options

_PREFIX = "$AN_CEC"
_PARAMETERS = ("STEP", "MIN", "MAX", "INPUT_AXIS", "OUTPUT_AXIS", "DIRECTION", "FACTOR", "MULT_BY_TABLE", "IS_MODULO")
_SETTING_DATA = ("TABLE_WEIGHT", "TABLE_ENABLE")
_KNOWN = {f"{_PREFIX}_{name}": name for name in _PARAMETERS} | {f"$SN_CEC_{name}": name for name in _SETTING_DATA}


class _Part(NamedTuple):
    """One table of the file: a curve that acts in some directions, and what it belongs to."""

    line: int
    curve: CompensationTable
    directions: tuple[int, ...]


def read_cec(text: str, options: Options = DEFAULTS) -> list[CompensationTable]:
    """Return a table for each pair of axes; the input axis of a modulo table is a rotary one.

    Raises
    ------
    FormatError
        Also if the file holds products of tables.
    """
    tables: dict[int, Written] = {}
    for setting in settings(text):
        if setting.variable != _PREFIX and setting.variable not in _KNOWN:
            raise FormatError(setting.line, f"{setting.variable} is no variable of a sag compensation")
        written = tables.setdefault(setting.whole_index(0), Written(setting.line))
        setting.check_indices(2 if setting.variable == _PREFIX else 1)
        if setting.variable == _PREFIX:
            written.points[setting.whole_index(1)] = setting.number()
        else:
            written.parameters[_KNOWN[setting.variable]] = setting
    if not any(written.points for written in tables.values()):
        raise FormatError(0, "the file has no table")
    pairs: dict[tuple[str, str], list[_Part]] = {}
    for number, written in sorted(tables.items()):
        if written.flag("TABLE_ENABLE", True):
            part = _part(f"table {number}", written, options)
            pairs.setdefault((part.curve.axis, part.curve.over), []).append(part)
    return [_sum(parts) for parts in pairs.values()]


def _part(name: str, written: Written, options: Options) -> _Part:
    written.check_has(name, _PREFIX, (*GRID, "INPUT_AXIS", "OUTPUT_AXIS"))
    if written.number("MULT_BY_TABLE", 0.0) != 0.0:
        line = written.parameters["MULT_BY_TABLE"].line
        raise FormatError(line, f"{name} is multiplied by another one: no table over one axis holds the product")
    direction = written.number("DIRECTION", 0.0)
    if direction not in {-1.0, 0.0, 1.0}:
        raise FormatError(written.parameters["DIRECTION"].line, f"{_PREFIX}_DIRECTION must be −1, 0 or 1")
    over, axis = (written.parameters[needed].axis() for needed in ("INPUT_AXIS", "OUTPUT_AXIS"))
    over_unit = "deg" if written.flag("IS_MODULO", False) else options.unit(over)
    unit = over_unit if axis == over else options.unit(axis)
    weight = written.number("FACTOR", 1.0) * written.number("TABLE_WEIGHT", 1.0)
    curve = written.table(name, (axis, over), (unit, over_unit), weight, options)
    return _Part(written.line, curve, {0.0: (1, -1), 1.0: (1,), -1.0: (-1,)}[direction])


def _sum(parts: Sequence[_Part]) -> CompensationTable:
    """Add the tables of one pair of axes, on all their points."""
    first = parts[0].curve
    for part in parts[1:]:
        if not _same_rhythm(part.curve, first):
            raise FormatError(part.line, f"the tables of {first.axis} over {first.over} repeat differently")
    positions = sorted({position for part in parts for position in part.curve.positions})
    positive, negative = np.zeros((2, len(positions)))
    for part in parts:
        values = part.curve.positive.on(positions).y
        positive += values if 1 in part.directions else 0.0
        negative += values if -1 in part.directions else 0.0
    curves = (positive.tolist(), negative.tolist())
    return CompensationTable.of(first.axis, first.over, positions, *curves, first.period, first.unit, first.over_unit)


def _same_rhythm(one: CompensationTable, other: CompensationTable) -> bool:
    if one.period is None or other.period is None:
        return one.period is other.period
    return math.isclose(one.period, other.period) and one.positions[0] == other.positions[0]


def write_cec(tables: Sequence[CompensationTable], options: Options = DEFAULTS) -> str:
    """Return the file with any tables; a bilateral one becomes two, one for each direction."""
    lines: list[str] = []
    number = 0
    for table in tables:
        even = on_equidistant_points(table, options.max_points, options.within)
        for direction in (0,) if even.negative is None else (1, -1):
            values = even.curve(direction or 1).y
            lines += [
                f"; {table.axis} over {table.over}: {len(values)} points, MD18342 MM_CEC_MAX_POINTS[{number}] must "
                "hold them",
                *blocks(_PREFIX, [number], [], even, values, options),
                f"{_PREFIX}_INPUT_AXIS[{number}]=({table.over})",
                f"{_PREFIX}_OUTPUT_AXIS[{number}]=({table.axis})",
                f"{_PREFIX}_DIRECTION[{number}]={direction}",
                f"{_PREFIX}_MULT_BY_TABLE[{number}]=0",
            ]
            number += 1
    return program("NC_CEC", lines)
