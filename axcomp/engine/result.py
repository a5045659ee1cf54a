"""What a run puts out: columns by the names of the FMU's variables, with units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..model import Tabular, Tabulated, needed, symbol
from ..saving import write_whole

if TYPE_CHECKING:
    import os

    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray


PLOTTED_MAX = 6
"""Panels of a picture at most: one for each unit."""


@dataclass(frozen=True, eq=False, repr=False)
class Result(Tabular, Mapping[str, "NDArray[Any]"]):
    """Outputs of a run: a mapping from the name of a variable to its values, one a cycle.

    Attributes
    ----------
    time : array, shape (n,)
        Instants of the cycles, s.
    columns : mapping of str to array, shape (n,)
        Float, int or bool.
    notices : tuple of str
        What the run has to say, a sentence each.
    units : mapping of str to str
        By name, as the FMU has them; bare numbers are not in it.

    Examples
    --------
    >>> from axcomp import Engine, models
    >>> result = Engine(models() / "rotary_table").run({"C.setpoint": [0.0, 90.0, 180.0]})
    >>> result.cycles, result.units["C.velocity"] if "C.velocity" in result else "an input"
    (3, 'an input')
    >>> {name: len(values) for name, values in result.items() if name.endswith("setpoint")}
    {'C.corrected_setpoint': 3}
    """

    time: NDArray[np.float64]
    columns: Mapping[str, NDArray[Any]]
    notices: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the values of one variable, shape (n,)."""
        return self.columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        """Return the number of variables; ``cycles`` is that of the rows."""
        return len(self.columns)

    def __repr__(self) -> str:
        return f"Result({self.cycles} cycles of {len(self)} variables: {', '.join(self)})"

    @property
    def cycles(self) -> int:
        """Number of cycles."""
        return len(self.time)

    def tabulated(self) -> Tabulated:
        """Return the columns over the time."""
        return Tabulated("time", self.time, self.columns, {"time": "s", **self.units})

    def plot(self, *names: str) -> Figure:
        """Draw the variables ``names`` over the time, a panel for each unit; return the figure.

        Without names: all that are not 0 all the time. KeyError, with the known names, for one that is none.
        """
        figures = needed("matplotlib.figure", "plot")
        if unknown := [name for name in names if name not in self.columns]:
            raise KeyError(f"{', '.join(unknown)}: no output; the outputs are {', '.join(self)}")
        chosen = names or tuple(name for name, column in self.items() if column.any()) or tuple(self)[:1]
        groups: dict[str, list[str]] = {}
        for name in chosen:
            boolean = self[name].dtype == bool
            groups.setdefault("on" if boolean else symbol(self.units.get(name, "")), []).append(name)
        panels = list(groups.items())[:PLOTTED_MAX]
        drawing: Figure = figures.Figure(figsize=(10.0, 1.2 + 2.2 * len(panels)), dpi=120, layout="constrained")
        drawing.suptitle(f"{self.cycles} cycles, {_span(self.time)}", fontsize=11)
        for place, (unit, members) in enumerate(panels, 1):
            ax = drawing.add_subplot(len(panels), 1, place)
            for name in members:
                ax.plot(self.time, self[name].astype(float), label=name, linewidth=1.2)
            ax.set_ylabel(f"[{unit}]" if unit and unit != "on" else unit or "bare number")
            ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8, frameon=False)
            ax.grid(alpha=0.3)
        drawing.axes[-1].set_xlabel("time [s]")
        return drawing

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write time and all variables to ``path``, as CSV that reads back to the same bits."""
        write_whole(path, "".join(f"{line}\n" for line in self.csv_lines()).encode())

    def csv_lines(self) -> Iterator[str]:
        """Yield the lines that ``to_csv`` writes."""
        columns = [self.time.tolist(), *(column.tolist() for column in self.columns.values())]
        yield ",".join(["time", *self.columns])
        for row in zip(*columns, strict=True):
            yield ",".join(repr(float(value)) for value in row)


def _span(time: NDArray[np.float64]) -> str:
    return f"{time[0]:g} … {time[-1]:g} s" if len(time) else "none"
