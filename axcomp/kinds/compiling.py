"""From a compensation to the kernel's table: what all kinds need for that."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ..kernel import LARGEST, Argument, AxisTable, CompensationTables, Curve
from ..model import Axis, Machine


class CompileError(ValueError):
    """A Machine that the kernel cannot run: the message names axis, compensation and what is wrong."""


def append(pool: list[float], values: Sequence[float], owner: str) -> int:
    """Put numbers into the pool and return where they begin; CompileError, naming the owner, if one is not finite."""
    if not all(map(LARGEST.__gt__, map(abs, values))):
        raise CompileError(f"{owner}: a table holds a number that is not finite")
    first = len(pool)
    pool.extend(values)
    return first


class AxisCompiler:
    """Fills the tables of one axis.

    Attributes
    ----------
    machine : Machine
    axis : Axis
        One of its axes.
    index : int
        Its place among them.
    tables : CompensationTables
        To be filled.
    """

    def __init__(self, machine: Machine, index: int, table: AxisTable, pool: list[float]) -> None:
        self.machine = machine
        self.axis: Axis = machine.axes[index]
        self.index = index
        self.tables: CompensationTables = table.compensation
        self._pool = pool

    @property
    def modulo_range(self) -> float:
        """Return after how many ° the axis' positions repeat, 0 if they do not."""
        return 0.0 if self.axis.modulo is None else self.axis.modulo.length

    def require(self, condition: bool, message: str) -> None:
        """Raise CompileError unless a condition holds."""
        if not condition:
            raise CompileError(f"axis {self.axis.name}: {message}")

    def append(self, values: Sequence[float]) -> int:
        """Put numbers into the pool; return where they begin."""
        return append(self._pool, values, f"axis {self.axis.name}")

    def ascending(self, kind: str, x: Sequence[float]) -> None:
        """Raise CompileError unless abscissae ascend."""
        self.require(all(a < b for a, b in pairwise(x)), f"{kind}: the points do not ascend")

    def curve(
        self, curve: Curve, kind: str, x: Sequence[float], y: Sequence[float], *, x_at: int | None = None
    ) -> None:
        """Put a curve into the pool; ``x_at``: where its abscissae are already."""
        self.require(len(x) == len(y) and len(x) > 0, f"{kind}: {len(x)} points but {len(y)} values")
        self.ascending(kind, x)
        curve.points = len(x)
        curve.x = self.append(x) if x_at is None else x_at
        curve.y = self.append(y)

    def index_of(self, number: int) -> int:
        """Return the place of an axis in the machine."""
        try:
            return self.machine.index_of(number)
        except KeyError:
            raise CompileError(f"axis {self.axis.name}: its master axis {number} does not exist") from None

    def argument(self, argument: Argument, number: int, first: float, last: float) -> None:
        """Say that a table from ``first`` to ``last`` is looked up with the position of an axis.

        One that counts modulo is folded into the turn that is centred on the table (semantics §5).
        """
        argument.axis = self.index_of(number)
        modulo = self.machine.axes[argument.axis].modulo
        if modulo is not None:
            argument.period = modulo.length
            argument.start = 0.5 * (first + last - modulo.length)
