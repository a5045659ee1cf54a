"""Tables and sentences in the terminal."""

from __future__ import annotations

import math
import shutil
import sys
from collections.abc import Iterable, Mapping, Sequence

from rich.box import SIMPLE_HEAD
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderResult
from rich.table import Table
from rich.text import Text

WIDTH_PIPED = 160
"""Columns where nothing says how wide the output is."""


def console() -> Console:
    """Return where to print; text is shown as it is, without markup."""
    width = None if sys.stdout.isatty() else shutil.get_terminal_size((WIDTH_PIPED, 25)).columns
    return Console(width=width, markup=False, highlight=False, emoji=False)


class WideTable:
    """A table whose columns stand below each other in groups where they are too many for the terminal.

    No number is cut; the first column comes again in each group.
    """

    def __init__(self, title: str, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
        self.title, self.header, self.rows = title, list(header), [list(row) for row in rows]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield a table for each group of columns."""
        cells = list(zip(self.header, *self.rows, strict=True))
        widths = [max(cell_len(line) for cell in column for line in cell.split("\n")) for column in cells]
        groups = _groups(widths, options.max_width)
        for number, group in enumerate(groups):
            made = Table(box=SIMPLE_HEAD, pad_edge=False, show_edge=False)
            for column in group:
                whole = widths[column] + _BETWEEN <= options.max_width
                made.add_column(
                    self.header[column], justify="right" if column else "left", no_wrap=whole, overflow="fold"
                )
            for row in self.rows:
                made.add_row(*(row[column] for column in group))
            if number == 0 and self.title:
                yield Text(self.title, style="bold", overflow="fold")
            yield made
            yield Text("")


_BETWEEN = 3
"""Blanks around the cells of a column."""


def _groups(widths: Sequence[int], room: int) -> list[list[int]]:
    """Return the columns that stand side by side; the first one in all groups, unless it leaves no room."""
    repeated = [0] if len(widths) > 1 and widths[0] + max(widths[1:]) + 2 * _BETWEEN <= room else []
    groups: list[list[int]] = [[]]
    used = 0
    for column, width in enumerate(widths):
        if groups[-1] and used + width + _BETWEEN > room:
            groups.append([one for one in repeated if one != column])
            used = sum(widths[one] + _BETWEEN for one in groups[-1])
        groups[-1].append(column)
        used += width + _BETWEEN
    return groups


def table(title: str, header: Sequence[str], rows: Iterable[Sequence[str]]) -> WideTable:
    """Return a table whose first column is aligned to the left and all others to the right."""
    return WideTable(title, header, rows)


def figure(value: float, digits: int = 2) -> str:
    """Return a number for a table, a dash where there is none."""
    return "–" if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"


def compared(title: str, figures: Mapping[str, Mapping[str, float]], names: Mapping[str, str], unit: str) -> WideTable:
    """Return a table of figures: a row for each of ``names``, a column for each state in ``figures``."""
    rows = [
        [f"{label} [{unit}]", *(figure(column.get(name, math.nan)) for column in figures.values())]
        for name, label in names.items()
        if any(not math.isnan(column.get(name, math.nan)) for column in figures.values())
    ]
    return table(title, ["", *figures], rows)
