"""Linear measurements in Renishaw's ``.rtl`` files; what their header says to be something else is refused.

Plain text in sections that begin with ``NAME::``, ``EOF::`` is the last. ``TARGET DATA`` holds ``Target-count`` and,
behind ``Targets :``, the targets in mm, some to a line, up to ``Flags:``; ``RUNS`` the ``Run-count``; ``DEVIATIONS``,
behind ``Run Target Data:``, one line for each reading: the run, the number of the target counted from 1, the deviation
in µm. ``USER-TEXT`` says machine, axis, date and so on.

A bidirectional measurement goes there in one run and back in the next. The direction of a run is that in which its
targets are listed; the runs of either direction are counted from 1.
"""

from __future__ import annotations

import math
import re
from itertools import count
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..engine import Array
from ..lists import decode
from .columns import LARGEST, MeasurementError

SUFFIXES = (".rtl", ".rta", ".rts", ".rtf", ".rtx", ".rtq")
_TYPES = {"rta": "angular", "rts": "straightness", "rtf": "flatness"}
_OTHERS = {
    "angular": "an angular measurement: its deviations are pitch or yaw, not positions",
    "straightness": "a straightness measurement: its deviations are across the axis, not along it",
    "flatness": "a flatness measurement: its deviations are heights of a surface, not positions",
    "squareness": "a squareness measurement: its deviations are across the axes, not along one",
    "rotary": "a measurement of a rotary axis, whose layout is another one",
    "diagonal": "a measurement of a diagonal, along which several axes move",
    "dynamic": "a dynamic measurement over time, without targets",
}
"""What headers may say, and why it makes no positioning."""
_SECTION = re.compile(r"\s*([A-Za-z][A-Za-z0-9 _-]*?)\s*::\s*\Z")
_FIELD = re.compile(r"\s*([A-Za-z][A-Za-z0-9 _.-]*?)\s*:\s*(.*?)\s*\Z")


LinearReadings = tuple[Array, npt.NDArray[np.int64], npt.NDArray[np.int64], Array]
"""Targets in mm, runs, directions and deviations in µm, as in ``positioning.Positioning``."""


def is_rtl(path: Path) -> bool:
    """Tell from the name whether a file is one."""
    return path.suffix.lower() in SUFFIXES


def read_rtl(path: Path) -> tuple[LinearReadings, dict[str, str]]:
    """Return readings and details of a file; MeasurementError, with the line, if it is damaged."""
    reader = _Reader(str(path))
    for line, written in enumerate(_text(path).split("\n"), 1):
        if written.strip():
            reader.take(line, written)
    return reader.readings(), reader.details


def _text(path: Path) -> str:
    try:
        text = decode(path.read_bytes())
    except OSError as error:
        raise MeasurementError(str(path), 0, f"The file cannot be read: {error.strerror or error}.") from error
    if text is None:
        raise MeasurementError(str(path), 0, "The file is no text.")
    return text


class _Reader:
    """Goes through the lines of a file and remembers in which section it is."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._section = ""
        self._field = ""
        self._counts: dict[str, tuple[int, int]] = {}
        self._targets: list[float] = []
        self._readings: list[tuple[int, int, float, int]] = []
        self.details: dict[str, str] = {}

    def take(self, line: int, written: str) -> None:
        """Take one line that is not blank."""
        if found := _SECTION.match(written):
            self._section, self._field = found[1].upper(), ""
            return
        rest = written
        if found := _FIELD.match(written):
            self._field, rest = found[1].lower(), found[2]
            if self._field in ("target-count", "run-count"):
                self._counts[self._field] = self._whole(line, rest), line
            elif self._section in ("HEADER", "USER-TEXT") and rest:
                self.details.setdefault(self._field, rest)
                if self._section == "HEADER":
                    self._check_header(line, rest)
        if self._section == "TARGET DATA" and self._field == "targets":
            self._targets += [self._number(line, word) for word in rest.split()]
        elif self._section == "DEVIATIONS" and self._field == "run target data" and rest.strip():
            self._reading(line, rest.split())

    def _check_header(self, line: int, said: str) -> None:
        """Refuse what is no linear measurement."""
        words = said.lower()
        if self._field == "file type":
            words = _TYPES.get(words.lstrip("."), words)
        other = next((why for name, why in _OTHERS.items() if name in words), None)
        if other is not None:
            raise self._error(
                line, f"The header says “{said}”: this is {other}. A .rtl file of linear readings is needed."
            )
        if self._field == "owner" and "linear" not in words:
            raise self._error(line, f"The header says that it is of “{said}”, not of a linear measurement.")

    def _reading(self, line: int, words: list[str]) -> None:
        if len(words) != 3:
            raise self._error(line, "A reading has three numbers: run, target and deviation.")
        run, target = self._whole(line, words[0]), self._whole(line, words[1])
        if not 1 <= target <= len(self._targets):
            raise self._error(line, f"There is no target {target}; the file has {len(self._targets)}.")
        self._readings.append((run, target - 1, self._number(line, words[2]), line))

    def readings(self) -> LinearReadings:
        """Return all readings with their directions."""
        if not self._targets:
            raise self._error(0, "There are no targets in it (section TARGET DATA); is it a linear measurement?")
        if not self._readings:
            raise self._error(0, "There are no readings in it (section DEVIATIONS).")
        self._check_count("target-count", len(self._targets), "targets")
        self._check_count("run-count", len({run for run, *_ in self._readings}), "runs")
        directions = self._directions()
        numbers = {1: count(1), -1: count(1)}
        number = {run: next(numbers[direction]) for run, direction in directions.items()}
        return (
            np.array([self._targets[target] for _, target, _, _ in self._readings]),
            np.array([number[run] for run, *_ in self._readings]),
            np.array([directions[run] for run, *_ in self._readings]),
            np.array([deviation for _, _, deviation, _ in self._readings]),
        )

    def _directions(self) -> dict[int, int]:
        """Return for each run whether its targets ascend (1) or descend (−1)."""
        last: dict[int, float] = {}
        directions: dict[int, int] = {}
        for run, target, _, line in self._readings:
            position = self._targets[target]
            if run in last:
                direction = 1 if position > last[run] else -1
                if position == last[run] or directions.setdefault(run, direction) != direction:
                    raise self._error(line, f"The targets of run {run} neither only ascend nor only descend here.")
            last[run] = position
        # A run of one target has no direction of its own: runs go there and back by turns.
        return {run: directions.get(run, 1 if turn % 2 == 0 else -1) for turn, run in enumerate(last)}

    def _check_count(self, name: str, found: int, what: str) -> None:
        stated, line = self._counts.get(name, (found, 0))
        if stated < found or (stated != found and name == "target-count"):
            raise self._error(line, f"The file has {found} {what}, not {stated}.")

    def _number(self, line: int, word: str) -> float:
        try:
            value = float(word)
        except ValueError:
            value = math.nan
        if not abs(value) <= LARGEST or "_" in word:
            raise self._error(line, f"“{word}” is no number.")
        return value

    def _whole(self, line: int, word: str) -> int:
        if not word.strip().isdigit() or len(word) > 9:
            raise self._error(line, f"“{word.strip()}” is no count.")
        return int(word)

    def _error(self, line: int, sentence: str) -> MeasurementError:
        return MeasurementError(self._file, line, sentence)
