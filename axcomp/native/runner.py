"""Many cycles in the compiled kernel: the same bits as the Python one."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import Variable
from ..kernel import Inputs, Outputs, State, Tables
from ..model import Machine
from ..runtime import Runtime, pack, unpack
from .layout import address_of, ctypes_of, from_c, to_c

if TYPE_CHECKING:
    from numpy.typing import NDArray

POKES_MAX = 256
"""Values that a command sets at most."""

_FIELD = np.dtype([("column", np.uintp), ("stride", np.int64), ("at", np.uintp)], align=True)
_EVENT = np.dtype([("row", np.int64), ("first", np.int32), ("count", np.int32)])
_POKE = np.dtype([("at", np.uintp), ("value", np.int32), ("held", np.int32)], align=True)
_DTYPES: dict[type, Any] = {float: np.float64, int: np.int64, bool: np.bool_}

Poke = tuple[int, int, bool]
"""What a command sets: the address, the value, and whether it is a Boolean that is put back behind the cycle; else it
is an Integer."""


class _Columns(ctypes.Structure):
    _fields_ = (
        ("fields", ctypes.c_void_p),
        ("reals", ctypes.c_int64),
        ("integers", ctypes.c_int64),
        ("booleans", ctypes.c_int64),
    )


class _Run(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_void_p) for name in ("tables", "pool", "state", "inputs", "outputs")),
        ("given", _Columns),
        ("results", _Columns),
        ("events", ctypes.c_void_p),
        ("event_count", ctypes.c_int64),
        ("pokes", ctypes.c_void_p),
        ("rows", ctypes.c_int64),
    )


class Bound:
    """Fields of Inputs or Outputs with their columns, as C takes them; it keeps the columns alive."""

    def __init__(self, fields: NDArray[Any], counts: Sequence[int], columns: object) -> None:
        self._fields, self._counts, self._kept = fields, counts, columns
        self.columns = _Columns(fields.__array_interface__["data"][0], *counts)

    def from_row(self, first: int) -> Bound:
        """Return the same without the rows before ``first``."""
        if first == 0:
            return self
        fields = self._fields.copy()
        fields["column"] += (first * fields["stride"]).astype(np.uintp)
        return Bound(fields, self._counts, self._kept)


class Fields:
    """Where some variables lie in memory.

    Attributes
    ----------
    dtypes : list of numpy dtypes
        Of their columns: float64, int64 or bool.
    """

    def __init__(self, variables: Sequence[Variable], places: Sequence[int]) -> None:
        types = [type(variable.start) for variable in variables]
        self.dtypes = [_DTYPES[kind] for kind in types]
        ranks = [list(_DTYPES).index(kind) for kind in types]
        self._order = np.argsort(ranks, kind="stable")
        self._counts = [ranks.count(rank) for rank in range(len(_DTYPES))]
        self._fields = np.empty(len(variables), _FIELD)
        self._fields["at"] = places

    def bound(self, addresses: Sequence[int], strides: Sequence[int], columns: object) -> Bound:
        """Return the fields with columns at such addresses, whose elements are so many bytes apart."""
        self._fields["column"] = addresses
        self._fields["stride"] = strides
        return Bound(self._fields[self._order], self._counts, columns)

    def of(self, columns: Sequence[NDArray[Any]]) -> Bound:
        """Return the fields with these columns, which have their types."""
        addresses = [column.__array_interface__["data"][0] for column in columns]
        return self.bound(addresses, [column.strides[0] for column in columns], columns)

    def new(self, rows: int) -> tuple[Bound, list[NDArray[Any]]]:
        """Return the fields with new columns, and these, in the order of the variables."""
        blocks = [np.empty((count, rows), dtype) for count, dtype in zip(self._counts, _DTYPES.values(), strict=True)]
        columns: list[NDArray[Any]] = [blocks[0]] * len(self.dtypes)
        addresses, strides = [0] * len(columns), [0] * len(columns)
        places = iter(self._order.tolist())
        for block in blocks:
            begin, size, item = block.__array_interface__["data"][0], block.strides[0], block.itemsize
            for k, column in enumerate(block):
                place = next(places)
                columns[place], addresses[place], strides[place] = column, begin + k * size, item
        return self.bound(addresses, strides, blocks), columns


NOTHING = Fields((), ()).of(())


class CompiledRuntime(Runtime):
    """A machine in operation whose records lie in memory as C has them; its cycles run in a compiled kernel.

    ``kernel`` comes from ``library.compiled_kernel``; the rest as in ``Runtime``.
    """

    def __init__(self, machine: Machine, cycle_time: float, kernel: ctypes.CDLL) -> None:
        super().__init__(machine, cycle_time)
        self._run_rows = kernel.axcomp_run
        self._run_rows.restype = None
        self._run = _Run()
        self._run.state, self._run.inputs, self._run.outputs = map(
            ctypes.addressof, (self._in_c(record) for record in (self.state, self.inputs, self.outputs))
        )
        self._call = ctypes.byref(self._run)
        self._bound: tuple[Tables, Any, NDArray[np.float64]] | None = None

    def _records(self) -> tuple[State, Inputs, Outputs]:
        """Return structures with the same fields, which own the arrays that they point to."""
        state, inputs, outputs = map(_structure_of, super()._records())
        return state, inputs, outputs  # type: ignore[return-value]

    @staticmethod
    def _in_c(record: Any) -> ctypes.Structure:
        structure: ctypes.Structure = record
        return structure

    def fields(self, variables: Sequence[Variable]) -> Fields:
        """Return where inputs or outputs lie; they stay there as long as the runtime lives."""
        owners = (self.outputs if variable.causality == "output" else self.inputs for variable in variables)
        return Fields(
            variables, [address_of(self._in_c(owner), _path_of(v)) for owner, v in zip(owners, variables, strict=True)]
        )

    def begin(self, time: float = 0.0) -> None:
        """Set the clock and compute the outputs of the first cycle without running it."""
        state, _, _ = self._in_python()
        self.cycle()
        to_c(state, self._in_c(self.state))
        self.start_time, self.cycles = time, 0

    def cycle(self) -> None:
        """Run one cycle: the outputs then belong to the present inputs."""
        self.run(NOTHING, NOTHING, 1)

    def run(self, given: Bound, results: Bound, rows: int, events: Sequence[tuple[int, Sequence[Poke]]] = ()) -> None:
        """Run one cycle for each row of the columns ``given``, and put the outputs into the columns ``results``.

        ``events``: in the order of their rows, what NC commands set before the cycle of a row.
        """
        run = self._run
        if self._bound is None or self._bound[0] is not self.tables:
            self._bind()
        run.given, run.results, run.rows = given.columns, results.columns, rows
        if events:
            at, pokes = _listed(events)
            run.events, run.pokes, run.event_count = at.ctypes.data, pokes.ctypes.data, len(at)
        else:
            run.event_count = 0
        self._run_rows(self._call)
        self.cycles += rows

    def _bind(self) -> None:
        """Lay the tables in force out for C; that costs more than many cycles."""
        tables = self.tables
        structure = _structure_of(tables)
        pool = np.array(self.pool, dtype=np.float64)
        self._bound = tables, structure, pool
        self._run.tables, self._run.pool = ctypes.addressof(structure), pool.ctypes.data

    def save(self) -> bytes:
        """Return the snapshot that a Runtime in Python would."""
        return pack(self._machine_identity(), *self._in_python(), [self.start_time, float(self.cycles)])

    def restore(self, data: bytes) -> None:
        """Go back to a snapshot of this machine."""
        records, clock = self._in_python(), [0.0, 0.0]
        unpack(data, self._machine_identity(), *records, clock)
        for record, structure in zip(records, (self.state, self.inputs, self.outputs), strict=True):
            to_c(record, self._in_c(structure))
        self.start_time, self.cycles = clock[0], int(clock[1])

    def _in_python(self) -> tuple[State, Inputs, Outputs]:
        records = super()._records()
        for record, structure in zip(records, (self.state, self.inputs, self.outputs), strict=True):
            from_c(self._in_c(structure), record)
        return records


def _structure_of(record: Any) -> ctypes.Structure:
    structure = ctypes_of(type(record))()
    to_c(record, structure)
    return structure


def _listed(events: Sequence[tuple[int, Sequence[Poke]]]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return events and what they set as C takes them; what is set alike is listed once."""
    programs = {id(program): program for _, program in events}
    ends = dict(zip(programs, accumulate(map(len, programs.values())), strict=True))
    found = np.empty(len(events), _EVENT)
    found["row"] = [row for row, _ in events]
    found["count"] = [len(program) for _, program in events]
    found["first"] = np.array([ends[id(program)] for _, program in events]) - found["count"]
    return found, np.array([poke for program in programs.values() for poke in program], _POKE)


def _path_of(variable: Variable) -> str:
    if variable.axis is not None:
        return f"axis[{variable.axis}].{variable.field}"
    if variable.volumetric is not None:
        return f"volumetric[{variable.volumetric}].{variable.field}"
    return variable.field
