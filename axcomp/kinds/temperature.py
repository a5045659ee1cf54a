"""Temperature compensation (``lr_param.temp_comp``): growth of an axis, linear over its position.

It stands in the axis list; names and units after the vendor's function description FCT-C5, P-AXIS-00271 … 00275.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..kernel import LARGEST
from ..model import Axis, AxisType, Compensation, Curve, Machine
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, KindInput, Reference, TableReader
from .parameter import DataType, ListKind, Parameter, Quantity, Severity, activation, axis as axis_id, position
from .shown import Table, correction_of, position_of
from .units import convert, in_list

PREFIX = "lr_param.temp_comp"
_POSITION, _OFFSET = f"{PREFIX}_position_0", f"{PREFIX}_offset_0"
_COEFFICIENT, _CYCLES = f"{PREFIX}_coefficient", f"{PREFIX}_n_cycles"

_PER_UNIT = {AxisType.TRANSLATORY: Quantity.GRADIENT.divisor, AxisType.ROTARY: 1_000}
"""Values of the list that make a growth of 1 mm per mm (µm/m) or 1° per ° (0.001°/°)."""


@dataclass(frozen=True)
class Temperature(Compensation, kind="temperature"):
    """Temperature compensation: offset + coefficient · (setpoint − position) is added to the setpoint of the axis.

    Attributes
    ----------
    position : float
        Where only the offset acts, mm or ° (P-AXIS-00272).
    offset : float
        mm or ° (P-AXIS-00273).
    coefficient : float
        Growth, mm per mm or ° per ° (P-AXIS-00274).
    n_cycles : int
        Cycles over which a change of offset or coefficient comes in, 1..20 (P-AXIS-00275).
    """

    position: float = 0.0
    offset: float = 0.0
    coefficient: float = 0.0
    n_cycles: int = 1


class TemperatureKind(Kind[Temperature]):
    """See the module."""

    name = "temperature"
    title = "Temperature compensation"
    word = "TEMP"
    identifier = 36
    activator = activation(PREFIX, "temperature compensation", "00271")
    list_kind = ListKind.AXIS
    prefix = f"{PREFIX}_"
    parameters = (
        position(_POSITION, "Position without growth by temperature", axis_id("00272")),
        position(_OFFSET, "Offset of the temperature compensation", axis_id("00273")),
        Parameter(
            _COEFFICIENT,
            "Growth by temperature over the position",
            DataType.SGN32,
            0,
            axis_id("00274"),
            Quantity.GRADIENT,
            "(MIN, MAX)",
        ),
        # The vendor prints 0 < n < 20 and uses 20 in an example.
        Parameter(
            _CYCLES,
            "Cycles over which a change of the temperature compensation comes in",
            DataType.UNS16,
            1,
            axis_id("00275"),
            Quantity.CYCLES,
            "(0, 20)",
            usable="(0, 20]",
        ),
    )
    values = ("offset", "coefficient")
    inputs = (
        KindInput(39, "temperature.offset", "offset", "Added to the offset of the lists", "{}"),
        KindInput(
            40, "temperature.coefficient", "coefficient", "Added to the growth of the lists, mm per mm or deg per deg"
        ),
    )
    codes = {"AXC-GRADIENT": (Severity.WARNING, "A growth by temperature that no machine has: it is in another unit")}

    def read(self, source: TableReader) -> Temperature | None:
        """Return the compensation, None where the axis cannot have it."""
        values = source.values
        per_unit = _PER_UNIT.get(source.axis.type)
        if per_unit is None:
            message = f"Axis {source.axis.number} is a spindle, which has no temperature compensation; it stays off."
            source.note("AXC-AXIS-TYPE", PREFIX, message)
            return None
        coefficient = convert(values.number(_COEFFICIENT), per_unit)
        if abs(coefficient) > LARGEST_GRADIENT:
            message = f"{_COEFFICIENT} makes {coefficient:g} mm per mm or ° per °, more than any machine; it is used."
            source.note("AXC-GRADIENT", _COEFFICIENT, message)
        return Temperature(
            position=values.converted(_POSITION),
            offset=values.converted(_OFFSET),
            coefficient=coefficient,
            n_cycles=values.integer(_CYCLES),
        )

    def write(self, compensation: Temperature, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        per_unit = _PER_UNIT.get(axis.type, Quantity.GRADIENT.divisor)
        lines.add_converted(_POSITION, compensation.position)
        lines.add_converted(_OFFSET, compensation.offset)
        lines.add(_COEFFICIENT, in_list(compensation.coefficient, Quantity.GRADIENT, per_unit))
        lines.add_unless_default(_CYCLES, compensation.n_cycles)

    def compile(self, compensation: Temperature, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        numbers = (compensation.position, compensation.offset, compensation.coefficient)
        compiler.require(all(abs(x) < LARGEST for x in numbers), "temperature: a number is not finite")
        table = compiler.tables.temperature
        table.position, table.offset, table.coefficient = numbers

    def tables(self, compensation: Temperature, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return the line over the position; it stands in no column and goes on beyond both ends."""
        x = tuple(compensation.position + way for way in (-SHOWN_WAY, 0.0, SHOWN_WAY))
        y = tuple(compensation.offset + compensation.coefficient * (s - compensation.position) for s in x)
        return (Curve(x, y, position_of(axis), correction_of(axis), label="correction", note="goes on straight"),)

    def looks_up(self, compensation: Temperature, axis: Axis) -> Iterable[Reference]:
        """Return the axis' position and what may be measured while it runs."""
        return tuple((axis.number, name) for name in ("setpoint", "temperature.offset", "temperature.coefficient"))


LARGEST_GRADIENT = 1e-3
"""mm per mm: aluminium grows by this over 40 K."""

SHOWN_WAY = 1000.0
"""How far the line is shown on either side, mm or °."""

KIND = TemperatureKind()
