"""Findings that are known: a project that begins to be checked goes on with what is new."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from ..lists import Finding
from ..saving import write_whole
from .settings import SettingsError, relative

_VERSION = 1
_Key = tuple[str, str, str]
"""File, code and entry: lines move."""


class Baseline:
    """How often each finding is known, file by file as seen from the folder of the baseline."""

    def __init__(self, path: Path, known: Counter[_Key] | None = None) -> None:
        self.path = path
        self._known: Counter[_Key] = known or Counter()

    @classmethod
    def read(cls, path: Path) -> Baseline:
        """Read a file; SettingsError if it is none."""
        try:
            told = json.loads(path.read_text(encoding="utf-8"))
            if told["version"] != _VERSION:
                raise SettingsError(
                    f"{path}: the baseline has version {told['version']}, this program reads {_VERSION}"
                )
            rows = [
                (str(one["file"]), str(one["code"]), str(one["parameter"]), int(one["count"]))
                for one in told["findings"]
            ]
        except OSError as error:
            raise SettingsError(f"{path}: the baseline cannot be read: {error.strerror or error}") from None
        except (KeyError, TypeError, ValueError) as error:
            if isinstance(error, SettingsError):
                raise
            raise SettingsError(f"{path}: this is no baseline; --write-baseline writes one") from None
        return cls(path, Counter({(file, code, parameter): count for file, code, parameter, count in rows}))

    def new(self, findings: Iterable[Finding]) -> tuple[list[Finding], int]:
        """Return the findings that are not known, and how many are."""
        left = self._known.copy()
        told, known = [], 0
        for finding in findings:
            key = self._key(finding)
            if left[key] > 0:
                left[key] -= 1
                known += 1
            else:
                told.append(finding)
        return told, known

    def write(self, findings: Iterable[Finding]) -> int:
        """Write the findings as known ones, and return how many they are; OSError if that fails."""
        self._known = Counter(map(self._key, findings))
        rows = [
            {"file": file, "code": code, "parameter": parameter, "count": count}
            for (file, code, parameter), count in sorted(self._known.items())
        ]
        text = json.dumps({"version": _VERSION, "findings": rows}, indent=1, ensure_ascii=False)
        write_whole(self.path, f"{text}\n")
        return self._known.total()

    def _key(self, finding: Finding) -> _Key:
        return relative(finding.file, self.path.parent), finding.code, finding.parameter
