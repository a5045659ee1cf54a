"""Results that are tables too: as a data frame, as a dataset, and in a notebook."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from .extras import needed
from .html import as_html
from .quantity import symbol

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

ROWS_SHOWN = 20
"""Rows that a notebook shows at most."""


class Tabulated(NamedTuple):
    """Columns over one quantity; units of all of them by name, where they have one."""

    over: str
    index: Any
    columns: Mapping[str, Any]
    units: Mapping[str, str]


class Tabular(ABC):
    """A result with columns over one quantity."""

    @abstractmethod
    def tabulated(self) -> Tabulated:
        """Return its columns."""

    def to_frame(self) -> pd.DataFrame:
        """Return them as a data frame over an index; ``attrs["units"]`` has the units by column."""
        pandas, table = needed("pandas", "frame"), self.tabulated()
        frame: pd.DataFrame = pandas.DataFrame(dict(table.columns), index=pandas.Index(table.index, name=table.over))
        frame.attrs["units"] = dict(table.units)
        return frame

    def to_xarray(self) -> xr.Dataset:
        """Return them as a dataset; each variable has its unit in ``attrs["units"]``."""
        xarray, table = needed("xarray", "frame"), self.tabulated()

        def attributes(name: str) -> dict[str, str]:
            return {"units": table.units[name]} if table.units.get(name) else {}

        found = {name: (table.over, column, attributes(name)) for name, column in table.columns.items()}
        index = {table.over: (table.over, table.index, attributes(table.over))}
        dataset: xr.Dataset = xarray.Dataset(found, coords=index)
        return dataset

    def _repr_html_(self) -> str:
        """Return the first rows as a table, for notebooks."""
        table = self.tabulated()
        units = {name: f" [{symbol(unit)}]" for name, unit in table.units.items() if unit}
        rows = zip(table.index, *table.columns.values(), strict=True)
        shown = [[_cell(cell) for cell in row] for row, _ in zip(rows, range(ROWS_SHOWN), strict=False)]
        left = len(table.index) - len(shown)
        header = [name + units.get(name, "") for name in (table.over, *table.columns)]
        return as_html(header, shown, caption=f"{left} more rows" if left else "")


def _cell(cell: Any) -> str:
    return f"{float(cell):.6g}" if isinstance(cell, int | float) or hasattr(cell, "dtype") else str(cell)
