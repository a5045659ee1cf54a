"""Random walks through all calls of FMI, legal and illegal: status and values are what the standard and Python say."""

from __future__ import annotations

import copy
import math
import random
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from host_program import ERROR, OK, Answer, Program, bits

from axcomp.bench import machine_of
from axcomp.interface import AXIS_DECLARATIONS, BLOCK, OF_MACHINE, Slot, slot_in
from axcomp.kernel import ERROR_UPDATE
from axcomp.model import Machine
from axcomp.native import image_of
from axcomp.runtime import Runtime, compile_tables

GUID = "{3b2f6c1e-0000-4000-8000-00000000cafe}"
INSTANCES, STATES, AXES = 3, 4, 2
MACHINE = machine_of(AXES, 12)
CYCLE_TIME = next(d.identifier for d in OF_MACHINE if d.name == "cycle_time")
INPUTS = [d for d in AXIS_DECLARATIONS if d.causality == "input" and d.kind != "volumetric"]
OUTPUTS = [d for d in AXIS_DECLARATIONS if d.causality == "output" and d.kind != "volumetric"]
LETTERS = {float: "r", int: "i", bool: "b"}
RELOAD = next(d.identifier for d in OF_MACHINE if d.name == "reload")
UPDATE_PATH = next(d.identifier for d in OF_MACHINE if d.name == "update_path")
SIZES = [0.0, 0.001, 0.001, 0.001, 0.00100005, 0.0003, 0.0007, 0.0123, 0.001 / 3, 5e-324]


def slot_at(record: Any, path: str) -> Slot:
    slot = slot_in(record, path)
    assert slot is not None
    return slot


def with_other_screw(scale: float, max_points: int) -> Machine:
    """Return the machine with other pitch errors of its first axis."""
    first = MACHINE.axes[0]
    assert first.leadscrew is not None
    values = tuple(scale * value for value in first.leadscrew.positive)
    screw = replace(first.leadscrew, positive=values, max_points=max_points)
    return replace(MACHINE, axes=(first.having(screw), *MACHINE.axes[1:]))


IMAGES = {
    "tables.bin": MACHINE,
    "twice.bin": with_other_screw(2.0, 1500),
    "thrice.bin": with_other_screw(3.0, 1500),
    "sizes.bin": with_other_screw(4.0, 1400),  # the first axis keeps what it has
    "axes.bin": machine_of(AXES + 1, 12),
}
REFUSED = ("axes.bin", "nowhere.bin")
Name = str | tuple[Any, ...]
"""Lists by the file they came from; a tuple where the first axis has kept its own: the file, and what was in force."""


class Expected:
    """One instance, as the standard and the Python runtime say it must behave."""

    def __init__(self, machine: Machine) -> None:
        self.runtime = Runtime(machine)
        self.known: set[Name] = set()
        self.phase = "none"
        self._forget()
        self.fresh = self.save()

    def _forget(self) -> None:
        self.lists: Name = "tables.bin"
        self.path = ""
        self.reload = self.seen = False
        self.waiting: str | None = None
        self.stop = math.inf

    def save(self) -> dict[str, Any]:
        r = self.runtime
        return {
            "phase": self.phase,
            "stop": self.stop,
            "memory": copy.deepcopy((r.state, r.inputs, r.outputs, r.start_time, r.cycles)),
            "machine": (r.machine, r.pool, copy.copy(r.tables)),
            "reload": (self.lists, self.path, self.reload, self.seen, self.waiting),
        }

    def restore(self, saved: dict[str, Any]) -> None:
        r = self.runtime
        self.phase, self.stop = saved["phase"], saved["stop"]
        r.state, r.inputs, r.outputs, r.start_time, r.cycles = copy.deepcopy(saved["memory"])
        r.machine, r.pool, tables = saved["machine"]
        r.tables = copy.copy(tables)
        self.lists, self.path, self.reload, self.seen, self.waiting = saved["reload"]

    def reset(self) -> None:
        self.restore(self.fresh)
        self.phase = "instantiated"

    def made(self) -> None:
        self.reset()
        self.known = {"tables.bin"}

    # Updates: read when the input rises, taken or refused with the next step

    def has_lists_of(self, saved: dict[str, Any]) -> bool:
        """Tell whether all lists that a state needs have been read by this instance too."""
        lists, _, _, _, waiting = saved["reload"]
        named = None if waiting in (None, *REFUSED) else self.name_of(waiting, lists)
        return lists in self.known and (named is None or named in self.known)

    @staticmethod
    def name_of(file: str, lists: Name) -> Name:
        return (file, lists) if file == "sizes.bin" else file

    def watch(self, *, path_set: bool) -> None:
        if not self.reload:
            self.waiting = None
        elif not self.seen and (self.waiting is None or path_set):
            self.waiting = self.path or "tables.bin"
            if self.waiting not in REFUSED:
                self.known.add(self.name_of(self.waiting, self.lists))

    def take(self) -> str:
        """Take or refuse the lists that wait; return which of the two it was, and whether an axis has kept its own."""
        waiting, self.waiting, self.seen = self.waiting, None, self.reload
        if waiting is None:
            return "nothing"
        if waiting in REFUSED:
            for state, outputs in zip(self.runtime.state.axis, self.runtime.outputs.axis, strict=True):
                state.error = outputs.error = ERROR_UPDATE
            return "refused"
        self.lists = self.name_of(waiting, self.lists)
        return "kept" if self.runtime.update(IMAGES[waiting]) else "taken"


class Walk:
    """Writes a script, and what each of its lines must return: a status, and the words behind it or None."""

    def __init__(self, seed: int) -> None:
        self.source = random.Random(seed)
        self.instances = [Expected(MACHINE) for _ in range(INSTANCES)]
        self.states: list[tuple[dict[str, Any], float] | None] = [None] * STATES
        self.happened: set[str] = set()
        self.times = [0.0] * INSTANCES
        self.script: list[str] = []
        self.expected: list[tuple[int, list[str] | None]] = []
        self.moves: list[tuple[Callable[[int, Expected], None], int]] = [
            (self.step, 30),
            (self.set_one, 30),
            (self.get_one, 30),
            (self.get_all, 10),
            (self.proceed, 12),
            (self.change_phase, 8),
            (self.wrong_step, 3),
            (self.wrong_variable, 6),
            (self.save, 6),
            (self.restore, 6),
            (self.through_bytes, 2),
            (self.spoilt_bytes, 2),
            (self.cycle_time, 3),
            (self.set_reload, 3),
            (self.set_path, 3),
            (self.update, 8),
            (self.nulls, 1),
            (self.make_again, 2),
        ]

    def go(self, moves: int) -> None:
        makers, weights = zip(*self.moves, strict=True)
        for slot in range(INSTANCES):
            self.make(slot)
        for move in self.source.choices(makers, weights, k=moves):
            slot = self.source.randrange(INSTANCES)
            move(slot, self.instances[slot])
        for state in range(STATES):
            self.make(0)
            self.say(f"release 0 {state + 8}", OK, ["1"])

    def say(self, line: str, status: int, values: list[str] | None = None) -> None:
        self.script.append(line)
        self.expected.append((status, values))

    # Creation and phases

    def make(self, slot: int) -> None:
        """Put a new instance in the slot."""
        if self.instances[slot].phase != "none":
            self.say(f"free {slot}", OK)
        self.say(f"instantiate {slot} name{slot} 1 {GUID} . 1 0", 1)
        self.instances[slot].made()
        if self.source.random() < 0.5:
            self.cycle_time(slot, self.instances[slot])

    def make_again(self, slot: int, it: Expected) -> None:
        if self.source.random() < 0.5:
            self.make(slot)
        else:
            self.say(f"free {slot}", OK)
            it.phase = "none"

    def proceed(self, slot: int, it: Expected) -> None:
        """Go on to the next phase."""
        following = {"none": self.make, "instantiated": self._enter, "init": self._exit}
        following.get(it.phase, self._terminate_rarely)(slot)

    def _terminate_rarely(self, slot: int) -> None:
        if self.source.random() < 0.2:
            self._phase(slot, "terminate", {"step": "terminated"})

    def _enter(self, slot: int) -> None:
        self._phase(slot, "enter", {"instantiated": "init"})

    def _exit(self, slot: int) -> None:
        self._phase(slot, "exit", {"init": "step"})

    def _phase(self, slot: int, call: str, ways: dict[str, str]) -> None:
        it = self.instances[slot]
        legal = it.phase in ways
        self.say(f"{call} {slot}", OK if legal else ERROR)
        if legal and call == "exit":
            it.runtime.begin(it.runtime.start_time)
            self.times[slot] = it.runtime.start_time
        it.phase = ways.get(it.phase, it.phase)

    def change_phase(self, slot: int, it: Expected) -> None:
        """Call one of these, legal or not."""
        call = self.source.choice(["setup", "enter", "exit", "terminate", "reset"])
        if call == "reset":
            self.say(f"reset {slot}", OK if it.phase != "none" else ERROR)
            if it.phase != "none":
                self.happened |= {"reset while lists wait"} if it.waiting else set()
                it.reset()
                self.times[slot] = 0.0
        elif call == "setup":
            start = self.source.choice([0.0, 1.5, -3.25, math.nan, math.inf])
            stop = self.source.choice([start + 1.0, start + 0.01, start + 0.01, start, start - 1.0, math.nan])
            legal = it.phase == "instantiated" and math.isfinite(start) and stop >= start
            self.say(f"setup {slot} 1 {bits(1e-6)} {bits(start)} 1 {bits(stop)}", OK if legal else ERROR)
            if legal:
                it.runtime.start_time, it.stop = start, stop
        else:
            following = {"enter": {"instantiated": "init"}, "exit": {"init": "step"}}
            self._phase(slot, call, following.get(call, {"step": "terminated"}))

    # Steps and values

    def step(self, slot: int, it: Expected) -> None:
        size = self.source.choice(SIZES)
        legal = it.phase == "step" and self.times[slot] + size <= it.stop + 0.01 * it.runtime.tables.cycle_time
        self.say(f"step {slot} {bits(self.times[slot])} {bits(size)}", OK if legal else ERROR)
        if legal:
            self.times[slot] += size
            self.happened.add(it.take())
            it.runtime.advance(self.times[slot])

    def wrong_step(self, slot: int, _: Expected) -> None:
        now = self.times[slot]
        wrong = [(0.0, math.nan), (math.nan, 0.001), (0.0, -0.001), (0.0, math.inf), (now, 1e300), (-math.inf, 1e-3)]
        time, size = self.source.choice([*wrong, (now - 0.001, 0.002), (now - 5e-5, 0.0)])
        self.say(f"step {slot} {bits(time)} {bits(size)}", ERROR)

    def set_one(self, slot: int, it: Expected) -> None:
        axis, declared = self.source.randrange(AXES), self.source.choice(INPUTS)
        reference = BLOCK * (1 + axis) + declared.identifier
        value: Any
        if isinstance(declared.start, bool):
            value, word = self.source.random() < 0.7, ""
            word = self.source.choice(["1", "-7"]) if value else "0"
        elif isinstance(declared.start, int):
            value = self.source.choice([0, 1, -1, 0, 1, -1, 2, -(2**31)])
            word = str(value)
        else:
            value = self.source.choice(
                [self.source.uniform(-600, 600)] * 20 + [math.nan, math.inf, 1e308, -0.0, 5e-324]
            )
            word = bits(value)
        legal = it.phase in ("instantiated", "init", "step")
        self.say(f"set {slot} {LETTERS[type(declared.start)]} {reference} {word}", OK if legal else ERROR)
        if legal:
            slot_at(it.runtime.inputs.axis[axis], declared.field).set(value)

    def cycle_time(self, slot: int, it: Expected) -> None:
        """Set the parameter: before the steps, and to something possible."""
        value = self.source.choice([0.001, 0.002, 0.0, -1.0, math.nan, math.inf])
        legal = it.phase in ("instantiated", "init") and 0 < value < 1e3
        self.say(f"set {slot} r {CYCLE_TIME} {bits(value)}", OK if legal else ERROR)
        if legal:
            it.runtime.tables.cycle_time = value

    def set_reload(self, slot: int, it: Expected, value: bool | None = None) -> None:
        """Set the input that reads lists; ``value``: None: either."""
        legal = it.phase in ("instantiated", "init", "step")
        value = self.source.random() < 0.6 if value is None else value
        self.say(f"set {slot} b {RELOAD} {int(value)}", OK if legal else ERROR)
        if legal:
            it.reload = value
            it.watch(path_set=False)

    def set_path(self, slot: int, it: Expected) -> None:
        legal = it.phase in ("instantiated", "init", "step")
        path = self.source.choice([*IMAGES, *REFUSED])
        self.say(f"set {slot} s {UPDATE_PATH} {path}", OK if legal else ERROR)
        if legal:
            it.path = path
            it.watch(path_set=True)

    def update(self, slot: int, it: Expected) -> None:
        """Read other lists, perhaps do something in between, and step with them."""
        self.set_reload(slot, it, False)
        self.step(slot, it)
        self.set_path(slot, it)
        self.set_reload(slot, it, True)
        self.source.choice([self.step, self.step, self.change_phase, self.save, self.restore])(slot, it)
        for _ in range(2):
            if it.phase != "step":
                self.proceed(slot, it)
        self.step(slot, it)
        self.get_all(slot, it)

    def get_one(self, slot: int, it: Expected) -> None:
        self._get(slot, it, [(self.source.randrange(AXES), self.source.choice(OUTPUTS))])

    def get_all(self, slot: int, it: Expected) -> None:
        for start in (float, bool, int):
            self._get(slot, it, [(axis, d) for axis in range(AXES) for d in OUTPUTS if type(d.start) is start])

    def _get(self, slot: int, it: Expected, wanted: list[tuple[int, Any]]) -> None:
        legal = it.phase in ("init", "step", "terminated")
        if it.phase == "init":
            it.runtime.begin(it.runtime.start_time)
        words = [self._word(slot_at(it.runtime.outputs.axis[axis], d.field).get()) for axis, d in wanted]
        references = " ".join(str(BLOCK * (1 + axis) + d.identifier) for axis, d in wanted)
        letter = LETTERS[type(wanted[0][1].start)]
        self.say(f"get {slot} {letter} {references}", OK if legal else ERROR, words if legal else [])

    @staticmethod
    def _word(value: float | int | bool) -> str:
        return bits(value) if isinstance(value, float) else str(int(value))

    def wrong_variable(self, slot: int, it: Expected) -> None:
        """Outputs cannot be set; there is no such reference; it has another type."""
        output, given = BLOCK + 8, BLOCK
        lines = [
            f"set {slot} r {output} {bits(1.0)}",
            f"set {slot} r {BLOCK * (1 + AXES)} {bits(1.0)}",
            f"set {slot} r 4294967295 {bits(1.0)}",
            f"set {slot} b {given} 1",
            f"set {slot} s {given} text",
            f"set {slot} i {given} 1",
            f"set {slot} s 3 -",
            f"get {slot} b {given}",
            f"get {slot} i {output}",
            f"get {slot} s {output}",
            f"get {slot} r 63",
            f"get {slot} r {BLOCK * 40}",
            f"get {slot} r 4294967295",
        ]
        line = self.source.choice(lines)
        self.say(line, ERROR)
        if it.phase == "init" and line.startswith("get"):  # asking for a value computes them all
            it.runtime.begin(it.runtime.start_time)

    def nulls(self, slot: int, _: Expected) -> None:
        self.say(f"nulls {slot}", 1)

    # States

    def save(self, slot: int, it: Expected) -> None:
        state = self.source.randrange(STATES)
        self.say(f"save {slot} {state + 8}", OK if it.phase != "none" else ERROR)
        if it.phase != "none":
            self.states[state] = (it.save(), self.times[slot])

    def restore(self, slot: int, it: Expected) -> None:
        """Into any instance, whichever it was saved from, and whether that one is still there."""
        state = self.source.randrange(STATES)
        saved = self.states[state]
        legal = it.phase != "none" and saved is not None and it.has_lists_of(saved[0])
        self.say(f"restore {slot} {state + 8}", OK if legal else ERROR)
        if legal and saved is not None:
            it.restore(saved[0])
            self.times[slot] = saved[1]
        elif it.phase != "none" and saved is not None:
            self.happened.add("a state of other lists")

    def through_bytes(self, slot: int, it: Expected) -> None:
        """Serialize a state and read it again."""
        state = self.source.randrange(STATES)
        saved = self.states[state]
        if it.phase != "none" and saved is not None:
            self.say(f"serialize {slot} {state + 8} 0", OK)
            self.say(f"deserialize {slot} {state + 8} 0 -1", OK if it.has_lists_of(saved[0]) else ERROR)

    def spoilt_bytes(self, slot: int, it: Expected) -> None:
        state = self.source.randrange(STATES)
        if it.phase != "none" and self.states[state] is not None:
            self.say(f"serialize {slot} {state + 8} 1", ERROR)
            self.say(f"serialize {slot} {state + 8} 0", OK)
            self.say(f"deserialize {slot} {state + 8} {self.source.randrange(1, 1500)} -1", ERROR)
            self.say(f"deserialize {slot} {state + 8} 0 {self.source.randrange(28)}", ERROR)
            self.say(f"deserialize {slot} {state + 8} 0 {self.source.randrange(32, 1500)}", ERROR)
            self.say(f"deserialize {slot} {state + 8} 1000000 -1", ERROR)


def check(walk: Walk, answers: list[Answer]) -> None:
    for number, (line, (status, values), answer) in enumerate(zip(walk.script, walk.expected, answers, strict=True)):
        where = f"line {number + 1}: {line}: {answer}"
        assert answer.status == status, where
        if values is not None:
            assert answer.values == values, where
        if not line.startswith(("nulls", "instantiate")):
            errors = [entry for entry in answer.log if entry.startswith("log 3 ")]
            assert status == ERROR or not errors, where


@pytest.fixture
def resources(tmp_path: Path) -> Path:
    for name, machine in IMAGES.items():
        (tmp_path / name).write_bytes(image_of(compile_tables(machine), GUID))
    return tmp_path


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("way", ["gcc", "sanitized"])
def test_any_sequence_of_calls(host: Callable[[str], Program], way: str, seed: int, resources: Path) -> None:
    walk = Walk(seed)
    walk.go(1500)
    check(walk, host(way).run(walk.script, resources))


@pytest.mark.slow
@pytest.mark.parametrize("way", ["valgrind", "linux64", "win64", "aarch64"])
def test_any_sequence_of_calls_elsewhere(host: Callable[[str], Program], way: str, resources: Path) -> None:
    walk = Walk(99)
    walk.go(800)
    check(walk, host(way).run(walk.script, resources))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 130))
def test_many_more_sequences(host: Callable[[str], Program], seed: int, resources: Path) -> None:
    walk = Walk(seed)
    walk.go(4000)
    check(walk, host("sanitized").run(walk.script, resources))


def test_the_walk_visits_every_phase_and_both_outcomes() -> None:
    walk = Walk(0)
    walk.go(6000)
    calls = {(line.split()[0], status) for line, (status, _) in zip(walk.script, walk.expected, strict=True)}
    for call in (
        "setup",
        "enter",
        "exit",
        "terminate",
        "reset",
        "step",
        "get",
        "set",
        "save",
        "restore",
        "deserialize",
    ):
        assert {(call, OK), (call, ERROR)} <= calls, call
    assert walk.happened == {"nothing", "taken", "kept", "refused", "reset while lists wait", "a state of other lists"}
