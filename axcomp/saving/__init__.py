"""Writing files whole or not at all: everything axcomp writes goes through here."""

from .saving import write_all, write_whole

__all__ = ["write_all", "write_whole"]
