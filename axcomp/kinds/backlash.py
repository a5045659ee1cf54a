"""Backlash compensation (``lr_param.anwahl_losekomp``, ``getriebe[i].lose``): the drive goes further after a reversal.

It stands in the axis list; names and units after the vendor's function description FCT-C5, P-AXIS-00021 and 00103.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..kernel import LARGEST
from ..model import Axis, Compensation, Curve, Machine, Quantity
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, Reference, TableReader
from .parameter import DataType, ListKind, Parameter, Quantity as ListQuantity, Severity, Value, axis as axis_id
from .shown import Table, correction_of

MODE, AMOUNT = "lr_param.anwahl_losekomp", "getriebe[i].lose"
NEGATIVE, POSITIVE = 1, 2
"""Modes of P-AXIS-00021, by the motion after which the drive goes further."""


@dataclass(frozen=True)
class Backlash(Compensation, kind="backlash"):
    """Backlash compensation: after a motion in one direction the setpoint moves on by the backlash.

    Attributes
    ----------
    amount : float
        By how much the drive moves before the slide does, mm or ° (P-AXIS-00103).
    mode : int
        1: −amount is added after negative motion; 2: +amount after positive motion (P-AXIS-00021).
    """

    amount: float
    mode: int = NEGATIVE


class BacklashKind(Kind[Backlash]):
    """See the module."""

    name = "backlash"
    title = "Backlash compensation"
    word = "BACKLASH"
    identifier = 44
    activator = Parameter(
        MODE,
        "Activates the backlash compensation: right after 1 positive, 2 negative motion",
        DataType.UNS16,
        0,
        axis_id("00021"),
        values=(0, NEGATIVE, POSITIVE),
    )
    list_kind = ListKind.AXIS
    prefix = AMOUNT
    parameters = (
        Parameter(
            AMOUNT,
            "Backlash; above 0: the drive moves before the slide",
            DataType.SGN16,
            0,
            axis_id("00103"),
            ListQuantity.POSITION,
            index_max=(15,),
        ),
    )
    values = ("amount",)
    codes = {"AXC-BACKLASH": (Severity.WARNING, "The backlash compensation is activated, but the backlash is 0")}

    def activation(self, compensation: Backlash | None) -> Value:
        """Return the mode."""
        return NEGATIVE if compensation is None else compensation.mode

    def read(self, source: TableReader) -> Backlash | None:
        """Return the compensation."""
        amount = source.values.converted(AMOUNT, 0)
        if amount == 0.0:
            message = f"{MODE} is {source.values.integer(MODE)}, but getriebe[0].lose is 0: nothing is compensated."
            source.note("AXC-BACKLASH", MODE, message)
        return Backlash(amount, source.values.integer(MODE))

    def write(self, compensation: Backlash, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        lines.add_converted(AMOUNT, compensation.amount, 0)

    def compile(self, compensation: Backlash, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        compiler.require(abs(compensation.amount) < LARGEST, "backlash: the amount is not finite")
        compiler.require(compensation.mode in (NEGATIVE, POSITIVE), f"backlash: mode {compensation.mode} is not 1 or 2")
        table = compiler.tables.backlash
        table.direction = -1 if compensation.mode == NEGATIVE else 1
        table.amount = table.direction * compensation.amount
        table.reversal_cycles = max(1, compiler.axis.backlash_cycles)

    def tables(self, compensation: Backlash, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return what is added after negative and after positive motion."""
        after = (-compensation.amount, 0.0) if compensation.mode == NEGATIVE else (0.0, compensation.amount)
        over = Quantity("direction of motion", "", axis.name)
        return (Curve((-1.0, 1.0), after, over, correction_of(axis), label="correction"),)

    def needs(self, compensation: Backlash, axis: Axis) -> tuple[int, ...]:
        """Return nothing: only the direction of motion counts."""
        return ()

    def looks_up(self, compensation: Backlash, axis: Axis) -> Iterable[Reference]:
        """Return the motion of the axis."""
        return ((axis.number, "setpoint"), (axis.number, "velocity"))


KIND = BacklashKind()
