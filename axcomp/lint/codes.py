"""What each code of a finding means, why it matters, how it is mended, and an example."""

from __future__ import annotations

import textwrap
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ..lists import CODES
from ..model import docs

PAGE = docs() / "findings.md"
"""Where the page is: in a checkout, or in the installed package."""


class Page(NamedTuple):
    """What there is to say about a code.

    Attributes
    ----------
    code, severity, meaning : str
        As ``CODES`` has them.
    why : str
        What it does to the machine.
    mend : str
        What to do about it.
    example : str
        Lists that have it; several files are parted by lines ``=== NAME``. "" where lists alone cannot show it.
    options : tuple of str
        Of ``axcomp check``, without which the example does not show it.
    """

    code: str
    severity: str
    meaning: str
    why: str
    mend: str
    example: str
    options: tuple[str, ...]

    @property
    def files(self) -> dict[str, str]:
        """The lists of the example by their names."""
        found: dict[str, list[str]] = {}
        lines = found["achskw1.lis"] = []
        for line in self.example.splitlines():
            if line.startswith("=== "):
                lines = found.setdefault(line[4:], [])
            else:
                lines.append(line)
        return {name: "\n".join([*lines, ""]) for name, lines in found.items() if lines}


@cache
def pages() -> dict[str, Page]:
    """Return the page of every code."""
    told = tomllib.loads(Path(__file__).with_name("pages.toml").read_text(encoding="utf-8"))
    return {
        code: Page(
            code,
            severity.value,
            f"{meaning}.",
            " ".join(told[code]["why"].split()),
            " ".join(told[code]["mend"].split()),
            told[code].get("example", ""),
            tuple(told[code].get("options", "").split()),
        )
        for code, (severity, meaning) in CODES.items()
    }


def help_address(code: str, base: str = "") -> str:
    """Return where a code is explained; ``base``: the address of the page, where it is not the installed one."""
    return f"{base or PAGE.as_uri()}#{code.lower()}"


def explained(code: str) -> str:
    """Return all about a code as Markdown; KeyError if there is none."""
    return "\n".join(_section(pages()[code]))


def page() -> str:
    """Return the text of the page with all codes."""
    return "\n".join((*_lines(), ""))


def _lines() -> Iterator[str]:
    yield "# Findings"
    yield ""
    yield "Made by `python -m axcomp.lint` from `axcomp/lint/pages.toml`. Numbers are the vendor's, codes `AXC-…`"
    yield "this program's own. What `axcomp check --fix` mends by itself stands on the page of the [linter](linter.md)."
    yield ""
    yield "| Code | Severity | Meaning |"
    yield "| --- | --- | --- |"
    for one in pages().values():
        yield f"| [{one.code}](#{one.code.lower()}) | {one.severity} | {one.meaning} |"
    for one in pages().values():
        yield ""
        yield from _section(one)


def _section(one: Page) -> Iterator[str]:
    yield f"## {one.code}"
    yield ""
    yield from textwrap.wrap(f"**{one.severity}:** {one.meaning}", 120)
    yield ""
    yield from textwrap.wrap(f"*Why it matters.* {one.why}", 120)
    yield ""
    yield from textwrap.wrap(f"*How to mend it.* {one.mend}", 120)
    if one.example:
        with_options = f" with `{' '.join(one.options)}`" if one.options else ""
        yield ""
        yield f"*Example*{with_options}:"
        yield ""
        yield "```"
        yield from one.example.strip("\n").splitlines()
        yield "```"
