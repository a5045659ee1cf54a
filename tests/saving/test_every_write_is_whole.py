"""Every file that axcomp writes is written whole or not at all, by one helper."""

from __future__ import annotations

import ast
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from axcomp.cli import main
from axcomp.model import models
from axcomp.saving import write_all, write_whole

ROOT = Path(__file__).parents[2]

WRITERS = {
    "write_text", "write_bytes", "savefig", "to_csv", "to_excel", "to_parquet", "to_pickle", "to_hdf",
    "savetxt", "savez", "tofile", "copyfile", "copy2", "copytree", "truncate", "mkstemp", "NamedTemporaryFile",
    "print_png", "touch", "symlink_to", "hardlink_to", "extractall",
}  # fmt: skip
"""Calls that write files by themselves."""

KNOWN = {
    # the helper itself
    "axcomp/saving/saving.py: target.write_bytes(data)",
    "axcomp/saving/saving.py: unfinished.open('xb')",
    # lines are added, each with its checksum
    "axcomp/sweep/journal.py: self.path.open('ab')",
    # into memory
    "axcomp/plot/style.py: figure.savefig(stream, format=form)",
    "axcomp/plot/style.py: figure.savefig(stream, format='svg', metadata={'Date': None, 'Creator': None})",
    "axcomp/plot/style.py: few.save(stream, 'PNG', compress_level=6)",
    "axcomp/fmu/archive.py: zipfile.ZipFile(packed, 'w', zipfile.ZIP_DEFLATED, compresslevel=LEVEL)",
    "axcomp/sweep/sweep.py: self.table.to_csv(index=False, lineterminator='\\n')",
    "axcomp/sweep/sweep.py: self.table.to_parquet(index=False, engine='pyarrow')",
    "axcomp/analysis/diagnosis/workbook.py: book.save(written)",
    # through the helper
    "axcomp/cli/run.py: result.to_csv(args.output)",
    "axcomp/sweep/sweep.py: sweep.save(output)",
    # what a child says, in a folder that goes when it has ended
    "axcomp/demo/run.py: (own / 'messages.txt').open('wb')",
    "axcomp/demo/coupling.py: (folder / DONE).open('a', encoding='ascii')",
    # the package of npm, in a temporary folder
    "axcomp/browser/site.py: archive.extractall(folder, filter='data')",
    # descriptors, not files
    "axcomp/lsp/server.py: os.fdopen(os.dup(sys.stdout.fileno()), 'wb')",
    "axcomp/lists/files.py: os.open(path, _TO_READ)",
    "axcomp/cli/__init__.py: os.open(os.devnull, os.O_WRONLY)",
}


def writes(path: Path) -> Iterator[str]:
    """Yield the calls in a module that may write a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        owner = ast.unparse(node.func.value) if isinstance(node.func, ast.Attribute) else ""
        words = [arg.value for arg in [*node.args, *(k.value for k in node.keywords)] if isinstance(arg, ast.Constant)]
        mode = any(isinstance(word, str) and word[:1] in ("w", "a", "x") and len(word) <= 3 for word in words)
        if (
            name in WRITERS
            or (name in ("copy", "move", "rename", "replace", "link") and owner in ("shutil", "os"))
            or (name == "save" and node.args and owner)
            or (name in ("open", "ZipFile", "TarFile", "fdopen", "GzipFile") and mode)
            or (name == "open" and owner == "os")
        ):
            yield f"{path.relative_to(ROOT).as_posix()}: {ast.unparse(node)}"


def test_nothing_writes_but_through_the_helper() -> None:
    paths = [path for folder in ("axcomp", "fmu_src") for path in (ROOT / folder).rglob("*.py")]
    assert {call for path in paths for call in writes(path)} ^ KNOWN == set()


def test_several_files_are_written_all_or_none(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"old")
    with pytest.raises(OSError, match="no") as raised:
        write_all({tmp_path / "a": b"new", tmp_path / "no" / "b": b"new"})
    assert raised.value.filename == str(tmp_path / "no" / "b")
    assert [(path.name, path.read_bytes()) for path in tmp_path.iterdir()] == [("a", b"old")]
    write_all({tmp_path / "a": b"new", tmp_path / "b": b"new"})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


@pytest.mark.skipif(not hasattr(os, "geteuid"), reason="needs rights as POSIX has them")
@pytest.mark.parametrize("locked", ["file", "folder"])
def test_what_may_not_be_written_stays(locked: str, tmp_path: Path) -> None:
    """In a child that is no root: root may write anything."""
    place = tmp_path / "place"
    place.mkdir()
    old = place / "a.lis"
    old.write_bytes(b"old")
    old.chmod(0o444 if locked == "file" else 0o666)
    place.chmod(0o777 if locked == "file" else 0o555)
    program = (
        "import os, sys\n"
        "from axcomp.saving import write_whole\n"
        "os.geteuid() or os.setuid(65534)\n"
        "try:\n    write_whole(sys.argv[1], b'new')\n"
        "except PermissionError as error:\n    print(error.filename)\n"
    )
    for folder in [tmp_path, *tmp_path.parents][:4]:
        if os.geteuid() == 0 and folder != Path("/tmp"):
            folder.chmod(folder.stat().st_mode | 0o055)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    words = [sys.executable, "-c", program, str(old)]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == (f"{old}\n", "")
    assert [(path.name, path.read_bytes()) for path in place.iterdir()] == [("a.lis", b"old")]


COMMANDS = {
    "build": ["build", "--machine", "MODEL", "--image", "OUT"],
    "report": ["report", "MODEL", "--output", "OUT"],
    "show page": ["show", "MODEL", "--output", "OUT.html"],
    "show figures": ["show", "MODEL", "--output", "OUT.csv"],
    "run": ["run", "MODEL/input.csv", "--machine", "MODEL", "--output", "OUT"],
    "convert": ["convert", "MODEL", "--axis", "X", "--kind", "leadscrew", "--to", "csv", "--output", "OUT"],
    "diagnose": ["diagnose", "FIVE", "--id", "0", "--output", "OUT"],
}
"""Commands that write one file; reading the model and computing are the same each time."""


def command(name: str, out: Path) -> tuple[list[str], Path]:
    places = {"MODEL": str(models() / "three_axis"), "FIVE": str(models() / "five_axis"), "OUT": str(out)}
    words = []
    for word in COMMANDS[name]:
        for key, value in places.items():
            word = word.replace(key, value)  # noqa: PLW2901
        words.append(word)
    return words, Path(next(word for word in words if word.startswith(str(out))))


@pytest.mark.parametrize("name", COMMANDS)
def test_a_full_disk_leaves_the_file_of_each_command(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words, path = command(name, tmp_path / "out")
    assert main(words) == 0
    before = path.read_bytes()
    capsys.readouterr()

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        assert main(words) == 1
    assert "No space left on device" in capsys.readouterr().err
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="mounts a small file system")
def test_a_disk_that_is_really_full_leaves_the_old_file(tmp_path: Path) -> None:
    mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(tmp_path)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("mounting is not allowed here")
    try:
        write_whole(tmp_path / "a", b"old" * 13_000)
        with pytest.raises(OSError, match="No space left"):
            write_whole(tmp_path / "a", b"new" * 13_000)
        assert (tmp_path / "a").read_bytes() == b"old" * 13_000
        assert [path.name for path in tmp_path.iterdir()] == ["a"]
    finally:
        subprocess.run(["umount", tmp_path], check=True)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs signals")
def test_a_kill_at_any_point_leaves_a_whole_file(tmp_path: Path) -> None:
    """A child writes one of two contents for ever; whenever it is killed, one of the two is there."""
    contents = [bytes([kind]) * 3_000_000 for kind in b"ab"]
    path = tmp_path / "a"
    write_whole(path, contents[0])
    program = (
        "import sys\nfrom axcomp.saving import write_whole\n"
        "while True:\n    for kind in b'ab':\n        write_whole(sys.argv[1], bytes([kind]) * 3_000_000)\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    for k in range(12):
        with subprocess.Popen([sys.executable, "-c", program, str(path)], env=environment) as child:
            time.sleep(0.06 + 0.0113 * k)
            child.kill()
        assert path.read_bytes() in contents
    assert all(name.startswith(".axcomp-") for name in {one.name for one in tmp_path.iterdir()} - {"a"})
