"""What the reader has to say about a list: severity, place, parameter, code and one sentence."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from dataclasses import dataclass


class Severity(enum.Enum):
    """How much a finding matters; the order of the members is the order of the matter."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True)
class Finding:
    """One thing the reader noticed.

    Attributes
    ----------
    severity : Severity
        ERROR where something the list asks for does not act; WARNING where it acts otherwise than written.
    file : str
        The file as it was named, "" where no file is meant.
    line : int
        Counted from 1; 0 where the whole file is meant.
    parameter : str
        The entry as it stands in the list, e.g. ``kw.ssfk.table[3].pos``; "" where none is meant.
    code : str
        The vendor's number where the vendor documents one, else ``AXC-…`` (see ``CODES``).
    message : str
        One sentence: what was wrong, and what is used instead.
    """

    severity: Severity
    file: str
    line: int
    parameter: str
    code: str
    message: str

    def __str__(self) -> str:
        """``file:line: severity code: sentence``, as compilers write it."""
        return f"{self.file}:{self.line}: {self.severity.value} {self.code}: {self.message}"


class ListError(Exception):
    """Raised in strict mode: all findings of severity error, one a line."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(findings)
        super().__init__("\n".join(str(finding) for finding in self.findings))
