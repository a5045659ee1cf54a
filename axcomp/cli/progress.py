"""How far a long command is, and how long it still takes, on standard error where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def progress(what: str) -> Iterator[Callable[[int, int], None]]:
    """Keep a bar; it takes how much is done, and of how much. Without Rich, or a terminal, there is none."""
    try:
        from rich import progress as rich
        from rich.console import Console
    except ModuleNotFoundError:
        yield lambda _done, _of: None
        return
    columns = [rich.TextColumn(what), rich.BarColumn(bar_width=None), rich.MofNCompleteColumn()]
    columns += [rich.TimeElapsedColumn(), rich.TextColumn("left"), rich.TimeRemainingColumn()]
    shown = Console(stderr=True)
    with rich.Progress(*columns, console=shown, transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, of: bar.update(task, completed=done, total=of)
