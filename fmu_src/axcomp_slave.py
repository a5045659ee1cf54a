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
TYPES = ("Real", "Integer", "Boolean", "String")


def _getter(kind: str) -> Any:
    """Make the method that returns variables of one type by value reference."""

    def get(self: AxcompSlave, vrs: list[int]) -> list[Any]:
        return self._instance.get(kind, vrs)

    return get


def _setter(kind: str) -> Any:
    """Make the method that sets variables of one type by value reference."""

    def set_(self: AxcompSlave, vrs: list[int], values: list[Any]) -> None:
        self._instance.set(kind, vrs, values)

    return set_


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
        return self._instance.do_step(current_time, step_size) is not False

    get_real, get_integer, get_boolean, get_string = map(_getter, TYPES)
    set_real, set_integer, set_boolean, set_string = map(_setter, TYPES)

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
