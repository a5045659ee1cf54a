"""The specification of a sweep, a TOML or JSON file, read and checked; ``axcomp sweep --help`` shows one."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

from ..engine import LIMITS, InputFile, Limits, Motion, Sine, read_input
from ..model import CYCLE_TIME
from .list_variation import Value
from .reductions import Reduction
from .settings import Setting

T = TypeVar("T")

MACHINE = "machine"
RUN, FINDINGS, ERROR = "run", "findings", "error"
RESERVED = (RUN, MACHINE, FINDINGS, ERROR)
"""Columns of the results that are always there, and that of the machine where there are several."""
RUNS_MAX = 1_000_000

_KEYS = ("machine", "cycle_time", "duration", "input", "vary", "runs", "results")


class SpecError(ValueError):
    """A specification that cannot be used: one sentence behind ``file: key:``."""

    def __init__(self, file: object, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(f"{file}: {key}: {sentence}" if key else f"{file}: {sentence}")


@dataclass(frozen=True)
class Run:
    """One run of a sweep: its row, the index of its machine in the specification, and what is set for it."""

    index: int
    machine: int
    values: Mapping[Setting, Value]


@dataclass(frozen=True, eq=False)
class Spec:
    """A sweep as it was read from ``file``.

    ``machines``: lists as ``read_machine`` takes them, or FMUs. ``trajectory``: inputs of every run; ``duration``: s,
    None: as long as that is. ``results``: by the name of their column. Every combination of ``vary`` is run with each
    of ``runs``; one that sets nothing if there are none. ``cycle_time``: s.
    """

    file: Path
    machines: tuple[Path, ...]
    trajectory: InputFile | Motion
    results: Mapping[str, Reduction]
    vary: Mapping[Setting, tuple[Value, ...]]
    runs: tuple[Mapping[Setting, Value], ...] = ({},)
    cycle_time: float = CYCLE_TIME
    duration: float | None = None

    @property
    def settings(self) -> tuple[Setting, ...]:
        """All that is set in any run, in the order of the columns."""
        return tuple(dict.fromkeys((*(setting for run in self.runs for setting in run), *self.vary)))

    @property
    def count(self) -> int:
        """How many runs there are."""
        return len(self.machines) * len(self.runs) * math.prod(len(values) for values in self.vary.values())

    def every_run(self) -> Iterator[Run]:
        """Yield the runs in the order of their rows: the last key of ``vary`` changes fastest."""
        combinations = product(range(len(self.machines)), self.runs, product(*self.vary.values()))
        for index, (machine, fixed, values) in enumerate(combinations):
            yield Run(index, machine, {**fixed, **dict(zip(self.vary, values, strict=True))})


def read_spec(path: Path) -> Spec:
    """Read a specification; SpecError with file, key and what was expected."""
    return _Reader(path, _content(path)).spec()


def _content(path: Path) -> dict[str, Any]:
    language, loads = ("JSON", json.loads) if path.suffix.lower() == ".json" else ("TOML", tomllib.loads)
    try:
        content = loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise SpecError(path, "", f"the specification cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:
        raise SpecError(path, "", f"the specification is no {language}: {error}") from None
    if not isinstance(content, dict):
        raise SpecError(path, "", f"expected an object with the keys {', '.join(_KEYS)}")
    return content


class _Reader:
    """Checks one specification."""

    def __init__(self, file: Path, content: dict[str, Any]) -> None:
        self.file, self.content = file, content

    def spec(self) -> Spec:
        self._only(self.content, _KEYS, "")
        runs = self._runs()
        spec = Spec(
            self.file,
            self._machines(),
            self._trajectory(),
            self._results(),
            self._vary(),
            runs,
            self._positive(self.content.get("cycle_time", CYCLE_TIME), "cycle_time"),
            self._positive(self.content["duration"], "duration") if "duration" in self.content else None,
        )
        if isinstance(spec.trajectory, Motion) and not spec.trajectory.moves and spec.duration is None:
            raise self._error("duration", "expected a number of seconds, for the motion does not end by itself")
        for setting in spec.vary:
            if any(setting in run for run in runs):
                raise self._error(f'vary."{setting.key}"', "this stands in runs too; one of them must go")
        taken = [name for name in spec.results if name in {*RESERVED, *(s.key for s in spec.settings)}]
        if taken:
            raise self._error(f'results."{taken[0]}"', "there is another column of this name; expected a different one")
        if spec.count > RUNS_MAX:
            raise self._error("vary", f"these are {spec.count} runs; expected at most {RUNS_MAX}")
        return spec

    def _machines(self) -> tuple[Path, ...]:
        given = self.content.get(MACHINE)
        names = given if isinstance(given, list) and given else [given]
        paths = tuple(self.file.parent / name for name in names if isinstance(name, str) and name)
        if len(paths) < len(names):
            raise self._error(MACHINE, "expected the path of a start-up list, a folder or an FMU, or several of them")
        for path in paths:
            if not path.exists():
                raise self._error(MACHINE, f"{path} does not exist")
        return paths

    def _trajectory(self) -> InputFile | Motion:
        given = self._table(self.content.get("input"), "input", "file = “inputs.csv”, or start and moves, or sine")
        if "file" in given:
            self._only(given, ("file",), "input")
            if not isinstance(given["file"], str):
                raise self._error("input.file", "expected the path of a CSV file")
            return self._made("input.file", read_input, self.file.parent / given["file"])
        self._only(given, ("start", "moves", "sine", *LIMITS), "input")
        start = self._numbers(given.get("start", {}), "input.start")
        limits = replace(Limits(), **{k: self._positive(given[k], f"input.{k}") for k in LIMITS if k in given})
        motion = Motion(start, self._moves(given.get("moves", []), start), self._sines(given.get("sine", {})), limits)
        if not motion.moves and not motion.sines:
            raise self._error("input", "expected file, moves or sine: nothing moves")
        twice = [axis for axis in motion.sines if axis in start]
        if twice:
            raise self._error(f"input.sine.{twice[0]}", "this axis makes moves already; expected another one")
        return motion

    def _moves(self, given: Any, start: Mapping[str, float]) -> list[dict[str, float]]:
        if not isinstance(given, list):
            raise self._error("input.moves", "expected a list of { AXIS = target } and { dwell = seconds }")
        moves = []
        for number, one in enumerate(given):
            key = f"input.moves[{number}]"
            move = self._numbers(one, key)
            if "dwell" in move and (len(move) > 1 or move["dwell"] < 0.0):
                raise self._error(key, "expected { dwell = seconds } with nothing else")
            for name, value in move.items():
                if name in LIMITS:
                    self._positive(value, f"{key}.{name}")
                elif name != "dwell" and name not in start:
                    raise self._error(f"{key}.{name}", f"expected an axis of input.start: {', '.join(start) or 'none'}")
            moves.append(move)
        return moves

    def _sines(self, given: Any) -> dict[str, Sine]:
        sines = {}
        for axis, one in self._table(given, "input.sine", "AXIS = { amplitude, frequency }").items():
            key = f"input.sine.{axis}"
            values = self._numbers(one, key)
            self._only(values, ("centre", "amplitude", "frequency", "phase"), key)
            if not {"amplitude", "frequency"} <= set(values):
                raise self._error(key, "expected amplitude and frequency")
            sines[axis] = Sine(**{"centre": 0.0, **values})
        return sines

    def _vary(self) -> dict[Setting, tuple[Value, ...]]:
        found = {}
        for name, given in self._table(self.content.get("vary", {}), "vary", "keys with values").items():
            key = f'vary."{name}"'
            setting = self._made(key, Setting.parse, name)
            values = self._range(given, key) if isinstance(given, dict) else given
            if not isinstance(values, list) or not values:
                raise self._error(key, "expected a list of values, or { from, to, count }")
            found[setting] = tuple(self._made(key, setting.check, value) for value in values)
        return found

    def _range(self, given: dict[str, Any], key: str) -> list[float]:
        self._only(given, ("from", "to", "count"), key)
        if set(given) != {"from", "to", "count"} or not isinstance(given["count"], int) or given["count"] < 2:
            raise self._error(key, "expected { from, to, count } with at least 2 values")
        count = min(given["count"], RUNS_MAX + 1)
        first, last = (self._number(given[name], f"{key}.{name}") for name in ("from", "to"))
        values = [first + (last - first) * k / (count - 1) for k in range(count - 1)] + [last]
        # Most entries of lists are whole numbers.
        return [int(value) for value in values] if all(value.is_integer() for value in values) else values

    def _runs(self) -> tuple[dict[Setting, Value], ...]:
        given = self.content.get("runs", [{}])
        if not isinstance(given, list) or not given:
            raise self._error("runs", "expected a list of tables, each with a value for every key")
        found = []
        for number, one in enumerate(given):
            settings = {}
            for name, value in self._table(one, f"runs[{number}]", "keys with a value each").items():
                key = f'runs[{number}]."{name}"'
                setting = self._made(key, Setting.parse, name)
                settings[setting] = self._made(key, setting.check, value)
            found.append(settings)
        return tuple(found)

    def _results(self) -> dict[str, Reduction]:
        found = {}
        given = self._table(self.content.get("results"), "results", "NAME = “max X.correction”")
        for name, text in given.items():
            key = f'results."{name}"'
            if not isinstance(text, str):
                raise self._error(key, "expected a text such as “max X.correction”")
            found[name] = self._made(key, Reduction.parse, text)
        if not found:
            raise self._error("results", "expected at least one NAME = “max X.correction”")
        return found

    def _made(self, key: str, make: Callable[[Any], T], given: object) -> T:
        """Return what is made of a value; where that is refused, SpecError with the sentence."""
        try:
            return make(given)
        except ValueError as error:
            raise self._error(key, str(error)) from None

    def _table(self, given: Any, key: str, expected: str) -> dict[str, Any]:
        if not isinstance(given, dict):
            raise self._error(key, f"expected a table: {expected}")
        return given

    def _numbers(self, given: Any, key: str) -> dict[str, float]:
        table = self._table(given, key, "names with a number each")
        return {name: self._number(value, f"{key}.{name}") for name, value in table.items()}

    def _number(self, value: Any, key: str) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise self._error(key, f"expected a number, not {value!r}")
        return float(value)

    def _positive(self, value: Any, key: str) -> float:
        number = self._number(value, key)
        if number <= 0.0:
            raise self._error(key, f"expected a number above 0, not {value!r}")
        return number

    def _only(self, given: Mapping[str, Any], known: tuple[str, ...], key: str) -> None:
        for name in given:
            if name not in known:
                raise self._error(f"{key}.{name}".lstrip("."), f"expected one of {', '.join(known)}")

    def _error(self, key: str, sentence: str) -> SpecError:
        return SpecError(self.file, key, sentence)
