"""Fixtures of the translator's tests."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from translating import Builder


@pytest.fixture
def build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Builder]:
    """Return a function that translates, compiles and imports a module given as text."""
    monkeypatch.syspath_prepend(tmp_path)
    builder = Builder(tmp_path)
    yield builder
    builder.forget()
