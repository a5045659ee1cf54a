"""``docs/architecture.md`` names the rooms that there are, in the order in which they import each other."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "axcomp"
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROOMS = re.findall(r"^\| `(\w+)` \| \S", PAGE.split("## Rooms")[1].split("\n## ")[0], re.MULTILINE)
APART = "translate"


def imports(path: Path) -> Iterator[tuple[str, str]]:
    """Yield kind (``room`` or ``module``) and name of all that a file imports."""
    folder = path.relative_to(PACKAGE).parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = (*folder[: len(folder) - node.level + 1], *(node.module or "").split("."))
            yield from (("room", name) for name in ([base[0]] if base[0] else [alias.name for alias in node.names]))
        elif isinstance(node, ast.ImportFrom | ast.Import):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module or ""]
            yield from (("module", name.split(".")[0]) for name in names)


def test_every_room_is_on_the_page_once_and_no_other() -> None:
    rooms = sorted(path.parent.name for path in PACKAGE.glob("*/__init__.py"))
    assert sorted(ROOMS) == rooms


def test_a_room_imports_only_those_below_it() -> None:
    for room in ROOMS:
        used = {name for path in (PACKAGE / room).rglob("*.py") for what, name in imports(path) if what == "room"}
        below = ROOMS[ROOMS.index(room) :] if room != APART else [APART, "kernel"]
        assert used & set(ROOMS) <= set(below) - ({APART} - {room}), room


def test_the_rooms_that_travel_in_the_fmu_need_the_standard_library_only() -> None:
    (sentence,) = re.findall(r"^.* need the standard library only", PAGE, re.MULTILINE)
    rooms = re.findall(r"`(\w+)`", sentence)
    assert len(rooms) == 6
    for room in rooms:
        for path in (PACKAGE / room).rglob("*.py"):
            names = {name for what, name in imports(path) if what == "module"}
            assert names <= sys.stdlib_module_names, path


def test_every_file_on_the_page_is_there() -> None:
    named = set(re.findall(r"`((?:axcomp|fmu_src|docs|tests|models)/[\w/.]+)`", PAGE))
    named |= {f"axcomp/{name}" for name in re.findall(r"`((?:\w+/)+\w+\.py)`", PAGE) if name.split("/")[0] in ROOMS}
    written_there = {f"axcomp/{name}" for name in re.findall(r"^# axcomp/(\S+)$", PAGE, re.MULTILINE)}
    assert len(named) > 25
    missing = {name for name in named - written_there if not (ROOT / name).exists()}
    assert missing == set()


def test_functions_on_the_page_stand_in_the_kernel() -> None:
    kernel = "".join(path.read_text(encoding="utf-8") for path in (PACKAGE / "kernel").glob("*.py"))
    named = ("cycle", "accept", "correct_axis", "cross_value", "CrossTable")
    for name in named:
        assert f"`{name}`" in PAGE
        assert re.search(rf"^(def|class) {name}\b", kernel, re.MULTILINE)
