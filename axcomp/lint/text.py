"""Findings as text: one a line in a file or a pipe, in colour and as wide as the window on a terminal."""

from __future__ import annotations

import os
import shutil
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TextIO

from ..kinds import Severity
from ..lists import CODES, Finding
from .machines import Checked

_COLOURS = {Severity.ERROR: "31", Severity.WARNING: "33", Severity.INFO: "36"}
_FILES_MAX = 2
"""Files up to which an info that many of them have is told for each."""


class Style(NamedTuple):
    """How text is written.

    Attributes
    ----------
    colour : bool
    width : int
        Columns; 0: a finding is a line, however long.
    """

    colour: bool = False
    width: int = 0

    @classmethod
    def of(cls, stream: TextIO, environment: Mapping[str, str] = os.environ) -> Style:
        """Return the style for a stream; ``NO_COLOR`` and ``FORCE_COLOR`` are followed if they are not empty."""
        terminal = stream.isatty()
        wanted = bool(environment.get("FORCE_COLOR")) or (terminal and environment.get("TERM") != "dumb")
        width = shutil.get_terminal_size((80, 24)).columns if terminal else 0
        return cls(wanted and not environment.get("NO_COLOR"), width)

    def painted(self, text: str, colour: str) -> str:
        """Return a text in a colour."""
        return f"\033[{colour}m{text}\033[0m" if self.colour and text else text


def as_text(checked: Sequence[Checked], style: Style, notes: Sequence[str] = (), quiet: bool = False) -> str:
    """Return findings as text.

    Parameters
    ----------
    checked : sequence of Checked
        Their findings are what is told.
    style : Style
        Colour and width.
    notes : sequence of str
        What stands behind the counts: what was hidden, mended.
    quiet : bool
        Without the counts; nothing where nothing was found.
    """
    findings = [finding for one in checked for finding in one.findings]
    lines = list(_lines(findings, style))
    if not quiet:
        lines += _wrapped(_summary(checked, findings, notes), style)
    return "".join(f"{line}\n" for line in lines)


def _lines(findings: Sequence[Finding], style: Style) -> Iterator[str]:
    files: dict[str, set[str]] = {}
    for finding in findings:
        if finding.severity is Severity.INFO:
            files.setdefault(finding.code, set()).add(finding.file)
    many = {code for code, named in files.items() if len(named) > _FILES_MAX}
    for finding in findings:
        if finding.severity is not Severity.INFO or finding.code not in many:
            yield from _finding(finding, style)
    for code in sorted(many):
        told = f"info {code}: In {len(files[code])} files: {CODES[code][1]}."
        yield from _wrapped(told, style, (("info", _COLOURS[Severity.INFO]),))


def _finding(finding: Finding, style: Style) -> Iterator[str]:
    line = f"{finding.file}:" + (
        f"{finding.line}:" + (f"{finding.column}:" if finding.column else "") if finding.line else ""
    )
    place, _, said = str(finding).partition(f": {finding.severity.value} {finding.code}: ")
    del place
    severity = finding.severity.value
    text = f"{line} {severity} {finding.code}: {said}"
    return _wrapped(text, style, ((line, "1"), (f"{severity} {finding.code}", _COLOURS[finding.severity])))


def _wrapped(text: str, style: Style, colours: Sequence[tuple[str, str]] = ()) -> Iterator[str]:
    lines = [text]
    if style.width:
        lines = textwrap.wrap(text, max(style.width, 20), subsequent_indent="    ", break_on_hyphens=False) or [""]
    for line in lines:
        painted = line
        for word, colour in colours:
            painted = painted.replace(word, style.painted(word, colour), 1)
        yield painted


def _summary(checked: Sequence[Checked], findings: Sequence[Finding], notes: Sequence[str]) -> str:
    machines = [one.machine for one in checked]
    counts = [counted(sum(one.severity is severity for one in findings), severity.value) for severity in Severity]
    axes = [axis for machine in machines for axis in machine.axes]
    volumetric = sum(len(machine.volumetric) for machine in machines)
    compensations = counted(sum(len(axis.compensations) for axis in axes), "compensation")
    of_axes = f"{counted(len(axes), 'axis')} with {compensations}"
    more = f" and {counted(volumetric, 'volumetric compensation')}" if volumetric else ""
    several = f"{counted(len(checked), 'machine')}, " if len(checked) > 1 else ""
    return f"{', '.join([*counts, *notes])}; {several}{of_axes}{more}."


def counted(count: int, noun: str) -> str:
    """Return a count with its noun: ``2 axes``."""
    plural = {"axis": "axes", "info": "infos"}.get(noun, f"{noun}s")
    return f"{count} {noun if count == 1 else plural}"
