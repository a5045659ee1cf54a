"""Memory and states are as large as the machine, and equal tables are in memory once."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmu_host import in_child

from axcomp.bench import machine_of
from axcomp.fmu import NoCompilerError, package_native
from axcomp.lists import write_machine
from axcomp.model import models
from axcomp.native import PLATFORMS, own_platform

INSTANCES = 200


class _MallocInfo(ctypes.Structure):
    _fields_ = tuple((f"field{i}", ctypes.c_size_t) for i in range(10))

    def used(self) -> int:
        """Return the bytes in use: ``uordblks`` and ``hblkhd``."""
        return int(self.field7) + int(self.field4)


def measured(folder: Path, guid: str) -> tuple[float, list[bytes]]:
    """Return the bytes of one more instance, and the serialized states of two."""
    own = own_platform()
    library: Any = ctypes.CDLL(str(folder / "binaries" / own / f"axcomp{PLATFORMS[own].suffix}"))
    libc: Any = ctypes.CDLL(None)
    libc.mallinfo2.restype = _MallocInfo
    library.fmi2Instantiate.restype = ctypes.c_void_p

    def instance() -> ctypes.c_void_p:
        arguments = (guid.encode(), str(folder / "resources").encode(), None, 0, 0)
        found = ctypes.c_void_p(library.fmi2Instantiate(b"name", 1, *arguments))
        assert found
        return found

    def state_of(owner: ctypes.c_void_p) -> bytes:
        library.fmi2EnterInitializationMode(owner)
        library.fmi2ExitInitializationMode(owner)
        state, size = ctypes.c_void_p(), ctypes.c_size_t()
        assert library.fmi2GetFMUstate(owner, ctypes.byref(state)) == 0
        assert library.fmi2SerializedFMUstateSize(owner, state, ctypes.byref(size)) == 0
        data = ctypes.create_string_buffer(size.value)
        assert library.fmi2SerializeFMUstate(owner, state, data, size) == 0
        return data.raw

    first, second = instance(), instance()
    before = libc.mallinfo2().used()
    for _ in range(INSTANCES):
        instance()
    each = (libc.mallinfo2().used() - before) / INSTANCES
    return each, [state_of(first), state_of(second)]


def sizes(lists: Path, folder: Path) -> tuple[float, int]:
    """Return the bytes of an instance besides shared tables, and of a state; equal states have equal bytes."""
    if not sys.platform.startswith("linux") or not hasattr(ctypes.CDLL(None), "mallinfo2"):
        pytest.skip("only glibc tells how much memory is in use")
    try:
        fmu = package_native(lists, folder / "some.fmu").path
    except NoCompilerError as error:
        pytest.skip(str(error))
    unpacked = Path(fmpy.extract(fmu, folder / "fmu"))
    each, (one, other) = in_child(measured, unpacked, fmpy.read_model_description(fmu).guid)
    assert one == other
    return each, len(one)


def test_an_instance_of_three_axes_has_24_kb_and_its_state_4_kb_at_most(tmp_path: Path) -> None:
    each, state = sizes(models() / "three_axis", tmp_path)
    assert each <= 24_000
    assert state <= 4_000


def test_they_grow_with_the_axes_and_not_with_the_points(tmp_path: Path) -> None:
    found = {}
    for axes, points in ((1, 100), (1, 1000), (4, 100), (8, 100)):
        folder = tmp_path / f"{axes}-{points}"
        write_machine(machine_of(axes, points), folder / "lists")
        found[axes, points] = sizes(folder / "lists", folder)
    assert found[1, 1000] == pytest.approx(found[1, 100], rel=0.01)
    memory, state = ([found[axes, 100][what] for axes in (1, 4, 8)] for what in (0, 1))
    assert (memory[2] - memory[1]) / 4 == pytest.approx((memory[1] - memory[0]) / 3, rel=0.02)
    assert (state[2] - state[1]) / 4 == pytest.approx((state[1] - state[0]) / 3, rel=0.02)
