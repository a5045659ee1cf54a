"""Lists given as texts, read as a machine."""

from collections.abc import Callable
from pathlib import Path

import pytest

from axcomp.lists import Reading, read_machine

ReadLists = Callable[..., Reading]


@pytest.fixture
def read_lists(tmp_path: Path) -> ReadLists:
    """Return a function that writes files (name → text or bytes) and reads the folder, or the file ``path`` in it."""

    def read(files: dict[str, str | bytes], path: str = "") -> Reading:
        for name, content in files.items():
            target = tmp_path / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content.encode() if isinstance(content, str) else content)
        return read_machine(tmp_path / path)

    return read


@pytest.fixture
def read_list(read_lists: ReadLists) -> Callable[[str], Reading]:
    """Return a function that reads one compensation list on its own."""

    def read(text: str) -> Reading:
        return read_lists({"achskw.lis": text}, "achskw.lis")

    return read
