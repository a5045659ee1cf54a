"""What every part of the table compiler needs: the error, and the pool of floats."""

from __future__ import annotations

from collections.abc import Sequence


class CompileError(ValueError):
    """A Machine that the kernel cannot run: the message names axis, compensation and what is wrong."""


def append(pool: list[float], values: Sequence[float], owner: str) -> int:
    """Put numbers into the pool and return where they begin; CompileError, naming the owner, if one is not finite."""
    if not all(abs(value) < 1e15 for value in values):
        raise CompileError(f"{owner}: a table holds a number that is not finite")
    first = len(pool)
    pool.extend(values)
    return first
