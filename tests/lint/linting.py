"""What the tests of the linter have in common."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

Write = Callable[[Mapping[str, str | bytes]], Path]
Check = Callable[..., Any]
