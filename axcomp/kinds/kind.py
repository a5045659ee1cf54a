"""What is declared of a kind of compensation: everything that is special about it, for all the rooms above.

A kind is one module of this room: the class of its compensations, the parameters of its lists, how it is read, written
and compiled, and what it depends on. The kernel has a module of the same name with its formula.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, ClassVar, Generic, Literal, NamedTuple, Protocol, TypeVar

from ..kernel import CompensationTables, fields_of
from ..model import Axis, AxisType, Compensation, Machine, ModuloRange
from .compiling import AxisCompiler
from .parameter import Codes, ListKind, Parameter, Value
from .shown import Range, Table, ranges_of
from .units import Gear

C = TypeVar("C", bound=Compensation)
Reference = tuple[int, str]
"""Logical number of an axis and name of one of its inputs."""


class AxisFacts(Protocol):
    """What the axis lists say about an axis."""

    number: int
    type: AxisType
    modulo: ModuloRange | None
    gear: Gear
    backlash_cycles: int


class Values(Protocol):
    """The plausible values of one list; where it is silent, the defaults."""

    def cells(self, name: str) -> Mapping[tuple[int, ...], Any]:
        """Return indices → value and line of all that is given for a parameter."""

    def count(self, name: str) -> int:
        """Return how many entries are given for a parameter."""

    def given(self, name: str, *indices: int) -> bool:
        """Whether an entry is there."""

    def spelt(self, name: str) -> bool:
        """Whether a parameter is given by this very name."""

    def number(self, name: str, *indices: int) -> Any:
        """Return a number in the unit of the list."""

    def integer(self, name: str, *indices: int) -> int:
        """Return a count, index, axis number or number of cycles."""

    def flag(self, name: str) -> bool:
        """Return a Boolean."""

    def text(self, name: str, *indices: int) -> str:
        """Return a string."""

    def converted(self, name: str, *indices: int, gear: Gear = ...) -> float:
        """Return a number in mm, °, mm/s, °/s or as a factor."""


class TableReader(Protocol):
    """The list of an axis being read: its values, the axis, the other axes, and where to note findings."""

    @property
    def values(self) -> Values:
        """What the list says."""

    @property
    def axis(self) -> AxisFacts:
        """The axis it is for."""

    def note(self, code: str, name: str, message: str, *indices: int) -> None:
        """Note a finding at an entry."""

    def axis_of(self, name: str, purpose: str, code: str = "AXC-MASTER") -> Any:
        """Return the axis whose number an entry gives; a finding and None if there is none."""

    def note_own_master(self, name: str) -> None:
        """Warn when an axis is named as its own master."""

    def gears(self, unit: str, *axes: Any) -> list[Gear]:
        """Return how to convert positions of axes: as they stand, or from encoder increments."""

    def capacity(self, name: str) -> int:
        """Return max_points; 0 stands for the default."""

    def fits(self, used: int, capacity: int, size_name: str) -> bool:
        """Check the used size of a table, with a finding if it is 0 or too large."""

    def column(self, name: str, *counts: int, gear: Gear = ...) -> list[float]:
        """Return the used part of a table, converted, the last index running fastest; missing entries are 0."""

    def note_unused(self, name: str, reason: str) -> None:
        """Say that entries which are there are not used."""

    def ascending(self, positions: Sequence[float], name: str, code: str, size_name: str) -> bool:
        """Check that positions ascend strictly; a finding at the first that does not."""


class EntryWriter(Protocol):
    """The entries of a list being written; each method raises ValueError for what a list cannot hold."""

    def add(self, name: str, value: Value, *indices: int) -> None:
        """Append an entry with a value in the unit of the list."""

    def add_converted(self, name: str, value: float, *indices: int) -> None:
        """Append an entry with a value in mm, °, mm/s, °/s or a factor."""

    def add_unless_default(self, name: str, value: Value) -> None:
        """Append an entry unless the default says the same."""


@dataclass(frozen=True)
class KindInput:
    """An input of the FMU that only one kind has.

    Attributes
    ----------
    identifier : int
        In the block of value references of its axis.
    name : str
        Behind the axis': ``temperature.offset``.
    path : str
        Of its field in the kernel's record of the kind's inputs.
    description : str
        One sentence without a full stop.
    unit : str
        ``{}`` stands for mm or deg.
    boolean : bool
        It is a Boolean.
    present : callable
        Tells whether a compensation has it; None stands for a kind that is activated without a table.
    """

    identifier: int
    name: str
    path: str
    description: str
    unit: str = ""
    boolean: bool = False
    present: Callable[[Any], bool] = lambda _: True


class TableArray(NamedTuple):
    """Numbers of a kind's table that a host of FMI 3.0 reads and calibrates.

    ``number``: with the kind's identifier, that of the array in the block of its axis' tables; ``name``: behind the
    kind's; ``of``: ``x`` abscissae, ``v`` those of a speed, ``y`` values; ``unit``: as in ``KindInput``, of abscissae
    for the axis they are looked up with. ``at``, ``points``, ``rows``, ``argument`` are paths in the kernel's table: of
    the index in the pool, the counts ("": one row), and what looks the abscissae up ("": no position).
    """

    number: int
    name: str
    description: str
    of: Literal["x", "v", "y"]
    unit: str
    at: str
    points: str
    rows: str = ""
    argument: str = ""


class Kind(ABC, Generic[C]):
    """A kind of compensation; every module of this room but the common ones ends with one.

    Attributes
    ----------
    name : str
        As it is called everywhere: fields, variables of the FMU, options.
    title : str
        As it begins a sentence or stands above a table.
    word : str
        In NC commands: ``X[COMP ON CROSS]``.
    identifier : int
        First of the identifiers of its variables in a block of value references: enable, active, correction.
    adds_to : str
        ``setpoint``, or ``current`` of the motor.
    activator : Parameter
        The entry of the axis list that activates it.
    list_kind : ListKind
        The list its entries stand in.
    prefix : str
        What their names begin with.
    parameters : tuple of Parameter
        All its entries, in the order of the manuals.
    values : tuple of str
        Fields of the compensation, and of records in it, that grow with what is compensated: a factor multiplies them.
    columns, sizes : tuple of str
        Entries whose presence, or whose value above 0, means that there is a table.
    places : tuple of str
        Entries that say where a table lies: the wrong default would go unnoticed.
    reserves : str
        Entry that says how many entries the controller keeps free for its table; "" if none does.
    points_error : int
        Of an update that changes what is reserved for its table; 0: there is no such thing.
    at_standstill : bool
        A command waits until the axis stands.
    inputs : tuple of KindInput
        Of its own, besides those that every kind has.
    arrays : tuple of TableArray
        Numbers of its table that a host of FMI 3.0 may change; none: it may not.
    codes : mapping
        Of findings that only this kind has.
    inactive_code, no_table_code : str
        Of the findings about a table that nothing activates, and about an activated kind without a table.
    notice : str
        What the user should know once the kernel says so (``has_notice``).
    """

    name: ClassVar[str]
    title: ClassVar[str]
    word: ClassVar[str]
    identifier: ClassVar[int]
    adds_to: ClassVar[Literal["setpoint", "current"]] = "setpoint"
    activator: ClassVar[Parameter]
    list_kind: ClassVar[ListKind] = ListKind.COMPENSATION
    prefix: ClassVar[str]
    parameters: ClassVar[tuple[Parameter, ...]]
    values: ClassVar[tuple[str, ...]]
    columns: ClassVar[tuple[str, ...]] = ()
    sizes: ClassVar[tuple[str, ...]] = ()
    places: ClassVar[tuple[str, ...]] = ()
    reserves: ClassVar[str] = ""
    points_error: ClassVar[int] = 0
    at_standstill: ClassVar[bool] = False
    inputs: ClassVar[tuple[KindInput, ...]] = ()
    arrays: ClassVar[tuple[TableArray, ...]] = ()
    codes: ClassVar[Codes] = {}
    inactive_code: ClassVar[str] = "AXC-INACTIVE"
    no_table_code: ClassVar[str] = "AXC-NO-TABLE"
    notice: ClassVar[str] = ""

    @property
    def number(self) -> int:
        """Return its number in the kernel: the place of its tables among those of an axis."""
        return KIND_NAMES.index(self.name)

    def is_activated(self, values: Values) -> bool:
        """Tell whether an axis list activates it."""
        return values.integer(self.activator.name) != 0

    def activation(self, compensation: C | None) -> Value:
        """Return the value of the activator for an axis that has it, or is ready for it."""
        return 1

    def is_present(self, values: Values) -> bool:
        """Tell whether a list has entries of a table, or says that there should be some."""
        given = any(values.count(name) for name in self.columns)
        return given or any(values.given(name) and values.integer(name) > 0 for name in self.sizes)

    @abstractmethod
    def read(self, source: TableReader) -> C | None:
        """Return the compensation that a list describes; None, with a finding, where its table cannot be used."""

    @abstractmethod
    def write(self, compensation: C, axis: Axis, lines: EntryWriter) -> None:
        """Append the entries of a compensation; ``read`` returns the same from them."""

    @abstractmethod
    def compile(self, compensation: C, compiler: AxisCompiler) -> None:
        """Fill the kernel's table; CompileError for a compensation made by hand that cannot be run."""

    @abstractmethod
    def tables(self, compensation: C, machine: Machine, axis: Axis) -> tuple[Table, ...]:
        """Return what is shown, judged and converted: tables of one class over the same quantities, at least one."""

    def ranges(self, compensation: C, tables: tuple[Table, ...], machine: Machine) -> list[Range]:
        """Return over what, and from where to where, a compensation has values of its own; ``tables``: its own."""
        return ranges_of(tables) if tables[0].entry else []

    def scaled(self, compensation: C, factor: float) -> C:
        """Return a compensation that adds so many times as much."""
        scaled: C = _times(compensation, self.values, factor)
        return scaled

    def reserved(self, compensation: C | None, values: Values | None = None) -> int:
        """Return how many entries the controller keeps free for its table, at least 1.

        ``compensation`` None: there is no table yet; ``values``: the list that may say how large it can become.
        """
        if not self.reserves:
            return 1
        default = next(int(row.default) for row in self.parameters if row.name == self.reserves)
        if compensation is not None:
            return getattr(compensation, "max_points", None) or default
        return (0 if values is None else values.integer(self.reserves)) or default

    def needs(self, compensation: C, axis: Axis) -> tuple[int, ...]:
        """Return the logical numbers of the axes that must be referenced."""
        return (axis.number,)

    def looks_up(self, compensation: C, axis: Axis) -> Iterable[Reference]:
        """Return the inputs that its value at full weight is computed from."""
        return ((axis.number, "setpoint"),)

    def follows(self, compensation: C) -> bool:
        """Tell whether its value depends on what the kinds before it add."""
        return False


def _times(value: Any, names: tuple[str, ...], factor: float) -> Any:
    """Return a number times a factor; of a tuple all its items, of a record the fields with these names."""
    if isinstance(value, tuple):
        return tuple(_times(item, names, factor) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        own = [field.name for field in fields(value) if field.name in names]
        return replace(value, **{name: _times(getattr(value, name), names, factor) for name in own})
    return None if value is None else value * factor


KIND_NAMES = tuple(fields_of(CompensationTables))
"""All kinds in the order of a cycle: the kernel's tables of an axis say it."""
