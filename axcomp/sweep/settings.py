"""What a sweep varies: one setting each, written as the key of its values.

| Key | Its values |
| --- | --- |
| ``achskw1.lis: kw.crosscomp2.n_cycles`` | go into this entry of this list; empty indices: into all rows |
| ``scale achskw1.lis: kw.ssfk.table[].pos`` | multiply the numbers that stand there |
| ``scale X.leadscrew``, ``scale volumetric[0].EXX`` | multiply the values of a compensation that acts |
| ``input X.leadscrew.switch`` | are this input from the first to the last cycle |
| ``scale input X.velocity`` | multiply this input |
| ``parameter velocity`` | are a parameter: ``PARAMETERS``, or one of the FMU |
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from .list_variation import ListEntry, Table, Value

Kind = Literal["list", "table", "input", "scaled input", "parameter"]

PARAMETERS = ("cycle_time", "duration", "velocity", "acceleration", "jerk")
"""Of a run: s, s, and those of the generated moves that say nothing else."""

EXPECTED = (
    "“LIST: ENTRY”, “scale LIST: ENTRY”, “scale AXIS.KIND”, “scale volumetric[i]”, “input NAME”, “scale input NAME” or "
    "“parameter NAME”"
)


@dataclass(frozen=True)
class Setting:
    """What a key stands for: as it is written, which is the name of the column in the results too, and what is varied.

    ``name``: of the input or the parameter; ``target``: what is varied in the lists.
    """

    key: str
    kind: Kind
    name: str = ""
    target: ListEntry | Table | None = None

    @classmethod
    def parse(cls, key: str) -> Setting:
        """Return what a key stands for; ValueError with what was expected."""
        first, _, rest = key.strip().partition(" ")
        rest = rest.strip()
        if first == "parameter" and rest:
            return cls(key, "parameter", rest)
        if first == "input" and rest:
            return cls(key, "input", rest)
        scale = first == "scale" and bool(rest)
        if scale and rest.startswith("input "):
            return cls(key, "scaled input", rest.removeprefix("input ").strip())
        file, colon, entry = (rest if scale else key).rpartition(":")
        if colon and file.strip() and entry.strip():
            return cls(key, "list", target=ListEntry(file.strip(), entry.strip(), scale))
        if scale and ("." in rest or rest.startswith("volumetric[")):
            return cls(key, "table", target=Table(rest))
        raise ValueError(f"{key!r} is nothing that can be varied; expected {EXPECTED}")

    @property
    def of_lists(self) -> bool:
        """Whether it makes another machine."""
        return self.target is not None

    def check(self, value: object) -> Value:
        """Return a value it can take; ValueError with what was expected."""
        scaling = self.kind in {"table", "scaled input"} or (isinstance(self.target, ListEntry) and self.target.scale)
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if scaling and not (number and math.isfinite(float(value))):  # type: ignore[arg-type]
            raise ValueError(f"{value!r} is no factor: expected a number")
        if self.kind == "parameter" and self.name in PARAMETERS and not (number and 0.0 < float(value) < math.inf):  # type: ignore[arg-type]
            raise ValueError(f"{value!r} is no {self.name}: expected a number above 0")
        if self.kind == "input" and not isinstance(value, (bool, int, float)):
            raise ValueError(f"{value!r} is no input: expected a number or a Boolean")
        if not isinstance(value, (bool, int, float, str)):
            raise ValueError(f"{value!r} is no value: expected a number, a Boolean or a string")
        if isinstance(value, str) and ("\n" in value or "\r" in value):
            raise ValueError(f"{value!r} does not fit into a line of a list")
        return value
