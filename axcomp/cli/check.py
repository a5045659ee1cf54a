"""``axcomp check``: what is to be said about machines, for people and for programs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from difflib import unified_diff
from pathlib import Path
from typing import Any

from ..analysis.judgement import Evidence
from ..lint import (
    FORMATS,
    Baseline,
    Checked,
    Settings,
    SettingsError,
    Style,
    as_text,
    check_machine,
    explained,
    find_machines,
    find_settings,
    fixed,
    written,
)
from ..lists import Document, Finding, Reading, Severity
from ..model import machine_path
from .judgement_options import add_judgement_options, evidence_of
from .reading_options import add_reading_options

_EXAMPLE = """\
The exit status is 0 if there is no finding of the severity --fail-on or above, 1 if there is one, 2 if the lists could
not be checked. Settings stand in [tool.axcomp] of a pyproject.toml, or in an axcomp.toml, upwards of the first PATH.
In a list, "# axcomp: ignore CODE" behind an entry hides findings about it. All codes: docs/findings.md, or --explain.

Tables that can be read are judged too: outliers, seams of round axes, volumetric corrections against s_limit; by a
measurement taken without the compensation the sign, by a feed what a table asks of the drives, by an input file whether
the tables hold all positions in use. These findings are warnings and infos.

example:
  axcomp check models/three_axis
  axcomp check lists --select AXC,70 --ignore AXC-OTHERS --fail-on warning
  axcomp check lists --format sarif > axcomp.sarif
  axcomp check lists --diff
  axcomp check models/three_axis --measurement x.rtl --axis X
  axcomp check models/three_axis --feed 30000 --feed Z=10000 --max-acceleration 5m/s2
"""
FAILED = 2
"""Exit status where nothing could be checked."""


def add_subparser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "check",
        description="Read the lists of machines and print what was found, one finding a line: "
        "file:line:column: severity code: sentence.",
        epilog=_EXAMPLE,
    )
    parser.add_argument(
        "paths",
        type=machine_path,
        nargs="*",
        metavar="PATH",
        help="a start-up list, any other list on its own, a TwinCAT project, a folder that is searched for machines, "
        "or - for a list from standard input (default: the current folder)",
    )
    parser.add_argument("--stdin-filename", type=Path, metavar="FILE", help="what - is called, and lies beside")
    parser.add_argument("--format", choices=("text", *FORMATS), help="what to print (default: text)")
    parser.add_argument("-q", "--quiet", action="store_true", help="print findings only, no counts")
    parser.add_argument(
        "--explain", metavar="CODE", help="print what a code means and how it is mended, and nothing else"
    )
    group = parser.add_argument_group("which findings")
    group.add_argument("--select", type=_codes, metavar="CODES", help="these codes, or what begins so; ALL: every one")
    group.add_argument("--ignore", type=_codes, default=(), metavar="CODES", help="not these")
    group.add_argument("--baseline", type=Path, metavar="FILE", help="not those that are known")
    group.add_argument("--write-baseline", type=Path, metavar="FILE", help="make all findings known ones")
    group.add_argument(
        "--fail-on",
        choices=[one.value for one in Severity],
        help="severity from which on the status is 1 (default: error)",
    )
    group.add_argument("--exit-zero", action="store_true", help="exit with 0 whatever was found")
    group = parser.add_argument_group("mending")
    either = group.add_mutually_exclusive_group()
    either.add_argument("--fix", action="store_true", help="mend what can be mended without a decision")
    either.add_argument("--diff", action="store_true", help="print what --fix would change, and nothing else")
    add_judgement_options(parser)
    add_reading_options(parser)
    parser.set_defaults(do=_do_check)


def _codes(text: str) -> tuple[str, ...]:
    return tuple(code.strip() for code in text.split(","))


def _do_check(options: argparse.Namespace) -> int:
    try:
        return _explain(options.explain) if options.explain else _check(options)
    except (SettingsError, ValueError, OSError) as error:
        place = f"{error.filename}: " if isinstance(error, OSError) and error.filename else ""
        reason = error.strerror if isinstance(error, OSError) and error.strerror else error
        return _failed(f"{place}{reason}")


def _failed(sentence: str) -> int:
    print(f"axcomp check: {sentence}", file=sys.stderr)
    return FAILED


def _explain(code: str) -> int:
    try:
        print(explained(code.upper()))
    except KeyError:
        return _failed(f"there is no code {code}")
    return 0


def _check(options: argparse.Namespace) -> int:
    paths = options.paths or [Path()]
    name = options.stdin_filename or Path("-")
    settings = _settings(options, name if str(paths[0]) == "-" else paths[0])
    documents = [Document(name, sys.stdin.buffer.read())] if Path("-") in paths else None
    asked = (name if str(path) == "-" else path for path in paths)
    machines = list(find_machines(asked, settings, options.axis_type))
    if options.fix or options.diff:
        if documents is not None:
            return _failed("a list from standard input cannot be mended in its place")
        fixes = sum(_mend(path, settings, options) for path, _ in machines)
        if options.diff:
            return int(fixes > 0 and not options.exit_zero)
    if options.fix:
        machines = [(path, None) for path, _ in machines]
    checked, faults = _checked(machines, settings, options, documents)
    notes = [f"{fixes} mended"] if options.fix else []
    if hidden := sum(one.hidden for one in checked):
        notes.append(f"{hidden} hidden")
    findings = [finding for one in checked for finding in one.findings]
    if options.write_baseline is not None:
        known = Baseline(options.write_baseline).write(findings)
        print(f"{options.write_baseline}: {known} findings are known now.")
        return 0
    if settings.baseline:
        checked, known = _new(checked, Baseline.read(settings.folder / settings.baseline))
        notes += [f"{known} known"] if known else []
        findings = [finding for one in checked for finding in one.findings]
    if settings.format in ("", "text"):
        print(as_text(checked, Style.of(sys.stdout), notes, options.quiet), end="")
    else:
        from .. import __version__

        print(written(settings.format, checked, settings, __version__), end="")
    for fault in faults:
        print(f"axcomp check: {fault}", file=sys.stderr)
    if faults:
        return FAILED
    return int(_fails(findings, settings.fail_on) and not options.exit_zero)


def _settings(options: argparse.Namespace, path: Path) -> Settings:
    """Return the settings of the file that is found, as the options change them."""
    settings = find_settings(path)
    given: dict[str, Any] = {
        name: getattr(options, name) for name in ("select", "fail_on", "format") if getattr(options, name)
    }
    if options.baseline is not None:
        given["baseline"] = str(options.baseline.absolute())
    folder = settings.folder if settings.folder != Path() else Path.cwd()
    ignore, allowed = (*settings.ignore, *options.ignore), tuple(options.allow_outside)
    return replace(settings, **given, folder=folder, ignore=ignore, allow_outside=allowed)


def _checked(
    machines: Sequence[tuple[Path, Reading | None]],
    settings: Settings,
    options: argparse.Namespace,
    documents: Sequence[Document] | None,
) -> tuple[list[Checked], list[str]]:
    """Return what there is to say about each machine, and a sentence for each option that cannot be followed."""
    checked: list[Checked] = []
    faults: list[str] = []
    for path, reading in machines:
        one = check_machine(path, settings, documents=documents, axis_type=options.axis_type, reading=reading)
        evidence = evidence_of(options, one.machine)
        faults += evidence.faults
        if evidence != Evidence(faults=evidence.faults, tool_length=0.0):
            one = check_machine(path, settings, reading=one.reading, evidence=evidence)
        checked.append(one)
    return checked, list(dict.fromkeys(faults))


def _new(checked: Sequence[Checked], baseline: Baseline) -> tuple[list[Checked], int]:
    """Return what is left of the findings without those that are known, and how many these are."""
    new, known = baseline.new(finding for one in checked for finding in one.findings)
    left = {id(finding) for finding in new}
    return [replace(one, findings=tuple(f for f in one.findings if id(f) in left)) for one in checked], known


def _fails(findings: Sequence[Finding], fail_on: str) -> bool:
    order = [severity.value for severity in Severity]
    return any(order.index(finding.severity.value) <= order.index(fail_on) for finding in findings)


def _mend(path: Path, settings: Settings, options: argparse.Namespace) -> int:
    """Mend the lists of a machine, or print how they would change; return how many findings that concerns."""
    reading, count = fixed(path, settings, options.axis_type or settings.axis_type)
    for document in reading.documents.values():
        if options.diff:
            print("".join(difference(document)), end="")
        elif document.changed:
            document.save()
    return count


def difference(document: Document) -> Iterator[str]:
    """Yield the lines of a unified diff from a list as it was read to what it is now."""
    if document.changed:
        before = Document(document.path, document.data).text.splitlines(keepends=True)
        after = document.text.splitlines(keepends=True)
        for line in unified_diff(before, after, str(document.path), str(document.path)):
            yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
