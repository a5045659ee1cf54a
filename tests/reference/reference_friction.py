"""The friction compensation a second time: it keeps the whole history and looks back at the reversals in it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from axcomp.kinds import Friction
from axcomp.model import Axis

STANDSTILL = 1e-9


class FrictionRow(Protocol):
    """What it takes of the inputs of an axis."""

    setpoint: float
    velocity: float
    acceleration: float
    ahead_known: bool
    velocity_ahead: tuple[float, ...]


@dataclass
class Value:
    """What was computed in one cycle."""

    current: float
    reverses: bool
    ahead: float = 1.0


class FrictionReference:
    """The additional motor current of one axis."""

    def __init__(self, axis: Axis, cycle_time: float) -> None:
        self.axis, self.cycle_time = axis, cycle_time
        self.history: list[Value] = []
        self.sign, self.begun_at, self.built_up = 0, 0.0, False

    def current(self, row: FrictionRow) -> float:
        """Return the current of this cycle, at full weight of the switch."""
        table = self.axis.of(Friction)
        assert table is not None
        sign = self._sign_of(row.velocity)
        reverses = sign not in (0, self.sign)
        if reverses:
            self.sign, self.begun_at, self.built_up = sign, row.setpoint, False
        value = Value(table.scaling * sign * self._over_velocity(row, table) * self._after(row, table), reverses)
        if table.reversal_lookahead > table.delay_cycles:
            value.ahead = self._known(row, table) if row.ahead_known else self._predicted(row, table)
        self.history.append(value)
        late = len(self.history) - 1 - table.delay_cycles
        if late < 0:
            return 0.0
        out = self.history[late]
        return out.current * (out.ahead if table.reversal_lookahead > table.delay_cycles else self._seen(late, table))

    def _sign_of(self, velocity: float) -> int:
        return 0 if abs(velocity) * self.cycle_time < STANDSTILL else int(math.copysign(1, velocity))

    def _over_velocity(self, row: FrictionRow, table: Friction) -> float:
        return float(np.interp(abs(row.velocity), table.velocities, table.currents))

    def _after(self, row: FrictionRow, table: Friction) -> float:
        """Return w_after: once it is 1 it stays so until the next reversal."""
        way = row.setpoint - self.begun_at
        if self.axis.modulo is not None:
            way = math.remainder(way, self.axis.modulo.length)
        self.built_up = self.built_up or abs(way) >= table.position_delay
        return 1.0 if self.built_up else abs(way) / table.position_delay

    def _seen(self, index: int, table: Friction) -> float:
        """Return w_before from the reversals that have come since, which is exact."""
        for left, later in enumerate(self.history[index + 1 : index + 1 + table.reversal_lookahead]):
            if later.reverses:
                return left / table.reversal_lookahead
        return 1.0

    def _known(self, row: FrictionRow, table: Friction) -> float:
        for left, velocity in enumerate(row.velocity_ahead[: table.reversal_lookahead]):
            if self._sign_of(velocity) not in (0, self.sign):
                return left / table.reversal_lookahead
        return 1.0

    def _predicted(self, row: FrictionRow, table: Friction) -> float:
        """Return w_before for the crossing at t = −v/a."""
        if row.velocity * row.acceleration >= 0.0:
            return 1.0
        cycles = -row.velocity / row.acceleration / self.cycle_time
        return min(1.0, math.floor(cycles) / table.reversal_lookahead)
