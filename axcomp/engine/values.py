"""Values of inputs and outputs: what is taken for one, columns of them, and rows in memory."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interface import INTEGER_MAX, Value, Variable, whole
from ..native import Bound, CompiledRuntime

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_PACKED: dict[type, str] = {float: "d", int: "q", bool: "?7x"}


def taken(variable: Variable) -> Callable[[Any], Value]:
    """Return what makes of a given value one that the variable has."""
    return (lambda value: whole(float(value))) if variable.type == "Integer" else type(variable.start)


def column_of(values: ArrayLike, variable: Variable) -> NDArray[Any]:
    """Return the same of a column; as int64 where it is one of integers."""
    if variable.type != "Integer":
        return np.asarray(values).astype(type(variable.start), copy=False)
    given = np.asarray(values, dtype=np.float64)
    return np.where(np.abs(given) < INTEGER_MAX, np.floor(given + 0.5), INTEGER_MAX).astype(np.int64)


class Row:
    """Inputs and outputs of one cycle side by side in memory, for steps that always set the same inputs."""

    def __init__(self, runtime: CompiledRuntime, given: Sequence[Variable], results: Sequence[Variable]) -> None:
        self._given, given_fields = _packed(runtime, given)
        self._results, result_fields = _packed(runtime, results)
        self._fields = given_fields, result_fields
        self._names = tuple(variable.name for variable in results)
        self._takes = [taken(variable) for variable in given]
        self._kinds = [(variable.name, np.dtype(type(variable.start))) for variable in results]

    def step(self, runtime: CompiledRuntime, values: Mapping[str, Value]) -> dict[str, Value]:
        """Set the inputs, run one cycle, and return the outputs by name."""
        write, given = self._given
        try:
            write.pack_into(given, 0, *values.values())
        except struct.error:  # what float and int understand besides numbers
            write.pack_into(given, 0, *(take(x) for take, x in zip(self._takes, values.values(), strict=True)))
        runtime.run(*self._fields, 1)
        read, results = self._results
        return dict(zip(self._names, read.unpack_from(results), strict=True))

    def columns(self) -> dict[str, NDArray[Any]]:
        """Return the outputs of the last step as columns of one row."""
        cells = np.array(self._results[1])
        views = {kind: cells.view(kind)[:: 8 // kind.itemsize] for kind in {kind for _, kind in self._kinds}}
        return {name: views[kind][k : k + 1] for k, (name, kind) in enumerate(self._kinds)}


def _packed(
    runtime: CompiledRuntime, variables: Sequence[Variable]
) -> tuple[tuple[struct.Struct, ctypes.Array[ctypes.c_double]], Bound]:
    """Return how the values of some variables are packed, eight bytes each, the bytes, and the fields there."""
    form = struct.Struct("=" + "".join(_PACKED[type(variable.start)] for variable in variables))
    cells = (ctypes.c_double * len(variables))()
    begin = ctypes.addressof(cells)
    addresses = range(begin, begin + 8 * len(cells), 8)
    return (form, cells), runtime.fields(variables).bound(addresses, [0] * len(cells), cells)
