"""Universal libraries of macOS: one file with the code of several processors (Mach-O, big-endian header)."""

from __future__ import annotations

import struct
from collections.abc import Sequence

_UNIVERSAL = 0xCAFEBABE
_PAGE = 1 << 14
"""Each slice begins at a multiple of it: the page of Apple's processors, bytes."""


def universal(slices: Sequence[bytes]) -> bytes:
    """Return the universal library of 64-bit Mach-O libraries; their signatures stay valid."""
    header = struct.pack(">2I", _UNIVERSAL, len(slices))
    body = b""
    for data in slices:
        body += bytes(-len(body) % _PAGE)
        _, processor, variant = struct.unpack_from("<3I", data)
        header += struct.pack(">5I", processor, variant, _PAGE + len(body), len(data), _PAGE.bit_length() - 1)
        body += data
    return header.ljust(_PAGE, b"\0") + body
