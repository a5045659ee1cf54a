"""Whole trajectories in the compiled kernel: the same bits as the Python one."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..fmu.variable import Variable
from ..kernel.records import Inputs, Outputs, State, Tables
from ..runtime import Runtime
from .layout import ctypes_of, from_c, to_c

if TYPE_CHECKING:
    from numpy.typing import NDArray

DOUBLES = ctypes.POINTER(ctypes.c_double)


class _Field(ctypes.Structure):
    _fields_ = (("offset", ctypes.c_int32), ("type", ctypes.c_char))


def run_compiled(
    kernel: ctypes.CDLL,
    runtime: Runtime,
    given: Sequence[Variable],
    rows: NDArray[np.float64],
    results: Sequence[Variable],
) -> NDArray[np.float64]:
    """Run one cycle for each row; the runtime is then where as many calls of ``cycle`` had brought it.

    Parameters
    ----------
    kernel : CDLL
        From ``library.compiled_kernel``.
    runtime : Runtime
        Its state, inputs and outputs go into the kernel and come back.
    given : sequence of Variable
        Inputs of the columns.
    rows : ndarray, shape (n, len(given))
        C-contiguous; Booleans are 0 or 1.
    results : sequence of Variable
        Outputs wanted.

    Returns
    -------
    ndarray, shape (n, len(results))
    """
    tables, pools = _tables_in_c(runtime.tables)
    state, inputs, outputs = ctypes_of(State)(), ctypes_of(Inputs)(), ctypes_of(Outputs)()
    records = ((runtime.state, state), (runtime.inputs, inputs), (runtime.outputs, outputs))
    for record, struct in records:
        to_c(record, struct)
    values = np.empty((len(rows), len(results)))
    kernel.axcomp_run(
        ctypes.byref(tables),
        ctypes.byref(state),
        ctypes.byref(inputs),
        ctypes.byref(outputs),
        ctypes.c_int64(len(rows)),
        _fields(ctypes_of(Inputs), given),
        ctypes.c_int32(len(given)),
        rows.ctypes.data_as(DOUBLES),
        _fields(ctypes_of(Outputs), results),
        ctypes.c_int32(len(results)),
        values.ctypes.data_as(DOUBLES),
    )
    del pools
    for record, struct in records:
        from_c(struct, record)
    runtime.cycles += len(rows)
    return values


def _tables_in_c(tables: Tables) -> tuple[Any, list[Any]]:
    """Return the tables as a structure, and the pools that must live as long; axes mostly share one pool."""
    structure = ctypes_of(Tables)()
    axes = tables.axis[: tables.axis_count]
    bare = replace(tables, pool=[], axis=[replace(axis, pool=[]) for axis in axes])
    to_c(replace(bare, volumetric=tables.volumetric[: tables.volumetrics]), structure)
    pools = {id(pool): np.array(pool, dtype=np.float64) for pool in (tables.pool, *(axis.pool for axis in axes))}
    structure.pool = pools[id(tables.pool)].ctypes.data_as(DOUBLES)
    for index, axis in enumerate(axes):
        structure.axis[index].pool = pools[id(axis.pool)].ctypes.data_as(DOUBLES)
    return structure, list(pools.values())


def _fields(cls: Any, variables: Sequence[Variable]) -> Any:
    fields = (_Field * len(variables))()
    for field, variable in zip(fields, variables, strict=True):
        place, structure = 0, cls
        if variable.axis is not None:
            structure = dict(cls._fields_)["axis"]._type_
            place = cls.axis.offset + variable.axis * ctypes.sizeof(structure)
        elif variable.volumetric is not None:
            structure = dict(cls._fields_)["volumetric"]._type_
            place = cls.volumetric.offset + variable.volumetric * ctypes.sizeof(structure)
        field.offset = place + getattr(structure, variable.field).offset
        field.type = {float: b"r", bool: b"b", int: b"i"}[type(variable.start)]
    return fields
