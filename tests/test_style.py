"""The rules that tools can check: format, lint, types."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COMMANDS = {"formatted": ["ruff", "format", "--check", "."], "linted": ["ruff", "check", "."], "typed": ["mypy"]}


@pytest.mark.slow
@pytest.mark.parametrize("rule", COMMANDS)
def test_the_checkout_is(rule: str) -> None:
    result = subprocess.run(
        [sys.executable, "-m", *COMMANDS[rule]], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
