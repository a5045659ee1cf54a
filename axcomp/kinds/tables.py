"""The tables of a machine's compensations, whatever their kind: what is shown, judged and converted of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..model import Axis, Compensation, Curve, Grid, Machine
from .registry import KINDS, kind_of
from .shown import POSITION, Range, Table


@dataclass(frozen=True)
class Tables:
    """The tables of one compensation.

    Attributes
    ----------
    machine : Machine
    axis : Axis
        The one that is corrected.
    kind : str
        One of ``KINDS``.
    compensation : dataclass
        What they are of.
    tables : tuple of Curve, Grid or Scatter
        At least one; all of one class, over the same quantities.
    """

    machine: Machine
    axis: Axis
    kind: str
    compensation: Compensation
    tables: tuple[Table, ...]

    @property
    def name(self) -> str:
        """The table in words, as sentences have it: ``the cross table of Z over X``."""
        first = self.tables[0]
        over = (first.over,) if isinstance(first, Curve) else first.over
        others = [one.axis for one in over if first.entry and one.name == POSITION and one.axis != self.axis.name]
        return f"the {self.kind} table of {self.axis.name}" + (f" over {' and '.join(others)}" if others else "")

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Curves over a position that stand in a column of the list each; none for other tables."""
        return tuple(one for one in self.tables if isinstance(one, Curve) and one.entry and one.over.name == POSITION)

    @property
    def grids(self) -> tuple[Grid, ...]:
        """Grids that stand in the list."""
        return tuple(one for one in self.tables if isinstance(one, Grid) and one.entry)

    def named(self, curve: Curve) -> str:
        """Return one of several curves in words."""
        return f"{self.name}, {curve.label}" if len(self.tables) > 1 else self.name

    def ranges(self) -> list[Range]:
        """Return over what, and from where to where, the compensation has values of its own."""
        return KINDS[self.kind].ranges(self.compensation, self.tables, self.machine)


def tables_of(machine: Machine, axis: str | None = None, kind: str | None = None) -> Iterator[Tables]:
    """Yield the tables of the compensations that act, axis by axis in the order of a cycle.

    Parameters
    ----------
    machine : Machine
        With every master its compensations name.
    axis, kind : str or None
        Only of this axis, only of this kind.
    """
    for one in machine.axes:
        if axis in {None, one.name}:
            for compensation in one.compensations:
                if kind in {None, compensation.kind}:
                    tables = kind_of(compensation).tables(compensation, machine, one)
                    yield Tables(machine, one, compensation.kind, compensation, tables)
