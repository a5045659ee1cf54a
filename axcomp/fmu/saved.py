"""The state of an FMU instance as bytes, checked before it is trusted."""

from __future__ import annotations

import dataclasses
import enum
import io
import pickle
import sys
import zlib
from dataclasses import dataclass, fields
from typing import Any

from .. import kinds, model
from ..model import Machine
from ..runtime import SnapshotError

MAGIC = b"axcompF2"


@dataclass(frozen=True)
class Saved:
    """What an instance remembers, beside its lists in ``resources``.

    ``machine`` is None while the lists in ``resources`` are in force; ``snapshot``: ``Runtime.save``.
    """

    cycle_time: float
    largest_step: int
    reload: bool
    update_path: str
    reload_seen: bool
    initializing: bool
    start_time: float
    stop_time: float
    time: float
    machine: Machine | None
    snapshot: bytes

    def to_bytes(self) -> bytes:
        """Return bytes with a check sum."""
        written = io.BytesIO()
        _MachinePickler(written, protocol=4).dump(tuple(getattr(self, field.name) for field in fields(self)))
        body = written.getvalue()
        return MAGIC + zlib.crc32(body).to_bytes(4, "little") + body

    @classmethod
    def from_bytes(cls, data: bytes) -> Saved:
        """Return what ``to_bytes`` wrote; SnapshotError if it is something else."""
        head = len(MAGIC)
        body = data[head + 4 :]
        if data[:head] != MAGIC or zlib.crc32(body) != int.from_bytes(data[head : head + 4], "little"):
            raise SnapshotError("this is no state of this FMU, or it is truncated or altered")
        try:
            return cls(*_MachineUnpickler(io.BytesIO(body)).load())
        except (pickle.UnpicklingError, TypeError, ValueError, EOFError, IndexError, AttributeError) as error:
            raise SnapshotError(f"this state belongs to another version: {error}") from None


class _MachinePickler(pickle.Pickler):
    """Writes a choice by its value: Python 3.11.0 to 3.11.3 would call ``getattr``, which is not allowed below."""

    def reducer_override(self, obj: object) -> Any:
        return (type(obj), (obj.value,)) if isinstance(obj, enum.Enum) else NotImplemented


class _MachineUnpickler(pickle.Unpickler):
    """Loads the dataclasses that a Machine consists of, and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        for room in (model, kinds):
            if module.startswith(f"{room.__name__}."):
                found = getattr(sys.modules.get(module), name, None)
                if dataclasses.is_dataclass(found) or (isinstance(found, type) and issubclass(found, enum.Enum)):
                    return found
        raise pickle.UnpicklingError(f"{module}.{name}")
