"""Whatever lies outside the subset is refused, each place by file, line and a sentence that says what to do."""

from __future__ import annotations

from pathlib import Path

import pytest
from translating import PREAMBLE, write_package

from axcomp.translate import TranslationError, translate

RECORDS = """\
N = 4

@dataclass(slots=True)
class Part:
    x: float
    n: int
    on: bool
    line: Annotated[list[float], N]

@dataclass(slots=True)
class All:
    part: Part
    other: Part
    parts: Annotated[list[Part], N]

def change(p: Part) -> float:
    p.x = p.x + 1.0
    return p.x

def look(p: Part) -> float:
    return p.x

"""

BODIES = [
    # lines of f(a: All, table: Vec, x: float, n: int, b: bool) -> float, the refused one of them, part of the sentence
    ("y, z = x, x", 1, "tuple"),
    ("return (x, x)", 1, "tuple"),
    ("y = z = x", 1, "one target"),
    ("y = [i for i in range(3)]", 1, "comprehension"),
    ("y = sum(k for k in a.part.line)", 1, "sum is no function"),
    ("y = lambda: x", 1, "lambda"),
    ("y = 'text'", 1, "text"),
    ("y = f'{x}'", 1, "text"),
    ("y = {}", 1, "dictionaries"),
    ("y = [0.0, 1.0]", 1, "zeros(n)"),
    ("if (y := x) > 0.0:\n    return y", 1, "statement of its own"),
    ("try:\n    x = 1.0\nexcept ValueError:\n    pass", 1, "exceptions"),
    ("raise ValueError", 1, "exceptions"),
    ("assert b", 1, "exceptions"),
    ("with b:\n    pass", 1, "context managers"),
    ("del x", 1, "deleted"),
    ("global N", 1, "globals"),
    ("def g() -> None:\n    pass", 1, "module level"),
    ("import math", 1, "module level"),
    ("match n:\n    case 1:\n        pass", 1, "if … elif"),
    ("x = x ** 2.0", 1, "**"),
    ("n = n ^ 1", 1, "^"),
    ("n = ~n", 1, "~"),
    ("n = +n", 1, "UAdd"),
    ("x = x // 2.0", 1, "whole(x / y)"),
    ("x = x % 2.0", 1, "whole(x / y)"),
    ("x = x % 2", 1, "takes int"),
    ("b = b & True", 1, "takes int"),
    ("x = x << 1", 1, "takes int"),
    ("if x is None:\n    pass", 1, "=="),
    ("if n in a.part.line:\n    pass", 1, "loop"),
    ("if n:\n    pass", 1, "condition is a bool"),
    ("while x:\n    pass", 1, "condition is a bool"),
    ("b = not n", 1, "condition is a bool"),
    ("x = x or 1.0", 1, "condition is a bool"),
    ("if a.part == a.other:\n    pass", 1, "not compared"),
    ("if a.part.line == a.other.line:\n    pass", 1, "not compared"),
    ("if b == 1:\n    pass", 1, "compared with"),
    ("a.part = a.other", 1, "Python would share it, C would copy it"),
    ("a.part.line = a.other.line", 1, "Python would share it, C would copy it"),
    ("a.parts[n] = a.part", 1, "Python would share it, C would copy it"),
    ("table[0] = x", 1, "only read"),
    ("a = a.part", 1, "not rebound"),
    ("p = a.part if b else a.other\np.x = x", 1, "same kind of number"),
    ("x = a.part.line[-1]", 1, "negative index"),
    ("x = a.part.line[1 - N]", 1, "negative index"),
    ("x = a.part.line[N]", 1, "outside an array of length 4"),
    ("x = a.part.line[x]", 1, "an index is int"),
    ("x = a.part.line[0:2]", 1, "slice"),
    ("x = a.part.nothing", 1, "no field nothing"),
    ("x = x.real", 1, "float has no fields"),
    ("x = n[0]", 1, "int has no elements"),
    ("x = unknown", 1, "unknown is not known here"),
    ("x = unknown(x)", 1, "unknown is no function"),
    ("x = a.part.look()", 1, "method"),
    ("x = round(x)", 1, "round is no function"),
    ("x = look(p=a.part)", 1, "by position"),
    ("x = look(a.part, x)", 1, "takes 1 arguments, here are 2"),
    ("x = look(a)", 1, "is Part, this is All"),
    ("x = look", 1, "no value"),
    ("p = Part()", 1, "outside the kernel"),
    ("x = 1", 1, "x is float, this is int"),
    ("n = x", 1, "write int(…)"),
    ("n = b", 1, "write int(…)"),
    ("n = n / 2", 1, "float"),
    ("n += 0.5", 1, "makes it float"),
    ("n /= 2", 1, "makes it float"),
    ("return n", 1, "returned is float, this is int"),
    ("return", 1, "returns float"),
    ("a.part.x = n", 1, "a.part.x is float"),
    ("x = n if b else 1.0", 1, "one side is int, the other float"),
    ("x = min(x, 0)", 1, "both are int, or both are float"),
    ("x = max(x, 0.0, 1.0)", 1, "takes 2 arguments"),
    ("x = abs(b)", 1, "abs is for int and float"),
    ("x = sqrt(n)", 1, "argument of sqrt is float"),
    ("n = int(n)", 1, "converts nothing"),
    ("n = 2147483648", 1, "32 bits"),
    ("n = 2000000000 + 2000000000", 1, "32 bits"),
    ("n = N << 30", 1, "32 bits"),
    ("x = 1e999", 1, "finite"),
    ("n = n // (N - 4)", 1, "divides by 0"),
    ("n %= 0", 1, "divides by 0"),
    ("n = n >> 32", 1, "0 to 31"),
    ("x = change(a.part) + change(a.other)", 1, "a statement of its own"),
    ("x = a.part.x + change(a.part)", 1, "a statement of its own"),
    ("x = max(change(a.part), look(a.part))", 1, "a statement of its own"),
    ("a.part.x += change(a.other)", 1, "a statement of its own"),
    (
        "a.part.line[a.part.n] = float(a.part.n) * 2.0 + look(a.part)\na.part.line[int(change(a.part))] = a.part.x",
        2,
        "own",
    ),
    ("if 0.0 < change(a.part) < 1.0:\n    pass", 1, "chain"),
    ("for p in a.parts:\n    p.x = x", 1, "range"),
    ("for i in range(0, n, 2):\n    x += 1.0", 1, "range takes"),
    ("for i in range(n):\n    i += 1", 1, "counts this loop"),
    ("for i in range(n):\n    x += float(i)\nelse:\n    x = 0.0", 1, "no else"),
    ("for i in range(n):\n    x += 1.0\nn = i", 3, "may have no value"),
    ("for i in range(n):\n    for i in range(n):\n        x += 1.0", 2, "counts this loop"),
    ("i = 3\nfor i in range(i):\n    x += 1.0", 2, "counts this loop"),
    ("while b:\n    b = False\nelse:\n    x = 0.0", 1, "no else"),
    ("if b:\n    y = x\nx = y", 3, "y may have no value"),
    ("while b:\n    y = x\n    b = False\nx = y", 4, "y may have no value"),
    ("return x\nx = 1.0", 2, "never reached"),
    ("y = x", 1, "y is never read"),
    ("t = zeros(n)\nt[0] = x", 1, "no length"),
    ("t = zeros(4)\nt[n] = x", 1, "t is never read"),
    ("t = zeros(4)\nx = t[0]\nt = zeros(4)", 3, "first named"),
    ("x = zeros(4)[0]", 1, "stands alone"),
    ("line = zeros(4)\nx = line[0]\nline = a.part.line", 3, "an array of its own"),
    ("int_min = x\nx = int_min", 1, "already means something in C"),
    ("register = x\nx = register", 1, "already means something in C"),
    ("_Value = x\nx = _Value", 1, "reserved"),
    ("Part = x\nx = Part", 1, "also the name of something at module level"),
    ("change = x\nx = change(a.part)", 1, "also the name of something at module level"),
    ("größe = x\nx = größe", 1, "ASCII"),
    ("x", 1, "no effect"),
    ("y: float\ny = x\nx = y", 1, "first value"),
    ("y: str = x\nx = y", 1, "no type of the subset"),
    ("y: int = x\nn = y", 1, "y is int, this is float"),
    ("y = change(a.part)\ny = n\nx = y", 2, "y is float, this is int"),
]

MODULE_LEVEL = [
    ("def f(x):\n    return x", 1, "x has no annotation"),
    ("def f(x: float):\n    return x", 1, "f has no annotation"),
    ("def f(x: float = 0.0) -> float:\n    return x", 1, "no defaults"),
    ("def f(*x: float) -> float:\n    return 0.0", 1, "plain arguments"),
    ("def f(x: str) -> float:\n    return 0.0", 1, "no type of the subset"),
    ("def f(x: list[float]) -> float:\n    return x[0]", 1, "no type of the subset"),
    ("def f(x: Annotated[list[float], 0]) -> float:\n    return x[0]", 1, "no length"),
    ("def f(x: Annotated[list[Vec], 2]) -> float:\n    return 0.0", 1, "an array holds"),
    ("def f(x: float) -> Vec:\n    return x", 1, "returns a number or None"),
    ("def f(x: float) -> float:\n    if x > 0.0:\n        return x", 1, "may end without returning float"),
    (
        "def f(x: float) -> float:\n    while True:\n        x += 1.0\n        if x > 3.0:\n            break",
        1,
        "may end",
    ),
    ("def f(x: float, unused: int) -> float:\n    return x", 1, "unused is never read"),
    ("def f(x: float) -> float:\n    return f(x)", 1, "calls itself"),
    ("def g(x: float) -> float:\n    return f(x)\ndef f(x: float) -> float:\n    return g(x)", 1, "calls itself"),
    ("@staticmethod\ndef f(x: float) -> float:\n    return x", 2, "decorated"),
    ("async def f(x: float) -> float:\n    return x", 1, "at module level"),
    ("def double(x: float) -> float:\n    return x", 1, "already means something in C"),
    ("def gamma(x: float) -> float:\n    return x", 1, "already means something in C"),
    ("def f(new: float) -> float:\n    return new", 1, "already means something in C"),
    ("def f(size_t: float) -> float:\n    return size_t\n\ndef value_t() -> float:\n    return 1.0", 4, "reserved"),
    ("A = 1\ndef _A() -> int:\n    return A", 2, "the same name in C as A at"),
    ("A = 3000000000", 1, "32 bits"),
    ("A = 65536 * 65536", 1, "32 bits"),
    ("A = 1 // 0", 1, "no value"),
    ("A = 'text'", 1, "made of numbers"),
    ("A = B + 1", 1, "made of numbers"),
    ("A = B = 1", 1, "at module level"),
    ("A: int = 1", 1, "at module level"),
    ("import math", 1, "from … import"),
    ("from math import sin", 1, "math.sin is not known"),
    ("from os import path", 1, "os is not known"),
    ("from .record import fields_of", 1, "record.fields_of is not known"),
    ("from math import sqrt as root", 1, "keeps its name"),
    ("from .missing import thing", 1, "no module missing"),
    ("if True:\n    A = 1", 1, "at module level"),
    ("print(1)", 1, "at module level"),
    ("class A:\n    x: float", 1, "write @dataclass(slots=True)"),
    ("@dataclass\nclass A:\n    x: float", 2, "write @dataclass(slots=True)"),
    ("@dataclass(slots=True)\nclass A(B):\n    x: float", 2, "stands alone"),
    ("@dataclass(slots=True)\nclass A:\n    x: float = 0.0", 3, "no default"),
    ("@dataclass(slots=True)\nclass A:\n    x = 0.0", 3, "fields only"),
    ("@dataclass(slots=True)\nclass A:\n    x: float\n    def f(self) -> None:\n        pass", 4, "f is a method"),
    ("@dataclass(slots=True)\nclass A:\n    x: list[float]", 3, "no type of the subset"),
    ("@dataclass(slots=True)\nclass A:\n    x: None", 3, "holds nothing"),
    ("@dataclass(slots=True)\nclass A:\n    switch: float", 3, "already means something in C"),
    ('@dataclass(slots=True)\nclass A:\n    """Empty."""', 2, "no fields"),
    ("@dataclass(slots=True)\nclass A:\n    SIZE: float\nSIZE: Final[int] = 3", 3, "also the name of a constant"),
]


def refusals(tmp_path: Path, text: str, exports: tuple[str, ...] = ("f",)) -> list[tuple[str, int, str]]:
    """Return what is refused in a module."""
    folder = write_package(tmp_path / "package", {"functions": text})
    with pytest.raises(TranslationError) as error:
        translate(folder, exports)
    return [(Path(refusal.file).name, refusal.line, refusal.sentence) for refusal in error.value.refusals]


@pytest.mark.parametrize(("body", "line", "sentence"), BODIES, ids=[body.partition("\n")[0] for body, _, _ in BODIES])
def test_a_body_outside_the_subset_is_refused_at_its_line(tmp_path: Path, body: str, line: int, sentence: str) -> None:
    start = PREAMBLE + RECORDS + "def f(a: All, table: Vec, x: float, n: int, b: bool) -> float:\n"
    read_all = "    if b:\n        x += float(n) + look(a.part) + table[0]\n"
    lines = "".join(f"    {one}\n" for one in body.split("\n"))
    found = refusals(tmp_path, f"{start}{lines}{read_all}    return x\n")
    place = start.count("\n") + line
    assert any(where == place and sentence in what for _, where, what in found), found
    assert {where for _, where, what in found if "never reached" not in what} <= {place, place + 1}, found


@pytest.mark.parametrize(("text", "line", "sentence"), MODULE_LEVEL, ids=[repr(text) for text, _, _ in MODULE_LEVEL])
def test_a_definition_outside_the_subset_is_refused_at_its_line(
    tmp_path: Path, text: str, line: int, sentence: str
) -> None:
    end = "\n\ndef last() -> int:\n    return 1\n"
    found = refusals(tmp_path, PREAMBLE + text + end, ("last",))
    assert any(where == PREAMBLE.count("\n") + line and sentence in what for _, where, what in found), found


def test_a_record_that_holds_a_vec_is_refused_once_by_module_record_and_field(tmp_path: Path) -> None:
    record = "@dataclass(slots=True)\nclass Table:\n    scale: float\n    pool: Vec  # numbers\n"
    user = (
        "from .tables import Table\n\n\ndef f(table: Table, i: int) -> float:\n    pool = table.pool\n"
        "    return g(pool, i) * table.scale + table.pool[0]\n\n\n"
    )
    taker = "def g(pool: Vec, i: int) -> float:\n    return pool[i]\n"
    folder = write_package(tmp_path / "package", {"tables": PREAMBLE + record, "user": PREAMBLE + user + taker})
    with pytest.raises(TranslationError) as error:
        translate(folder, ("f",))
    line = PREAMBLE.count("\n") + 4
    assert str(error.value) == (
        f"{folder / 'tables.py'}:{line}: pool of the record Table in tables is a Vec, a pointer in"
        " C, and a record holds none: keep an offset, and hand the Vec to the functions as a parameter"
    )


def test_a_vec_is_handed_on_from_parameter_to_parameter(tmp_path: Path) -> None:
    caller = "def f(pool: Vec) -> float:\n    numbers = pool\n    return g(numbers)\n"
    text = f"{caller}def g(pool: Vec) -> float:\n    return pool[1]\n"
    source = translate(write_package(tmp_path / "package", {"functions": PREAMBLE + text}), ("f",)).source
    assert "double axcomp_f(const double *pool)\n{\n    const double *numbers = pool;\n    return g(numbers);" in source


def test_every_refusal_of_every_module_is_reported_at_once(tmp_path: Path) -> None:
    first = "A = 1\n\n\ndef g(x: float) -> float:\n    y = x ** 2.0\n    z = [x]\n    return y + z\n"
    second = "from .first import A, g\n\n\ndef f(x: float) -> float:\n    x = x % 2.0\n    return g(x) + unknown\n"
    folder = write_package(tmp_path / "package", {"first": first, "second": second})
    with pytest.raises(TranslationError) as error:
        translate(folder, ("f",))
    assert [(Path(r.file).name, r.line) for r in error.value.refusals] == [
        ("first.py", 5),
        ("first.py", 6),
        ("second.py", 5),
        ("second.py", 6),
    ]
    assert str(error.value).splitlines()[0].startswith(f"{folder / 'first.py'}:5: ")


def test_modules_that_import_each_other_are_refused(tmp_path: Path) -> None:
    modules = {
        "first": "from .second import B\n\nA = B\n\n\ndef f() -> int:\n    return A\n",
        "second": "from .first import A\n\nB = A\n",
    }
    folder = write_package(tmp_path / "package", modules)
    with pytest.raises(TranslationError, match=r"second\.py:1: first imports this module in turn"):
        translate(folder, ("f",))


def test_a_name_that_another_module_has_taken_is_refused(tmp_path: Path) -> None:
    modules = {
        "first": "def _limit(x: float) -> float:\n    return x\n\n\ndef g(x: float) -> float:\n    return _limit(x)\n",
        "second": "from .first import g\n\n\ndef limit(x: float) -> float:\n    return g(x)\n"
        "\n\ndef f(x: float) -> float:\n    return limit(x)\n",
    }
    folder = write_package(tmp_path / "package", modules)
    with pytest.raises(
        TranslationError, match=r"second\.py:4: limit would be the same name in C as _limit at .*first\.py:1"
    ):
        translate(folder, ("f",))


def test_a_missing_export_and_a_syntax_error_are_refused(tmp_path: Path) -> None:
    assert "exported function g" in refusals(tmp_path, "def f() -> int:\n    return 1\n", ("g",))[0][2]
    (tmp_path / "package" / "functions.py").write_text("def f(:\n")
    with pytest.raises(TranslationError, match=r"functions\.py:1: no Python"):
        translate(tmp_path / "package", ("f",))
