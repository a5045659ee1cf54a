"""States and images that somebody has forged, pipes, endless steps, and hosts that round otherwise."""

from __future__ import annotations

import ctypes
import os
import resource
import struct
import zlib
from pathlib import Path
from typing import Any, get_args

import pytest
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.fmu import write_image
from axcomp.interface import variables_of
from axcomp.kernel import Inputs, Outputs, State, fields_of
from axcomp.lists import write_machine
from axcomp.model import Machine
from axcomp.native import ctypes_of

FE_UPWARD, FE_TONEAREST = 0x800, 0
CYCLES = 40


class Controls(ctypes.Structure):
    _fields_ = [
        ("cycle_time", ctypes.c_double),
        ("largest_step", ctypes.c_int32),
        ("reload", ctypes.c_bool),
        ("update_path", ctypes.c_char * 1),
    ]


class Memory(ctypes.Structure):
    """As in instance.h, as far as the path, of which a state has only what is used."""

    _fields_ = [
        ("state", ctypes_of(State)),
        ("inputs", ctypes_of(Inputs)),
        ("outputs", ctypes_of(Outputs)),
        ("slopes", ctypes_of(Inputs)),
        ("sloped", ctypes.c_bool),
        *((name, ctypes.c_double) for name in ("start_time", "stop_time", "time", "cycles")),
        ("phase", ctypes.c_int),
        ("reload_seen", ctypes.c_bool),
        ("refused", ctypes.c_bool),
        ("controls", Controls),
    ]


HEAD = 8 + 6 * 4
AXES = len(three_axes().axes)


def forged(data: bytes, offset: int, new: bytes) -> bytes:
    """Return a state with some bytes replaced and a right checksum."""
    body = bytearray(data)
    body[offset : offset + len(new)] = new
    body[8:12] = struct.pack("<I", zlib.crc32(bytes(body[12:])))
    return bytes(body)


def element_of(record: Any) -> Any:
    """Return what the array ``axis`` of a record holds, as C has it."""
    return ctypes_of(get_args(get_args(fields_of(record)["axis"])[0])[0])


def arrays_of(data: bytes) -> dict[str, tuple[int, Any]]:
    """Return where the arrays of a state are that holds no volumetric compensation, and what their elements are."""
    path = HEAD + Memory.controls.offset + Controls.update_path.offset
    at = (data.index(0, path) + 1 + 7) // 8 * 8
    found = {}
    for name, element in (
        ("motion.axis", element_of(fields_of(State)["motion"])),
        ("axis", element_of(State)),
        ("line", ctypes.c_double),
    ):
        found[name] = (at, element)
        at += AXES * ctypes.sizeof(element)
    return found


def offset_in(data: bytes, path: str) -> int:
    """Return where a field is in a serialized state."""
    if path.startswith("memory."):
        at, structure, parts = HEAD, Memory, path.removeprefix("memory.").split(".")
    else:
        name, _, rest = path.partition("[")
        at, structure = arrays_of(data)[name]
        index, _, rest = rest.partition("]")
        at += int(index) * ctypes.sizeof(structure)
        parts = rest.strip(".").split(".") if rest else []
    for part in parts:
        name, _, number = part.partition("[")
        at += getattr(structure, name).offset
        structure = {one[0]: one[1] for one in structure._fields_}[name]
        if number:
            structure = structure._type_
            at += int(number[:-1]) * ctypes.sizeof(structure)
    return at


LARGEST = struct.pack("<i", 2**31 - 1)
FORGERIES: dict[str, tuple[str, bytes]] = {
    "a delay line that is written before its begin": ("axis[0].compensation.friction.head", struct.pack("<i", -561)),
    "one that is written behind its end": ("axis[0].compensation.friction.head", struct.pack("<i", 249)),
    "a look-ahead that goes back for ever": (
        "axis[0].compensation.friction.since_reversal",
        struct.pack("<i", 2**31 - 1),
    ),
    "a search that goes on elsewhere": ("axis[0].compensation.leadscrew.lookup.interval", struct.pack("<i", 10**6)),
    "one before the table": ("axis[0].compensation.friction.lookup.interval", struct.pack("<i", -1)),
    "a reversal beyond its cycles": ("axis[0].compensation.leadscrew.reversal_step", struct.pack("<i", 21)),
    "a switch beyond its cycles": ("axis[0].switching[4].step", struct.pack("<i", 2**30)),
    "a blend beyond its cycles": ("axis[0].switching[4].blend_step", struct.pack("<i", -5)),
    "a release beyond its cycles": ("axis[0].shift.step", struct.pack("<i", 2**31 - 1)),
    "a Boolean that is neither": ("axis[0].started", b"\x02"),
    "a number that is none": ("motion.axis[0].setpoint", struct.pack("<d", float("nan"))),
    "an infinite number": ("line[0]", struct.pack("<d", float("inf"))),
    "a direction that is none": ("motion.axis[0].direction", struct.pack("<i", 7)),
    "an input that is neither": ("memory.inputs.reset", b"\x05"),
    "a slope that is neither": ("memory.sloped", b"\x02"),
    "a phase that is none": ("memory.phase", struct.pack("<i", 3)),
    "a time that is none": ("memory.time", struct.pack("<d", float("nan"))),
}


def take_forgeries(fmu: Path) -> list[tuple[str, bool, bool]]:
    """Return for each forgery whether it was refused, and whether the instance goes on as if nothing had been."""
    rows = trajectory(60)
    found = []
    with Host(fmu) as host:
        host.run(rows[:30])
        state = host.slave.getFMUstate()
        data, time = host.slave.serializeFMUstate(state), host.time
        wanted = host.run(rows[30:40])
        places = {name: (offset_in(data, path), new) for name, (path, new) in FORGERIES.items()}
        for name, (offset, new) in places.items():
            refused = False
            try:
                other = host.slave.deSerializeFMUstate(forged(data, offset, new))
                host.slave.freeFMUstate(other)
            except Exception:
                refused = True
            host.slave.setFMUstate(state)
            host.time = time
            found.append((name, refused, host.run(rows[30:40]) == wanted))
        same = host.slave.deSerializeFMUstate(forged(data, HEAD, b""))
        host.slave.freeFMUstate(same)
        host.slave.freeFMUstate(state)
    return found


def test_a_forged_state_is_refused_and_nothing_changes(native_fmu: Path) -> None:
    found = in_child(take_forgeries, native_fmu)
    assert [name for name, refused, _ in found if not refused] == []
    assert [name for name, _, goes_on in found if not goes_on] == []
    assert len(found) == len(FORGERIES)


def from_a_pipe(fmu: Path, path: str) -> tuple[int, list[str]]:
    with Host(fmu) as host:
        host.step({"X.setpoint": 30.0, "update_path": path})
        return host.step({"reload": True})["X.error"], [text for *_, text in host.messages]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_reload_opens_regular_files_only(kind: str, native_fmu: Path, tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    error, texts = in_child(from_a_pipe, native_fmu, str(path) if kind == "pipe" else "/dev/zero")
    assert error == 902
    assert "cannot be read" in texts[0]


def step_of(fmu: Path, seconds: float, largest: int | None) -> list[str]:
    with Host(fmu) as host:
        pass
    with Host(fmu, parameters={} if largest is None else {"largest_step": largest}) as host:
        try:
            host.step({}, seconds)
        except Exception:
            return [text for *_, text in host.messages]
        return []


def test_a_step_of_more_cycles_than_allowed_is_refused_with_a_sentence(native_fmu: Path) -> None:
    [text] = in_child(step_of, native_fmu, 10_001.0, None)
    assert "a step of 10001000 cycles is refused; largest_step is 10000000" in text
    [text] = in_child(step_of, native_fmu, 0.02, 19)
    assert "a step of 20 cycles is refused; largest_step is 19" in text
    assert in_child(step_of, native_fmu, 0.02, 20) == []


def many_reloads(fmu: Path, one: bytes, place: str, count: int) -> tuple[float, float]:
    """Return how many MB the process has grown, and the correction after the last of many different images."""
    path = Path(place)
    with Host(fmu) as host:
        host.step({"X.setpoint": 30.0, "update_path": place})
        begin = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for k in range(count):
            data = one[:80] + str(k).encode().ljust(227, b"\0")[:16] + one[96:]
            path.write_bytes(data[:20] + struct.pack("<I", zlib.crc32(data[24:])) + data[24:])
            host.step({"reload": True})
            value = host.step({"reload": False})["X.leadscrew.correction"]
        return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - begin) / 1024, value


def test_lists_that_nothing_uses_are_freed(native_fmu: Path, lists: Path, tmp_path: Path) -> None:
    image = write_image(lists, tmp_path / "t.bin").path.read_bytes()
    grown, value = in_child(many_reloads, native_fmu, image, str(tmp_path / "n.bin"), 400)
    assert grown < 20.0
    assert value == pytest.approx(-0.03, abs=1e-12)


def back_to_each(fmu: Path, images: list[str]) -> list[float]:
    """Take several images, keep a state of each, and go back to all of them."""
    with Host(fmu) as host:
        states = []
        for path in images:
            host.step({"X.setpoint": 30.0, "update_path": path, "reload": False})
            host.step({"reload": True})
            host.step({}, 0.01)
            states.append(host.slave.getFMUstate())
        found = []
        for state in states:
            host.slave.setFMUstate(state)
            found.append(host.outputs()["X.leadscrew.correction"])
            host.slave.freeFMUstate(state)
        return found


def test_a_state_in_memory_keeps_its_lists_however_many_came_after(native_fmu: Path, tmp_path: Path) -> None:
    paths = []
    for k in range(14):
        write_machine(three_axes(1.0 + k), tmp_path / str(k))
        paths.append(str(write_image(tmp_path / str(k), tmp_path / f"{k}.bin").path))
    assert in_child(back_to_each, native_fmu, paths) == pytest.approx([-0.03 * (1.0 + k) for k in range(14)])


def rounding(fmu: Path, mode: int) -> tuple[list[dict[str, Any]], int]:
    """Run with a rounding mode set by the host around every step; return the outputs, and the mode at the end."""
    libm = ctypes.CDLL("libm.so.6")
    rows = trajectory(CYCLES)
    with Host(fmu) as host:
        outputs = []
        kept = mode
        for row in rows:
            host.set(row)
            libm.fesetround(mode)
            status = host.slave.fmi2DoStep(
                host.slave.component, ctypes.c_double(host.time), ctypes.c_double(0.001), ctypes.c_int(1)
            )
            kept = libm.fegetround()
            libm.fesetround(FE_TONEAREST)
            host.time += 0.001
            outputs.append({**host.outputs(), "status": int(status or 0)})
        return outputs, kept


@pytest.mark.skipif(os.uname().machine != "x86_64" or os.uname().sysname != "Linux", reason="knows that libm only")
def test_rounding_set_by_the_host_changes_no_bit_and_is_left_as_it_was(native_fmu: Path) -> None:
    nearest, _ = in_child(rounding, native_fmu, FE_TONEAREST)
    upward, mode = in_child(rounding, native_fmu, FE_UPWARD)
    assert mode == FE_UPWARD
    assert [{k: struct.pack("d", v) for k, v in row.items()} for row in upward] == [
        {k: struct.pack("d", v) for k, v in row.items()} for row in nearest
    ]


def test_the_machine_of_these_tests_has_what_they_forge() -> None:
    names = {variable.name for variable in variables_of(three_axes())}
    assert {"X.friction.active", "X.leadscrew.active", "largest_step"} <= names
    assert "axis" in fields_of(State)
    assert isinstance(three_axes(), Machine)
