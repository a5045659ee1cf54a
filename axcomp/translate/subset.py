"""What the translator refuses: the sentences, and where they point to.

The kernel is restricted Python: it runs as it is and translates line by line to C99. Anything that C has not, or that C
would do differently, is refused with file and line; all refusals of a program are collected before any is reported.
"""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(frozen=True, order=True)
class Refusal:
    """One place of the source that is outside the subset.

    Attributes
    ----------
    file : str
        As it was named to the translator.
    line : int
        Counted from 1.
    sentence : str
        What was found, and what to write instead where that is not plain.
    """

    file: str
    line: int
    sentence: str

    def __str__(self) -> str:
        """``file:line: sentence``, as compilers write it."""
        return f"{self.file}:{self.line}: {self.sentence}"


class TranslationError(Exception):
    """The source is outside the subset; ``refusals`` lists every place, in the order of the files and lines."""

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
