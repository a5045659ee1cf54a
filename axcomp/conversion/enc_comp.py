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

from collections.abc import Sequence

from .sinumerik import GRID, Written, blocks, program, settings
from .table import CompensationTable, on_equidistant_points
from .text import DEFAULTS, CannotHoldError, FormatError, Options

_PREFIX = "$AA_ENC_COMP"


def read_enc_comp(text: str, options: Options = DEFAULTS) -> list[CompensationTable]:
    """Return the tables of the measuring system ``options.encoder``; an axis with a modulo table is a rotary one."""
    axes: dict[str, Written] = {}
    others: set[int] = set()
    for setting in settings(text):
        if not setting.variable.startswith(_PREFIX):
            raise FormatError(setting.line, f"{setting.variable} is no variable of a leadscrew compensation")
        if setting.whole_index(0, 1) != options.encoder:
            others.add(setting.whole_index(0, 1))
            continue
        is_point = setting.variable == _PREFIX
        axis = axes.setdefault(setting.axis_index(2 if is_point else 1), Written(setting.line))
        setting.check_indices(3 if is_point else 2)
        name = setting.variable.removeprefix(f"{_PREFIX}_")
        if is_point:
            axis.points[setting.whole_index(1)] = setting.number()
        elif name in {*GRID, "IS_MODULO"}:
            axis.parameters[name] = setting
        else:
            raise FormatError(setting.line, f"{setting.variable} is no variable of a leadscrew compensation")
    if not axes:
        found = f"; it has one for encoder {min(others)}" if others else ""
        raise FormatError(0, f"the file has no table for encoder {options.encoder}{found}")
    return [_table(name, written, options) for name, written in axes.items()]


def _table(name: str, written: Written, options: Options) -> CompensationTable:
    written.check_has(f"axis {name}", _PREFIX, GRID)
    unit = "deg" if written.flag("IS_MODULO", False) else options.unit(name)
    return written.table(f"the table of {name}", (name, name), (unit, unit), -1.0, options)


def write_enc_comp(tables: Sequence[CompensationTable], options: Options = DEFAULTS) -> str:
    """Return the file with unilateral leadscrew tables, for the measuring system ``options.encoder``."""
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
        even = on_equidistant_points(table, options.max_points, options.within)
        errors = [-value for value in even.positive.y]
        count = f"; {table.axis}: {len(errors)} points, MD38000 MM_ENC_COMP_MAX_POINTS must hold them"
        lines += [count, *blocks(_PREFIX, [options.encoder], [table.axis], even, errors, options)]
    return program("AX_EEC", lines)
