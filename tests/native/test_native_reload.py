"""Images that ``reload`` reads while the native FMU runs: good ones act, bad ones are refused as a whole."""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fmu_host import Host, in_child
from fmu_machines import three_axes, trajectory

from axcomp.engine import Engine
from axcomp.fmu import write_image
from axcomp.kinds import Cross
from axcomp.lists import write_machine
from axcomp.model import Axis, Machine, ModuloRange
from axcomp.native import HEADER_BEFORE_CHECK

REFUSED = 902


def image(machine: Machine, folder: Path) -> Path:
    write_machine(machine, folder / "lists")
    return write_image(folder / "lists", folder / "new image ü.bin").path


BLEND = 4
"""Backlash cycles of X, over which new values of its leadscrew come in."""


def reloaded(fmu: Path, path: str) -> tuple[list[float], list[int], list[str]]:
    """Correction of X before and after the update, errors of all axes after it, and what the log says."""
    with Host(fmu) as host:
        before = host.step({"X.setpoint": 30.0, "update_path": path})
        after = [host.step({"reload": True}), *(host.step({}) for _ in range(BLEND - 1))][-1]
        corrections = [outputs["X.leadscrew.correction"] for outputs in (before, after)]
        errors = [after[f"{axis}.error"] for axis in ("X", "Y_ACHSE", "C")]
        return corrections, errors, [text for *_, text in host.messages]


def test_a_good_image_acts(native_fmu: Path, tmp_path: Path) -> None:
    path = image(three_axes(3.0), tmp_path)
    assert in_child(reloaded, native_fmu, str(path)) == ([-0.03, -0.09], [0, 0, 0], [])
    assert in_child(reloaded, native_fmu, path.as_uri()) == ([-0.03, -0.09], [0, 0, 0], [])


def test_new_values_come_in_over_the_backlash_cycles(native_fmu: Path, tmp_path: Path) -> None:
    path = image(three_axes(3.0), tmp_path)
    rest = [math.sin(math.pi / 8 * step) ** 2 for step in (3, 2, 1, 0)]
    assert in_child(coming_in, native_fmu, str(path)) == pytest.approx([-0.09 + 0.06 * w for w in rest], abs=1e-15)


def coming_in(fmu: Path, path: str) -> list[float]:
    with Host(fmu) as host:
        host.step({"X.setpoint": 30.0, "update_path": path})
        outputs = [host.step({"reload": True}), *(host.step({}) for _ in range(BLEND - 1))]
        return [row["X.leadscrew.correction"] for row in outputs]


def test_an_image_of_lists_with_errors_is_refused_as_the_lists_are_by_the_other_runtime(
    native_fmu: Path, tmp_path: Path
) -> None:
    write_machine(three_axes(3.0), tmp_path / "lists")
    table = next(path for path in (tmp_path / "lists").glob("achskw*.lis") if "kw.ssfk.table[1]" in path.read_text())
    lines = table.read_text().splitlines(keepends=True)
    at = next(number for number, line in enumerate(lines) if line.startswith("kw.ssfk.table[1]"))
    lines[at] = f"{lines[at].split()[0]} nothing\n"
    table.write_text("".join(lines))
    written = write_image(tmp_path / "lists", tmp_path / "new.bin")
    error = f"{table.name}:{at + 1}: error AXC-ZEROED: kw.ssfk.table[1].pos = nothing is no number"
    corrections, errors, texts = in_child(reloaded, native_fmu, str(written.path))
    assert (corrections, errors) == ([-0.03, -0.03], [REFUSED] * 3)
    assert len(texts) == 1
    assert f"the new lists are refused: errors in them: 1, the first: {error}" in texts[0]


def on_the_move(fmu: Path, path: Path, rows: list[dict[str, Any]], at: int, cycle_time: float) -> list[dict[str, Any]]:
    with Host(fmu, parameters={"cycle_time": cycle_time}) as host:
        outputs = [host.step(row, cycle_time) for row in rows[:at]]
        host.set({"update_path": str(path), "reload": True})
        outputs += [host.step(row, cycle_time) for row in rows[at : at + 10]]
        host.set({"reload": False})
        return outputs + [host.step(row, cycle_time) for row in rows[at + 10 :]]


@pytest.mark.parametrize("cycle_time", [0.001, 0.004])
def test_an_update_on_the_move_has_the_bits_of_the_engine(native_fmu: Path, tmp_path: Path, cycle_time: float) -> None:
    """The cycle time is the host's, whatever the image was made for (0.001 s)."""
    rows = trajectory(160)
    found = in_child(on_the_move, native_fmu, image(three_axes(3.0), tmp_path), rows, 73, cycle_time)
    engine = Engine(three_axes(), cycle_time)
    expected = [engine.step(row) for row in rows[:73]]
    engine.runtime.update(three_axes(3.0))
    expected += [engine.step(row) for row in rows[73:]]
    assert found == expected


def delayed(cycles: int) -> Machine:
    """Three axes, with another delay of the friction current of X."""
    x, *others = three_axes().axes
    assert x.friction is not None
    return Machine((x.having(replace(x.friction, delay_cycles=cycles)), *others))


@pytest.mark.parametrize("cycles", [0, 1, 3, 248])
def test_another_delay_of_the_friction_current_has_the_bits_of_the_engine(
    native_fmu: Path, tmp_path: Path, cycles: int
) -> None:
    """The delay line grows or shrinks while currents wait in it."""
    rows = trajectory(700)
    found = in_child(on_the_move, native_fmu, image(delayed(cycles), tmp_path), rows, 73, 0.001)
    engine = Engine(three_axes())
    expected = [engine.step(row) for row in rows[:73]]
    engine.runtime.update(delayed(cycles))
    expected += [engine.step(row) for row in rows[73:]]
    assert found == expected


def setpoints_with_a_slope(fmu: Path, path: Path) -> list[float]:
    with Host(fmu) as host:
        x = host.variables["X.setpoint"].valueReference
        host.set({"X.setpoint": 30.0})
        host.slave.setRealInputDerivatives([x], [1], [20.0])
        host.set({"update_path": str(path), "reload": True})
        host.step(duration=0.01)
        return [host.get("X.setpoint"), host.get("X.corrected_setpoint") - host.get("X.correction")]


def test_a_slope_that_was_set_outlasts_lists_that_need_more_memory(native_fmu: Path, tmp_path: Path) -> None:
    """A longer delay moves everything: the setpoint goes on by 20 mm/s for 10 ms, that of the last cycle by 9 ms."""
    found = in_child(setpoints_with_a_slope, native_fmu, image(delayed(200), tmp_path))
    assert found == pytest.approx([30.2, 30.18], abs=1e-12)


def resized(kind: str) -> Machine:
    """Three axes, one of them with another ``max_points``, all of them with twice the pitch errors."""
    axes = list(three_axes(2.0).axes)
    place = next(k for k, axis in enumerate(axes) if getattr(axis, kind) is not None)
    axes[place] = replace(axes[place], **{kind: replace(getattr(axes[place], kind), max_points=19)})
    return Machine(tuple(axes))


@pytest.mark.parametrize(
    ("kind", "errors", "correction"),
    [
        ("leadscrew", [110638, 0, 0], -0.03),
        ("cross", [0, 110639, 0], -0.06),
        ("plane", [0, 110640, 0], -0.06),
        ("friction", [110641, 0, 0], -0.03),
    ],
)
def test_an_axis_with_other_sizes_keeps_its_lists(
    native_fmu: Path, tmp_path: Path, kind: str, errors: list[int], correction: float
) -> None:
    path = image(resized(kind), tmp_path)
    corrections, found, texts = in_child(reloaded, native_fmu, str(path))
    assert (corrections, found) == ([-0.03, correction], errors)
    axis = next(k for k, error in enumerate(errors, start=1) if error)
    assert len(texts) == 1
    assert f"axis {axis} keeps its old lists: error {errors[axis - 1]}" in texts[0]


def test_a_kept_axis_folds_its_master_as_its_own_table_says(native_fmu: Path, tmp_path: Path) -> None:
    """Y keeps its plane over C, which gets another modulo range in the same update."""
    new = resized("plane")
    new = Machine((*new.axes[:2], replace(new.axes[2], modulo=ModuloRange(0.0, 270.0))))
    rows = [{"X.setpoint": 5.0 * k, "C.setpoint": 7.0 * k} for k in range(100)]
    found = in_child(on_the_move, native_fmu, image(new, tmp_path), rows, 40, 0.001)
    engine = Engine(three_axes())
    expected = [engine.step(row) for row in rows[:40]]
    assert engine.runtime.update(new) == {"Y-ACHSE": 110640}
    expected += [engine.step(row) for row in rows[40:]]
    assert found == expected


X, Y, C = three_axes().axes


@pytest.mark.parametrize(
    ("axes", "text"),
    [
        ((X, Y), "other axes"),
        ((X, Y, C, Axis(4, "U")), "other axes"),
        ((X, Y, replace(C, number=7)), "do not fit axis 3"),
        ((replace(X, cross=Cross(2, (0.0, 1.0), (0.0, 0.1))), Y, C), "do not fit axis 1"),
    ],
)
def test_an_image_of_another_machine_is_refused(
    native_fmu: Path, tmp_path: Path, axes: tuple[Axis, ...], text: str
) -> None:
    if axes[2:] and axes[2].number == 7:
        axes = (X, replace(Y, plane=None), axes[2])  # the plane's second master was axis 3
    corrections, errors, texts = in_child(reloaded, native_fmu, str(image(Machine(axes), tmp_path)))
    assert (corrections, errors) == ([-0.03, -0.03], [REFUSED] * 3)
    assert len(texts) == 1
    assert text in texts[0]


def checked(data: bytes) -> bytes:
    """Give altered bytes the checksum that belongs to them."""
    start = HEADER_BEFORE_CHECK.size
    return data[:start] + struct.pack("<I", zlib.crc32(data[start + 4 :])) + data[start + 4 :]


def huge_offset(data: bytes) -> bytes:
    """Let every 32-bit number of the first axis' tables that is small be a large one."""
    table = bytearray(data)
    for place in range(64, 64 + 400, 4):
        if 0 < int.from_bytes(table[place : place + 4], "little") < 100:
            table[place : place + 4] = (2**31 - 5).to_bytes(4, "little")
    return checked(bytes(table))


DAMAGES: dict[str, tuple[Callable[[bytes], bytes], str]] = {
    "empty": (lambda _: b"", "truncated"),
    "only a header": (lambda data: data[:64], "truncated"),
    "a byte short": (lambda data: data[:-1], "truncated"),
    "a byte too long": (lambda data: data + b"\0", "bytes too many"),
    "one bit": (lambda data: data[:-9] + bytes([data[-9] ^ 16]) + data[-8:], "altered"),
    "magic": (lambda data: b"AXCOMPT9" + data[8:], "no image"),
    "a list": (lambda _: b"kw.ssfk.kw_nr_max 4\n" * 40, "no image"),
    "layout": (lambda data: data[:8] + b"\1\2\3\4" + data[12:], "another version"),
    "more axes": (lambda data: data[:12] + b"\xff\xff" + data[14:], "truncated"),
    "absurd numbers": (lambda data: data[:16] + b"\xff\xff\xff\xff" + data[20:], "truncated"),
    "guid": (lambda data: checked(data[:24] + b"x" * 40 + data[64:]), "guid is too long"),
    "cycle time": (lambda data: checked(data[:64] + struct.pack("<d", float("nan")) + data[72:]), "contradict"),
    "offsets": (huge_offset, "contradict"),
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_image_is_refused_and_the_log_says_why(native_fmu: Path, tmp_path: Path, damage: str) -> None:
    path = image(three_axes(3.0), tmp_path)
    spoil, text = DAMAGES[damage]
    path.write_bytes(spoil(path.read_bytes()))
    corrections, errors, texts = in_child(reloaded, native_fmu, str(path))
    assert (corrections, errors) == ([-0.03, -0.03], [REFUSED] * 3)
    assert len(texts) == 1
    assert text in texts[0]


@pytest.mark.parametrize(("path", "text"), [("nowhere.bin", "cannot be read"), (".", "cannot be read")])
def test_a_path_without_an_image_is_refused(native_fmu: Path, path: str, text: str) -> None:
    corrections, errors, texts = in_child(reloaded, native_fmu, path)
    assert (corrections, errors) == ([-0.03, -0.03], [REFUSED] * 3)
    assert text in texts[0]


def own_again(fmu: Path, new: Path) -> list[float]:
    """Update, and go back with an empty path."""
    with Host(fmu) as host:
        host.step({"X.setpoint": 30.0, "update_path": str(new)})
        host.step({"reload": True})
        values = [host.step({})["X.leadscrew.correction"] for _ in range(BLEND)]
        host.step({"reload": False, "update_path": ""})
        host.step({"reload": True})
        return values[-1:] + [host.step({})["X.leadscrew.correction"] for _ in range(BLEND)][-1:]


def test_an_empty_path_takes_the_fmus_own_image_again(native_fmu: Path, tmp_path: Path) -> None:
    assert in_child(own_again, native_fmu, image(three_axes(3.0), tmp_path)) == [-0.09, -0.03]
