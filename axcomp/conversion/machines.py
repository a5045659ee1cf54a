"""The leadscrew and cross compensations of a ``Machine`` as tables, and tables as compensations of a ``Machine``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..kinds import Cross, Leadscrew, shown, tables_of as tables_of_machine
from ..model import Axis, AxisType, Curve, Grid, Machine, ModuloRange
from .table import CompensationTable
from .text import CannotHoldError, Unit

CONVERTED = ("leadscrew", "cross")
"""Kinds that are tables over the position of one axis."""

_OVER = {shown.ACCELERATION: "is a table over accelerations", shown.SPEED: "is a table of currents over velocities"}


def tables_of(machine: Machine, axis: str | None = None, kind: str | None = None) -> list[CompensationTable]:
    """Return the tables of a machine that are in force, axis by axis; only of one axis (name) or kind, if given.

    Raises
    ------
    CannotHoldError
        If there is none, or one that is asked for is not over the position of one axis.
    """
    if axis is not None and axis not in {other.name for other in machine.axes}:
        names = ", ".join(other.name for other in machine.axes) or "none"
        raise CannotHoldError(f"there is no axis {axis!r}; the machine has {names}")
    tables = []
    for one in tables_of_machine(machine, axis, kind):
        if not one.curves:
            hint = "" if kind else "; choose with --axis and --kind"
            raise CannotHoldError(
                f"the {one.kind} compensation of {one.axis.name} {_why(one.tables[0])}: no other format holds it{hint}"
            )
        first, *others = (curve.added() for curve in one.curves)
        over = machine.axis(first.over.axis)
        negative = others[0].y if others else None
        values = (first.x, first.y, negative, first.period, _unit(one.axis), _unit(over))
        tables.append(CompensationTable.of(one.axis.name, over.name, *values))
    if machine.volumetric and axis is None and kind is None:
        raise CannotHoldError("a volumetric compensation is no table over one axis; choose with --axis and --kind")
    if not tables:
        of_axis = f" of axis {axis}" if axis else ""
        raise CannotHoldError(f"no {kind or 'leadscrew or cross'} compensation{of_axis} is in force")
    return tables


def _why(table: shown.Table) -> str:
    """Return in words why no other format holds a table."""
    if isinstance(table, Grid):
        return "is a table over two axes"
    return _OVER.get(
        table.over.name if isinstance(table, Curve) else "", "is no table over the position of one axis alone"
    )


def _unit(axis: Axis) -> Unit:
    return "mm" if axis.type is AxisType.TRANSLATORY else "deg"


def dropped(machine: Machine, tables: Sequence[CompensationTable]) -> list[str]:
    """Return, a sentence each, what the lists say of tables that the other formats have no word for."""
    sentences = []
    for table in tables:
        compensation = getattr(machine.axis(table.axis), table.kind)
        said = {
            "manual_activation": "is switched on by command only",
            "n_cycles": "is switched on and off softly",
            "without_other_compensations": "leaves the other compensations out of its position",
        }
        lost = [words for name, words in said.items() if getattr(compensation, name, 0)]
        sentences += [f"{table.name} {words}; the other format does not say so" for words in lost]
    return sentences


def machine_with(tables: Sequence[CompensationTable], machine: Machine | None = None) -> Machine:
    """Return a machine with these tables, at most one of a kind for each axis.

    The axes of ``machine`` keep what else they have; where it is None the axes of a new one are numbered as they come
    (``AX3``, as SINUMERIK calls them, is number 3).

    Raises
    ------
    CannotHoldError
        If the lists have no room for a table, or the machine no such axis.
    """
    axes = {axis.name: axis for axis in machine.axes} if machine is not None else _new_axes(tables)
    for table in tables:
        for name, unit in ((table.axis, table.unit), (table.over, table.over_unit)):
            if name not in axes:
                raise CannotHoldError(f"{table.name} needs an axis {name}; the machine has {', '.join(axes) or 'none'}")
            if _unit(axes[name]) != unit:
                raise CannotHoldError(f"axis {name} of the machine counts in {_unit(axes[name])}, the table in {unit}")
    done: set[tuple[str, str]] = set()
    for table in tables:
        if (table.axis, table.kind) in done:
            raise CannotHoldError(f"{table.axis} has two {table.kind} tables; the lists have room for one")
        done.add((table.axis, table.kind))
        axis = axes[table.axis]
        is_cross = table.kind == "cross"
        axes[table.axis] = _with_cross(axis, axes[table.over], table) if is_cross else _with_leadscrew(axis, table)
    return replace(machine or Machine(()), axes=tuple(axes.values()))


def _new_axes(tables: Sequence[CompensationTable]) -> dict[str, Axis]:
    units: dict[str, Unit] = {}
    for table in tables:
        units.setdefault(table.axis, table.unit)
        units.setdefault(table.over, table.over_unit)
    said = {name: int(name[2:]) for name in units if name[:2].upper() == "AX" and name[2:].isdecimal()}
    numbers = {name: number for name, number in said.items() if 0 < number < 2**16}
    if len(set(numbers.values())) < len(numbers):
        numbers = {}
    free = (number for number in range(1, len(units) + len(numbers) + 1) if number not in numbers.values())
    return {
        name: Axis(
            numbers[name] if name in numbers else next(free),
            name,
            AxisType.TRANSLATORY if unit == "mm" else AxisType.ROTARY,
        )
        for name, unit in units.items()
    }


def _with_leadscrew(axis: Axis, table: CompensationTable) -> Axis:
    modulo = axis.modulo
    if table.period is not None:
        if table.unit == "mm":
            raise CannotHoldError(f"{table.name} repeats every {table.period:g} mm: the lists repeat rotary axes only")
        modulo = modulo or ModuloRange(0.0, table.period)
        if abs(modulo.end - modulo.start - table.period) > 1e-9:
            raise CannotHoldError(
                f"{table.name} repeats every {table.period:g} deg, its axis from {modulo.start:g} to {modulo.end:g}"
            )
    old = axis.leadscrew or Leadscrew((), ())
    # The lists hold actual − programmed.
    error = table.mapped(lambda curve: curve.scaled(-1.0))
    leadscrew = replace(
        old,
        positions=table.positions,
        positive=error.positive.y,
        negative=None if error.negative is None else error.negative.y,
        modulo=table.period is not None,
        max_points=max(old.max_points, len(table.positions)),
    )
    return replace(axis.having(leadscrew), modulo=modulo)


def _with_cross(axis: Axis, master: Axis, table: CompensationTable) -> Axis:
    if table.negative is not None:
        raise CannotHoldError(f"{table.name} is bilateral: the lists have one curve for both directions of the master")
    if table.period is not None:
        raise CannotHoldError(
            f"{table.name} repeats every {table.period:g} {table.over_unit}: a cross table of the lists ends"
        )
    old = axis.cross or Cross(master.number, (), ())
    cross = replace(
        old,
        master=master.number,
        positions=table.positions,
        corrections=table.positive.y,
        max_points=max(old.max_points, len(table.positions)),
    )
    return axis.having(cross)
