"""What reading costs: the largest legal lists, beside splitting their lines and nothing else, and the FMU of them."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

from ..fmu import package_axcomp
from ..lists import read_machine, write_machine
from .clock import Sample, sample
from .machines import largest_machine

REPEATS_MAX = 5


def bench_lists(repeats: int) -> Iterator[Sample]:
    """Measure reading the largest legal set of lists, and packing it."""
    repeats = min(repeats, REPEATS_MAX)
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as output:
        paths = write_machine(largest_machine(), folder)
        lines = sum(path.read_bytes().count(b"\n") for path in paths)
        split = sample("", "s", lambda: split_and_float(paths), repeats=repeats)
        reading = sample(
            f"reading the largest legal lists ({lines:,} lines)", "s", lambda: read_machine(folder), repeats=repeats
        )
        yield reading
        ratios = tuple(value / split.median for value in reading.values)
        yield Sample("reading them / split and float of them", ":1", ratios, 2.5)
        fmu = Path(output, "largest.fmu")
        yield sample("FMU of them", "s", lambda: package_axcomp(folder, fmu), repeats=repeats, goal=2.0)


def split_and_float(paths: Iterable[Path]) -> list[tuple[str, float]]:
    """Return the names and numbers of lists by the shortest program that finds them: the limit of reading in Python."""
    found = []
    for path in paths:
        with path.open(encoding="utf-8") as file:
            for line in file:
                words = line.split()
                if len(words) > 1 and words[1].lstrip("-").isdigit():
                    found.append((words[0], float(words[1])))
    return found
