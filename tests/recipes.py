"""The recipes of ``docs/architecture.md``, carried out on a copy of the checkout."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "architecture.md"
COPIED = ("axcomp", "fmu_src", "models", "docs", "README.md", "LICENSE", "pyproject.toml")

_BLOCK = re.compile(r"^```(python|diff|sh)\n(.*?)^```", re.DOTALL | re.MULTILINE)


def recipe(heading: str) -> list[tuple[str, str]]:
    """Return language and text of the code blocks below a heading of the page."""
    page = PAGE.read_text(encoding="utf-8")
    (section,) = (part for part in re.split(r"^## ", page, flags=re.MULTILINE) if part.startswith(f"{heading}\n"))
    return _BLOCK.findall(section)


class Checkout:
    """A copy of the checkout, in which recipes are carried out.

    Attributes
    ----------
    folder : Path
    written : list of str
        Files that the recipes have written or changed by hand.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.written: list[str] = []
        for name in COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__", "images"))
            else:
                shutil.copy(source, folder / name)

    def carry_out(self, heading: str) -> None:
        """Write new files, change present ones and run the commands, in the order of the page."""
        for language, text in recipe(heading):
            if language == "sh":
                for command in text.splitlines():
                    python, *arguments = shlex.split(command)
                    assert python == "python"
                    self.run(*arguments)
                continue
            first, _, rest = text.partition("\n")
            path = self.folder / first.removeprefix("# ")
            self.written.append(first.removeprefix("# "))
            if language == "python":
                assert not path.exists()
                path.write_text(rest, encoding="utf-8")
            else:
                path.write_text(changed(path.read_text(encoding="utf-8"), rest), encoding="utf-8")

    def run(self, *arguments: str, **environment: str) -> str:
        """Run Python in the copy; return what it prints, in words."""
        own = {"PYTHONPATH": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache")}
        result = subprocess.run(
            [sys.executable, *arguments],
            cwd=self.folder,
            env={**os.environ, **own, **environment},
            capture_output=True,
            text=True,
            check=False,
        )
        assert result.returncode == 0, result.stdout + result.stderr
        return result.stdout


def changed(text: str, diff: str) -> str:
    """Return a text with the hunks of a diff applied: each begins with ``@@`` and fits at one place only."""
    for hunk in re.split(r"^@@\n", diff, flags=re.MULTILINE):
        lines = hunk.splitlines(keepends=True)
        before, after = ("".join(line[1:] for line in lines if line[0] in signs) for signs in (" -", " +"))
        assert text.count(before) == 1, f"not exactly once in the file:\n{before}"
        text = text.replace(before, after)
    return text
