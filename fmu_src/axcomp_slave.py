"""The compensations as a pythonfmu slave: needs only the standard library and what lies beside it in ``resources/``.

Values go straight between the host and the engine's records: pythonfmu's own way of reading and writing variables costs
more than a step, and saves only what it knows of.
"""

from __future__ import annotations

from typing import Any

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status

from axcomp.fmu.instance import Instance
from axcomp.kinds.parameter import Severity

STATUS = {Severity.ERROR: Fmi2Status.error, Severity.WARNING: Fmi2Status.warning, Severity.INFO: Fmi2Status.ok}
CATEGORY = {Severity.ERROR: "logStatusError", Severity.WARNING: "logStatusWarning", Severity.INFO: "logAll"}


class AxcompSlave(Fmi2Slave):
    """Passes the calls of FMI on to an Instance, which never raises."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._instance = Instance(self.resources or "", self._tell)

    def _tell(self, severity: Severity, text: str) -> None:
        self.log(text, STATUS[severity], CATEGORY[severity])

    def setup_experiment(self, start_time: float, *_: Any) -> None:
        """Take the start time."""
        self._instance.set_up(start_time)

    def enter_initialization_mode(self) -> None:
        """Compute outputs whenever they are read."""
        self._instance.enter_initialization()

    def exit_initialization_mode(self) -> None:
        """Compute the outputs at the start time."""
        self._instance.exit_initialization()

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Run the cycles of a communication step."""
        self._instance.do_step(current_time, step_size)
        return True

    def get_real(self, vrs: list[int]) -> list[float]:
        """Return Real variables by value reference."""
        return self._instance.get("Real", vrs)

    def get_integer(self, vrs: list[int]) -> list[int]:
        """Return Integer variables by value reference."""
        return self._instance.get("Integer", vrs)

    def get_boolean(self, vrs: list[int]) -> list[bool]:
        """Return Boolean variables by value reference."""
        return self._instance.get("Boolean", vrs)

    def get_string(self, vrs: list[int]) -> list[str]:
        """Return String variables by value reference."""
        return self._instance.get("String", vrs)

    def set_real(self, vrs: list[int], values: list[float]) -> None:
        """Set Real variables by value reference."""
        self._instance.set("Real", vrs, values)

    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        """Set Integer variables by value reference."""
        self._instance.set("Integer", vrs, values)

    def set_boolean(self, vrs: list[int], values: list[bool]) -> None:
        """Set Boolean variables by value reference."""
        self._instance.set("Boolean", vrs, values)

    def set_string(self, vrs: list[int], values: list[str]) -> None:
        """Set String variables by value reference."""
        self._instance.set("String", vrs, values)

    def _get_fmu_state(self) -> bytes:
        return self._instance.save()

    def _set_fmu_state(self, state: bytes) -> None:
        self._instance.restore(state)

    @staticmethod
    def _fmu_state_to_bytes(state: bytes) -> bytes:
        return state

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> bytes:
        return state
