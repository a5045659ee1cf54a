"""Tables as an image: what ``fmu_src/native/image.c`` reads, from a file or from an array in the sources."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..lists import Finding, Severity
from ..runtime import Compiled
from .layout import ctypes_of, to_c
from .places import layout

MAGIC = b"AXCOMPT2"
HEADER_BEFORE_CHECK = struct.Struct("<8sIHHI")
HEADER_AFTER_CHECK = struct.Struct("<40sdHH228s")
SAID = 227
"""Bytes of the first error that an image tells."""
WORDS_A_LINE = 6


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
    body = b"".join(_bytes_of(axis) for axis in axes)
    body += b"".join(_bytes_of(volumetric) for volumetric in volumetrics)
    body += struct.pack(f"<{len(pool)}d", *pool)
    before = HEADER_BEFORE_CHECK.pack(MAGIC, layout(), len(axes), len(volumetrics), len(pool))
    checked = (
        HEADER_AFTER_CHECK.pack(guid.encode()[:40], tables.cycle_time, min(len(errors), 0xFFFF), real_only, said) + body
    )
    return before + struct.pack("<I", zlib.crc32(checked)) + checked


def image_source(image: bytes) -> str:
    """Return an image as C: an array of 64-bit words, so that it is aligned as the records are."""
    padded = image.ljust(-(-len(image) // 8) * 8, b"\0")
    words = [f"0x{word:x}u" for (word,) in struct.iter_unpack("<Q", padded)]
    lines = [", ".join(words[i : i + WORDS_A_LINE]) for i in range(0, len(words), WORDS_A_LINE)]
    return (
        '/* The tables of this machine; see image.h. */\n#include "image.h"\n\n'
        f"const unsigned int axcomp_image_size = {len(image)}u;\n"
        f"const unsigned long long axcomp_image[{len(words)}] = {{\n    " + ",\n    ".join(lines) + "\n};\n"
    )


def _bytes_of(record: Any) -> bytes:
    structure = ctypes_of(type(record))()
    to_c(record, structure)
    return bytes(structure)
