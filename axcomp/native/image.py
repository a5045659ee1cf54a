"""Tables as an image, a file that ``fmu_src/native/image.c`` reads, and as C."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from ..lists import Finding, Severity
from ..runtime import Compiled
from .places import layout
from .records import initializer, record_bytes, wrapped

MAGIC = b"AXCOMPT3"
HEADER_BEFORE_CHECK = struct.Struct("<8sIHHI")
HEADER_AFTER_CHECK = struct.Struct("<40sdHH228s")
SAID = 227
"""Bytes of the first error that an image tells."""


def image_of(compiled: Compiled, guid: str, findings: Iterable[Finding] = (), *, real_only: bool = False) -> bytes:
    """Return the image of tables.

    ``guid``: that of the modelDescription.xml they belong to, at most 39 characters; ``findings``: what there was to
    say about their lists: with errors among them ``reload`` refuses the image, as it refuses lists (semantics §2).
    ``real_only``: that model description calls Booleans and Integers Real.
    """
    errors = [finding for finding in findings if finding.severity is Severity.ERROR]
    # Not the folder: an FMU is the same wherever it is built.
    first = "".join(str(replace(error, file=Path(error.file).name)) for error in errors[:1])
    said = first.encode()[:SAID].decode(errors="ignore").encode()
    tables, pool = compiled
    axes = tables.axis[: tables.axis_count]
    volumetrics = tables.volumetric[: tables.volumetrics]
    body = b"".join(map(record_bytes, [*axes, *volumetrics]))
    body += struct.pack(f"<{len(pool)}d", *pool)
    before = HEADER_BEFORE_CHECK.pack(MAGIC, layout(), len(axes), len(volumetrics), len(pool))
    checked = (
        HEADER_AFTER_CHECK.pack(guid.encode()[:40], tables.cycle_time, min(len(errors), 0xFFFF), real_only, said) + body
    )
    return before + struct.pack("<I", zlib.crc32(checked)) + checked


def tables_source(compiled: Compiled, guid: str, *, real_only: bool = False) -> str:
    """Return tables as C: records that the compiler initializes, for any byte order and pointer size."""
    tables, pool = compiled
    axes, volumetrics = tables.axis[: tables.axis_count], tables.volumetric[: tables.volumetrics]
    identity = zlib.crc32(guid.encode())
    parts = ['/* The tables of this machine. */\n#include "image.h"\n\n#include <stddef.h>\n']
    parts.append(_array("double", "pool", [repr(number) for number in pool] or ["0.0"]))
    parts.append(_array("AxisTable", "axes", [initializer(axis) for axis in axes]))
    if volumetrics:
        parts.append(_array("VolumetricTable", "volumetrics", [initializer(one) for one in volumetrics]))
    tables_of = f"{tables.cycle_time!r}, {len(axes)}, (AxisTable *)axes, {len(volumetrics)}, "
    tables_of += "(VolumetricTable *)volumetrics" if volumetrics else "NULL"
    parts.append(
        "/* Nothing writes through the pointers: these tables are in force from beginning to end. */\n"
        f'const Lists axcomp_tables = {{{{{tables_of}}}, pool, {len(pool)}, 0x{identity:08x}u, "{guid}", '
        f"{str(real_only).lower()}, false, false}};\n"
    )
    return "\n".join(parts)


def _array(kind: str, name: str, elements: list[str]) -> str:
    lines = wrapped(", ".join(elements)) if kind == "double" else ",\n".join(map(wrapped, elements))
    return f"static const {kind} {name}[{len(elements)}] = {{\n{lines}\n}};\n"
