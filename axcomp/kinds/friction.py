"""Friction compensation (``frict_comp``): an additional motor current over the velocity."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ..kernel import DELAY_LINE, LARGEST, LOOKAHEAD_MAX
from ..model import Axis, Compensation, Curve, Machine, Quantity, symbol
from .compiling import AxisCompiler
from .kind import EntryWriter, Kind, KindInput, Reference, TableArray, TableReader
from .parameter import BELOW_MAX, DataType, Parameter, Quantity as ListQuantity, Severity, activation, both
from .shown import SPEED, Table
from .units import span

PREFIX = "frict_comp."
VELOCITY, CURRENT = f"{PREFIX}table[i].in", f"{PREFIX}table[i].out"
_MODE, _COUNT, _MAX_POINTS = f"{PREFIX}mode", f"{PREFIX}table_entries", f"{PREFIX}max_points"
_SCALING, _BUILD_UP = f"{PREFIX}scaling_factor", f"{PREFIX}position_delay"
_LOOKAHEAD, _DELAY = f"{PREFIX}reversal_lookahead", f"{PREFIX}delay_cycles"
_POINTS = 20
_ADDITIVE_CURRENT = 3


@dataclass(frozen=True, repr=False)
class Friction(Compensation, kind="friction"):
    """Friction compensation (``frict_comp``): an additional motor current over the setpoint velocity.

    Attributes
    ----------
    velocities : tuple of float
        Velocities of the table, ≥ 0, strictly ascending, mm/s or °/s (P-COMP-00046).
    currents : tuple of float
        Current at each velocity, in the drive's own unit (P-COMP-00047).
    scaling : float
        Factor of all currents: ``scaling_factor``/1000 (P-COMP-00045).
    position_delay : float
        Distance from a reversal over which the current builds up, mm or ° (P-COMP-00043).
    reversal_lookahead : int
        Cycles over which it decays before a reversal, 0..4 (P-COMP-00044).
    delay_cycles : int
        Cycles by which the current is put out late, 0..248 (P-COMP-00058).
    max_points : int
        Entries the controller reserves (P-COMP-00062).
    """

    velocities: tuple[float, ...]
    currents: tuple[float, ...]
    scaling: float = 1.0
    position_delay: float = 0.0
    reversal_lookahead: int = 0
    delay_cycles: int = 0
    max_points: int = _POINTS

    def __repr__(self) -> str:
        return f"Friction({len(self.velocities)} points {span(self.velocities, '/s')}, {self.scaling:g} ×)"


def _needs_ahead(cycles: int) -> Callable[[Friction | None], bool]:
    """Return what tells whether a compensation needs so many velocities to come: the delay line does not hold them."""

    def needs(friction: Friction | None) -> bool:
        return (
            friction is not None
            and friction.reversal_lookahead > friction.delay_cycles
            and (friction.reversal_lookahead >= cycles)
        )

    return needs


class FrictionKind(Kind[Friction]):
    """See the module."""

    name = "friction"
    title = "Friction compensation"
    word = "FRICT"
    identifier = 32
    adds_to = "current"
    activator = activation("lr_param.frict_comp", "friction compensation", "00522")
    prefix = PREFIX
    parameters = tuple(
        replace(row, aliases=(f"kw.{row.name}",))
        for row in (
            Parameter(_MAX_POINTS, "Reserved entries; 0: default", DataType.UNS32, _POINTS, both("00062")),
            Parameter(
                _MODE,
                "0 off, 3 additive current over the velocity",
                DataType.UNS16,
                0,
                both("00041"),
                values=(0, _ADDITIVE_CURRENT),
            ),
            Parameter(_COUNT, "Number of entries", DataType.UNS16, 0, both("00042")),
            Parameter(
                _BUILD_UP,
                "Distance over which the current builds up",
                DataType.SGN32,
                0,
                both("00043"),
                ListQuantity.POSITION,
                "[0, 10]",
                usable="[0, MAX]",
            ),
            Parameter(
                _LOOKAHEAD,
                "Cycles over which the current decays before a reversal",
                DataType.UNS16,
                0,
                both("00044"),
                ListQuantity.CYCLES,
                f"[0, {LOOKAHEAD_MAX}]",
            ),
            Parameter(
                _SCALING,
                "Factor of all currents",
                DataType.SGN16,
                1000,
                both("00045"),
                ListQuantity.PER_MILLE,
                "(MIN, MAX)",
            ),
            Parameter(
                _DELAY,
                "Cycles by which the current comes late",
                DataType.SGN16,
                0,
                both("00058"),
                ListQuantity.CYCLES,
                f"[0, {DELAY_LINE})",
            ),
            # 0 stands in the vendor's own examples; a negative velocity is the table's fault (110591).
            Parameter(
                VELOCITY,
                "Velocity",
                DataType.SGN32,
                0,
                both("00046"),
                ListQuantity.VELOCITY,
                "(0, MAX)",
                usable=BELOW_MAX,
            ),
            Parameter(CURRENT, "Current", DataType.SGN32, 0, both("00047"), ListQuantity.CURRENT, "(MIN, MAX)"),
        )
    )
    values = ("currents",)
    inputs = (
        KindInput(48, "ahead_known", "ahead_known", "velocity_ahead is given", boolean=True, present=_needs_ahead(1)),
        *(
            KindInput(
                48 + n,
                f"velocity_ahead[{n}]",
                f"velocity_ahead[{n - 1}]",
                f"Setpoint velocity {n} cycle{'s' if n > 1 else ''} later, where ahead_known",
                "{}/s",
                present=_needs_ahead(n),
            )
            for n in range(1, LOOKAHEAD_MAX + 1)
        ),
    )
    notice = "its friction compensation predicts reversals: nothing gives it velocity_ahead, as its look-ahead needs"
    columns = (VELOCITY, CURRENT)
    sizes = (_COUNT,)
    reserves = _MAX_POINTS
    points_error = 110641
    arrays = (
        TableArray(0, "velocities", "Speeds of the points", "v", "{}/s", "curve.x", "curve.points"),
        TableArray(1, "currents", "Currents at these speeds, before scaling", "y", "", "curve.y", "curve.points"),
    )
    inactive_code = "70495"
    codes = {
        "70495": (
            Severity.INFO,
            "Friction compensation: a table is there, but the axis does not activate it (P-AXIS-00522)",
        ),
        "AXC-SCALING": (Severity.WARNING, "The scaling of a friction table is 0 or negative"),
        "AXC-LOOKAHEAD": (Severity.WARNING, "The current before a reversal needs velocities that are not known yet"),
        "110591": (Severity.ERROR, "Friction compensation: velocities are negative or not ascending"),
        "110641": (Severity.ERROR, "Friction compensation: max_points was changed by an update"),
    }

    def read(self, source: TableReader) -> Friction | None:
        """Return the compensation, None where it is off or its table cannot be used."""
        values = source.values
        if values.integer(_MODE) != _ADDITIVE_CURRENT:
            source.note("AXC-INACTIVE", _MODE, f"There is a friction table, but {_MODE} is 0: it is off.")
            return None
        count = values.integer(_COUNT)
        capacity = source.capacity(_MAX_POINTS)
        if not source.fits(count, capacity, _COUNT):
            return None
        velocities = source.column(VELOCITY, count)
        currents = source.column(CURRENT, count)
        if not source.ascending(velocities, VELOCITY, "110591", _COUNT):
            return None
        if velocities[0] < 0.0:
            message = f"A velocity of the table is negative: {velocities[0]:g}; the compensation stays off."
            source.note("110591", VELOCITY, message, 0)
            return None
        if not values.converted(_SCALING) > 0.0:
            message = f"{_SCALING} = {values.number(_SCALING)} does not add what friction takes away; it is used."
            source.note("AXC-SCALING", _SCALING, message)
        if values.integer(_LOOKAHEAD) > values.integer(_DELAY):
            message = (
                f"{_LOOKAHEAD} is larger than {_DELAY}: the current before a reversal depends on velocities to come, "
                "which a host must give as velocity_ahead."
            )
            source.note("AXC-LOOKAHEAD", _LOOKAHEAD, message)
        return Friction(
            velocities=tuple(velocities),
            currents=tuple(currents),
            scaling=values.converted(_SCALING),
            position_delay=values.converted(_BUILD_UP),
            reversal_lookahead=values.integer(_LOOKAHEAD),
            delay_cycles=values.integer(_DELAY),
            max_points=capacity,
        )

    def write(self, compensation: Friction, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries."""
        lines.add(_MODE, _ADDITIVE_CURRENT)
        lines.add_unless_default(_MAX_POINTS, compensation.max_points)
        lines.add(_COUNT, len(compensation.velocities))
        lines.add_converted(_SCALING, compensation.scaling)
        lines.add_converted(_BUILD_UP, compensation.position_delay)
        lines.add(_LOOKAHEAD, compensation.reversal_lookahead)
        lines.add(_DELAY, compensation.delay_cycles)
        for i, row in enumerate(zip(compensation.velocities, compensation.currents, strict=True)):
            for name, value in zip((VELOCITY, CURRENT), row, strict=True):
                lines.add_converted(name, value, i)

    def compile(self, compensation: Friction, compiler: AxisCompiler) -> None:
        """Fill the kernel's table."""
        friction, table, require = compensation, compiler.tables.friction, compiler.require
        compiler.curve(table.curve, self.name, friction.velocities, friction.currents)
        require(friction.velocities[0] >= 0.0, "friction: velocities are not negative")
        require(abs(friction.scaling) < LARGEST, "friction: the scaling must be finite")
        require(0.0 <= friction.position_delay < LARGEST, "friction: the position delay is not negative")
        require(0 <= friction.reversal_lookahead <= LOOKAHEAD_MAX, "friction: the look-ahead is 0 … 4 cycles")
        require(0 <= friction.delay_cycles < DELAY_LINE, "friction: the delay is 0 … 248 cycles")
        table.scaling = friction.scaling
        table.position_delay = friction.position_delay
        table.lookahead = friction.reversal_lookahead
        table.delay = friction.delay_cycles
        table.modulo_range = compiler.modulo_range

    def tables(self, compensation: Friction, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return the scaled current over the speed."""
        unit = symbol(axis.unit)
        builds_up = f", builds up over {compensation.position_delay:g} {unit}" if compensation.position_delay else ""
        return (
            Curve(
                compensation.velocities,
                tuple(compensation.scaling * current for current in compensation.currents),
                Quantity(SPEED, f"{unit}/s", axis.name),
                Quantity("added current", "drive units"),
                label="current",
                entry=CURRENT,
                note=f"scaled by {compensation.scaling:g}{builds_up}",
            ),
        )

    def needs(self, compensation: Friction, axis: Axis) -> tuple[int, ...]:
        """Return nothing: it acts whether referenced or not."""
        return ()

    def looks_up(self, compensation: Friction, axis: Axis) -> Iterable[Reference]:
        """Return the motion of the axis, and what is known of the motion to come."""
        own = [one.name for one in self.inputs if one.present(compensation)]
        return tuple((axis.number, name) for name in ("setpoint", "velocity", "acceleration", *own))


KIND = FrictionKind()
