"""``docs/architecture.md`` names the rooms that there are, in the order in which they may import each other."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
ROOMS = re.findall(r"^\| `(\w+)` \| \S", PAGE.split("## Rooms")[1].split("\n## ")[0], re.MULTILINE)


def contract(name: str) -> dict[str, Any]:
    """Return the import contract whose name begins so."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    (found,) = (one for one in settings["contracts"] if one["name"].startswith(name))
    return dict(found)


def test_every_room_is_on_the_page_in_the_order_of_the_contract() -> None:
    assert sorted(ROOMS) == sorted(path.parent.name for path in (ROOT / "axcomp").glob("*/__init__.py"))
    assert contract("Every room knows")["layers"] == ["__main__", *ROOMS]


def test_the_rooms_of_the_standard_library_are_those_of_the_contract() -> None:
    (sentence,) = re.findall(r"^.* need the standard library only", PAGE, re.MULTILINE)
    rooms = {f"axcomp.{room}" for room in re.findall(r"`(\w+)`", sentence)}
    assert rooms == set(contract("Standard library only")["source_modules"])


def test_every_file_on_the_page_is_there() -> None:
    named = set(re.findall(r"`((?:axcomp|fmu_src|docs|tests|models)/[\w/.]+)`", PAGE))
    named |= {f"axcomp/{name}" for name in re.findall(r"`((?:\w+/)+\w+\.py)`", PAGE) if name.split("/")[0] in ROOMS}
    written_there = {f"axcomp/{name}" for name in re.findall(r"^# axcomp/(\S+)$", PAGE, re.MULTILINE)}
    assert len(named) > 25
    missing = {name for name in named - written_there if not (ROOT / name).exists()}
    assert missing == set()


def test_what_the_page_names_stands_in_the_kernel() -> None:
    kernel = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "axcomp" / "kernel").glob("*.py"))
    for name in ("cycle", "accept", "correct_axis", "cross_value", "CrossTable"):
        assert f"`{name}`" in PAGE
        assert re.search(rf"^(def|class) {name}\b", kernel, re.MULTILINE)
