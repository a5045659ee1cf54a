"""The layout of a list: names and values in columns, one blank line at most, nothing behind the last line."""

from __future__ import annotations

import re

from ..lists import Document, DocumentEntry, continued

_NAME_WIDTH = 40
_COMMENT_GAP = 2


def formatted(document: Document) -> str | None:
    r"""Return the text of a list in its layout, with ``\n`` between lines; None if it is no list.

    Entries, their order, their values and comments stay what they are.
    """
    if document.kind is None or not document.is_text:
        return None
    lines = document.text.split("\n")
    inside = continued(lines)
    keep = inside | {line - 1 for line in inside}
    found = {entry.line - 1: entry for entry in document.entries}
    width = max([_NAME_WIDTH, *(len(entry.name) for entry in found.values())]) + 1
    values = [len(entry.value) for at, entry in found.items() if entry.comment and at not in keep]
    out: list[str] = []
    for at, line in enumerate(lines):
        if at in keep:
            out.append(line)
        elif at in found:
            out.append(_entry(found[at], width, width + max(values, default=0) + _COMMENT_GAP))
        else:
            out.append(line.strip())
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(out) if not keep else _joined(out, keep)).strip("\n")
    return f"{text}\n" if text else ""


def _entry(entry: DocumentEntry, width: int, comments: int) -> str:
    line = f"{entry.name:<{width}}{entry.value}".rstrip()
    if not entry.comment:
        return line
    return f"{line:<{comments - 1}} {entry.comment}" if entry.value else f"{line:<{width - 1}} {entry.comment}"


def _joined(lines: list[str], keep: set[int]) -> str:
    return "\n".join("" if at not in keep and not line else line for at, line in enumerate(lines))
