"""What is kept of a run: reductions of an output, or of the difference of two, to one number.

``max X.correction``, ``rms X.corrected_setpoint - X.setpoint``, ``at 0.25 X.current``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..engine import Array

Column = npt.NDArray[Any]


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


REDUCTIONS: Mapping[str, Callable[[Array], float]] = {
    "max": lambda values: float(np.max(values)),
    "min": lambda values: float(np.min(values)),
    "peak": lambda values: float(np.max(np.abs(values))),
    "mean": lambda values: float(np.mean(values)),
    "rms": _rms,
    "last": lambda values: float(values[-1]),
}
"""By name; ``at`` has a time besides. ``peak``: the largest value without its sign."""

AT = "at"
EXPECTED = (
    f"“REDUCTION NAME” or “REDUCTION NAME - NAME” with {', '.join(REDUCTIONS)} or “{AT} SECONDS” as REDUCTION, "
    "for example “rms X.corrected_setpoint - X.setpoint”"
)

_NAME = r"[^\W\d][\w.\[\]]*"
_GRAMMAR = re.compile(rf"\s*([a-z]+)(?:\s+([0-9.][0-9.eE+-]*))?\s+({_NAME})(?:\s*[-−]\s*({_NAME}))?\s*\Z")


@dataclass(frozen=True)
class Reduction:
    """One number of a run.

    ``how``: one of ``REDUCTIONS``, or ``at``; ``minuend`` and ``subtrahend``: names of variables, no subtrahend: "";
    ``time``: for ``at``, s from the start of the run; the cycle it falls into counts.
    """

    how: str
    minuend: str
    subtrahend: str = ""
    time: float = 0.0

    @classmethod
    def parse(cls, text: str) -> Reduction:
        """Return what a text means; ValueError with what was expected."""
        found = _GRAMMAR.match(text)
        if found is None or (found[1] != AT and found[1] not in REDUCTIONS) or (found[2] is None) != (found[1] != AT):
            raise ValueError(f"{text!r} is no result; expected {EXPECTED}")
        try:
            time = float(found[2] or 0.0)
        except ValueError:
            raise ValueError(f"{found[2]!r} is no time in s; expected {EXPECTED}") from None
        return cls(found[1], found[3], found[4] or "", time)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables it needs."""
        return (self.minuend, self.subtrahend) if self.subtrahend else (self.minuend,)

    def of(self, values: Mapping[str, Column], cycle_time: float) -> float:
        """Return the number for the values of a run, one a cycle each; ValueError if there is none."""
        series = np.asarray(values[self.minuend], dtype=np.float64)
        if self.subtrahend:
            series = series - np.asarray(values[self.subtrahend], dtype=np.float64)
        if self.how != AT:
            return REDUCTIONS[self.how](series)
        # An instant that is meant to be that of a cycle must not fall before it by rounding.
        cycle = int(self.time / cycle_time + 1e-6)
        if cycle >= len(series):
            raise ValueError(f"{AT} {self.time:g} s: the run ends at {(len(series) - 1) * cycle_time:g} s")
        return float(series[cycle])
