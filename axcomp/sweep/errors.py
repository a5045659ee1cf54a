"""What can be wrong with a specification."""

from __future__ import annotations


class SpecError(ValueError):
    """A specification that cannot be used: one sentence behind ``file: key:``."""

    def __init__(self, file: object, key: str, sentence: str) -> None:
        self.key = key
        super().__init__(f"{file}: {key}: {sentence}" if key else f"{file}: {sentence}")
