"""Machine → the kernel's tables: axis numbers become indices, tables one pool of floats, and divisors are checked.

The reader has sorted out what is implausible and said so; a Machine made by hand is checked here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from ..kernel import CYCLES_MAX, LARGEST, AxisTable, Tables, Vec, VolumetricTable, zero
from ..kinds import AxisCompiler, CompileError, kind_of, kinds_of
from ..model import (
    AXES_MAX,
    CYCLE_TIME,
    CYCLE_TIME_MAX,
    LETTERS,
    LINEAR,
    SHORTEST_RANGE,
    Axis,
    AxisType,
    Compensation,
    Machine,
    Volumetric,
)
from .compile_volumetric import compile_volumetric

__all__ = ["CompileError", "Compiled", "compile_tables", "error_model"]


class Compiled(NamedTuple):
    """What the kernel needs of a machine: records, and the numbers that they point into."""

    tables: Tables
    pool: Vec


def compile_tables(machine: Machine, cycle_time: float = CYCLE_TIME) -> Compiled:
    """Return the tables of a machine.

    Parameters
    ----------
    machine : Machine
        At most 32 axes; every master is one of them.
    cycle_time : float
        Of the position controller in s, > 0.

    Raises
    ------
    CompileError
        If an axis is missing, abscissae do not ascend, sizes differ, or a number is out of range.
    """
    if not 0.0 < cycle_time < CYCLE_TIME_MAX:
        raise CompileError(f"the cycle time must be above 0 s, not {cycle_time}")
    if len(machine.axes) > AXES_MAX:
        raise CompileError(f"{len(machine.axes)} axes: at most {AXES_MAX} are possible")
    if len({axis.number for axis in machine.axes}) < len(machine.axes):
        raise CompileError("two axes have the same logical number")
    count, pool = len(machine.axes), Vec()
    tables = Tables(cycle_time, count, [zero(AxisTable) for _ in range(count)], 0, [])
    for index, axis in enumerate(machine.axes):
        table = tables.axis[index]
        table.first = len(pool)
        _compile_axis(axis, AxisCompiler(machine, index, table, pool), table)
        table.numbers = len(pool) - table.first
    compile_volumetric(machine, tables, pool)
    return Compiled(tables, pool)


def error_model(volumetric: Volumetric) -> tuple[Vec, VolumetricTable]:
    """Return pool and table of a volumetric compensation on its own, for ``correction_at`` and its like."""
    types = {letter: AxisType.TRANSLATORY if letter in LINEAR else AxisType.ROTARY for letter in LETTERS}
    axes = tuple(Axis(number, letter, types[letter]) for letter, number in volumetric.axes)
    tables, pool = compile_tables(Machine(axes, (replace(volumetric, index=0),)))
    return pool, tables.volumetric[0]


def _compile_axis(axis: Axis, compiler: AxisCompiler, table: AxisTable) -> None:
    table.number = axis.number
    table.modulo_range = compiler.modulo_range
    if axis.modulo is not None:
        compiler.require(SHORTEST_RANGE < table.modulo_range < LARGEST, "the modulo range must be above 0 and finite")
    compiler.require(0 <= axis.backlash_cycles <= CYCLES_MAX, f"n_backlash_cyc is 0 … {CYCLES_MAX}")
    for switching in table.switching:
        switching.cycles = switching.blend_cycles = 1
    reserved = dict(axis.reserved)
    for kind in kinds_of(axis):
        switching = table.switching[kind.number]
        switching.points_error = kind.points_error
        switching.reserved = reserved.get(kind.name, 1)
        table.kind[table.kinds] = kind.number
        table.kinds += 1
    for compensation in axis.compensations:
        _compile_switching(compensation, compiler, table)
        kind_of(compensation).compile(compensation, compiler)
    # A shift of the leadscrew has no n_cycles: it is released as softly as the axis changes direction.
    table.shift_cycles = max(axis.backlash_cycles, *(switching.cycles for switching in table.switching))


def _compile_switching(compensation: Compensation, compiler: AxisCompiler, table: AxisTable) -> None:
    kind, axis, cycles = kind_of(compensation), compiler.axis, compensation.n_cycles
    compiler.require(0 <= cycles <= CYCLES_MAX, f"n_cycles is 0 … {CYCLES_MAX}, not {cycles}")
    switching = table.switching[kind.number]
    switching.configured = True
    switching.manual = compensation.manual_activation
    switching.at_standstill = kind.at_standstill
    switching.cycles = max(1, cycles)
    # What has no n_cycles changes as softly as the axis changes direction; a current at once.
    has_cycles = "n_cycles" in compensation.__dataclass_fields__  # type: ignore[attr-defined]
    if kind.adds_to == "setpoint":
        switching.blend_cycles = switching.cycles if has_cycles else max(1, axis.backlash_cycles)
    switching.reserved = kind.reserved(compensation)
    needed = sorted({compiler.index_of(number) for number in kind.needs(compensation, axis)})
    switching.needs = len(needed)
    switching.need[: len(needed)] = needed
