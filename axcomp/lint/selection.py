"""Which findings are told: by code, by file, and by what a list itself says behind an entry."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from fnmatch import fnmatch
from functools import cached_property
from pathlib import Path

from ..lists import CODES, Document, Finding
from .settings import Settings, relative

_INLINE = re.compile(r"axcomp:\s*ignore(-file)?(?![\w-])[ \t]*([\w-]+(?:[ \t]*,[ \t]*[\w-]+)*)?", re.I)
_ALONE = re.compile(r"\s*(?:#|/\*|\()")


class Selection:
    """Chooses among findings.

    ``# axcomp: ignore CODE`` (several with commas between) behind an entry hides findings in its line, on a line of its
    own those of the next line that is no comment; ``ignore-file`` those of the whole file. CODE may be the beginning
    of codes.
    """

    def __init__(self, settings: Settings, documents: Mapping[Path, Document]) -> None:
        self._settings = settings
        self._documents = {str(path): document for path, document in documents.items()}
        self._inline: dict[str, _Inline] = {}

    def chosen(self, findings: Iterable[Finding]) -> tuple[list[Finding], int]:
        """Return the findings that are told, and how many a list or the settings of its file hide."""
        asked = [finding for finding in (*findings, *self._wrong_ignores()) if self._selected(finding.code)]
        told = [finding for finding in asked if not self._hidden(finding)]
        return told, len(asked) - len(told)

    def tells(self, finding: Finding) -> bool:
        """Tell whether a finding is told."""
        return self._selected(finding.code) and not self._hidden(finding)

    def _selected(self, code: str) -> bool:
        """Tell whether a code is asked for: what names it more closely decides, of two alike the one that ignores."""
        return _closest(code, self._settings.select) > _closest(code, self._settings.ignore)

    def _hidden(self, finding: Finding) -> bool:
        file = relative(finding.file, self._settings.folder)
        for pattern, codes in self._settings.per_file_ignores.items():
            if _closest(finding.code, codes) and (fnmatch(file, pattern) or fnmatch(Path(file).name, pattern)):
                return True
        return self._inline_of(finding.file).hides(finding)

    def _inline_of(self, file: str) -> _Inline:
        if file not in self._inline:
            document = self._documents.get(file)
            self._inline[file] = _Inline(document.text if document is not None and document.is_text else "")
        return self._inline[file]

    def _wrong_ignores(self) -> list[Finding]:
        """Return findings about what lists ask to be ignored without saying what."""
        severity = CODES["AXC-IGNORE"][0]
        return [
            Finding(severity, file, line, "", "AXC-IGNORE", sentence, column)
            for file in self._documents
            for line, column, sentence in self._inline_of(file).wrong
        ]


class _Inline:
    """What one list asks to be ignored."""

    def __init__(self, text: str) -> None:
        self._lines = text.split("\n") if re.search("axcomp:", text, re.I) else []

    @cached_property
    def _asked(self) -> dict[int, set[str]]:
        """Codes by line, 0 for the whole file."""
        asked: dict[int, set[str]] = {}
        waiting: set[str] = set()
        for number, line in enumerate(self._lines, 1):
            here: set[str] = set()
            for found in _INLINE.finditer(line):
                codes = set(re.split(r"[\s,]+", (found[2] or "").upper())) - {""}
                asked.setdefault(0, set()).update(codes) if found[1] else here.update(codes)
            if _ALONE.match(line):
                waiting |= here
            elif line.strip():
                asked.setdefault(number, set()).update(here, waiting)
                waiting = set()
            if here:
                asked.setdefault(number, set()).update(here)
        return asked

    def hides(self, finding: Finding) -> bool:
        """Tell whether the list hides a finding about it."""
        if not self._lines or finding.code == "AXC-IGNORE":
            return False
        codes = self._asked.get(0, set()) | (self._asked.get(finding.line, set()) if finding.line else set())
        return _closest(finding.code, codes) > 0

    @cached_property
    def wrong(self) -> list[tuple[int, int, str]]:
        """Line, column and a sentence for each request that names no code."""
        found = []
        for number, line in enumerate(self._lines, 1):
            for match in _INLINE.finditer(line):
                codes = [code for code in re.split(r"[\s,]+", (match[2] or "").upper()) if code]
                unknown = [code for code in codes if not any(known.startswith(code) for known in CODES)]
                if unknown or not codes:
                    what = f"{', '.join(unknown)} is no code of a finding" if unknown else "No code is named"
                    found.append((number, match.start() + 1, f"{what}: nothing is ignored by that."))
        return found


def _closest(code: str, names: Iterable[str]) -> int:
    """Return how many characters of a code the closest of some names gives, plus 1; 0 if none means it."""
    return max(
        (1 if name == "ALL" else len(name) + 1 for name in names if name == "ALL" or code.startswith(name)), default=0
    )
