"""The command ``python -m axcomp.translate``: write the kernel's C, or check that what is written is up to date."""

from __future__ import annotations

import argparse
import ast
import sys
from pathlib import Path

from ..saving import write_whole
from .emit import translate
from .subset import TranslationError

_PACKAGE = Path(__file__).resolve().parent.parent


def main(arguments: list[str] | None = None) -> int:
    """Translate, and return the exit status: 0 done, 1 refused or out of date."""
    parser = argparse.ArgumentParser(
        prog="python -m axcomp.translate",
        description="Translate the kernel to C99: kernel.c and kernel.h.",
        epilog="example: python -m axcomp.translate --check",
    )
    parser.add_argument("--kernel", type=Path, default=_PACKAGE / "kernel", help="folder with the modules")
    parser.add_argument("--output", type=Path, default=_PACKAGE.parent / "fmu_src" / "native", help="folder for the C")
    parser.add_argument("--check", action="store_true", help="write nothing, but fail if the C is out of date")
    options = parser.parse_args(arguments)
    exports = _exports_of(options.kernel)
    if not exports:
        print(f"{_shortest(options.kernel)}/__init__.py names no EXPORTS: nothing to translate for", file=sys.stderr)
        return 1
    try:
        translation = translate(_shortest(options.kernel), exports)
    except TranslationError as error:
        print(error, file=sys.stderr)
        return 1
    files = {options.output / "kernel.h": translation.header, options.output / "kernel.c": translation.source}
    if options.check:
        stale = [path for path, text in files.items() if not path.is_file() or path.read_text("utf-8") != text]
        for path in stale:
            text = f"{_shortest(path)} is not what the kernel translates to: run python -m axcomp.translate"
            print(text, file=sys.stderr)
        return 1 if stale else 0
    if not options.output.is_dir():
        print(f"{options.output} is no folder: name one with --output", file=sys.stderr)
        return 1
    for path, text in files.items():
        write_whole(path, text)
        print(f"wrote {_shortest(path)}")
    return 0


def _exports_of(kernel: Path) -> tuple[str, ...]:
    """Return what the package names as EXPORTS: the functions that C calls."""
    for node in ast.parse((kernel / "__init__.py").read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "EXPORTS":
            return tuple(ast.literal_eval(node.value))
    return ()


def _shortest(path: Path) -> Path:
    """Return a path relative to the working folder where it lies below it."""
    full = path.resolve()
    return full.relative_to(Path.cwd()) if full.is_relative_to(Path.cwd()) else full
