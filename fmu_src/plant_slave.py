"""The plant as a pythonfmu slave: needs only the standard library and what lies beside it in ``resources/``."""

from __future__ import annotations

import contextlib
import sys
from copy import copy
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from axcomp.plant import variables as v
from axcomp.plant.machine import FILE_NAME, Plant

LARGEST = 1e12
"""Inputs beyond are not used, as if they were infinite."""

REMEMBERED = ("values", "setpoints", "currents", "commanded", "tool_length")
"""What a state holds besides that of the plant."""

NOTHING = {"sub_step": 1.0, "axes": []}
"""Description of the plant that stands in for one that cannot be read."""


class PlantSlave(Fmi2Slave):
    """Feeds inputs to the plant and keeps its outputs; inputs that are not finite keep their last good value.

    Where the plant cannot be read, which the log says once, every variable is 0 and stays so.
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.plant = Plant(NOTHING)
        self._guard(self._read)
        count = len(self.plant.names)
        self.axes = range(count)
        self.of_machine = v.BLOCK * count
        self.values = [0.0] * (self.of_machine + (len(v.OF_MACHINE) if self.plant.bodies else 0))
        self.setpoints = [0.0] * count
        self.currents = [0.0] * count
        self.commanded = [0.0] * count
        self.tool_length = 0.0

    def _read(self) -> None:
        self.plant = Plant.from_file(Path(self.resources or "") / FILE_NAME)

    def exit_initialization_mode(self) -> None:
        """Stand still at the setpoints."""
        self._guard(self._begin)

    def do_step(self, current_time: float, step_size: float) -> bool:  # noqa: ARG002
        """Go on for ``step_size`` s with the inputs as they are."""
        if step_size > 0.0:
            self._guard(self._step, step_size)
        return True

    def get_real(self, vrs: list[int]) -> list[float]:
        """Return variables by value reference."""
        values = self.values
        try:
            return [values[vr] for vr in vrs]
        except IndexError:
            self._tell_unknown(vrs)
            return [values[vr] if vr < len(values) else 0.0 for vr in vrs]

    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """Set variables by value reference."""
        own = self.values
        try:
            for vr, value in zip(vrs, values, strict=True):
                own[vr] = value
        except IndexError:
            self._tell_unknown(vrs)

    def _get_fmu_state(self) -> dict[str, Any]:
        return {"plant": self.plant.state, **{name: copy(getattr(self, name)) for name in REMEMBERED}}

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        self._guard(self._restore, state)

    def _restore(self, state: dict[str, Any]) -> None:
        if len(state["values"]) != len(self.values):
            raise ValueError("the state belongs to another machine")
        self.plant.state = state["plant"]
        for name in REMEMBERED:
            setattr(self, name, copy(state[name]))

    def _begin(self) -> None:
        self._take_inputs()
        self.plant.rest_at(self.setpoints)
        self._give_outputs()

    def _step(self, step_size: float) -> None:
        self._take_inputs()
        self.plant.step(self.setpoints, self.currents, step_size)
        self._give_outputs()

    def _take_inputs(self) -> None:
        for axis in self.axes:
            setpoint = self.values[v.BLOCK * axis + v.SETPOINT]
            current = self.values[v.BLOCK * axis + v.CURRENT]
            if -LARGEST < setpoint < LARGEST:
                self.setpoints[axis] = setpoint
            if -LARGEST < current < LARGEST:
                self.currents[axis] = current
            commanded = self.values[v.BLOCK * axis + v.COMMANDED_POSITION]
            if -LARGEST < commanded < LARGEST:
                self.commanded[axis] = commanded
        if self.plant.bodies:
            tool_length = self.values[self.of_machine + v.TOOL_LENGTH]
            if -LARGEST < tool_length < LARGEST:
                self.tool_length = tool_length

    def _give_outputs(self) -> None:
        values, true, beyond = self.values, self.plant.true, self.plant.beyond
        for axis, drive in enumerate(self.plant.drives):
            at = v.BLOCK * axis
            values[at + v.TRUE_POSITION] = true[axis]
            values[at + v.MEASURED_POSITION] = drive.position
            values[at + v.VELOCITY] = drive.velocity
            values[at + v.MOTOR_CURRENT] = drive.current
            values[at + v.FOLLOWING_ERROR] = drive.lag
            values[at + v.BEYOND] = beyond[axis]
        bodies = self.plant.bodies
        if bodies:
            tip, at = bodies.tip(self.tool_length), self.of_machine
            values[at + v.TCP : at + v.TCP + 3] = bodies.place(tip, true)
            values[at + v.NOMINAL_TCP : at + v.NOMINAL_TCP + 3] = bodies.nominal_place(tip, self.commanded)

    def _guard(self, work: Any, *arguments: Any) -> None:
        """Do something; what goes wrong is reported and the outputs stay: a second exception would end the host."""
        try:
            work(*arguments)
        except Exception as error:
            self._tell(f"{type(error).__name__}: {error}")

    def _tell_unknown(self, vrs: list[int]) -> None:
        if self.plant.names:
            unknown = [vr for vr in vrs if vr >= len(self.values)]
            self._tell(f"no variables have the value references {unknown}")

    def _tell(self, message: str) -> None:
        """Report an error; a C host would take a % for the beginning of a format."""
        self.log(message.replace("%", "percent"), Fmi2Status.error)
        with contextlib.suppress(OSError, ValueError, AttributeError):
            sys.stderr.write(f"{self.instance_name}: {message}\n")
