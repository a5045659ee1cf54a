"""Tables and sentences in the terminal."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

WIDTH_PIPED = 160
"""Columns where the output is no terminal: wide enough that no cell is cut."""


def console() -> Console:
    """Return where to print; text is shown as it is, without markup."""
    found = Console(markup=False, highlight=False, emoji=False)
    return found if found.is_terminal else Console(width=WIDTH_PIPED, markup=False, highlight=False, emoji=False)


def table(title: str, header: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """Return a table whose first column is aligned to the left and all others to the right."""
    made = Table(title=title or None, box=SIMPLE_HEAD, title_justify="left", title_style="bold", pad_edge=False)
    for column, name in enumerate(header):
        made.add_column(name, justify="right" if column else "left", no_wrap=True)
    for row in rows:
        made.add_row(*row)
    return made


def figure(value: float, digits: int = 2) -> str:
    """Return a number for a table, a dash where there is none."""
    return "–" if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"


def compared(title: str, figures: Mapping[str, Mapping[str, float]], names: Mapping[str, str], unit: str) -> Table:
    """Return a table of figures: a row for each of ``names``, a column for each state in ``figures``."""
    rows = [
        [f"{label} [{unit}]", *(figure(column.get(name, math.nan)) for column in figures.values())]
        for name, label in names.items()
        if any(not math.isnan(column.get(name, math.nan)) for column in figures.values())
    ]
    return table(title, ["", *figures], rows)
