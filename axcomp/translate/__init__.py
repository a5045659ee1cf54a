"""The translator: the kernel's restricted Python to readable C99 that computes the same bits.

A module holds, in this order of dependency: imports, constants (numbers, and arithmetic on them), records
(``@dataclass(slots=True)``) and functions with all types stated. Types are int (int32_t), float (double), bool,
records, ``Annotated[list[T], N]`` and ``Vec`` (a table that is only read, and no field of a record). Records and lists
are handed on by reference, as Python does: a parameter or alias becomes a pointer, const where nothing is written
through it. A record itself holds no pointers, so a copy of one is complete.

What the kernel must see to by itself, because C does not say or the translator cannot know: whole numbers stay within
32 bits, also on ``int(x)`` (clamp before), indices are never negative, shifts move non-negative numbers, and nothing is
divided by 0. A float is never taken for an int, nor an int for a float where −0 would tell them apart.

Everything else that C would do otherwise, or not at all, is refused with file, line and a sentence (see ``subset``).
"""

from __future__ import annotations

from .command import main
from .emit import Translation, translate
from .subset import Refusal, TranslationError

__all__ = ["Refusal", "Translation", "TranslationError", "main", "translate"]
