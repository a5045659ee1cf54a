"""Random programs of the subset: records, nested calls, aliases, loops and every operator.

Values stay far from infinity and from the limits of 32 bits: what is stored goes through ``bounded`` or a remainder.
"""

from __future__ import annotations

import random

from translating import PREAMBLE

START = (
    PREAMBLE
    + '''\
LENGTH = 5
COUNT: Final = 3
SMALL = -1.5
OTHER = SMALL * 0.125 + COUNT


@dataclass(slots=True)
class Part:
    x: float
    y: float  # trailing
    n: int
    m: int
    on: bool
    line: Annotated[list[float], LENGTH]
    marks: Annotated[list[int], 4]
    flags: Annotated[list[bool], 2]


@dataclass(slots=True)
class Whole:
    total: float
    rounds: int
    up: bool
    part: Part
    spare: Part
    parts: Annotated[list[Part], COUNT]
    line: Annotated[list[float], LENGTH]


@dataclass(slots=True)
class Tables:
    scale: float


def bounded(x: float) -> float:
    """Return x where it is an ordinary number."""
    if -1e3 < x < 1e3:
        return x
    return 0.5


def first_of(line: Annotated[list[float], 3], i: int) -> float:
    return line[i % 3]


'''
)


class Maker:
    """Makes one program; the same seed makes the same program."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        self._floats: list[str] = []
        self._ints: list[str] = []
        self._bools: list[str] = []
        self._lines: list[str] = []  # arrays of at least 5 floats
        self._parts: list[str] = []
        self._scalar_functions: list[str] = []
        self._part_functions: list[str] = []
        self._costs: dict[str, int] = {}  # statements that a call runs, roughly
        self._cost = 0
        self._rounds = 1  # of the loops around the next statement
        self._fresh = 0

    def program(self, functions: int = 5) -> tuple[str, list[str]]:
        """Return the source and the names of its exported functions, each f(whole, tables, table, x, i, b)."""
        text = START
        for k in range(functions):
            text += self._scalar_function(f"scalar_{k}")
            text += self._part_function(f"part_{k}")
        exports = [f"whole_{k}" for k in range(functions)]
        return text + "".join(self._whole_function(name) for name in exports), exports

    # ---- functions

    def _scalar_function(self, name: str) -> str:
        self._scope(floats=["x", "y"], ints=["i", "j"], bools=["b"])
        body = self._start() + self._block(2, 1)
        text = (
            f"def {name}(x: float, y: float, i: int, j: int, b: bool) -> float:\n{body}{self._end('x + y + j * b')}\n\n"
        )
        self._scalar_functions.append(name)
        self._costs[name] = self._cost
        return text

    def _part_function(self, name: str) -> str:
        self._scope(floats=["x"], ints=["i"], bools=["given.on"], parts=["given"], lines=["given.line", "line"])
        body = self._start() + "    line[i % LENGTH] = x\n" + self._block(2, 1)
        head = f"def {name}(given: Part, line: Annotated[list[float], LENGTH], x: float, i: int) -> float:\n"
        self._part_functions.append(name)
        self._costs[name] = self._cost
        return f"{head}{body}{self._end('given.x')}\n\n"

    def _whole_function(self, name: str) -> str:
        parts = ["whole_.part", "whole_.spare", f"whole_.parts[{self._random.randrange(3)}]"]
        self._scope(["x", "whole_.total", "tables.scale"], ["i", "whole_.rounds"], ["b", "whole_.up"], parts)
        first = self._index(3)
        self._parts.append("alias")
        self._lines = ["whole_.line", "local", "alias_line"]
        body = self._start() + (
            f"    alias = whole_.parts[{first}]\n"
            "    alias_line = alias.line\n"
            "    local = zeros(LENGTH)\n"
            "    local[2] = x + table[i % 6] * tables.scale\n"
            "    alias.y += alias_line[1] * 0.5\n"
        )
        head = f"def {name}(whole_: Whole, tables: Tables, table: Vec, x: float, i: int, b: bool) -> float:\n"
        return f"{head}{body}{self._block(3, 1)}{self._end('local[0] + local[2] + whole_.total * b')}\n\n"

    def _scope(
        self,
        floats: list[str],
        ints: list[str],
        bools: list[str],
        parts: list[str] | None = None,
        lines: list[str] | None = None,
    ) -> None:
        self._floats, self._ints, self._bools = [*floats, "a", "OTHER"], [*ints, "n", "COUNT"], [*bools, "c"]
        self._parts, self._lines = parts or [], lines or []
        self._cost, self._rounds = 1, 1

    def _start(self) -> str:
        return "    a = x\n    n = i\n    c = x > 0.0\n"

    def _end(self, last: str) -> str:
        return f"    if c:\n        a = -a\n    return bounded(a + n * 0.5 + {last})\n"

    def _cheap_one_of(self, functions: list[str]) -> str:
        """Return a function that can be called here without this one becoming endless; empty if there is none."""
        cheap = [name for name in functions if self._costs[name] * self._rounds + self._cost < 500]
        name = self._random.choice(cheap) if cheap else ""
        self._cost += self._costs[name] * self._rounds if name else 0
        return name

    # ---- statements

    def _block(self, depth: int, indent: int) -> str:
        return "".join(self._statement(depth, "    " * indent) for _ in range(self._random.randint(1, 4)))

    def _statement(self, depth: int, pad: str) -> str:
        self._cost += self._rounds
        simple = [self._assign, self._assign, self._augment, self._whole_number, self._condition_of, self._branches]
        if self._lines:
            simple += [self._element, self._element]
        if self._parts:
            simple += [self._field, self._field, self._part_call, self._part_call, self._alias]
        compound = [self._if, self._for, self._while]
        if depth and self._random.random() < 0.45:
            return self._random.choice(compound)(depth - 1, pad)
        return self._random.choice(simple)(pad)

    def _assign(self, pad: str) -> str:
        return f"{pad}a = bounded({self._float(3)})  # {self._random.randrange(100)}\n"

    def _augment(self, pad: str) -> str:
        return f"{pad}a {self._random.choice(['+=', '-=', '*='])} {self._float(2)}\n{pad}a = bounded(a)\n"

    def _whole_number(self, pad: str) -> str:
        if self._random.random() < 0.3:
            return f"{pad}n {self._random.choice(['+=', '-='])} {self._int(1)}\n{pad}n %= {self._divisor()}\n"
        return f"{pad}n = ({self._int(3)}) % {self._divisor()}\n"

    def _condition_of(self, pad: str) -> str:
        return f"{pad}c = {self._bool(3)}\n"

    def _branches(self, pad: str) -> str:
        """Give a local its value in both branches only."""
        name = self._name("v")
        return (
            f"{pad}if {self._bool(2)}:\n{pad}    {name} = {self._float(2)}\n"
            f"{pad}else:\n{pad}    {name} = {self._float(2)}\n"
            f"{pad}a = bounded(a + {name})\n"
        )

    def _element(self, pad: str) -> str:
        line = self._random.choice(self._lines)
        operation = self._random.choice(["=", "+="])
        return f"{pad}{line}[{self._index(5)}] {operation} bounded({self._float(2)})\n"

    def _field(self, pad: str) -> str:
        part = self._random.choice(self._parts)
        return pad + self._random.choice(
            [
                f"{part}.x = bounded({self._float(2)})\n",
                f"{part}.y = {self._float(1)}\n{pad}{part}.y = bounded({part}.y)\n",
                f"{part}.n = ({self._int(2)}) % 50\n",
                f"{part}.m = {part}.n // {self._divisor()}\n",
                f"{part}.on = {self._bool(2)}\n",
                f"{part}.marks[{self._index(4)}] = ({self._int(2)}) % 9\n",
                f"{part}.flags[{self._index(2)}] = {self._bool(2)}\n",
                f"{part}.line[{self._index(5)}] -= {part}.x * 0.5\n",
            ]
        )

    def _part_call(self, pad: str) -> str:
        function = self._cheap_one_of(self._part_functions[-4:])
        if not function:
            return self._assign(pad)
        part, line = self._random.choice(self._parts), self._random.choice(self._lines)
        call = f"{function}({part}, {line}, bounded({self._float(1)}), {self._int(1)})"
        return pad + self._random.choice(
            [f"{call}\n", f"a = {call}\n", f"a += {call}\n", f"a = bounded(a - {call} * 2.0)\n", f"{part}.y = {call}\n"]
        )

    def _alias(self, pad: str) -> str:
        name = self._name("p")
        part = self._random.choice(self._parts)
        return (
            f"{pad}{name} = {part}\n{pad}{name}.x = bounded({name}.x - {part}.y)\n"
            if "." in part
            else self._assign(pad)
        )

    def _if(self, depth: int, pad: str) -> str:
        indent = len(pad) // 4 + 1
        text = f"{pad}if {self._bool(2)}:\n{self._block(depth, indent)}"
        if self._random.random() < 0.4:
            text += f"{pad}elif {self._bool(2)}:\n{self._block(depth, indent)}"
        if self._random.random() < 0.6:
            text += f"{pad}else:\n{self._block(depth, indent)}"
        return text

    def _for(self, depth: int, pad: str) -> str:
        """Make a loop whose end may change while it runs."""
        counter = self._name("k")
        bounds = ["4", "n % 5", "LENGTH - 1", "n & 3", "1, 3", "-2, n % 3"]
        bounds += [f"{part}.n % 4" for part in self._parts]
        self._ints.append(counter)
        body = self._rounds_of(4, depth, pad)
        self._ints.remove(counter)
        leave = ""
        if self._random.random() < 0.4:
            leave = f"{pad}    if {self._bool(1)}:\n{pad}        {self._random.choice(['break', 'continue'])}\n"
        return f"{pad}for {counter} in range({self._random.choice(bounds)}):\n{leave}{body}"

    def _while(self, depth: int, pad: str) -> str:
        left = self._name("w")
        body = self._rounds_of(3, depth, pad)
        if self._random.random() < 0.5:
            return f"{pad}{left} = 3\n{pad}while {left} > 0 and ({self._bool(1)}):\n{pad}    {left} -= 1\n{body}"
        leave = f"{pad}    if {left} < 0:\n{pad}        break\n"
        return f"{pad}{left} = 2\n{pad}while True:\n{pad}    {left} -= 1\n{body}{leave}"

    def _rounds_of(self, rounds: int, depth: int, pad: str) -> str:
        self._rounds *= rounds
        body = self._block(depth, len(pad) // 4 + 1)
        self._rounds //= rounds
        return body

    def _name(self, letter: str) -> str:
        self._fresh += 1
        return f"{letter}{self._fresh}"

    # ---- expressions

    def _index(self, length: int) -> str:
        text = str(self._random.randrange(length))
        return text if self._random.random() < 0.4 else f"({self._int(1)}) % {length}"

    def _divisor(self) -> str:
        return self._random.choice(["7", "3", "-3", "-5", "COUNT", "11", "(COUNT - 5)"])

    def _float(self, depth: int) -> str:
        if depth <= 0 or self._random.random() < 0.15:
            return self._float_leaf()
        return self._random.choice(
            [
                lambda: f"{self._float(depth - 1)} {self._random.choice('+-*')} {self._float(depth - 1)}",
                lambda: f"({self._float(depth - 1)} {self._random.choice('+-*')} {self._float(depth - 1)})",
                lambda: f"{self._float(0)} * ({self._float(depth - 1)} - {self._float(depth - 1)})",
                lambda: f"({self._float(depth - 1)}) / (abs({self._float(depth - 1)}) + 0.5)",
                lambda: f"{self._random.choice(['min', 'max'])}({self._float(depth - 1)}, {self._float(depth - 1)})",
                lambda: f"-({self._float(depth - 1)})",
                lambda: f"sqrt(abs({self._float(depth - 1)}))",
                lambda: f"whole({self._float(depth - 1)})",
                lambda: f"({self._float(depth - 1)} if {self._bool(depth - 1)} else {self._float(depth - 1)})",
                lambda: f"({self._int(depth - 1)}) * {self._float_leaf()}",
                lambda: f"({self._int(depth - 1)}) / {self._random.choice(['4', '-7', '2.5'])}",
                lambda: f"{self._float_leaf()} * {self._random.choice(self._bools)}",
                lambda: f"float({self._random.choice([self._int(depth - 1), self._bool(depth - 1)])})",
                self._call,
            ]
        )()

    def _float_leaf(self) -> str:
        choices = [*self._floats, repr(round(self._random.uniform(-9, 9), 3)), "0.0", "-0.0", "1e-3"]
        choices += [f"{line}[{self._random.randrange(5)}]" for line in self._lines]
        choices += [f"{part}.{self._random.choice('xy')}" for part in self._parts]
        return self._random.choice(choices)

    def _call(self) -> str:
        if self._lines and self._random.random() < 0.4:
            return f"first_of({self._random.choice(self._lines)}, {self._int(1)})"
        name = self._cheap_one_of(self._scalar_functions[-4:])
        if not name:
            return self._float_leaf()
        return f"{name}({self._float_leaf()}, {self._float_leaf()}, {self._int(0)}, {self._int(0)}, {self._bool(1)})"

    def _int(self, depth: int) -> str:
        if depth <= 0 or self._random.random() < 0.2:
            choices = [*self._ints, str(self._random.randint(-9, 9)), "0x1F"]
            choices += [f"{part}.{self._random.choice(['n', 'm', 'marks[2]'])}" for part in self._parts]
            return self._random.choice(choices)
        return self._random.choice(
            [
                lambda: f"{self._int(depth - 1)} {self._random.choice('+-')} {self._int(depth - 1)}",
                lambda: f"({self._int(depth - 1)} {self._random.choice('+-')} {self._int(depth - 1)})",
                lambda: f"({self._int(depth - 1)}) {self._random.choice(['%', '//'])} {self._divisor()}",
                lambda: f"(({self._int(depth - 1)}) & {self._random.randint(1, 15)})",
                lambda: f"({self._int(depth - 1)} | {self._random.randint(0, 7)})",
                lambda: f"(({self._int(depth - 1)}) >> {self._random.randint(0, 3)})",
                lambda: f"(1 << ({self._int(0)} & 7))",
                lambda: f"{self._random.choice(['min', 'max'])}({self._int(depth - 1)}, {self._int(depth - 1)})",
                lambda: f"abs({self._int(depth - 1)})",
                lambda: f"int(bounded({self._float(depth - 1)}))",
                lambda: f"int({self._bool(depth - 1)})",
                lambda: f"({self._random.choice(self._bools)} + {self._random.choice(self._bools)})",
                lambda: f"({self._int(depth - 1)} if {self._bool(depth - 1)} else {self._int(depth - 1)})",
            ]
        )()

    def _bool(self, depth: int) -> str:
        if depth <= 0 or self._random.random() < 0.2:
            choices = [*self._bools, "True", "False"]
            choices += [f"{part}.{self._random.choice(['on', 'flags[1]'])}" for part in self._parts]
            return self._random.choice(choices)
        compare = self._random.choice(["<", "<=", ">", ">=", "==", "!="])
        return self._random.choice(
            [
                lambda: f"{self._float(depth - 1)} {compare} {self._float(depth - 1)}",
                lambda: f"{self._int(depth - 1)} {compare} {self._int(depth - 1)}",
                lambda: f"{self._float(depth - 1)} {compare} {self._int(depth - 1)}",
                lambda: f"{self._int(depth - 1)} < {self._int(depth - 1)} <= {self._float(depth - 1)}",
                lambda: f"({self._bool(depth - 1)} {self._random.choice(['and', 'or'])} {self._bool(depth - 1)})",
                lambda: f"{self._bool(0)} and {self._bool(0)} or {self._bool(0)}",
                lambda: f"not ({self._bool(depth - 1)})",
                lambda: f"({self._bool(depth - 1)}) {self._random.choice(['==', '!='])} ({self._bool(depth - 1)})",
            ]
        )()
