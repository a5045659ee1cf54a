"""The parser of every command: help that fits the terminal, and a refusal before the work where no output can go."""

from __future__ import annotations

import argparse
import os
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

OUTPUTS = ("output", "plot", "image", "ssp", "write_baseline")
"""Options of all commands that name what is written."""

CHOICES_MAX = 40
"""Characters that the choices of an option have at most in its usage; more are listed in its help."""

_COLUMNS = re.compile(r"(\s*\S.*?\s{2,})(\S.*)\Z")
_WORDS = re.compile(r'(?:[^\s"]|"[^"]*")+')


class Help(argparse.HelpFormatter):
    """Help as wide as the terminal: paragraphs are filled, examples and columns go on below where they began."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:  # noqa: ARG002
        return "\n".join(line for block in text.strip("\n").split("\n\n") for line in [*_block(block, width), ""])

    def _metavar_formatter(self, action: argparse.Action, default_metavar: str) -> Any:
        if action.metavar is None and action.choices is not None and not _is_short(action):
            choices = action.choices
            action.metavar = action.dest.upper()
            action.help = f"{action.help or ''} ({', '.join(map(str, choices))})".strip()
        return super()._metavar_formatter(action, default_metavar)


def _is_short(action: argparse.Action) -> bool:
    return sum(len(str(one)) + 1 for one in action.choices or ()) <= CHOICES_MAX


def _block(block: str, width: int) -> Iterator[str]:
    """Yield the lines of a paragraph; lines that begin with a blank stand for themselves."""
    paragraph: list[str] = []
    for line in block.split("\n"):
        if line[:1].isspace():
            yield from _filled(paragraph, width)
            paragraph = []
            yield from _kept(line, width)
        else:
            paragraph.append(line)
    yield from _filled(paragraph, width)


def _filled(paragraph: list[str], width: int) -> list[str]:
    text = " ".join(paragraph)
    return textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False) if text else []


def _kept(line: str, width: int) -> Iterator[str]:
    """Yield a line of an example: a command goes on behind a backslash, the last column below itself."""
    if len(line) <= width:
        yield line
        return
    indent = line[: len(line) - len(line.lstrip())]
    columns = _COLUMNS.match(line)
    if columns and len(columns[1]) < width - 20:
        comment = "# " if columns[2].startswith("# ") else ""
        rest = textwrap.wrap(columns[2].removeprefix("# "), width - len(columns[1]) - len(comment))
        for number, part in enumerate(rest):
            yield (columns[1] if number == 0 else " " * len(columns[1])) + comment + part
        return
    written = indent
    for word in _words(line):
        if len(written) + len(word) + 3 > width and written.strip():
            yield f"{written.rstrip()} \\"
            written = f"{indent}    "
        written += f"{word} "
    yield written.rstrip()


def _words(line: str) -> Iterator[str]:
    """Yield the words of a command, an option with its value as one."""
    words = _WORDS.findall(line)
    while words:
        word = words.pop(0)
        if word.startswith("--") and words and not words[0].startswith("--"):
            word = f"{word} {words.pop(0)}"
        yield word


class Parser(argparse.ArgumentParser):
    """A parser of axcomp or of one of its commands."""

    def __init__(self, **options: Any) -> None:
        super().__init__(**{**options, "formatter_class": Help})

    def error(self, message: str) -> NoReturn:
        """Say what is wrong and where help is; exit with 2."""
        self.exit(2, f"{self.format_usage()}{self.prog}: error: {message}\n")


def refusal(options: argparse.Namespace) -> str:
    """Return why nothing can be written where the options say, "" if it can."""
    for name in OUTPUTS:
        path = getattr(options, name, None)
        if not isinstance(path, Path):
            continue
        folder = path.parent
        if not folder.is_dir():
            return f"there is no folder {folder} for {path.name}"
        place = path if path.exists() and not path.is_dir() else folder
        if not os.access(place, os.W_OK):
            return f"{place} cannot be written"
    return ""
