"""What C does for ``sound`` and ``decided``: a function for each record that looks at all that is in it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from .kinds import ArrayType, RecordType, Scalar, Type
from .program import Program, Struct

_CALL = re.compile(r"\b(sound|decided)_(\w+)\(")


def checks(program: Program, written: str) -> list[str]:
    """Return the functions that a text calls, callees first, a line each."""
    done: dict[tuple[str, str], list[str]] = {}

    def write(what: str, kind: RecordType) -> None:
        if (what, kind.name) not in done:
            record = program.record_of(kind)
            for field in record.fields.values():
                inner = field.element if isinstance(field, ArrayType) else field
                if isinstance(inner, RecordType) and _test(what, field):
                    write(what, inner)
            done[what, kind.name] = list(_function(what, record))

    for what, name in dict.fromkeys(_CALL.findall(written)):
        write(what, RecordType(name))
    return [line for lines in done.values() for line in lines]


def _function(what: str, record: Struct) -> Iterator[str]:
    tests = [(name, kind, _test(what, kind)) for name, kind in record.fields.items()]
    tests = [(name, kind, test) for name, kind, test in tests if test]
    yield f"static bool {what}_{record.c_name}(const {record.c_name} *record)"
    yield "{"
    if not tests:
        yield "    (void)record;"
    for name, kind, test in tests:
        if isinstance(kind, ArrayType):
            yield f"    for (int32_t i = 0; i < {kind.length_text}; i++) {{"
            yield f"        if (!{test.replace('@', f'record->{name}[i]')}) {{"
            yield from ("            return false;", "        }", "    }")
        else:
            yield f"    if (!{test.replace('@', f'record->{name}')}) {{"
            yield from ("        return false;", "    }")
    yield from ("    return true;", "}")


def _test(what: str, kind: Type) -> str:
    """Return a condition about ``@``, "" where there is nothing to look at."""
    if isinstance(kind, ArrayType) and kind.apart:
        return ""  # whoever knows how long it is looks at it
    inner = kind.element if isinstance(kind, ArrayType) else kind
    if isinstance(inner, RecordType):
        return f"{what}_{inner.name}(&@)"
    if inner is Scalar.BOOL:
        # A byte that is neither must not be read as a truth value.
        return "(*(const unsigned char *)&@ <= 1)"
    return "(@ - @ == 0.0)" if inner is Scalar.FLOAT and what == "sound" else ""
