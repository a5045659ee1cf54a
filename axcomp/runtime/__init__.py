"""."""

from __future__ import annotations

from .compile import Compiled, CompileError, compile_tables, error_model
from .runtime import NO_COMMAND, ON_INSTANT, Runtime, UpdateError, initial_inputs
from .snapshot import SnapshotError, identity_of, pack, unpack

__all__ = [
    "NO_COMMAND",
    "ON_INSTANT",
    "CompileError",
    "Compiled",
    "Runtime",
    "SnapshotError",
    "UpdateError",
    "compile_tables",
    "error_model",
    "identity_of",
    "initial_inputs",
    "pack",
    "unpack",
]
