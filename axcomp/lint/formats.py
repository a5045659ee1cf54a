"""Findings for programs: JSON, SARIF 2.1.0, JUnit, annotations of GitHub, code quality of GitLab."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any
from urllib.parse import quote

from ..kinds import Severity
from ..lists import Finding
from .codes import explained, help_address, pages
from .machines import Checked
from .settings import Settings, relative

VERSION = 1
"""Of the JSON: of ``docs/check.schema.json``."""

_SARIF_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


def written(format_name: str, checked: Sequence[Checked], settings: Settings, version: str) -> str:
    """Return findings in a format for programs; ``version``: of this program."""
    return FORMATS[format_name](checked, settings, version)


def _findings(checked: Sequence[Checked]) -> list[Finding]:
    return [finding for one in checked for finding in one.findings]


def _dumped(value: Any) -> str:
    return f"{json.dumps(value, indent=2, ensure_ascii=False)}\n"


def _json(checked: Sequence[Checked], settings: Settings, version: str) -> str:
    findings = _findings(checked)
    base = settings.help_address
    told = {
        "version": VERSION,
        "program": {"name": "axcomp", "version": version},
        "findings": [
            asdict(one) | {"severity": one.severity.value, "help": help_address(one.code, base)} for one in findings
        ],
        "counts": {severity.value: sum(one.severity is severity for one in findings) for severity in Severity},
        "machines": [_machine(one) for one in checked],
    }
    return _dumped(told)


def _machine(checked: Checked) -> dict[str, Any]:
    return {
        "path": str(checked.path),
        "axes": [
            {
                "number": axis.number,
                "name": axis.name,
                "type": axis.type.name.lower(),
                "compensations": [one.kind for one in axis.compensations],
            }
            for axis in checked.machine.axes
        ],
        "volumetric": [
            {"index": one.index, "chain": one.chain, "axes": dict(one.axes), "errors": len(one.errors)}
            for one in checked.machine.volumetric
        ],
        "judgement": checked.judgement.to_dict(),
        "hidden": checked.hidden,
    }


def _address(file: str) -> str:
    """Return a file as seen from here, as a URI."""
    return quote(relative(file, Path.cwd()))


def _sarif(checked: Sequence[Checked], settings: Settings, version: str) -> str:
    findings = _findings(checked)
    codes = list(pages())
    rules = [
        {
            "id": one.code,
            "shortDescription": {"text": one.meaning},
            "fullDescription": {"text": one.why},
            "help": {"text": f"{one.why} {one.mend}", "markdown": explained(one.code)},
            "helpUri": help_address(one.code, settings.help_address),
            "defaultConfiguration": {"level": _LEVELS[Severity(one.severity)]},
        }
        for one in pages().values()
    ]
    seen: Counter[str] = Counter()
    results = []
    for finding in findings:
        results.append(
            {
                "ruleId": finding.code,
                "ruleIndex": codes.index(finding.code),
                "level": _LEVELS[finding.severity],
                "message": {"text": _said(finding)},
                "locations": [{"physicalLocation": _location(finding)}],
                "partialFingerprints": {"axcomp/v1": _fingerprint(finding, seen)},
            }
        )
    run = {
        "tool": {"driver": {"name": "axcomp", "version": version, "rules": rules}},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {"%SRCROOT%": {"uri": f"{Path.cwd().as_uri()}/"}},
        "results": results,
    }
    return _dumped({"$schema": _SARIF_SCHEMA, "version": "2.1.0", "runs": [run]})


def _location(finding: Finding) -> dict[str, Any]:
    place: dict[str, Any] = {"artifactLocation": {"uri": _address(finding.file), "uriBaseId": "%SRCROOT%"}}
    if finding.line:
        place["region"] = {"startLine": finding.line}
        if finding.column:
            place["region"] |= {"startColumn": finding.column, "endColumn": finding.column + len(finding.parameter)}
    return place


def _said(finding: Finding) -> str:
    """Return the sentence of a finding, with the entry where it does not name it."""
    return str(finding).partition(f" {finding.code}: ")[2]


def _fingerprint(finding: Finding, seen: Counter[str]) -> str:
    """Return what a finding is recognized by when lines have moved: of equal ones each has its own."""
    what = "\0".join((relative(finding.file, Path.cwd()), finding.code, finding.parameter))
    seen[what] += 1
    return hashlib.sha256(f"{what}\0{seen[what]}".encode(errors="surrogateescape")).hexdigest()[:32]


def _junit(checked: Sequence[Checked], settings: Settings, version: str) -> str:
    del version
    failing = [one.value for one in Severity][: [one.value for one in Severity].index(settings.fail_on) + 1]
    suites, total, failed = [], 0, 0
    for one in checked:
        cases = []
        failures = 0
        for finding in one.findings:
            name = _quoted(_plain(f"{finding.file}:{finding.line} {finding.code}"))
            head = f"<testcase name={name} classname={_quoted(_plain(finding.file))}"
            said = _quoted(_plain(_said(finding)))
            if finding.severity.value in failing:
                failures += 1
                cases.append(f"{head}><failure message={said} type={_quoted(finding.code)}/></testcase>")
            else:
                cases.append(f"{head}><system-out>{_escaped(_plain(_said(finding)))}</system-out></testcase>")
        if not cases:
            path = _quoted(_plain(str(one.path)))
            cases.append(f"<testcase name={path} classname={path}/>")
        total, failed = total + len(cases), failed + failures
        suite = _quoted(_plain(str(one.path)))
        counts = f'tests="{len(cases)}" failures="{failures}" errors="0"'
        suites.append(f"<testsuite name={suite} {counts}>{''.join(cases)}</testsuite>")
    head = f'<testsuites name="axcomp" tests="{total}" failures="{failed}" errors="0">'
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{head}\n' + "\n".join(suites) + "\n</testsuites>\n"


def _plain(text: str) -> str:
    """Return a text without what XML cannot hold."""
    return "".join(
        c if c in "\t\n\r" or " " <= c < "\ud800" or "\ue000" <= c < "\ufffe" or c > "\uffff" else "�" for c in text
    )


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _quoted(text: str) -> str:
    """Return a text as the value of an attribute."""
    text = _escaped(text).replace('"', "&quot;").replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")
    return f'"{text}"'


_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}


def _github(checked: Sequence[Checked], settings: Settings, version: str) -> str:
    del settings, version

    def data(text: str) -> str:
        return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")

    def attribute(text: str) -> str:
        return data(text).replace(":", "%3A").replace(",", "%2C")

    lines = []
    for finding in _findings(checked):
        at = {"file": relative(finding.file, Path.cwd()), "line": finding.line, "col": finding.column}
        given = [f"{name}={attribute(str(value))}" for name, value in at.items() if value]
        given.append(f"title={attribute(finding.code)}")
        lines.append(f"::{_COMMANDS[finding.severity]} {','.join(given)}::{data(_said(finding))}\n")
    return "".join(lines)


_QUALITY = {Severity.ERROR: "critical", Severity.WARNING: "minor", Severity.INFO: "info"}


def _gitlab(checked: Sequence[Checked], settings: Settings, version: str) -> str:
    del settings, version
    seen: Counter[str] = Counter()
    rows = [
        {
            "description": _said(finding),
            "check_name": finding.code,
            "fingerprint": _fingerprint(finding, seen),
            "severity": _QUALITY[finding.severity],
            "location": {"path": relative(finding.file, Path.cwd()), "lines": {"begin": max(finding.line, 1)}},
        }
        for finding in _findings(checked)
    ]
    return _dumped(rows)


FORMATS: dict[str, Callable[[Sequence[Checked], Settings, str], str]] = {
    "json": _json,
    "sarif": _sarif,
    "junit": _junit,
    "github": _github,
    "gitlab": _gitlab,
}
"""Formats for programs; people read text."""
