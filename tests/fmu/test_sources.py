from __future__ import annotations

import ast
import sys
from pathlib import Path

from axcomp.fmu import PACKAGE, needed_files, renamed_sources
from axcomp.kinds import KINDS
from axcomp.model import fmu_sources

SLAVE = fmu_sources() / "axcomp_slave.py"


def written(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        path = folder.joinpath(*name.split("__")).with_suffix(".py")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def test_the_slave_needs_nothing_but_the_standard_library() -> None:
    for path in needed_files(SLAVE, PACKAGE):
        source = ast.parse(path.read_text(encoding="utf-8"))
        typing = [
            one for one in ast.walk(source) if isinstance(one, ast.If) and ast.unparse(one.test) == "TYPE_CHECKING"
        ]
        for node in set(ast.walk(source)) - {node for one in typing for node in ast.walk(one)}:
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                assert node.level or node.module != "axcomp", path
                names = [] if node.level else [node.module or ""]
            else:
                continue
            assert {name.split(".")[0] for name in names} <= sys.stdlib_module_names, path


def test_what_is_imported_anywhere_comes_along_and_nothing_else(tmp_path: Path) -> None:
    folder = written(
        tmp_path,
        slave="from pack.a.b import x\nimport pack.single\n",
        pack__a__b="from . import sibling\nfrom ..far import thing\ndef f():\n    from ..late import g\n",
        pack__a__sibling="",
        pack__far="from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .only_types import T\n",
        pack__late="",
        pack__single="",
        pack__only_types="",
        pack__unused="",
    )
    (folder / "pack" / "__init__.py").touch()
    (folder / "pack" / "a" / "__init__.py").touch()
    found = [path.relative_to(folder).as_posix() for path in needed_files(folder / "slave.py", folder / "pack")]
    assert found == [
        "pack/__init__.py",
        "pack/a/__init__.py",
        "pack/a/b.py",
        "pack/a/sibling.py",
        "pack/far.py",
        "pack/late.py",
        "pack/single.py",
    ]


def test_modules_that_are_imported_by_a_name_made_while_it_runs_all_come_along(tmp_path: Path) -> None:
    folder = written(
        tmp_path,
        slave="from pack.a.b import x\n",
        pack__a__b='from importlib import import_module\nx = [import_module(f".{n}", __package__) for n in "cd"]\n',
        pack__a__c="from ..far import y\n",
        pack__a__d="",
        pack__far="",
        pack__unused="",
    )
    (folder / "pack" / "__init__.py").touch()
    (folder / "pack" / "a" / "__init__.py").touch()
    found = [
        path.relative_to(folder / "pack").as_posix() for path in needed_files(folder / "slave.py", folder / "pack")
    ]
    assert found == ["__init__.py", "a/__init__.py", "a/b.py", "a/c.py", "a/d.py", "far.py"]


def test_the_slave_has_a_module_of_every_kind_of_compensation() -> None:
    names = {path.relative_to(PACKAGE).as_posix() for path in needed_files(SLAVE, PACKAGE)}
    assert {f"{room}/{name}.py" for room in ("kinds", "kernel") for name in KINDS} <= names


def test_names_change_with_every_byte_of_the_sources(tmp_path: Path) -> None:
    folder = written(tmp_path, slave="from pack.a import x\n# from pack\n", pack____init__="", pack__a="x = 1\n")
    module, files = renamed_sources(folder / "slave.py", folder / "pack")
    suffix = module.removeprefix("slave_")
    assert files[f"{module}.py"] == f"from pack_{suffix}.a import x\n# from pack\n".encode()
    assert files[f"pack_{suffix}/a.py"] == b"x = 1\n"
    (folder / "pack" / "a.py").write_bytes(b"x = 1\r\n")
    assert renamed_sources(folder / "slave.py", folder / "pack")[0] == module
    (folder / "pack" / "a.py").write_bytes(b"x = 2\n")
    assert renamed_sources(folder / "slave.py", folder / "pack")[0] != module
