"""Rows of a sweep on disk as they come, so that one that was stopped can go on.

A line each: a checksum, then as JSON the key of the run and its row. The key is made of everything that decides the
row, so a journal never gives a row to a run that has become another one. A line that was cut off or altered is none:
its run is done again.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .spec import ERROR, Run
from .task import Job, Row

SUFFIX = ".journal"
"""Added to the name of the results' file."""

FORMAT = 1
"""To be raised when the same run gives other rows than before."""


def keys_of(job: Job, runs: list[Run]) -> list[str]:
    """Return the key of each run."""
    common = hashlib.sha256(repr(FORMAT).encode())
    common.update(repr((job.cycle_time, job.duration, sorted(job.results.items()))).encode())
    _update(common, job.trajectory)
    digests = []
    for run in runs:
        own = common.copy()
        own.update(job.sources[run.machine].digest.encode())
        own.update(repr([(setting.key, value) for setting, value in run.values.items()]).encode())
        digests.append(own.hexdigest())
    return digests


def _update(digest: Any, value: Any) -> None:
    if dataclasses.is_dataclass(value):
        for item in dataclasses.fields(value):
            _update(digest, getattr(value, item.name))
    elif isinstance(value, Mapping):
        for name, element in value.items():
            digest.update(f"\0{name}\0".encode())
            _update(digest, element)
    elif isinstance(value, np.ndarray):
        digest.update(value.tobytes())
    else:
        digest.update(repr(value).encode())


def _check(written: bytes) -> bytes:
    return hashlib.sha256(written).hexdigest()[:16].encode()


class Journal:
    """The rows so far, in a file that is made when the first one comes."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file: Any = None

    def rows(self, *, failed: bool = True) -> dict[str, Row]:
        """Return the rows by key; ``failed``: those with an error too."""
        found: dict[str, Row] = {}
        try:
            lines = self.path.read_bytes().split(b"\n")
        except FileNotFoundError:
            return found
        for line in lines:
            check, _, written = line.partition(b" ")
            if check == _check(written):
                key, row = json.loads(written)
                if failed or not row[ERROR]:
                    found[key] = row
        return found

    def add(self, key: str, row: Row) -> None:
        """Write a row; it is on disk when this returns."""
        if self._file is None:
            # What was cut off must not spoil the line that follows it.
            cut = self.path.exists() and not self.path.read_bytes().endswith(b"\n")
            self._file = self.path.open("ab")
            self._file.write(b"\n" if cut else b"")
        written = json.dumps([key, row]).encode()
        self._file.write(_check(written) + b" " + written + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def remove(self) -> None:
        """Delete the file: the results are complete."""
        self.close()
        self.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
