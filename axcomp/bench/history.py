"""What was measured before: a page of figures, and beside it the runs that it is made of."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ..saving import write_whole
from .clock import Sample

SHOWN = 5
"""Runs whose medians stand side by side on the page."""

HEAD = """# What a cycle costs

Made by `python -m axcomp bench --save docs/performance.md`; `--compare docs/performance.md` tells what has changed
since. A figure is the median of several measurements in one run, with the least and the greatest. A goal that is missed
is marked ✗, one that is reached ✓. Times are those of one machine: ratios mean more.
"""


class HistoryError(ValueError):
    """A history that cannot be read; the message says which file."""


def save(page: Path, samples: Sequence[Sample]) -> None:
    """Add a run to the history of a page and write both.

    Raises
    ------
    HistoryError
        If there is something else than a history; nothing is written then.
    """
    runs = _runs(page)
    figures = {one.name: [one.unit, one.median, one.low, one.high, one.goal] for one in samples}
    now = datetime.now(UTC).strftime("%Y-%m-%d %H:%M")
    runs.append(
        {"date": now, "machine": f"Python {platform.python_version()}, {platform.machine()}", "figures": figures}
    )
    write_whole(_data(page), json.dumps(runs, indent=1, ensure_ascii=False) + "\n")
    write_whole(page, _page(runs, samples))


def compared(page: Path, samples: Sequence[Sample]) -> list[str]:
    """Return a sentence for each figure that was there in the last saved run too; HistoryError if there is none."""
    runs = _runs(page)
    if not runs:
        raise HistoryError(f"{_data(page)}: there is no saved run to compare with")
    before: Mapping[str, Any] = runs[-1]["figures"]
    return [
        f"{one.name}: {one.median / before[one.name][1]:.2f} of {before[one.name][1]:.3g} {one.unit}"
        for one in samples
        if one.name in before and before[one.name][1] > 0.0
    ]


def _data(page: Path) -> Path:
    return page.with_suffix(".json")


def _runs(page: Path) -> list[dict[str, Any]]:
    path = _data(page)
    if not path.exists():
        return []
    try:
        runs = json.loads(path.read_text(encoding="utf-8"))
        good = all(isinstance(run["figures"], dict) and isinstance(run["date"], str) for run in runs)
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise HistoryError(f"{path}: this is no history of figures: {error}") from None
    if not good:
        raise HistoryError(f"{path}: this is no history of figures")
    return list(runs)


def _page(runs: Sequence[Mapping[str, Any]], samples: Sequence[Sample]) -> str:
    lines = [
        HEAD,
        f"Last run: {runs[-1]['date']} UTC, {runs[-1]['machine']}.",
        "",
        "| figure | median | spread | goal |",
    ]
    lines.append("|---|---|---|---|")
    for one in samples:
        goal = "" if one.goal is None else f"{one.at} {one.goal:g} {one.unit} {'✗' if one.missed else '✓'}"
        lines.append(f"| {one.name} | {one.median:.4g} {one.unit} | {one.low:.4g} … {one.high:.4g} | {goal} |")
    shown = runs[-SHOWN:]
    lines += [
        "",
        "## History",
        "",
        f"| figure | {' | '.join(run['date'] for run in shown)} |",
        "|---" * (len(shown) + 1) + "|",
    ]
    for one in samples:
        found = [run["figures"].get(one.name) for run in shown]
        cells = " | ".join("" if figure is None else f"{figure[1]:.4g} {figure[0]}" for figure in found)
        lines.append(f"| {one.name} | {cells} |")
    return "\n".join(lines) + "\n"
