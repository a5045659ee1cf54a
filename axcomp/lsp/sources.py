"""The lists that editors hold and those on the disk, grouped into machines, read again where something has changed."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from ..kinds import ListKind, Severity
from ..lint import Checked, Selection, Settings, SettingsError, check_machine, find_settings
from ..lists import START_UP_NAME, Document, Finding, Reading, is_project, kind_of, read_machine
from .text import Text

_ABOVE = 3
"""Folders above a list in which its start-up list is looked for."""


class Sources:
    """All lists that are known, by their path."""

    def __init__(self) -> None:
        self.open: dict[Path, Text] = {}
        self._documents: dict[Path, Document] = {}
        self._machine_of: dict[Path, Path] = {}
        self.readings: dict[Path, Reading] = {}

    def hold(self, path: Path, text: Text) -> None:
        """Take in what an editor holds of a file."""
        self.open[path] = text
        before = self._documents.get(path)
        if before is None or before.kind is ListKind.START_UP:
            # What belongs together may have changed.
            self._machine_of.clear()
            self.readings.clear()
        self._documents[path] = Document(path, text.source.encode("utf-8", "replace"), before.kind if before else None)

    def close(self, path: Path) -> None:
        """Forget what an editor held: from now on the file on the disk counts."""
        self.open.pop(path, None)
        self.forget(path)

    def forget(self, path: Path) -> None:
        """Read a file anew the next time, unless an editor holds it."""
        if path not in self.open:
            self._documents.pop(path, None)
        self._machine_of.clear()
        self.readings.clear()

    def settings(self, path: Path) -> Settings:
        """Return the settings for a machine; those that are wrong do not count here: the command tells."""
        try:
            return find_settings(path)
        except SettingsError:
            return Settings()

    def document(self, path: Path) -> Document | None:
        """Return a list as it stands in its machine, with its kind."""
        reading = self.reading(self.machine_of(path))
        return next((one for found, one in reading.documents.items() if _normal(found) == path), None)

    def machine_of(self, path: Path) -> Path:
        """Return the path of the machine that a list belongs to, else of the list itself."""
        if path not in self._machine_of:
            machine = self._find(path)
            self._machine_of[path] = machine
            self._machine_of.update((_normal(one), machine) for one in self.reading(machine).documents)
            self._machine_of[path] = machine
        return self._machine_of[path]

    def _find(self, path: Path) -> Path:
        if self._kind(path) is ListKind.START_UP or is_project(path):
            return path
        folders = [path.parent, *path.parent.parents][:_ABOVE]
        for folder in folders:
            for start in self._start_ups(folder):
                if any(_normal(one) == path for one in self.reading(start).documents):
                    return start
        by_name = kind_of(path.name, "")
        if by_name in (ListKind.AXIS, ListKind.COMPENSATION) and not self._start_ups(path.parent):
            return path.parent
        return path

    def _start_ups(self, folder: Path) -> list[Path]:
        try:
            files = [one for one in folder.iterdir() if one.suffix.lower() == ".lis"]
        except OSError:
            files = []
        files += [one for one in self.open if one.parent == folder and one not in files]
        named = [one for one in files if one.name.lower() == START_UP_NAME]
        others = [one for one in self.open if one.parent == folder and one not in named]
        return named + [one for one in others if self._kind(one) is ListKind.START_UP]

    def _kind(self, path: Path) -> ListKind | None:
        document = self._documents.get(path)
        if document is None:
            return ListKind.START_UP if path.name.lower() == START_UP_NAME else None
        return kind_of(path.name, document.text) if document.is_text else None

    def reading(self, machine: Path, again: bool = False) -> Reading:
        """Return a machine as it is now; only lists that have changed are parsed again."""
        if again or machine not in self.readings:
            documents = self._documents.values()
            axis_type = self.settings(machine).axis_type
            reading = read_machine(machine, documents=documents, beside_disk=True, axis_type=axis_type)
            self.readings[machine] = reading
            for path, one in reading.documents.items():
                if one.outer is None:
                    self._documents[_normal(path)] = one
        return self.readings[machine]

    def checked(self, machine: Path) -> Checked:
        """Return all there is to say about a machine, tables judged too."""
        return check_machine(machine, self.settings(machine), reading=self.reading(machine))

    def told(self, machine: Path) -> list[Finding]:
        """Return what the lists of a machine say without a look at its tables: that is quick."""
        reading = self.reading(machine)
        return Selection(self.settings(machine), reading.documents).chosen(reading.findings)[0]

    def files(self, machine: Path) -> set[Path]:
        """Return the files of a machine."""
        return {_normal(path) for path, one in self.reading(machine).documents.items() if one.outer is None}


def by_file(findings: Iterable[Finding]) -> dict[Path, list[Finding]]:
    """Return findings by the files they are about, the gravest first."""
    found: dict[Path, list[Finding]] = {}
    order = list(Severity)
    for finding in sorted(findings, key=lambda one: order.index(one.severity)):
        found.setdefault(_normal(Path(finding.file)), []).append(finding)
    return found


def _normal(path: Path) -> Path:
    return Path(os.path.normpath(path))
