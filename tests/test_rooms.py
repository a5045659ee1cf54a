"""The rooms of the design: who may import whom, and how large a module and a function may be."""

from __future__ import annotations

import ast
import importlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MODULE_LINES = 400
FUNCTION_LINES = 80


def sources() -> Iterator[Path]:
    for folder in ("axcomp", "fmu_src"):
        yield from sorted((ROOT / folder).rglob("*.py"))


def test_every_import_points_down() -> None:
    """The contracts stand in pyproject.toml: rooms, standard library, plant."""
    code = "import sys; from importlinter.cli import lint_imports_command; lint_imports_command(['--no-cache'])"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 broken" in done.stdout


def test_no_module_is_too_long() -> None:
    long = {
        str(path.relative_to(ROOT)): n for path in sources() if (n := len(path.read_text().splitlines())) > MODULE_LINES
    }
    assert long == {}


def test_no_function_is_too_long() -> None:
    long = {}
    for path in sources():
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef):
                lines = (node.end_lineno or 0) - node.lineno + 1
                if lines > FUNCTION_LINES:
                    long[f"{path.relative_to(ROOT)}:{node.name}"] = lines
    assert long == {}


@pytest.mark.parametrize("arguments", [["--help"], ["chek"], ["check", "SMALL"]])
def test_what_is_quick_loads_no_numerics(arguments: list[str], tmp_path: Path) -> None:
    """Help, a typo and a small machine need neither NumPy nor what is built on it."""
    (tmp_path / "achskw1.lis").write_text("kopf.achs_nr 1\nfrict_comp.mode 3\nfrict_comp.table_entries 1\n")
    given = [str(tmp_path) if word == "SMALL" else word for word in arguments]
    program = (
        "import sys\nfrom axcomp.cli import main\n"
        f"try:\n    main({given!r})\nexcept SystemExit:\n    pass\n"
        "print(*{name.split('.')[0] for name in sys.modules}, file=sys.stderr)"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True)
    loaded = set(done.stderr.splitlines()[-1].split())
    assert "axcomp" in loaded
    assert not loaded & {"numpy", "scipy", "matplotlib", "pandas", "rich"}


ROOMS = tuple(
    ".".join(path.parent.relative_to(ROOT).parts)
    for path in (ROOT / "axcomp").rglob("__init__.py")
    if path.parent.name not in {"axcomp", "cli", "analysis"}
)
"""Every package with a face; commands are loaded by name, and analyses are rooms of their own."""
ABOVE_ROOMS = {"axcomp.model.face"}
"""What makes the faces stands behind none of them."""


def imports(path: Path) -> Iterator[tuple[str, str]]:
    """Yield module and name of what a file takes from the package, in absolute names."""
    package = path.parent.relative_to(ROOT).parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            module = node.module or ""
            if node.level:
                module = ".".join((*package[: len(package) - node.level + 1], *filter(None, [module])))
            if module.startswith("axcomp."):
                yield from ((module, alias.name) for alias in node.names)


def room_of(module: str) -> str:
    return max((room for room in ROOMS if f"{module}.".startswith(f"{room}.")), key=len, default="")


@pytest.mark.parametrize("folder", ["axcomp", "tests"])
def test_rooms_and_tests_import_faces_and_not_the_modules_inside(folder: str) -> None:
    inside = []
    for path in sorted((ROOT / folder).rglob("*.py")):
        own = room_of(".".join(path.relative_to(ROOT).with_suffix("").parts))
        for module, name in imports(path):
            room = room_of(module)
            if room not in ("", own, module) and module not in ABOVE_ROOMS and not name.startswith("_"):
                inside.append(f"{path.relative_to(ROOT)}: {module} {name}")
    assert inside == []


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_has_a_face_and_what_it_offers_is_there(room: str) -> None:
    face = importlib.import_module(room)
    assert face.__doc__
    assert len(set(face.__all__)) == len(face.__all__) > 0
    assert [name for name in face.__all__ if getattr(face, name, None) is None] == []
