"""SINUMERIK ENC_COMP: error compensation of an axis' own measuring system (leadscrew), one curve for both directions.

``$AA_ENC_COMP[e,N,AXi]`` is the value at point N of encoder e (0 or 1), ``…_STEP[e,AXi]`` the distance of the points,
``…_MIN`` the position of point 0, ``…_MAX`` that of the last point k = (MAX − MIN)/STEP; outside the end values are
held. ``…_IS_MODULO`` = 1: the table is repeated, point k is followed by point 0 at once and should have its value.

Sign: the control adds the value to the measured position, so a positive one moves the axis in the negative direction
(the manual says so): it is the error actual − programmed, and the correction of the setpoint is its negative.
The control looks it up at the measured position, not at the setpoint; the difference is of second order: the correction
times the slope of the curve, 0.002 µm for 20 µm at 100 µm/m. Units: mm or inch after the basic system of the control,
degrees for rotary axes.

Source: Siemens 6FC5397-1BP40-3BA1 (03/2013), K3, 4.4.2.1 to 4.4.2.3, pages 238 to 242.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field

from .numbers import decimal, scale
from .resample import on_equidistant_points
from .sinumerik import MAX_POINTS, Setting, index_of_last_point, program, settings, values_of
from .table import CannotHoldError, CompensationTable, FormatError, Unit

_PREFIX = "$AA_ENC_COMP"


@dataclass
class _Written:
    """What a file says of one axis."""

    line: int
    points: dict[int, float] = field(default_factory=dict)
    parameters: dict[str, Setting] = field(default_factory=dict)


def read_enc_comp(
    text: str, *, encoder: int = 0, inch: bool = False, rotary: Collection[str] = ()
) -> list[CompensationTable]:
    """Return the tables of a file, one for each axis.

    Parameters
    ----------
    text : str
        Content of the file.
    encoder : int
        0 or 1: the measuring system whose tables are read.
    inch : bool
        The basic system of the control is inch.
    rotary : collection of str
        Names of the rotary axes: the files do not tell them. An axis with a modulo table is one anyway.

    Raises
    ------
    FormatError
        If the file is not of this format, with the line.
    """
    axes: dict[str, _Written] = {}
    others: set[int] = set()
    for setting in settings(text):
        if not setting.variable.startswith(_PREFIX):
            raise FormatError(setting.line, f"{setting.variable} is no variable of a leadscrew compensation")
        if setting.whole_index(0, 1) != encoder:
            others.add(setting.whole_index(0, 1))
            continue
        place = 2 if setting.variable == _PREFIX else 1
        axis = axes.setdefault(setting.axis_index(place), _Written(setting.line))
        if len(setting.indices) != place + 1:
            raise FormatError(setting.line, f"{setting.variable} has {place + 1} indices, not {len(setting.indices)}")
        if place == 2:
            axis.points[setting.whole_index(1)] = setting.number()
        elif setting.variable in {f"{_PREFIX}_{name}" for name in ("STEP", "MIN", "MAX", "IS_MODULO")}:
            axis.parameters[setting.variable.removeprefix(f"{_PREFIX}_")] = setting
        else:
            raise FormatError(setting.line, f"{setting.variable} is no variable of a leadscrew compensation")
    if not axes:
        found = f"; it has one for encoder {min(others)}" if others else ""
        raise FormatError(0, f"the file has no table for encoder {encoder}{found}")
    return [_table(name, written, inch, name in rotary) for name, written in axes.items()]


def _table(name: str, written: _Written, inch: bool, rotary: bool) -> CompensationTable:
    for needed in ("STEP", "MIN", "MAX"):
        if needed not in written.parameters:
            raise FormatError(written.line, f"axis {name} has no {_PREFIX}_{needed}")
    step, low, high = (written.parameters[name].number() for name in ("STEP", "MIN", "MAX"))
    modulo = "IS_MODULO" in written.parameters and written.parameters["IS_MODULO"].flag()
    line = written.parameters["MAX"].line
    last = index_of_last_point(low, high, step, line, f"the table of {name}")
    values = values_of(written.points, last, written.line, f"the table of {name}")
    unit: Unit = "deg" if rotary or modulo else "mm"
    factor = scale(unit, inch)
    if modulo and last == 0:
        raise FormatError(line, f"the table of {name} repeats but has no length")
    try:
        return CompensationTable.of(
            name,
            name,
            tuple((low + index * step) * factor for index in range(last + 1)),
            tuple(-value * factor for value in values),
            period=last * step * factor if modulo else None,
            unit=unit,
            over_unit=unit,
        )
    except ValueError as error:
        raise FormatError(line, str(error)) from None


def write_enc_comp(
    tables: Sequence[CompensationTable],
    *,
    encoder: int = 0,
    inch: bool = False,
    max_points: int = MAX_POINTS,
    within: float | None = None,
) -> str:
    """Return the file with the tables of several axes.

    Parameters
    ----------
    tables : sequence of CompensationTable
        Unilateral leadscrew tables.
    encoder : int
        0 or 1: the measuring system they are for.
    inch : bool
        The basic system of the control is inch.
    max_points : int
        What MD38000 of the control reserves.
    within : float or None
        µm (″) that equidistant points may cost; None: they must be equidistant.

    Raises
    ------
    CannotHoldError
        For a cross or bilateral table, and for what equidistant points cannot hold.
    """
    lines: list[str] = []
    for table in tables:
        if table.kind == "cross":
            raise CannotHoldError(
                f"{table.name} cannot be held: ENC_COMP corrects an axis over its own position (CEC can)"
            )
        if table.negative is not None:
            raise CannotHoldError(
                f"{table.name} is bilateral: ENC_COMP has one curve for both directions (CEC has two)"
            )
        lines += _blocks(on_equidistant_points(table, max_points, within), encoder, inch)
    return program("AX_EEC", lines)


def _blocks(table: CompensationTable, encoder: int, inch: bool) -> list[str]:
    factor = scale(table.unit, inch)
    last = len(table.positions) - 1
    low, high = table.positions[0] / factor, table.positions[-1] / factor
    step = (high - low) / last
    return [
        f"; {table.axis}: {last + 1} points, MD38000 MM_ENC_COMP_MAX_POINTS must hold them",
        *(
            f"{_PREFIX}[{encoder},{index},{table.axis}]={decimal(-value / factor)}"
            for index, value in enumerate(table.positive.y)
        ),
        f"{_PREFIX}_STEP[{encoder},{table.axis}]={decimal(step)}",
        f"{_PREFIX}_MIN[{encoder},{table.axis}]={decimal(low)}",
        f"{_PREFIX}_MAX[{encoder},{table.axis}]={decimal(high)}",
        f"{_PREFIX}_IS_MODULO[{encoder},{table.axis}]={int(table.period is not None)}",
    ]
