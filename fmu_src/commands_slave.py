"""Commands over time as a pythonfmu slave: needs only the standard library and its ``resources/``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Slave

ON_INSTANT = 0.01
"""Share of a step by which a time may miss a row's: hosts add up their steps."""


class CommandsSlave(Fmi2Slave):
    """Puts out the rows of ``commands.json`` one after the other: its ``step`` in s, ``rows`` of all its outputs.

    The outputs at a time are the row that begins there; behind the last one they stay. They begin with the first.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        given = json.loads((Path(self.resources or "") / "commands.json").read_text(encoding="utf-8"))
        self.step: float = given["step"]
        self.rows: list[list[float]] = given["rows"]
        self.row = 0

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Go to the row that begins at the end of the step."""
        row = int((current_time + step_size) / self.step + ON_INSTANT)
        self.row = min(max(row, 0), len(self.rows) - 1)
        return True

    def get_real(self, vrs: list[int]) -> list[float]:
        """Return outputs by value reference."""
        return [float(self.rows[self.row][vr]) for vr in vrs]

    def get_integer(self, vrs: list[int]) -> list[int]:
        """Return outputs by value reference."""
        return [int(self.rows[self.row][vr]) for vr in vrs]

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Return outputs by value reference."""
        return [self.rows[self.row][vr] != 0 for vr in vrs]

    def _get_fmu_state(self) -> int:
        return self.row

    def _set_fmu_state(self, state: int) -> None:
        self.row = state

    @staticmethod
    def _fmu_state_to_bytes(state: int) -> bytes:
        return str(state).encode()

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> int:
        return int(state)
