"""Readings: classes whose fields say which columns of a file they are, read, chosen and joined alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self, TypeVar, get_origin, get_type_hints

import numpy as np
import numpy.typing as npt

from .columns import Column, Columns, MeasurementError, read_columns

RUN = Column("run", optional=True, aliases=("cycle",))
"""Where there is one run only, a file need not say so."""


class Readings:
    """A measurement: a dataclass of arrays with one element a reading, and of what these have in common.

    A field that is a column of a file is ``Annotated`` with it, one of several side by side with all of these.
    Positions are in mm or °, deviations in µm or ″; a position that may be missing is 0 then, and runs are 1.
    """

    __dataclass_fields__: ClassVar[dict[str, Any]]
    runs: npt.NDArray[np.int64]
    source: str

    @classmethod
    def read(cls, path: str | Path, axis: str = "") -> Self:
        """Read a file, of several axes in it that of ``axis``; MeasurementError with the line if it cannot be read."""
        hints = get_type_hints(cls, include_extras=True)
        groups = {name: hint.__metadata__ for name, hint in hints.items() if get_origin(hint) is Annotated}
        every = [one for group in groups.values() for one in group]
        found = read_columns(Path(path), sorted(every, key=lambda one: one.optional), axis)
        values: dict[str, Any] = cls.about(found)
        for name, group in groups.items():
            arrays: list[Any] = [
                found.positions(one.name) if one.unit in _LARGE else found.values.get(one.name) for one in group
            ]
            values[name] = np.column_stack(arrays) if len(arrays) > 1 else arrays[0]
            if group[0].direction:
                values[name] = values[name].astype(np.int64)
        return cls(**{**values, "runs": whole_runs(found)})

    @classmethod
    def about(cls, columns: Columns) -> dict[str, Any]:
        """Return fields that are no columns."""
        return {"source": columns.file}

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Return what there is of each reading, by name."""
        values = {item.name: getattr(self, item.name) for item in fields(self)}
        return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}

    def only(self, chosen: npt.NDArray[np.bool_]) -> Self:
        """Return the measurement with some of its readings."""
        return replace(self, **{name: value[chosen] for name, value in self.arrays().items()})


Measurement = TypeVar("Measurement", bound=Readings)
_LARGE = ("mm", "deg")
"""Usual units of what is a position."""


def joined(measurements: Sequence[Measurement]) -> Measurement:
    """Return several measurements of the same as one; the runs of later ones are counted on.

    Raises
    ------
    MeasurementError
        They are not of the same unit.
    """
    first = measurements[0]
    for other in measurements[1:]:
        for name in (item.name for item in fields(first)):
            if name.endswith("unit") and getattr(other, name) != getattr(first, name):
                sentence = f"It is in {getattr(other, name)}, {first.source} in {getattr(first, name)}."
                raise MeasurementError(other.source, 0, sentence)
    stacked: dict[str, Any] = {
        name: np.concatenate([getattr(m, name) for m in measurements]) for name in first.arrays()
    }
    passed = np.cumsum([0, *(m.runs.max() for m in measurements[:-1])])
    stacked["runs"] = np.concatenate([m.runs + n for m, n in zip(measurements, passed, strict=True)])
    stacked["source"] = ", ".join(dict.fromkeys(m.source for m in measurements))
    return replace(first, **stacked)


def whole_runs(columns: Columns) -> npt.NDArray[np.int64]:
    """Return the column ``run``, 1 everywhere where there is none; MeasurementError if a run is no whole number."""
    runs = columns.values.get("run", np.ones(len(columns.lines)))
    for line, run in zip(columns.lines, runs, strict=True):
        if run != np.floor(run) or not 0 <= run < 10**6:
            raise MeasurementError(columns.file, int(line), f"{run:g} is no number of a run; 1, 2, … are.")
    return runs.astype(np.int64)
