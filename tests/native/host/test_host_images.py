"""What hosts do wrong, files that are damaged, updates, and many instances at once, in a host without Python."""

from __future__ import annotations

import math
import random
import struct
import zlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from host_program import ERROR, OK, Program, bits, real, text
from host_trajectory import motion, write_trajectory

from axcomp.bench import machine_of
from axcomp.interface import BLOCK
from axcomp.kernel import ERROR_UPDATE
from axcomp.kinds import Leadscrew
from axcomp.lists import read_machine
from axcomp.model import Machine, models
from axcomp.native import image_of
from axcomp.runtime import compile_tables

GUID = "{3b2f6c1e-0000-4000-8000-00000000beef}"
MACHINE = machine_of(3, 12)
AT_ONCE = replace(MACHINE, axes=tuple(replace(axis, backlash_cycles=0) for axis in MACHINE.axes))
"""The same without blending over."""
RELOAD, UPDATE_PATH, SETPOINT, CORRECTION, AXIS_ERROR = 2, 3, BLOCK, BLOCK + 30, BLOCK + 12
PLAIN = pytest.mark.parametrize("way", ["gcc", "sanitized"])


def image(machine: Machine) -> bytes:
    return image_of(compile_tables(machine), GUID)


def doubled(machine: Machine, **changes: object) -> Machine:
    """Return the machine with twice the pitch errors of its first axis."""
    first = machine.axes[0]
    screw = first.leadscrew
    assert isinstance(screw, Leadscrew)
    more = replace(screw, positive=tuple(2 * v for v in screw.positive), **changes)  # type: ignore[arg-type]
    return replace(machine, axes=(replace(first, leadscrew=more), *machine.axes[1:]))


@pytest.fixture
def resources(tmp_path: Path) -> Path:
    (tmp_path / "tables.bin").write_bytes(image(MACHINE))
    return tmp_path


def instantiated(folder: Path | str, slot: int = 0) -> str:
    return f"instantiate {slot} name 1 {GUID} {text(folder)} 1 0"


def started(folder: Path, slot: int = 0) -> list[str]:
    return [instantiated(folder, slot), f"enter {slot}", f"exit {slot}"]


def checked(data: bytes) -> bytes:
    """Return the image with the checksum that belongs to its bytes."""
    return data[:20] + struct.pack("<I", zlib.crc32(data[24:])) + data[24:]


@PLAIN
def test_an_instance_is_refused_with_a_message(host: Callable[[str], Program], way: str, resources: Path) -> None:
    location = text(resources)
    wrong = [
        f"instantiate 0 name 1 {{other}} {location} 1 0",
        f"instantiate 0 name 1 - {location} 1 0",
        f"instantiate 0 name 0 {GUID} {location} 1 0",
        f"instantiate 0 - 1 {GUID} {location} 1 0",
        f"instantiate 0 name 1 {GUID} /nowhere 1 1",
        f"instantiate 0 name 1 {GUID} {'x' * 5000} 1 1",
        f"instantiate 0 name 1 {GUID} - 1 0",
    ]
    silent = [f"instantiate 0 - 7 - - {callbacks} 1" for callbacks in (0, 2)]
    answers = host(way).run([*wrong, *silent], resources)
    assert [answer.status for answer in answers] == [0] * len(answers)
    for answer in answers[: len(wrong)]:
        assert len(answer.log) == 1, answer
        assert answer.log[0].startswith("log 3 logStatusError")


@PLAIN
def test_no_instance_is_an_error_everywhere(host: Callable[[str], Program], way: str, resources: Path) -> None:
    calls = [
        "setup 0 0 0 0 0 0",
        "enter 0",
        "exit 0",
        "terminate 0",
        "reset 0",
        "step 0 0 0",
        "get 0 r 64",
        "get 0 s 3",
    ]
    calls += ["set 0 r 64 0", "set 0 s 3 -", "debug 0 1", "save 0 1", "restore 0 1", "release 0 1", "serialize 0 1 0"]
    calls += ["deserialize 0 1 100 -1", "get 0 i", "set 0 b"]
    answers = host(way).run(["about", "nulls 0", "free 0", "free 0", *calls], resources)
    assert answers[0].values == ["default", "2.0"]
    assert [answer.status for answer in answers[1:4]] == [1, OK, OK]
    assert {answer.status for answer in answers[4:]} == {ERROR}


@PLAIN
def test_log_categories(host: Callable[[str], Program], way: str, resources: Path) -> None:
    missing = [f"set 0 s {UPDATE_PATH} nowhere", f"set 0 b {RELOAD} 1", f"set 0 b {RELOAD} 0"]
    missing.append(f"step 0 {bits(0)} {bits(0.001)}")
    script = [
        *started(resources),
        *missing,
        "debug 0 1 logStatusWarning",
        *missing,
        "debug 0 1 logStatusError",
        *missing,
    ]
    script += ["debug 0 1 logAll", *missing, "debug 0 0", *missing, "debug 0 1 nonsense", "debug 0 1 -", "debug 0 1"]
    answers = host(way).run(script, resources)
    heard = [bool(answer.log) for line, answer in zip(script, answers, strict=True) if line == f"set 0 b {RELOAD} 1"]
    assert heard == [False, True, False, True, False]
    assert [answer.status for answer in answers[-3:]] == [ERROR, ERROR, OK]


def damaged(good: bytes) -> Iterable[bytes]:
    source = random.Random(1)
    yield from (b"", good[:7], good[:71], good[:72], good[: len(good) // 2], good[:-1], good + b"\0")
    yield bytes(len(good))
    for _ in range(30):
        place = source.randrange(len(good))
        yield good[:place] + bytes([good[place] ^ 1 << source.randrange(8)]) + good[place + 1 :]
    for name, value in ((12, 33), (12, 65535), (14, 6), (16, 2**31), (16, 2**32 - 1)):
        yield checked(good[:name] + struct.pack("<I", value) + good[name + 4 :])


@PLAIN
def test_damaged_images_are_refused(host: Callable[[str], Program], way: str, resources: Path) -> None:
    script, cases = started(resources), 0
    for cases, data in enumerate(damaged(image(MACHINE)), 1):
        folder = resources / str(cases)
        folder.mkdir()
        (folder / "tables.bin").write_bytes(data)
        script += [instantiated(folder, 1), f"set 0 s {UPDATE_PATH} {folder}/tables.bin", "debug 0 1"]
        script += [f"set 0 b {RELOAD} 1", f"step 0 {bits(cases)} {bits(0.001)}", f"get 0 i {AXIS_ERROR}"]
        script += [f"set 0 b {RELOAD} 0", f"step 0 {bits(cases + 0.001)} {bits(0.001)}"]
    answers = host(way).run(script, resources)[3:]
    assert cases > 40
    for number in range(cases):
        made, named, _, read, step, error, *_ = answers[8 * number : 8 * number + 8]
        assert (made.status, len(made.log)) == (0, 1), number
        assert (named.status, read.status, step.status) == (OK, OK, OK), number
        assert len(read.log) == 1, number
        assert error.values == [str(ERROR_UPDATE)], number


def scrambled(good: bytes, count: int, seed: int) -> Iterable[bytes]:
    """Images with wrong numbers in their records and a checksum that fits, as no accident makes them."""
    source = random.Random(seed)
    records = len(good) // 4 - 18
    for _ in range(count):
        data = bytearray(good)
        for _ in range(source.randint(1, 3)):
            place = 72 + 4 * source.randrange(min(records, source.choice([400, 4000])))
            value = source.choice(
                [0, 1, 2, 7, 255, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7FF80000, source.getrandbits(32)]
            )
            data[place : place + 4] = struct.pack("<I", value)
        yield checked(bytes(data))


def run_scrambled(program: Program, resources: Path, count: int, seed: int, machine: Machine) -> None:
    """Whatever such an image says, it is refused, or its tables can be used without harm."""
    script: list[str] = []
    axes = len(machine.axes)
    for number, data in enumerate(scrambled(image(machine), count, seed)):
        folder = resources / f"{seed}-{number}"
        folder.mkdir()
        (folder / "tables.bin").write_bytes(data)
        script += started(folder)
        for k in range(6):
            places = " ".join(
                f"{BLOCK * (1 + i) + j} {bits(37.0 * k * (i + 1) - 400 * j)}" for i in range(axes) for j in range(4)
            )
            script += [f"set 0 r {places}", f"step 0 {bits(0.001 * k)} {bits(0.001)}"]
        script += ["get 0 r " + " ".join(str(BLOCK * (1 + i) + 8) for i in range(axes)), "free 0"]
    program.run(script, resources)


@pytest.mark.parametrize("way", ["gcc", "forged"])
def test_forged_images_do_no_harm(host: Callable[[str], Program], way: str, resources: Path) -> None:
    run_scrambled(host(way), resources, 60, 1, MACHINE)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2, 12))
@pytest.mark.parametrize("name", ["three_axis", "five_axis", "warm_axis", ""])
def test_many_forged_images_do_no_harm(host: Callable[[str], Program], seed: int, name: str, resources: Path) -> None:
    machine = read_machine(models() / name).machine if name else MACHINE
    run_scrambled(host("forged"), resources, 100, seed, machine)


def moved(slot: int, at: float, position: float) -> list[str]:
    """A step to a position, and the correction there."""
    return [
        f"set {slot} r {SETPOINT} {bits(position)}",
        f"step {slot} {bits(at)} {bits(0.001)}",
        f"get {slot} r {CORRECTION}",
    ]


@PLAIN
def test_states_from_before_and_after_an_update(host: Callable[[str], Program], way: str, resources: Path) -> None:
    """Back to before it, while it waits and after it, with an axis that keeps its lists: the same bits each time."""
    new = resources / "new ü %41.bin"
    axes = list(doubled(MACHINE).axes)
    axes[1] = replace(axes[1], leadscrew=replace(axes[1].leadscrew, max_points=1400))  # type: ignore[type-var,arg-type]
    new.write_bytes(image(Machine(tuple(axes))))
    script = [*started(resources), *moved(0, 0.0, 100.0), "save 0 8", f"set 0 s {UPDATE_PATH} {text(new)}"]
    script += [f"set 0 b {RELOAD} 1", "save 0 9", *moved(0, 0.001, 100.0), "save 0 10", *moved(0, 0.002, 103.0)]
    first = len(script) - 1
    for state in (8, 9, 10):
        script += [f"serialize 0 {state} 0", f"deserialize 0 {state} 0 -1", f"restore 0 {state}"]
        script += [*moved(0, 0.001, 100.0)] if state < 10 else []
        script += [*moved(0, 0.002, 103.0), f"get 0 i {AXIS_ERROR} {AXIS_ERROR + BLOCK}"]
    script += [*started(resources, 1), "restore 1 8", "restore 1 10", "deserialize 1 10 0 -1", f"set 0 b {RELOAD} 0"]
    script += ["reset 0", "enter 0", "exit 0", *moved(0, 0.0, 100.0)]
    script += [f"release 0 {state}" for state in (8, 9, 10)]
    answers = host(way).run(script, resources)
    values = [
        real(answer.values[0]) for line, answer in zip(script, answers, strict=True) if line.startswith("get 0 r")
    ]
    old, after, on, *again, reset = values
    # the double values come in over the 10 backlash cycles; this is the first of them
    assert MACHINE.axes[0].backlash_cycles == 10
    assert after == pytest.approx(old * (1 + math.sin(math.pi / 20) ** 2), rel=1e-14)
    assert old != 0.0
    assert answers[first].status == OK
    assert again[0] == old  # not updated: reload was not on yet
    assert again[2:] == [after, on, on]
    assert reset == old
    errors = [answer.values for line, answer in zip(script, answers, strict=True) if line.startswith("get 0 i")]
    assert errors == [["0", "0"], ["0", "110638"], ["0", "110638"]]
    place = script.index("restore 1 8")
    assert [answer.status for answer in answers[place : place + 3]] == [OK, ERROR, ERROR]
    assert all(answer.log for answer in answers[place + 1 : place + 3])


@PLAIN
def test_a_state_with_lists_that_wait_fits_only_where_they_are(
    host: Callable[[str], Program], way: str, resources: Path
) -> None:
    (resources / "new.bin").write_bytes(image(doubled(MACHINE)))
    script = [*started(resources), *started(resources, 1), f"set 0 s {UPDATE_PATH} new.bin", f"set 0 b {RELOAD} 1"]
    script += ["save 0 8", "serialize 0 8 0", "restore 1 8", "deserialize 1 8 0 -1", "restore 0 8", "release 0 8"]
    answers = host(way).run(script, resources)[-4:]
    assert [answer.status for answer in answers] == [ERROR, ERROR, OK, OK]
    assert ["the state belongs to other lists" in " ".join(answer.log) for answer in answers[:2]] == [True, True]


@PLAIN
def test_a_reset_forgets_lists_that_wait(host: Callable[[str], Program], way: str, resources: Path) -> None:
    (resources / "tables.bin").write_bytes(image(AT_ONCE))
    (resources / "new.bin").write_bytes(image(doubled(AT_ONCE)))
    path, edge = f"set 0 s {UPDATE_PATH} new.bin", f"set 0 b {RELOAD} 1"
    script = [*started(resources), *moved(0, 0.0, 100.0), path, edge, "reset 0", "enter 0", "exit 0"]
    script += [*moved(0, 0.0, 100.0), path, edge, *moved(0, 0.001, 100.0)]
    answers = host(way).run(script, resources)
    before, reset, after = (
        real(answer.values[0]) for line, answer in zip(script, answers, strict=True) if line.startswith("get")
    )
    assert reset == before != 0.0
    assert after == 2 * before


@PLAIN
def test_an_axis_keeps_the_lists_in_force_whatever_it_kept_before(
    host: Callable[[str], Program], way: str, resources: Path
) -> None:
    """The same image mixed with two others: each time the first axis keeps what it has, 110638 says so."""
    (resources / "tables.bin").write_bytes(image(AT_ONCE))
    (resources / "sizes.bin").write_bytes(image(doubled(doubled(AT_ONCE), max_points=1400)))
    (resources / "twice.bin").write_bytes(image(doubled(AT_ONCE)))
    script = [*started(resources), *moved(0, 0.0, 100.0)]
    for k, name in enumerate(("sizes", "twice", "sizes")):
        script += [f"set 0 s {UPDATE_PATH} {name}.bin", f"set 0 b {RELOAD} 1", *moved(0, 0.001 * (k + 1), 100.0)]
        script += [
            f"get 0 i {AXIS_ERROR}",
            f"save 0 {8 + k}",
            f"set 0 b {RELOAD} 0",
            f"step 0 {bits(0.001 * (k + 2))} {bits(0)}",
        ]
    for state in (8, 9, 10):
        script += [f"restore 0 {state}", *moved(0, 0.1, 100.0), f"release 0 {state}"]
    answers = host(way).run(script, resources)
    said = list(zip(script, answers, strict=True))
    first, *values = [real(answer.values[0]) for line, answer in said if line.startswith("get 0 r")]
    assert first != 0.0
    assert values == [first, 2 * first, 2 * first] * 2
    assert [answer.values for line, answer in said if line.startswith("get 0 i")] == [["110638"], ["0"], ["110638"]]


@PLAIN
def test_every_run_has_its_notice(host: Callable[[str], Program], way: str, resources: Path) -> None:
    """Once that the tests of crosstalk, 0 mm and more, have been left; after a reset once again."""
    script = [*started(resources), "debug 0 1"]
    for _ in range(2):
        script += [*moved(0, 0.0, 1.0), *moved(0, 0.001, -1.0), *moved(0, 0.002, -2.0), "reset 0", "enter 0", "exit 0"]
    answers = host(way).run(script, resources)
    logs = [answer.log for line, answer in zip(script, answers, strict=True) if line.startswith("step")]
    assert [len(log) for log in logs] == [0, 2, 0] * 2
    assert logs[1] == logs[4]
    for axis, said in zip((2, 3), logs[1], strict=True):
        assert said.startswith(f"log 1 logStatusWarning name: axis {axis}: the adaptation axes of its crosstalk")


@PLAIN
def test_a_percent_sign_reaches_the_log_of_the_host(host: Callable[[str], Program], way: str, resources: Path) -> None:
    """The host takes a message for a format (its log function complains about one it would expand)."""
    name = "100%s_%n%25"
    script = [*started(resources), "debug 0 1", f"set 0 s {UPDATE_PATH} {name}", f"set 0 b {RELOAD} 1"]
    assert host(way).run(script, resources)[-1].log == [f"log 1 logStatusWarning name: reload: {name} cannot be read"]


@PLAIN
def test_the_longest_path_fits_and_a_longer_one_is_refused(
    host: Callable[[str], Program], way: str, resources: Path
) -> None:
    longest = "x" * 4095
    get = f"get 0 s {UPDATE_PATH}"
    script = [*started(resources), f"set 0 s {UPDATE_PATH} {longest}", get]
    script += [line for more in (1, 2, 1000) for line in (f"set 0 s {UPDATE_PATH} {'y' * (4095 + more)}", get)]
    answers = host(way).run([*script, *moved(0, 0.0, 100.0)], resources)[3:-3]
    assert [answer.status for answer in answers] == [OK, OK] + [ERROR, OK] * 3
    assert [answer.values for answer in answers[1::2]] == [[f"<{longest}>"]] * 4
    assert all("more than 4095 bytes" in answer.log[0] for answer in answers[2::2])


@PLAIN
def test_the_order_of_path_and_edge_does_not_matter(host: Callable[[str], Program], way: str, resources: Path) -> None:
    new = resources / "new.bin"
    new.write_bytes(image(doubled(MACHINE)))
    path, edge = f"set 0 s {UPDATE_PATH} {new}", f"set 0 b {RELOAD} 1"
    results = []
    for order in ([path, edge], [edge, path]):
        answers = host(way).run([*started(resources), *order, *moved(0, 0.0, 77.0)], resources)
        results.append(answers[-1].values)
        assert not any(answer.log for answer in answers)
    assert results[0] == results[1] != host(way).run([*started(resources), *moved(0, 0.0, 77.0)], resources)[-1].values


@PLAIN
def test_an_empty_path_means_the_image_in_the_resources(
    host: Callable[[str], Program], way: str, resources: Path
) -> None:
    """A host without files to write can change that one; a relative path counts from the current folder."""
    script = [*started(resources), *moved(0, 0.0, 50.0), "about", f"set 0 b {RELOAD} 1", *moved(0, 0.001, 50.0)]
    before = host(way).run(script, resources)
    assert before[5].values == before[-1].values
    (resources / "other").mkdir()
    (resources / "other" / "tables.bin").write_bytes(image(doubled(MACHINE)))
    script[7:7] = [f"set 0 s {UPDATE_PATH} file:other/tables.bin"]
    assert host(way).run(script, resources)[-1].values != before[-1].values


@PLAIN
def test_updates_without_end_need_no_memory(host: Callable[[str], Program], way: str, resources: Path) -> None:
    """Two images in turn, a thousand times: the instance keeps each of them once."""
    for name, machine in (("a.bin", AT_ONCE), ("b.bin", doubled(AT_ONCE))):
        (resources / name).write_bytes(image(machine))
    turn = []
    for k in range(1000):
        turn += [f"set 0 s {UPDATE_PATH} {'ab'[k % 2]}.bin", f"set 0 b {RELOAD} 1", *moved(0, 0.001 * k, 50.0)]
        turn += [f"set 0 b {RELOAD} 0", f"step 0 {bits(0.001 * (k + 1))} {bits(0.0)}"]
    answers = host(way).run([*started(resources), *turn], resources)
    values = [answer.values[0] for line, answer in zip(turn, answers[3:], strict=True) if line.startswith("get")]
    assert len(set(values[::2])) == len(set(values[1::2])) == 1
    assert values[0] != values[1]


def many(resources: Path, cycles: int) -> Path:
    path = resources / "motion.bin"
    write_trajectory(path, MACHINE, motion(MACHINE, np.random.default_rng(1), cycles))
    return path


@pytest.mark.parametrize(("way", "number"), [("gcc", 1000), ("sanitized", 200)])
def test_many_instances_at_once(host: Callable[[str], Program], way: str, number: int, resources: Path) -> None:
    script = [f"many 0 {number} {GUID} {resources} {many(resources, 5)}"]
    assert host(way).run(script, resources)[0].status == 1


@pytest.mark.parametrize("way", ["gcc", "threads"])
def test_two_threads_with_an_instance_each(host: Callable[[str], Program], way: str, resources: Path) -> None:
    script: Sequence[str] = [f"threads 0 {GUID} {resources} {many(resources, 2000)}"]
    assert host(way).run(script, resources)[0].status == 1
