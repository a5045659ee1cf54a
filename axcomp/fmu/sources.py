"""Python sources for an FMU: a slave, and what it needs of a package under a name that no other version has.

FMUs in one process share ``sys.modules``: under the same name the second would silently run the first one's code.
"""

from __future__ import annotations

import ast
import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

LOADS_BY_NAME = b'import_module(f".{'
"""Stands in a module that imports others of its package by names that only the program knows: all are needed."""

Module = tuple[str, ...]
"""Dotted name below the package; () is the package itself."""


def renamed_sources(slave: Path, package: Path) -> tuple[str, dict[str, bytes]]:
    """Return the name of the slave's module, and the files that ``resources`` needs for it: contents by path.

    The slave imports from the package by absolute names; inside it imports are relative. The name carries a hash of the
    slave's own contents and those of the package.
    """
    files = {path.relative_to(package).as_posix(): _text(path) for path in needed_files(slave, package)}
    digest = hashlib.sha256(_text(slave))
    for name in sorted(files):
        digest.update(b"\0".join((name.encode(), files[name], b"")))
    suffix = digest.hexdigest()[:12]
    renamed = f"{package.name}_{suffix}"
    pattern = rf"^(from|import) {package.name}(?=[. ])".encode()
    source = re.sub(pattern, rf"\1 {renamed}".encode(), _text(slave), flags=re.MULTILINE)
    module = f"{slave.stem}_{suffix}"
    return module, {f"{module}.py": source, **{f"{renamed}/{name}": files[name] for name in sorted(files)}}


def _text(path: Path) -> bytes:
    """Return a source with the same line ends on every system."""
    return path.read_bytes().replace(b"\r\n", b"\n")


def needed_files(slave: Path, package: Path) -> list[Path]:
    """Return the modules of the package that a slave imports, directly or not, with their packages; sorted."""
    found: dict[Path, None] = {}
    waiting: list[tuple[Path, Module, bool]] = [(slave, (), False)]
    while waiting:
        path, module, is_package = waiting.pop()
        parent = module if is_package else module[:-1]
        by_name = []
        if LOADS_BY_NAME in path.read_bytes():
            by_name = [(*parent, one.stem) for one in path.parent.glob("*.py") if one.stem != "__main__"]
        for base in (*_imports(path, parent, package.name), *by_name):
            for end in range(len(base) + 1):
                needed = _file_of(package, base[:end])
                if needed is not None and needed not in found:
                    found[needed] = None
                    waiting.append((needed, base[:end], needed.name == "__init__.py"))
    return sorted(found)


def _file_of(package: Path, module: Module) -> Path | None:
    """Return the file of a module; None where the name is something inside a module."""
    stem = package.joinpath(*module)
    for path in (stem / "__init__.py", stem.with_suffix(".py")):
        if path.is_file() and path != package.with_suffix(".py"):
            return path
    return None


def _imports(path: Path, parent: Module, package_name: str) -> Iterator[Module]:
    """Yield what a file imports from the package; ``parent``: the package it is in."""
    for node in _executed(ast.parse(path.read_bytes())):
        if isinstance(node, ast.ImportFrom):
            named = tuple(node.module.split(".")) if node.module else ()
            if node.level:
                base = parent[: len(parent) - node.level + 1] + named
            elif named[0] == package_name:
                base = named[1:]
            else:
                continue
            yield from ((*base, alias.name) for alias in node.names)
        elif isinstance(node, ast.Import):
            for alias in node.names:
                first, *rest = alias.name.split(".")
                if first == package_name:
                    yield tuple(rest)


def _executed(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes below one, leaving out what only type checkers see."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and isinstance(child.test, ast.Name) and child.test.id == "TYPE_CHECKING":
            continue
        yield child
        yield from _executed(child)
