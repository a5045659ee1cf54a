"""Nothing is lost: what changes in files is shown, the old ones are kept, those of other lists are not touched."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from difflib import unified_diff
from pathlib import Path

from ..lists import decode, entries
from ..saving import write_whole

_BACKUP = ".bak"
_SIZE_MAX = 2_000_000


def changes(files: Mapping[Path, bytes]) -> list[str]:
    """Return what would change in files, line by line, as a unified diff."""
    lines: list[str] = []
    for path, data in files.items():
        before = path.read_bytes() if path.is_file() else b""
        old, new = ((decode(one) or "").splitlines() for one in (before, data))
        name = "/dev/null" if not path.exists() else str(path)
        lines += unified_diff(old, new, name, str(path), n=1, lineterm="")
    return lines


def backed_up(path: Path, data: bytes, before: bytes | None = None) -> Path | None:
    """Keep a copy of a file that is about to change, beside it; return where, None if nothing would be lost.

    ``before``: what it holds, where that is known.
    """
    if not path.is_file():
        return None
    before = path.read_bytes() if before is None else before
    if before == data:
        return None
    number = 1
    while (copy := path.with_name(f"{path.name}{_BACKUP}{'' if number == 1 else number}")).exists():
        if copy.read_bytes() == before:
            return copy
        number += 1
    write_whole(copy, before)
    return copy


def owners(path: Path, but: Sequence[Path] = (), read: Callable[[Path], bytes] = Path.read_bytes) -> list[Path]:
    """Return the lists beside a file that name it, besides those given."""
    if not path.exists():
        return []
    wanted, known = path.resolve(), {one.resolve() for one in but}
    found = []
    for beside in sorted(path.parent.glob("*")):
        if beside.suffix.lower() != ".lis" or not beside.is_file() or beside.resolve() in known | {wanted}:
            continue
        text = decode(read(beside)) if beside.stat().st_size < _SIZE_MAX else None
        if text is None or path.stem.casefold() not in text.casefold():
            continue
        names = {entry.word.replace("\\", "/").strip('"') for entry in entries(text, lambda *_: None)}
        if any(_is(path, name, wanted) for name in names if name):
            found.append(beside)
    return found


def _is(path: Path, name: str, wanted: Path) -> bool:
    """Tell whether a list beside a file means it by a name, whatever its case."""
    try:
        named = (path.parent / name).resolve()
    except (OSError, ValueError):
        return False
    return str(named).casefold() == str(wanted).casefold()
