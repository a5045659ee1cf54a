"""What the translator refuses: the sentences, where they point to, and the names that C has already taken.

The kernel is restricted Python: it runs as it is and translates line by line to C99. Anything that C has not, or that C
would do differently, is refused with file and line; all refusals of a program are collected before any is reported.
"""

from __future__ import annotations

import ast
import contextlib
import re
from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(frozen=True, order=True)
class Refusal:
    """A line of the source that is outside the subset, counted from 1; the file as it was named to the translator.

    The sentence says what was found, and what to write instead where that is not plain.
    """

    file: str
    line: int
    sentence: str

    def __str__(self) -> str:
        """``file:line: sentence``, as compilers write it."""
        return f"{self.file}:{self.line}: {self.sentence}"


class TranslationError(Exception):
    """The source is outside the subset; ``refusals`` lists every line, in the order of the files and lines."""

    def __init__(self, refusals: tuple[Refusal, ...]) -> None:
        self.refusals = refusals
        super().__init__("\n".join(str(refusal) for refusal in refusals))


class RefusedError(Exception):
    """Raised by a rule at a node; an empty sentence marks a consequence of what has been refused before."""

    def __init__(self, node: ast.AST, sentence: str) -> None:
        self.line = int(getattr(node, "lineno", 1))
        self.sentence = sentence
        super().__init__(sentence)


@dataclass
class Report:
    """Collects refusals, so that one run names them all."""

    refusals: set[Refusal] = field(default_factory=set)

    @contextlib.contextmanager
    def catching(self, file: str) -> Iterator[None]:
        """Note a refusal that is raised inside and go on behind the block."""
        try:
            yield
        except RefusedError as refused:
            self.add(file, refused)

    def add(self, file: str, refused: RefusedError) -> None:
        """Note what a rule refused in ``file``."""
        if refused.sentence:
            self.refusals.add(Refusal(file, refused.line, refused.sentence))

    def finish(self) -> None:
        """Raise TranslationError if anything has been refused."""
        if self.refusals:
            raise TranslationError(tuple(sorted(self.refusals)))


_COMPREHENSION = "a comprehension is a loop in C: write the loop"
_COROUTINE = "the kernel has no coroutines and generators"
TEXT = "text has no place in the kernel"
_EXCEPTION = "C has no exceptions: check before, and report through a field"

SENTENCES: dict[type[ast.AST], str] = {
    ast.Tuple: "a tuple has no counterpart in C: assign the values one by one",
    ast.List: "a list is made by zeros(n) only",
    ast.Dict: "the kernel has no dictionaries",
    ast.Set: "the kernel has no sets",
    ast.ListComp: _COMPREHENSION,
    ast.SetComp: _COMPREHENSION,
    ast.DictComp: _COMPREHENSION,
    ast.GeneratorExp: _COMPREHENSION,
    ast.Lambda: "a lambda has no counterpart in C: write a function",
    ast.JoinedStr: TEXT,
    ast.NamedExpr: "an assignment is a statement of its own",
    ast.Starred: "arguments are given one by one",
    ast.Slice: "a slice would be a copy: index one element",
    ast.Await: _COROUTINE,
    ast.Yield: _COROUTINE,
    ast.YieldFrom: _COROUTINE,
    ast.AsyncFor: _COROUTINE,
    ast.AsyncWith: _COROUTINE,
    ast.AsyncFunctionDef: _COROUTINE,
    ast.Try: _EXCEPTION,
    ast.TryStar: _EXCEPTION,
    ast.Raise: _EXCEPTION,
    ast.Assert: _EXCEPTION,
    ast.With: "the kernel has no context managers",
    ast.Match: "match has no counterpart in C: write if … elif",
    ast.Delete: "nothing is deleted: C frees a local at the end of its block",
    ast.Global: "the kernel has no globals: keep it in a record",
    ast.Nonlocal: "the kernel has no closures: pass it as an argument",
    ast.FunctionDef: "a function stands at module level",
    ast.ClassDef: "a record stands at module level",
    ast.Import: "an import stands at module level",
    ast.ImportFrom: "an import stands at module level",
    ast.Pow: "** has no counterpart in C: multiply, or call sqrt",
    ast.MatMult: "@ has no counterpart in C: write the loops",
    ast.BitXor: "^ is not in the subset",
    ast.Invert: "~ is not in the subset",
    ast.Is: "`is` compares identities: use ==",
    ast.IsNot: "`is not` compares identities: use !=",
    ast.In: "`in` is a loop in C: write the loop",
    ast.NotIn: "`not in` is a loop in C: write the loop",
}
"""What is refused for its kind alone."""


def outside(node: ast.AST, kind: ast.AST | None = None) -> RefusedError:
    """Return the refusal of ``node`` because of its kind, or of the kind of its operator."""
    kind = kind or node
    return RefusedError(node, SENTENCES.get(type(kind), f"{type(kind).__name__} is not in the subset"))


_LANGUAGES = """
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class compl
    concept const consteval constexpr constinit const_cast continue co_await co_return co_yield decltype default
    delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline int long
    mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public register
    reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct switch
    template this thread_local throw true try typedef typeid typename typeof union unsigned using virtual void
    volatile wchar_t while xor xor_eq
"""
_MACROS = """
    NULL NAN INFINITY HUGE_VAL EOF I complex imaginary linux unix i386 min max errno
    isnan isinf isfinite isnormal signbit fpclassify math_errhandling stdin stdout stderr assert offsetof
"""  # of the headers in use, of compilers' GNU modes, and the two that <windows.h> is known for
_HELPERS = "floor sqrt fabs whole double_min double_max int_min int_max int_abs int_floor_div int_floor_mod"
_LIBRARY = """
    abort abs acos acosh asin asinh atan atan2 atanh atexit atof atoi atol atoll bsearch calloc cbrt ceil clock
    copysign cos cosh div drem erf erfc exit exp exp2 expm1 fdim fma fmax fmin fmod free frexp gamma getenv hypot
    ilogb index j0 j1 jn labs ldexp ldiv lgamma llabs lldiv llrint llround log log10 log1p log2 logb lrint lround
    main malloc memchr memcmp memcpy memmove memset modf nan nearbyint nextafter nexttoward pow qsort rand random
    realloc remainder remove remquo rename rindex rint round scalb scalbn select signal significand sin sincos sinh
    srand strcat strchr strcmp strcpy strlen strncmp strncpy system tan tanh tgamma time trunc y0 y1 yn
"""
_TAKEN = frozenset(f"{_LANGUAGES} {_MACROS} {_HELPERS}".split())
_TAKEN_AT_FILE_SCOPE = _TAKEN | frozenset(_LIBRARY.split())


def c_name(name: str) -> str:
    """Return a module-level name as C writes it: without leading underscores, which C reserves at file scope."""
    return name.lstrip("_")


def check_name(node: ast.AST, name: str, *, file_scope: bool = False) -> None:
    """Refuse a name that C or C++ has taken.

    At file scope the standard library's names are taken too, and leading underscores do not count: there they are
    dropped (see ``c_name``), because C reserves them.
    """
    bare = c_name(name) if file_scope else name
    if bare in (_TAKEN_AT_FILE_SCOPE if file_scope else _TAKEN):
        raise RefusedError(node, f"{name} already means something in C: choose another name")
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", bare):
        raise RefusedError(node, f"{name} is no name in C: it takes ASCII letters, digits and _ only")
    if re.match(r"_[_A-Z]", bare) or (file_scope and bare.endswith("_t")):
        raise RefusedError(node, f"{name} is reserved for the C library: choose another name")
