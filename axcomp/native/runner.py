"""Whole trajectories in the compiled kernel: the same bits as the Python one."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import Variable
from ..kernel import Tables, Vec
from ..runtime import Runtime
from .layout import address_of, ctypes_of, from_c, to_c

if TYPE_CHECKING:
    from numpy.typing import NDArray

DOUBLES = ctypes.POINTER(ctypes.c_double)


class _Field(ctypes.Structure):
    _fields_ = (("at", ctypes.c_void_p), ("type", ctypes.c_char))


class CompiledTables:
    """Tables as C has them; making them costs more than many cycles, so they are kept as long as they are in force.

    ``tables``: what they were made of, which the kernel never changes; ``pool``: the numbers that they point into.
    """

    def __init__(self, tables: Tables, pool: Vec) -> None:
        self.tables = tables
        self.structure: Any = ctypes_of(Tables)()
        axes, volumetrics = tables.axis[: tables.axis_count], tables.volumetric[: tables.volumetrics]
        to_c(replace(tables, axis=axes, volumetric=volumetrics), self.structure)
        self.pool = np.array(pool, dtype=np.float64)


def run_compiled(
    kernel: ctypes.CDLL,
    compiled: CompiledTables,
    runtime: Runtime,
    given: Sequence[Variable],
    rows: NDArray[np.float64],
    results: Sequence[Variable],
) -> NDArray[np.float64]:
    """Run one cycle for each row; the runtime is then where as many calls of ``cycle`` had brought it.

    ``kernel`` comes from ``library.compiled_kernel``, ``compiled`` are the runtime's tables; its state, inputs and
    outputs go into the kernel and come back. ``rows``, shape (n, len(given)), C-contiguous, are the inputs ``given``,
    Booleans 0 or 1. Returns the outputs ``results``, shape (n, len(results)).
    """
    records = [(record, ctypes_of(type(record))()) for record in (runtime.state, runtime.inputs, runtime.outputs)]
    for record, struct in records:
        to_c(record, struct)
    _, inputs, outputs = (struct for _, struct in records)
    values = np.empty((len(rows), len(results)))
    kernel.axcomp_run(
        ctypes.byref(compiled.structure),
        compiled.pool.ctypes.data_as(DOUBLES),
        *(ctypes.byref(struct) for _, struct in records),
        ctypes.c_int64(len(rows)),
        _fields(inputs, given),
        ctypes.c_int32(len(given)),
        rows.ctypes.data_as(DOUBLES),
        _fields(outputs, results),
        ctypes.c_int32(len(results)),
        values.ctypes.data_as(DOUBLES),
    )
    for record, struct in records:
        from_c(struct, record)
    runtime.cycles += len(rows)
    return values


def _fields(struct: ctypes.Structure, variables: Sequence[Variable]) -> Any:
    fields = (_Field * len(variables))()
    for field, variable in zip(fields, variables, strict=True):
        owner = ""
        if variable.axis is not None:
            owner = f"axis[{variable.axis}]."
        elif variable.volumetric is not None:
            owner = f"volumetric[{variable.volumetric}]."
        field.at = address_of(struct, owner + variable.field)
        field.type = {float: b"r", bool: b"b", int: b"i"}[type(variable.start)]
    return fields
